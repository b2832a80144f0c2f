//! Springs of a sweep's structures, tuned once a geometry.
//!
//! By similarity the design depends on alpha, m R^2/I0, e and Omega_n/p alone. So of the structures
//! that share the first three the largest is tuned, whose p is least and for which earthquakes are
//! fastest in units of p; the others take its Omega_n/p.

use std::{io::ErrorKind, path::Path};

use serde::{Deserialize, Serialize};

use super::{SweepError, manifest, plan::Plan};
use cases::{Case, Tuning};
use dynamics::spring::{Chain, Design, Springs};
use files::{
    input,
    message::{one_line, significant},
};
use springs::job::Job;
use strong_motion::{Record, excitation::Excitation, fnv1a};

/// A chain without units; its Omega_n over p.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct DimensionlessChain {
    mu: f64,
    f: f64,
    xi: f64,
    omega_n_hz_over_p: f64,
}

/// The springs of one geometry and restitution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct TunedSprings {
    alpha: f64,
    mass_share: f64,
    restitution: f64,
    /// The structure that was tuned, and the error asked for.
    tuned_on: String,
    accuracy: f64,
    /// Whether what was measured there is within it.
    reached: bool,
    vertical: DimensionlessChain,
    horizontal: DimensionlessChain,
}

impl TunedSprings {
    /// That they do not reach the accuracy.
    fn doubt(&self) -> String {
        format!(
            "springs for restitution {}, tuned on {}: they do not reach the accuracy of {}; ask \
             for less (accuracy under [springs]), or allow stiffer ones (max_omega_hz)",
            significant(self.restitution, 4),
            self.tuned_on,
            self.accuracy
        )
    }
}

/// `springs.json`: of a sweep, in the order in which its geometries come.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Filed {
    sweep: String,
    /// FNV-1a of the springs as they are written: nobody's hand, and no damage, makes others of
    /// them.
    checksum: String,
    springs: Vec<TunedSprings>,
}

impl Filed {
    fn checksum(springs: &[TunedSprings]) -> Result<String, SweepError> {
        Ok(format!("{:016x}", fnv1a(manifest::json("springs.json", &springs)?.bytes())))
    }
}

/// Springs with units of every structure and restitution.
#[derive(Clone, Debug)]
pub struct SpringsTable {
    chains: Vec<Springs<Chain>>,
    restitutions: usize,
    /// The springs that do not reach the accuracy: which, and what to do, a line each.
    pub missed: Vec<String>,
}

/// What springs depend on, to nine digits.
#[derive(Clone, PartialEq)]
struct SpringsKey([String; 3]);

impl SpringsKey {
    fn new(plan: &Plan, subject: usize, restitution: usize) -> Self {
        let body = &plan.subjects[subject].body;
        Self(
            [body.alpha(), body.mass_share(), plan.restitution(subject, restitution)]
                .map(|x| format!("{x:.8e}")),
        )
    }
}

impl SpringsTable {
    /// The springs of a sweep's folder: those in `springs.json`, else tuned now and put there.
    /// `progress`: geometries done, of how many.
    ///
    /// # Errors
    /// A structure that cannot be tuned; a file that cannot be read or written.
    pub fn new(
        plan: &Plan,
        folder: &Path,
        hash: &str,
        progress: &dyn Fn(usize, usize),
    ) -> Result<Self, SweepError> {
        if let Some(springs) = Self::read(plan, folder, hash)? {
            return Ok(springs);
        }
        let springs = tune(plan, progress)?;
        let filed = Filed { sweep: hash.into(), checksum: Filed::checksum(&springs)?, springs };
        let path = folder.join("springs.json");
        manifest::whole(&path, manifest::json("springs.json", &filed)?.as_bytes())?;
        // what is read back is what every later run will read
        Self::read(plan, folder, hash)?.ok_or_else(|| damaged(&path, "cannot be read back"))
    }

    /// The springs in a folder's `springs.json`, if it is there.
    ///
    /// # Errors
    /// It cannot be read, is damaged, or is of another sweep.
    pub fn read(plan: &Plan, folder: &Path, hash: &str) -> Result<Option<Self>, SweepError> {
        let path = folder.join("springs.json");
        let text = match input::text(&path) {
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            text => text
                .map_err(|source| SweepError::File { path: path.display().to_string(), source })?,
        };
        let filed: Filed =
            serde_json::from_str(&text).map_err(|e| damaged(&path, &one_line(&e.to_string())))?;
        if filed.sweep != hash || filed.checksum != Filed::checksum(&filed.springs)? {
            return Err(damaged(&path, "holds other springs than those that tune sweep tuned"));
        }
        let springs = Self::of_filed(plan, &filed);
        springs.map(Some).ok_or_else(|| damaged(&path, "springs are missing"))
    }

    fn of_filed(plan: &Plan, filed: &Filed) -> Option<Self> {
        let keys = keys(plan);
        let mut chains = Vec::new();
        for subject in 0..plan.subjects.len() {
            for restitution in 0..plan.restitution_count() {
                let key = SpringsKey::new(plan, subject, restitution);
                let tuned =
                    filed.springs.get(keys.iter().position(|(other, ..)| *other == key)?)?;
                let subject = &plan.subjects[subject];
                let design = |unit: &DimensionlessChain| Design {
                    mu: unit.mu,
                    f: unit.f,
                    xi: unit.xi,
                    omega_n_hz: unit.omega_n_hz_over_p * subject.p,
                };
                let springs = Springs {
                    vertical: design(&tuned.vertical),
                    horizontal: design(&tuned.horizontal),
                };
                chains.push(springs.chains(subject.structure.mass_kg));
            }
        }
        let missed = filed.springs.iter().filter(|tuned| !tuned.reached);
        Some(Self {
            chains,
            restitutions: plan.restitution_count(),
            missed: missed.map(TunedSprings::doubt).collect(),
        })
    }

    /// The springs of a structure with a restitution of the plan.
    pub(crate) fn of(&self, subject: usize, restitution: usize) -> Springs<Chain> {
        self.chains[subject * self.restitutions + restitution]
    }
}

fn damaged(path: &Path, reason: &str) -> SweepError {
    SweepError::Damaged { path: path.display().to_string(), reason: reason.into() }
}

/// Every geometry with its largest structure, as they first appear.
fn keys(plan: &Plan) -> Vec<(SpringsKey, usize, usize)> {
    let mut keys: Vec<(SpringsKey, usize, usize)> = Vec::new();
    for subject in 0..plan.subjects.len() {
        for restitution in 0..plan.restitution_count() {
            let key = SpringsKey::new(plan, subject, restitution);
            match keys.iter_mut().find(|(other, ..)| *other == key) {
                Some((_, largest, _)) if plan.subjects[subject].p < plan.subjects[*largest].p => {
                    *largest = subject
                }
                Some(_) => {}
                None => keys.push((key, subject, restitution)),
            }
        }
    }
    keys
}

fn tune(plan: &Plan, progress: &dyn Fn(usize, usize)) -> Result<Vec<TunedSprings>, SweepError> {
    let keys = keys(plan);
    let mut all = Vec::new();
    for (done, (_, subject, restitution)) in keys.iter().enumerate() {
        progress(done, keys.len());
        let e = plan.restitution(*subject, *restitution);
        let subject = &plan.subjects[*subject];
        // no record: nothing is tuned to one
        let still = Record::new("none", 0.01, vec![0.0; 2])?;
        let tuning = Tuning {
            accuracy: plan.springs.accuracy,
            max_omega_hz: plan.springs.max_omega_hz,
            ..Tuning::default()
        };
        let case = Case::new("sweep", (subject.structure, e), Excitation::whole(still), tuning)?;
        let job = Job::new(&case, &|_, _, _| {})
            .map_err(|source| SweepError::Springs { structure: subject.name.clone(), source })?;
        let unit = |design: &Design<f64>| DimensionlessChain {
            mu: design.mu,
            f: design.f,
            xi: design.xi,
            omega_n_hz_over_p: design.omega_n_hz / subject.p,
        };
        all.push(TunedSprings {
            alpha: subject.alpha,
            mass_share: subject.body.mass_share(),
            restitution: e,
            tuned_on: subject.name.clone(),
            accuracy: plan.springs.accuracy,
            reached: job.tuned.best.errors.histories.reaches(plan.springs.accuracy),
            vertical: unit(&job.springs.vertical),
            horizontal: unit(&job.springs.horizontal),
        });
    }
    progress(keys.len(), keys.len());
    Ok(all)
}
