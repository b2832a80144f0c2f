//! SAP2000 .s2k text tables (File > Import > SAP2000 .s2k Text File), in KN, m.
//!
//! ```text
//!  joint 3 (mass) ── frames 1, 2 (all but rigid) ── joints 1, 2 (feet)
//!      └─ links 1, 2: FOOT ── joints 11, 12 (absorbers, not rotating) ── links 3, 4: GROUND ── joints 21, 22 (fixed)
//! ```
//!
//! Link axes of a vertical link: local 1 up (U1 vertical), local 2 along +X (U2 horizontal). FOOT is a friction isolator:
//! its U1 presses and does not pull, its U2 acts only while U1 presses, which a gap link cannot say. GROUND is a linear
//! link with damping. A gap property FOOT_GAP is defined beside it, not used, for programs or versions without isolators.
//!
//! Table and field names are those of SAP2000's own exports as public files and readers show them. What could not be tried
//! without the program stands in the file's own header.

mod cases;
mod links;

use std::fmt::{Display, Write};

use super::model::{Model, digits};
use cases::{cases, loads, record};
use links::links;

/// N to KN, and kg to KN s2/m.
const KILO: f64 = 1e-3;
/// Modulus of the legs' material; only its products with area and inertia count [KN/m2].
const LEG_E: f64 = 2e8;
/// Length of a link over h: long enough that importing merges no joints. The absorbers do not rotate, so it does not matter.
const LINK_LENGTH: f64 = 0.01;
/// Stiffness of legs that stand for a rigid body, over the stiffest spring: nothing takes their compliance off k1 here.
const LEG_STIFFNESS: f64 = 1e4;
/// Friction coefficient: a pressing foot never slides.
const FRICTION: f64 = 1000.0;

/// What a user must know before trusting the file.
const NOTES: &str = "\
$ Import: File > Import > SAP2000 .s2k Text File; then run load cases GRAVITY and QUAKE.
$ Not verified with the program (tables and fields follow SAP2000's own exports):
$  1. FOOT is a friction isolator (LINK PROPERTY DEFINITIONS 08 - SLIDING ISOLATOR): U1 compression only with k1, U2 with k1
$     while U1 presses, friction coefficient 1000 so that a foot never slides. In SAP2000 its shear force follows the axial
$     force (force = P mu z); the tuned model has a plain spring that lets go when P = 0. If the import does not know the
$     table, assign FOOT_GAP to links 1 and 2: its horizontal spring then also acts on a lifted foot, which is wrong by
$     the foot's travel times k1; use it for small rocking only.
$  2. GeoNonLin of both cases must read 'P-Delta plus Large Displacements': check under Define > Load Cases.
$  3. The integrator is Hilber-Hughes-Taylor with alpha = -1/3, the most damped SAP2000 offers; halve the step once and compare.
$  4. The mass source must count added masses only.
$  5. The words for the isolator (LinkType), large displacements (GeoNonLin) and ground acceleration (LoadType) differ between
$     versions: if the import log names one, set it in the dialog of links 1 and 2 or of the load cases.
";

/// The whole file.
pub(super) fn tables(model: &Model) -> String {
    let mut text = format!("$ {}\n{NOTES}{}\n", model.title(), expected(model));
    for table in
        [control(), geometry(model), links(model), loads(model), cases(model), record(model)].into_iter().flatten()
    {
        text.push_str(&table.text);
        text.push('\n');
    }
    text.push_str("END TABLE DATA\n");
    text
}

fn expected(model: &Model) -> String {
    let e = &model.expected;
    format!(
        "$ Expected at joint 3, m, within 1 % (`tune simulate`): settled U3 {}; U1 {} to {}; U3 above settled {} to {}\n",
        digits(e.settled),
        digits(e.u.1),
        digits(e.u.0),
        digits(e.v.1),
        digits(e.v.0)
    )
}

/// A table in the making.
struct Table {
    text: String,
}

impl Table {
    fn new(name: &str) -> Self {
        Self { text: format!("TABLE:  \"{name}\"\n") }
    }

    /// One row of field = value; texts with spaces or commas are quoted.
    fn row(mut self, fields: &[(&str, &dyn Display)]) -> Self {
        for (field, value) in fields {
            let value = value.to_string();
            let quote = if value.contains([' ', ',']) { "\"" } else { "" };
            // writing to a String does not fail
            let _ = write!(self.text, "   {field}={quote}{value}{quote}");
        }
        self.text.push('\n');
        self
    }
}

fn control() -> Vec<Table> {
    vec![
        Table::new("PROGRAM CONTROL").row(&[
            ("ProgramName", &"SAP2000"),
            ("Version", &"20.0.0"),
            ("CurrUnits", &"KN, m, C"),
            ("MergeTol", &"0.0001"),
        ]),
        Table::new("ACTIVE DEGREES OF FREEDOM").row(&[
            ("UX", &"Yes"),
            ("UY", &"No"),
            ("UZ", &"Yes"),
            ("RX", &"No"),
            ("RY", &"Yes"),
            ("RZ", &"No"),
        ]),
        Table::new("MASS SOURCE").row(&[
            ("MassSource", &"ADDED"),
            ("Elements", &"Yes"),
            ("Masses", &"Yes"),
            ("Loads", &"No"),
            ("IsDefault", &"Yes"),
        ]),
    ]
}

/// Joints, what holds them, and the masses at them.
fn joints(model: &Model) -> [Table; 3] {
    let body = model.body();
    let (b, h) = (body.half_width, body.height);
    let link = LINK_LENGTH * h;
    let mut joints = Table::new("JOINT COORDINATES");
    for (joint, x, z) in [
        (1, -b, 0.0),
        (2, b, 0.0),
        (3, 0.0, h),
        (11, -b, -link),
        (12, b, -link),
        (21, -b, -2.0 * link),
        (22, b, -2.0 * link),
    ] {
        joints = joints.row(&[
            ("Joint", &joint),
            ("CoordSys", &"GLOBAL"),
            ("CoordType", &"Cartesian"),
            ("XorR", &digits(x)),
            ("Y", &0),
            ("Z", &digits(z)),
        ]);
    }
    let mut restraints = Table::new("JOINT RESTRAINT ASSIGNMENTS");
    for (joint, held) in [(11, "No"), (12, "No"), (21, "Yes"), (22, "Yes")] {
        restraints = restraints.row(&[
            ("Joint", &joint),
            ("U1", &held),
            ("U2", &"Yes"),
            ("U3", &held),
            ("R1", &"Yes"),
            ("R2", &"Yes"),
            ("R3", &"Yes"),
        ]);
    }
    let (v, hz) = (&model.springs.vertical, &model.springs.horizontal);
    let mut masses = Table::new("JOINT ADDED MASS ASSIGNMENTS");
    for (joint, horizontal, vertical, turning) in
        [(3, body.mass, body.mass, model.inertia), (11, hz.m2, v.m2, 0.0), (12, hz.m2, v.m2, 0.0)]
    {
        masses = masses.row(&[
            ("Joint", &joint),
            ("CoordSys", &"GLOBAL"),
            ("Mass1", &digits(horizontal * KILO)),
            ("Mass2", &0),
            ("Mass3", &digits(vertical * KILO)),
            ("MMI1", &0),
            ("MMI2", &digits(turning * KILO)),
            ("MMI3", &0),
        ]);
    }
    [joints, restraints, masses]
}

/// What the legs are made of, and where they are.
fn legs(model: &Model) -> Vec<Table> {
    let body = model.body();
    let (v, hz) = (&model.springs.vertical, &model.springs.horizontal);
    let stiffest = v.k1.max(v.k2).max(hz.k1).max(hz.k2);
    let (stiffness, length) = (LEG_STIFFNESS * stiffest * KILO, body.radius());
    let area = digits(stiffness * length / LEG_E);
    let inertia = digits(stiffness * length.powi(3) / 3.0 / LEG_E);
    let mut frames = Table::new("CONNECTIVITY - FRAME");
    let mut sections = Table::new("FRAME SECTION ASSIGNMENTS");
    for frame in [1, 2] {
        frames = frames.row(&[("Frame", &frame), ("JointI", &frame), ("JointJ", &3), ("IsCurved", &"No")]);
        sections = sections.row(&[
            ("Frame", &frame),
            ("SectionType", &"General"),
            ("AutoSelect", &"N.A."),
            ("AnalSect", &"LEG"),
            ("DesignSect", &"N.A."),
            ("MatProp", &"Default"),
        ]);
    }
    vec![
        Table::new("MATERIAL PROPERTIES 01 - GENERAL").row(&[
            ("Material", &"RIGID"),
            ("Type", &"Other"),
            ("SymType", &"Isotropic"),
            ("TempDepend", &"No"),
            ("Color", &"Gray8Dark"),
        ]),
        Table::new("MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES").row(&[
            ("Material", &"RIGID"),
            ("UnitWeight", &0),
            ("UnitMass", &0),
            ("E1", &digits(LEG_E)),
            ("G12", &digits(LEG_E / 2.0)),
            ("U12", &0),
            ("A1", &0),
        ]),
        // AS2 = AS3 = 0: no shear deformation
        Table::new("FRAME SECTION PROPERTIES 01 - GENERAL").row(&[
            ("SectionName", &"LEG"),
            ("Material", &"RIGID"),
            ("Shape", &"General"),
            ("t3", &1),
            ("t2", &1),
            ("Area", &area),
            ("TorsConst", &inertia),
            ("I33", &inertia),
            ("I22", &inertia),
            ("I23", &0),
            ("AS2", &0),
            ("AS3", &0),
            ("Color", &"Gray8Dark"),
        ]),
        frames,
        sections,
    ]
}

fn geometry(model: &Model) -> Vec<Table> {
    let [joints, restraints, masses] = joints(model);
    let mut tables = legs(model);
    // joints before the frames between them
    tables.insert(3, joints);
    tables.extend([restraints, masses]);
    tables
}
