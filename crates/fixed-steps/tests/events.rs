//! Steps cut at events: what that leaves as it was, and what it does to a block and a pier that
//! rock.

use dynamics::spring::{Chain, Design, Springs};
use fixed_steps::{
    ConvergenceTest, EventStepping, FixedStepAnalysis, FixedStepBody, FixedStepFrame,
    FixedStepHistory, FixedStepOutcome, Integrator, Iteration, StepSettings,
};
use frames::{
    beam::BeamSection,
    frame::{Cantilever, Footing, StraightMember},
};
use rocking::{
    motion::nrmse,
    structure::{Body, Structure},
};

const DT: f64 = 0.01;

fn block() -> Body<f64> {
    Structure::block(2.6, 0.7, 1e3).unwrap().body()
}

fn units(body: &Body<f64>) -> Springs<Chain> {
    let vertical = Design::from_kc(0.3, 0.1, 0.75, 20.0);
    let horizontal = Design::from_kc(0.3, 0.57, 1.86, 20.0);
    Springs { vertical, horizontal }.chains(body.mass)
}

/// A Ricker wavelet of 7 rad/s about 1 s: 3 s.
fn pulse(peak: f64) -> Vec<f64> {
    let at = |t: f64| {
        let square = (3.5 * (t - 1.0)).powi(2);
        peak * (1.0 - 2.0 * square) * (-square).exp()
    };
    (0..300).map(|i| at(i as f64 * DT)).collect()
}

fn history(peak: f64, integrator: Integrator, step: f64, cut: bool) -> FixedStepHistory {
    let body = block();
    let model = FixedStepBody::new(&body, &units(&body));
    let iteration = Iteration { constant: 0, newton: 30, test: ConvergenceTest::Increment(1e-9) };
    let settings = StepSettings { iteration, ..StepSettings::new(integrator, step) };
    let events = cut.then_some(EventStepping::USUAL);
    let settings = StepSettings { events, ..settings.with_substeps(1.0 / 16.0) };
    FixedStepAnalysis::new(&model, settings, DT, &pulse(peak)).history()
}

/// A motion that lifts no foot has no event: the history is the same to the last bit.
#[test]
fn without_events_nothing_changes() {
    for integrator in [Integrator::HHT_MOST, Integrator::Trbdf2] {
        let [even, cut] = [false, true].map(|cut| history(0.5, integrator, 1e-3, cut));
        assert_eq!(cut.work.events, 0);
        assert_eq!((even.motion.u, even.motion.theta), (cut.motion.u, cut.motion.theta));
    }
}

/// Of a rocking block some steps are cut, and the history comes to that of steps a hundred times as
/// short, which are not cut.
#[test]
fn cut_steps_come_to_the_history_of_short_ones() {
    for integrator in [Integrator::HHT_MOST, Integrator::AVERAGE_ACCELERATION] {
        let short = history(4.5, integrator, 1e-5, false).motion.u;
        let found = history(4.5, integrator, 1e-3, true);
        assert_eq!(found.outcome, FixedStepOutcome::Finished, "{integrator}");
        assert!((3..20).contains(&found.work.events), "{:?}", found.work);
        let error = nrmse(&found.motion.u, &short);
        // p dt: steps that are not cut err by 13 of these
        let least = block().p_squared().sqrt() * 1e-3;
        assert!(error < least, "{integrator}: {error}, {least}");
    }
}

/// The same of an elastic pier: its top.
#[test]
fn cut_steps_of_a_pier_come_to_the_history_of_short_ones() {
    let section = BeamSection { bending_damping: 1e8, ..BeamSection::elastic(1e10, 4e10) };
    let footing = Footing::block(4.0, 1.2e5, 0.75, 0.75);
    let column = StraightMember { section, elements: 1 };
    let (mass, height) = (6e5, 12.0);
    let pier = Cantilever { mass, inertia: None, height, footing, column, consistent: false };
    let frame = pier.layout().frame().unwrap();
    let unit = Design::from_kc(0.3, 0.1, 0.75, 20.0);
    let units = vec![Springs { vertical: unit, horizontal: unit }.chains(1.2e5); 2];
    let model = FixedStepFrame::new(&frame, &units).unwrap();
    let iteration = Iteration { constant: 0, newton: 30, test: ConvergenceTest::Increment(1e-7) };
    let top = |step: f64, events: Option<EventStepping>| {
        let settings = StepSettings::new(Integrator::HHT_MOST, step);
        let settings = StepSettings { iteration, events, ..settings };
        let found = FixedStepAnalysis::new(&model, settings, DT, &pulse(4.5)).history().unwrap();
        assert_eq!(found.outcome, FixedStepOutcome::Finished);
        let u: Vec<f64> = found.coordinates.iter().map(|q| frame.displacement(1, q)[0]).collect();
        (u, found.work.events)
    };
    let (found, events) = top(1e-3, Some(EventStepping::USUAL));
    assert!(events > 2, "{events}");
    let error = nrmse(&found, &top(5e-5, None).0);
    assert!(error < 5e-3, "{error}");
}
