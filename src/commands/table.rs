//! The parameter table: the paper's Table 1, as Markdown and on the terminal.

use comfy_table::{Table, presets};

use crate::{
    compare::Match,
    front::FrontPoint,
    message::percent,
    motion::shown,
    parameters::{PaperProcedure, Parameters},
    spring::ChainRow,
    tuning::whole_model::report::LandingRow,
};

/// Springs and their match under a heading.
struct SpringsColumn<'a> {
    heading: &'static str,
    vertical: &'a ChainRow,
    horizontal: &'a ChainRow,
    matched: Option<&'a Match>,
}

/// The springs of a file, and those beside them.
fn columns(p: &Parameters) -> Vec<SpringsColumn<'_>> {
    let own = SpringsColumn {
        heading: "finite elements",
        vertical: &p.vertical,
        horizontal: &p.horizontal,
        matched: p.matched.as_ref(),
    };
    let others = [("paper's procedure, same Omega_n", &p.paper_procedure), ("Table 1 as recovered", &p.table_1)];
    let others =
        others.into_iter().filter_map(|(heading, other)| Some(SpringsColumn::beside(heading, other.as_ref()?)));
    std::iter::once(own).chain(others).collect()
}

impl<'a> SpringsColumn<'a> {
    fn beside(heading: &'static str, other: &'a PaperProcedure) -> Self {
        let PaperProcedure { vertical, horizontal, matched } = other;
        Self { heading, vertical, horizontal, matched: Some(matched) }
    }
}

/// Heading and rows of Table 1: name, vertical and horizontal of each springs.
pub(super) fn spring_rows(p: &Parameters) -> (Vec<String>, Vec<Vec<String>>) {
    let all = columns(p);
    let mut head = vec!["per foot".to_string()];
    for (i, column) in all.iter().enumerate() {
        let of = if i == 0 { String::new() } else { format!("{}: ", column.heading) };
        head.extend([format!("{of}vertical"), "horizontal".to_string()]);
    }
    let plain = |x: f64| format!("{x:.4}");
    let power = |x: f64| format!("{x:.4e}");
    type SpringsCell<'a> = (&'static str, &'a dyn Fn(&ChainRow) -> String);
    let cells: [SpringsCell; 8] = [
        ("mass ratio mu = m2/m1", &|c| plain(c.mu)),
        ("frequency ratio f", &|c| plain(c.f)),
        ("damping ratio xi", &|c| plain(c.xi)),
        ("Omega_n / 2 pi [Hz]", &|c| five_digits(c.omega_n_hz)),
        ("k1 [N/m]", &|c| power(c.k1_n_per_m)),
        ("k2 [N/m]", &|c| power(c.k2_n_per_m)),
        ("m2 [kg]", &|c| power(c.m2_kg)),
        ("c [N s/m]", &|c| power(c.c_ns_per_m)),
    ];
    let row = |(name, cell): SpringsCell| {
        let mut row = vec![name.to_string()];
        row.extend(all.iter().flat_map(|column| [cell(column.vertical), cell(column.horizontal)]));
        row
    };
    (head, cells.map(row).into())
}

/// A frequency with five significant digits, all of them before the point where it is large.
fn five_digits(hz: f64) -> String {
    let before = if hz > 0.0 { hz.log10().floor() } else { 0.0 };
    format!("{hz:.*}", (4.0 - before).clamp(0.0, 9.0) as usize)
}

/// What m2 is: there is no such mass in the structure.
pub(super) const ABSORBER: &str = "m2 is no part of the structure: a fictitious mass between foot and ground, without weight, that takes in \
                                   a landing the momentum which Housner's rule takes.";

/// Heading and rows of the match: name, Housner, and each springs.
pub(super) fn match_rows(first: &str, p: &Parameters) -> (Vec<String>, Vec<Vec<String>>) {
    let all = columns(p);
    let mut head = vec![first.to_string(), "Housner".to_string()];
    head.extend(all.iter().map(|column| column.heading.to_string()));
    let Some(m) = &p.matched else { return (head, Vec::new()) };
    let row = |name: &str, housner: String, value: &dyn Fn(&Match) -> String| {
        let mut row = vec![name.to_string(), housner];
        row.extend(all.iter().map(|column| column.matched.map_or(String::new(), value)));
        row
    };
    let mm = |x: f64| format!("{:.2} mm", x * 1e3);
    let count = |x: Option<usize>| x.map_or("-".to_string(), |n| n.to_string());
    let none = String::new;
    let rows = vec![
        row("peak horizontal displacement", mm(m.peak_horizontal_housner_m), &|m| mm(m.peak_horizontal_fem_m)),
        row("peak vertical displacement", mm(m.peak_vertical_housner_m), &|m| mm(m.peak_vertical_fem_m)),
        row("impacts harder than a fall from 0.02 alpha", count(m.impacts_housner_firm), &|m| {
            count(m.impacts_fem_firm)
        }),
        row("all, with the tremble of a body coming to rest", m.impacts_housner.to_string(), &|m| {
            m.impacts_fem.to_string()
        }),
        row("NRMSE horizontal", none(), &|m| shown(m.nrmse_horizontal)),
        row("NRMSE vertical", none(), &|m| shown(m.nrmse_vertical)),
        row("largest error of restitution", none(), &|m| percent(m.restitution_error_max)),
        row("the same, impacts harder than a fall from 0.02 alpha", none(), &|m| {
            m.restitution_error_firm.map_or("-".into(), percent)
        }),
        row("bounces", none(), &|m| m.bounces.to_string()),
        row("settlement", none(), &|m| format!("{:.5} mm", m.settlement_m * 1e3)),
        row("energy residual", none(), &|m| format!("{:.1e}", m.energy_residual)),
    ];
    (head, rows)
}

fn heading(p: &Parameters) -> String {
    let s = &p.structure;
    let record = p.record.as_ref().map_or(String::new(), |r| {
        format!("; record {} ({} samples of {} s, PGA {:.4} g)", r.name, r.samples, r.dt_s, r.pga_g)
    });
    format!(
        "Ground springs of one foot; {}: centre of mass at {} m, feet {} m apart, {} kg{record}",
        match s.kind {
            crate::structure::Kind::AFrame => "A-frame",
            crate::structure::Kind::Block => "block",
        },
        six_digits(s.height_m),
        six_digits(s.width_m),
        six_digits(s.mass_kg)
    )
}

/// x to six significant digits: a length in inches is not shown with the rounding of its conversion.
fn six_digits(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// A Markdown table.
fn markdown_table<T: AsRef<[String]>>(head: &[String], rows: impl IntoIterator<Item = T>) -> String {
    let mut out = format!("| {} |\n|{}\n", head.join(" | "), "---|".repeat(head.len()));
    for row in rows {
        out.push_str(&format!("| {} |\n", row.as_ref().join(" | ")));
    }
    out
}

/// The same for a terminal.
fn terminal_table<T: AsRef<[String]>>(head: &[String], rows: impl IntoIterator<Item = T>) -> String {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header(head);
    table.add_rows(rows.into_iter().map(|row| row.as_ref().to_vec()));
    table.to_string()
}

pub(super) fn strings(head: &[&str]) -> Vec<String> {
    head.iter().map(|s| s.to_string()).collect()
}

pub(super) const LANDINGS: [&str; 8] =
    ["landing from", "restitution e", "error of e", "in the air", "rebound", "touch-downs", "ringing", "settlement"];

/// Rows of the landings.
pub(super) fn landing_rows(p: &Parameters) -> Vec<[String; 8]> {
    let row = |l: &LandingRow| {
        [
            format!("{} alpha", l.lean),
            format!("{:.5}", l.restitution),
            percent(l.restitution_error),
            format!("{:.1} ms", l.air_s * 1e3),
            format!("{:.3}", l.rebound),
            l.touch_downs.to_string(),
            format!("{:.1e}", l.ringing),
            format!("{:.3} mm", l.settlement_m * 1e3),
        ]
    };
    p.landings.iter().map(row).collect()
}

/// What the run found: an accuracy missed, what the body did, the accuracy measured and on what, which springs.
pub fn said(p: &Parameters) -> Vec<String> {
    let warning = p.assessment.iter().filter_map(|assessment| assessment.warning());
    warning.chain(found(p)).collect()
}

/// The same without the warning, for what begins with it.
pub fn found(p: &Parameters) -> Vec<String> {
    let verdict = p.verdict.iter().flat_map(|verdict| verdict.lines());
    verdict.chain(trusted(p)).chain(p.assessment.iter().flat_map(|assessment| assessment.lines())).collect()
}

/// That springs are sound although one motion cannot be foretold.
fn trusted(p: &Parameters) -> Option<String> {
    let (verdict, assessment) = (p.verdict?, p.assessment?);
    let judged = assessment.measured.synthetic_median.filter(|_| assessment.reached)?;
    (!verdict.well_conditioned && verdict.nrmse_horizontal.is_some()).then(|| {
        format!(
            "the springs can be trusted all the same: they reached the accuracy on {} synthetic motions that can be foretold",
            judged.count
        )
    })
}

/// What comes before everything else.
fn first(p: &Parameters) -> String {
    let warning = p.assessment.and_then(|assessment| assessment.warning());
    warning.map_or(String::new(), |warning| warning + "\n\n")
}

/// `parameters.md`.
pub fn markdown(p: &Parameters) -> String {
    let (head, rows) = spring_rows(p);
    let mut out = format!("{}{}.\n\n{}\n{ABSORBER}\n", first(p), heading(p), markdown_table(&head, rows));
    let found = found(p);
    if !found.is_empty() {
        out.push_str(&format!("\n- {}\n", found.join("\n- ")));
    }
    if let Some(m) = &p.matched {
        out.push_str(&format!("\nMatch over the first {:.2} s:\n\n", m.duration_s));
        let (head, rows) = match_rows("", p);
        out.push_str(&markdown_table(&head, rows));
    }
    if !p.landings.is_empty() {
        out.push_str(&format!(
            "\nLandings without a record: released at rest, landed once, up to the next impact; restitution asked for \
             {:.5}, ringing as a share of the weight.\n\n",
            p.restitution()
        ));
        out.push_str(&markdown_table(&strings(&LANDINGS), landing_rows(p)));
    }
    out
}

/// The same for a terminal.
pub fn terminal(p: &Parameters) -> String {
    let (head, rows) = spring_rows(p);
    let mut out = format!("{}{}\n\n{}\n{ABSORBER}\n", first(p), heading(p), terminal_table(&head, rows));
    if let Some(m) = &p.matched {
        let (head, rows) = match_rows(&format!("first {:.2} s", m.duration_s), p);
        out.push_str(&format!("\n{}\n", terminal_table(&head, rows)));
    }
    out
}

pub(super) const FRONT: [&str; 6] = [
    "Omega_n [Hz]",
    "NRMSE of u, design from the geometry",
    "paper's procedure",
    "largest foot force [weights]",
    "analyze steps of the deck",
    "",
];

/// What forces of the feet are.
pub(super) const FORCES: &str =
    "Foot forces are those of the springs in a landing, not of the structure: they grow with Omega_n.";

pub(super) fn front_rows(front: &[FrontPoint]) -> Vec<[String; 6]> {
    let error = |e: Option<f64>| e.map_or("-".to_string(), shown);
    let row = |p: &FrontPoint| {
        [
            format!("{:.0}", p.omega_n_hz),
            error(p.landing),
            error(p.arr),
            format!("{:.0}", p.foot_force_weights),
            p.deck_steps.to_string(),
            if p.chosen { "chosen".to_string() } else { String::new() },
        ]
    };
    front.iter().map(row).collect()
}

/// The front, for `parameters.md`.
pub fn front(front: &[FrontPoint]) -> String {
    if front.is_empty() {
        return String::new();
    }
    format!("\nError against Omega_n. {FORCES}\n\n{}", markdown_table(&strings(&FRONT), front_rows(front)))
}

/// The front, for a terminal.
pub fn front_terminal(front: &[FrontPoint]) -> String {
    if front.is_empty() {
        return String::new();
    }
    format!("\n{}\n{FORCES}\n", terminal_table(&strings(&FRONT), front_rows(front)))
}
