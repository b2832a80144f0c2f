//! The page of runs that go each their own way: what it says, its size, and that it asks for nothing from elsewhere.

use super::super::draw::Pictures;
use super::*;
use crate::{case::Case, commands::FinishedRun, excitation::Excitation, record::Record, tuning::job::Job};

/// A run of a short stretch of El Centro.
fn run(scale: f64, toml: Option<&str>) -> FinishedRun {
    let mut case = toml.map_or_else(Case::paper, |text| Case::parse("tuning/test.toml", text)).unwrap();
    let excitation = Excitation { scale, duration_s: Some(8.0), ..Excitation::whole(Record::el_centro()) };
    case.set_excitation(excitation).unwrap();
    case.tuning.max_omega_hz = Some(160.0);
    case.tuning.accuracy = 0.1;
    let job = Job::new(&case, &|_, _, _| {}).unwrap();
    FinishedRun::new(case, job, Vec::new(), 0.5)
}

fn page(run: &FinishedRun, figures: bool) -> String {
    let FinishedRun { case, job, front, both, .. } = run;
    let figures = if figures { Pictures { case, job, both, front }.draw().unwrap() } else { Vec::new() };
    let page = Page { parameters: &run.parameters, run: Some(run), figures: &figures }.html();
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    // names of vocabularies are no addresses to be asked
    let asked = page.replace("http://www.w3.org/2000/svg", "");
    for what in ["http:", "https:", "//cdn", "src=", "@import", "url("] {
        assert!(!asked.contains(what), "the page names {what}");
    }
    for section in ["case", "springs", "accuracy", "opensees", "sap2000", "cite"] {
        assert!(page.contains(&format!("<section id=\"{section}\">")), "{section}");
    }
    page
}

#[test]
fn the_page_of_a_frame_that_rocks_has_everything() {
    let run = run(1.0, None);
    let page = page(&run, true);
    assert!(page.contains("The structure rocks and stands; the finite elements follow Housner to "));
    assert_eq!(page.matches("<figure ").count(), 5);
    assert_eq!(page.matches(" class=\"live\"").count(), 3);
    assert!(page.contains("61 × 12.2 m") && page.contains("frequency ratio f") && page.contains("NRMSE"));
    assert_eq!(page, self::page(&run, true));
}

#[test]
fn a_frame_that_never_lifts_is_said_to_stand() {
    let page = page(&run(0.1, None), true);
    assert!(page.contains("The record does not lift the structure"));
    assert!(page.contains("its peak is 0.0313 g, uplift takes 0.1000 g"), "{page}");
    // numbers of figures are in base 64, where three letters may be any
    let read = page.split("<script").map(|part| part.rsplit("</script>").next().unwrap_or(part));
    assert!(read.into_iter().all(|part| !part.contains("NaN")));
}

#[test]
fn a_block_that_overturns_is_said_to_and_marked() {
    let block = "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 1000.0\n";
    let page = page(&run(2.5, Some(block)), true);
    assert!(page.contains("The structure overturns at t = 4.4"));
    assert!(page.contains("overturned at t = 4.4"));
}

#[test]
fn a_page_without_figures_is_whole() {
    let page = page(&run(1.0, None), false);
    assert!(!page.contains("<figure") && !page.contains("id=\"figures\""));
    assert!(page.contains("<div class=\"tiles\">") && page.contains("id=\"verdict\""));
}
