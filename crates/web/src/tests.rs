//! The functions of the page, natively.

use super::*;
use serde_json::Value;

const FRAME: &str = "[structure]\nkind = \"aframe\"\nheight_m = 61.0\nwidth_m = 12.2\n\
    mass_kg = 680.1e3\n[record]\nduration_s = 20.0\n";
const PIER: &str = "[structure]\nkind = \"pier\"\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
    footing_mass_kg = 60e3\nfooting_height_m = 1.5\nfrequency_hz = 2.0\ndamping_ratio = 0.02\n\
    [record]\nduration_s = 20.0\n";

/// A portal frame on two footings that slide apart as it rocks.
const PORTAL: &str = "[structure]\nkind = 'frame'\nheight_m = 9.0\nspan_m = 8.0\n\
    footing_width_m = 2.0\nfooting_height_m = 1.0\nfooting_mass_kg = 30e3\nbeam_mass_kg = 400e3\n\
    column_ea_n = 3e10\ncolumn_ei_nm2 = 2e9\nbeam_ea_n = 3e10\nbeam_ei_nm2 = 4e9\n\
    damping_ratio = 0.03\n[record]\nduration_s = 8.0\n";

fn parsed(answer: JsonOrLine) -> Value {
    serde_json::from_str(&answer.unwrap()).unwrap()
}

#[test]
fn a_frame_is_answered_at_once() {
    let answer = parsed(at_once(FRAME, 0.5));
    // the paper: lifts at 0.1 g
    assert!((answer["working"]["uplift_g"].as_f64().unwrap() - 0.1).abs() < 1e-15);
    let peaks = &answer["peaks"];
    let top = |model: &str| peaks[model]["top_displacement_m"].as_f64().unwrap();
    assert!((top("springs") / top("reference") - 1.0).abs() < 1e-2, "{peaks}");
    assert!(
        answer["verdict"].as_str().unwrap().contains("rocks and stands"),
        "{}",
        answer["verdict"]
    );
    // how far it can be foretold the run finds, whose springs may be others
    assert!(!answer["verdict"].as_str().unwrap().contains("predictable"), "{}", answer["verdict"]);
}

#[test]
fn of_a_table_the_page_is_told_the_columns_and_takes_one() {
    let rows = "0.000,0.0,0.0,0.0\n0.010,-0.1,-0.2,0.1\n0.020,0.3,0.4,-0.2\n0.030,0.0,0.0,0.0\n";
    give_file("three.csv", format!("time (s),H1 (g),H2 (g),V (g)\n{rows}").as_bytes());
    let case = |more: &str| {
        let structure = FRAME.split("[record]").next().unwrap_or_default();
        read_record(&format!("{structure}[record]\nfile = \"three.csv\"\n{more}"))
    };
    // the page makes its list of these words
    let told = "three.csv, line 2: 4 columns; choose the acceleration with --column, a number or a \
        name (column 2 (H1 (g)), column 3 (H2 (g)), column 4 (V (g)); in a case file column in \
        [record])";
    let line = case("").unwrap_err();
    assert!(line.contains(told), "{line}");
    let taken = parsed(case("component = \"column 3\"\n"));
    assert!((taken["pga_g"].as_f64().unwrap() - 0.4).abs() < 1e-12, "{taken}");
}

#[test]
fn a_pier_is_answered_at_once() {
    let answer = parsed(at_once(PIER, 0.5));
    let peaks = &answer["peaks"];
    // README's table, from the whole run: 386 mm at the top, 16.8 mm by bending
    let of = |what: &str| peaks["springs"][what].as_f64().unwrap();
    assert!((of("top_displacement_m") / 0.386 - 1.0).abs() < 2e-2, "{peaks}");
    assert!((of("bending_m") / 0.0168 - 1.0).abs() < 5e-2, "{peaks}");
    assert_eq!(answer["history"]["springs"]["bases"].as_array().unwrap().len(), 1);
}

/// Peaks at once are those of the whole run by definition: the top's parts are one sum, and the
/// drift ratio leaves out what the feet move.
#[test]
fn peaks_at_once_are_defined_as_those_of_a_run() {
    for case in [PIER, PORTAL] {
        let answer = parsed(at_once(case, 0.5));
        let springs = &answer["peaks"]["springs"];
        let of = |row: &Value, what: &str| row[what].as_f64().unwrap_or(f64::NAN);
        let top = of(springs, "top_displacement_m");
        let parts =
            ["rocking_m", "bending_m", "feet_moved_m"].map(|what| of(&springs["then"], what));
        assert!((parts.iter().sum::<f64>() / top - 1.0).abs() < 1e-9, "{springs}");
        let height = if case == PIER { 12.0 } else { 9.0 };
        let (rocks, moved) = (of(springs, "drift_ratio") * height, of(springs, "feet_moved_m"));
        assert!(moved > 0.0 && (rocks - top).abs() <= moved * (1.0 + 1e-9), "{springs}");
        assert!(rocks >= parts[0] + parts[1] - 1e-12, "{springs}");
    }
    let said = parsed(at_once(PORTAL, 0.5))["findings"][0]["message"].to_string();
    assert!(said.contains("of columns "), "{said}");
}

/// (1 + T/W) b/h, T a tendon's tension and W the weight: (1 + 4000/(400 9.81)) 0.25.
#[test]
fn a_tendon_holds_a_body_down() {
    let block = "[structure]\nkind = 'block'\ntotal_height_m = 2.0\nwidth_m = 0.5\nmass_kg = 400\n\
                 [tendon]\nstiffness_n_per_m = 1e5\npretension_n = 4000.0\n";
    let answer = parsed(at_once(block, 0.5));
    let uplift_g = answer["working"]["uplift_g"].as_f64().unwrap();
    assert!((uplift_g - 0.25 * (1.0 + 4000.0 / (400.0 * 9.81))).abs() < 1e-12, "{uplift_g}");
}

#[test]
fn what_a_page_cannot_do_is_refused_in_one_line() {
    let said = |more: &str| at_once(&format!("{FRAME}[tuning]\n{more}\n"), 0.5).unwrap_err();
    for more in ["objective = \"arr\"", "max_omega_hz = 160.0"] {
        let line = said(more);
        assert!(line.starts_with("case.toml: tuning.") && !line.contains('\n'), "{line}");
    }
}

/// Steady ground of g b/h pushes a body over as soon as it lifts it: within 1 % of that a change of
/// 1 % decides, further away none does. That a history is sensitive is no chance of falling.
#[test]
fn by_chance_is_where_small_changes_decide_on_overturning() {
    give_file("push.txt", "0.25\n".repeat(3000).as_bytes());
    let chance = |scale: f64| {
        let case = format!(
            "[structure]\nkind = \"block\"\ntotal_height_m = 2.0\nwidth_m = 0.5\n\
                mass_kg = 100.0\n\
                [record]\nfile = \"push.txt\"\ndt_s = 0.01\nunits = \"g\"\nscale = {scale}\n"
        );
        let answer = parsed(at_once(&case, 0.5));
        (answer["does"].as_str().unwrap().to_string(), answer["by_chance"].as_bool().unwrap())
    };
    assert_eq!(chance(1.004), ("overturns".into(), true));
    assert_eq!(chance(1.1), ("overturns".into(), false));
    assert_eq!(chance(0.9), ("stays_down".into(), false));
    forget_file("push.txt");
    // the page's first block: 4 % of overturning, and a history that nothing foretells
    let block = "[structure]\nkind = \"block\"\ntotal_height_m = 1.9\nwidth_m = 0.5\n\
        mass_kg = 250.0\n[record]\nscale = 1.0\n";
    let answer = parsed(at_once(block, 0.5));
    let sensitive = |f: &Value| f["finding"] == "ill_conditioned";
    assert!(answer["findings"].as_array().unwrap().iter().any(sensitive), "{answer}");
    assert_eq!(answer["by_chance"], false);
}

/// What is there at once and what the run says later are the same quantities, on other springs.
#[test]
fn peaks_of_a_pier_do_not_jump_when_its_run_ends() {
    let [at_once, run] = [parsed(at_once(PIER, 0.5)), parsed(tune(PIER, 0.5))["said"].take()];
    let of = |from: &Value, key: &str| from["peaks"]["springs"][key].as_f64().unwrap();
    for key in ["top_displacement_m", "rocking_m", "bending_m", "uplift_m", "drift_ratio"] {
        let (first, last) = (of(&at_once, key), of(&run, key));
        assert!((first / last - 1.0).abs() < 0.05, "{key}: {first} {last}");
    }
    let moved = of(&at_once, "feet_moved_m") - of(&run, "feet_moved_m");
    assert!(moved.abs() < 0.01 * of(&run, "top_displacement_m"), "{moved}");
}

#[test]
fn a_pulse_is_a_record_with_its_amplitude() {
    let text = pulse(0.7, 1.2).unwrap();
    give_file("pulse test.txt", text.as_bytes());
    let record = format!("file = \"pulse test.txt\"\ndt_s = {}\nunits = \"g\"\n", pulse_step(1.2));
    let case = format!(
        "[structure]\nkind = \"block\"\ntotal_height_m = 1.9\nwidth_m = 0.6\nmass_kg = 200.0\n\
            [record]\n{record}"
    );
    let answer = parsed(read_record(&case));
    assert!((answer["pga_g"].as_f64().unwrap() - 0.7).abs() < 1e-3, "{answer}");
    forget_file("pulse test.txt");
    assert!(read_record(&case).is_err());
    assert!(pulse(0.0, 1.0).unwrap_err().contains("amplitude is 0.0; give 0.001 to 10 g"));
}

/// A wider body rocks less; the body itself is the case's.
#[test]
fn variations_are_bodies_on_the_record() {
    let answer = parsed(variations(
        FRAME,
        r#"[{}, {"scale": 1.0}, {"alpha": 0.5}, {"scale": 50.0, "alpha": 0.05}]"#,
    ));
    assert_eq!(answer[0], answer[1]);
    let own = parsed(at_once(FRAME, 0.5))["share_of_overturning"].as_f64().unwrap();
    assert!((answer[0].as_f64().unwrap() / own - 1.0).abs() < 1e-2);
    assert_eq!((answer[2].as_f64(), answer[3].is_null()), (Some(0.0), true));
}

/// Steady ground pushes a body over as soon as it lifts it, at g tan(alpha): nothing brings it
/// back. A block of 2 m by 0.5 m lifts at g/4; ground of 0.2 g does that 1.25 times as strong.
#[test]
fn the_weakest_motion_and_the_widest_body_that_fall_are_found() {
    give_file("steady.txt", "0.2\n".repeat(3000).as_bytes());
    let case = "[structure]\nkind = \"block\"\ntotal_height_m = 2.0\nwidth_m = 0.5\n\
        mass_kg = 100.0\n[record]\nfile = \"steady.txt\"\ndt_s = 0.01\nunits = \"g\"\n";
    let share = |ends: &str| parsed(first_fall(case, ends)).as_f64().unwrap();
    let scale = 1.2 + 0.1 * share(r#"[{"scale": 1.2}, {"scale": 1.3}]"#);
    assert!(scale > 1.25 && scale < 1.25 + 0.1 / 4000.0, "{scale}");
    // tan(alpha) = 0.2, at whatever radius
    let alpha = 0.3 - 0.2 * share(r#"[{"alpha": 0.3}, {"alpha": 0.1}]"#);
    let closed = 0.2_f64.atan();
    assert!(alpha < closed && alpha > closed - 0.2 / 4000.0, "{alpha}");
    // both directions give the first that falls, seen from the one that stands
    assert_eq!(share(r#"[{"scale": 1.0}, {"scale": 1.25001}]"#), 1.0);
    forget_file("steady.txt");
    assert!(first_fall(FRAME, "[{}]").unwrap_err().contains("list of variations"));
}

#[test]
fn springs_for_a_program_are_in_closed_form_at_once() {
    let case = format!("{FRAME}[program]\nstep_s = 0.001\nintegrator = \"trbdf2\"\n");
    let answer = parsed(fixed_step(&case));
    let [k1, k2] =
        ["k1_n_per_m", "k2_n_per_m"].map(|key| answer["springs"][0][key].as_f64().unwrap());
    // k1 K/(1 + K) = 10 m p/(alpha^2 dt) and 20 alpha^3 (1.7 K)^2 = 3/4 13 p dt of the frame
    let alpha = 0.1_f64.atan();
    let p_dt = (9.81 / 61.0_f64.hypot(6.1)).sqrt() * 1e-3;
    let in_series = 10.0 * 680.1e3 * p_dt / (alpha * alpha * 1e-6);
    assert!((k1 * k2 / (k1 + k2) / in_series - 1.0).abs() < 1e-4, "{answer}");
    let k = (0.75 * 13.0 * p_dt / (20.0 * alpha.powi(3))).sqrt() / 1.7;
    assert!((k2 / k1 / k - 1.0).abs() < 1e-4, "{answer}");
    assert_eq!(answer["integrator"], "TRBDF2");
    assert!(fixed_step(PIER).unwrap_err().contains("whole run"));
    let wrong = format!("{FRAME}[program]\nstep_s = 0.0\n");
    assert!(fixed_step(&wrong).unwrap_err().contains("program.step_s is 0.0"));
}

/// The whole run has the program's springs, measured, and files for its steps.
#[test]
fn a_run_is_for_the_program_of_the_case() {
    let frame = "[structure]\nkind = \"aframe\"\nheight_m = 28.0\nwidth_m = 6.0\n\
        mass_kg = 1834862.0\n[program]\nfor = \"sap2000\"\nstep_s = 0.005\n";
    let first = parsed(fixed_step(frame));
    let answer = parsed(tune(frame, 0.5));
    let k1 = |from: &Value| from["springs"][0]["k1_n_per_m"].as_f64().unwrap();
    let program = &answer["program"];
    // the run takes a softer stance than the closed form's: 5 in place of 10
    assert!((k1(program) / k1(&first) - 5.0 / 10.0).abs() < 1e-9, "{program}");
    let errors = program["errors"].as_str().unwrap();
    assert!(errors.contains("16 earthquake-like motions"), "{errors}");
    // as on the screen, in the sheet and in parameters.json
    let screen = answer["screen"].as_str().unwrap();
    assert!(screen.contains("SAP2000, 5 ms: vertical"), "{screen}");
    let sheet = run_file("decks/sap2000_by_hand.txt");
    assert!(sheet.contains("0.005"), "{sheet}");
    let filed: Value = serde_json::from_str(&run_file("parameters.json")).unwrap();
    assert_eq!(filed["program"]["vertical"]["k1_n_per_m"].as_f64(), Some(k1(program)));
    assert_eq!(filed["program"]["asked"], true);
}
