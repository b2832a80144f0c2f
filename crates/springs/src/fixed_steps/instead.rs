//! When springs for a program are of no use, and other settings of it that are measured then: the
//! integrator that it is usually set to, then other steps, the cheapest first.

use serde::{Deserialize, Serialize};

use super::LONGEST;
use fixed_steps::{FixedStepProgram, Integrator, ProgramName};

/// Error of the largest displacement above which springs are of no use: in the median of motions,
/// or on the run's record.
pub const USELESS: f64 = 0.1;
/// The same on earthquake-like motions in steps that are not too long; and what one motion in ten
/// may err by without a warning.
pub const NO_PEAK: f64 = 0.3;
/// Shorter steps that are tried.
const SHORTER: usize = 4;
/// Times as long steps, tried where most motions are lost.
const LONGER: [f64; 2] = [2.0, 4.0];
/// p dt below which a step is too costly to be tried.
const LEAST: f64 = 2.5e-4;
/// A difference of integrators' alpha that is rounding: users write hht:-0.333.
const SAME_ALPHA: f64 = 1e-3;

/// What was measured of other settings than those asked for, whose springs are of no use.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProgramInstead {
    /// These are of use.
    Helps {
        /// The program, where its usual integrator is what helps.
        #[serde(default, rename = "for", skip_serializing_if = "Option::is_none")]
        usual_of: Option<ProgramName>,
        /// Step (s).
        step_s: f64,
        /// Error of the largest displacement there, in the median of the motions where it errs
        /// most.
        median: f64,
    },
    /// None that was tried is.
    NoneDoes {
        /// The shortest step tried (s).
        shortest_s: f64,
    },
}

/// The largest step of 1, 2 or 5 times a power of ten that is no longer than this (s).
pub fn round_step(step: f64) -> f64 {
    let all = (1..=9).flat_map(|k| [5, 2, 1].map(|digit| format!("{digit}e-{k}")));
    let all = all.filter_map(|text| text.parse::<f64>().ok());
    all.into_iter().find(|x| *x <= step * (1.0 + 1e-9)).unwrap_or(step)
}

/// The median of peaks that decides whether springs are of use, and whether it is that of
/// earthquake-like motions, given those of synthetic and of earthquake-like ones; infinite where
/// most are lost, none where nothing was measured. Earthquake-like motions count in steps that are
/// too long by the law of the floor, and where peaks err by more than 30 %.
pub fn deciding([synthetic, earthquakes]: [Option<f64>; 2], floor: f64) -> Option<(f64, bool)> {
    let counts = |median: &f64| synthetic.is_none() || floor > USELESS || *median > NO_PEAK;
    match (synthetic, earthquakes.filter(counts)) {
        (Some(synthetic), Some(earthquakes)) if earthquakes > synthetic => {
            Some((earthquakes, true))
        }
        (Some(synthetic), _) => Some((synthetic, false)),
        (None, earthquakes) => Some((earthquakes?, true)),
    }
}

/// The program that this integrator is used in, if that is usually set to another one; one without
/// a name is OpenSees, if that has the integrator.
pub fn usually_another(name: Option<ProgramName>, integrator: Integrator) -> Option<ProgramName> {
    let nameless = match ProgramName::OpenSees.has(integrator) {
        true => ProgramName::OpenSees,
        false => ProgramName::Sap2000,
    };
    let name = name.unwrap_or(nameless);
    let same = match (integrator, name.integrator()) {
        (Integrator::Hht { alpha }, Integrator::Hht { alpha: usual }) => {
            (alpha - usual).abs() < SAME_ALPHA
        }
        (given, usual) => given == usual,
    };
    (!same).then_some(name)
}

/// What is tried, in this order, of a body of this p (1/s).
fn tried(program: FixedStepProgram, p: f64, lost: bool) -> Vec<FixedStepProgram> {
    let fits = |step: f64| p * step <= LONGEST;
    let usual = usually_another(program.name, program.integrator);
    let usual = usual.filter(|_| fits(program.step)).map(|name| FixedStepProgram {
        name: Some(name),
        integrator: name.integrator(),
        ..program
    });
    let longer = LONGER.map(|times| times * program.step);
    let longer = longer.into_iter().filter(|step| lost && fits(*step));
    let next = |step: &f64| Some(round_step(0.99 * step)).filter(|step| p * step >= LEAST);
    let longest = program.step.min(LONGEST / p);
    let shorter = std::iter::successors(next(&longest), next).take(SHORTER);
    let steps = longer.chain(shorter).map(|step| FixedStepProgram { step, ..program });
    usual.into_iter().chain(steps).collect()
}

/// The first that errs by less than a tenth on all sets of motions, or else that is of use and errs
/// by less than those asked for, `own`, by what `measure` finds: the largest median of peaks, and
/// whether springs are of use; none if it measures none of them.
pub(crate) fn instead(
    program: FixedStepProgram,
    p: f64,
    (own, lost): (f64, bool),
    mut measure: impl FnMut(FixedStepProgram) -> Option<(f64, bool)>,
) -> Option<ProgramInstead> {
    let (mut shortest_s, mut warned) = (None, None);
    for other in tried(program, p, lost) {
        let (median, of_use) = measure(other)?;
        let usual_of = other.name.filter(|_| other.integrator != program.integrator);
        let helps = ProgramInstead::Helps { usual_of, step_s: other.step, median };
        if of_use && median <= USELESS {
            return Some(helps);
        }
        if of_use && median < own && warned.is_none() {
            warned = Some(helps);
        }
        shortest_s = Some(shortest_s.map_or(other.step, |step: f64| step.min(other.step)));
    }
    warned.or(Some(ProgramInstead::NoneDoes { shortest_s: shortest_s? }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_rounded_down_to_one_two_or_five() {
        for (step, rounded) in [
            (0.0192, 0.01),
            (0.02, 0.02),
            (0.0067, 0.005),
            (9.9e-4, 5e-4),
            (1e-3, 1e-3),
            (0.7, 0.5),
        ] {
            assert_eq!(round_step(step), rounded, "{step}");
        }
    }

    /// The usual integrator at the same step, longer steps where motions are lost, then shorter
    /// ones; no longer than anything is known of, no shorter than is cheap.
    #[test]
    fn the_cheapest_settings_are_tried_first() {
        let sap = FixedStepProgram::of(ProgramName::Sap2000, 0.01);
        let steps = |program, p, lost| -> Vec<f64> {
            tried(program, p, lost).iter().map(|other| other.step).collect()
        };
        assert_eq!(steps(sap, 0.6, false), [5e-3, 2e-3, 1e-3, 5e-4]);
        assert_eq!(steps(sap, 0.6, true), [0.02, 0.04, 5e-3, 2e-3, 1e-3, 5e-4]);
        assert_eq!(steps(sap, 0.1, false), [5e-3]);
        // 0.03/15 = 2 ms at most
        assert_eq!(steps(sap, 15.0, true), [1e-3, 5e-4, 2e-4, 1e-4]);
        let nameless = FixedStepProgram { name: None, integrator: Integrator::Trbdf2, ..sap };
        let first = tried(nameless, 0.5, false)[0];
        assert_eq!(first, FixedStepProgram::of(ProgramName::OpenSees, 0.01));
    }

    #[test]
    fn the_first_that_is_of_use_is_told_or_how_far_was_tried() {
        let program = FixedStepProgram::of(ProgramName::Sap2000, 0.01);
        let errs = |least: f64| {
            instead(program, 0.6, (0.3, false), |other| {
                let error = if other.step > least { 0.5 } else { 0.03 };
                Some((error, error < USELESS))
            })
        };
        let helps = ProgramInstead::Helps { usual_of: None, step_s: 2e-3, median: 0.03 };
        assert_eq!(errs(2e-3), Some(helps));
        assert_eq!(errs(1e-4), Some(ProgramInstead::NoneDoes { shortest_s: 5e-4 }));
        // much on earthquake-like motions, which is a warning, but for the shortest
        let much = instead(program, 0.6, (0.3, false), |other| Some((12.0 * other.step, true)));
        let helps = ProgramInstead::Helps { usual_of: None, step_s: 5e-3, median: 0.06 };
        assert_eq!(much, Some(helps));
        let warned = instead(program, 0.6, (0.3, false), |_| Some((0.2, true)));
        assert_eq!(
            warned,
            Some(ProgramInstead::Helps { usual_of: None, step_s: 5e-3, median: 0.2 })
        );
        let no_less = instead(program, 0.6, (0.15, false), |_| Some((0.2, true)));
        assert_eq!(no_less, Some(ProgramInstead::NoneDoes { shortest_s: 5e-4 }));
        // a run that is stopped
        assert_eq!(instead(program, 0.6, (0.3, false), |_| None), None);
        let other = FixedStepProgram { integrator: Integrator::Trbdf2, name: None, ..program };
        let found = instead(other, 0.6, (0.3, false), |_| Some((0.01, true)));
        let (usual_of, step_s) = (Some(ProgramName::OpenSees), 0.01);
        assert_eq!(found, Some(ProgramInstead::Helps { usual_of, step_s, median: 0.01 }));
    }
}
