//! A body whose friction gives way before it lifts, as a program.

use serde_json::Value;
use strong_motion::Record;

#[path = "support/program.rs"]
mod program;

use program::{TestFolder, finding};

const GRAVITY: f64 = 9.81;

/// What `tune run` prints, its parameters, and its summary.csv.
fn run(case: &str, options: &str) -> (String, Value, String) {
    let folder = TestFolder::with(&[("case.toml", case)]);
    let run = format!("run case.toml --quiet --no-figures --no-report {options}");
    let screen = folder.runs(&run).stdout;
    (screen, folder.json("out/parameters.json"), folder.text("out/summary.csv"))
}

/// Largest slip and where it ends (m): Newmark's block on a plane, r'' = -a_g - mu g sgn(r').
fn block_on_a_plane(record: &Record, friction: f64) -> [f64; 2] {
    let (parts, limit) = (1000, friction * GRAVITY);
    let h = record.dt / f64::from(parts);
    let (mut slip, mut rate, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for pair in record.accel.windows(2) {
        for part in 0..parts {
            let share = (f64::from(part) + 0.5) / f64::from(parts);
            let push = -(pair[0] + share * (pair[1] - pair[0]));
            if rate == 0.0 && push.abs() <= limit {
                continue;
            }
            let way = if rate == 0.0 { push.signum() } else { rate.signum() };
            let next = rate + h * (push - way * limit);
            let next = if next * way < 0.0 { 0.0 } else { next };
            slip += 0.5 * h * (rate + next);
            rate = next;
            largest = largest.max(slip.abs());
        }
    }
    [largest, slip.abs()]
}

/// A cabinet on a floor of friction 0.15, of which b/h is 0.2: it slides, as a block on a plane
/// does, the ground bears no more than mu m g, and nothing is foretold less for what Housner's body
/// would do.
#[test]
fn a_block_that_slides_is_newmarks() {
    let case = "[structure]\nkind = 'block'\ntotal_height_m = 1.9\nwidth_m = 0.38\n\
        mass_kg = 350.0\n[friction]\ncoefficient = 0.15\n[record]\nscale = 1.3\n";
    let (said, parameters, summary) = run(case, "");
    assert!(said.contains("slides and does not rock"), "{said}");
    assert!(!said.contains("predictable to") && !said.contains("Ill-conditioned"), "{said}");
    let mut record = Record::el_centro();
    record.accel.iter_mut().for_each(|a| *a *= 1.3);
    let slides = finding(&parameters, "slides").unwrap();
    for (key, due) in ["largest_m", "left_m"].into_iter().zip(block_on_a_plane(&record, 0.15)) {
        let found = slides[key].as_f64().unwrap();
        assert!((found / due - 1.0).abs() < 5e-3, "{key}: {found}, {due}");
    }
    let forces = &parameters["design_forces"];
    let most = 0.15 * 350.0 * GRAVITY;
    for (force, most) in [("column_shear_n", most), ("column_base_moment_nm", 0.95 * most)] {
        let value = forces[force]["value"].as_f64().unwrap().abs();
        assert!((value / most - 1.0).abs() < 3e-3, "{force}: {value}, {most}");
        assert_eq!(forces[force]["predictable"], true, "{force}");
    }
    // springs without friction stand beside
    let top = summary.lines().find(|line| line.starts_with("top displacement")).unwrap();
    let cells: Vec<f64> = top.split(',').skip(2).take(3).map(|x| x.parse().unwrap()).collect();
    assert!((cells[0] / cells[1] - 1.0).abs() < 0.01 && cells[2] < 0.1 * cells[1], "{top}");
}

/// Stout blocks that slide by decimetres are followed to the end of the record, and slide as a
/// block on a plane.
#[test]
fn blocks_that_slide_far_are_newmarks_to_the_end() {
    for (height, width, friction, scale) in
        [(1.2, 1.4, 0.2, 3.0), (1.6, 1.2, 0.3, 4.0), (0.5, 0.6, 0.1, 2.0)]
    {
        let (said, parameters, _) = run(
            &format!(
                "[structure]\nkind = 'block'\ntotal_height_m = {height}\nwidth_m = {width}\n\
                 mass_kg = 1200.0\n[friction]\ncoefficient = {friction}\n[record]\n\
                 scale = {scale}\n"
            ),
            "--no-front",
        );
        assert!(said.contains("slides and does not rock"), "{said}");
        let mut record = Record::el_centro();
        record.accel.iter_mut().for_each(|a| *a *= scale);
        let slides = finding(&parameters, "slides").unwrap();
        let [largest, left] = block_on_a_plane(&record, friction);
        for (key, due) in [("largest_m", largest), ("left_m", left)] {
            let found = slides[key].as_f64().unwrap();
            assert!((found - due).abs() < 5e-3 * largest, "{height} m, {key}: {found}, {due}");
        }
    }
}

/// What acts together with each largest force of a body that slides, beside statics: its shear is
/// mu W and its moment mu W h; the corner that is pressed bears W/2 (1 + mu h/b), and mu times that
/// across; nothing is above the largest of its kind.
fn its_forces_are_of_one_sliding_body(parameters: &Value, weight: f64, (h, b): (f64, f64)) {
    let forces = &parameters["design_forces"];
    let largest = |key: &str| forces[key]["value"].as_f64().map(f64::abs);
    let near = |found: f64, due: f64| assert!((found / due - 1.0).abs() < 1e-5, "{found} {due}");
    let shear = 0.2 * weight;
    let pressed = 0.5 * weight * (1.0 + 0.2 * h / b);
    near(largest("corner_vertical_n").unwrap(), pressed);
    near(largest("corner_horizontal_n").unwrap(), 0.2 * pressed);
    for key in ["corner_vertical_n", "corner_horizontal_n"] {
        let corner = &forces[key]["corner"];
        near(corner["vertical_n"].as_f64().unwrap(), pressed);
        near(corner["horizontal_n"].as_f64().unwrap().abs(), 0.2 * pressed);
    }
    let rows: Vec<_> = forces.as_object().unwrap().values().map(|f| &f["together"]).collect();
    let rows: Vec<_> = rows.into_iter().filter(|row| row.is_object()).collect();
    assert!(rows.len() > 3, "{forces}");
    for row in rows {
        let of = |key: &str| row[key].as_f64().map(f64::abs);
        for (key, value) in row.as_object().unwrap() {
            if let Some(most) = largest(&key.replace("apex_moment_nm", "none")) {
                assert!(value.as_f64().unwrap().abs() <= most * (1.0 + 1e-9), "{key}: {row}");
            }
        }
        // a block's moment is its shear times the height of its mass; a leg's, of its own foot
        match of("apex_moment_nm") {
            None => near(of("column_base_moment_nm").unwrap(), h * of("column_shear_n").unwrap()),
            Some(moment) => {
                near(moment, (b - 0.2 * h).abs() * pressed);
                near(of("column_shear_n").unwrap(), moment / h.hypot(b));
                near(of("axial_n").unwrap(), pressed * (h + 0.2 * b) / h.hypot(b));
            }
        }
    }
    let own = largest("sole_shear_n").or(largest("column_shear_n")).unwrap();
    near(own, shear);
}

#[test]
fn what_acts_together_in_a_body_that_slides_is_what_statics_say() {
    let block = "[structure]\nkind = 'block'\ntotal_height_m = 0.9\nwidth_m = 0.28\n\
        mass_kg = 120.0\n[friction]\ncoefficient = 0.2\n[record]\nscale = 2.0\n\
        duration_s = 20.0\n";
    let (said, parameters, _) = run(block, "--no-front");
    its_forces_are_of_one_sliding_body(&parameters, 120.0 * GRAVITY, (0.45, 0.14));
    let words = "Housner's body overturns at t = 5.53 s; its numbers count up to then";
    assert!(said.split_whitespace().collect::<Vec<_>>().join(" ").contains(words), "{said}");
    let frame = "[structure]\nkind = 'aframe'\nheight_m = 6.0\nwidth_m = 3.0\n\
        mass_kg = 10e3\n[friction]\ncoefficient = 0.2\n[record]\nduration_s = 10.0\n";
    let (_, parameters, _) = run(frame, "--no-front");
    its_forces_are_of_one_sliding_body(&parameters, 1e4 * GRAVITY, (6.0, 1.5));
}

/// What a vertical component that is left out would change is told of the body as it is: of one
/// that slides its slip.
#[test]
fn a_vertical_motion_left_out_is_told_of_the_body_with_friction() {
    let file = program::TE_MARA;
    let case = format!(
        "[structure]\nkind = 'block'\ntotal_height_m = 0.82\nwidth_m = 0.369\nmass_kg = 120.0\n\
         [friction]\ncoefficient = 0.42\n[record]\nfile = {file:?}\nduration_s = 70.0\n\
         scale = 0.8\n"
    );
    let (_, without, _) = run(&case, "");
    let told = finding(&without, "vertical_left_out").unwrap();
    let changes = told["changes"].as_array().unwrap();
    let top = changes.iter().find(|change| change["quantity"] == "top displacement").unwrap();
    let (_, with, _) = run(&case, "--vertical auto");
    let taken = finding(&with, "slides").unwrap();
    for (found, of) in [("without", &without), ("with", &with)] {
        let due = of["peaks"]["with_members"]["top_displacement_m"].as_f64().unwrap();
        assert!((top[found].as_f64().unwrap() / due - 1.0).abs() < 1e-9, "{top} {due}");
    }
    let top = with["peaks"]["with_members"]["top_displacement_m"].as_f64().unwrap();
    assert!((taken["largest_m"].as_f64().unwrap() / top - 1.0).abs() < 1e-5, "{taken}");
}
