//! Forces that a structure is designed for, and whether they are its own: whether they stay when
//! the mesh and the springs are others.
//!
//! ```text
//!   force = largest magnitude of its low-pass without delay (`fem::low_pass`) at the cutoff       beside it: largest of the force as it is
//!   cutoff = 1.5 f_3        f_3: third bending mode of the column, fixed at its foot, by 32 elements; its gain there is 0.96
//!   holds: |force(other) - force| < 5 % of force, other: elements doubled; Omega_n/4; 4 Omega_n
//! ```
//!
//! A landing stops a footing at once. The wave that this sends up a column with a mass of its own
//! is sharper the finer the mesh and the stiffer the springs: its peak is theirs, its part below a
//! frequency is the structure's. A column without mass has no waves: its forces are given as they
//! are. The ground's impulse that stops a footing has no largest force of the structure's: forces
//! of the ground are given between landings, what the columns bring and, of the footings' weight
//! and inertia, the median over 0.02 s.
//!
//! Springs at Omega_n/4 have k1/16, k2/16, c/4 and the same m2: their landing is the same, four
//! times as slow.

mod beside;
mod check;
mod columns;
mod cutoff;
mod name;

pub use beside::{ForcesTogether, HeldForce, MOST_CHANGE, OtherForces};
pub use columns::{COMPARED, ColumnForces, ColumnPeaks, stiffer};
pub use cutoff::Cutoff;
pub use name::ForceName;

use super::{
    assembled::Assembled,
    fem::{ElasticHistory, LANDING_OVER},
    frame::EquilibriumError,
    peaks::StructurePeaks,
    rigid::RigidForces,
    structure::ElasticStructure,
};
use check::{ForcePeaks, Variants};
use dynamics::{
    fem::HistoryOutcome,
    spring::{Chain, Springs},
};
use rocking::motion::TimedPeak;
use strong_motion::Record;

/// At least so many parts to [`LANDING_OVER`].
const PARTS_A_LANDING: f64 = 13.0;

/// A force and its relative change with springs and mesh, over `over_s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureForce {
    /// Which.
    pub kind: ForceName,
    /// The force to design for, below the cutoff, with its sign [N, N m]; none if it does not hold.
    pub value: Option<f64>,
    /// When (s).
    pub time_s: f64,
    /// Whether it is the structure's own: all changes are below 5 %.
    pub holds: bool,
    /// What the column's base bears at that time; none of the ground's forces.
    pub together: Option<ForcesTogether>,
    /// Where, above the base along the column (m), of a column's shear or tension: the middle of an
    /// element, or its top.
    pub above_base_m: Option<f64>,
    /// What was found, whether it holds or not, and what with another mesh and on other springs [N,
    /// N m].
    pub others: OtherForces,
    /// Largest magnitude without a filter [N, N m].
    pub raw: f64,
    /// Frequency below which it is given (Hz); none: not filtered, of soles between landings.
    pub cutoff_hz: Option<f64>,
    /// Length of the record from its start that the peak is of (s): all of it, or as much as can be
    /// foretold.
    pub over_s: f64,
    /// Of a force that holds over that part alone: what it is over the whole record.
    pub whole_record: Option<OtherForces>,
    /// Of a force that is larger after what can be foretold: what it is, and holds, up to then.
    pub held: Option<HeldForce>,
    /// The structure held to the ground, below the same cutoff.
    pub fixed: Option<TimedPeak>,
    /// The rigid body by Housner's equation, between impacts.
    pub rigid: Option<TimedPeak>,
}

impl StructureForce {
    /// Of the whole record, and does not hold or is largest after what can be foretold: beside what
    /// it is, and holds, up to then. What is larger later is not to be designed by what was before.
    fn beside(self, part: Self) -> Self {
        let (later, found) = (self.others.found.abs(), part.others.found.abs());
        if self.holds || later > (1.0 + MOST_CHANGE) * found {
            let held = Some(HeldForce { value: part.others.found, over_s: part.over_s });
            Self { held, ..self }
        } else {
            Self { whole_record: Some(self.others), ..part }
        }
    }
}

/// All forces of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct StructureForces {
    /// Below which column forces are given, and what it keeps; none of columns without mass.
    pub cutoff: Option<Cutoff>,
    /// In the order of `ForceName::MEASURED`, less what does not apply.
    pub forces: Vec<StructureForce>,
}

impl StructureForces {
    /// One of them.
    pub fn get(&self, kind: ForceName) -> Option<&StructureForce> {
        self.forces.iter().find(|force| force.kind == kind)
    }

    /// The largest change, with springs or mesh, of those that hold: their error, as far as it is
    /// known. None where one of a column is withheld.
    pub fn error(&self) -> Option<f64> {
        let mut of_columns = self.forces.iter().filter(|force| COMPARED.contains(&force.kind));
        let all = of_columns.all(|force| force.holds);
        let given = self.forces.iter().filter(|force| force.holds);
        given.map(|force| force.others.change()).reduce(f64::max).filter(|_| all)
    }

    /// Of a structure on these springs, through a record; what it did on them and held to the
    /// ground, their forces finely sampled ([`parts`]), and as a rigid body; `foretold_s` if it can
    /// be foretold for less than the record's length. Unless it is `checked` on other springs and
    /// another mesh no force holds.
    ///
    /// # Errors
    /// A structure with its elements doubled or on other springs does not stand.
    pub(crate) fn new(
        checked: bool,
        (assembled, springs, record): (&Assembled, &[Springs<Chain>], &Record),
        (fem, fixed): (&ElasticHistory, &ElasticHistory),
        foretold_s: Option<f64>,
        rigid: Option<&RigidForces>,
    ) -> Result<Self, EquilibriumError> {
        let cutoff = Cutoff::of(&assembled.structure);
        let of =
            |history: &ElasticHistory, over: f64| ForcePeaks::of(history, cutoff.as_ref(), over);
        let variants = checked.then(|| Variants::of(assembled, springs, record)).transpose()?;
        let held = of(fixed, f64::INFINITY);
        // all forces of all motions over the same time
        let over = |seconds: f64| -> Vec<StructureForce> {
            let peaks = of(fem, seconds);
            let faster =
                cutoff.as_ref().map(|cutoff| ForcePeaks::below(2.0, fem, Some(cutoff), seconds));
            let peaks_of = |pick: fn(&Variants) -> Option<&ElasticHistory>| {
                variants.as_ref().and_then(pick).map(|history| of(history, seconds))
            };
            let finer = peaks_of(|variants| variants.doubled.as_ref());
            let [softer, stiffer] = [peaks_of(|v| Some(&v.softer)), peaks_of(|v| Some(&v.stiffer))];
            let value = |peaks: &ForcePeaks, kind: ForceName| {
                peaks.get(kind).map(|peak| peak.filtered.value)
            };
            let force = |kind: ForceName| {
                let peak = peaks.get(kind)?;
                let found = peak.filtered.value;
                let others = OtherForces {
                    found,
                    // a finer mesh without this force counts as an infinite change
                    doubled_elements: finer
                        .as_ref()
                        .map(|finer| value(finer, kind).unwrap_or(f64::INFINITY)),
                    softer: softer.as_ref().and_then(|softer| value(softer, kind)),
                    stiffer: stiffer.as_ref().and_then(|stiffer| value(stiffer, kind)),
                    doubled_cutoff: faster.as_ref().and_then(|faster| value(faster, kind)),
                };
                let holds = others.change() < MOST_CHANGE;
                let of_soles = [ForceName::SoleShear, ForceName::SoleVertical].contains(&kind);
                Some(StructureForce {
                    kind,
                    value: holds.then_some(found),
                    time_s: peak.filtered.time,
                    holds,
                    together: peak.together,
                    above_base_m: peak.above_base_m,
                    others,
                    raw: peak.raw,
                    cutoff_hz: peak.cutoff_hz,
                    over_s: seconds,
                    whole_record: None,
                    held: None,
                    // a structure held to the ground has no soles
                    fixed: held.get(kind).filter(|_| !of_soles).map(|peak| peak.filtered),
                    rigid: rigid.and_then(|rigid| rigid_peak(rigid, kind, record.dt)),
                })
            };
            // a leg is hinged at its foot
            let legs = matches!(assembled.structure, ElasticStructure::AFrame(_));
            let moments = [ForceName::ColumnBaseMoment, ForceName::ColumnTopMoment];
            let applies = |kind: &ForceName| !(legs && moments.contains(kind));
            ForceName::MEASURED.into_iter().filter(applies).filter_map(force).collect()
        };
        let mut forces = over((record.len().saturating_sub(1)) as f64 * record.dt);
        // beyond what can be foretold motions part, and with them their peaks
        let until = foretold_s.unwrap_or(f64::INFINITY);
        let doubtful = |force: &StructureForce| !force.holds || force.time_s > until;
        if forces.iter().any(doubtful) {
            for part in foretold_s.map(over).into_iter().flatten().filter(|part| part.holds) {
                let same = |whole: &&mut StructureForce| whole.kind == part.kind && doubtful(whole);
                if let Some(whole) = forces.iter_mut().find(same) {
                    *whole = whole.beside(part);
                }
            }
        }
        Ok(Self { cutoff: cutoff.clone(), forces })
    }
}

/// What another motion does to a structure on given springs, not checked.
pub struct OtherMotion {
    /// Largest displacement of a top (m).
    pub top_displacement: f64,
    /// When it overturns (s).
    pub overturns: Option<f64>,
    /// Largest forces [N, N m].
    pub forces: Vec<(ForceName, f64)>,
}

/// A structure on given springs through another record; nothing where its history ends early.
///
/// # Errors
/// The structure does not stand.
pub fn through(
    assembled: &Assembled,
    springs: &[Springs<Chain>],
    record: &Record,
) -> Result<Option<OtherMotion>, EquilibriumError> {
    let history = check::follow(&assembled.structure, &assembled.frame, springs, record)?;
    if history.outcome.ends_early().is_some() {
        return Ok(None);
    }
    let peaks = ForcePeaks::of(&history, Cutoff::of(&assembled.structure).as_ref(), f64::INFINITY);
    let forces = ForceName::MEASURED
        .into_iter()
        .filter_map(|kind| Some((kind, peaks.get(kind)?.filtered.value)))
        .collect();
    let moved = StructurePeaks::of(assembled, history.q.iter().map(Vec::as_slice));
    let overturns = match history.outcome {
        HistoryOutcome::Overturned { time } => Some(time),
        _ => None,
    };
    Ok(Some(OtherMotion { top_displacement: moved.displacement, overturns, forces }))
}

/// Parts of a record's time step whose means hold what a structure's cutoffs keep.
pub(crate) fn parts(structure: &ElasticStructure, dt: f64) -> usize {
    parts_below(Cutoff::of(structure).as_ref(), dt)
}

fn parts_below(cutoff: Option<&Cutoff>, dt: f64) -> usize {
    let of_waves = cutoff.map_or(0.0, |cutoff| dt * cutoff.cutoff_hz * cutoff::PARTS_A_PERIOD);
    of_waves.max(dt / LANDING_OVER * PARTS_A_LANDING).ceil().max(1.0) as usize
}

/// The rigid body's: its shear across the column is its moment over the column's length.
fn rigid_peak(rigid: &RigidForces, kind: ForceName, dt: f64) -> Option<TimedPeak> {
    let series = match kind {
        ForceName::ColumnShear => &rigid.shear,
        ForceName::ColumnBaseMoment => &rigid.moment,
        ForceName::Axial => &rigid.axial,
        _ => return None,
    };
    let peak = TimedPeak::of(dt, series)?;
    // on the end of the column, as in the frame
    Some(if kind == ForceName::ColumnBaseMoment {
        TimedPeak { value: -peak.value, ..peak }
    } else {
        peak
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn force(found: f64, over_s: f64, holds: bool) -> StructureForce {
        let others = OtherForces { found, ..OtherForces::default() };
        StructureForce {
            kind: ForceName::AxialTension,
            value: holds.then_some(found),
            time_s: 3.0,
            holds,
            together: None,
            above_base_m: None,
            others,
            raw: found,
            cutoff_hz: None,
            over_s,
            whole_record: None,
            held: None,
            fixed: None,
            rigid: None,
        }
    }

    #[test]
    fn a_force_that_is_larger_later_is_withheld() {
        let given = force(1.33e6, 40.0, false).beside(force(0.2e6, 10.0, true));
        assert_eq!((given.value, given.holds), (None, false));
        assert_eq!(given.held, Some(HeldForce { value: 0.2e6, over_s: 10.0 }));
    }

    #[test]
    fn a_force_that_is_not_larger_later_is_that_of_the_part_that_holds() {
        let given = force(-0.202e6, 40.0, false).beside(force(0.2e6, 10.0, true));
        assert_eq!((given.value, given.over_s, given.held), (Some(0.2e6), 10.0, None));
        assert_eq!(given.whole_record.map(|others| others.found), Some(-0.202e6));
    }
}
