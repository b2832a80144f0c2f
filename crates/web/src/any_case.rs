//! A case of either kind, from its text.

use std::sync::{Arc, Mutex, PoisonError};

use crate::WebError;
use cases::{Case, CaseError, ElasticCase, Objective};
use rocking::structure::Body;
use springs::landing_simulation::differs_from_housner;
use strong_motion::{Notice, excitation::Excitation};

/// How the case file is called, in messages and by whoever saves it.
const NAME: &str = "case.toml";

/// What is to be computed.
pub(crate) enum AnyCase {
    Rigid(Box<Case>),
    Elastic(Box<ElasticCase>),
}

/// The last case with its text: charts ask for the same one again and again.
static LAST: Mutex<Option<(String, Arc<AnyCase>)>> = Mutex::new(None);

/// Records have changed.
pub(crate) fn forget() {
    *LAST.lock().unwrap_or_else(PoisonError::into_inner) = None;
}

/// Who gives a file to a page has no line of a case file that names it.
fn of_record(error: CaseError) -> CaseError {
    match error {
        CaseError::OfRecord { source, .. } => CaseError::Record(source),
        other => other,
    }
}

impl AnyCase {
    /// From a case file's text; its record is one of the files given, or El Centro.
    pub(crate) fn of(text: &str) -> Result<Arc<Self>, WebError> {
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, case)) = last.as_ref().filter(|(known, _)| known == text) {
            return Ok(case.clone());
        }
        let case = Arc::new(Self::parsed(text)?);
        *last = Some((text.to_string(), case.clone()));
        Ok(case)
    }

    fn parsed(text: &str) -> Result<Self, WebError> {
        if ElasticCase::is(text) {
            return Ok(Self::Elastic(Box::new(ElasticCase::parse(NAME, text).map_err(of_record)?)));
        }
        let case = Case::parse(NAME, text).map_err(of_record)?;
        // settings whose search reads the clock, which wasm does not have, or takes minutes
        let refused = [
            ("tuning.objective = \"arr\"", case.tuning.objective == Objective::Arr),
            ("tuning.max_omega_hz", case.tuning.max_omega_hz.is_some()),
            (
                "structure.restitution",
                differs_from_housner(&case.structure.body(), case.restitution),
            ),
        ];
        match refused.into_iter().find(|(_, is)| *is) {
            Some((key, _)) => Err(WebError::ForTheProgram { key }),
            None => Ok(Self::Rigid(Box::new(case))),
        }
    }

    pub(crate) fn excitation(&self) -> &Excitation {
        match self {
            Self::Rigid(case) => &case.excitation,
            Self::Elastic(case) => &case.excitation,
        }
    }

    pub(crate) fn notices(&self) -> &[Notice] {
        match self {
            Self::Rigid(case) => &case.notices,
            Self::Elastic(case) => &case.notices,
        }
    }

    /// The rigid body, of an elastic structure that of the same masses.
    pub(crate) fn body(&self) -> Body<f64> {
        match self {
            Self::Rigid(case) => case.structure.body(),
            Self::Elastic(case) => case.structure.body(),
        }
    }
}
