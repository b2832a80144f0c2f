//! One component of a file: its numbers, for tables and JSON.

use std::f64::consts::PI;

use serde::Serialize;

use rocking::{scalar::GRAVITY, structure::Body};
use strong_motion::{Direction, Peak, Recording, Units};

/// One component. Times are those of the file's header.
#[derive(Debug, Serialize)]
pub struct ComponentRow {
    pub component: String,
    pub direction: Direction,
    pub dt_s: f64,
    pub samples: usize,
    /// Time of the first sample on the header's clock.
    pub start_s: f64,
    /// Unit of the numbers in the file.
    pub unit: Units,
    pub pga_g: f64,
    pub pga_m_per_s2: f64,
    pub pga_time_s: f64,
    /// What the header says of it (m/s2).
    pub header_pga_m_per_s2: Option<Peak>,
    /// By integration, less the mean of the acceleration.
    pub pgv_m_per_s: f64,
    pub pgv_time_s: f64,
    /// What the header says of it (m/s).
    pub header_pgv_m_per_s: Option<Peak>,
    pub arias_m_per_s: f64,
    pub duration_5_95_s: f64,
    /// Mean of the samples as read.
    pub offset_g: f64,
    /// 2 pi PGV/PGA.
    pub pulse_period_s: f64,
    /// Whether a run takes this component.
    pub taken: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub structure: Option<OnStructure>,
}

/// What the record is to a structure: rocking has no period, so no spectrum of an oscillator says
/// it.
#[derive(Debug, Serialize)]
pub struct OnStructure {
    /// Above 1 the body lifts.
    pub pga_over_g_tan_alpha: f64,
    /// Strength of the velocity pulse against p = sqrt(m g R/I0).
    pub p_pgv_over_g_tan_alpha: f64,
    /// Circular frequency of the pulse, PGA/PGV, against p.
    pub pulse_omega_over_p: f64,
}

impl ComponentRow {
    /// The component at an index.
    pub fn new(recording: &Recording, index: usize, body: Option<&Body<f64>>) -> Self {
        let component = &recording.components[index];
        let (record, m) = (&component.record, component.record.measures());
        let time = |peak: Peak| component.start + peak.time.unwrap_or(0.0);
        let structure = body.map(|body| {
            let (p, g_tan) = (body.p(), GRAVITY * body.alpha().tan());
            OnStructure {
                pga_over_g_tan_alpha: m.pga.value.abs() / g_tan,
                p_pgv_over_g_tan_alpha: p * m.pgv.value.abs() / g_tan,
                pulse_omega_over_p: if m.pulse_period_s > 0.0 {
                    2.0 * PI / (m.pulse_period_s * p)
                } else {
                    0.0
                },
            }
        });
        Self {
            component: component.name.clone().unwrap_or_default(),
            direction: component.direction,
            dt_s: record.dt,
            samples: record.len(),
            start_s: component.start,
            unit: component.units,
            pga_g: m.pga.value / GRAVITY,
            pga_m_per_s2: m.pga.value,
            pga_time_s: time(m.pga),
            header_pga_m_per_s2: component.header_pga,
            pgv_m_per_s: m.pgv.value,
            pgv_time_s: time(m.pgv),
            header_pgv_m_per_s: component.header_pgv,
            arias_m_per_s: m.arias_m_per_s,
            duration_5_95_s: m.duration_5_95_s,
            offset_g: component.offset / GRAVITY,
            pulse_period_s: m.pulse_period_s,
            taken: index == recording.taken,
            structure,
        }
    }

    /// The cells below [`head`].
    pub fn cells(&self) -> Vec<String> {
        let header = |peak: Option<Peak>, unit: f64, decimals: usize| {
            peak.map_or("-".to_owned(), |peak| {
                let at = peak.time.map_or(String::new(), |time| format!(" at {time:.2} s"));
                format!("{:.decimals$}{at}", peak.value / unit)
            })
        };
        let mark = if self.taken { "*" } else { "" };
        let mut cells = vec![
            format!("{}{mark}", if self.component.is_empty() { "-" } else { &self.component }),
            match self.direction {
                Direction::Azimuth(degrees) => format!("{degrees}"),
                Direction::Vertical => "vertical".into(),
                Direction::Horizontal => "horizontal".into(),
                Direction::Unknown => "-".into(),
            },
            format!("{}", self.dt_s),
            self.samples.to_string(),
            self.unit.to_string(),
            format!("{:.5} at {:.2} s", self.pga_g, self.pga_time_s),
            header(self.header_pga_m_per_s2, GRAVITY, 5),
            format!("{:.4} at {:.2} s", self.pgv_m_per_s, self.pgv_time_s),
            header(self.header_pgv_m_per_s, 1.0, 4),
            format!("{:.2}", self.duration_5_95_s),
            format!("{:.1e}", self.offset_g),
            format!("{:.2}", self.pulse_period_s),
        ];
        if let Some(on) = &self.structure {
            cells.extend([
                format!("{:.3}", on.pga_over_g_tan_alpha),
                format!("{:.3}", on.p_pgv_over_g_tan_alpha),
                format!("{:.2}", on.pulse_omega_over_p),
            ]);
        }
        cells
    }
}

/// Names of the columns; three more with a structure.
pub fn head(on_structure: bool) -> Vec<&'static str> {
    let mut head = vec![
        "component",
        "azimuth [deg]",
        "dt [s]",
        "samples",
        "unit",
        "PGA [g]",
        "header [g]",
        "PGV [m/s]",
        "header [m/s]",
        "Arias 5-95 % [s]",
        "offset [g]",
        "pulse period [s]",
    ];
    if on_structure {
        head.extend(["PGA/(g tan alpha)", "p PGV/(g tan alpha)", "omega/p of the pulse"]);
    }
    head
}
