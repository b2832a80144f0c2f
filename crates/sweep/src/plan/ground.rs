//! The ground motions that a sweep file asks for.

use std::{path::Path, sync::Arc};

use toml::Spanned;

use crate::{
    SweepError,
    motion::{Frequency, GivenMotion, SweepMotion},
    pulse::{Name, PulseShape},
    spec::{PulseSection, SweepKind, SweepSource},
};
use rocking::synthetic::MotionTarget;
use strong_motion::{ReadOptions, Record, Recording};

/// Bounds on omega/p and on a frequency (Hz).
const OMEGA_OVER_P: (f64, f64) = (0.01, 1e3);
const FREQUENCY_HZ: (f64, f64) = (0.01, 1e3);

/// Motions made like a given one, unless said.
const LIKE_COUNT: usize = 100;

/// The motions of a sweep file: files, folder, El Centro, those made, pulses. `read` and
/// `duration_s` say how the one is read that others are made like.
///
/// # Errors
/// A folder without records; a pulse that is none, with its line; a motion that no other can be
/// like.
pub(crate) fn motions(
    source: &SweepSource,
    read: &ReadOptions,
    duration_s: Option<f64>,
) -> Result<Vec<SweepMotion>, SweepError> {
    let records = &source.spec.records;
    let mut motions: Vec<SweepMotion> =
        records.files.iter().map(|file| SweepMotion::File(source.folder().join(file))).collect();
    if let Some(folder) = &records.folder {
        motions.extend(
            Record::list_dir(&source.folder().join(folder))?.into_iter().map(SweepMotion::File),
        );
    }
    if records.el_centro {
        motions.push(SweepMotion::ElCentro);
    }
    let count = |name: &str, n: &Option<Spanned<usize>>| match n {
        Some(n) if (1..=10_000_000).contains(n.get_ref()) => Ok(*n.get_ref()),
        Some(n) => {
            Err(source.at(n, format!("{name} is {}; give 1 to 10000000 motions", n.get_ref())))
        }
        None => Ok(0),
    };
    motions.extend((0..count("synthetic", &records.synthetic)?).map(SweepMotion::Synthetic));
    motions.extend((0..count("earthquakes", &records.earthquakes)?).map(SweepMotion::Earthquake));
    match (&records.like, &records.like_count) {
        (Some(file), n) => {
            let given = Arc::new(given(&source.folder().join(file.get_ref()), read, duration_s)?);
            let n = if n.is_some() { count("like_count", n)? } else { LIKE_COUNT };
            motions.extend((0..n).map(|i| SweepMotion::Like(i, given.clone())));
        }
        (None, Some(n)) => {
            return Err(
                source.at(n, "like_count without like; give the record, as like = \"floor.csv\"")
            );
        }
        (None, None) => {}
    }
    let files = motions.len();
    for pulse in &source.spec.pulse {
        of_pulse(source, pulse, &mut motions)?;
    }
    let kind = &source.spec.sweep.kind;
    if motions.is_empty() {
        return Err(source.at(kind, "no ground motion; give [records] or [[pulse]]"));
    }
    let of_files = motions.iter().any(|motion| matches!(motion, SweepMotion::File(_)));
    if let Some(vertical) = records.vertical.as_ref().filter(|_| !of_files) {
        return Err(source.at(
            vertical,
            "vertical is for motions of files; those of this sweep are horizontal: take it out",
        ));
    }
    if *kind.get_ref() == SweepKind::Overturning && files > 0 {
        return Err(source.at(kind, "an overturning spectrum is of pulses; take [records] out"));
    }
    Ok(motions)
}

/// The horizontal motion that others are made like.
fn given(
    path: &Path,
    read: &ReadOptions,
    duration_s: Option<f64>,
) -> Result<GivenMotion, SweepError> {
    let recording = Recording::read(path, &ReadOptions { vertical: None, ..read.clone() })?;
    let notices = recording.notices();
    let record = recording.into_record();
    let target = MotionTarget::new(
        &duration_s.map_or(record.clone(), |duration| record.truncated(duration)),
    )?;
    Ok(GivenMotion { whole: record, target, notices })
}

fn of_pulse(
    source: &SweepSource,
    pulse: &PulseSection,
    motions: &mut Vec<SweepMotion>,
) -> Result<(), SweepError> {
    let name = *pulse.shape.get_ref();
    let given = [&pulse.gamma.as_ref().map(|gamma| *gamma.get_ref()), &pulse.nu]
        .into_iter()
        .any(Option::is_some);
    let shape = match name {
        Name::MavroeidisPapageorgiou => {
            let gamma = match &pulse.gamma {
                Some(gamma) => source.within("gamma", gamma, 1.0, 10.0)?,
                None => return Err(source.at(
                    &pulse.shape,
                    "a Mavroeidis-Papageorgiou pulse needs gamma, its oscillations, 1 to 10, and \
                     nu, their phase [rad]",
                )),
            };
            PulseShape::MavroeidisPapageorgiou {
                gamma,
                nu: pulse.nu.filter(|nu| nu.is_finite()).unwrap_or(0.0),
            }
        }
        _ if given => {
            return Err(source
                .at(&pulse.shape, "gamma and nu are of mavroeidis-papageorgiou; take them out"));
        }
        Name::HalfSine => PulseShape::HalfSine,
        Name::Sine => PulseShape::Sine,
        Name::Ricker => PulseShape::Ricker,
        Name::RickerAntisymmetric => PulseShape::RickerAntisymmetric,
    };
    let frequencies: Vec<Frequency> = match (&pulse.omega_over_p, &pulse.frequency_hz) {
        (Some(q), None) => {
            let (low, high) = OMEGA_OVER_P;
            source
                .all_within("omega_over_p", q, low, high)?
                .into_iter()
                .map(Frequency::OverP)
                .collect()
        }
        (None, Some(hz)) => {
            let (low, high) = FREQUENCY_HZ;
            source
                .all_within("frequency_hz", hz, low, high)?
                .into_iter()
                .map(Frequency::Hz)
                .collect()
        }
        _ => {
            return Err(source
                .at(&pulse.shape, "a pulse needs omega_over_p or frequency_hz, one of the two"));
        }
    };
    motions
        .extend(frequencies.into_iter().map(|frequency| SweepMotion::Pulse { shape, frequency }));
    Ok(())
}
