//! The weight, the ground motion, and the load cases that apply them.

use super::{KILO, SapModel, SapTable};
use crate::model::digits;
use rocking::scalar::GRAVITY;

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
    let step = parts.record.dt / parts.even_steps as f64;
    let out_steps = parts.samples.saturating_sub(1) * parts.even_steps;
    vec![
        SapTable::new("LOAD CASE DEFINITIONS")
            .row(&[("Case", &"GRAVITY"), ("Type", &"NonStatic"), ("InitialCond", &"Zero"), ("RunCase", &"Yes")])
            .row(&[("Case", &"QUAKE"), ("Type", &"NonDirHist"), ("InitialCond", &"GRAVITY"), ("RunCase", &"Yes")]),
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
            ("OutSteps", &out_steps),
            ("StepSize", &digits(step)),
        ]),
        SapTable::new("CASE - DIRECT HISTORY 2 - LOAD ASSIGNMENTS").row(&[
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
        // dashpots and materials have all damping
        SapTable::new("CASE - DIRECT HISTORY 3 - PROPORTIONAL DAMPING").row(&[
            ("Case", &"QUAKE"),
            ("SpecifyType", &"Direct"),
            ("MassCoeff", &0),
            ("StiffCoeff", &0),
        ]),
        SapTable::new("CASE - DIRECT HISTORY 4 - INTEGRATION PARAMETERS").row(&[
            ("Case", &"QUAKE"),
            ("IntMethod", &"HilberHughesTaylor"),
            ("Gamma", &digits(5.0 / 6.0)),
            ("Beta", &digits(4.0 / 9.0)),
            ("Alpha", &digits(-1.0 / 3.0)),
        ]),
        SapTable::new("CASE - DIRECT HISTORY 5 - NONLINEAR PARAMETERS").row(&[
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

pub(super) fn record(parts: &SapModel) -> Vec<SapTable> {
    let mut table = SapTable::new("FUNCTION - TIME HISTORY - USER");
    for (i, &a) in parts.record.accel.iter().enumerate() {
        let time = i as f64 * parts.record.dt;
        table = table.row(&[("Name", &"GROUND_MOTION"), ("Time", &digits(time)), ("Value", &digits(a))]);
    }
    vec![table]
}
