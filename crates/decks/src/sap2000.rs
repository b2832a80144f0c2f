//! SAP2000 .s2k text tables (File > Import > SAP2000 .s2k Text File), in KN, m.
//!
//! ```text
//!  joint 3 (mass) ── frames 1, 2 (all but rigid) ── joints 1, 2 (feet)
//!      └─ links 1, 2: FOOT ── joints 11, 12 (absorbers, not rotating) ── links 3, 4: GROUND ── joints 21, 22 (fixed)
//! ```
//!
//! So a rigid body; an elastic structure has joints at its nodes, frames between them and FOOT_1,
//! GROUND_1, ... under its corners.
//!
//! Link axes of a vertical link: local 1 up (U1 vertical), local 2 along +X (U2 horizontal). FOOT
//! is a friction isolator: its U1 presses and does not pull, its U2 acts only while U1 presses,
//! which a gap link cannot say. GROUND is a linear link with damping. A gap property FOOT_GAP is
//! defined beside it, not used, for programs or versions without isolators.
//!
//! Table and field names are those of SAP2000's own exports as public files and readers show them.
//! What could not be tried without the program stands in the file's own header.

mod cases;
mod elastic;
mod function;
mod links;
mod parts;
mod sheet;

use std::fmt::{Display, Write};

use super::{model::digits, plain::lines};
use cases::{cases, loads, record};
pub use function::sap_function;
use links::links;
pub(super) use parts::SapModel;
use parts::{Bar, FootJoints, SapSection};
pub(super) use sheet::{ToCompare, of_any_program, sheet};

/// N to KN, and kg to KN s2/m.
const KILO: f64 = 1e-3;
/// Modulus of every material; only its products with area and inertia count [KN/m2].
const MODULUS: f64 = 2e8;
/// Friction coefficient: a pressing foot never slides.
const FRICTION: f64 = 1000.0;

/// What a user must know before trusting the file.
const NOTES: &str = "\
$ Import: File > Import > SAP2000 .s2k Text File; then run load cases GRAVITY and QUAKE.
$ Not verified with the program (tables and fields follow SAP2000's own exports):
$  1. FOOT is a friction isolator (LINK PROPERTY DEFINITIONS 08 - SLIDING ISOLATOR): U1 compression
$     only with k1, U2 with k1 while U1 presses, friction coefficient 1000 so that a foot never
$     slides. In SAP2000 its shear force follows the axial force (force = P mu z); the tuned model
$     has a plain spring that lets go when P = 0. If the import does not know the table, assign
$     FOOT_GAP to the FOOT links: its horizontal spring then also acts on a lifted foot, which is
$     wrong by the foot's travel times k1; use it for small rocking only.
$  2. GeoNonLin of both cases must read 'P-Delta plus Large Displacements': check under Define >
$     Load Cases.
$  3. The springs are for the load case's step and integrator. Set under Nonlinear Parameters:
$     substeps between DTMax and DTMin, no iterations with constant stiffness, Newton-Raphson
$     iterations and relative tolerance as in the table: an emulation of such steps loses histories
$     with a tighter tolerance or with constant stiffness. No line search: LSPerIter, the most of an
$     iteration, is 0; the dialog must read Use Line Search: No.
$  4. The mass source must read Element Self Mass and Additional Mass, no load patterns: the
$     materials' mass and weight per volume are 0.
$  5. The words for the isolator (LinkType), large displacements (GeoNonLin) and ground acceleration
$     (LoadType) differ between versions: if the import log names one, set it in the dialog of the
$     FOOT links or of the load cases.
";

/// The whole file.
pub(super) fn tables(parts: &SapModel) -> String {
    let why = parts.even.not_to_be_used.map_or(String::new(), |why| format!("$ {why}.\n"));
    let damping = parts.damping.as_ref();
    let damping = damping.map_or(String::new(), |of| format!("$  8. {}\n", lines(of, "\n$     ")));
    let (title, of_model) = (&parts.title, &parts.notes);
    let mut text = format!("$ {title}\n{why}{NOTES}{of_model}{damping}{}\n", parts.expected());
    for table in
        [control(), geometry(parts), links(parts), loads(parts), cases(parts), record(parts)]
            .into_iter()
            .flatten()
    {
        text.push_str(&table.text);
        text.push('\n');
    }
    text.push_str("END TABLE DATA\n");
    text
}

/// A table in the making.
struct SapTable {
    text: String,
}

impl SapTable {
    fn new(name: &str) -> Self {
        Self { text: format!("TABLE:  \"{name}\"\n") }
    }

    /// The same with one more row.
    fn row(mut self, fields: &[(&str, &dyn Display)]) -> Self {
        self.add(fields);
        self
    }

    /// One row of field = value; texts with spaces or commas are quoted.
    fn add(&mut self, fields: &[(&str, &dyn Display)]) {
        for (field, value) in fields {
            let value = value.to_string();
            let quote = if value.contains([' ', ',']) { "\"" } else { "" };
            // writing to a String does not fail
            let _ = write!(self.text, "   {field}={quote}{value}{quote}");
        }
        self.text.push('\n');
    }
}

fn control() -> Vec<SapTable> {
    vec![
        SapTable::new("PROGRAM CONTROL").row(&[
            ("ProgramName", &"SAP2000"),
            ("Version", &"20.0.0"),
            ("CurrUnits", &"KN, m, C"),
            ("MergeTol", &"0.0001"),
        ]),
        SapTable::new("ACTIVE DEGREES OF FREEDOM").row(&[
            ("UX", &"Yes"),
            ("UY", &"No"),
            ("UZ", &"Yes"),
            ("RX", &"No"),
            ("RY", &"Yes"),
            ("RZ", &"No"),
        ]),
        SapTable::new("MASS SOURCE").row(&[
            ("MassSource", &"ADDED"),
            ("Elements", &"Yes"),
            ("Masses", &"Yes"),
            ("Loads", &"No"),
            ("IsDefault", &"Yes"),
        ]),
    ]
}

/// Joints, what holds them, and the masses at them.
fn joints(parts: &SapModel) -> [SapTable; 3] {
    let mut joints = SapTable::new("JOINT COORDINATES");
    let mut joint = |tag: usize, [x, z]: [f64; 2]| {
        joints.add(&[
            ("Joint", &tag),
            ("CoordSys", &"GLOBAL"),
            ("CoordType", &"Cartesian"),
            ("XorR", &digits(x)),
            ("Y", &0),
            ("Z", &digits(z)),
        ]);
    };
    parts.joints.iter().for_each(|each| joint(each.tag, each.place));
    let below = |foot: &FootJoints, links: f64| {
        let [x, z] = parts.place(foot.joint);
        [x, z - links * parts.link]
    };
    parts.feet.iter().for_each(|foot| joint(foot.absorber, below(foot, 1.0)));
    parts.feet.iter().for_each(|foot| joint(foot.ground, below(foot, 2.0)));

    let mut restraints = SapTable::new("JOINT RESTRAINT ASSIGNMENTS");
    let absorbers = parts.feet.iter().map(|foot| (foot.absorber, "No"));
    for (joint, held) in absorbers.chain(parts.feet.iter().map(|foot| (foot.ground, "Yes"))) {
        restraints.add(&[
            ("Joint", &joint),
            ("U1", &held),
            ("U2", &"Yes"),
            ("U3", &held),
            ("R1", &"Yes"),
            ("R2", &"Yes"),
            ("R3", &"Yes"),
        ]);
    }
    let mut masses = SapTable::new("JOINT ADDED MASS ASSIGNMENTS");
    let heavy = parts.joints.iter().filter(|joint| joint.mass > 0.0);
    let absorber = |foot: &FootJoints| {
        let springs = &parts.units[foot.unit].springs;
        (foot.absorber, springs.horizontal.m2, springs.vertical.m2, 0.0)
    };
    let all =
        heavy.map(|j| (j.tag, j.mass, j.mass, j.inertia)).chain(parts.feet.iter().map(absorber));
    for (joint, horizontal, vertical, turning) in all {
        masses.add(&[
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

/// Materials: by name, each once, with their damping over stiffness.
fn materials(parts: &SapModel) -> Vec<SapTable> {
    let mut general = SapTable::new("MATERIAL PROPERTIES 01 - GENERAL");
    let mut mechanical = SapTable::new("MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES");
    let mut damping = SapTable::new("MATERIAL PROPERTIES 06 - DAMPING PARAMETERS");
    let mut seen: Vec<&str> = Vec::new();
    for SapSection { material, ahead, .. } in &parts.sections {
        if seen.contains(&material.as_str()) {
            continue;
        }
        seen.push(material);
        general.add(&[
            ("Material", material),
            ("Type", &"Other"),
            ("SymType", &"Isotropic"),
            ("TempDepend", &"No"),
            ("Color", &"Gray8Dark"),
        ]);
        mechanical.add(&[
            ("Material", material),
            ("UnitWeight", &0),
            ("UnitMass", &0),
            ("E1", &digits(MODULUS)),
            ("G12", &digits(MODULUS / 2.0)),
            ("U12", &0),
            ("A1", &0),
        ]);
        if *ahead > 0.0 {
            damping.add(&[
                ("Material", material),
                ("ModalRatio", &0),
                ("VisMass", &0),
                ("VisStiff", &digits(*ahead)),
                ("HysMass", &0),
                ("HysStiff", &0),
            ]);
        }
    }
    let damped = parts.sections.iter().any(|section| section.ahead > 0.0);
    [general, mechanical].into_iter().chain(damped.then_some(damping)).collect()
}

fn sections(parts: &SapModel) -> SapTable {
    let mut table = SapTable::new("FRAME SECTION PROPERTIES 01 - GENERAL");
    for SapSection { name, material, axial, bending, shear, .. } in &parts.sections {
        let [area, inertia] = [axial, bending].map(|stiffness| digits(stiffness * KILO / MODULUS));
        // AS2 = AS3 = 0: no shear deformation; G is E/2
        let sheared =
            if shear.is_finite() { digits(2.0 * shear * KILO / MODULUS) } else { "0".into() };
        table.add(&[
            ("SectionName", name),
            ("Material", material),
            ("Shape", &"General"),
            ("t3", &1),
            ("t2", &1),
            ("Area", &area),
            ("TorsConst", &inertia),
            ("I33", &inertia),
            ("I22", &inertia),
            ("I23", &0),
            ("AS2", &sheared),
            ("AS3", &sheared),
            ("Color", &"Gray8Dark"),
        ]);
    }
    table
}

fn frames(parts: &SapModel) -> [SapTable; 2] {
    let mut frames = SapTable::new("CONNECTIVITY - FRAME");
    let mut assigned = SapTable::new("FRAME SECTION ASSIGNMENTS");
    for (i, Bar { joints: [from, to], section }) in parts.bars.iter().enumerate() {
        let frame = i + 1;
        frames.add(&[("Frame", &frame), ("JointI", from), ("JointJ", to), ("IsCurved", &"No")]);
        assigned.add(&[
            ("Frame", &frame),
            ("SectionType", &"General"),
            ("AutoSelect", &"N.A."),
            ("AnalSect", &parts.sections[*section].name),
            ("DesignSect", &"N.A."),
            ("MatProp", &"Default"),
        ]);
    }
    [frames, assigned]
}

fn geometry(parts: &SapModel) -> Vec<SapTable> {
    let [joints, restraints, masses] = joints(parts);
    let [frames, assigned] = frames(parts);
    let mut tables = materials(parts);
    // joints before the frames between them
    tables.extend([sections(parts), joints, frames, assigned, restraints, masses]);
    tables
}
