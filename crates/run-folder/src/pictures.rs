//! The figures of `tune run`, filled from its results.

mod response;

use std::path::Path;

use crate::FolderError;
use cases::Case;
use dynamics::{compare::Match, fem::History};
use figures::{EventMark, Figure, FigureError, Sheet, brief, short};
use files::message::significant;
use parameters::answers::ModelComparison;
use report::stiffness_tradeoff::TradeoffPoint;
use rocking::{
    housner::{self, Rocking},
    motion::Motion,
    structure::{Kind as BodyKind, Structure},
};
use springs::job::Job;

/// Every figure that a run may leave, and its files.
macro_rules! figures {
    ($($constant:ident = $name:literal)+) => {
        $(#[doc = concat!("Name of the figure ", $name, ".")] pub const $constant: &str = $name;)+
        pub(crate) const FILES: &[&str] = &[$(concat!($name, ".png"), concat!($name, ".svg")),+];
    };
}
figures!(
    HISTORY = "history"
    RESPONSE = "response"
    CONTACT = "contact"
    ENERGY = "energy"
    FRONT = "front"
    CANDIDATES = "candidates"
    BEARING = "forces"
);

/// What forces of the feet are.
const FORCES: &str = "Foot forces are those of the springs in a landing, not of the structure: \
                      they grow with Omega_n.";

/// What figures are drawn from.
pub(crate) struct Pictures<'a> {
    pub case: &'a Case,
    pub job: &'a Job,
    pub both: &'a ModelComparison,
    pub front: &'a [TradeoffPoint],
    /// Up to when the histories can be foretold, where not all of them (s).
    pub foretold_s: Option<f64>,
}

impl Pictures<'_> {
    /// All figures that there are numbers for, drawn side by side.
    ///
    /// # Errors
    /// Numbers that cannot be drawn.
    pub(crate) fn draw(&self) -> Result<Vec<Figure>, FigureError> {
        type Draw<'a> = fn(&Pictures<'a>) -> Result<Option<Sheet>, FigureError>;
        let all: &[(&str, &str, Draw)] = &[
            (
                HISTORY,
                "Displacement of the mass, finite elements over Housner's solution; impacts as \
                 triangles.",
                Self::history,
            ),
            (
                RESPONSE,
                "Amplitude response ratio of the spring-absorber units (equation 7 of the paper).",
                Self::response,
            ),
            (CONTACT, FORCES, Self::contact),
            (
                ENERGY,
                "Where the energy that the ground brings in goes; the residual is what the account \
                 misses.",
                Self::energy,
            ),
            (FRONT, "What stiffer springs gain in accuracy, and what they cost.", Self::front),
            (CANDIDATES, "Every pair of Ωₙ that the paper's procedure tried.", Self::candidates),
        ];
        let drawn = parallel::map(all, |(name, caption, draw)| {
            Ok(draw(self)?.map(|sheet| Figure { name, caption, sheet }))
        });
        drawn.into_iter().filter_map(Result::transpose).collect()
    }

    /// A title, and below it the structure, the record, its scale and Omega_n.
    fn title(&self, what: &str) -> String {
        let excitation = &self.case.excitation;
        let motions = format!("{} × {}", self.case.record.name, brief(excitation.scale, 4));
        let hz = self.job.springs.vertical.omega_n_hz;
        format!("{what}\n{}", subtitle(&self.case.structure, &motions, hz))
    }

    /// Times of so many samples (s).
    fn times(&self, n: usize) -> Vec<f64> {
        (0..n).map(|i| i as f64 * self.job.record.dt).collect()
    }

    /// The history on springs that answers for the structure, and its match: with its members, if
    /// it has any.
    fn own(&self) -> (&History, &Match) {
        let both = self.both;
        both.with.as_ref().map_or((&both.fem, &both.matched), |with| (&with.history, &with.matched))
    }

    /// What is drawn, said of a structure with members.
    fn with_members(&self, what: &str) -> String {
        let with = match &self.both.with {
            Some(with) if with.members.friction.is_some() => ", with friction",
            Some(_) => ", with members",
            None => "",
        };
        format!("{what}{with}")
    }

    /// When the finite element model overturned, in words.
    fn fall(&self) -> Option<(f64, String)> {
        let time = self.own().1.overturned_fem_s?;
        Some((time, format!("overturned at t = {time:.2} s")))
    }

    /// Housner's history that the finite elements are beside: with a tendon and dampers, if the
    /// body has these.
    fn housner(&self) -> (&Rocking<f64>, &Motion) {
        let with = self.both.with.as_ref();
        let own = with.and_then(|with| Some((with.rocking.as_ref()?, with.housner.as_ref()?)));
        own.unwrap_or((&self.both.rocking, &self.both.housner))
    }

    /// When Housner's body overturned, or his solution ended otherwise.
    fn end_of_housner(&self) -> Option<(f64, String)> {
        let (rocking, _) = self.housner();
        let time = match rocking.outcome {
            housner::RockingOutcome::LeavesGround { time } => {
                return Some((time, format!("Housner: leaves the ground at t = {time:.2} s")));
            }
            housner::RockingOutcome::WorkBound { time }
            | housner::RockingOutcome::NotFinite { time } => {
                return Some((time, format!("Housner: ends at t = {time:.2} s")));
            }
            _ => rocking.overturned()?,
        };
        Some((time, format!("Housner: overturned at t = {time:.2} s")))
    }

    fn history(&self) -> Result<Option<Sheet>, FigureError> {
        let ((rocking, housner), (fem, _)) = (self.housner(), self.own());
        let what = match self.case.structure.kind {
            BodyKind::AFrame => "Displacement of the apex",
            BodyKind::Block => "Displacement of the centre of mass",
        };
        let bare = &self.both.housner;
        let t = self.times(housner.len().max(fem.motion.len()).max(bare.len()));
        let impacts_housner: Vec<f64> = rocking.impacts.iter().map(|i| i.time).collect();
        let impacts_fem: Vec<f64> =
            fem.landings.iter().filter(|l| l.impact).map(|l| l.time).collect();
        let (end, fall) = (self.end_of_housner(), self.fall());
        let last = (fem.motion.len().saturating_sub(1)) as f64 * self.job.record.dt;
        let early = fem.motion.len() < housner.len() && fall.is_none();
        let fall =
            fall.map(|(time, _)| (time, format!("finite elements: overturned at t = {time:.2} s")));
        let fall = fall
            .or_else(|| early.then(|| (last, format!("finite elements: end at t = {last:.2} s"))));
        let own = self.both.with.as_ref().map(|with| with.housner.is_some());
        let reference = figures::history::Trace {
            label: match own {
                Some(true) => "Housner, with members",
                Some(false) => "Housner, without members",
                None => "Housner",
            },
            u: &housner.u,
            v: &housner.v,
            impacts: &impacts_housner,
            end: event(&end),
            answers: false,
            behind: false,
        };
        let other = figures::history::Trace {
            label: &self.with_members("finite elements on ground springs"),
            u: &fem.motion.u,
            v: &fem.motion.v,
            impacts: &impacts_fem,
            end: event(&fall),
            answers: self.both.with.is_some(),
            behind: false,
        };
        let without = figures::history::Trace {
            label: "Housner, without members",
            u: &bare.u,
            v: &bare.v,
            behind: true,
            ..Default::default()
        };
        let others = [other, without];
        let title = self.title(what);
        let foretold =
            self.foretold_s.map(|until| (until, format!("predictable to t = {until:.2} s")));
        let data = figures::history::HistoryFigure {
            title: &title,
            t: &t,
            reference,
            others: if own == Some(true) { &others } else { &others[..1] },
            differences: false,
            foretold: event(&foretold),
        };
        figures::history::draw(&data).map(Some)
    }

    fn candidates(&self) -> Result<Option<Sheet>, FigureError> {
        let Some(paper) = &self.job.paper else { return Ok(None) };
        let tuned = &paper.tuned;
        let candidates: Vec<_> = tuned
            .candidates
            .iter()
            .map(|c| figures::candidates::CandidateMark {
                vertical_hz: c.springs.vertical.omega_n_hz,
                horizontal_hz: c.springs.horizontal.omega_n_hz,
                error: c.error,
                abandoned: c.abandoned,
            })
            .collect();
        let delivered = self.job.springs == tuned.candidates[tuned.chosen].springs;
        let data = figures::candidates::CandidatesFigure {
            title: &self.title("Every candidate of the paper's procedure"),
            error_label: "NRMSE of u and v",
            candidates: &candidates,
            chosen: Some(tuned.chosen),
            chosen_label: if delivered { "delivered" } else { "its best, not delivered" },
        };
        figures::candidates::draw(&data).map(Some)
    }

    fn contact(&self) -> Result<Option<Sheet>, FigureError> {
        let f = &self.own().0.forces;
        let t = self.times(f.vertical[0].len());
        let fall = self.fall();
        let data = figures::contact::ContactFigure {
            title: &format!(
                "{}\n{}",
                self.title(&self.with_members("Forces between the feet and the ground")),
                letters(FORCES)
            ),
            t: &t,
            left_vertical: &f.vertical[0],
            right_vertical: &f.vertical[1],
            left_horizontal: &f.horizontal[0],
            right_horizontal: &f.horizontal[1],
            weight: Some(self.case.structure.mass_kg * rocking::scalar::GRAVITY),
            end: event(&fall),
        };
        figures::contact::draw(&data).map(Some)
    }

    fn energy(&self) -> Result<Option<Sheet>, FigureError> {
        let a = &self.own().0.account;
        let t = self.times(a.input.len());
        let fall = self.fall();
        let data = figures::energy::EnergyFigure {
            title: &self.title(&self.with_members("Energy account of the finite elements")),
            t: &t,
            input: &a.input,
            stored: &a.stored,
            dissipated: &a.dissipated,
            residual: &a.residual,
            end: event(&fall),
        };
        figures::energy::draw(&data).map(Some)
    }

    fn front(&self) -> Result<Option<Sheet>, FigureError> {
        let front = self.front;
        let series = |pick: fn(&TradeoffPoint) -> Option<f64>| -> (Vec<f64>, Vec<f64>) {
            front.iter().filter_map(|p| pick(p).map(|e| (p.omega_n_hz, e))).unzip()
        };
        let (landing, arr) = (series(|p| p.landing), series(|p| p.arr));
        let named = [("design from the geometry", &landing), ("the paper's procedure", &arr)];
        let all: Vec<_> = named
            .into_iter()
            .filter(|(_, s)| !s.0.is_empty())
            .map(|(label, s)| figures::front::DesignSeries { label, omega_n_hz: &s.0, error: &s.1 })
            .collect();
        if all.is_empty() {
            return Ok(None);
        }
        let mut notes = vec![letters(FORCES)];
        for (label, s) in named.into_iter().filter(|(_, s)| s.0.len() < front.len()) {
            let without = front.iter().map(|p| p.omega_n_hz).filter(|hz| !s.0.contains(hz));
            let without: Vec<String> = without.map(|hz| format!("{hz:.0}")).collect();
            notes.push(match (s.0.is_empty(), self.job.paper.is_some()) {
                (true, false) => format!(
                    "No point of {label}: it tunes on the record, which must \
                    rock the structure and be well conditioned."
                ),
                _ => format!("No finite error of {label} at {} Hz.", without.join(", ")),
            });
        }
        let cost = |pick: fn(&TradeoffPoint) -> f64| -> (Vec<f64>, Vec<f64>) {
            front.iter().map(|p| (p.omega_n_hz, pick(p).max(1.0))).unzip()
        };
        let (forces, steps) = (cost(|p| p.foot_force_weights), cost(|p| p.deck_steps as f64));
        let on = if self.job.suites.has_record() {
            "on the record"
        } else {
            "median of synthetic motions"
        };
        let data = figures::front::FrontFigure {
            title: &self.title("Error against stiffness"),
            error_label: &format!("NRMSE of u, {on}"),
            series: &all,
            chosen_hz: self.job.springs.vertical.omega_n_hz,
            accuracy: self.case.tuning.accuracy,
            costs: [
                figures::front::Cost {
                    label: "foot force [weights]",
                    omega_n_hz: &forces.0,
                    value: &forces.1,
                },
                figures::front::Cost {
                    label: "steps of the deck",
                    omega_n_hz: &steps.0,
                    value: &steps.1,
                },
            ],
            notes: &notes,
        };
        figures::front::draw(&data).map(Some)
    }
}

/// What a figure is of, in a line: the structure, the motions, Omega_n.
pub fn subtitle(structure: &Structure, motions: &str, omega_n_hz: f64) -> String {
    // to read: what was typed in inches has 16 digits
    let [height_m, width_m] = [structure.height_m, structure.width_m].map(|x| significant(x, 6));
    let body = match structure.kind {
        BodyKind::AFrame => format!("A-frame {height_m} m high, feet {width_m} m apart"),
        BodyKind::Block => format!("block with its mass at {height_m} m, {width_m} m wide"),
    };
    let (unit, letter) = figures::prefix(omega_n_hz);
    format!("{body}; {motions}; Ωₙ/2π = {} {letter}Hz", short(omega_n_hz / unit, 3))
}

/// The field's letter in place of its name.
fn letters(text: &str) -> String {
    text.replace("Omega_n", "Ωₙ")
}

fn event(end: &Option<(f64, String)>) -> Option<EventMark<'_>> {
    end.as_ref().map(|(time, text)| EventMark { time: *time, text })
}

/// Write every figure as PNG and SVG, side by side.
///
/// # Errors
/// A figure that cannot be rasterised or written.
pub(crate) fn save(dir: &Path, figures: &[Figure]) -> Result<(), FolderError> {
    let save = |figure: &Figure| figure.sheet.save(&dir.join(figure.name).with_extension("png"));
    Ok(parallel::map(figures, save).into_iter().collect::<Result<(), FigureError>>()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 24 inches, typed.
    #[test]
    fn a_subtitle_has_few_digits() {
        let block = Structure::block(2.286, 0.609_599_999_999_999_9, 952.5).unwrap();
        let told = subtitle(&block, "motion", 50e3);
        assert_eq!(told, "block with its mass at 1.143 m, 0.6096 m wide; motion; Ωₙ/2π = 50.0 kHz");
    }
}
