//! The springs: links between foot, absorber and ground.

use std::fmt::Display;

use super::{FRICTION, KILO, SapModel, SapTable, parts::SpringLinks};
use crate::model::digits;
use dynamics::spring::Springs;

pub(super) fn links(parts: &SapModel) -> Vec<SapTable> {
    let mut general = SapTable::new("LINK PROPERTY DEFINITIONS 01 - GENERAL");
    let kinds = [("FOOT", "Friction Isolator"), ("FOOT_GAP", "Gap"), ("GROUND", "Linear")];
    for (unit, (link, kind)) in parts.units.iter().flat_map(|unit| kinds.map(|kind| (unit, kind))) {
        // P-Delta moments go to joint I, the absorber or the ground, which does not rotate
        general.add(&[
            ("Link", &name(link, unit)),
            ("LinkType", &kind),
            ("Mass", &0),
            ("Weight", &0),
            ("RotInert1", &0),
            ("RotInert2", &0),
            ("RotInert3", &0),
            ("DefLength", &1),
            ("DefArea", &1),
            ("PDM2I", &1),
            ("PDM2J", &0),
            ("PDM3I", &1),
            ("PDM3J", &0),
            ("Color", &"Magenta"),
        ]);
    }
    let mut connect = SapTable::new("CONNECTIVITY - LINK");
    let mut assign = SapTable::new("LINK PROPERTY ASSIGNMENTS");
    // from below to above: a foot that goes down shortens its link, U1 < 0
    let upper = parts.feet.iter().map(|foot| (foot.absorber, foot.joint, foot.unit, kinds[0]));
    let lower = parts.feet.iter().map(|foot| (foot.ground, foot.absorber, foot.unit, kinds[2]));
    for (i, (from, to, unit, (property, kind))) in upper.chain(lower).enumerate() {
        let link = i + 1;
        connect.add(&[("Link", &link), ("JointI", &from), ("JointJ", &to)]);
        assign.add(&[
            ("Link", &link),
            ("LinkType", &kind),
            ("LinkJoints", &"TwoJoint"),
            ("LinkProp", &name(property, &parts.units[unit])),
            ("LinkFDProp", &"None"),
        ]);
    }
    let mut springs = [
        SapTable::new("LINK PROPERTY DEFINITIONS 02 - LINEAR"),
        SapTable::new("LINK PROPERTY DEFINITIONS 05 - GAP"),
        SapTable::new("LINK PROPERTY DEFINITIONS 08 - SLIDING ISOLATOR"),
    ];
    for unit in &parts.units {
        let [linear_table, gap_table, isolator_table] = &mut springs;
        linear(unit, linear_table);
        gap(unit, gap_table);
        isolator(unit, isolator_table);
    }
    [general].into_iter().chain(springs).chain([connect, assign]).collect()
}

/// A link property of a unit.
fn name(link: &str, unit: &SpringLinks) -> String {
    format!("{link}{}", unit.suffix)
}

fn kilo(x: f64) -> String {
    digits(x * KILO)
}

/// k2 beside c, between absorber and ground.
fn linear(unit: &SpringLinks, table: &mut SapTable) {
    let (link, Springs { vertical: v, horizontal: h }) = (name("GROUND", unit), &unit.springs);
    table.add(&[
        ("Link", &link),
        ("DOF", &"U1"),
        ("Fixed", &"No"),
        ("TransKE", &kilo(v.k2)),
        ("TransCE", &kilo(v.c)),
    ]);
    table.add(&[
        ("Link", &link),
        ("DOF", &"U2"),
        ("Fixed", &"No"),
        ("TransKE", &kilo(h.k2)),
        ("TransCE", &kilo(h.c)),
        ("DJ", &0),
    ]);
}

/// k1, between foot and absorber, where the program knows no isolator: the horizontal spring acts
/// in the air, too.
fn gap(unit: &SpringLinks, table: &mut SapTable) {
    foot("FOOT_GAP", unit, ("TransOpen", &0), "No", &[], table);
}

/// The same as an isolator, whose horizontal spring acts while the foot presses.
fn isolator(unit: &SpringLinks, table: &mut SapTable) {
    let k1 = kilo(unit.springs.horizontal.k1);
    // radius 0: a flat slider
    let slider: [SapField; 5] =
        [("TransK", &k1), ("Slow", &FRICTION), ("Fast", &FRICTION), ("Rate", &0), ("Radius", &0)];
    foot("FOOT", unit, ("TransC", &0), "Yes", &slider, table);
}

/// A column of a table and its value.
type SapField<'a> = (&'a str, &'a dyn Display);

/// k1 of a unit, as `link`: it only presses vertically, with the column that this kind has for it;
/// whether the horizontal spring is nonlinear, and its columns then. DJ = 0: it sits at the foot,
/// so the foot's rotation does not stretch it.
fn foot(
    link: &str,
    unit: &SpringLinks,
    vertical: SapField,
    nonlinear: &str,
    horizontal: &[SapField],
    table: &mut SapTable,
) {
    let link = name(link, unit);
    let [v, h] = [unit.springs.vertical.k1, unit.springs.horizontal.k1].map(kilo);
    let mut row = |direction: &str, nonlinear: &str, k1: &String, rest: &[SapField]| {
        let all: [SapField; 6] = [
            ("Link", &link),
            ("DOF", &direction),
            ("Fixed", &"No"),
            ("NonLinear", &nonlinear),
            ("TransKE", k1),
            ("TransCE", &0),
        ];
        table.add(&[&all, rest].concat());
    };
    row("U1", "Yes", &v, &[("TransK", &v), vertical]);
    row("U2", nonlinear, &h, &[&[("DJ", &0 as &dyn Display)], horizontal].concat());
}
