//! `report.html`: a run on one page that asks no network, to be read, printed and filed.

use std::fmt::Write;

use super::{
    draw::Figure,
    members,
    run::FinishedRun,
    table::{self, FORCES, strings},
};
use crate::{
    case::Objective,
    figures::{self, brief, short},
    motion::shown,
    parameters::Parameters,
    structure::Kind,
    tuning::suite::LOOSER,
    verdict::Fate,
};
use advice::{Advice, Weight};
use html::{escape, facts, json, pretty, table, tile};

mod advice;
pub(super) mod html;

const STYLE: &str = include_str!("page/style.css");
const SCRIPT: &str = include_str!("page/script.js");

/// What the page is made from.
pub struct Page<'a> {
    /// As `parameters.json` holds it.
    pub parameters: &'a Parameters,
    /// None of springs that were tuned without a record.
    pub run: Option<&'a FinishedRun>,
    pub figures: &'a [Figure],
}

/// A section: its name in the address, its heading, its body.
pub(super) type PageSection = (&'static str, &'static str, String);

impl Page<'_> {
    /// The whole page.
    pub fn html(&self) -> String {
        let advice = advice::all(self.parameters, self.run);
        let sections: Vec<PageSection> = [
            ("case", "The case", self.case()),
            ("springs", "The springs", self.springs()),
            ("accuracy", "Accuracy, and on what", self.accuracy()),
            ("figures", "Figures", figures(self.figures)),
            ("landings", "Landings", self.landings()),
            ("forces", "Forces", self.forces()),
            ("stiffness", "Stiffness", self.stiffness()),
            ("opensees", "In OpenSees", self.opensees()),
            ("sap2000", "In SAP2000", self.sap2000()),
            ("cite", "How to cite", cite()),
        ]
        .into_iter()
        .filter(|(_, _, body)| !body.is_empty())
        .collect();
        let (title, subtitle) = self.title();
        let advised: String = advice.iter().map(Advice::html).collect();
        document(&title, &subtitle, &(self.verdict(&advice) + &advised), &sections)
    }

    /// Of what, and on what.
    fn title(&self) -> (String, String) {
        let s = &self.parameters.structure;
        let title = match s.kind {
            Kind::AFrame => format!("Ground springs for an A-frame of {} × {} m", s.height_m, s.width_m),
            Kind::Block => format!("Ground springs for a block, its mass at {} m, {} m wide", s.height_m, s.width_m),
        };
        let on = self.run.map_or("tuned without a record".to_string(), |run| run.case.excitation.line());
        (escape(&title), escape(&on))
    }

    /// What the run found, in a sentence, a few numbers, and all that the program said.
    fn verdict(&self, advice: &[Advice]) -> String {
        let class = match advice.iter().map(|advice| advice.weight).max() {
            None | Some(Weight::Note) => "verdict",
            Some(Weight::Care) => "verdict care",
            Some(Weight::Bad) => "verdict bad",
        };
        let said = self.run.map_or_else(|| table::said(self.parameters), FinishedRun::said);
        let short = &said[..said.iter().take_while(|line| !line.starts_with("accuracy")).count()];
        // what the heading and a remark below say is not said a third time
        let told = |line: &&String| {
            let remarked = ["WARNING: the accuracy", "ILL-CONDITIONED", "the springs can be trusted"];
            !remarked.iter().any(|what| line.contains(what))
        };
        let short: Vec<String> = short.iter().filter(told).cloned().collect();
        let items =
            |lines: &[String]| lines.iter().map(|line| format!("<li>{}</li>", pretty(line))).collect::<String>();
        format!(
            "<div class=\"{class}\" id=\"verdict\"><strong>{}</strong><ul>{}</ul></div>\n<div class=\"tiles\">\n{}</div>\n\
             <details><summary>All that the program said</summary><ul>{}</ul></details>\n",
            escape(&self.sentence()),
            items(&short),
            self.tiles(),
            items(&said)
        )
    }

    fn sentence(&self) -> String {
        let reached = self.parameters.assessment.as_ref().is_none_or(|a| a.reached);
        let missed = if reached { "" } else { "The accuracy asked for was not reached. " };
        let Some(v) = &self.parameters.verdict else {
            let without = "Springs tuned without a record";
            return if reached {
                format!("{without}, of the accuracy asked for")
            } else {
                format!("{missed}{without}")
            };
        };
        let what = match (v.agrees(), v.housner.fate, v.finite_elements.fate) {
            (false, ..) => "The two models disagree on what the structure does".to_string(),
            (_, Fate::NeverLifted, _) => "The record does not lift the structure".into(),
            (_, _, Fate::Overturned) => {
                let time = v.finite_elements.overturned_s.unwrap_or(v.compared_s);
                format!("The structure overturns at t = {time:.2} s")
            }
            (_, Fate::LeftGround, _) => "The structure rocks, and Housner's pivot leaves the ground".into(),
            _ => "The structure rocks and stands".into(),
        };
        match (v.well_conditioned, v.nrmse_horizontal) {
            (true, Some(e)) if v.agrees() => {
                format!("{missed}{what}; the finite elements follow Housner to {} %", short(e * 100.0, 2))
            }
            (false, Some(_)) if reached => format!(
                "{what}; no model can foretell this one motion, but the springs can be trusted: they were judged on synthetic ones"
            ),
            (false, Some(_)) => format!("{missed}{what}; no model can foretell this one motion"),
            _ => format!("{missed}{what}"),
        }
    }

    fn tiles(&self) -> String {
        let p = self.parameters;
        let mut out = tile(&hz(p.vertical.omega_n_hz), "Omega_n / 2 pi of the vertical springs");
        if let (Some(m), Some(v)) = (&p.matched, &p.verdict)
            && v.housner.fate != Fate::NeverLifted
        {
            let mm = |x: f64| format!("{} mm", short(x.abs() * 1e3, 4));
            let housner = format!("largest u up to {:.2} s; Housner {}", m.duration_s, mm(m.peak_horizontal_housner_m));
            out += &tile(&mm(m.peak_horizontal_fem_m), &housner);
            let until = v.housner.left_ground_s.map_or(String::new(), |t| format!(" until t = {t:.2} s"));
            let ratio = format!("peak theta/alpha; Housner {:.3}{until}", v.housner.peak_ratio);
            out += &tile(&format!("{:.3}", v.finite_elements.peak_ratio), &ratio);
            if let (Some(fem), Some(housner)) = (m.impacts_fem_firm, m.impacts_housner_firm) {
                out +=
                    &tile(&fem.to_string(), &format!("impacts harder than a fall from 0.02 alpha; Housner {housner}"));
            }
            if v.well_conditioned {
                out += &tile(&shown(m.nrmse_horizontal), "error of u on the record (NRMSE)");
            }
        }
        if let Some(a) = &p.assessment {
            let reached = if a.reached { "reached" } else { "not reached" };
            out += &tile(reached, &format!("accuracy asked for: {}", a.accuracy));
        }
        out
    }

    fn case(&self) -> String {
        let s = &self.parameters.structure;
        let body = s.body::<f64>();
        let kind = match s.kind {
            Kind::AFrame => "A-frame, its mass at the apex of two legs",
            Kind::Block => "solid block",
        };
        let given = if self.parameters.restitution.is_some() { "asked for" } else { "equation 2" };
        let mut rows = vec![
            ("structure", kind.to_string()),
            ("height h of the centre of mass", format!("{} m", s.height_m)),
            ("distance 2b of the feet", format!("{} m", s.width_m)),
            ("mass m", format!("{} kg", brief(s.mass_kg, 5))),
            ("rotational inertia about the centre of mass", format!("{} kg m²", brief(s.rotational_inertia_kgm2, 5))),
            ("slenderness alpha", format!("{:.5} rad", body.alpha())),
            ("frequency p", format!("{:.4} 1/s", body.p_squared().sqrt())),
            ("restitution e", format!("{:.5} ({given})", self.parameters.restitution())),
            ("acceleration that lifts it, g tan alpha", format!("{:.4} g", body.alpha().tan())),
        ];
        let members = members::names(&self.parameters.members());
        if !members.is_empty() {
            rows.push(("members, simulated beside the rigid body", members));
        }
        if let Some(run) = self.run {
            let line = run.case.excitation.line();
            rows.push(("record", line.strip_prefix("record ").unwrap_or(&line).to_string()));
            let tuning = &run.case.tuning;
            rows.push(("tuned by", objective(tuning.objective).into()));
            rows.push(("stiffest springs allowed", tuning.max_omega_hz.map_or("no limit".into(), hz)));
            rows.push(("friction coefficient for the warning of sliding", run.report.regime.friction.to_string()));
        }
        facts(&rows)
    }

    fn springs(&self) -> String {
        let (head, rows) = table::spring_rows(self.parameters);
        let mut out = String::from(
            "<p>Table 1 of the paper, for one foot; every foot has a vertical and a horizontal unit. In a unit the gap spring k₁ stands \
             between the foot and an absorber of mass m₂, and the spring k₂ and the dashpot c, side by side, between the absorber and the \
             ground. μ = m₂/m₁ with the structure's mass m₁. ",
        );
        out += &format!("{}</p>\n", pretty(table::ABSORBER));
        out += &table(&head, rows, 1..3);
        let columns = self.parameters.paper_procedure.is_some() || self.parameters.table_1.is_some();
        if columns {
            out +=
                "<p class=\"small\">The shaded columns are delivered; the others stand beside them to compare.</p>\n";
        }
        out
    }

    fn accuracy(&self) -> String {
        let mut out = String::new();
        if let Some(a) = &self.parameters.assessment {
            let m = &a.measured;
            let row = |what: &str, value: Option<f64>, count: Option<usize>, looser: f64| {
                let cells = |x: f64| {
                    let count = count.map_or("1".to_string(), |n| n.to_string());
                    [what.to_string(), count, shown(x), shown(looser * a.accuracy)]
                };
                value.map(cells)
            };
            let (median, p90, mean) = (m.synthetic_median, m.synthetic_p90, m.earthquakes_mean);
            let rows = [
                row("the record (u or v, the larger)", m.record, None, 1.0),
                row("synthetic motions, median", median.map(|s| s.value), median.map(|s| s.count), 1.0),
                row("synthetic motions, 90 % are below", p90.map(|s| s.value), p90.map(|s| s.count), LOOSER),
                row(
                    "earthquake-like motions, geometric mean",
                    mean.map(|s| s.value),
                    mean.map(|s| s.count),
                    m.looser_on_earthquakes(),
                ),
                row("the same with three standard errors", m.earthquakes_upper, mean.map(|s| s.count), f64::INFINITY),
            ];
            out += "<p>Measured in this run against Housner's solution. NRMSE is the root mean square of the difference in the \
                    displacement over the root mean square of Housner's; only motions count that can be followed one to one.</p>\n";
            out +=
                &table(&strings(&["measured on", "motions", "NRMSE", "asked for"]), rows.into_iter().flatten(), 2..3);
        }
        if let Some(m) = &self.parameters.matched {
            let (head, rows) = table::match_rows("on the record", self.parameters);
            let _ = writeln!(out, "<h3>The first {:.2} s of the record</h3>", m.duration_s);
            out += &table(&head, rows, 2..3);
        }
        out
    }

    fn landings(&self) -> String {
        if self.parameters.landings.is_empty() {
            return String::new();
        }
        let about = format!(
            "<p>Without a record: released at rest from a share of α, landed once, up to the next impact. Restitution asked for: {:.5}. Ringing \
             is a share of the weight.</p>\n",
            self.parameters.restitution()
        );
        about + &table(&strings(&table::LANDINGS), table::landing_rows(self.parameters), 1..3)
    }

    fn forces(&self) -> String {
        let Some(run) = self.run else { return String::new() };
        let columns = members::columns(&run.both.demands, run.both.with.as_ref());
        let mut head = strings(&["largest force"]);
        head.extend(columns.iter().map(|(name, _)| name.to_string()));
        let rows = crate::fem::QUANTITIES.iter().enumerate().filter_map(|(k, name)| {
            let (what, unit) = name.rsplit_once('_')?;
            let unit = if unit == "nm" { "N m" } else { "N" };
            if columns.iter().all(|(_, peaks)| peaks[k].value == 0.0) {
                return None;
            }
            let cell = |peak: crate::motion::TimedPeak| {
                let (factor, letter) = figures::prefix(peak.value.abs());
                match peak.value {
                    0.0 => "-".into(),
                    value => format!("{} {letter}{unit} at {:.2} s", short(value / factor, 4), peak.time),
                }
            };
            let mut row = vec![what.replace("axial", "axial force").replace('_', " ")];
            row.extend(columns.iter().map(|(_, peaks)| cell(peaks[k])));
            Some(row)
        });
        format!("<p>{} <b>{}</b></p>\n{}", pretty(members::ABOUT), pretty(FORCES), table(&head, rows, 1..2))
    }

    fn stiffness(&self) -> String {
        let Some(run) = self.run.filter(|run| !run.front.is_empty()) else { return String::new() };
        format!(
            "<p>Error of u against Ωₙ, and what stiffness costs. {}</p>\n{}",
            pretty(FORCES),
            table(&strings(&table::FRONT), table::front_rows(&run.front), 1..2)
        )
    }

    fn opensees(&self) -> String {
        if self.run.is_none() {
            return "<p>Tuned without a record, so without a deck: <code>tune export --format openseespy --parameters parameters.json \
                    --record FILE --out model.py</code> writes one.</p>\n"
                .into();
        }
        "<p>The deck builds the model, applies gravity, runs the record in steps that follow every touch and lift, and prints its peaks beside \
         those of this report.</p>\n<pre>pip install openseespy\npython3 decks/model_openseespy.py\ntune verify --parameters parameters.json     \
         # OpenSees, this history and Housner's in one table</pre>\n<p>In a model of your own: a node for the foot, one for the absorber and a \
         fixed one under it; between foot and absorber a vertical gap spring k₁ that only presses and a horizontal k₁ that acts while the \
         foot presses; between absorber and ground k₂ beside the dashpot c, in both directions; m₂ on the absorber. Steps must be \
         shortened towards touches and lifts (<code>class Steps</code> in the deck can be pasted). With even steps, take softer springs \
         from <code>tune run --max-hz 160</code>.</p>\n"
            .into()
    }

    fn sap2000(&self) -> String {
        let Some(run) = self.run else { return String::new() };
        let members = self.parameters.members();
        let more = members.damper.is_some() || members.tendon.is_some() || members.friction.is_some();
        if run.job.record.vertical.is_some() || more {
            return "<p>No SAP2000 deck was written: its tables leave vertical motion, dampers, tendons and friction out. Enter the springs \
                    by hand (decks/springs.csv).</p>\n"
                .into();
        }
        "<p>File &gt; Import &gt; SAP2000 .s2k Text File: <code>decks/model_sap2000.s2k</code>; then run the load cases GRAVITY and QUAKE. \
         The file could not be tried with the program; its head lists what to check after the import.</p>\n<p>SAP2000 takes even steps. \
         Give it springs that these can follow, <code>tune run --max-hz 160</code>, halve the step once, and compare with \
         history.csv.</p>\n"
            .into()
    }
}

/// A page of sections below a verdict; title and line are escaped.
pub(super) fn document(title: &str, subtitle: &str, verdict: &str, sections: &[PageSection]) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n<p class=\"sub\">{subtitle}</p>\n<nav>"
    );
    for (name, heading, _) in sections {
        // writing to a String cannot fail
        let _ = write!(out, "<a href=\"#{name}\">{heading}</a>");
    }
    out.push_str("</nav>\n");
    out.push_str(verdict);
    for (name, heading, body) in sections {
        let _ = write!(out, "<section id=\"{name}\">\n<h2>{heading}</h2>\n{body}</section>\n");
    }
    let version = env!("CARGO_PKG_VERSION");
    let _ = write!(
        out,
        "<footer>Written by tune {version} (crate groundspring). The same numbers: parameters.json, parameters.md, history.csv, \
         members.csv.</footer>\n</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    );
    out
}

/// Figures with their captions; those over time zoom.
pub(super) fn figures(all: &[Figure]) -> String {
    let mut out = String::new();
    for figure in all {
        let svg = figure.sheet.svg.replacen("<svg ", "<svg class=\"sheet\" role=\"img\" ", 1);
        let (live, numbers) = if figure.sheet.plots.is_empty() {
            ("", String::new())
        } else {
            (" class=\"live\"", format!("<script type=\"application/json\">{}</script>\n", json(&figure.sheet.plots)))
        };
        // writing to a String cannot fail
        let _ = write!(
            out,
            "<figure id=\"{}\"{live}>\n{svg}{numbers}<figcaption>{}</figcaption>\n</figure>\n",
            figure.name,
            pretty(figure.caption)
        );
    }
    out
}

fn objective(objective: Objective) -> &'static str {
    match objective {
        Objective::Landing => "the landing of the structure, from its geometry",
        Objective::Arr => "the paper's procedure: frequency response, then Ωₙ on the record",
    }
}

fn hz(x: f64) -> String {
    if x < 1e3 { format!("{} Hz", short(x, 4)) } else { format!("{} kHz", short(x * 1e-3, 4)) }
}

pub(super) fn cite() -> String {
    format!(
        "<p>The method: Q. T. Ma, J. W. Butterworth, B. D. Davidson, <i>Modelling rocking structures using standard finite elements</i>, \
         New Zealand Society for Earthquake Engineering Conference, 2005. The theory: G. W. Housner, <i>The behavior of inverted \
         pendulum structures during earthquakes</i>, Bulletin of the Seismological Society of America 53 (2), 1963.</p>\n<p>The program: \
         the groundspring authors, <i>tune: ground springs for rocking structures</i>, version {}.</p>\n",
        env!("CARGO_PKG_VERSION")
    )
}

#[cfg(test)]
mod tests;
