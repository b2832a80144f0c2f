//! `report.html`: a run on one page that asks no network, to be read, printed and filed.

use std::fmt::Write;

use super::{
    Run, Section,
    displacements::exact,
    html::{escape, in_html, pretty, table, tile, unbroken},
    markdown::sections,
    sentence,
};
use files::message::{percent, quantity};
use results::{FiledFinding, PeakTimes, Weight};

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// A figure as the page has it.
#[derive(Clone, Debug)]
pub struct Drawing<'a> {
    /// In addresses.
    pub id: &'a str,
    /// What it is.
    pub caption: &'a str,
    /// The picture.
    pub svg: &'a str,
    /// Plots over time with their numbers, as JSON, by which the page zooms it; none of others.
    pub plots: Option<String>,
}

/// The whole page.
pub fn page(run: &Run, drawn: &[Drawing]) -> String {
    let title = escape(&format!("Ground springs: {}", run.taken.structure));
    let subtitle = escape(run.taken.record.as_deref().unwrap_or("without a record"));
    let mut parts: Vec<(String, String, String)> = Vec::new();
    for part in sections(run) {
        let body = section(&part);
        parts.push((part.id.to_string(), part.title, body));
        if part.id == "forces" && !drawn.is_empty() {
            parts.push(("figures".into(), "Figures".into(), figures(drawn)));
        }
    }
    if !drawn.is_empty() && parts.iter().all(|(id, ..)| id != "figures") {
        parts.push(("figures".into(), "Figures".into(), figures(drawn)));
    }
    parts.extend(
        [programs(run), cite()]
            .into_iter()
            .map(|(id, title, body)| (id.to_string(), title.to_string(), body)),
    );
    document(&title, &subtitle, &(head(run) + &remarks(run)), &parts)
}

/// The verdict, what was taken, and a few numbers.
fn head(run: &Run) -> String {
    let graver = run.findings.iter().map(|finding| finding.weight).max();
    let class = match graver {
        Some(Weight::Fault) => "verdict bad",
        Some(Weight::Warning) => "verdict care",
        _ => "verdict",
    };
    let mut items: Vec<String> = Vec::new();
    if !run.taken.assumed.is_empty() {
        let all: Vec<String> =
            run.taken.assumed.iter().map(|a| format!("{} ({})", a.what, a.key)).collect();
        items.push(format!("Assumed: {}.", all.join("; ")));
    }
    items.extend(
        run.accuracy.as_ref().map(|accuracy| format!("Accuracy: {}.", accuracy.sentence())),
    );
    let items: String = items.iter().map(|text| format!("<li>{}</li>", pretty(text))).collect();
    format!(
        "<div class=\"{class}\" id=\"verdict\"><strong>{}</strong><ul>{items}</ul></div>\n\
            <div class=\"tiles\">\n{}</div>\n",
        pretty(&run.verdict()),
        tiles(run)
    )
}

/// What is added to the name of a number that cannot be predicted.
fn doubt(late: bool) -> &'static str {
    if late { " (not predictable)" } else { "" }
}

fn tiles(run: &Run) -> String {
    let mut out = String::new();
    if let Some(pair) = &run.peaks {
        let (shown, reference) = (pair.with_members.unwrap_or(pair.springs), pair.reference);
        let m = |x: f64| quantity(exact(x), "m");
        let until = run.predictable_to();
        let late = |when: fn(&PeakTimes) -> f64| {
            let time = shown.times.as_ref().map(when);
            doubt(time.zip(until).is_some_and(|(time, until)| time > until))
        };
        let of_top = late(|times| times.top_displacement_s);
        let top = format!(
            "top displacement{of_top}; {} {}",
            run.reference,
            m(reference.top_displacement_m)
        );
        out += &tile(&m(shown.top_displacement_m), &top);
        let of_drift = late(|times| times.drift_ratio_s.unwrap_or(times.rocking_s));
        let drift = "drift ratio: largest of the top from above its feet, over height";
        out += &tile(&percent(shown.drift_ratio), &format!("{drift}{of_drift}"));
        out += &tile(
            &m(shown.uplift_m),
            &format!(
                "uplift{}; {} {}",
                late(|times| times.uplift_s),
                run.reference,
                m(reference.uplift_m)
            ),
        );
        out += &tile(
            &shown.impacts.to_string(),
            &format!("impacts; {} {}", run.reference, reference.impacts),
        );
    }
    for (name, force) in run.design_forces.iter().flat_map(|forces| forces.all()) {
        let value =
            force.value.map_or("withheld".into(), |value| quantity(value.abs(), name.unit()));
        let name = run.force_words()(name);
        out += &tile(&value, &format!("{name}{}", doubt(Run::doubts(&force))));
    }
    if let Some(a) = &run.accuracy {
        let asked = match (a.peaks_asked, a.history_asked) {
            (Some(peaks), _) => format!("accuracy asked for: peaks within {}", percent(peaks)),
            (_, Some(history)) => format!("accuracy asked for: history {history}"),
            _ => "accuracy".into(),
        };
        out += &tile(if a.reached { "reached" } else { "not reached" }, &asked);
    }
    out
}

fn remarks(run: &Run) -> String {
    let one = |finding: &FiledFinding| {
        let class = if finding.weight == Weight::Note { "advice note" } else { "advice" };
        let mut body = format!("<b>{}</b>", pretty(&sentence(&finding.message)));
        if let Some(meaning) = finding.finding.meaning() {
            let _ = write!(body, "<p>{}</p>", pretty(meaning));
        }
        if let Some(remedy) = &finding.remedy {
            let _ = write!(body, "<p>What to do: {}</p>", pretty(&sentence(remedy)));
        }
        format!("<div class=\"{class}\">{body}</div>\n")
    };
    run.remarks().map(one).collect()
}

fn section(part: &Section) -> String {
    let paragraphs = |all: &[String]| {
        all.iter().map(|text| format!("<p>{}</p>\n", pretty(text))).collect::<String>()
    };
    let mut out = paragraphs(&part.text);
    if let Some(rows) = &part.table {
        let own = if part.id == "table1" { 1..3 } else { 0..0 };
        out += &table(rows, own);
    }
    out += &paragraphs(&part.notes);
    if !part.commands.is_empty() {
        let _ = writeln!(out, "<pre>{}</pre>", escape_lines(&part.commands));
    }
    out
}

fn escape_lines(lines: &[String]) -> String {
    lines.iter().map(|line| escape(line)).collect::<Vec<_>>().join("\n")
}

/// How to use the springs.
fn programs(run: &Run) -> (&'static str, &'static str, String) {
    let body = if run.taken.record.is_none() {
        "<p>Tuned without a record, so without a deck: <code>tune export --format openseespy \
            --parameters parameters.json --record FILE --out model.py</code> writes one.</p>\n"
            .to_string()
    } else {
        let sap2000 = match (&run.program, run.sap2000) {
            (None, _) => format!("<p>SAP2000: {}.</p>\n", escape(crate::screen::no_program(run))),
            (Some(program), deck) => {
                let deck = match deck {
                    _ if program.deck_of_even_steps => {
                        " <code>decks/model_even.py</code> and <code>decks/model_even.tcl</code> \
                            hold the model, these springs and these settings."
                    }
                    true if program.etabs => {
                        " <code>decks/etabs_by_hand.txt</code> holds the model, these springs and \
                            these settings to type from; ETABS was not run."
                    }
                    _ if !program.csi => {
                        " No deck has these springs: type them into a model of your own."
                    }
                    true => {
                        " <code>decks/model_sap2000.s2k</code> holds the model, these springs and \
                            these settings; it could not be tried with the program. \
                            <code>decks/sap2000_by_hand.txt</code> is the same to type from."
                    }
                    false => {
                        " No SAP2000 deck was written: its tables leave dampers, tendons and \
                            friction out."
                    }
                };
                let settings = program.settings(true).join("; ");
                let set_to = match settings.is_empty() {
                    true => settings,
                    false => format!("; set to {settings}"),
                };
                format!(
                    "<p>{}: {}{}.{deck}</p>\n",
                    escape(&program.program),
                    unbroken(&escape(&program.line())),
                    unbroken(&escape(&set_to))
                )
            }
        };
        let no_use = run.accuracy.as_ref().and_then(|accuracy| accuracy.no_use());
        let no_use =
            no_use.map_or(String::new(), |why| format!("<p>OpenSees: {}.</p>\n", escape(&why)));
        format!(
            "{no_use}<p>The deck builds the \
                model, applies gravity, runs the record in steps that follow \
                every touch and lift, and prints its peaks beside those of this report.</p>\n\
                <pre>pip install openseespy\npython3 decks/model_openseespy.py\ntune verify \
                --parameters parameters.json     # OpenSees, this history and the reference in one \
                table</pre>\n<p>In a model of your own: a node for the foot, one for the absorber \
                and a fixed one under it; between foot and absorber a vertical gap spring k₁ that \
                only presses and a horizontal k₁ that acts while the foot presses; between \
                absorber and ground k₂ beside the dashpot c, in both directions; m₂ on the \
                absorber. Steps must be shortened towards touches and lifts (<code>class \
                Steps</code> in the deck can be pasted).</p>\n{sap2000}"
        )
    };
    ("opensees", "In OpenSees and SAP2000", body)
}

fn cite() -> (&'static str, &'static str, String) {
    let body = format!(
        "<p>The method: Q. T. Ma, J. W. Butterworth, B. D. Davidson, <i>Modelling rocking \
            structures using standard finite elements</i>, New Zealand Society for Earthquake \
            Engineering Conference, 2005. The theory: G. W. Housner, <i>The behavior of inverted \
            pendulum structures during earthquakes</i>, Bulletin of the Seismological Society of \
            America 53 (2), 1963.</p>\n<p>The program: the groundspring authors, <i>tune: ground \
            springs for rocking structures</i>, version {}.</p>\n",
        env!("CARGO_PKG_VERSION")
    );
    ("cite", "How to cite", body)
}

/// A page of sections (id, heading, body) below a verdict; title and line are escaped.
fn document(
    title: &str,
    subtitle: &str,
    verdict: &str,
    parts: &[(String, String, String)],
) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
            <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
            <link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n\
            </head>\n<body>\n<main>\n<h1>{}</h1>\n<p class=\"sub\">{}</p>\n<nav>",
        unbroken(title),
        unbroken(subtitle)
    );
    for (id, heading, _) in parts {
        // writing to a String cannot fail
        let _ = write!(out, "<a href=\"#{id}\">{}</a>", escape(heading));
    }
    out.push_str("</nav>\n");
    out.push_str(verdict);
    for (id, heading, body) in parts {
        let _ = write!(
            out,
            "<section id=\"{id}\">\n<h2>{}</h2>\n{body}</section>\n",
            unbroken(&escape(heading))
        );
    }
    let version = env!("CARGO_PKG_VERSION");
    let _ = write!(
        out,
        "<footer>Written by tune {version} (crate groundspring). The same numbers: \
            parameters.json, parameters.md, history.csv, members.csv.</footer>\n</main>\n<script>\n\
            {SCRIPT}</script>\n</body>\n</html>\n"
    );
    out
}

/// Figures with their captions; those over time zoom.
fn figures(all: &[Drawing]) -> String {
    let mut out = String::new();
    for drawing in all {
        let svg = drawing.svg.replacen("<svg ", "<svg class=\"sheet\" role=\"img\" ", 1);
        let (live, numbers) = match &drawing.plots {
            Some(plots) => (
                " class=\"live\"",
                format!("<script type=\"application/json\">{}</script>\n", in_html(plots)),
            ),
            None => ("", String::new()),
        };
        // writing to a String cannot fail
        let _ = write!(
            out,
            "<figure id=\"{}\"{live}>\n{svg}{numbers}<figcaption>{}</figcaption>\n</figure>\n",
            drawing.id,
            pretty(drawing.caption)
        );
    }
    out
}
