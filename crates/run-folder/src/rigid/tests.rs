//! The page of runs that go each their own way: what it says, its size, and that it asks for
//! nothing from elsewhere.

use cases::Case;
use report::screen::{Written, screen};
use results::Finding;
use springs::job::Job;
use strong_motion::Record;
use strong_motion::excitation::Excitation;

use super::*;

mod program;

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
    let foretold_s = None;
    let figures = if figures {
        Pictures { case, job, both, front, foretold_s }.draw().unwrap()
    } else {
        Vec::new()
    };
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
    assert!(!said.verdict().contains("not predictable"), "{}", said.verdict());
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
    assert!(
        verdict.contains(", not predictable: a motion hardly different may leave"),
        "{verdict}"
    );
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
