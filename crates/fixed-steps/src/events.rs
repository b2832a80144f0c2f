//! Event-to-event stepping: a step is cut where a gap opens or closes.
//!
//! ```text
//!   trial of size h from the last step's end, every contact held as it was there
//!   d_i0, d_i1   compression of gap i at its begin and at its end
//!   s            least d_i0/(d_i0 - d_i1) of the gaps that change sign: the part up to the first event
//! ```
//!
//! The trial is repeated with the part s, and s found again between the longest trial without an
//! event and the shortest with one, until it ends within `lumping` h of the event. There the step
//! holds, the contact changes, and what is left of the step follows. A gap whose own event lies
//! within `lumping` h of the first one changes with it.
//!
//! CSI's help ("Solution Control": load steps are subdivided where the stiffness of nonlinear
//! elements changes; "Event Lumping Tolerance": events closer together than this count as one) and
//! a public generator of SAP2000's tables (event lumping 0.01) say that much. How often such a
//! program repeats a trial, the most events in a step and the shortest part are not from there.

use crate::{
    contact::FixedFoot,
    integrator::Integrator,
    iteration::{Iterates, Iteration},
    kinematics::{Kinematics, StepKinematics},
    model::FixedStepModel,
};

/// How steps are cut at events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventStepping {
    /// Part of a step by which the end of a substep may miss its event, and within which events
    /// count as one.
    pub lumping: f64,
    /// At most so many events in a step: what is left of it is taken with the usual iteration.
    pub most: usize,
    /// The shortest substep that an event makes, as a part of the step: if one lies nearer, what is
    /// left of the step is taken with the usual iteration.
    pub least: f64,
}

/// Trials of a substep until it ends at its event, at most: gaps are all but straight in a step.
const TRIALS: usize = 12;

impl EventStepping {
    /// Lumping 0.01, at most 24 events in a step, no substep below a sixteenth of it: the smallest
    /// that such a program is set to (`program::SUBSTEPS`).
    pub const USUAL: Self = Self { lumping: 0.01, most: 24, least: 1.0 / 16.0 };
}

impl Default for EventStepping {
    fn default() -> Self {
        Self::USUAL
    }
}

/// What a search for the first event of a step has found.
pub(crate) enum FirstEvent<V> {
    /// A substep that arrived, its contacts held.
    Substep {
        step: StepKinematics<V>,
        /// The contacts that change at its end: none if no event ends it.
        changing: Vec<usize>,
    },
    /// None that could be taken.
    Unclear,
}

/// What a trial has shown.
struct HeldTrial {
    size: f64,
    /// Compression of every gap at its end (m).
    gaps: Vec<f64>,
}

/// What a search needs.
pub(crate) struct EventSearch<'a, M: FixedStepModel> {
    pub model: &'a M,
    pub events: EventStepping,
    pub iteration: &'a Iteration,
    pub integrator: &'a Integrator,
    /// Size of a whole step (s).
    pub whole: f64,
}

impl<M: FixedStepModel> EventSearch<'_, M> {
    fn gaps(&self, q: &M::Vector, v: &M::Vector) -> Vec<f64> {
        let mut all = Vec::new();
        self.model.gaps(q, v, |d, _| all.push(d));
        all
    }

    /// Step `size` from `motion`, or up to its first event. A substep that is found is left in
    /// `iterates` and `feet`, which are held until [`end_substep`]; else `feet` are as they were.
    /// `ground`: its acceleration at a time from the begin (m/s2).
    pub(crate) fn first(
        &self,
        size: f64,
        motion: &Kinematics<M::Vector>,
        feet: &mut M::Feet,
        iterates: &mut Iterates<M>,
        ground: impl Fn(f64) -> [f64; 2],
    ) -> FirstEvent<M::Vector> {
        let lumped = self.events.lumping * self.whole;
        let begin = HeldTrial { size: 0.0, gaps: self.gaps(&motion.q, &motion.v) };
        let (mut before, mut after) = (begin, None::<HeldTrial>);
        let mut tried = size;
        for _ in 0..TRIALS {
            feet.as_mut().iter_mut().for_each(FixedFoot::hold);
            let step = motion.step(self.integrator, tried);
            let at = ground(step.forces_at());
            if !iterates.arrives(self.model, self.iteration, motion, &step, feet, at) {
                break;
            }
            let trial = HeldTrial { size: tried, gaps: self.end_gaps(motion, iterates) };
            match first_crossing(feet, &before, &trial) {
                // at the end of the whole step, or beyond the event by no more than what counts
                // as the same
                Some(at) if trial.size - at <= lumped => {
                    let changing = changing(feet, &before, &trial, lumped);
                    return FirstEvent::Substep { step, changing };
                }
                Some(at) => {
                    tried = at;
                    after = Some(trial);
                }
                None => {
                    let Some(end) = &after else {
                        return FirstEvent::Substep { step, changing: Vec::new() };
                    };
                    let Some(at) = first_crossing(feet, &trial, end) else { break };
                    if at - trial.size <= lumped {
                        let changing = changing(feet, &trial, end, lumped);
                        return FirstEvent::Substep { step, changing };
                    }
                    tried = at;
                    before = trial;
                }
            }
            feet.as_mut().iter_mut().for_each(FixedFoot::revert);
            if tried < self.events.least * self.whole {
                break;
            }
        }
        feet.as_mut().iter_mut().for_each(|foot| {
            foot.release();
            foot.revert();
        });
        FirstEvent::Unclear
    }

    fn end_gaps(&self, motion: &Kinematics<M::Vector>, iterates: &Iterates<M>) -> Vec<f64> {
        let mut q = motion.q.clone();
        for (q, by) in q.as_mut().iter_mut().zip(iterates.change.as_ref()) {
            *q += by;
        }
        self.gaps(&q, &motion.v)
    }
}

/// The substep is taken: these contacts change, and all follow their gaps again.
pub(crate) fn end_substep<F: AsMut<[FixedFoot]>>(feet: &mut F, changing: &[usize]) {
    for (i, foot) in feet.as_mut().iter_mut().enumerate() {
        if changing.contains(&i) {
            foot.change();
        }
        foot.release();
    }
}

/// The contacts that change at the first event between two trials, and those that count as the
/// same event.
fn changing<F: AsRef<[FixedFoot]>>(
    feet: &F,
    before: &HeldTrial,
    after: &HeldTrial,
    lumped: f64,
) -> Vec<usize> {
    let first = first_crossing(feet, before, after).unwrap_or(f64::NEG_INFINITY);
    let near = |(i, foot): (usize, &FixedFoot)| {
        crossing(foot, i, before, after).is_some_and(|own| own - first <= lumped).then_some(i)
    };
    feet.as_ref().iter().enumerate().filter_map(near).collect()
}

/// When the gap of a foot changes sign between two trials, on a straight line (s from the begin of
/// both); at the first if it is on the wrong side there already.
fn crossing(foot: &FixedFoot, i: usize, before: &HeldTrial, after: &HeldTrial) -> Option<f64> {
    let (&d0, &d1) = before.gaps.get(i).zip(after.gaps.get(i))?;
    let wrong = |d: f64| foot.was_closed() != (d >= 0.0);
    wrong(d1).then(|| {
        let part = if wrong(d0) { 0.0 } else { d0 / (d0 - d1) };
        before.size + part * (after.size - before.size)
    })
}

fn first_crossing<F: AsRef<[FixedFoot]>>(
    feet: &F,
    before: &HeldTrial,
    after: &HeldTrial,
) -> Option<f64> {
    let all = feet.as_ref().iter().enumerate();
    all.filter_map(|(i, foot)| crossing(foot, i, before, after)).min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{iteration::ConvergenceTest, kinematics::MemberDamping, rigid::FixedStepBody};
    use approx::assert_relative_eq;
    use dynamics::spring::{Chain, Design, Springs};
    use rocking::{scalar::GRAVITY, structure::Structure};

    const STEP: f64 = 0.01;
    const ALL: [Integrator; 4] = [
        Integrator::HHT_MOST,
        Integrator::AVERAGE_ACCELERATION,
        Integrator::Trbdf2,
        Integrator::BackwardEuler,
    ];

    fn springs(mass: f64) -> Springs<Chain> {
        let unit = Design::from_kc(0.3, 0.1, 0.75, 20.0);
        Springs { vertical: unit, horizontal: unit }.chains(mass)
    }

    /// The first event of a step of a block in the air, this high and turning so (m, m/s, rad/s).
    fn first(integrator: Integrator, [high, falls, turns]: [f64; 3]) -> Option<(f64, Vec<usize>)> {
        let body = Structure::block(2.6, 0.7, 1e3).unwrap().body::<f64>();
        let model = FixedStepBody::new(&body, &springs(body.mass));
        let q = [0.0, high, 0.0, 0.0, 0.0, 0.0, 0.0];
        let v = [0.0, -falls, turns, 0.0, 0.0, 0.0, 0.0];
        let a = [0.0, -GRAVITY, 0.0, 0.0, 0.0, 0.0, 0.0];
        let motion = Kinematics::moving(q, v, a);
        let mut feet = [FixedFoot::new(false, 0.0); 2];
        let iteration =
            Iteration { constant: 0, newton: 30, test: ConvergenceTest::Increment(1e-12) };
        let search = EventSearch {
            model: &model,
            events: EventStepping::USUAL,
            iteration: &iteration,
            integrator: &integrator,
            whole: STEP,
        };
        let mut iterates = Iterates::new(&model, &q, MemberDamping::OfVelocities);
        match search.first(STEP, &motion, &mut feet, &mut iterates, |_| [0.0; 2]) {
            FirstEvent::Substep { step, changing } => Some((step.size, changing)),
            FirstEvent::Unclear => None,
        }
    }

    /// h = v t + g t^2/2: both feet touch at once, within the tolerance of the closed form.
    #[test]
    fn a_falling_block_touches_when_the_closed_form_says() {
        let lumped = EventStepping::USUAL.lumping * STEP;
        for integrator in ALL {
            for part in [0.07, 0.2, 0.5, 0.77, 0.985, 0.999] {
                let (t, falls) = (part * STEP, 0.4);
                let high = falls * t + 0.5 * GRAVITY * t * t;
                let (size, changing) = first(integrator, [high, falls, 0.0]).unwrap();
                assert!((size - t).abs() <= lumped, "{integrator}, {part}: {size}, {t}");
                assert_eq!(changing, [0, 1], "{integrator}, {part}");
            }
            // beyond the step: all of it, and nothing changes
            let high = 1.01 * (0.4 * STEP + 0.5 * GRAVITY * STEP * STEP);
            assert_eq!(first(integrator, [high, 0.4, 0.0]), Some((STEP, vec![])));
            // nearer than the shortest substep: left to the usual iteration
            assert_eq!(first(integrator, [0.4 * 0.03 * STEP, 0.4, 0.0]), None);
        }
    }

    /// A turning block touches with one foot: h - v t - g t^2/2 + b sin(w t) (right) and the same
    /// with -b (left) are zero at that foot's own time; together if these differ by less than the
    /// tolerance.
    #[test]
    fn of_two_feet_the_first_one_ends_the_substep() {
        let lumped = EventStepping::USUAL.lumping * STEP;
        for integrator in ALL {
            for (turns, own) in [(0.4, vec![1]), (-0.4, vec![0]), (4e-4, vec![0, 1])] {
                let (high, falls) = (3e-3, 0.4);
                let below = |t: f64| {
                    let turned = f64::abs(turns) * t;
                    let sinks = falls * t + 0.5 * GRAVITY * t * t + 0.35 * turned.sin();
                    sinks - 1.3 * (1.0 - turned.cos()) - high
                };
                let (mut low, mut top) = (0.0, STEP);
                for _ in 0..60 {
                    let middle = 0.5 * (low + top);
                    if below(middle) > 0.0 { top = middle } else { low = middle }
                }
                let (size, changing) = first(integrator, [high, falls, turns]).unwrap();
                assert!((size - low).abs() <= lumped, "{integrator}, {turns}: {size}, {low}");
                assert_eq!(changing, own, "{integrator}, {turns}");
            }
        }
    }

    /// A foot that is held keeps its state, pulls, and changes only when told.
    #[test]
    fn a_held_foot_is_as_it_was() {
        let units = springs(1e3);
        let mut foot = FixedFoot::new(true, 0.0);
        foot.hold();
        foot.meet(&units, -1e-3, 2e-3);
        let [h, n] = foot.force(&units, -1e-3, 2e-3);
        assert_relative_eq!(n, -1e-3 * units.vertical.k1, max_relative = 1e-12);
        assert_relative_eq!(h, -2e-3 * units.horizontal.k1, max_relative = 1e-12);
        let mut feet = [foot];
        end_substep(&mut feet, &[0]);
        assert!(!feet[0].closed && feet[0].has_changed());
        feet[0].meet(&units, 1e-3, 0.0);
        assert!(feet[0].closed);
    }
}
