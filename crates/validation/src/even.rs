//! A history in steps of one size beside Housner's.

use super::{
    Validator,
    row::{HistoryEnd, HousnerAnswer},
    stream::{ComparisonObserver, HistorySample},
};
use fixed_steps::{
    FixedStepAnalysis, FixedStepBody, FixedStepModel, FixedStepOutcome, StepSettings,
};
use rocking::housner::topples;

impl Validator {
    /// Step a record as the program does.
    pub(crate) fn follow_even<'a>(
        &'a self,
        answer: &'a HousnerAnswer,
        model: &FixedStepBody,
        settings: StepSettings,
    ) -> (ComparisonObserver<'a>, HistoryEnd) {
        let (dt, accel) = (answer.record.dt, &answer.record.accel[..]);
        let mut stream = ComparisonObserver::new(&self.body, answer.standing(), accel);
        let mut falls = false;
        let analysis = FixedStepAnalysis::new(model, settings, dt, accel);
        let ended = analysis.follow(|index, q| {
            let [u, v, theta] = model.displacement(q);
            let before = if index == 0 { theta } else { stream.last.0 };
            let (velocity, rate) = ([0.0; 2], (theta - before) / dt);
            let mut stands = true;
            model.gaps(q, &Default::default(), |compression, _| stands &= compression > 0.0);
            let sample = HistorySample { place: [u, v], velocity, theta, rate, stands };
            let flow = stream.take(index, &sample);
            falls = flow.is_break();
            flow
        });
        let overturned = match ended {
            Ok((FixedStepOutcome::Finished, _)) => {
                Some(falls || topples(&self.body, stream.last.0, stream.last.1))
            }
            Ok((FixedStepOutcome::Fallen { .. }, _)) => Some(true),
            Ok((FixedStepOutcome::GaveUp(_), _)) | Err(_) => None,
        };
        (stream, HistoryEnd { overturned, energy_residual: None })
    }
}
