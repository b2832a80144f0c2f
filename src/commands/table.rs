//! The parameter table: the paper's Table 1, as Markdown and on the terminal.

use comfy_table::{Table, presets};

use crate::{
    compare::Match,
    motion::shown,
    parameters::Parameters,
    tuning::{
        front::Point,
        whole_model::report::LandingRow,
    },
};

/// Rows of Table 1: name, vertical, horizontal.
fn rows(p: &Parameters) -> Vec<[String; 3]> {
    let (v, h) = (&p.vertical, &p.horizontal);
    let row = |name: &str, v: String, h: String| [name.to_string(), v, h];
    let plain = |x: f64| format!("{x:.4}");
    let power = |x: f64| format!("{x:.4e}");
    vec![
        row("mass ratio mu = m2/m1", plain(v.mu), plain(h.mu)),
        row("frequency ratio f", plain(v.f), plain(h.f)),
        row("damping ratio xi", plain(v.xi), plain(h.xi)),
        row("Omega_n / 2 pi [Hz]", plain(v.omega_n_hz), plain(h.omega_n_hz)),
        row("k1 [N/m]", power(v.k1_n_per_m), power(h.k1_n_per_m)),
        row("k2 [N/m]", power(v.k2_n_per_m), power(h.k2_n_per_m)),
        row("m2 [kg]", power(v.m2_kg), power(h.m2_kg)),
        row("c [N s/m]", power(v.c_ns_per_m), power(h.c_ns_per_m)),
    ]
}

/// Rows of the match: name, Housner, finite elements, and these on the springs of the paper's procedure if they differ.
fn match_rows(p: &Parameters) -> Vec<Vec<String>> {
    let Some(m) = &p.matched else { return Vec::new() };
    let paper = p.paper_procedure.map(|paper| paper.matched);
    let row = |name: &str, housner: String, value: &dyn Fn(&Match) -> String| {
        let mut row = vec![name.to_string(), housner, value(m)];
        row.extend(paper.iter().map(value));
        row
    };
    let mm = |x: f64| format!("{:.2} mm", x * 1e3);
    let percent = |x: f64| format!("{:.3} %", x * 100.0);
    let none = String::new;
    vec![
        row("peak horizontal displacement", mm(m.peak_horizontal_housner_m), &|m| mm(m.peak_horizontal_fem_m)),
        row("peak vertical displacement", mm(m.peak_vertical_housner_m), &|m| mm(m.peak_vertical_fem_m)),
        row("impacts", m.impacts_housner.to_string(), &|m| m.impacts_fem.to_string()),
        row("NRMSE horizontal", none(), &|m| shown(m.nrmse_horizontal)),
        row("NRMSE vertical", none(), &|m| shown(m.nrmse_vertical)),
        row("largest error of restitution", none(), &|m| percent(m.restitution_error_max)),
        row("the same, landings as hard as a fall from 0.02 alpha", none(), &|m| {
            m.restitution_error_firm.map_or(none(), percent)
        }),
        row("bounces", none(), &|m| m.bounces.to_string()),
        row("settlement", none(), &|m| format!("{:.3} mm", m.settlement_m * 1e3)),
        row("energy residual", none(), &|m| format!("{:.1e}", m.energy_residual)),
    ]
}

/// Heading of these rows.
fn match_head(first: &str, p: &Parameters) -> Vec<String> {
    let mut head = vec![first.to_string(), "Housner".to_string(), "finite elements".to_string()];
    head.extend(p.paper_procedure.map(|_| "by the paper's procedure".to_string()));
    head
}

fn heading(p: &Parameters) -> String {
    let s = &p.structure;
    let record = p.record.as_ref().map_or(String::new(), |r| {
        format!("; record {} ({} samples of {} s, PGA {:.4} g)", r.name, r.samples, r.dt_s, r.pga_g)
    });
    format!(
        "Ground springs of one foot; {}: centre of mass at {} m, feet {} m apart, {:.4e} kg{record}",
        match s.kind {
            crate::structure::Kind::AFrame => "A-frame",
            crate::structure::Kind::Block => "block",
        },
        s.height_m,
        s.width_m,
        s.mass_kg
    )
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

fn strings(head: &[&str]) -> Vec<String> {
    head.iter().map(|s| s.to_string()).collect()
}

const LANDINGS: [&str; 8] =
    ["landing from", "restitution e", "error of e", "in the air", "rebound", "touch-downs", "ringing", "settlement"];

/// Rows of the landings.
fn landing_rows(p: &Parameters) -> Vec<[String; 8]> {
    let row = |l: &LandingRow| {
        [
            format!("{} alpha", l.lean),
            format!("{:.5}", l.restitution),
            format!("{:+.3} %", l.restitution_error * 100.0),
            format!("{:.1} ms", l.air_s * 1e3),
            format!("{:.2}", l.rebound),
            l.touch_downs.to_string(),
            format!("{:.1e}", l.ringing),
            format!("{:.3} mm", l.settlement_m * 1e3),
        ]
    };
    p.landings.iter().map(row).collect()
}

const PER_FOOT: [&str; 3] = ["per foot", "vertical", "horizontal"];

/// `parameters.md`.
pub fn markdown(p: &Parameters) -> String {
    let mut out = format!("{}.\n\n{}", heading(p), markdown_table(&strings(&PER_FOOT), rows(p)));
    if let Some(m) = &p.matched {
        out.push_str(&format!("\nMatch over the first {:.2} s:\n\n", m.duration_s));
        out.push_str(&markdown_table(&match_head("", p), match_rows(p)));
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
    let mut out = format!("{}\n\n{}\n", heading(p), terminal_table(&strings(&PER_FOOT), rows(p)));
    if let Some(m) = &p.matched {
        let head = match_head(&format!("first {:.2} s", m.duration_s), p);
        out.push_str(&format!("\n{}\n", terminal_table(&head, match_rows(p))));
    }
    out
}

const FRONT: [&str; 6] = [
    "Omega_n [Hz]",
    "NRMSE of u, landing",
    "paper's procedure",
    "largest foot force [weights]",
    "contact changes",
    "",
];

fn front_rows(front: &[Point]) -> Vec<[String; 6]> {
    let error = |e: Option<f64>| e.map_or("-".to_string(), shown);
    let row = |p: &Point| {
        [
            format!("{:.0}", p.omega_n_hz),
            error(p.landing),
            error(p.arr),
            format!("{:.0}", p.foot_force_weights),
            p.contact_changes.to_string(),
            if p.chosen { "chosen".to_string() } else { String::new() },
        ]
    };
    front.iter().map(row).collect()
}

/// The front, for `parameters.md`.
pub fn front(front: &[Point]) -> String {
    if front.is_empty() {
        return String::new();
    }
    format!("\nError against stiffness:\n\n{}", markdown_table(&strings(&FRONT), front_rows(front)))
}

/// The front, for a terminal.
pub fn front_terminal(front: &[Point]) -> String {
    if front.is_empty() {
        return String::new();
    }
    format!("\n{}\n", terminal_table(&strings(&FRONT), front_rows(front)))
}
