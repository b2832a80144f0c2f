//! The weight, the ground motion, and the load cases that apply them.

use super::{KILO, SapModel, SapTable, function::pairs};
use crate::{model::digits, stepping::EvenSteps};
use fixed_steps::Integrator;
use rocking::scalar::GRAVITY;

/// Functions of the record.
const ACROSS: &str = "GROUND_MOTION";
const UPWARDS: &str = "GROUND_MOTION_UP";

pub(super) fn loads(parts: &SapModel) -> Vec<SapTable> {
    let mut forces = SapTable::new("JOINT LOADS - FORCE");
    for joint in parts.joints.iter().filter(|joint| joint.mass > 0.0) {
        forces.add(&[
            ("Joint", &joint.tag),
            ("LoadPat", &"WEIGHT"),
            ("CoordSys", &"GLOBAL"),
            ("F1", &0),
            ("F2", &0),
            ("F3", &digits(-joint.mass * GRAVITY * KILO)),
            ("M1", &0),
            ("M2", &0),
            ("M3", &0),
        ]);
    }
    let patterns = SapTable::new("LOAD PATTERN DEFINITIONS").row(&[
        ("LoadPat", &"WEIGHT"),
        ("DesignType", &"DEAD"),
        ("SelfWtMult", &0),
    ]);
    vec![patterns, forces]
}

pub(super) fn cases(parts: &SapModel) -> Vec<SapTable> {
    let output = parts.output();
    let settings = CaseSettings::of(&parts.even);
    vec![
        SapTable::new("LOAD CASE DEFINITIONS")
            .row(&[
                ("Case", &"GRAVITY"),
                ("Type", &"NonStatic"),
                ("InitialCond", &"Zero"),
                ("RunCase", &"Yes"),
            ])
            .row(&[
                ("Case", &"QUAKE"),
                ("Type", &"NonDirHist"),
                ("InitialCond", &"GRAVITY"),
                ("RunCase", &"Yes"),
            ]),
        SapTable::new("CASE - STATIC 1 - LOAD ASSIGNMENTS").row(&[
            ("Case", &"GRAVITY"),
            ("LoadType", &"Load pattern"),
            ("LoadName", &"WEIGHT"),
            ("LoadSF", &1),
        ]),
        SapTable::new("CASE - STATIC 2 - NONLINEAR LOAD APPLICATION").row(&[
            ("Case", &"GRAVITY"),
            ("LoadApp", &"Full Load"),
            ("MonitorDOF", &"U3"),
            ("MonitorJt", &parts.watched),
        ]),
        SapTable::new("CASE - STATIC 4 - NONLINEAR PARAMETERS").row(&[
            ("Case", &"GRAVITY"),
            ("GeoNonLin", &"Large Displ"),
            ("ResultsSave", &"Final State"),
        ]),
        SapTable::new("CASE - DIRECT HISTORY 1 - GENERAL").row(&[
            ("Case", &"QUAKE"),
            ("OutSteps", &output.count),
            ("StepSize", &digits(output.step_s)),
        ]),
        motions(parts),
        // dashpots and materials have all damping
        SapTable::new("CASE - DIRECT HISTORY 3 - PROPORTIONAL DAMPING").row(&[
            ("Case", &"QUAKE"),
            ("SpecifyType", &"Direct"),
            ("MassCoeff", &0),
            ("StiffCoeff", &0),
        ]),
        settings.integration(),
        SapTable::new("CASE - DIRECT HISTORY 5 - NONLINEAR PARAMETERS").row(&[
            ("Case", &"QUAKE"),
            ("GeoNonLin", &"Large Displ"),
            ("DTMax", &settings.longest),
            ("DTMin", &settings.shortest),
            ("MaxIterCS", &settings.constant),
            ("MaxIterNR", &settings.newton),
            ("ItConvTol", &settings.tolerance),
            ("UseEvStep", &"No"),
            // line searches of an iteration, at most
            ("LSPerIter", &0),
        ]),
    ]
}

/// The ground's acceleration across, and upwards where the record has it.
fn motions(parts: &SapModel) -> SapTable {
    let mut table = SapTable::new("CASE - DIRECT HISTORY 2 - LOAD ASSIGNMENTS");
    let mut motion = |direction: &str, function: &str| {
        table.add(&[
            ("Case", &"QUAKE"),
            ("LoadType", &"Accel"),
            ("LoadName", &direction),
            ("Function", &function),
            ("TransAccSF", &1),
            ("TimeFactor", &1),
            ("ArrivalTime", &0),
            ("CoordSys", &"GLOBAL"),
            ("Angle", &0),
        ]);
    };
    motion("U1", ACROSS);
    if parts.record.vertical.is_some() {
        motion("U3", UPWARDS);
    }
    table
}

/// How the program steps.
pub(super) struct CaseSettings {
    integrator: Integrator,
    /// Substeps (s).
    pub(super) longest: String,
    pub(super) shortest: String,
    pub(super) constant: usize,
    pub(super) newton: usize,
    pub(super) tolerance: String,
}

impl CaseSettings {
    pub(super) fn of(even: &EvenSteps) -> Self {
        Self {
            integrator: even.integrator,
            longest: digits(even.step),
            shortest: digits(even.step / even.substeps as f64),
            constant: 0,
            newton: even.newton,
            tolerance: even.unbalance.map_or("0.0001".into(), digits),
        }
    }

    /// Its method: Newmark's, or Hilber-Hughes-Taylor's; others are refused before.
    pub(super) fn method(&self) -> &'static str {
        match self.integrator {
            Integrator::Newmark { .. } => "Newmark",
            _ => "HilberHughesTaylor",
        }
    }

    /// Gamma, beta, alpha.
    pub(super) fn constants(&self) -> [f64; 3] {
        match self.integrator {
            Integrator::Newmark { gamma, beta } => [gamma, beta, 0.0],
            Integrator::Hht { alpha } => [0.5 - alpha, 0.25 * (1.0 - alpha).powi(2), alpha],
            _ => [5.0 / 6.0, 4.0 / 9.0, -1.0 / 3.0],
        }
    }

    fn integration(&self) -> SapTable {
        let [gamma, beta, alpha] = self.constants();
        SapTable::new("CASE - DIRECT HISTORY 4 - INTEGRATION PARAMETERS").row(&[
            ("Case", &"QUAKE"),
            ("IntMethod", &self.method()),
            ("Gamma", &digits(gamma)),
            ("Beta", &digits(beta)),
            ("Alpha", &digits(alpha)),
        ])
    }
}

pub(super) fn record(parts: &SapModel) -> Vec<SapTable> {
    let mut table = SapTable::new("FUNCTION - TIME HISTORY - USER");
    let record = parts.record;
    let up: &[f64] = if record.vertical.is_some() { record.up() } else { &[] };
    for (name, motion) in [(ACROSS, &record.accel[..]), (UPWARDS, up)] {
        for [time, a] in pairs(record.dt, motion) {
            table.add(&[("Name", &name), ("Time", &digits(time)), ("Value", &digits(a))]);
        }
    }
    vec![table]
}
