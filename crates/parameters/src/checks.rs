//! Whether the numbers of a file of parameters can be.

use super::{Parameters, ParametersError};
use dynamics::spring::ChainRow;
use rocking::{scalar::GRAVITY, structure::Structure};

/// Stiffness that a spring may have, in units of the weight over the height: softer ones let the
/// body sink in by a thousand times its height, stiffer ones are compressed by less than the
/// rounding of it.
const STIFFNESS: (f64, f64) = (1e-3, 1e15);
/// Absorber's mass, in units of the structure's.
const MASS: (f64, f64) = (1e-9, 1e9);
/// Damping, in units of the mass times sqrt(g/height).
const DAMPING: (f64, f64) = (0.0, 1e15);

impl Parameters {
    /// The same, if every number can be.
    pub(super) fn checked(self, path: &str) -> Result<Self, ParametersError> {
        if let Some(row) = &self.record
            && let Some(value) = row.duration_s.filter(|d| *d <= 0.0)
        {
            return Err(ParametersError::Record {
                path: path.to_string(),
                name: "duration_s",
                value,
            });
        }
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
        for (chain, row) in [("vertical", &self.vertical), ("horizontal", &self.horizontal)]
            .into_iter()
            .chain(program)
        {
            for (name, value, least) in [
                ("k1_n_per_m", row.k1_n_per_m, f64::MIN_POSITIVE),
                ("k2_n_per_m", row.k2_n_per_m, f64::MIN_POSITIVE),
                ("m2_kg", row.m2_kg, f64::MIN_POSITIVE),
                ("c_ns_per_m", row.c_ns_per_m, 0.0),
            ] {
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
            self.meaningful(path, chain, row)?;
        }
        let members = self.members().checked(&self.structure.body());
        members.map_err(|source| ParametersError::Members { path: path.to_string(), source })?;
        Ok(self)
    }

    /// Springs whose numbers, in units of the structure's own, are within what 16 digits can
    /// follow.
    fn meaningful(
        &self,
        path: &str,
        chain: &'static str,
        row: &ChainRow,
    ) -> Result<(), ParametersError> {
        let Structure { mass_kg, height_m, .. } = self.structure;
        // a spring that the weight compresses by the height
        let k = mass_kg * GRAVITY / height_m;
        let c = (k * mass_kg).sqrt();
        for (name, value, unit, scale, (least, most)) in [
            ("k1_n_per_m", row.k1_n_per_m, k, "the weight over the height", STIFFNESS),
            ("k2_n_per_m", row.k2_n_per_m, k, "the weight over the height", STIFFNESS),
            ("m2_kg", row.m2_kg, mass_kg, "the structure's mass", MASS),
            ("c_ns_per_m", row.c_ns_per_m, c, "the mass times sqrt(g/height)", DAMPING),
        ] {
            let times = value / unit;
            if !(least..=most).contains(&times) {
                return Err(ParametersError::Absurd {
                    path: path.to_string(),
                    chain,
                    name,
                    value,
                    times,
                    scale,
                });
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
