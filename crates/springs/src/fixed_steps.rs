//! Springs for programs with fixed time steps: units for the body's own landing, as stiff and with
//! as little rebound as the step has use for.
//!
//! ```text
//!   error of a history   floor    13 p dt
//!                        stance   80 (p/(alpha Omega_e))^2
//!                        rebound  20 alpha^3 (v_r/v_n)^2,   v_r/v_n about 1.7 K
//!
//!   stance  = 0.6 floor         ->  k_e = k1 K/(1 + K) = S m p/(alpha^2 dt), S = 12, 10, 7, 5
//!                               and 48, 20 where the integrator ends stiff modes
//!   rebound = 3/4 floor         ->  K = sqrt(3 13 p dt/(4 20 1.7^2 alpha^3)),  at most 1/2
//!   units   mu = mu_u(K) M/2,  C = C_u(K) sqrt(M)  of what lands (`landing::design`)
//!           Omega_h/Omega_v at least 4, more under stocky frames
//! ```
//!
//! The units are those of `units`. The floor is what springs cannot go below
//! (`fixed_steps::expected`). How stiff the stance is decides two things against each other: an
//! iteration gives up the more often, and short steps of stocky bodies err the more, the stiffer it
//! is (`cargo bench --bench fixed_steps -- stance`); and a body sways on it before it lifts, on
//! earthquake-like motions most. Both are measured: springs are stepped as the program does, on the
//! synthetic motions that a run's other springs are judged on. Stances are tried from the stiffest
//! on. One will do if nearly all histories come through and their median error is at most 1.7 times
//! the floor; the first that will do is taken, from 10 on. If a user asks for a program, all are
//! tried, stiffer ones too if the integrator ends stiff modes; of those whose medians are alike, it
//! takes the one whose peaks err least on earthquake-like motions. The errors given for synthetic
//! motions are then measured on 48 motions that did not choose the springs. On earthquake-like
//! motions they are measured in every run.

pub mod instead;
mod units;

pub use self::units::{DesignNumbers, design};

use self::instead::{ProgramInstead, USELESS, deciding, instead};
use super::{
    ALIKE,
    suite::{JudgedOn, Suites},
};
use cases::Case;
use dynamics::effort::Effort;
use fixed_steps::{
    ExpectedError, FixedStepBody, FixedStepDesign, FixedStepProgram, FixedStepSprings,
    StepSettings,
    measured::{ErrorsOverMotions, ReferenceHistory},
    recipe::FixedStepSpringsError,
};
use rocking::structure::Body;

/// k_e alpha^2 dt/(m p): the stances that are tried.
pub const STANCES: [f64; 4] = [12.0, DesignNumbers::EVEN.stance, 7.0, 5.0];
/// The first of them where no program was asked for: fewer motions choose, and a run's own record,
/// which does not, is to come through.
const UNASKED: usize = 1;
/// Stiffer ones, which sway less before they lift, for integrators that end stiff modes.
const STIFFER: [f64; 2] = [48.0, 20.0];
/// Median error that springs may have, over the floor.
const OVER_FLOOR: f64 = 1.7;
/// Where a user asks for a program: additional synthetic motions that choose the springs; the
/// motions after these only measure the errors.
const ALSO_CHOOSE: usize = 24;
/// p dt up to which an error is told.
pub const LONGEST: f64 = 0.03;
/// Histories that a program is to get through, of all.
pub const THROUGH: f64 = 0.95;
/// The same with an integrator that ends stiff modes.
const THROUGH_IF_ENDED: f64 = 0.99;

/// Springs for a body in a program, and what they err.
#[derive(Clone, Debug)]
pub struct ProgramSprings {
    /// The program.
    pub program: FixedStepProgram,
    /// The springs, and the body as both models are to have it.
    pub springs: FixedStepSprings,
    /// The parts of the error, in closed form.
    pub expected: ExpectedError,
    /// Measured on synthetic motions; none of a step too long to promise anything, or if the run
    /// was stopped before.
    pub synthetic: Option<ErrorsOverMotions>,
    /// Measured on earthquake-like motions; none where synthetic ones are not.
    pub earthquakes: Option<ErrorsOverMotions>,
    /// Whether stiffer springs were taken, for what they do on earthquake-like motions.
    pub stiffer: bool,
    /// Other settings, measured where a user asked for these and they are of no use.
    pub instead: Option<ProgramInstead>,
}

/// Motions, and Housner's answers of the body as the program has it.
struct ProgramSuites {
    /// Those that choose the springs.
    synthetic: Vec<ReferenceHistory>,
    earthquakes: Vec<ReferenceHistory>,
    /// Synthetic motions that choose nothing.
    others: Vec<ReferenceHistory>,
}

impl ProgramSuites {
    /// The motions of a run's suites; more of them only where a user asked.
    fn of(body: &Body<f64>, suites: &Suites, asked: bool, effort: &Effort) -> Self {
        let restitution = suites.another_restitution();
        let of = |suites: &Suites, on: JudgedOn| -> Vec<ReferenceHistory> {
            let motions: Vec<_> = suites.motions(on).collect();
            let answers = parallel::map(&motions, |(dt, accel)| {
                ReferenceHistory::new(body, restitution, *dt, accel.to_vec())
            });
            answers.into_iter().flatten().collect()
        };
        let mut synthetic = of(suites, JudgedOn::Synthetic);
        let earthquakes = of(suites, JudgedOn::Earthquakes);
        if !asked {
            return Self { synthetic, earthquakes, others: Vec::new() };
        }
        let mut more = of(
            &suites.more(restitution.unwrap_or(body.restitution()), effort),
            JudgedOn::Synthetic,
        );
        let others = more.split_off(ALSO_CHOOSE.min(more.len()));
        synthetic.append(&mut more);
        Self { synthetic, earthquakes, others }
    }
}

impl ProgramSprings {
    /// Springs for the program that a case asks for, or for the usual one; none for a body with
    /// members. They have equation 2's restitution, and are measured against the case's.
    pub(crate) fn of_case(
        case: &Case,
        body: &Body<f64>,
        suites: &Suites,
        effort: &Effort,
    ) -> Option<Self> {
        // no program's model of such steps has members
        if !case.members.is_none() {
            return None;
        }
        let program = case.program.unwrap_or_else(FixedStepProgram::usual);
        Self::measured(body, program, suites, case.program.is_some(), effort).ok()
    }

    /// Springs for a body, measured on the motions of its suites; if a user asked for this program,
    /// on more synthetic ones that did not choose the springs.
    ///
    /// # Errors
    /// A step that is none; an integrator that is unstable.
    pub fn measured(
        body: &Body<f64>,
        program: FixedStepProgram,
        suites: &Suites,
        asked: bool,
        effort: &Effort,
    ) -> Result<Self, FixedStepSpringsError> {
        let found = Self::at(body, program, suites, asked, effort)?;
        let (median, of_use) = found.peaks();
        if of_use || !asked {
            return Ok(found);
        }
        let measure = |other| {
            let other = Self::at(body, other, suites, asked, effort).ok()?;
            (!effort.stopped()).then(|| other.peaks())
        };
        let lost = found.synthetic.is_some() && median.is_infinite();
        Ok(Self { instead: instead(program, body.p(), (median, lost), measure), ..found })
    }

    /// The median of peaks on the motions where they err most, infinite where nothing was
    /// measured; whether the springs are of use.
    fn peaks(&self) -> (f64, bool) {
        let median = |e: &Option<ErrorsOverMotions>| e.as_ref().map(|e| e.peak_quantile(0.5));
        let medians = [&self.synthetic, &self.earthquakes].map(median);
        let of_use = deciding(medians, self.expected.floor).is_some_and(|(x, _)| x <= USELESS);
        (medians.into_iter().flatten().reduce(f64::max).unwrap_or(f64::INFINITY), of_use)
    }

    /// The same of these settings alone.
    fn at(
        body: &Body<f64>,
        program: FixedStepProgram,
        suites: &Suites,
        asked: bool,
        effort: &Effort,
    ) -> Result<Self, FixedStepSpringsError> {
        let own = design(body, program.step);
        let of = |stance| Self::designed(body, program, FixedStepDesign { stance, ..own });
        let first = Self::designed(body, program, own)?;
        if body.p() * program.step > LONGEST || effort.stopped() {
            return Ok(first);
        }
        let motions = ProgramSuites::of(&first.springs.body, suites, asked, effort);
        let ends_modes = asked && program.integrator.ends_stiff_modes();
        let stiffer = if ends_modes { &STIFFER[..] } else { &[] };
        let mut tried = Vec::new();
        let stances = if asked { &STANCES[..] } else { &STANCES[UNASKED..] };
        for &stance in stiffer.iter().chain(stances) {
            if effort.stopped() {
                break;
            }
            let mut springs = Self { stiffer: STIFFER.contains(&stance), ..of(stance)? };
            springs.synthetic = springs.errors(&motions.synthetic);
            let enough = !asked && springs.will_do();
            tried.push(springs);
            if enough {
                break;
            }
        }
        let mut found = Self::best(tried, &motions.earthquakes, effort).unwrap_or(first);
        if effort.stopped() {
            return Ok(found);
        }
        if found.earthquakes.is_none() {
            found.earthquakes = found.errors(&motions.earthquakes);
        }
        // few of them would tell less than those that chose
        if motions.others.len() >= ALSO_CHOOSE {
            found.synthetic = found.errors(&motions.others);
        }
        Ok(found)
    }

    /// The first springs that [`Self::measured`] tries unasked, in closed form: at once, but not
    /// measured.
    ///
    /// # Errors
    /// As there.
    pub fn preliminary(
        body: &Body<f64>,
        program: FixedStepProgram,
    ) -> Result<Self, FixedStepSpringsError> {
        Self::designed(body, program, design(body, program.step))
    }

    fn designed(
        body: &Body<f64>,
        program: FixedStepProgram,
        design: FixedStepDesign,
    ) -> Result<Self, FixedStepSpringsError> {
        let FixedStepProgram { step, integrator, .. } = program;
        let springs = FixedStepSprings::designed(body, step, integrator, &design)?;
        let expected = springs.expected();
        Ok(Self {
            program,
            springs,
            expected,
            synthetic: None,
            earthquakes: None,
            stiffer: false,
            instead: None,
        })
    }

    /// Whether nearly all synthetic motions come through and err as little as the step allows.
    fn will_do(&self) -> bool {
        self.synthetic.as_ref().is_none_or(|errors| {
            share_lost(errors) <= 1.0 - self.through() && self.over_limit(errors) <= 1.0
        })
    }

    /// The share of motions that it is to get through.
    fn through(&self) -> f64 {
        let ended = self.program.integrator.ends_stiff_modes();
        if ended { THROUGH_IF_ENDED } else { THROUGH }
    }

    /// The median error over the largest acceptable one (`OVER_FLOOR` times the floor).
    fn over_limit(&self, errors: &ErrorsOverMotions) -> f64 {
        errors.quantile(0.5) / (OVER_FLOOR * self.expected.floor)
    }

    /// Of those that will do, and are alike on synthetic motions, the springs whose peaks err least
    /// on earthquake-like ones; of all that will do where these would be of no use; the nearest
    /// where none will do.
    fn best(tried: Vec<Self>, earthquakes: &[ReferenceHistory], effort: &Effort) -> Option<Self> {
        let least = |of: &mut dyn Iterator<Item = &Self>, rank: fn(&Self) -> f64| {
            of.min_by(|a, b| rank(a).total_cmp(&rank(b))).cloned()
        };
        let (mut found, others): (Vec<_>, Vec<_>) = tried.into_iter().partition(Self::will_do);
        let Some(mut best) = least(&mut found.iter(), Self::median) else {
            return least(&mut others.iter(), Self::distance);
        };
        for most in [ALIKE * best.median(), f64::INFINITY] {
            for springs in &mut found {
                if effort.stopped() {
                    return Some(best);
                }
                if springs.median() <= most && springs.earthquakes.is_none() {
                    springs.earthquakes = springs.errors(earthquakes);
                }
            }
            let mut measured = found.iter().filter(|springs| springs.median() <= most);
            best = least(&mut measured, Self::earthquake_peaks).unwrap_or(best);
            if best.peaks().1 {
                break;
            }
        }
        Some(best)
    }

    /// What peaks of earthquake-like motions err, in the median.
    fn earthquake_peaks(&self) -> f64 {
        self.earthquakes.as_ref().map_or(0.0, |errors| errors.peak_quantile(0.5))
    }

    /// What histories of synthetic motions err, in the median.
    fn median(&self) -> f64 {
        self.synthetic.as_ref().map_or(0.0, |errors| errors.quantile(0.5))
    }

    /// How far springs are from what will do: the larger of histories lost and of the median, each
    /// over its limit.
    fn distance(&self) -> f64 {
        self.synthetic.as_ref().map_or(0.0, |errors| {
            (share_lost(errors) / (1.0 - self.through())).max(self.over_limit(errors))
        })
    }

    /// How the program steps on them.
    pub fn settings(&self) -> StepSettings {
        self.program.settings(self.springs.body.lifting_force())
    }

    /// Errors of the springs in the program; none of no motions.
    fn errors(&self, motions: &[ReferenceHistory]) -> Option<ErrorsOverMotions> {
        let springs = &self.springs;
        let model = FixedStepBody::new(&springs.body, &springs.chains());
        let settings = self.settings();
        let all = parallel::map(motions, |motion| motion.errors(&model, settings));
        (!all.is_empty()).then(|| ErrorsOverMotions::of(all))
    }
}

fn share_lost(errors: &ErrorsOverMotions) -> f64 {
    errors.lost() as f64 / errors.count().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixed_steps::{Integrator, ProgramName};
    use rocking::structure::Structure;

    #[test]
    fn a_step_too_long_promises_nothing() {
        let body = Structure::block(0.3, 0.1, 10.0).unwrap().body::<f64>();
        let suites = Suites::of_seed(7, &body, body.restitution(), None);
        let program = FixedStepProgram::of(ProgramName::OpenSees, 1e-2);
        let found =
            ProgramSprings::measured(&body, program, &suites, true, &Effort::unbounded()).unwrap();
        assert!(found.synthetic.is_none() && found.earthquakes.is_none());
        let program = FixedStepProgram { step: 1e-3, ..program };
        let found =
            ProgramSprings::measured(&body, program, &suites, false, &Effort::unbounded()).unwrap();
        assert!(found.synthetic.is_some_and(|errors| errors.count() > 12));
        assert!(found.earthquakes.is_some_and(|errors| errors.count() == 16));
    }

    /// Where a user asks, what springs err is told on motions none of which chose them.
    #[test]
    fn springs_are_told_on_motions_that_did_not_choose_them() {
        let body = Structure::block(0.3, 0.1, 10.0).unwrap().body::<f64>();
        let effort = Effort::unbounded();
        let suites = Suites::of_seed(7, &body, body.restitution(), None);
        let program = FixedStepProgram::of(ProgramName::OpenSees, 1e-3);
        let found = ProgramSprings::measured(&body, program, &suites, true, &effort).unwrap();
        let motions = ProgramSuites::of(&found.springs.body, &suites, true, &effort);
        assert!(motions.others.len() > ALSO_CHOOSE);
        for other in &motions.others {
            assert!(motions.synthetic.iter().all(|chose| chose.accel != other.accel));
        }
        assert_eq!(found.synthetic, found.errors(&motions.others));
        assert_ne!(found.synthetic, found.errors(&motions.synthetic));
        assert_eq!(found.earthquakes, found.errors(&motions.earthquakes));
    }

    /// Where none will do, the springs nearest to it: with an integrator that ends stiff modes 3
    /// motions of 72 lost are four times what may be, a median 5 % over its limit is nearer.
    #[test]
    fn springs_that_lose_motions_are_further_off_than_a_median_just_over_its_limit() {
        let body = Structure::block(0.3, 0.1, 10.0).unwrap().body::<f64>();
        let program =
            FixedStepProgram { integrator: Integrator::Trbdf2, ..FixedStepProgram::usual() };
        let springs = ProgramSprings::preliminary(&body, program).unwrap();
        let with = |over: f64, stopped: usize| {
            let error = over * OVER_FLOOR * springs.expected.floor;
            let errors = vec![error; 72 - stopped];
            let synthetic = ErrorsOverMotions { errors, stopped, ..ErrorsOverMotions::default() };
            ProgramSprings { synthetic: Some(synthetic), ..springs.clone() }
        };
        let tried = vec![with(0.5, 3), with(1.05, 0)];
        assert!(tried.iter().all(|springs| !springs.will_do()));
        let best = ProgramSprings::best(tried, &[], &Effort::unbounded()).unwrap();
        assert_eq!(best.synthetic.unwrap().stopped, 0);
    }
}
