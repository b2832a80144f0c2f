//! Forces to design with: those that do not change with the springs or the mesh, measured in the
//! run that gives them.

use frames::design_forces::{ForcesTogether, HeldForce, MOST_CHANGE, OtherForces};
use serde::{Deserialize, Serialize};

use super::{DamperMotion, Finding, ForceName, PeakChange, TendonMotion};

/// Share by which a force exceeds the one at rest at most, if the record adds nothing to it.
const RECORD_ADDS: f64 = 0.01;

/// Error of peaks on springs, as a share, from which on they check no force: one that is nearer is
/// so by chance.
const FAR: f64 = 0.1;

/// A largest force, and whether it is the structure's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DesignForce {
    /// Largest magnitude, with its sign: axial forces are positive in tension (N or N m). None
    /// where it does not hold.
    pub value: Option<f64>,
    /// When (s).
    pub time_s: f64,
    /// Whether it changes by less than 5 % with the springs, and with the mesh where there is one.
    pub holds: bool,
    /// The largest change that was measured, as a share; none where nothing could be measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change: Option<f64>,
    /// Largest magnitude with all that the springs and the mesh add, of an elastic structure (N or
    /// N m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub raw: Option<f64>,
    /// The same force of the structure fixed to the ground (N or N m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed: Option<f64>,
    /// Of the rigid body by Housner's equation (N or N m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rigid: Option<f64>,
    /// Of an A-frame's legs: what they bear at rest, half of the weight on each foot and no thrust,
    /// which is assumed: of feet that are held it is next to nothing (N or N m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_rest: Option<f64>,
    /// What a column's base, a leg or a block's base bears at that time; of an elastic structure
    /// below the same frequency.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub together: Option<ForcesTogether>,
    /// Of a force at one corner: what the ground gives that corner at that time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corner: Option<CornerForce>,
    /// Where the shear or the tension of an elastic structure's column is so large: height above
    /// its base, along it (m); 0 at the base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub above_base_m: Option<f64>,
    /// What it is with another mesh and on other springs, of an elastic structure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub others: Option<OtherForces>,
    /// Length of the record from its start over which it is the largest and holds (s), where it
    /// does not hold over all of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub over_s: Option<f64>,
    /// What it is over the whole record then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub whole_record: Option<OtherForces>,
    /// Of a force that is larger after what can be foretold: what it is, and holds, up to then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held: Option<HeldForce>,
    /// Of a rigid body whose springs are so far from Housner's motions that they check no force:
    /// error of their peaks, as a share.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub springs_err: Option<f64>,
    /// Whether the motion can be foretold up to `time_s`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub predictable: Option<bool>,
}

/// What the ground gives one corner of a rigid body at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CornerForce {
    /// Positive to the right (N).
    pub horizontal_n: f64,
    /// Positive where the corner presses (N).
    pub vertical_n: f64,
}

impl DesignForce {
    /// A force that was measured to change by this share.
    pub fn measured(value: f64, time_s: f64, change: Option<f64>) -> Self {
        let holds = change.is_some_and(|change| change < MOST_CHANGE);
        Self { value: Some(value).filter(|_| holds), time_s, holds, change, ..Self::default() }
    }

    /// Whether the largest is the one at rest.
    pub fn is_at_rest(&self) -> bool {
        let at_rest = |value: f64| {
            self.at_rest.is_some_and(|rest| value.abs() < (1.0 + RECORD_ADDS) * rest.abs())
        };
        self.value.is_some_and(at_rest)
    }

    /// This force times a length (m): the moment at one end of a member without mass that has a
    /// hinge at its other end.
    pub fn times(self, length: f64) -> Self {
        let by = |x: Option<f64>| x.map(|x| x * length);
        let all = |others: OtherForces| OtherForces {
            found: others.found * length,
            doubled_elements: by(others.doubled_elements),
            softer: by(others.softer),
            stiffer: by(others.stiffer),
            doubled_cutoff: by(others.doubled_cutoff),
        };
        let (others, whole_record) = (self.others.map(all), self.whole_record.map(all));
        let held = self.held.map(|held| HeldForce { value: held.value * length, ..held });
        Self {
            whole_record,
            held,
            value: by(self.value),
            raw: by(self.raw),
            fixed: by(self.fixed),
            rigid: by(self.rigid),
            at_rest: by(self.at_rest),
            others,
            ..self
        }
    }
}

/// A force below twice the frequency, over the one that is given, from which that is said.
const MOST_BY_CUTOFF: f64 = 1.25;

/// The forces; what does not apply to a structure is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DesignForces {
    /// Frequency below which peaks are given (Hz); none where forces are those between landings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub below_hz: Option<f64>,
    /// Shear of the column, where along it that is largest, of a leg, or at the foot of a rigid
    /// body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column_shear_n: Option<DesignForce>,
    /// Moment at the foot of the column, of a rigid body about the middle of its base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column_base_moment_nm: Option<DesignForce>,
    /// Moment at the top of the column of an elastic frame, where it meets the beam.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column_top_moment_nm: Option<DesignForce>,
    /// Axial force of the column, the leg or the rigid body, tension positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_n: Option<DesignForce>,
    /// Largest tension of the column of an elastic structure, where there is any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_tension_n: Option<DesignForce>,
    /// Moment of a leg at the apex of an A-frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub apex_moment_nm: Option<DesignForce>,
    /// Shear at all soles together, footings included, between landings; of a rigid body what the
    /// soles bear, without the tendon's pull at its anchor.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sole_shear_n: Option<DesignForce>,
    /// Vertical force at all soles together, footings included, upwards, between landings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sole_vertical_n: Option<DesignForce>,
    /// Vertical force of the ground on one corner of a rigid body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corner_vertical_n: Option<DesignForce>,
    /// Horizontal force of the ground on one corner of a rigid body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corner_horizontal_n: Option<DesignForce>,
    /// Horizontal force of a rigid body's tendon at its anchor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor_horizontal_n: Option<DesignForce>,
    /// Of the tendon that pulls most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tendon_n: Option<DesignForce>,
    /// Of the damper with the largest force on the structure, upwards.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damper_n: Option<DesignForce>,
    /// How far a rigid body's tendon is drawn, where its force holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tendon_motion: Option<TendonMotion>,
    /// How a rigid body's dampers move, where their force holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damper_motion: Option<DamperMotion>,
}

impl DesignForces {
    /// The same, each marked whether the motion, foretold up to `until` (s), is foretold up to its
    /// largest value; all are where there is no end to that.
    pub fn foretold_to(mut self, until: Option<f64>) -> Self {
        for force in self.each() {
            force.predictable = Some(until.is_none_or(|until| force.time_s <= until));
        }
        self
    }

    /// Those of Housner's body, where peaks err by this share on the springs that check them: from
    /// a tenth on none holds but what the structure bears at rest.
    pub fn checked_on_springs(mut self, err: Option<f64>) -> Self {
        let Some(err) = err.filter(|err| *err > FAR) else { return self };
        for force in self.each().filter(|force| !force.is_at_rest()) {
            let springs_err = Some(err);
            *force = DesignForce { value: None, holds: false, held: None, springs_err, ..*force };
        }
        self
    }

    fn each(&mut self) -> impl Iterator<Item = &mut DesignForce> {
        [
            &mut self.column_shear_n,
            &mut self.column_base_moment_nm,
            &mut self.column_top_moment_nm,
            &mut self.axial_n,
            &mut self.axial_tension_n,
            &mut self.apex_moment_nm,
            &mut self.sole_shear_n,
            &mut self.sole_vertical_n,
            &mut self.corner_vertical_n,
            &mut self.corner_horizontal_n,
            &mut self.anchor_horizontal_n,
            &mut self.tendon_n,
            &mut self.damper_n,
        ]
        .into_iter()
        .flatten()
    }

    /// Every force that applies, with its name.
    pub fn all(&self) -> impl Iterator<Item = (ForceName, DesignForce)> {
        [
            (ForceName::ColumnShear, self.column_shear_n),
            (ForceName::ColumnBaseMoment, self.column_base_moment_nm),
            (ForceName::ColumnTopMoment, self.column_top_moment_nm),
            (ForceName::Axial, self.axial_n),
            (ForceName::AxialTension, self.axial_tension_n),
            (ForceName::ApexMoment, self.apex_moment_nm),
            (ForceName::SoleShear, self.sole_shear_n),
            (ForceName::SoleVertical, self.sole_vertical_n),
            (ForceName::CornerVertical, self.corner_vertical_n),
            (ForceName::CornerHorizontal, self.corner_horizontal_n),
            (ForceName::AnchorHorizontal, self.anchor_horizontal_n),
            (ForceName::Tendon, self.tendon_n),
            (ForceName::Damper, self.damper_n),
        ]
        .into_iter()
        .filter_map(|(name, force)| Some((name, force?)))
    }

    /// A finding of those that hold over a part of the record alone.
    pub fn held_in_part(&self) -> Option<Finding> {
        let part = |(name, force): (ForceName, DesignForce)| {
            let (over_s, whole) = (force.over_s?, force.whole_record?);
            let (quantity, unit) = (name.words().to_string(), name.unit().to_string());
            Some((
                over_s,
                PeakChange { quantity, unit, without: force.value?.abs(), with: whole.found.abs() },
            ))
        };
        let (over, changes): (Vec<f64>, Vec<PeakChange>) = self.all().filter_map(part).unzip();
        Some(Finding::ForcesHeldInPart { over_s: over.into_iter().reduce(f64::min)?, changes })
    }

    /// A finding of those that are much larger below twice the frequency they are given below.
    pub fn of_cutoff(&self) -> Option<Finding> {
        let below_hz = self.below_hz?;
        let more = |(name, force): (ForceName, DesignForce)| {
            let (without, with) = (force.value?.abs(), force.others?.doubled_cutoff?.abs());
            let (quantity, unit) = (name.words().to_string(), name.unit().to_string());
            (with > MOST_BY_CUTOFF * without).then_some(PeakChange {
                quantity,
                unit,
                without,
                with,
            })
        };
        let changes: Vec<PeakChange> = self.all().filter_map(more).collect();
        (!changes.is_empty()).then_some(Finding::ForcesOfCutoff { below_hz, changes })
    }

    /// A finding of those that are largest before anything moves.
    pub fn at_rest(&self) -> Option<Finding> {
        let forces: Vec<ForceName> =
            self.all().filter(|(_, force)| force.is_at_rest()).map(|(name, _)| name).collect();
        (!forces.is_empty())
            .then_some(Finding::ForcesAtRest { forces, tied: self.tendon_n.is_some() })
    }

    /// A finding for every force that does not hold.
    pub fn withheld(&self) -> impl Iterator<Item = Finding> {
        let those = self.all().filter(|(_, force)| !force.holds);
        those.map(|(name, force)| Finding::ForceWithheld {
            force: name,
            change: force.change,
            // those of elastic structures have a raw one beside them
            housner: force.rigid.filter(|_| force.raw.is_none()),
            springs_err: force.springs_err,
            of_block: self.column_base_moment_nm.is_some() && self.sole_shear_n.is_none(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_change_decides_whatever_the_sign_and_a_motion_that_says_nothing_is_none() {
        let others = OtherForces {
            found: -2.0,
            doubled_elements: Some(2.02),
            softer: Some(-1.9),
            stiffer: Some(2.06),
            // of another frequency: no change of the same force
            doubled_cutoff: Some(-3.0),
        };
        assert!((others.change() - 0.05).abs() < 1e-12);
        assert!((OtherForces { softer: Some(2.0), ..others }.change() - 0.03).abs() < 1e-12);
        assert!(
            (OtherForces { softer: Some(2.0), stiffer: Some(2.0), ..others }.change() - 0.01).abs()
                < 1e-12
        );
        assert_eq!(OtherForces { softer: None, ..others }.change(), f64::INFINITY);
    }

    #[test]
    fn a_force_that_changes_by_a_twentieth_is_withheld_and_said_so() {
        let holds = DesignForce::measured(1e6, 2.0, Some(0.049));
        let changes = DesignForce::measured(1e6, 2.0, Some(0.051));
        assert_eq!((holds.value, holds.holds), (Some(1e6), true));
        assert_eq!((changes.value, changes.holds), (None, false));
        assert_eq!(DesignForce::measured(1e6, 2.0, None).value, None);
        let all = DesignForces {
            column_shear_n: Some(holds),
            axial_n: Some(changes),
            ..DesignForces::default()
        };
        let withheld: Vec<_> = all.withheld().collect();
        assert_eq!(
            withheld,
            [Finding::ForceWithheld {
                force: ForceName::Axial,
                change: Some(0.051),
                housner: None,
                springs_err: None,
                of_block: false
            }]
        );
        let json = serde_json::to_value(all).unwrap();
        assert_eq!(json["column_shear_n"]["value"], 1e6);
        assert!(json["axial_n"]["value"].is_null() && json.get("sole_shear_n").is_none());
    }

    /// A force that is as large on springs that move 72 % more is so by chance; what is borne at
    /// rest no springs move.
    #[test]
    fn springs_that_do_not_follow_the_reference_check_no_force() {
        let near =
            DesignForce { rigid: Some(1e6), ..DesignForce::measured(1e6, 2.0, Some(0.0498)) };
        let rests = DesignForce { at_rest: Some(-3e6), ..near };
        let rests = DesignForce { value: Some(-3e6), ..rests };
        let all = DesignForces {
            column_shear_n: Some(near),
            axial_n: Some(rests),
            ..DesignForces::default()
        };
        for followed in [None, Some(0.09)] {
            assert_eq!(all.checked_on_springs(followed), all);
        }
        let err = 0.72;
        let found = all.checked_on_springs(Some(err));
        let shear = found.column_shear_n.unwrap();
        assert_eq!((shear.value, shear.holds, shear.rigid), (None, false, Some(1e6)));
        assert_eq!(found.axial_n, all.axial_n);
        let withheld: Vec<_> = found.withheld().collect();
        assert!(matches!(
            withheld[..],
            [Finding::ForceWithheld { springs_err: Some(x), housner: Some(1e6), .. }] if x == err
        ));
        assert_eq!(serde_json::to_value(found).unwrap()["column_shear_n"]["springs_err"], err);
    }
}
