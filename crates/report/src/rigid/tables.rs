//! Tables of a rigid body's run: the paper's Table 1, the match, landings, forces, error over the
//! stiffness.

use super::super::Table;
use crate::stiffness_tradeoff::TradeoffPoint;
use dynamics::compare::Match;
use dynamics::{
    fem::{Demands, QUANTITIES},
    spring::ChainRow,
};
use files::message::{percent, quantity, significant};
use parameters::{PaperProcedure, Parameters};
use rocking::{motion::shown, structure::Kind};
use springs::landing_simulation::report::LandingRow;

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
    let others = [
        ("paper's procedure, same Omega_n", &p.paper_procedure),
        ("Table 1 as recovered", &p.table_1),
    ];
    let others = others
        .into_iter()
        .filter_map(|(heading, other)| Some(SpringsColumn::beside(heading, other.as_ref()?)));
    std::iter::once(own).chain(others).collect()
}

impl<'a> SpringsColumn<'a> {
    fn beside(heading: &'static str, other: &'a PaperProcedure) -> Self {
        let PaperProcedure { vertical, horizontal, matched } = other;
        Self { heading, vertical, horizontal, matched: Some(matched) }
    }
}

/// Table 1 of the paper: name, vertical and horizontal of each springs.
pub(crate) fn springs(p: &Parameters) -> Table {
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
    Table { head, rows: cells.map(row).into() }
}

/// A frequency with five significant digits, all of them before the point where it is large.
fn five_digits(hz: f64) -> String {
    let before = if hz > 0.0 { hz.log10().floor() } else { 0.0 };
    format!("{hz:.*}", (4.0 - before).clamp(0.0, 9.0) as usize)
}

/// What m2 is: there is no such mass in the structure.
pub(crate) const ABSORBER: &str = "m2 is not part of the structure: it is a fictitious mass \
    without weight between foot and ground, which takes up in a landing the momentum that \
    Housner's rule removes.";

/// The match: name, Housner, and each springs.
pub(crate) fn comparison(p: &Parameters) -> Table {
    let all = columns(p);
    let mut head = vec!["on the record".to_string(), "Housner".to_string()];
    head.extend(all.iter().map(|column| column.heading.to_string()));
    let Some(m) = &p.matched else { return Table::new(head) };
    let all: Vec<_> = all.iter().map(|column| column.matched).collect();
    Table { head, rows: match_rows(m, &all) }
}

/// The same of a structure with a tendon or dampers, beside Housner's equation with them.
pub(super) fn with_members(p: &Parameters) -> Option<Table> {
    let m = p.match_with_members.as_ref().filter(|_| p.members().act())?;
    let head = ["on the record, with members", "Housner", "finite elements"];
    Some(Table { head: head.map(String::from).into(), rows: match_rows(m, &[Some(m)]) })
}

/// Name, Housner's value in `m`, and that of each match.
fn match_rows(m: &Match, all: &[Option<&Match>]) -> Vec<Vec<String>> {
    let row = |name: &str, housner: String, value: &dyn Fn(&Match) -> String| {
        let mut row = vec![name.to_string(), housner];
        row.extend(all.iter().map(|matched| matched.map_or(String::new(), value)));
        row
    };
    let mm = |x: f64| format!("{:.2} mm", x * 1e3);
    let count = |x: Option<usize>| x.map_or("-".to_string(), |n| n.to_string());
    let none = String::new;
    vec![
        row("peak horizontal displacement", mm(m.peak_horizontal_housner_m), &|m| {
            mm(m.peak_horizontal_fem_m)
        }),
        row("peak vertical displacement", mm(m.peak_vertical_housner_m), &|m| {
            mm(m.peak_vertical_fem_m)
        }),
        row("impacts harder than a fall from 0.02 alpha", count(m.impacts_housner_firm), &|m| {
            count(m.impacts_fem_firm)
        }),
        row(
            "all impacts, including those of a body coming to rest",
            m.impacts_housner.to_string(),
            &|m| m.impacts_fem.to_string(),
        ),
        row("NRMSE horizontal", none(), &|m| shown(m.nrmse_horizontal)),
        row("NRMSE vertical", none(), &|m| shown(m.nrmse_vertical)),
        row("largest error of restitution", none(), &|m| percent(m.restitution_error_max)),
        row("the same, impacts harder than a fall from 0.02 alpha", none(), &|m| {
            m.restitution_error_firm.map_or("-".into(), percent)
        }),
        row("bounces", none(), &|m| m.bounces.to_string()),
        row("settlement", none(), &|m| format!("{:.5} mm", m.settlement_m * 1e3)),
        row("energy residual", none(), &|m| format!("{:.1e}", m.energy_residual)),
    ]
}

/// Landings from large leans to small.
pub(crate) fn landings(p: &Parameters) -> Table {
    let row = |l: &LandingRow| {
        vec![
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
    Table::new([
        "landing from",
        "restitution e",
        "error of e",
        "in the air",
        "rebound",
        "touch-downs",
        "ringing",
        "settlement",
    ])
    .with(p.landings.iter().map(row))
}

/// Error against Omega_n, and what stiffness costs.
pub(crate) fn stiffness(front: &[TradeoffPoint]) -> Table {
    let error = |e: Option<f64>| e.map_or("-".to_string(), shown);
    let row = |p: &TradeoffPoint| {
        vec![
            format!("{:.0}", p.omega_n_hz),
            error(p.landing),
            error(p.arr),
            format!("{:.0}", p.foot_force_weights),
            p.deck_steps.to_string(),
            if p.chosen { "chosen".to_string() } else { String::new() },
        ]
    };
    Table::new([
        "Omega_n [Hz]",
        "NRMSE of u, design from the geometry",
        "paper's procedure",
        "largest foot force [weights]",
        "analyze steps of the deck, at least",
        "",
    ])
    .with(front.iter().map(row))
}

/// Largest forces of the finite elements, between landings and in them; those of legs are an
/// A-frame's.
pub(crate) fn finite_element_forces(kind: Kind, columns: &[(&str, &Demands)]) -> Table {
    let mut head = vec!["finite elements, largest".to_string()];
    for (name, _) in columns {
        head.extend([format!("{name}between landings"), format!("{name}in landings")]);
    }
    let row = |(k, name): (usize, &&str)| {
        let peaks: Vec<_> = columns
            .iter()
            .flat_map(|(_, demands)| [demands.between[k], demands.peaks[k]])
            .collect();
        let of_leg = ["axial", "shear", "moment"].iter().any(|force| name.starts_with(force));
        if kind == Kind::Block && of_leg {
            return None;
        }
        let (what, unit) = name.rsplit_once('_')?;
        let unit = if unit == "nm" { "N m" } else { "N" };
        let cell = |peak: &rocking::motion::TimedPeak| match peak.value {
            0.0 => "-".to_string(),
            value => format!("{} at {} s", quantity(value, unit), significant(peak.time, 4)),
        };
        // a tendon's anchor is in it
        let tied = k == 0 && columns.iter().any(|(_, demands)| demands.peaks[7].value != 0.0);
        let with = if tied { ", with the tendon's anchor" } else { "" };
        let mut row = vec![what.replace('_', " ") + with];
        row.extend(peaks.iter().map(cell));
        peaks.iter().any(|peak| peak.value != 0.0).then_some(row)
    };
    Table::new(head).with(QUANTITIES.iter().enumerate().filter_map(row))
}
