//! What the column of a rigid body bears that rocks by Housner's equation: what an elastic one is
//! compared with.
//!
//! ```text
//!   mass at (x, z) from the pivot of side s:   x = -s b cos theta + h sin theta,   z = s b sin theta + h cos theta
//!   force on it   F = m (x'' + a_g,  z'' + a_v + g),     x'' = z theta'' - x theta'^2,  z'' = -x theta'' - z theta'^2
//!   base shear sum F_x,   column shear sum F . e_1,   axial force -sum F . e_2
//!   moment at the column's foot   sum (F . e_1) (h - h_f)
//!   e_1 = (cos theta, -sin theta),  e_2 = (sin theta, cos theta)
//! ```
//!
//! The sums are over the mass and its column, whose mass stands in halves at the two points of
//! Gauss's quadrature: exact, as force times height is a square of the height at most. An impact's
//! impulse is not among them: they are forces between impacts.

use super::structure::ElasticStructure;
use rocking::{
    housner::{self, RockingOptions},
    scalar::GRAVITY,
};
use strong_motion::Record;

/// Forces of the rigid body, sample by sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidForces {
    /// Lean (rad).
    pub theta: Vec<f64>,
    /// Horizontal force on all above the footing (N).
    pub base_shear: Vec<f64>,
    /// Force across the column's axis (N); empty of an A-frame.
    pub shear: Vec<f64>,
    /// Axial force of the column, tension positive (N); empty of an A-frame.
    pub axial: Vec<f64>,
    /// Moment at the foot of the column (N m); empty of an A-frame.
    pub moment: Vec<f64>,
}

impl RigidForces {
    /// Through a record; `None` of a frame, which is not one rigid body.
    pub(crate) fn of(structure: &ElasticStructure, record: &Record) -> Option<Self> {
        // masses (kg), their heights above the ground and above the column's foot (m)
        let masses = match structure {
            ElasticStructure::Pier(pier) => {
                let (length, foot, half) =
                    (pier.length(), pier.height_m - pier.length(), 0.5 * pier.column_mass_kg);
                let points =
                    [-1.0, 1.0].map(|side: f64| 0.5 * length * (1.0 + side / 3.0_f64.sqrt()));
                vec![
                    (pier.mass_kg, pier.height_m, length),
                    (half, foot + points[0], points[0]),
                    (half, foot + points[1], points[1]),
                ]
            }
            ElasticStructure::AFrame(frame) => vec![(frame.mass_kg, frame.height_m, 0.0)],
            ElasticStructure::Frame(_) => return None,
        };
        let column = matches!(structure, ElasticStructure::Pier(_));
        let body = structure.body();
        let vertical = record.vertical.as_ref().map(|vertical| vertical.accel.clone());
        let options = RockingOptions { vertical: vertical.clone(), ..RockingOptions::default() };
        let rocking = housner::solve(&body, record.dt, &record.accel, &options);
        let (p2, alpha, b) = (body.p_squared(), body.alpha(), body.half_width);
        let mut out = Self::default();
        for (i, (&theta, &rate)) in rocking.theta.iter().zip(&rocking.rate).enumerate() {
            let a_g = record.accel.get(i).copied().unwrap_or(0.0);
            let a_v = vertical.as_ref().and_then(|v| v.get(i)).copied().unwrap_or(0.0);
            let stands = theta == 0.0 && rate == 0.0;
            let s = if theta != 0.0 { theta.signum() } else { rate.signum() };
            let lean = alpha * s - theta;
            let turn = if stands {
                0.0
            } else {
                -p2 * ((1.0 + a_v / GRAVITY) * lean.sin() + a_g / GRAVITY * lean.cos())
            };
            let (sin, cos) = theta.sin_cos();
            let (mut force, mut moment) = ([0.0; 2], 0.0);
            for &(mass, h, arm) in &masses {
                let (x, z) = (h * sin - s * b * cos, h * cos + s * b * sin);
                let of = [
                    mass * (z * turn - x * rate * rate + a_g),
                    mass * (-x * turn - z * rate * rate + a_v + GRAVITY),
                ];
                force = [force[0] + of[0], force[1] + of[1]];
                moment += (of[0] * cos - of[1] * sin) * arm;
            }
            out.theta.push(theta);
            out.base_shear.push(force[0]);
            if column {
                out.axial.push(-(force[0] * sin + force[1] * cos));
                out.shear.push(force[0] * cos - force[1] * sin);
                out.moment.push(moment);
            }
        }
        Some(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::PierSpec;

    fn pier() -> ElasticStructure {
        toml::from_str(
            "kind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
             footing_mass_kg = 120e3\nfooting_height_m = 1.5\n\
             frequency_hz = 2.0\ndamping_ratio = 0.02\n",
        )
        .unwrap()
    }

    /// Standing, the mass is pushed by the ground's acceleration and carries its weight.
    #[test]
    fn a_standing_body_bears_its_weight_and_the_ground_s_acceleration() {
        let record = Record::new("step", 0.01, vec![0.5; 10]).unwrap();
        let forces = RigidForces::of(&pier(), &record).unwrap();
        assert!(forces.base_shear.iter().all(|x| (x - 300e3).abs() < 1e-6));
        assert!(forces.axial.iter().all(|x| (x + 600e3 * GRAVITY).abs() < 1e-6));
        assert!(forces.moment.iter().all(|x| (x - 300e3 * 10.5).abs() < 1e-5));
    }

    /// A column's mass is carried, too: at its foot all of it, with half its length as lever.
    #[test]
    fn a_column_s_own_mass_is_borne() {
        let ElasticStructure::Pier(bare) = pier() else { panic!("a pier") };
        let heavy = ElasticStructure::Pier(PierSpec { column_mass_kg: 90e3, ..bare });
        let record = Record::new("step", 0.01, vec![0.5; 10]).unwrap();
        let forces = RigidForces::of(&heavy, &record).unwrap();
        assert!(forces.base_shear.iter().all(|x| (x - 345e3).abs() < 1e-6));
        assert!(forces.axial.iter().all(|x| (x + 690e3 * GRAVITY).abs() < 1e-6));
        let moment = 0.5 * (600e3 * 10.5 + 90e3 * 5.25);
        assert!(forces.moment.iter().all(|x| (x - moment).abs() < 1e-5));
    }

    /// A rocking body's shear is bounded by that which lifts it, times what a body turned to its
    /// pivot feels: the ground's acceleration is met by the fall. By differences of the mass's own
    /// path it is the same.
    #[test]
    fn the_force_is_the_mass_s_acceleration() {
        let accel: Vec<f64> = (0..2000).map(|i| 3.0 * (f64::from(i) * 1e-3 * 6.0).sin()).collect();
        let record = Record::new("sine", 1e-3, accel.clone()).unwrap();
        let structure = pier();
        let forces = RigidForces::of(&structure, &record).unwrap();
        let (b, h) = (2.0, 12.0);
        let place = |i: usize| {
            let theta: f64 = forces.theta[i];
            let s = theta.signum();
            h * theta.sin() + s * b * (1.0 - theta.cos())
        };
        let mut looked = 0;
        for (i, a_g) in accel.iter().enumerate().take(forces.theta.len() - 1).skip(1) {
            let signs = [i - 1, i, i + 1].map(|j| forces.theta[j].signum());
            if forces.theta[i - 1] == 0.0
                || signs[0] != signs[1]
                || signs[1] != signs[2]
                || forces.theta[i].abs() < 1e-3
            {
                continue;
            }
            let acceleration = (place(i + 1) - 2.0 * place(i) + place(i - 1)) / 1e-6;
            assert!((forces.base_shear[i] / 600e3 - a_g - acceleration).abs() < 1e-3, "{i}");
            looked += 1;
        }
        assert!(looked > 500);
    }
}
