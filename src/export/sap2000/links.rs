//! The springs: links between foot, absorber and ground.

use super::{FRICTION, KILO, Table};
use crate::export::model::{Model, digits};

pub(super) fn links(model: &Model) -> Vec<Table> {
    let mut general = Table::new("LINK PROPERTY DEFINITIONS 01 - GENERAL");
    for (link, kind) in [("FOOT", "Friction Isolator"), ("FOOT_GAP", "Gap"), ("GROUND", "Linear")] {
        // P-Delta moments go to joint I, the absorber or the ground, which does not rotate
        general = general.row(&[
            ("Link", &link),
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
    let mut connect = Table::new("CONNECTIVITY - LINK");
    let mut assign = Table::new("LINK PROPERTY ASSIGNMENTS");
    // from below to above: a foot that goes down shortens its link, U1 < 0
    for (link, from, to, property, kind) in [
        (1, 11, 1, "FOOT", "Friction Isolator"),
        (2, 12, 2, "FOOT", "Friction Isolator"),
        (3, 21, 11, "GROUND", "Linear"),
        (4, 22, 12, "GROUND", "Linear"),
    ] {
        connect = connect.row(&[("Link", &link), ("JointI", &from), ("JointJ", &to)]);
        assign = assign.row(&[
            ("Link", &link),
            ("LinkType", &kind),
            ("LinkJoints", &"TwoJoint"),
            ("LinkProp", &property),
            ("LinkFDProp", &"None"),
        ]);
    }
    vec![general, linear(model), gap(model), isolator(model), connect, assign]
}

fn kilo(x: f64) -> String {
    digits(x * KILO)
}

/// k2 beside c, between absorber and ground.
fn linear(model: &Model) -> Table {
    let (v, h) = (&model.springs.vertical, &model.springs.horizontal);
    Table::new("LINK PROPERTY DEFINITIONS 02 - LINEAR")
        .row(&[
            ("Link", &"GROUND"),
            ("DOF", &"U1"),
            ("Fixed", &"No"),
            ("TransKE", &kilo(v.k2)),
            ("TransCE", &kilo(v.c)),
        ])
        .row(&[
            ("Link", &"GROUND"),
            ("DOF", &"U2"),
            ("Fixed", &"No"),
            ("TransKE", &kilo(h.k2)),
            ("TransCE", &kilo(h.c)),
            ("DJ", &0),
        ])
}

/// k1, between foot and absorber, where the program knows no isolator.
fn gap(model: &Model) -> Table {
    let (v, h) = (&model.springs.vertical, &model.springs.horizontal);
    Table::new("LINK PROPERTY DEFINITIONS 05 - GAP")
        .row(&[
            ("Link", &"FOOT_GAP"),
            ("DOF", &"U1"),
            ("Fixed", &"No"),
            ("NonLinear", &"Yes"),
            ("TransKE", &kilo(v.k1)),
            ("TransCE", &0),
            ("TransK", &kilo(v.k1)),
            ("TransOpen", &0),
        ])
        .row(&[
            ("Link", &"FOOT_GAP"),
            ("DOF", &"U2"),
            ("Fixed", &"No"),
            ("NonLinear", &"No"),
            ("TransKE", &kilo(h.k1)),
            ("TransCE", &0),
            ("DJ", &0),
        ])
}

/// The same as an isolator, whose horizontal spring acts while the foot presses.
fn isolator(model: &Model) -> Table {
    let (v, h) = (&model.springs.vertical, &model.springs.horizontal);
    // DJ = 0: the shear spring sits at the foot, so the foot's rotation does not stretch it. Radius 0: a flat slider.
    Table::new("LINK PROPERTY DEFINITIONS 08 - SLIDING ISOLATOR")
        .row(&[
            ("Link", &"FOOT"),
            ("DOF", &"U1"),
            ("Fixed", &"No"),
            ("NonLinear", &"Yes"),
            ("TransKE", &kilo(v.k1)),
            ("TransCE", &0),
            ("TransK", &kilo(v.k1)),
            ("TransC", &0),
        ])
        .row(&[
            ("Link", &"FOOT"),
            ("DOF", &"U2"),
            ("Fixed", &"No"),
            ("NonLinear", &"Yes"),
            ("TransKE", &kilo(h.k1)),
            ("TransCE", &0),
            ("DJ", &0),
            ("TransK", &kilo(h.k1)),
            ("Slow", &FRICTION),
            ("Fast", &FRICTION),
            ("Rate", &0),
            ("Radius", &0),
        ])
}
