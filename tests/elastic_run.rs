//! `tune run` on elastic structures, as a program.

use parameters::elastic::ElasticParameters;

#[path = "support/program.rs"]
mod program;

use program::{TestFolder, finding};

const PIER: &str = include_str!("../tuning/pier.toml");

/// What is said of the pier on a record in g, at an accuracy that takes no time.
fn run_coarsely(folder: &TestFolder, record: &str) -> String {
    let run = format!("run pier.toml --record {record} --units g --accuracy 0.1");
    folder.runs(&format!("{run} --no-figures --no-report --quiet")).stdout
}

#[test]
fn a_pier_is_tuned_and_what_is_written_agrees_with_itself() {
    let folder = TestFolder::with(&[("pier.toml", PIER)]);
    // the ground offers less friction than the pier needs
    let said = folder.runs("run pier.toml --quiet --friction 0.05").stdout;
    assert!(said.contains("It rocks and stands") && said.contains("bending "), "{said}");
    let read = |name: &str| folder.text(&format!("out/{name}"));
    let parameters = folder.json("out/parameters.json");
    let sliding = finding(&parameters, "sliding").unwrap();
    assert!(
        sliding["needed"].as_f64().unwrap() > 0.05 && sliding["available"] == 0.05,
        "{sliding}"
    );
    let on = &parameters["on_record"];
    let assessment = &parameters["assessment"];
    assert_eq!(assessment["reached"], true, "{assessment}");
    assert!(
        assessment["measured"]["record"]["median"][0].as_f64().unwrap() <= 0.002,
        "{assessment}"
    );
    assert!(on["nrmse_rotation"].as_f64().unwrap() <= 0.002, "{on}");
    assert!(on["energy_residual"].as_f64().unwrap() < 1e-5, "{on}");
    assert_eq!(parameters["springs"].as_array().unwrap().len(), 2);
    // what rocking buys: less shear and a smaller moment at the column's base than held to the
    // ground
    for force in ["column_shear_n", "column_base_moment_nm", "axial_n"] {
        let force = &parameters["design_forces"][force];
        assert_eq!(force["holds"], true, "{force}");
    }
    for force in ["column_shear_n", "column_base_moment_nm"] {
        let force = &parameters["design_forces"][force];
        let share = (force["value"].as_f64().unwrap() / force["fixed"].as_f64().unwrap()).abs();
        assert!(share > 0.1 && share < 0.6, "{force}");
    }
    let peaks = &parameters["peaks"]["springs"];
    let number = |key: &str| peaks[key].as_f64().unwrap();
    assert!(number("rocking_m") > 5.0 * number("bending_m") && number("uplift_m") > 0.1, "{peaks}");
    // without what the feet have moved
    let part = |key: &str| peaks["then"][key].as_f64().unwrap();
    let without = part("rocking_m") + part("bending_m");
    assert!((number("drift_ratio") * 12.0 / without - 1.0).abs() < 1e-9, "{peaks}");
    let top = without + part("feet_moved_m");
    assert!((top / number("top_displacement_m") - 1.0).abs() < 1e-9, "{peaks}");
    members_are_whole(&read("members.csv"));
    let history = read("history.csv");
    assert_eq!(
        history.lines().next().unwrap(),
        "t,theta_reference,drift_reference,theta_fem,drift_fem,uplift_1,uplift_2,\
            foot_1_moved_reference,foot_1_moved_fem,top_reference,top_fem"
    );
    let top = |line: &str| line.rsplit(',').next().unwrap().parse::<f64>().unwrap().abs();
    let highest = history.lines().skip(1).map(top).fold(0.0, f64::max);
    assert!((highest / number("top_displacement_m") - 1.0).abs() < 1e-6, "{highest} {peaks}");
    assert_eq!(history.lines().count(), 2002);
    let page = read("report.html");
    assert!(page.contains("<h2>Forces to design with</h2>") && !page.contains("src=\"http"));
    decks_are_whole(&folder);
    for name in [
        "history.png",
        "history.svg",
        "forces.png",
        "forces.svg",
        "members.csv",
        "members_envelopes.csv",
        "parameters.md",
    ] {
        assert!(folder.bytes(&format!("out/{name}")).len() > 300, "{name}");
    }

    again_on_one_thread(&folder);
    refuses(&folder);
}

/// Forces at the same instants, from where the column stands in compression.
fn members_are_whole(members: &str) {
    assert!(
        members
            .lines()
            .next()
            .unwrap()
            .ends_with(",ground_vertical_n,ground_vertical_below_20_hz_n")
    );
    // at first the column stands in compression, under the mass
    let axial: f64 = members.lines().nth(1).unwrap().split(',').nth(2).unwrap().parse().unwrap();
    assert!((axial / (-600e3 * 9.81) - 1.0).abs() < 1e-6, "{axial}");
    // the base shear is what the ground gives all corners, the footing's inertia included
    let mut rows = members.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = rows.next().unwrap();
    let column = |name: &str| head.iter().position(|cell| *cell == name).unwrap();
    let shear = column("base_shear_n");
    let corners = [column("corner_1_horizontal_n"), column("corner_2_horizontal_n")];
    for row in rows {
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        let all: f64 = corners.into_iter().map(number).sum();
        assert!((number(shear) - all).abs() < 1e-6 * (1e6 + all.abs()), "{row:?}");
    }
}

/// The same bytes; without figures, none are left.
fn again_on_one_thread(folder: &TestFolder) {
    let before = folder.text("out/parameters.json");
    folder.runs("run pier.toml --quiet --friction 0.05 --jobs 1 --no-figures");
    assert_eq!(folder.text("out/parameters.json"), before);
    assert!(!folder.has("out/history.png"));
}

/// What is refused of an elastic structure.
fn refuses(folder: &TestFolder) {
    // a history needs two samples
    folder.write("one.txt", "1.0\n");
    for (line, said) in [
        ("run pier.toml --quiet --friction -0.3", "--friction"),
        // springs softer than any that could be judged
        ("run pier.toml --quiet --max-hz 0.5", "max_omega_hz (--max-hz) is 0.5"),
        ("run pier.toml --quiet --record one.txt --dt 0.01 --units g", "needs at least two"),
        // commands for rigid bodies say what this is
        ("housner --out out pier.toml", "pier.toml: this is an elastic structure"),
        ("simulate --parameters out/parameters.json", "elastic structure"),
    ] {
        let line = folder.refuses(line);
        assert!(line.contains(said), "{line}");
    }
}

/// Every deck of a run is there, without places left to fill in, and exported again the same.
fn decks_are_whole(folder: &TestFolder) {
    for (format, name, holds) in [
        ("openseespy", "model_openseespy.py", "\"flatSliderBearing\""),
        ("opensees-tcl", "model_opensees.tcl", "flatSliderBearing"),
        ("sap2000", "model_sap2000.s2k", "END TABLE DATA"),
        ("csv", "springs.csv", "corner 2"),
    ] {
        let deck = folder.text(&format!("out/decks/{name}"));
        assert!(deck.contains(holds) && !deck.contains('@'), "{name}");
        let export = "export --parameters out/parameters.json --out again --format";
        folder.runs(&format!("{export} {format}"));
        assert_eq!(folder.text("again"), deck, "{format}");
    }
    assert_eq!(folder.text("out/decks/springs.csv").lines().count(), 1 + 2 * 2);
    // what someone who types the model needs
    let parameters = folder.text("out/parameters.json");
    let parameters = ElasticParameters::parse("parameters.json", &parameters).unwrap();
    let ei = parameters.column.unwrap().ei_nm2;
    let table = folder.text("out/decks/springs_even.md");
    for holds in [
        "| corner 1 | -2 | vertical |",
        "halved, down to 1/16 of it",
        "an unbalance below ",
        "m2 has no weight",
        "with another kind (Rayleigh, or one coefficient for both) they differ",
        &format!("| {ei:.16e} |"),
    ] {
        assert!(table.contains(holds), "{holds}: {table}");
    }
    let csv = folder.text("out/decks/springs_even.csv");
    assert!(csv.starts_with("foot,x_m,direction,") && csv.contains("corner 2,2,horizontal,"));
    assert!(
        csv.lines()
            .next()
            .unwrap()
            .ends_with(",substeps,newton_iterations,tolerance,tolerance_is_of")
    );
}

#[test]
fn what_cannot_be_is_refused_in_one_line_before_anything_is_written() {
    for (from, to, said) in [
        ("mass_kg = 600e3", "mass_kg = -600e3", "mass_kg"),
        ("frequency_hz", "frequenzy_hz", "did you mean \"frequency_hz\""),
        ("footing_mass_kg = 60e3\n", "", "footing_mass_kg"),
        ("kind = \"pier\"", "kind = \"tower\"", "pier"),
        ("[record]", "[damper]\nc_ns_per_m = -1.0\n[record]", "damper.c_ns_per_m is -1"),
        ("[record]", "[damper]\nc = 1.0\n[record]", "did you mean \"c_ns_per_m\""),
        ("[record]", "[tendon]\nstiffness_n_per_m = 1e8\n[record]", "pretension_n"),
        (
            "[record]",
            "[tendon]\nstiffness_n_per_m = 0.0\npretension_n = 1.0\n[record]",
            "stiffness_n_per_m is 0",
        ),
        ("[record]", "[tendon]\nstiffness_n_per_m = 1e9\npretension_n = 4e9\n[record]", "tendon"),
        ("[record]", "[friction]\ncoefficient = 0.5\n[record]", "rigid bodies only"),
    ] {
        assert!(PIER.contains(from), "{from}");
        let folder = TestFolder::with(&[("case.toml", &PIER.replace(from, to))]);
        let line = folder.refuses("run case.toml --quiet");
        assert!(line.contains(said) && !folder.has("out"), "{to}: {line}");
    }
}

/// A history that ends early is said, and filed so that it can be read.
#[test]
fn a_pier_that_overturns_is_told_to() {
    // three times what lifts it, for two seconds
    let pulse: String =
        (0..600).map(|i| if (100..300).contains(&i) { "0.54\n" } else { "0.0\n" }).collect();
    let pulse = format!("# dt = 0.01\n{pulse}");
    let folder = TestFolder::with(&[("pier.toml", PIER), ("pulse.txt", &pulse)]);
    let said = run_coarsely(&folder, "pulse.txt");
    assert!(
        said.contains("The structure overturns at t = ") && said.contains("(in the reference at "),
        "{said}"
    );
    let json = folder.text("out/parameters.json");
    let parameters = ElasticParameters::parse("parameters.json", &json).unwrap();
    assert!(!parameters.on_record.unwrap().whole);
    // the program's steps see it fall, too, after the push and before its end
    let program = parameters.program.unwrap().on_record.unwrap();
    let falls = program.falls_s.unwrap();
    assert!(falls > 1.0 && falls < 5.99 && program.gives_up_s.is_none(), "{program:?}");
    assert!(said.contains("it overturns in these steps at "), "{said}");
    // both models' histories to their ends, cells of the one that ends before are empty
    let history = folder.text("out/history.csv");
    let columns: Vec<Vec<&str>> =
        history.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let given = |k: usize| columns.iter().filter(|row| !row[k].is_empty()).count();
    assert_eq!(given(1).max(given(3)), columns.len());
    assert!(given(1) < 600 && given(3) < 600 && given(5) == given(3), "{} {}", given(1), given(3));
}

/// Without a motion there are no landings to speak of, and no errors of rounding over rounding.
#[test]
fn of_a_record_without_a_motion_no_landing_and_no_error_is_said() {
    let still = "# dt = 0.01\n".to_string() + &"0.0\n".repeat(20);
    let folder = TestFolder::with(&[("pier.toml", PIER), ("still.txt", &still)]);
    let said = run_coarsely(&folder, "still.txt");
    assert!(said.contains("The record does not lift the structure"), "{said}");
    assert!(!said.contains("on this record"), "{said}");
}

/// Below uplift the rotation that rigid ground allows is none, and nothing is relative to it.
#[test]
fn a_record_that_does_not_lift_a_pier_has_no_error_of_its_rotation() {
    let weak = |i: i32| format!("{}\n", 0.01 * f64::from(i).sin());
    let weak = "# dt = 0.01\n".to_string() + &(0..200).map(weak).collect::<String>();
    let folder = TestFolder::with(&[("pier.toml", PIER), ("weak.txt", &weak)]);
    let said = run_coarsely(&folder, "weak.txt");
    assert!(said.contains("The record does not lift the structure"), "{said}");
    let program = folder.json("out/parameters.json")["program"].clone();
    assert!(program["on_record"]["top"].is_number(), "{program}");
    assert!(program["on_record"]["nrmse"].is_null(), "{program}");
}

/// A portal with all that takes lines: a vertical motion, doubts, forces, a search that was cut.
#[test]
fn a_crowded_screen_has_thirty_lines_at_most() {
    let record = program::TE_MARA;
    let case = format!(
        "[structure]\nkind = 'frame'\nheight_m = 11.25\nspan_m = 13.25\nfooting_width_m = 3.25\n\
        footing_height_m = 1.25\nfooting_mass_kg = 40\nbeam_mass_kg = 300e3\ncolumn_ea_n = 4e10\n\
        column_ei_nm2 = 6e9\nbeam_ea_n = 5e10\nbeam_ei_nm2 = 9e9\ndamping_ratio = 0.03\n\
        [record]\nfile = '{record}'\nvertical = 'auto'\nscale = -0.55\nduration_s = 200\n"
    );
    let folder = TestFolder::with(&[("case.toml", &case)]);
    let screen = folder.runs("run case.toml --quiet --no-figures --time-limit 1").stdout;
    assert!(screen.lines().count() <= 30, "{screen}");
    assert!(screen.lines().all(|line| line.chars().count() <= 100), "{screen}");
    assert_eq!(screen.lines().filter(|line| line.starts_with("CHECK ")).count(), 3, "{screen}");
    assert!(screen.lines().last().is_some_and(|line| line.starts_with("report ")), "{screen}");
}

/// Springs that are of no use in a program's steps: the screen names no deck of them, and
/// `tune export` says what they are.
#[test]
fn a_deck_of_refused_springs_is_not_offered() {
    let block = "[structure]\nkind = 'block'\ntotal_height_m = 2.0\nwidth_m = 0.5\n\
                 mass_kg = 500.0\n";
    let folder = TestFolder::with(&[("block.toml", block)]);
    let run = "run block.toml --quiet --no-figures --no-report --no-front --duration 4";
    let export = "export --parameters out/parameters.json --format openseespy --stepping even \
                  --out even.py";
    for (step, refused) in [("0.02", true), ("0.001", false)] {
        let said = folder.runs(&format!("{run} --step {step} --integrator trbdf2")).stdout;
        assert_eq!(said.contains("NOT to be used: "), refused, "{said}");
        assert_eq!(said.contains("its deck"), !refused, "{said}");
        let told = folder.runs(export).stderr;
        let line = "the springs of this deck are NOT to be used: ";
        assert_eq!(told.contains(line), refused, "{told}");
    }
}
