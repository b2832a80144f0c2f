//! Records: what a file has, and pulses made as files.

use std::path::Path;

use serde::Serialize;

use crate::{
    WebError,
    any_case::AnyCase,
    thin::{GroundSeries, Thinning},
};
use rocking::synthetic::Pulse;
use std::f64::consts::TAU;
use strong_motion::{ReadOptions, Recording, Source};

/// A component of the record's file.
#[derive(Serialize)]
struct ComponentChoice {
    /// As a case names it: its name, else its azimuth.
    name: String,
    /// Name and direction.
    label: String,
    vertical: bool,
    pga_g: f64,
    taken: bool,
}

/// The case's record.
#[derive(Serialize)]
pub(crate) struct RecordAnswer {
    /// Which, its scale, its length, its peak.
    line: String,
    name: String,
    /// What the program says of the file.
    notices: Vec<String>,
    components: Vec<ComponentChoice>,
    dt_s: f64,
    /// Of the whole record (s).
    duration_s: f64,
    /// Of the part used, scaled.
    pga_g: f64,
    vertical: bool,
    ground: GroundSeries,
}

pub(crate) fn read(case: &AnyCase) -> Result<RecordAnswer, WebError> {
    let excitation = case.excitation();
    let used = excitation.used()?;
    Ok(RecordAnswer {
        line: excitation.line(),
        name: used.name.clone(),
        notices: case.notices().iter().map(ToString::to_string).collect(),
        components: components(&excitation.record.source)?,
        dt_s: used.dt,
        duration_s: excitation.record.duration(),
        pga_g: used.pga_g(),
        vertical: used.vertical.is_some(),
        ground: Thinning::ground(&used.accel, used.dt),
    })
}

/// What the record's file has to choose from; nothing if it comes from none.
fn components(source: &Source) -> Result<Vec<ComponentChoice>, WebError> {
    let Source::File { path, component, units, .. } = source else { return Ok(Vec::new()) };
    // of a table whose unit it does not tell one column was taken: there is nothing to choose
    let options = ReadOptions { component: component.clone(), ..ReadOptions::default() };
    let recording = Recording::read(Path::new(path), &options).or_else(|_| {
        Recording::read(Path::new(path), &ReadOptions { units: Some(*units), ..options })
    });
    let Ok(recording) = recording else { return Ok(Vec::new()) };
    let row = |(i, component): (usize, &strong_motion::Component)| ComponentChoice {
        name: component.name.clone().unwrap_or_else(|| component.direction.to_string()),
        label: component.label(),
        vertical: component.direction == strong_motion::Direction::Vertical,
        pga_g: component.record.pga_g(),
        taken: i == recording.taken,
    };
    Ok(recording.components.iter().enumerate().map(row).collect())
}

/// Samples to a pulse's period.
const TO_A_PERIOD: f64 = 100.0;
/// What follows the pulse, in its periods: the body goes on rocking.
const AFTER: f64 = 6.0;
/// Amplitudes (g).
const AMPLITUDES: (f64, f64) = (0.001, 10.0);
/// Periods (s).
const PERIODS: (f64, f64) = (0.05, 20.0);

/// Time step of a pulse (s): a hundredth of its period, rounded down to 1, 2 or 5 times a power of
/// ten, from 0.5 ms to 0.1 s.
pub(crate) fn pulse_step(period_s: f64) -> f64 {
    let asked = period_s / TO_A_PERIOD;
    [0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005]
        .into_iter()
        .find(|step| *step <= asked)
        .unwrap_or(0.0005)
}

/// The file of a pulse: its amplitude (g) and period (s), then a line a sample.
pub(crate) fn pulse(amplitude_g: f64, period_s: f64) -> Result<String, WebError> {
    for (name, value, (least, most), unit) in
        [("amplitude", amplitude_g, AMPLITUDES, "g"), ("period", period_s, PERIODS, "s")]
    {
        if !(least..=most).contains(&value) {
            return Err(WebError::Pulse { name, value, least, most, unit });
        }
    }
    let (dt, omega) = (pulse_step(period_s), TAU / period_s);
    let shape = Pulse::RickerAntisymmetric;
    let before = (shape.half_length() / (omega * dt)).ceil();
    let samples = (2.0 * before + AFTER * period_s / dt) as usize;
    let mut text = format!(
        "# antisymmetric Ricker wavelet, amplitude {amplitude_g} g, period {period_s} s; in g, \
            time step {dt} s\n"
    );
    for i in 0..=samples {
        let accel = amplitude_g * shape.acceleration(omega * dt * (i as f64 - before));
        text.push_str(&format!("{accel:.9e}\n"));
    }
    Ok(text)
}
