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

use std::fmt::{Display, Write};

use super::model::{Model, digits};
use crate::scalar::GRAVITY;

/// N to KN, and kg to KN s2/m.
const KILO: f64 = 1e-3;
/// Modulus of the legs' material; only its products with area and inertia count [KN/m2].
const LEG_E: f64 = 2e8;
/// Length of a link over h: long enough that importing merges no joints. The absorbers do not rotate, so it does not matter.
const LINK_LENGTH: f64 = 0.01;
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

fn geometry(model: &Model) -> Vec<Table> {
    let body = model.body();
    let (b, h) = (body.half_width, body.height);
    let length = body.radius();
    let leg = model.leg * KILO;
    let area = digits(leg * length / LEG_E);
    let inertia = digits(leg * length.powi(3) / (3.0 * LEG_E));
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
        joints,
        frames,
        sections,
        restraints,
        masses,
    ]
}

fn links(model: &Model) -> Vec<Table> {
    let (v, h) = (&model.springs.vertical, &model.springs.horizontal);
    let kilo = |x: f64| digits(x * KILO);
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
    let linear = Table::new("LINK PROPERTY DEFINITIONS 02 - LINEAR")
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
        ]);
    let gap = Table::new("LINK PROPERTY DEFINITIONS 05 - GAP")
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
        ]);
    // DJ = 0: the shear spring sits at the foot, so the foot's rotation does not stretch it. Radius 0: a flat slider.
    let isolator = Table::new("LINK PROPERTY DEFINITIONS 08 - SLIDING ISOLATOR")
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
        ]);
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
    vec![general, linear, gap, isolator, connect, assign]
}

fn loads(model: &Model) -> Vec<Table> {
    let weight = digits(-model.body().mass * GRAVITY * KILO);
    vec![
        Table::new("LOAD PATTERN DEFINITIONS").row(&[
            ("LoadPat", &"WEIGHT"),
            ("DesignType", &"DEAD"),
            ("SelfWtMult", &0),
        ]),
        Table::new("JOINT LOADS - FORCE").row(&[
            ("Joint", &3),
            ("LoadPat", &"WEIGHT"),
            ("CoordSys", &"GLOBAL"),
            ("F1", &0),
            ("F2", &0),
            ("F3", &weight),
            ("M1", &0),
            ("M2", &0),
            ("M3", &0),
        ]),
    ]
}

fn cases(model: &Model) -> Vec<Table> {
    let step = model.record.dt / model.steps_per_sample as f64;
    let out_steps = (model.expected.samples - 1) * model.steps_per_sample;
    vec![
        Table::new("LOAD CASE DEFINITIONS")
            .row(&[("Case", &"GRAVITY"), ("Type", &"NonStatic"), ("InitialCond", &"Zero"), ("RunCase", &"Yes")])
            .row(&[("Case", &"QUAKE"), ("Type", &"NonDirHist"), ("InitialCond", &"GRAVITY"), ("RunCase", &"Yes")]),
        Table::new("CASE - STATIC 1 - LOAD ASSIGNMENTS").row(&[
            ("Case", &"GRAVITY"),
            ("LoadType", &"Load pattern"),
            ("LoadName", &"WEIGHT"),
            ("LoadSF", &1),
        ]),
        Table::new("CASE - STATIC 2 - NONLINEAR LOAD APPLICATION").row(&[
            ("Case", &"GRAVITY"),
            ("LoadApp", &"Full Load"),
            ("MonitorDOF", &"U3"),
            ("MonitorJt", &3),
        ]),
        Table::new("CASE - STATIC 4 - NONLINEAR PARAMETERS").row(&[
            ("Case", &"GRAVITY"),
            ("GeoNonLin", &"Large Displ"),
            ("ResultsSave", &"Final State"),
        ]),
        Table::new("CASE - DIRECT HISTORY 1 - GENERAL").row(&[
            ("Case", &"QUAKE"),
            ("OutSteps", &out_steps),
            ("StepSize", &digits(step)),
        ]),
        Table::new("CASE - DIRECT HISTORY 2 - LOAD ASSIGNMENTS").row(&[
            ("Case", &"QUAKE"),
            ("LoadType", &"Accel"),
            ("LoadName", &"U1"),
            ("Function", &"GROUND_MOTION"),
            ("TransAccSF", &1),
            ("TimeFactor", &1),
            ("ArrivalTime", &0),
            ("CoordSys", &"GLOBAL"),
            ("Angle", &0),
        ]),
        // the dashpots are the only damping
        Table::new("CASE - DIRECT HISTORY 3 - PROPORTIONAL DAMPING").row(&[
            ("Case", &"QUAKE"),
            ("SpecifyType", &"Direct"),
            ("MassCoeff", &0),
            ("StiffCoeff", &0),
        ]),
        Table::new("CASE - DIRECT HISTORY 4 - INTEGRATION PARAMETERS").row(&[
            ("Case", &"QUAKE"),
            ("IntMethod", &"HilberHughesTaylor"),
            ("Gamma", &digits(5.0 / 6.0)),
            ("Beta", &digits(4.0 / 9.0)),
            ("Alpha", &digits(-1.0 / 3.0)),
        ]),
        Table::new("CASE - DIRECT HISTORY 5 - NONLINEAR PARAMETERS").row(&[
            ("Case", &"QUAKE"),
            ("GeoNonLin", &"Large Displ"),
            ("DTMax", &0),
            ("DTMin", &0),
            ("MaxIterCS", &10),
            ("MaxIterNR", &40),
            ("ItConvTol", &"0.0001"),
            ("UseEvStep", &"No"),
        ]),
    ]
}

fn record(model: &Model) -> Vec<Table> {
    let mut table = Table::new("FUNCTION - TIME HISTORY - USER");
    for (i, &a) in model.record.accel.iter().enumerate() {
        let time = i as f64 * model.record.dt;
        table = table.row(&[("Name", &"GROUND_MOTION"), ("Time", &digits(time)), ("Value", &digits(a))]);
    }
    vec![table]
}
