//! Whether springs are of use in a program with fixed time steps, and what to do if they are not.

use super::{ProgramErrors, ProgramExpected, ProgramRow};
use fixed_steps::{ProgramName, expected::FLOOR};
use results::{NotToBeUsed, ProgramAdvice, ProgramFault};
use springs::fixed_steps::{
    LONGEST,
    instead::{NO_PEAK, ProgramInstead, USELESS, deciding, round_step, usually_another},
};

/// Times the floor above which an error is not the step's: no law tells which step it takes.
const OFF_LAW: f64 = 10.0;

impl<U> ProgramRow<U> {
    /// The same with what is wrong with its springs, if something is.
    #[doc(hidden)]
    #[must_use]
    pub fn judged(self) -> Self {
        Self { not_to_be_used: self.not_to_be_used(), ..self }
    }

    /// Whether the springs are of no use, why, and what to do, which can be printed.
    pub fn not_to_be_used(&self) -> Option<NotToBeUsed> {
        let fault = self.fault()?;
        Some(NotToBeUsed { fault, advice: self.advice(fault) })
    }

    /// What is wrong with them, if they are of no use: on the set of motions where they err most,
    /// or on the record where it can be predicted and errs more. Where earthquake-like motions do
    /// not count ([`deciding`]) what they err there is a warning.
    fn fault(&self) -> Option<ProgramFault> {
        let ProgramExpected { synthetic, earthquakes, floor, .. } = self.expected;
        let median = |errors: ProgramErrors| errors.peak[0].unwrap_or(f64::INFINITY);
        let medians = [synthetic, earthquakes].map(|errors| errors.map(median));
        let Some((median, like_earthquakes)) = deciding(medians, floor) else {
            return (floor > FLOOR * LONGEST).then_some(ProgramFault::TooLong { floor });
        };
        let errors = if like_earthquakes { earthquakes } else { synthetic }?;
        let (lost, motions) = (errors.lost, errors.histories);
        if median.is_infinite() {
            return Some(ProgramFault::Lost { lost, motions });
        }
        let on = self.on_record.filter(|on| on.predictable != Some(false));
        let on_record = on.and_then(|on| {
            let top = on.top.filter(|top| top.abs() > median.max(USELESS))?;
            Some(ProgramFault::OnRecord { top, until_s: on.until_s })
        });
        let on_motions = ProgramFault::Peaks { median, motions, earthquakes: like_earthquakes };
        on_record.or((median > USELESS).then_some(on_motions))
    }

    /// What springs that are of use err on earthquake-like motions, if that is much.
    #[doc(hidden)]
    pub fn errs_on_earthquakes(&self) -> Option<ProgramErrors> {
        let errors = self.expected.earthquakes.filter(|_| self.not_to_be_used().is_none())?;
        errors.peak[0].is_none_or(|median| median > USELESS).then_some(errors)
    }

    /// The errors of springs that are of use on the motions where one in ten errs by more than 30 %
    /// in the largest displacement; whether these are like earthquakes. None where peaks on those
    /// err much in the median, which is told.
    #[doc(hidden)]
    pub fn spreads(&self) -> Option<(ProgramErrors, bool)> {
        let ProgramExpected { synthetic, earthquakes, .. } = self.expected;
        let earthquakes = earthquakes.filter(|_| self.errs_on_earthquakes().is_none());
        let all = [(synthetic, false), (earthquakes, true)];
        let mut all = all.into_iter().filter_map(|(errors, like)| Some((errors?, like)));
        let wide = |(errors, _): &(ProgramErrors, bool)| {
            errors.peak[0].is_some() && errors.peak[1].is_some_and(|most| most > NO_PEAK)
        };
        all.find(wide).filter(|_| self.not_to_be_used().is_none())
    }

    /// What to do about it: what was measured, if something was; else by the law of the floor, by
    /// which errors are taken to grow as the step does, where they are not far above it.
    fn advice(&self, fault: ProgramFault) -> ProgramAdvice {
        let by_law = self.step_s * USELESS / self.expected.floor;
        let step = |error: f64| ProgramAdvice::Step {
            step_s: round_step(by_law.min(self.step_s * USELESS / error)),
        };
        let too_long = self.step_s > by_law;
        let usual = usually_another(self.name, self.integrator).filter(|_| !too_long);
        match (fault, self.expected.instead) {
            _ if self.without_deck => ProgramAdvice::OtherDeck,
            (_, Some(ProgramInstead::Helps { usual_of: Some(name), median, .. })) => {
                ProgramAdvice::MeasuredIntegrator { give_for: self.give_for(name), median }
            }
            (_, Some(ProgramInstead::Helps { step_s, median, .. })) => {
                ProgramAdvice::MeasuredStep { step_s, median }
            }
            (_, Some(ProgramInstead::NoneDoes { shortest_s })) => {
                ProgramAdvice::NoneHelps { shortest_s }
            }
            (ProgramFault::Lost { .. }, _) if too_long => step(USELESS),
            _ if usual.is_some_and(|name| self.give_for(name)) => ProgramAdvice::ForOpenSees,
            _ if usual.is_some() => ProgramAdvice::DefaultIntegrator,
            (ProgramFault::Lost { .. }, _) => ProgramAdvice::AnotherStep,
            (ProgramFault::OnRecord { .. }, _) if !too_long => ProgramAdvice::AnotherStep,
            (
                ProgramFault::Peaks { median: error, .. }
                | ProgramFault::OnRecord { top: error, .. }
                | ProgramFault::TooLong { floor: error },
                _,
            ) => {
                let times = error.abs() / self.expected.floor;
                if times > OFF_LAW { ProgramAdvice::OffLaw { times } } else { step(error.abs()) }
            }
        }
    }

    /// Whether a program has to be named to have its usual integrator: one without a name has
    /// SAP2000's.
    fn give_for(&self, name: ProgramName) -> bool {
        self.name.is_none() && name == ProgramName::OpenSees
    }
}
