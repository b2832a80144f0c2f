//! What a run warns of: what it means, and what to do.

use super::html::{escape, pretty};
use crate::{
    commands::run::FinishedRun,
    fem,
    parameters::Parameters,
    verdict::{Answer, Fate},
};

/// How much a remark weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// Good to know.
    Note,
    /// The numbers need judgement.
    Care,
    /// They must not be used as they are.
    Bad,
}

/// A remark.
#[derive(Clone, Debug)]
pub struct Advice {
    pub weight: Weight,
    what: String,
    means: &'static str,
    remedy: &'static str,
}

impl Advice {
    fn new(weight: Weight, what: impl Into<String>, means: &'static str, remedy: &'static str) -> Self {
        Self { weight, what: what.into(), means, remedy }
    }

    /// For the page.
    pub fn html(&self) -> String {
        let class = if self.weight == Weight::Note { "advice note" } else { "advice" };
        format!(
            "<div class=\"{class}\"><b>{}</b><p>{}</p><p>What to do: {}</p></div>\n",
            pretty(&self.what),
            escape(self.means),
            escape(self.remedy)
        )
    }
}

/// Everything that a reader must know, gravest first.
pub fn all(parameters: &Parameters, run: Option<&FinishedRun>) -> Vec<Advice> {
    let mut all = Vec::new();
    all.extend(run.iter().flat_map(|run| verdict(run)));
    all.extend(accuracy(parameters));
    all.extend(run.iter().flat_map(|run| regime(run)));
    all.extend(run.iter().flat_map(|run| history(run)));
    all.sort_by_key(|advice| std::cmp::Reverse(advice.weight));
    all
}

fn verdict(run: &FinishedRun) -> Vec<Advice> {
    let mut all = Vec::new();
    let Some(verdict) = &run.parameters.verdict else { return all };
    let fell = |answer: &Answer| answer.fate == Fate::Overturned;
    if !verdict.agrees() {
        all.push(Advice::new(
            Weight::Bad,
            "The two models disagree on what the body does",
            "One overturns, rocks or stands and the other does not. Near the edge of overturning the smallest change decides; elsewhere \
             the springs are too soft.",
            "ask for more accuracy (--accuracy), vary the record's scale by 1 %, and judge by many records (tune validate).",
        ));
    } else if fell(&verdict.housner) {
        all.push(Advice::new(
            Weight::Care,
            "The structure overturns",
            "Both models agree on it. Peaks, errors and forces count up to the time of overturning only; what follows is a fall.",
            "for the margin, scale the record (--scale) down until it stands.",
        ));
    }
    if verdict.housner.fate == Fate::NeverLifted {
        let pga = run.job.record.pga_g();
        let needed = run.case.structure.width_m / (2.0 * run.case.structure.height_m);
        all.push(Advice::new(
            Weight::Note,
            format!("The record does not lift the structure: its peak is {pga:.4} g, uplift takes {needed:.4} g"),
            "Nothing rocks, so there is no history to compare. The springs follow from the geometry, and their accuracy was measured on \
             synthetic motions: they are as good as for any record.",
            "nothing, or give a stronger record (--scale).",
        ));
    }
    if run.report.left_ground_s.is_some() {
        all.push(Advice::new(
            Weight::Care,
            "The pivot of Housner's body leaves the ground",
            "His equation holds while the foot presses on the ground, so his solution ends there. The finite elements go on, without \
             anything to compare them with.",
            "read the finite elements' history as that of a body that may fly; or leave the vertical component out to compare.",
        ));
    }
    if run.report.lifted && !verdict.well_conditioned {
        all.push(Advice::new(
            Weight::Care,
            "The motion is ill-conditioned",
            "A change of the width, the scale or the restitution far smaller than what is unknown of a real structure makes another history \
             of it. No two models, and no two tests, agree on it one to one, whatever the springs.",
            "do not judge the springs by this history: judge them by the accuracy on synthetic motions below, and by many records (tune \
             validate).",
        ));
    }
    all
}

fn accuracy(parameters: &Parameters) -> Vec<Advice> {
    let mut all = Vec::new();
    if let Some(a) = &parameters.assessment {
        let measured = a.measured.record.is_some() || a.measured.synthetic_median.is_some();
        if !a.reached {
            all.push(Advice::new(
                Weight::Bad,
                format!("The accuracy of {} was not reached", a.accuracy),
                "These are the best springs that were found within what was allowed; the table of accuracy says by how much they miss.",
                if a.capped { "raise or drop --max-hz." } else { "ask for less, or judge the springs by tune validate." },
            ));
        } else if !measured && a.measured.earthquakes_mean.is_none() {
            all.push(Advice::new(
                Weight::Care,
                "The accuracy could not be measured",
                "No motion that was tried rocks this body and can be followed one to one.",
                "judge the springs on records of your own (tune validate).",
            ));
        }
    }
    let errors = parameters.landings.iter().map(|l| l.restitution_error.abs());
    if errors.fold(0.0, f64::max) > super::super::run::RESTITUTION_MISSED {
        all.push(Advice::new(
            Weight::Care,
            "Landings do not have the restitution that was asked for",
            "A body on soft springs sways before it lifts and loses less; and a restitution other than equation 2's is met by a search, not \
             exactly. The table of landings says how far off.",
            "allow stiffer springs (--max-hz), or ask for a restitution nearer to equation 2's.",
        ));
    }
    all
}

fn regime(run: &FinishedRun) -> Vec<Advice> {
    let r = &run.report.regime;
    let mut all = Vec::new();
    let need = r.friction_needed.value.max(if run.report.lifted { r.landing_friction } else { 0.0 });
    if need > r.friction {
        all.push(Advice::new(
            Weight::Care,
            format!("The feet would slide: a friction coefficient of {need:.3} is needed, {:.3} is available", r.friction),
            "Housner's body and the springs hold the feet at any force. A real structure would slide there, and rock less.",
            "give the feet a shear key, a --friction that you can answer for, or friction in the case file, which is simulated.",
        ));
    }
    if let Some(flight) = r.free_flight {
        all.push(Advice::new(
            Weight::Care,
            format!("Free flight: the pivot lifts at t = {:.3} s", flight.time),
            "Housner's equation would have to pull the foot down there; the finite elements let it go.",
            "compare up to that time only.",
        ));
    }
    if r.too_stocky.is_some() {
        all.push(Advice::new(
            Weight::Care,
            "The body is too stocky to land without bouncing",
            "Housner's impact asks more friction of the landing foot than there is, or no friction would do.",
            "check the geometry (height of the centre of mass, width); rely on tests for such a body.",
        ));
    }
    all
}

fn history(run: &FinishedRun) -> Vec<Advice> {
    let with = run.both.with.as_ref().map(|with| ("with members ", &with.history));
    let mut all = Vec::new();
    for (which, history) in [("", &run.both.fem)].into_iter().chain(with) {
        match history.outcome {
            fem::HistoryOutcome::WorkBound { time } => all.push(Advice::new(
                Weight::Bad,
                format!("The history {which}ends at t = {time:.3} s: the bound on steps was reached"),
                "Springs this stiff with so little damping make more landings than can be followed.",
                "use softer springs (--max-hz), or springs with more damping.",
            )),
            fem::HistoryOutcome::Unstable { time } => all.push(Advice::new(
                Weight::Bad,
                format!("The history {which}ends at t = {time:.3} s: the rotation lost its balance"),
                "A body with almost no rotational inertia cannot stand on springs so soft, or leans so far that a leg would pull.",
                "use stiffer springs, or give a rotational_inertia_kgm2 above 0.002 m R^2.",
            )),
            _ => {}
        }
        if history.work.smallest > 0 {
            all.push(Advice::new(
                Weight::Care,
                format!("{} steps {which}were taken at the smallest size, whatever their error", history.work.smallest),
                "Contact changed faster than the integrator could resolve.",
                "compare with tune verify, or take slightly different springs.",
            ));
        }
    }
    all
}
