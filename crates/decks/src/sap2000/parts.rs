//! What tables are made from, whatever the structure: joints with masses, frames, feet on their
//! links, a record.

use crate::{
    ExportError, OutputSteps,
    beside::{HousnerBeside, HousnerEnd},
    model::{DeckModel, digits},
    stepping::EvenSteps,
};
use dynamics::spring::{Chain, Springs};
use files::message::significant;
use strong_motion::Record;

/// Length of a link over the structure's height: long enough that importing merges no joints. The
/// absorbers do not rotate, so it does not matter.
pub(super) const LINK_LENGTH: f64 = 0.01;
/// Stiffness of frames that stand for a rigid body, over the stiffest spring: nothing takes their
/// compliance off k1 here.
const RIGID: f64 = 1e4;

/// The material of such frames.
const RIGID_MATERIAL: &str = "RIGID";

/// A joint of the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joint {
    pub tag: usize,
    /// x, z (m).
    pub place: [f64; 2],
    /// Zero of a joint without mass (kg).
    pub mass: f64,
    /// (kg m2)
    pub inertia: f64,
}

/// A frame section, of a material of its own.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SapSection {
    pub name: String,
    pub material: String,
    /// EA (N).
    pub axial: f64,
    /// EI (N m2).
    pub bending: f64,
    /// GA_s (N); infinite: no shear deformation.
    pub shear: f64,
    /// Damping over stiffness (s).
    pub ahead: f64,
}

impl SapSection {
    /// All but rigid, beside springs as stiff as this, of a frame of this length.
    pub(crate) fn rigid(name: String, springs: &[Springs<Chain>], length: f64) -> Self {
        let of = |s: &Springs<Chain>| {
            s.vertical.k1.max(s.vertical.k2).max(s.horizontal.k1).max(s.horizontal.k2)
        };
        let stiffness = RIGID * springs.iter().map(of).fold(0.0, f64::max);
        let (axial, bending) = (stiffness * length, stiffness * length.powi(3) / 3.0);
        Self {
            name,
            material: RIGID_MATERIAL.into(),
            axial,
            bending,
            shear: f64::INFINITY,
            ahead: 0.0,
        }
    }

    /// Whether it is one of these.
    pub(crate) fn is_rigid(&self) -> bool {
        self.material == RIGID_MATERIAL
    }
}

/// A frame: its two joints and its section's index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bar {
    pub joints: [usize; 2],
    pub section: usize,
}

/// What stands on the ground: a joint, those of its absorber and of the ground below, its unit's
/// index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FootJoints {
    pub joint: usize,
    pub absorber: usize,
    pub ground: usize,
    pub unit: usize,
}

/// Springs, and what is added to the names of their links.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SpringLinks {
    pub suffix: String,
    pub springs: Springs<Chain>,
}

/// A model for tables.
pub(crate) struct SapModel<'a> {
    pub title: String,
    /// Notes besides those of all tables, lines that begin with a dollar.
    pub notes: String,
    pub joints: Vec<Joint>,
    pub sections: Vec<SapSection>,
    pub bars: Vec<Bar>,
    pub units: Vec<SpringLinks>,
    pub feet: Vec<FootJoints>,
    /// Joint whose motion is expected to be this, and what it is.
    pub watched: usize,
    pub watched_is: &'static str,
    /// Where it settles (m).
    pub settled: f64,
    /// Its largest and least displacement, sideways and upwards from where it settled (m).
    pub peaks: [(f64, f64); 2],
    /// Of a link (m).
    pub link: f64,
    pub record: &'a Record,
    /// Samples followed.
    pub samples: usize,
    /// Up to when it can be predicted, if not to its end: peaks are to then (s).
    pub until: Option<f64>,
    /// Settings of the program whose steps the springs are for.
    pub even: EvenSteps,
    /// What Housner's equation finds, up to then.
    pub housner: Option<HousnerBeside>,
    /// What damping its beams have, if they have some.
    pub damping: Option<String>,
}

impl<'a> SapModel<'a> {
    /// Of a rigid body: joint 3 the mass, on legs from joints 1 and 2.
    ///
    /// # Errors
    /// Springs for steps that follow touches.
    pub(crate) fn rigid(model: &DeckModel<'a>) -> Result<Self, ExportError> {
        let even = model.even.ok_or(ExportError::EventsInTables)?;
        let body = model.body();
        let (b, h) = (body.half_width, body.height);
        let foot = |tag: usize, x: f64| Joint { tag, place: [x, 0.0], mass: 0.0, inertia: 0.0 };
        let mass = Joint { tag: 3, place: [0.0, h], mass: body.mass, inertia: model.inertia };
        let e = &model.expected;
        Ok(Self {
            title: model.title(),
            notes: String::new(),
            joints: vec![foot(1, -b), foot(2, b), mass],
            sections: vec![SapSection::rigid("LEG".into(), &[model.springs], body.radius())],
            bars: [1, 2].map(|foot| Bar { joints: [foot, 3], section: 0 }).to_vec(),
            units: vec![SpringLinks { suffix: String::new(), springs: model.springs }],
            feet: [1, 2]
                .map(|joint| FootJoints {
                    joint,
                    absorber: 10 + joint,
                    ground: 20 + joint,
                    unit: 0,
                })
                .to_vec(),
            watched: 3,
            watched_is: "the centre of mass",
            settled: e.settled,
            peaks: [e.u, e.v],
            link: LINK_LENGTH * h,
            record: model.record,
            samples: e.samples,
            until: (e.compared < e.samples).then(|| model.compared_s()),
            even,
            housner: model.housner,
            damping: None,
        })
    }

    /// Where a joint of the structure is (m).
    pub(crate) fn place(&self, tag: usize) -> [f64; 2] {
        self.joints.iter().find(|joint| joint.tag == tag).map_or([0.0; 2], |joint| joint.place)
    }

    /// What the load case of the record shows: a whole number of the program's steps at a time.
    pub(crate) fn output(&self) -> OutputSteps {
        OutputSteps::of(self.even.step, self.record.dt, self.samples)
    }

    /// That the structure topples in these steps, or Housner's body does, and when.
    pub(crate) fn topples(&self) -> Option<String> {
        let time = |s: f64| significant(s, 4);
        let late = |s: f64| match self.until.is_some_and(|until| until <= s) {
            true if self.even.ends.compared_by_steps => ", after what can be compared",
            true => ", after what can be predicted",
            false => "",
        };
        let housner = self.housner.and_then(|housner| housner.end).map(|end| match end {
            HousnerEnd::Stands => "Housner's body stands".to_string(),
            HousnerEnd::Overturns(s) => {
                format!("Housner's body overturns, at {} s{}", time(s), late(s))
            }
            HousnerEnd::LeavesGround(s) => {
                format!(
                    "Housner's body leaves the ground, at {} s, where his solution ends",
                    time(s)
                )
            }
        });
        let overturns = |of: HousnerBeside| matches!(of.end, Some(HousnerEnd::Overturns(_)));
        let steps = match self.even.ends.falls_s {
            Some(s) => {
                format!("The structure topples in these steps, at {} s{}", time(s), late(s))
            }
            None if self.housner.is_some_and(overturns) => {
                let until = self.even.ends.gives_up_s.map_or(String::new(), |s| {
                    format!(" up to {} s, where the emulation ends", time(s))
                });
                format!("The structure does not topple in these steps{until}")
            }
            None => return None,
        };
        Some([Some(steps), housner].into_iter().flatten().collect::<Vec<_>>().join("; ") + ".")
    }

    /// What is expected, as a comment.
    pub(crate) fn expected(&self) -> String {
        let [u, v] = self.peaks;
        let until = self.until.map_or(String::new(), |until| {
            format!(", to {} s (beyond, {})", significant(until, 4), self.even.ends.beyond())
        });
        let errors =
            self.even.errors().map_or(String::new(), |errors| format!("$ Measured: {errors}.\n"));
        let topples = self.topples().map_or(String::new(), |topples| format!("$ {topples}\n"));
        format!(
            "$ Expected at joint {}, m, by an emulation of these steps{until}: settled U3 {}; U1 \
                {} to {}; U3 above settled {} to {}\n{topples}{errors}",
            self.watched,
            digits(self.settled),
            digits(u.1),
            digits(u.0),
            digits(v.1),
            digits(v.0)
        )
    }
}
