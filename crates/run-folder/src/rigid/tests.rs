//! The page of runs that go each their own way: what it says, its size, and that it asks for
//! nothing from elsewhere.

use cases::Case;
use report::screen::{Written, screen};
use results::{Finding, ProgramAdvice, Weight};
use rocking::motion::largest_magnitude;
use springs::job::Job;
use strong_motion::Record;
use strong_motion::excitation::Excitation;

use super::*;

const BLOCK: &str =
    "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 1000.0\n";
const FRAME: &str =
    "[structure]\nkind = \"aframe\"\nheight_m = 61.0\nwidth_m = 12.2\nmass_kg = 680.1e3\n";

/// A run of a short stretch of El Centro.
fn run(scale: f64, toml: Option<&str>) -> RigidRun {
    run_within((160.0, 0.1), scale, toml)
}

/// Up to some Omega_n/2 pi (Hz), to some accuracy.
fn run_within((most_hz, accuracy): (f64, f64), scale: f64, toml: Option<&str>) -> RigidRun {
    let mut case =
        toml.map_or_else(Case::paper, |text| Case::parse("tuning/test.toml", text)).unwrap();
    let excitation =
        Excitation { scale, duration_s: Some(8.0), ..Excitation::whole(Record::el_centro()) };
    case.set_excitation(excitation).unwrap();
    case.tuning.max_omega_hz = Some(most_hz);
    case.tuning.accuracy = accuracy;
    let job = Job::new(&case, &|_, _, _| {}).unwrap();
    RigidRun::new(case, job, Vec::new(), 0.5)
}

fn screen_of(said: &Run, folder: &str) -> String {
    screen(said, &Written { folder, report: true, decks: true, left_out: &[] })
}

fn page_of(run: &RigidRun, figures: bool) -> String {
    let RigidRun { case, job, front, both, .. } = run;
    let figures =
        if figures { Pictures { case, job, both, front }.draw().unwrap() } else { Vec::new() };
    let figures: Vec<Drawing> = figures.iter().map(drawing).collect();
    let page = super::page(&run.said(run.parameters.clone()), &figures);
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    // names of vocabularies are no addresses to be asked
    let asked = page.replace("http://www.w3.org/2000/svg", "");
    for what in ["http:", "https:", "//cdn", "src=", "@import", "url("] {
        assert!(!asked.contains(what), "the page names {what}");
    }
    for section in ["case", "peaks", "forces", "springs", "accuracy", "opensees", "cite"] {
        assert!(page.contains(&format!("<section id=\"{section}\">")), "{section}");
    }
    page
}

#[test]
fn the_page_of_a_frame_that_rocks_has_everything() {
    let run = run(1.0, None);
    let page = page_of(&run, true);
    assert!(page.contains("It rocks and stands: largest rotation "), "{page}");
    assert_eq!(page.matches("<figure ").count(), 5);
    assert_eq!(page.matches(" class=\"live\"").count(), 3);
    assert!(
        page.contains("A-frame 61 m high, feet 12.2 m apart")
            && page.contains("frequency ratio f")
            && page.contains("NRMSE")
    );
    assert_eq!(page, page_of(&run, true));
}

/// Without the marks that keep numbers and units together.
fn words_of(page: &str) -> String {
    page.replace("<span class=\"q\">", "").replace("</span>", "")
}

#[test]
fn a_frame_that_never_lifts_is_said_to_stand() {
    let page = page_of(&run(0.1, None), true);
    assert!(page.contains("The record does not lift the structure"));
    let words = words_of(&page);
    assert!(words.contains("its peak is 0.03129 g, uplift takes 0.1 g"), "{words}");
    // numbers of figures are in base 64, where three letters may be any
    let read = page.split("<script").map(|part| part.rsplit("</script>").next().unwrap_or(part));
    assert!(read.into_iter().all(|part| !part.contains("NaN")));
}

#[test]
fn a_block_that_overturns_is_said_to_and_marked() {
    let page = words_of(&page_of(&run(2.5, Some(BLOCK)), true));
    assert!(page.contains("The structure overturns at t = 4.4"));
    assert!(page.contains("overturned at t = 4.4"));
}

/// An overturning that comes later than a motion can be predicted is not told as certain.
#[test]
fn an_overturning_that_cannot_be_predicted_is_told_as_chance() {
    let run = run(2.5, Some(BLOCK));
    let mut said = run.said(run.parameters.clone());
    assert!(!said.verdict().contains("by chance"), "{}", said.verdict());
    let sensitive = Finding::IllConditioned {
        moved_by_width: 1.0,
        moved_by_scale: 1.0,
        moved_by_restitution: None,
        holds_to_s: Some(3.0),
        springs_judged: false,
    };
    let own = said.findings.iter().map(|filed| filed.finding.clone());
    said.findings = report::filed(own.chain([sensitive]));
    assert_eq!(said.findings[0].remedy.as_deref(), Some("judge by many: tune init sweep"));
    let verdict = said.verdict();
    assert!(verdict.contains(", by chance: a motion hardly different may leave"), "{verdict}");
    assert!(verdict.contains("; predictable to 3 s"), "{verdict}");
}

#[test]
fn a_page_without_figures_is_whole() {
    let page = page_of(&run(1.0, None), false);
    assert!(!page.contains("<figure") && !page.contains("id=\"figures\""));
    assert!(page.contains("<div class=\"tiles\">") && page.contains("id=\"verdict\""));
}

/// The paper's frame, for a program with steps of this size (s).
fn run_for(program: &str, step_s: f64) -> RigidRun {
    run(1.0, Some(&format!("{FRAME}[program]\nfor = \"{program}\"\nstep_s = {step_s:?}\n")))
}

/// What a program's springs err on the record is told up to the time that is printed beside it,
/// whatever ends what can be foretold.
#[test]
fn errors_of_a_program_are_of_the_time_that_is_told() {
    let block = "[structure]\nkind = \"block\"\ntotal_height_m = 5.0\nwidth_m = 1.0\n\
                 mass_kg = 9e3\n";
    let run = run(1.2, Some(block));
    let until = predictable_to(&run.parameters.findings).unwrap();
    assert!(until < 7.0, "{until}");
    let samples = (until / run.job.record.dt).round() as usize + 1;
    let largest = |u: &[f64]| largest_magnitude(&u[..samples]);
    let [steps, housner] =
        [&run.of_steps.as_ref().unwrap().motion.u, &run.both.rocking.motion(&run.job.body).u]
            .map(|u| largest(u));
    let on = run.parameters.program.as_ref().unwrap().on_record.unwrap();
    assert!((on.top.unwrap() - (steps / housner - 1.0)).abs() < 1e-3, "{on:?} {steps} {housner}");
    let forces = run.parameters.design_forces.unwrap();
    for (name, force) in forces.all() {
        assert_eq!(force.predictable, Some(force.time_s <= until), "{name:?} {force:?}");
    }
}

/// A program's decks, what the screen says of them, and Housner's numbers in the sheet.
#[test]
fn a_program_that_is_asked_for_has_its_sheet() {
    for (name, sheet, other, says) in [
        ("SAP2000", "sap2000_by_hand.txt", "etabs_by_hand.txt", "; type it from"),
        ("ETABS", "etabs_by_hand.txt", "sap2000_by_hand.txt", "; ETABS: to be typed"),
    ] {
        let run = run_for(name, 1e-3);
        let texts = texts(&run, Path::new("out")).unwrap();
        let find = |of: &str| texts.files.iter().find(|(file, _)| file == &format!("decks/{of}"));
        assert!(find(other).is_none());
        assert_eq!(find("model_sap2000.s2k").is_some(), name == "SAP2000");
        let (_, sheet_text) = find(sheet).unwrap();
        // the tables of its springs, beside those for steps that follow touches
        let k1 = run.parameters.program.as_ref().unwrap().units.vertical.k1_n_per_m;
        let holds = |table: &str| find(table).unwrap().1.matches(&format!("{k1:.16e}")).count();
        assert_eq!(["springs_even.csv", "springs_even.md", "springs.csv"].map(holds), [2, 2, 0]);
        assert!(find("springs_even.csv").unwrap().1.contains(",1 ms by hht:-0.333"));
        // El Centro begins at -0.063 m/s2, its function at 0
        let (_, motion) = find("ground_motion.txt").unwrap();
        let begin: Vec<&str> = motion.lines().take(2).collect();
        assert!(begin[0] == "0.000000000e0 0.000000000e0", "{begin:?}");
        assert!(begin[1].starts_with("1.000000000e-5 -6.28"), "{begin:?}");
        assert!(sheet_text.contains("it begins at 0, for the"), "{sheet_text}");
        let said = run.said(filed(&run, Path::new("out")));
        let text = screen_of(&said, "out");
        let last = text.lines().last().unwrap();
        assert!(last.contains(says) && last.ends_with(&format!("out/decks/{sheet}")), "{last}");
        // its springs first, and nothing of its lines cut
        let place = |what: &str| text.find(what).unwrap();
        assert!(place(", 1 ms: vertical") < place("OpenSees deck only: vertical"), "{text}");
        let lines = text.lines().skip_while(|line| !line.starts_with(name));
        let of_program: Vec<_> = lines.map(str::trim).collect();
        let of_program = of_program.join(" ");
        assert!(!of_program.contains("..."), "{text}");
        // all that the form of the load case asks for
        for what in [
            "HHT alpha -1/3",
            "output 800 x 0.01 s",
            "substeps max 0.001, min 6.25e-5 s",
            "constant-stiffness 0, Newton 40",
            "no event stepping; no line search",
            "P-Delta plus large displacements",
            "case damping 0; accel U1 x 1: ground_motion.txt",
            "from GRAVITY",
        ] {
            assert!(of_program.contains(what), "{what}: {text}");
        }
        // the joint of the sheet does in Housner's history what the run found
        let line = sheet_text.lines().find(|line| line.contains("   Housner: ")).unwrap();
        let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        let u = &run.both.housner.u;
        let extremes =
            [u.iter().copied().fold(0.0, f64::min), u.iter().copied().fold(0.0, f64::max)];
        for (told, found) in numbers.iter().zip(extremes) {
            assert!((told - 1e3 * found).abs() < 0.1 + 1e-3 * told.abs(), "{line}: {extremes:?}");
        }
    }
}

/// Springs for an integrator that SAP2000 has not come in decks for OpenSees, and in no tables.
#[test]
fn springs_for_another_integrator_are_in_decks_that_have_it() {
    let run = run(1.0, Some(&format!("{FRAME}[program]\nintegrator = \"trbdf2\"\n")));
    let texts = texts(&run, Path::new("out")).unwrap();
    let find = |of: &str| texts.files.iter().find(|(file, _)| file == of).map(|(_, text)| text);
    let deck = find("decks/model_even.py").unwrap();
    let k1 = run.parameters.program.as_ref().unwrap().units.vertical.k1_n_per_m;
    let mut numbers = deck.split(['=', ' ', ',', '\n']).filter_map(|word| word.parse::<f64>().ok());
    assert!(
        deck.contains("TRBDF2") && numbers.any(|x| (x / k1 - 1.0).abs() < 1e-9),
        "{k1}: {deck}"
    );
    for tables in ["decks/model_sap2000.s2k", "decks/sap2000_by_hand.txt"] {
        assert!(find(tables).is_none(), "{tables}");
    }
    let page = find("report.html").unwrap();
    assert!(page.contains("model_even.py") && !page.contains("model_sap2000"), "{page}");
}

/// A step that is far too long is told in the findings, with the number, and no sheet is offered.
#[test]
fn a_step_that_is_too_long_is_not_to_be_used() {
    let run = run_for("SAP2000", 0.05);
    let row = run.parameters.program.as_ref().unwrap();
    let on_record = row.on_record.unwrap();
    assert_eq!(on_record.predictable, Some(true));
    let expected = row.not_to_be_used().unwrap();
    let told = run.parameters.findings.iter().find_map(|filed| match &filed.finding {
        Finding::ProgramNotToBeUsed { fault, advice, .. } => Some((filed.weight, *fault, *advice)),
        _ => None,
    });
    assert_eq!(told, Some((Weight::Warning, expected.fault, expected.advice)));
    assert!(matches!(expected.advice, ProgramAdvice::Step { step_s } if step_s <= 0.01));
    let said = run.said(filed(&run, Path::new("out")));
    let text = screen_of(&said, "out");
    assert!(!text.contains("_by_hand"), "{text}");
}

/// Digits of a number, without zeros before the first and after the last.
fn digits(word: &str) -> usize {
    let number = word.trim_matches(|c: char| !c.is_ascii_digit() && c != '-');
    let mantissa = number.split(['e', 'E']).next().unwrap_or_default();
    if mantissa.parse::<f64>().is_err() {
        return 0;
    }
    let all: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    all.trim_start_matches('0').trim_end_matches('0').len()
}

/// A screen holds what it must, in its lines, letters and digits.
fn check_screen(run: &RigidRun, folder: &str) -> String {
    let said = run.said(run.parameters.clone());
    let text = screen_of(&said, folder);
    assert!(text.lines().count() <= 30, "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    for line in text.lines().filter(|line| !line.contains('/') && !line.starts_with("record ")) {
        assert!(line.split_whitespace().all(|word| digits(word) <= 4), "{line}");
    }
    for what in [
        "lifts beyond ",
        "assumed: ",
        "top displacement",
        "uplift",
        "design forces",
        "not soil",
        "accuracy",
        "SAP2000",
        "foot - k1 (gap) - m2 - k2 and c - ground",
    ] {
        assert!(text.contains(what), "{what}: {text}");
    }
    text
}

#[test]
fn a_screen_has_thirty_lines_of_a_hundred_letters_whatever_the_run() {
    let long = "a/very/long/way/to/a/folder/whose/name/nobody/can/read/at/once/".repeat(3);
    for (run, says) in [
        (run(1.0, None), "It rocks and stands"),
        (run(0.1, None), "The record does not lift the structure"),
        (run(2.5, Some(BLOCK)), "The structure overturns at t = 4.4"),
    ] {
        assert!(check_screen(&run, "out").contains(says));
        check_screen(&run, &long);
    }
}

/// A wall whose tendon keeps it down while Housner's body without it rocks: the answer, what lifts
/// it and the friction needed are those of the wall with its tendon; no springs for steps of one
/// size are offered, which `tune export` would refuse.
#[test]
fn a_wall_with_a_tendon_is_answered_with_its_tendon() {
    let wall = "[structure]\nkind = \"block\"\ntotal_height_m = 9.0\nwidth_m = 6.0\n\
                weight_kn = 2500.0\n[tendon]\nstiffness_n_per_m = 1.5e7\npretension_n = 1.2e6\n";
    let run = run(2.8, Some(wall));
    let said = run.said(run.parameters.clone());
    let verdict = said.verdict();
    // (W + T) b/(W h)
    let start = "With its members the record does not lift the structure: its peak is 0.876";
    assert!(verdict.starts_with(start), "{verdict}");
    assert!(verdict.contains("uplift takes 0.9867 g; without members, Housner's body rocks"));
    assert!(run.parameters.program.is_none());
    let screen = screen_of(&said, "out");
    assert!(screen.contains("lifts beyond 0.9867 g, without tendon 0.6667 g"), "{screen}");
    let words = screen.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("others, which are not made for dampers, tendons"), "{screen}");
    assert!(screen.lines().count() <= 30 && screen.lines().all(|l| l.chars().count() <= 98));
    // standing, it asks for m a_g/(m g + T)
    let needed = said.friction_needed.unwrap();
    let by_hand = run.job.record.pga_g() * 2.5e6 / (2.5e6 + 1.2e6);
    assert!((needed / by_hand - 1.0).abs() < 0.02, "{needed} {by_hand}");
}

/// A tendon's largest force is what the largest motion of its upper end makes of it, T0 + k (length
/// - height), and a damper's c times the rate of the corner that lifts.
#[test]
fn tendon_and_dampers_have_forces_to_design_for() {
    let wall = "[structure]\nkind = \"block\"\ntotal_height_m = 9.0\nwidth_m = 2.0\n\
                weight_kn = 900.0\n[tendon]\nstiffness_n_per_m = 4e6\npretension_n = 2e5\n\
                [damper]\nc_ns_per_m = 1e5\n";
    let run = run_within((4e4, 2e-3), 1.3, Some(wall));
    let forces = run.parameters.design_forces.unwrap();
    let motion = &run.both.with.as_ref().unwrap().history.motion;
    // the mass, 4.5 m up, is where the tendon ends
    let stretched = motion.u.iter().zip(&motion.v).map(|(u, v)| u.hypot(4.5 + v) - 4.5);
    let pull = 2e5 + 4e6 * stretched.fold(0.0, f64::max);
    let tendon = forces.tendon_n.unwrap();
    assert!(tendon.holds && pull > 2.02e5, "{tendon:?} {pull}");
    assert!((tendon.value.unwrap() / pull - 1.0).abs() < 2e-3, "{tendon:?} {pull}");
    // a corner 2 m from the other one turns about it
    let rate = motion.theta.windows(2).map(|two| (two[1] - two[0]).abs() / run.job.record.dt);
    let push = 1e5 * 2.0 * rate.fold(0.0, f64::max);
    let damper = forces.damper_n.unwrap();
    assert!(damper.holds, "{damper:?}");
    assert!((damper.value.unwrap().abs() / push - 1.0).abs() < 0.05, "{damper:?} {push}");
}

/// Of a slender block that a tendon and dampers hold, the sentence's top up to when its motion can
/// be foretold is that of the body with them, read off its own history: u + (H - h) sin theta.
#[test]
fn what_can_be_foretold_of_a_body_with_members_is_told_of_that_body() {
    let block = "[structure]\nkind = \"block\"\nheight_m = 9.0\nwidth_m = 2.2\nmass_kg = 110e3\n\
                 [tendon]\nstiffness_n_per_m = 2e6\npretension_n = 1e5\n\
                 [damper]\nc_ns_per_m = 2e5\n";
    let run = run_within((4e4, 2e-3), 1.0, Some(block));
    let said = run.said(run.parameters.clone());
    let motion = &run.both.with.as_ref().unwrap().history.motion;
    let top = |until: f64| {
        let samples = (until / run.job.record.dt).round() as usize + 1;
        let all = motion.u.iter().zip(&motion.theta).take(samples);
        all.map(|(u, theta)| (u + 9.0 * theta.sin()).abs()).fold(0.0, f64::max)
    };
    let verdict = said.verdict();
    assert!(verdict.starts_with("With its members it rocks and stands"), "{verdict}");
    let own = verdict.split("; without members").next().unwrap();
    match report::predictable_to(&said.findings) {
        Some(until) if top(until) < top(1e6) => {
            let words = format!("(top {})", files::message::quantity(top(until), "m"));
            assert!(own.contains("predictable to ") && own.contains(&words), "{verdict} {words}");
        }
        Some(_) => assert!(own.contains("predictable to ") && !own.contains("(top "), "{verdict}"),
        None => assert!(own.ends_with("; predictable"), "{verdict}"),
    }
    let screen = check_screen(&run, "out");
    assert!(screen.contains("lifts beyond 0.1335 g, without tendon 0.1222 g"), "{screen}");
    assert!(screen.contains(", axial "), "{screen}");
}

/// A body with friction alone is spoken of with friction, and where it ends beside its place is on
/// the screen; the friction needed stands outside of the columns.
#[test]
fn a_body_with_friction_is_told_with_friction() {
    let block = "[structure]\nkind = \"block\"\ntotal_height_m = 2.0\nwidth_m = 0.5\n\
                 mass_kg = 1000.0\n[friction]\ncoefficient = 0.28\n";
    let run = run_within((4e4, 2e-3), 1.0, Some(block));
    let said = run.said(run.parameters.clone());
    let text = screen_of(&said, "out");
    assert!(text.contains("with friction") && !text.contains("ith its members"), "{text}");
    assert!(!text.contains("with members"), "{text}");
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("friction needed: "), "{text}");
    let left = run.both.with.as_ref().unwrap().history.motion.u.last().unwrap().abs();
    let aside = said.findings.iter().any(|f| matches!(f.finding, Finding::LeftAside { .. }));
    let told = format!("ends {} aside", files::message::quantity(left, "m"));
    assert_eq!(words.contains(&told), aside, "{text} {told}");
}
