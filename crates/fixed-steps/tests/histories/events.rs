//! Steps cut at events: what that leaves as it was, and what it does to a block and a pier that
//! rock.

use dynamics::spring::{Design, Springs};
use fixed_steps::{
    EventStepping, FixedStepAnalysis, FixedStepBody, FixedStepFrame, FixedStepHistory,
    FixedStepOutcome, Integrator, StepSettings,
};
use rocking::motion::nrmse;

use crate::common::{DT, block, newton, pier, pulse, units};

fn history(peak: f64, integrator: Integrator, step: f64, cut: bool) -> FixedStepHistory {
    let body = block();
    let model = FixedStepBody::new(&body, &units(body.mass, 20.0));
    let settings = newton(integrator, step, 1e-9);
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
        let least = block().p() * 1e-3;
        assert!(error < least, "{integrator}: {error}, {least}");
    }
}

/// The same of an elastic pier: its top.
#[test]
fn cut_steps_of_a_pier_come_to_the_history_of_short_ones() {
    let frame = pier(1e8);
    let unit = Design::from_kc(0.3, 0.1, 0.75, 20.0);
    let units = vec![Springs { vertical: unit, horizontal: unit }.chains(1.2e5); 2];
    let model = FixedStepFrame::new(&frame, &units).unwrap();
    let top = |step: f64, events: Option<EventStepping>| {
        let settings = StepSettings { events, ..newton(Integrator::HHT_MOST, step, 1e-7) };
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
