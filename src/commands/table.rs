//! The parameter table: the paper's Table 1, as Markdown and on the terminal.

use comfy_table::{Table, presets};

use crate::{
    parameters::Parameters,
    tuning::front::{Errors, Point},
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

/// Rows of the match: name, Housner, finite elements.
fn match_rows(p: &Parameters) -> Vec<[String; 3]> {
    let Some(m) = &p.matched else { return Vec::new() };
    let mm = |x: f64| format!("{:.2} mm", x * 1e3);
    let row = |name: &str, a: String, b: String| [name.to_string(), a, b];
    vec![
        row("peak horizontal displacement", mm(m.peak_horizontal_housner_m), mm(m.peak_horizontal_fem_m)),
        row("peak vertical displacement", mm(m.peak_vertical_housner_m), mm(m.peak_vertical_fem_m)),
        row("impacts", m.impacts_housner.to_string(), m.impacts_fem.to_string()),
        row("NRMSE horizontal", String::new(), format!("{:.4}", m.nrmse_horizontal)),
        row("NRMSE vertical", String::new(), format!("{:.4}", m.nrmse_vertical)),
        row("largest error of restitution", String::new(), format!("{:.3} %", m.restitution_error_max * 100.0)),
        row("bounces", String::new(), m.bounces.to_string()),
        row("settlement", String::new(), format!("{:.3} mm", m.settlement_m * 1e3)),
        row("energy residual", String::new(), format!("{:.1e}", m.energy_residual)),
    ]
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

/// `parameters.md`.
pub fn markdown(p: &Parameters) -> String {
    let mut out = format!("{}.\n\n", heading(p));
    let table = |out: &mut String, head: [&str; 3], rows: Vec<[String; 3]>| {
        out.push_str(&format!("| {} |\n|---|---|---|\n", head.join(" | ")));
        for row in rows {
            out.push_str(&format!("| {} |\n", row.join(" | ")));
        }
    };
    table(&mut out, ["per foot", "vertical", "horizontal"], rows(p));
    if let Some(m) = &p.matched {
        out.push_str(&format!("\nMatch over the first {:.2} s:\n\n", m.duration_s));
        table(&mut out, ["", "Housner", "finite elements"], match_rows(p));
    }
    out
}

/// The same for a terminal.
pub fn terminal(p: &Parameters) -> String {
    let table = |head: [&str; 3], rows: Vec<[String; 3]>| {
        let mut table = Table::new();
        table.load_style(presets::ASCII_MARKDOWN).set_header(head);
        table.add_rows(rows);
        table.to_string()
    };
    let mut out = format!("{}\n\n{}\n", heading(p), table(["per foot", "vertical", "horizontal"], rows(p)));
    if let Some(m) = &p.matched {
        let head = format!("first {:.2} s", m.duration_s);
        out.push_str(&format!("\n{}\n", table([&head, "Housner", "finite elements"], match_rows(p))));
    }
    out
}

const FRONT: [&str; 5] = ["springs up to", "impact: NRMSE u", "v", "paper's procedure: NRMSE u", "v"];

fn front_rows(front: &[Point]) -> Vec<[String; 5]> {
    let pair = |e: Option<Errors>| match e {
        Some(e) => [format!("{:.4}", e.nrmse_u), format!("{:.4}", e.nrmse_v)],
        None => ["-".to_string(), "-".to_string()],
    };
    front
        .iter()
        .map(|p| {
            let ([iu, iv], [au, av]) = (pair(p.impact), pair(p.arr));
            [format!("{} Hz", p.max_hz), iu, iv, au, av]
        })
        .collect()
}

/// The front, for `parameters.md`.
pub fn front(front: &[Point]) -> String {
    if front.is_empty() {
        return String::new();
    }
    let mut out = format!("\nError against stiffness:\n\n| {} |\n|---|---|---|---|---|\n", FRONT.join(" | "));
    for row in front_rows(front) {
        out.push_str(&format!("| {} |\n", row.join(" | ")));
    }
    out
}

/// The front, for a terminal.
pub fn front_terminal(front: &[Point]) -> String {
    if front.is_empty() {
        return String::new();
    }
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header(FRONT);
    table.add_rows(front_rows(front));
    format!("\n{table}\n")
}
