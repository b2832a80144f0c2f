//! Whether the numbers of a file of parameters can be.

use super::{Parameters, ParametersError, RecordRow};
use rocking::scalar::GRAVITY;

/// Stiffness that a spring may have, in units of the weight over the height: softer ones let the
/// body sink in by a thousand times its height, stiffer ones are compressed by less than the
/// rounding of it.
const STIFFNESS: (f64, f64) = (1e-3, 1e15);
/// Absorber's mass, in units of the structure's.
const MASS: (f64, f64) = (1e-9, 1e9);
/// Damping, in units of the mass times sqrt(g/height).
const DAMPING: (f64, f64) = (0.0, 1e15);
/// Keys of a unit's numbers.
const NAMES: [&str; 4] = ["k1_n_per_m", "k2_n_per_m", "m2_kg", "c_ns_per_m"];
/// The least that each may be.
const LEAST: [f64; 4] = [f64::MIN_POSITIVE, f64::MIN_POSITIVE, f64::MIN_POSITIVE, 0.0];

impl Parameters {
    /// The same, if every number can be.
    pub(super) fn checked(self, path: &str) -> Result<Self, ParametersError> {
        self.record.iter().try_for_each(|row| row.check(path))?;
        self.structure
            .checked()
            .map_err(|source| ParametersError::Structure { path: path.to_string(), source })?;
        if let Some(value) = self.restitution.filter(|e| !(0.0..=1.0).contains(e)) {
            return Err(ParametersError::Restitution { path: path.to_string(), value });
        }
        self.program.iter().try_for_each(|row| row.check(path))?;
        let program = self.program.iter();
        let program = program.flat_map(|p| {
            [("program.vertical", &p.units.vertical), ("program.horizontal", &p.units.horizontal)]
        });
        let scale = UnitScale { mass: self.structure.mass_kg, height: self.structure.height_m };
        for (chain, row) in [("vertical", &self.vertical), ("horizontal", &self.horizontal)]
            .into_iter()
            .chain(program)
        {
            let numbers = [row.k1_n_per_m, row.k2_n_per_m, row.m2_kg, row.c_ns_per_m];
            for ((name, value), least) in NAMES.into_iter().zip(numbers).zip(LEAST) {
                if !(value.is_finite() && value >= least) {
                    let bound =
                        if least > 0.0 { " greater than zero" } else { ", zero or greater" };
                    return Err(ParametersError::Value {
                        path: path.to_string(),
                        chain,
                        name,
                        value,
                        bound,
                    });
                }
            }
            scale.check(path, chain, numbers)?;
        }
        let members = self.members().checked(&self.structure.body());
        members.map_err(|source| ParametersError::Members { path: path.to_string(), source })?;
        Ok(self)
    }
}

impl RecordRow {
    /// That the length of the part used, if it is given, is one.
    pub(super) fn check(&self, path: &str) -> Result<(), ParametersError> {
        match self.duration_s.filter(|d| *d <= 0.0) {
            Some(value) => {
                let path = path.to_string();
                Err(ParametersError::Record { path, name: "duration_s", value })
            }
            None => Ok(()),
        }
    }
}

/// What numbers of spring-absorber units are measured by: a structure's mass (kg) and the height of
/// its centre of mass (m).
#[derive(Clone, Copy)]
pub(super) struct UnitScale {
    pub(super) mass: f64,
    pub(super) height: f64,
}

impl UnitScale {
    /// That k1, k2, m2, c of a unit, over the structure's own, are within what 16 digits can
    /// follow; `chain` names the unit in messages.
    pub(super) fn check(
        &self,
        path: &str,
        chain: &str,
        numbers: [f64; 4],
    ) -> Result<(), ParametersError> {
        let Self { mass, height } = *self;
        // a spring that the weight compresses by the height
        let k = mass * GRAVITY / height;
        let c = (k * mass).sqrt();
        let scales = [
            (k, "the weight over the height", STIFFNESS),
            (k, "the weight over the height", STIFFNESS),
            (mass, "the structure's mass", MASS),
            (c, "the mass times sqrt(g/height)", DAMPING),
        ];
        for ((name, value), (unit, scale, (least, most))) in
            NAMES.into_iter().zip(numbers).zip(scales)
        {
            let times = value / unit;
            if !(least..=most).contains(&times) {
                let (path, chain) = (path.to_string(), chain.to_string());
                return Err(ParametersError::Absurd { path, chain, name, value, times, scale });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use springs::suite::{Accuracy, PeakAccuracy, Statistic};
    use validation::PeakErrors;

    /// JSON has no infinity: errors of springs that lose their motions stand as null.
    #[test]
    fn what_is_lost_is_read_back_as_lost() {
        let lost = Some(Statistic { value: f64::INFINITY, count: 24 });
        let written = PeakAccuracy {
            largest: Accuracy {
                record: Some(f64::INFINITY),
                synthetic_median: lost,
                ..Accuracy::default()
            },
            record: Some(PeakErrors::LOST),
            ..PeakAccuracy::default()
        };
        let text = serde_json::to_string(&written).unwrap();
        let read: PeakAccuracy = serde_json::from_str(&text).unwrap();
        assert_eq!(read, written, "{text}");
        assert!(!read.largest.reaches(1.0));
    }
}
