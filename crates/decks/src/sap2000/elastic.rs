//! An elastic structure for the tables: beams between joints, stiff arms to places off their nodes.

use super::parts::{Bar, FootJoints, Joint, LINK_LENGTH, SapModel, SapSection, SpringLinks};
use crate::{elastic::ElasticDeck, printable_title, stepping::EvenSteps};
use frames::{beam, frame::NodePoint};

/// What a frame that stands for axial stiffness alone has of the beam's bending stiffness, and the
/// other way round: a section needs both.
const TRACE: f64 = 1e-6;

const NOTES: &str = "\
$  6. Beams whose axial and bending damping differ are two frames side by side: _A bears the axial
$     force, _B the moments.
$  7. Damping of beams is VisStiff of their materials, stiffness-proportional; it must not resist a
$     rotation of the whole structure: compare a free rocking with and without it. Joints between
$     beam and footing are stiff frames ARM.
";

/// Tables' parts in the making.
struct Build<'a, 'd> {
    deck: &'a ElasticDeck<'d>,
    joints: Vec<Joint>,
    /// Node that each joint belongs to.
    owners: Vec<usize>,
    sections: Vec<SapSection>,
    bars: Vec<Bar>,
}

impl Build<'_, '_> {
    /// The joint at a place on a node, on an arm if that is off it.
    fn joint(&mut self, point: &NodePoint) -> usize {
        let known = self.joints.iter().zip(&self.owners);
        let mut known =
            known.filter(|(joint, owner)| **owner == point.node && joint.place == point.place);
        if let Some((joint, _)) = known.next() {
            return joint.tag;
        }
        let tag = self.joints.len() + 1;
        let from = self.joints[point.node];
        let length = (point.place[0] - from.place[0]).hypot(point.place[1] - from.place[1]);
        self.joints.push(Joint { tag, place: point.place, mass: 0.0, inertia: 0.0 });
        self.owners.push(point.node);
        let section = SapSection::rigid(format!("ARM_{tag}"), self.deck.springs, length);
        self.bar([from.tag, tag], section);
        tag
    }

    fn bar(&mut self, joints: [usize; 2], section: SapSection) {
        self.sections.push(section);
        self.bars.push(Bar { joints, section: self.sections.len() - 1 });
    }

    /// Beam i between two joints.
    fn beam(&mut self, i: usize, joints: [usize; 2], s: &beam::BeamSection) {
        let share =
            |damping: f64, stiffness: f64| if stiffness > 0.0 { damping / stiffness } else { 0.0 };
        let ahead = [share(s.axial_damping, s.axial), share(s.bending_damping, s.bending)];
        let name = format!("BEAM_{}", i + 1);
        let of = |name: String, [axial, bending]: [f64; 2], ahead: f64| SapSection {
            material: name.clone(),
            name,
            axial: axial * s.axial,
            bending: bending * s.bending,
            shear: bending * s.shear,
            ahead,
        };
        if (ahead[0] - ahead[1]).abs() <= 1e-12 * ahead[0] {
            return self.bar(joints, of(name, [1.0; 2], ahead[0]));
        }
        self.bar(joints, of(format!("{name}_A"), [1.0 - TRACE, TRACE], ahead[0]));
        self.bar(joints, of(format!("{name}_B"), [TRACE, 1.0 - TRACE], ahead[1]));
    }
}

impl<'a> SapModel<'a> {
    /// Of an elastic structure without members of its own: joint i + 1 is node i.
    pub(crate) fn elastic(deck: &ElasticDeck<'a>, even: EvenSteps) -> Self {
        let mass = deck.frame.mass_matrix();
        let of = |at: Option<usize>| at.map_or(0.0, |k| mass[(k, k)]);
        let nodes = 0..deck.layout.nodes.len();
        let joint = |node: usize| {
            let [x, _, turn] = deck.frame.coordinates(node);
            Joint { tag: node + 1, place: deck.frame.centre(node), mass: of(x), inertia: of(turn) }
        };
        let joints: Vec<Joint> = nodes.clone().map(joint).collect();
        let mut build =
            Build { deck, joints, owners: nodes.collect(), sections: Vec::new(), bars: Vec::new() };
        for (i, member) in deck.layout.members.iter().enumerate() {
            let ends = [build.joint(&member.ends[0]), build.joint(&member.ends[1])];
            build.beam(i, ends, &member.section);
        }
        let stands: Vec<usize> =
            deck.layout.corners.iter().map(|corner| build.joint(corner)).collect();
        let foot = |(i, &joint): (usize, &usize)| FootJoints {
            joint,
            absorber: 1001 + i,
            ground: 2001 + i,
            unit: i,
        };
        let unit = |(i, springs): (usize, &_)| SpringLinks {
            suffix: format!("_{}", i + 1),
            springs: *springs,
        };
        let (top, _) = deck.top;
        Self {
            title: printable_title(deck.title),
            notes: NOTES.into(),
            feet: stands.iter().enumerate().map(foot).collect(),
            units: deck.springs.iter().enumerate().map(unit).collect(),
            watched: top + 1,
            watched_is: "the top",
            settled: deck.settled(),
            peaks: [0, 1].map(|k| (deck.peak(k, 1.0), deck.peak(k, -1.0))),
            link: LINK_LENGTH * deck.frame.span(),
            record: deck.record,
            samples: deck.samples,
            until: (deck.compared < deck.samples).then(|| deck.compared_s()),
            even,
            housner: None,
            damping: deck.damping(""),
            joints: build.joints,
            sections: build.sections,
            bars: build.bars,
        }
    }
}
