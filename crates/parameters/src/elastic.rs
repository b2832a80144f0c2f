//! `parameters.json` of an elastic structure: springs under every corner, and what was measured of
//! them.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::corner::CornerRow;
use super::program::{CornerUnits, ProgramRow};
use super::{ParametersError, RecordRow, RememberedError, SCHEMA, checks::UnitScale, file};
use cases::Yardstick;
use dynamics::spring::{Chain, Springs};
use frames::{
    assembled::{Assembled, AssemblyError},
    ensemble::Ensemble,
    structure::ElasticStructure,
};
use results::{DesignForces, FiledFinding, PeakPair};
use rocking::members::{Damper, Members, Tendon};
use springs::elastic::suite::Measured;
use strong_motion::{Record, excitation::Excitation};

/// The first schema with elastic structures.
const FIRST: u32 = 2;

/// What was measured of the springs without the record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElasticAssessment {
    /// What the error that was asked for is one of.
    #[serde(default, skip_serializing_if = "Yardstick::is_histories")]
    pub judged_by: Yardstick,
    /// Error asked for: NRMSE of the rotations, or of peaks.
    pub accuracy: f64,
    /// Whether it was reached; not if there was nothing to measure it on.
    pub reached: bool,
    /// On what, and how well.
    pub measured: Measured,
}

/// The reference and the finite elements on the record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OnRecord {
    /// Length that could be compared (s).
    pub compared_s: f64,
    /// Whether that is all of it.
    pub whole: bool,
    /// Length in which a change of a millionth grows to less than a thousandth of the peak and no
    /// corner slides on from a landing, if that is not all of it (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub foretold_s: Option<f64>,
    /// When a corner of the reference lands so flat that it slides on, if that is where this ends
    /// (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slides_on_s: Option<f64>,
    /// Omega_n/2 pi of softer springs that hold the accuracy over that length (Hz).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub softer_omega_n_hz: Option<f64>,
    /// NRMSE of the rotations over that length; none where the reference is not lifted, or the
    /// history on springs ends before.
    pub nrmse_rotation: Option<f64>,
    /// NRMSE of the drifts; none where the history on springs ends before.
    pub nrmse_drift: Option<f64>,
    /// Largest rotation of the reference over alpha of the rigid body.
    pub peak_ratio_reference: f64,
    /// The same on the springs.
    pub peak_ratio_fem: f64,
    /// Largest drift of the reference (m).
    pub peak_drift_reference_m: f64,
    /// The same on the springs (m).
    pub peak_drift_fem_m: f64,
    /// When the reference lifts first (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lifts_s: Option<f64>,
    /// Landings of the reference.
    pub landings_reference: usize,
    /// Touches of corners on the springs.
    pub touches_fem: usize,
    /// Largest energy that the finite elements' account misses, over the largest energy.
    pub energy_residual: f64,
    /// Peaks over motions near the record, where it cannot be foretold to its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near: Option<Ensemble>,
}

/// What a pier's column is made of, where the structure gives a frequency or leaves something out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColumnRow {
    /// Bending stiffness EI (N m2).
    pub ei_nm2: f64,
    /// Axial stiffness EA (N).
    pub ea_n: f64,
}

impl ColumnRow {
    fn of(structure: &ElasticStructure) -> Option<Self> {
        match structure {
            ElasticStructure::Pier(pier) => Some(Self { ei_nm2: pier.ei(), ea_n: pier.ea() }),
            ElasticStructure::AFrame(_) | ElasticStructure::Frame(_) => None,
        }
    }
}

/// What the file holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElasticParameters {
    /// Version of the keys.
    pub schema: u32,
    /// As given, checked.
    pub structure: ElasticStructure,
    /// The column of a pier as it is computed with; there to read, and changes nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<ColumnRow>,
    /// Dampers between corners and ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damper: Option<Damper>,
    /// A tendon from the mass to the ground, of a frame one along each column.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tendon: Option<Tendon>,
    /// The record, if there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub record: Option<RecordRow>,
    /// Omega_n/2 pi of the vertical units, of all mass on one k1 (Hz).
    pub omega_n_hz: f64,
    /// Under every corner, from the left.
    pub springs: Vec<CornerRow>,
    /// Springs for a program with fixed time steps, in place of these.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub program: Option<ProgramRow<CornerUnits>>,
    /// What was measured without the record.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assessment: Option<ElasticAssessment>,
    /// And on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_record: Option<OnRecord>,
    /// Largest displacements of both models on the record.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peaks: Option<PeakPair>,
    /// Forces to design with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design_forces: Option<DesignForces>,
    /// What a reader must know besides.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<FiledFinding>,
}

impl ElasticParameters {
    /// Springs under corners at these places.
    pub fn new(
        structure: ElasticStructure,
        omega_n_hz: f64,
        corners: &[(f64, Springs<Chain>)],
    ) -> Self {
        let row = |(x, springs): &(f64, Springs<Chain>)| CornerRow {
            x_m: *x,
            vertical: (&springs.vertical).into(),
            horizontal: (&springs.horizontal).into(),
        };
        let springs = corners.iter().map(row).collect();
        Self {
            schema: SCHEMA,
            column: ColumnRow::of(&structure),
            structure,
            damper: None,
            tendon: None,
            record: None,
            omega_n_hz,
            springs,
            program: None,
            assessment: None,
            on_record: None,
            peaks: None,
            design_forces: None,
            findings: Vec::new(),
        }
    }

    /// The same of a structure with these members.
    pub fn with_members(self, Members { damper, tendon, .. }: Members) -> Self {
        Self { damper, tendon, ..self }
    }

    /// What the structure has besides.
    pub(crate) fn members(&self) -> Members {
        Members { damper: self.damper, tendon: self.tendon, friction: None }
    }

    /// The structure with its members.
    ///
    /// # Errors
    /// It does not stand under its tendon.
    pub fn assembled(&self) -> Result<Assembled, AssemblyError> {
        Assembled::with_members(self.structure, self.members())
    }

    /// Whether a file's text is of an elastic structure.
    pub(crate) fn is(text: &str) -> bool {
        let Ok(value) = serde_json::from_str::<serde_json::Value>(text) else { return false };
        value["springs"].is_array() && value["structure"]["kind"].is_string()
    }

    /// Read a file, if it is of an elastic structure.
    ///
    /// # Errors
    /// It cannot be read; what is wrong with it.
    pub fn read(path: &Path) -> Result<Option<Self>, ParametersError> {
        let (name, text) = file::read(path)?;
        if Self::is(&text) { Self::parse(&name, &text).map(Some) } else { Ok(None) }
    }

    /// Parse a file's text; `path` names it in messages.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(path: &str, text: &str) -> Result<Self, ParametersError> {
        file::known(path, text)?;
        let parameters: Self = file::parse(path, text)?;
        let value =
            |message: String| ParametersError::Parse { path: path.into(), line: 1, message };
        if !(FIRST..=SCHEMA).contains(&parameters.schema) {
            let found = parameters.schema;
            return Err(value(format!(
                "schema is {found}, this program reads {FIRST} to {SCHEMA}; run tune run again"
            )));
        }
        let structure = parameters.structure.checked().map_err(|e| value(e.to_string()))?;
        structure.check_members(parameters.members()).map_err(|e| value(e.to_string()))?;
        parameters.record.iter().try_for_each(|row| row.check(path))?;
        let body = structure.body();
        let scale = UnitScale { mass: body.mass, height: body.height };
        let corners = structure.layout().corners.len();
        parameters.program.iter().try_for_each(|row| row.check(path))?;
        let program = parameters.program.iter().map(|row| ("program.springs", &row.units.springs));
        for (key, rows) in [("springs", &parameters.springs)].into_iter().chain(program) {
            if rows.len() != corners {
                let found = rows.len();
                return Err(value(format!(
                    "{key} has {found} rows, the structure {corners} corners; run tune run again"
                )));
            }
            let bad = |row: &CornerRow| !row.vertical.good() || !row.horizontal.good();
            if let Some(i) = rows.iter().position(bad) {
                return Err(value(format!(
                    "{key}, row {}: k1, k2 and m2 must be finite and above zero, c zero or more; \
                     run tune run again",
                    i + 1
                )));
            }
            for (i, row) in rows.iter().enumerate() {
                for (unit, numbers) in [("vertical", row.vertical), ("horizontal", row.horizontal)]
                {
                    let unit = format!("{key}, row {}: {unit}", i + 1);
                    scale.check(path, &unit, numbers.numbers())?;
                }
            }
        }
        Ok(parameters)
    }

    /// As JSON.
    pub fn to_json(&self) -> String {
        file::to_json(self)
    }

    /// Under every corner.
    pub fn chains(&self) -> Vec<Springs<Chain>> {
        self.springs.iter().map(CornerRow::chains).collect()
    }

    /// The ground motion again; `path` is that of the file.
    ///
    /// # Errors
    /// The record is not there, has changed, or was in no file.
    pub fn excitation(&self, path: &Path) -> Result<Excitation, RememberedError> {
        match &self.record {
            Some(row) => row.excitation(path),
            None => Ok(Excitation::whole(Record::el_centro())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use springs::elastic::suite::ElasticErrors;

    fn parameters() -> ElasticParameters {
        let structure = toml::from_str(
            "kind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
             footing_mass_kg = 120e3\nfooting_height_m = 1.5\n\
             frequency_hz = 2.0\ndamping_ratio = 0.02\n",
        )
        .unwrap();
        let chain = Chain { k1: 1e10, k2: 5e8, m2: 2e4, c: 1e7 };
        let springs = Springs { vertical: chain, horizontal: chain };
        ElasticParameters::new(structure, 160.0, &[(-2.0, springs), (2.0, springs)])
    }

    #[test]
    fn a_file_is_read_as_it_was_written() {
        let written = parameters();
        let text = written.to_json();
        assert!(ElasticParameters::is(&text) && !ElasticParameters::is("{}"));
        assert_eq!(ElasticParameters::parse("p.json", &text).unwrap(), written);
        // what a frequency of 2 Hz comes to
        let ElasticStructure::Pier(pier) = written.structure else { panic!() };
        let column = ColumnRow { ei_nm2: pier.ei(), ea_n: pier.ea() };
        assert!(written.column == Some(column) && column.ei_nm2 > 1e9);
    }

    /// JSON has no infinity.
    #[test]
    fn errors_that_could_not_be_had_are_read_back() {
        let errors = ElasticErrors {
            median: [f64::INFINITY, 0.1],
            p90: [f64::INFINITY; 2],
            count: 3,
            touches: 2.0,
            peaks: None,
        };
        let measured = Measured { motions: Some(errors), ..Measured::default() };
        let on_record = OnRecord {
            compared_s: 5.0,
            slides_on_s: Some(5.0),
            peak_ratio_reference: 0.5,
            peak_ratio_fem: 2.0,
            peak_drift_reference_m: 0.1,
            peak_drift_fem_m: 0.2,
            lifts_s: Some(1.5),
            landings_reference: 4,
            touches_fem: 9,
            energy_residual: 1e-7,
            ..OnRecord::default()
        };
        let assessment = ElasticAssessment {
            judged_by: Yardstick::Histories,
            accuracy: 0.002,
            reached: false,
            measured,
        };
        let written = ElasticParameters {
            assessment: Some(assessment),
            on_record: Some(on_record),
            ..parameters()
        };
        let text = written.to_json();
        assert!(text.contains("\"nrmse_rotation\": null"), "{text}");
        assert_eq!(ElasticParameters::parse("p.json", &text).unwrap(), written);
    }

    #[test]
    fn what_does_not_fit_is_refused_with_a_line() {
        let text = parameters().to_json();
        for (from, to, said) in [
            ("\"k1_n_per_m\": 10000000000.0", "\"k1_n_per_m\": 0.0", "row 1"),
            ("\"schema\": 4", "\"schema\": 1", "schema is 1"),
            ("\"x_m\"", "\"y_m\"", "y_m"),
            ("\"height_m\": 12.0", "\"height_m\": -12.0", "height_m"),
        ] {
            assert!(text.contains(from), "{from}: {text}");
            let error = ElasticParameters::parse("p.json", &text.replacen(from, to, 1))
                .unwrap_err()
                .to_string();
            // the line is said once, in front
            assert!(error.contains(said) && error.matches("line ").count() == 1, "{error}");
        }
    }

    /// As of a rigid body: a file of a newer program is told so whatever its keys, a record has a
    /// length, and numbers are of a size that means something.
    #[test]
    fn a_file_is_checked_as_that_of_a_rigid_body_is() {
        let newer = "\"schema\": 5,\n  \"new_key\": 1";
        let record = "\"record\": {\"name\": \"r\", \"dt_s\": 0.01, \"samples\": 9, \
                      \"pga_g\": 0.3, \"duration_s\": -1.0},\n  \"omega_n_hz\"";
        let text = parameters().to_json();
        for (from, to, message) in [
            ("\"schema\": 4", newer, "its schema is 5, this program reads up to 4"),
            ("\"omega_n_hz\"", record, "record.duration_s is -1.0"),
            (
                "\"k1_n_per_m\": 10000000000.0",
                "\"k1_n_per_m\": 1e22",
                "springs, row 1: vertical.k1_n_per_m is 1e22, 1.4e16 times the weight",
            ),
            ("\"m2_kg\": 20000.0", "\"m2_kg\": 2e-9", "vertical.m2_kg is 2e-9"),
        ] {
            assert!(text.contains(from), "{from}: {text}");
            let error = ElasticParameters::parse("p.json", &text.replacen(from, to, 1))
                .unwrap_err()
                .to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
