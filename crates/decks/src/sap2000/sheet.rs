//! The model of the tables as a sheet to type from, for who would rather not import a file.

mod compare;
mod etabs;

use std::fmt::Write;

use super::super::LARGE_TOLERANCE;
use super::{FRICTION, KILO, MODULUS, SapModel, cases::CaseSettings, parts::SpringLinks};
use crate::{language::record_note, plain::lines};
pub(crate) use compare::ToCompare;
use compare::{expected, notes};
use files::message::significant;
use rocking::scalar::GRAVITY;

/// Width of a column.
const COLUMN: usize = 13;

/// The sheet.
pub(crate) fn sheet(parts: &SapModel) -> String {
    let program = if parts.even.etabs { "ETABS" } else { "SAP2000" };
    let mut text = format!("{}\nTo type into {program}. Units: kN, m, t, s.\n", parts.title);
    if let Some(why) = parts.even.not_to_be_used {
        text += &format!("{why}.\n");
    }
    if parts.even.etabs {
        text += &etabs::words(parts);
    }
    for (number, part) in [
        joints(parts),
        frames(parts),
        properties(parts),
        links(parts),
        weight(parts),
        history(parts),
        expected(parts),
        notes(parts),
    ]
    .into_iter()
    .enumerate()
    {
        // writing to a String does not fail
        let _ = write!(text, "\n{}. {part}", number + 1);
    }
    text
}

/// A line of columns.
fn line(cells: &[String]) -> String {
    let cells: String = cells.iter().map(|cell| format!("{cell:<COLUMN$}")).collect();
    format!("   {}\n", cells.trim_end())
}

fn head(cells: &[&str]) -> String {
    line(&cells.iter().map(ToString::to_string).collect::<Vec<_>>())
}

fn number(x: f64) -> String {
    significant(x, 5)
}

fn joints(parts: &SapModel) -> String {
    let mut text =
        "Joints in the plane XZ (active: UX, UZ, RY). A mass acts in X and Z as given.\n"
            .to_string();
    text += &head(&["joint", "x", "z", "mass in X", "mass in Z", "inertia R2", "held"]);
    let mut joint = |tag: usize, [x, z]: [f64; 2], masses: [f64; 3], held: &str| {
        let masses = masses.map(|mass| match mass {
            0.0 => "-".to_string(),
            mass => number(mass * KILO),
        });
        let cells = [vec![tag.to_string(), number(x), number(z)], masses.into()].concat();
        text += &line(&[cells, vec![held.into()]].concat());
    };
    for each in &parts.joints {
        joint(each.tag, each.place, [each.mass, each.mass, each.inertia], "");
    }
    let below = |tag: usize, links: f64| {
        let [x, z] = parts.place(tag);
        [x, z - links * parts.link]
    };
    for foot in &parts.feet {
        let springs = &parts.units[foot.unit].springs;
        let masses = [springs.horizontal.m2, springs.vertical.m2, 0.0];
        joint(foot.absorber, below(foot.joint, 1.0), masses, "U2 R1 R2 R3 (absorber)");
    }
    for foot in &parts.feet {
        joint(foot.ground, below(foot.joint, 2.0), [0.0; 3], "all (ground)");
    }
    text + "   Mass source: Element Self Mass and Additional Mass; no load patterns; the \
            material's mass and weight per\n   volume are 0.\n"
}

fn frames(parts: &SapModel) -> String {
    let damped = parts.sections.iter().any(|section| section.ahead > 0.0);
    let modulus = number(MODULUS);
    let mut text = format!(
        "Frames, weightless: section General, material of E = {modulus} kN/m2, Poisson's ratio 0, \
         mass and weight per\n   volume 0. Torsion and I22 as I33, AS3 as AS2: nothing acts on \
         them in the plane.{}\n",
        if damped { "" } else { " Additional material\n   damping: none." }
    );
    let columns = ["frame", "joints", "A (m2)", "I33 (m4)", "AS2 (m2)", "damping (s)"];
    text += &head(&columns[..columns.len() - usize::from(!damped)]);
    let [axial, bending, shear] = [1.0, 1.0, 2.0].map(|factor| factor * KILO / MODULUS);
    for (i, bar) in parts.bars.iter().enumerate() {
        let section = &parts.sections[bar.section];
        let or = |x: f64, no: &str| match x.is_finite() && x > 0.0 {
            true => number(x),
            false => no.into(),
        };
        let [from, to] = bar.joints;
        let mut cells = vec![
            (i + 1).to_string(),
            format!("{from} - {to}"),
            number(section.axial * axial),
            number(section.bending * bending),
            or(section.shear * shear, "0 (none)"),
        ];
        cells.extend(damped.then(|| or(section.ahead, "0")));
        text += &line(&cells);
    }
    text
}

fn properties(parts: &SapModel) -> String {
    let mut text =
        "Link properties. Local 1 points up, local 2 along +X; shear distance DJ = 0 and \
                    no mass for all. P-Delta\n   moments to end I. Effective stiffness: the \
                    same.\n"
            .to_string();
    text += &head(&["property", "direction", "stiffness", "damping", "type"]);
    for SpringLinks { suffix, springs } in &parts.units {
        let (v, h) = (&springs.vertical, &springs.horizontal);
        let slider = format!("friction coefficients {FRICTION}, rate 0, radius 0; nonlinear");
        for (name, direction, stiffness, damping, kind) in [
            ("FOOT", "U1", v.k1, 0.0, "Friction Isolator: compression only, nonlinear"),
            ("FOOT", "U2", h.k1, 0.0, slider.as_str()),
            ("GROUND", "U1", v.k2, v.c, "Linear"),
            ("GROUND", "U2", h.k2, h.c, "Linear"),
        ] {
            text += &line(&[
                format!("{name}{suffix}"),
                direction.into(),
                number(stiffness * KILO),
                number(damping * KILO),
                kind.into(),
            ]);
        }
    }
    text
}

fn links(parts: &SapModel) -> String {
    let mut text = "Links, from the lower joint I to the upper joint J.\n".to_string();
    text += &head(&["link", "I - J", "property"]);
    let unit = |unit: usize| &parts.units[unit].suffix;
    let upper = parts.feet.iter().map(|f| (f.absorber, f.joint, format!("FOOT{}", unit(f.unit))));
    let lower =
        parts.feet.iter().map(|f| (f.ground, f.absorber, format!("GROUND{}", unit(f.unit))));
    for (i, (from, to, property)) in upper.chain(lower).enumerate() {
        text += &line(&[(i + 1).to_string(), format!("{from} - {to}"), property]);
    }
    text
}

fn weight(parts: &SapModel) -> String {
    let mut text = format!(
        "Load pattern WEIGHT, self weight multiplier 0. Joint forces in Z, g = {GRAVITY} m/s2:\n"
    );
    for joint in parts.joints.iter().filter(|joint| joint.mass > 0.0) {
        let force = number(-joint.mass * GRAVITY * KILO);
        text += &line(&[format!("joint {}", joint.tag), force]);
    }
    text + "   Load case GRAVITY: nonlinear static from zero, WEIGHT with factor 1, full load, \
            P-Delta plus\n   large displacements; all else as the program has it.\n"
}

/// What the load case of the ground motion has in any program, one setting each: its name, its
/// words.
pub(crate) fn of_any_program(parts: &SapModel) -> Vec<(&'static str, String)> {
    let (output, dt) = (parts.output(), parts.record.dt);
    let (followed, whole) = (parts.samples.saturating_sub(1), parts.record.len().saturating_sub(1));
    let multiple = match output.step_s == dt {
        true => String::new(),
        false => format!(" (whole steps; the record's are {} s)", number(dt)),
    };
    let end = match followed < whole {
        true => format!(
            ": to {} s of the record's {} s, where {}",
            number(followed as f64 * dt),
            number(whole as f64 * dt),
            match parts.even.ends.falls_s {
                Some(_) => "the structure has toppled in these steps",
                None => "the emulation of these steps ends",
            }
        ),
        false => String::new(),
    };
    let scale = parts.record.made_of.as_ref().map_or(1.0, |of| of.scale);
    let scaled = format!("; scale {}, in the file already", significant(scale, 6));
    vec![
        ("geometry", "P-Delta plus large displacements".to_string()),
        ("record", record_note(parts.record) + &scaled),
        ("load", motions(parts)),
        ("output", format!("{} steps of {} s{multiple}{end}", output.count, number(output.step_s))),
        ("damping", "proportional damping 0: mass and stiffness coefficient".into()),
    ]
}

fn history(parts: &SapModel) -> String {
    let settings = CaseSettings::of(&parts.even);
    let short = |digits: &str| digits.parse().map_or_else(|_| digits.to_string(), number);
    let [gamma, beta, alpha] = settings.constants().map(number);
    let mut text = "Load case QUAKE: nonlinear direct integration history that continues from \
                    GRAVITY.\n"
        .to_string();
    let of_csi = [
        (
            "integration",
            format!("{}, gamma {gamma}, beta {beta}, alpha {alpha}", settings.method()),
        ),
        (
            "substeps",
            format!(
                "largest {} s, smallest {} s",
                short(&settings.longest),
                short(&settings.shortest)
            ),
        ),
        (
            "iterations",
            format!(
                "constant stiffness {}, Newton-Raphson {}; relative tolerance {}{}",
                settings.constant,
                settings.newton,
                short(&settings.tolerance),
                meant(&settings.tolerance)
            ),
        ),
        // the dialog has both otherwise
        ("stepping", "event-to-event stepping No; at most 0 line searches an iteration".into()),
    ];
    let below = format!("\n   {:COLUMN$}", "");
    for (what, value) in of_any_program(parts).into_iter().chain(of_csi) {
        text += &format!("   {what:<COLUMN$}{}\n", lines(&value, &below));
    }
    text
}

/// The ground's acceleration, and the files that have it.
fn motions(parts: &SapModel) -> String {
    let first = parts.record.accel.first().copied().unwrap_or_default();
    let begins = match first == 0.0 {
        true => String::new(),
        false => format!(
            "; it begins at 0, for the program takes it relative to its first value, the record's \
             {} m/s2",
            number(first)
        ),
    };
    let across = format!(
        "acceleration U1, scale 1: function from file ground_motion.txt beside this one, values \
         are Time and Function Values, a pair a line, in s and m/s2, scaled already, no header \
         line{begins}"
    );
    match parts.record.vertical {
        Some(_) => across + "; U3, scale 1: the same from ground_motion_up.txt",
        None => across,
    }
}

/// That a tolerance which looks like a misprint is none.
fn meant(tolerance: &str) -> &'static str {
    match tolerance.parse::<f64>() {
        Ok(x) if x > LARGE_TOLERANCE => {
            " (meant so large: with a smaller one such steps lose histories)"
        }
        _ => "",
    }
}
