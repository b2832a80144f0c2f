//! `report.html` of an elastic structure.

use std::fmt::Write;

use super::{ElasticRun, demands, words};
use crate::{
    commands::{
        draw::Figure,
        page::{self, PageSection, figures, html},
        table::strings,
    },
    figures::{brief, short},
    members::{Members, Tendon},
    motion::shown,
    parameters::elastic::ElasticParameters,
};

/// What the page is made from.
pub struct ElasticPage<'a> {
    pub run: &'a ElasticRun,
    pub parameters: &'a ElasticParameters,
    pub figures: &'a [Figure],
}

impl ElasticPage<'_> {
    /// The whole page.
    pub fn html(&self) -> String {
        let run = self.run;
        let sections: Vec<PageSection> = vec![
            ("case", "The case", self.case()),
            ("springs", "The springs", self.springs()),
            ("figures", "Figures", figures(self.figures)),
            ("forces", "What the structure bears", self.forces()),
            ("opensees", "In OpenSees", OPENSEES.into()),
            ("sap2000", "In SAP2000", self.sap2000()),
            ("cite", "How to cite", page::cite()),
        ];
        let title = format!("Ground springs for a {}", words::title(&run.assembled.structure));
        page::document(&html::escape(&title), &html::escape(&run.case.excitation.line()), &self.verdict(), &sections)
    }

    fn verdict(&self) -> String {
        let said = words::said(self.run);
        let reached = self.parameters.assessment.as_ref().is_none_or(|a| a.reached);
        let class = if reached { "verdict" } else { "verdict bad" };
        let (first, rest) = said.split_first().map_or(("", &[][..]), |(first, rest)| (first.as_str(), rest));
        let items: String = rest.iter().map(|line| format!("<li>{}</li>", html::pretty(line))).collect();
        let mut out = format!(
            "<div class=\"{class}\" id=\"verdict\"><strong>{}</strong><ul>{items}</ul></div>\n<div class=\"tiles\">\n",
            html::escape(first)
        );
        out += &html::tile(
            &format!("{} Hz", brief(self.parameters.omega_n_hz, 4)),
            "Omega_n / 2 pi of the vertical springs",
        );
        if let Some(on) = &self.parameters.on_record {
            let ratio = format!("peak theta/alpha; on rigid ground {:.3}", on.peak_ratio_reference);
            out += &html::tile(&format!("{:.3}", on.peak_ratio_fem), &ratio);
            let drift = format!("largest drift; on rigid ground {} mm", short(on.peak_drift_reference_m * 1e3, 3));
            out += &html::tile(&format!("{} mm", short(on.peak_drift_fem_m * 1e3, 3)), &drift);
            let over = format!("error of the rotation (NRMSE) over {:.2} s", on.compared_s);
            out += &html::tile(&on.nrmse_rotation.map_or("-".into(), shown), &over);
        }
        out + "</div>\n"
    }

    fn case(&self) -> String {
        let structure = &self.run.assembled.structure;
        let body = structure.body();
        let mut rows = vec![("structure", words::title(structure))];
        let given = serde_json::to_value(structure).unwrap_or_default();
        let keys: Vec<(String, String)> = given
            .as_object()
            .into_iter()
            .flatten()
            .filter(|(key, _)| *key != "kind")
            .map(|(key, value)| (key.clone(), value.to_string()))
            .collect();
        rows.extend(keys.iter().map(|(key, value)| (key.as_str(), value.clone())));
        let members = self.parameters.members();
        if let Some(damper) = members.damper {
            rows.push(("damper at each corner", format!("{} N s/m", brief(damper.c, 5))));
        }
        if let Some(Tendon { stiffness, pretension }) = members.tendon {
            rows.push(("tendon", format!("{} N/m, stressed to {} N", brief(stiffness, 5), brief(pretension, 5))));
        }
        rows.push(("slenderness alpha of the rigid body", format!("{:.5} rad", body.alpha())));
        rows.push(("frequency p of the rigid body", format!("{:.4} 1/s", body.p_squared().sqrt())));
        rows.push(("frequency fixed to the ground", format!("{} Hz", short(structure.frequency_hz(), 4))));
        rows.push(("acceleration that lifts the rigid body, g tan alpha", format!("{:.4} g", body.alpha().tan())));
        let line = self.run.case.excitation.line();
        rows.push(("record", line.strip_prefix("record ").unwrap_or(&line).to_string()));
        html::facts(&rows)
    }

    fn springs(&self) -> String {
        let mut out = String::from(
            "<p>Under every corner a vertical and a horizontal unit: the gap spring k₁ between the corner and an absorber of mass m₂, which presses \
             only (the horizontal one acts while it does), and k₂ beside the dashpot c between the absorber and the ground. m₂ is a numerical mass of \
             the unit, not one to be built.</p>\n",
        );
        let rows = self.parameters.springs.iter().enumerate().flat_map(|(i, row)| {
            [("vertical", &row.vertical), ("horizontal", &row.horizontal)].map(|(way, unit)| {
                let values = [unit.k1_n_per_m, unit.k2_n_per_m, unit.m2_kg, unit.c_ns_per_m];
                let mut cells = vec![format!("corner {} at {} m, {way}", i + 1, brief(row.x_m, 4))];
                cells.extend(values.map(|x| brief(x, 5)));
                cells
            })
        });
        out += &html::table(&strings(&["", "k1 [N/m]", "k2 [N/m]", "m2 [kg]", "c [N s/m]"]), rows, 0..0);
        out
    }

    fn sap2000(&self) -> String {
        if self.run.assembled.members != Members::default() || self.run.record.vertical.is_some() {
            return "<p>No SAP2000 deck was written: its tables leave dampers, tendons and vertical motion out.</p>\n"
                .into();
        }
        "<p>File &gt; Import &gt; SAP2000 .s2k Text File: <code>decks/model_sap2000.s2k</code>; then run the load cases GRAVITY and QUAKE. The file \
         could not be tried with the program; its head lists what to check after the import.</p>\n"
            .into()
    }

    fn forces(&self) -> String {
        let mut out = html::table(&strings(&demands::HEAD), demands::rows(self.run), 1..2);
        // writing to a String cannot fail
        let _ = writeln!(out, "<p>{}</p>", html::pretty(&demands::about(self.run)));
        out
    }
}

const OPENSEES: &str = "<p>The deck builds nodes, beams, footings and springs, applies gravity, runs the record in steps that follow every touch and \
     lift, and prints its peaks beside those of this report.</p>\n<pre>pip install openseespy\npython3 decks/model_openseespy.py\ntune verify \
     --parameters parameters.json</pre>\n<p>In a model of your own: put the springs under the footings' corners as in the deck; steps must be \
     shortened towards touches and lifts (<code>class Steps</code> can be pasted).</p>\n";
