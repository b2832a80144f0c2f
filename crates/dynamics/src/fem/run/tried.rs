//! What becomes of a step that was tried: it is accepted, refused, or repeated to find the event
//! within it.

use std::f64::consts::FRAC_PI_2;

use super::{
    TimeLoop,
    account::{Contacts, StepMeasures},
    events::{Located, Locating},
    met::StepEvent,
};
use crate::fem::{control::HistoryOutcome, model::TH, observer::Observer, step::Stages};

impl TimeLoop<'_> {
    /// Take note of a step that was tried: accept it, refuse it, or ask for the same step with the
    /// size that is returned, to find the event within it. `measures` are its own, if known.
    pub(crate) fn process_step(
        &mut self,
        converged: bool,
        stages: &mut Stages,
        measures: Option<&StepMeasures>,
        observer: &mut dyn Observer,
    ) -> Result<Option<f64>, HistoryOutcome> {
        if converged {
            self.work.iterations += stages.iterations;
        }
        if let Some(span) = self.spanning.take() {
            self.tried_span(&span, converged, stages, measures, observer)?;
            return Ok(None);
        }
        let h = stages.h;
        if let Some(mut event) = self.locating {
            match self.locate(&mut event, converged, stages) {
                Located::Next(size) => {
                    self.locating = Some(event);
                    return Ok(Some(size));
                }
                // nearer to the event, the step that ends there is easier
                Located::Nowhere => self.refuse(event.whole * event.tau * 0.5),
                Located::Here { changes } => {
                    let met = if changes { event.met() } else { StepEvent::Nothing };
                    self.accept(stages, measures, &met, observer)?;
                }
            }
            return Ok(None);
        }
        if !converged {
            self.refuse(h * 0.25);
            return Ok(None);
        }
        let mut measures = measures;
        let mut met = self.met(stages, measures.map_or(&Contacts::Unknown, |m| &m.contacts));
        if let StepEvent::Grip { foot, tau } = met {
            if !self.locate_grip(foot, tau, stages) {
                self.refuse(h * tau * 0.5);
                return Ok(None);
            }
            // where it changes was but estimated: a foot may touch or leave the ground before
            met = self.crosses(stages, &Contacts::Unknown).or(met);
            measures = None;
        }
        match met {
            StepEvent::Unresolved => self.refuse(h * 0.25),
            StepEvent::Crossing { foot, level, tau } => {
                let event = Locating::new(foot, level, (stages.h, tau));
                let size = event.h;
                self.locating = Some(event);
                return Ok(Some(size));
            }
            StepEvent::Nothing | StepEvent::Grip { .. } => {
                self.accept(stages, measures, &met, observer)?
            }
        }
        Ok(None)
    }

    /// Book the step, if it is accurate enough, and change the contact that changes at its end.
    fn accept(
        &mut self,
        stages: &Stages,
        measures: Option<&StepMeasures>,
        met: &StepEvent,
        observer: &mut dyn Observer,
    ) -> Result<(), HistoryOutcome> {
        let measured = measures.copied().unwrap_or_else(|| self.measure(stages));
        if !self.account(stages, &measured) {
            self.work.rejected += 1;
            return Ok(());
        }
        self.t += stages.h;
        let t0 = self.start_of_interval();
        if self.state.q[TH].abs() > FRAC_PI_2 {
            return Err(HistoryOutcome::Overturned { time: t0 + self.t });
        }
        let time = t0 + self.t;
        observer.step(&self.view(time));
        match *met {
            StepEvent::Crossing { foot, level, .. } => {
                (self.turns, self.event_by) = (0, usize::MAX);
                self.switch(foot, level, time, observer);
            }
            StepEvent::Grip { foot, .. } => self.change_grip(foot, time, observer),
            StepEvent::Nothing | StepEvent::Unresolved => {}
        }
        Ok(())
    }

    /// Count a step that did not converge; try again with size h (s).
    pub(super) fn refuse(&mut self, h: f64) {
        self.work.rejected += 1;
        self.rate = 1.0;
        self.h = h;
    }
}
