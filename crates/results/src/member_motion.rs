//! How far a rigid body draws its tendon and its dampers: what these are to be made for, beside
//! their forces.

use rocking::members::{Damper, Tendon};
use rocking::motion::TimedPeak;
use serde::{Deserialize, Serialize};

/// The largest elongation of a tendon from the mass to the ground below it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TendonMotion {
    /// Beyond its length in the standing structure (m).
    pub elongation_m: f64,
    /// When (s).
    pub time_s: f64,
    /// Over that length, which is the height of the mass.
    pub strain: f64,
    /// The same with what the pretension stretches it by, over its length without force.
    pub strain_with_pretension: f64,
}

/// The largest motions of the dampers between the corners and the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DamperMotion {
    /// Elongation: a corner's rise. On rigid ground it is never shorter than at rest (m).
    pub elongation_m: f64,
    /// When (s).
    pub elongation_time_s: f64,
    /// Speed (m/s): the largest force over c.
    pub velocity_m_per_s: f64,
    /// When (s).
    pub velocity_time_s: f64,
}

impl TendonMotion {
    /// Of a tendon as long as the mass is high (m), by its largest force (N).
    pub fn new(tendon: Tendon, height: f64, largest: TimedPeak) -> Self {
        let by = |force: f64| force / tendon.stiffness;
        let (all, held) = (by(largest.value), by(tendon.pretension));
        Self {
            elongation_m: all - held,
            time_s: largest.time,
            strain: (all - held) / height,
            strain_with_pretension: all / (height - held),
        }
    }
}

impl DamperMotion {
    /// By a damper's largest force (N) and a corner's largest rise (m).
    pub fn new(damper: Damper, largest: TimedPeak, rise: TimedPeak) -> Self {
        Self {
            elongation_m: rise.value,
            elongation_time_s: rise.time,
            velocity_m_per_s: largest.value.abs() / damper.c,
            velocity_time_s: largest.time,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 4e7 N/m pulled from 200 kN to 1 MN is 20 mm longer; of 8.9 m, 8.895 m without force.
    #[test]
    fn a_tendon_is_drawn_by_its_force_over_its_stiffness() {
        let tendon = Tendon { stiffness: 4e7, pretension: 2e5 };
        let of = TendonMotion::new(tendon, 8.9, TimedPeak { value: 1e6, time: 3.13 });
        assert!((of.elongation_m - 0.02).abs() < 1e-15 && of.time_s == 3.13);
        assert!((of.strain - 0.02 / 8.9).abs() < 1e-15);
        assert!((of.strain_with_pretension - 0.025 / 8.895).abs() < 1e-15);
        let largest = TimedPeak { value: -16e3, time: 3.5 };
        let rise = TimedPeak { value: 0.042, time: 3.13 };
        let of = DamperMotion::new(Damper { c: 8e4 }, largest, rise);
        assert!((of.velocity_m_per_s - 0.2).abs() < 1e-15 && of.velocity_time_s == 3.5);
        assert_eq!((of.elongation_m, of.elongation_time_s), (0.042, 3.13));
    }
}
