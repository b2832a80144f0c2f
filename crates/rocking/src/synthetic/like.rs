//! Motions like a given one: its response spectrum and its envelope in time, other phases.
//!
//! ```text
//! a(t) = E(t) sum_k A_k cos(w_k t + phi_k)        phi_k even in 0 to 2 pi, by seed and index
//! E^2(t): a^2 of the given motion, smoothed over a fraction of its strong part
//! A_k: its Fourier amplitudes, smoothed
//! X(f) <- X(f) S_given(1/f)/S(1/f)                until the spectra S of 5 % damping agree
//! ```
//!
//! D. A. Gasparini and E. H. Vanmarcke (1976), "Simulated earthquake motions compatible with
//! prescribed response spectra", MIT R76-4 (the program SIMQKE), with the correction made to the
//! transform X of the motion under its envelope instead of A_k (N. C. Tsai 1972,
//! "Spectrum-compatible motions for design purposes", Journal of the Engineering Mechanics
//! Division, ASCE 98): it converges closer. What a correction spreads beyond E is taken back, so
//! that a short strong part stays short. A part of the phases does not converge, because the
//! peak of a motion is an accident of its phases: several are drawn, and the closest is kept. The
//! ground ends at rest where it began, as in [`noise`](super::noise).
//!
//! What is not kept: how the frequencies of the given motion change with time.

use std::f64::consts::TAU;

use num_complex::Complex;
use thiserror::Error;

use super::{
    fft::Fourier, noise::rest_at_end, random::Random, silence_s, spectrum::ResponseSpectrum,
};
use strong_motion::{Record, Source, largest_magnitude};

/// Streams of random numbers that neither of the other suites uses; from bit 40 on the number of
/// the draw.
const LIKE: u64 = 1 << 62;
/// Draws of phases at most, and the mismatch of the spectrum at which one is good enough.
const DRAWS: u64 = 24;
/// Mismatch with which no further draw is made: ln of the ratio of spectra, at any period; of the
/// first draws, and of those that follow.
const ENOUGH: f64 = 0.12;
const ENOUGH_LATER: f64 = 0.18;
const FIRST_DRAWS: u64 = 8;
const GOOD: f64 = 0.06;
/// Corrections of a draw, those without a closer spectrum after which it is given up, and the
/// largest factor of one.
const CORRECTIONS: usize = 24;
const IN_VAIN: usize = 4;
const LARGEST_FACTOR: f64 = 2.0;
/// Periods that are matched (s): from three time steps, to a tenth of the motion.
const PERIODS_S: (f64, f64) = (0.04, 4.0);
/// Periods of the band, and how much farther the correction reaches, so that the band's end is no
/// end.
const MATCHED: usize = 64;
const BEYOND: f64 = 1.4;
/// Half a width of what the envelope is smoothed over: the time from 5 to 95 % of the Arias
/// intensity by so much, which quiet before and after the strong part does not change, and at least
/// so long (s).
const WIDTHS: f64 = 30.0;
const LEAST_WIDTH_S: f64 = 0.5;
/// Samples that a given motion may have.
const SAMPLES: (usize, usize) = (200, 400_000);

/// What is wrong with a motion that others shall be like.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum LikeError {
    #[error("{record}: has no motion; give a record that has")]
    Still { record: String },
    #[error(
        "{record}: {samples} samples; motions like it need {least} to {most}: give a longer \
         record, or duration_s"
    )]
    Samples { record: String, samples: usize, least: usize, most: usize },
}

/// A given motion, as others are made like it.
#[derive(Clone, Debug)]
pub struct MotionTarget {
    name: String,
    dt: f64,
    fingerprint: u64,
    /// E at the samples, zero at the last.
    envelope: Vec<f64>,
    /// Samples to each side that it is smoothed over.
    half: usize,
    /// A_k up to half of the sampling frequency.
    amplitudes: Vec<f64>,
    fourier: Fourier,
    spectrum: ResponseSpectrum,
    /// S of the given motion at the spectrum's periods (m/s2).
    wanted: Vec<f64>,
    /// How many of the periods are promised, the rest lies beyond.
    promised: usize,
    /// Of the given motion, at rest at its end: from 5 to 95 % of the Arias intensity (s), largest
    /// displacement of the ground (m).
    given: (f64, f64),
}

/// Shares of the given motion's length from 5 to 95 % of the Arias intensity that a motion may
/// have.
const LENGTHS: std::ops::RangeInclusive<f64> = 0.8..=1.25;
/// Largest displacement of the ground, in units of the given motion's.
const FARTHEST: f64 = 2.5;

impl MotionTarget {
    /// The horizontal motion of a record.
    ///
    /// # Errors
    /// It has no motion, or too few samples or too many.
    pub fn new(record: &Record) -> Result<Self, LikeError> {
        let (samples, (least, most)) = (record.len(), SAMPLES);
        let name = || record.name.clone();
        if !(least..=most).contains(&samples) {
            return Err(LikeError::Samples { record: name(), samples, least, most });
        }
        // what stands still at the end and the beginning has no spectrum of its own
        if record.pga() == 0.0 {
            return Err(LikeError::Still { record: name() });
        }
        let dt = record.dt;
        let duration_s = record.measures().duration_5_95_s;
        let half = ((duration_s / WIDTHS).max(LEAST_WIDTH_S) / dt).ceil() as usize;
        let (shortest, longest) = band(dt, record.duration());
        let ratio = (longest / shortest).powf(1.0 / (MATCHED - 1) as f64);
        let promised = MATCHED;
        let periods: Vec<f64> = (0..)
            .map(|i| shortest * ratio.powi(i))
            .enumerate()
            .take_while(|(i, period)| *i < MATCHED || *period < BEYOND * longest)
            .map(|(_, period)| period)
            .collect();
        let fourier = Fourier::holding(samples);
        let spectrum = ResponseSpectrum::new(periods, dt);
        let mut target = Self {
            given: (duration_s, 0.0),
            name: name(),
            dt,
            fingerprint: record.fingerprint(),
            envelope: envelope(&record.accel, half),
            half,
            amplitudes: amplitudes(record, &fourier, 0.5 / longest),
            wanted: spectrum.of(&record.accel),
            fourier,
            spectrum,
            promised,
        };
        let mut rested = record.accel.clone();
        target.rest(&mut rested);
        target.given.1 = farthest(&rested, dt);
        Ok(target)
    }

    /// Tells motions apart: FNV-1a of the given motion's numbers.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Name of the given motion.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The periods whose response is that of the given motion, from and to (s).
    #[cfg(test)]
    pub(crate) fn periods(&self) -> (f64, f64) {
        (self.spectrum.periods[0], self.spectrum.periods[self.promised - 1])
    }

    /// Motion `index` of a seed. It depends on the given motion, the seed and the index alone; only
    /// the silence at its end is as long as a structure with p (1/s) needs, as in
    /// [`earthquake`](super::earthquake).
    pub fn motion(&self, seed: u64, index: usize, p: f64) -> Record {
        let mut best: Option<(f64, Vec<f64>)> = None;
        for draw in 0..DRAWS {
            let mut random = Random::new(seed, LIKE | draw << 40 | index as u64);
            let (mismatch, accel) = self.drawn(&mut random);
            // one of another length, or whose ground wanders, is taken only if there is no better
            let mismatch = if self.fits(&accel) { mismatch } else { mismatch + 1.0 };
            if best.as_ref().is_none_or(|(least, _)| mismatch < *least) {
                best = Some((mismatch, accel));
            }
            let enough = if draw + 1 < FIRST_DRAWS { ENOUGH } else { ENOUGH_LATER };
            if best.as_ref().is_some_and(|(least, _)| *least < enough) {
                break;
            }
        }
        let mut accel = best.map_or_else(Vec::new, |(_, accel)| accel);
        accel.resize(accel.len() + (silence_s(p) / self.dt).ceil() as usize, 0.0);
        let name = format!("like-{}-{index:05}", self.name);
        Record {
            name,
            dt: self.dt,
            accel,
            vertical: None,
            source: Source::Synthetic,
            made_of: None,
        }
    }

    /// Whether a motion is about as long as the given one and moves the ground not much farther.
    fn fits(&self, accel: &[f64]) -> bool {
        let made = Record::new("made", self.dt, accel.to_vec());
        made.is_ok_and(|made| likeness(self, &made).fits())
    }

    /// One draw of phases, corrected: its mismatch, and its accelerations.
    fn drawn(&self, random: &mut Random) -> (f64, Vec<f64>) {
        let mut transform = vec![Complex::new(0.0, 0.0); self.fourier.len()];
        for (x, amplitude) in transform.iter_mut().zip(&self.amplitudes) {
            *x = Complex::from_polar(*amplitude, random.between(0.0, TAU));
        }
        self.fourier.inverse(&mut transform);
        let mut accel: Vec<f64> =
            transform.iter().zip(&self.envelope).map(|(x, e)| x.re * e).collect();
        self.rest(&mut accel);
        let offset = mean(&self.missing(&accel)).exp();
        accel.iter_mut().for_each(|a| *a *= offset);
        let (mut least, mut kept, mut in_vain) = (f64::INFINITY, accel.clone(), 0);
        for _ in 0..CORRECTIONS {
            let missing = self.missing(&accel);
            let mismatch = largest_magnitude(&missing[..self.promised]);
            if mismatch < least {
                (least, kept, in_vain) = (mismatch, accel.clone(), 0);
            } else {
                in_vain += 1;
            }
            if least < GOOD || in_vain == IN_VAIN {
                break;
            }
            self.correct(&mut accel, &missing, &mut transform);
        }
        (least, kept)
    }

    /// ln(S_given/S) at the periods.
    fn missing(&self, accel: &[f64]) -> Vec<f64> {
        let there = self.spectrum.of(accel);
        self.wanted
            .iter()
            .zip(there)
            .map(|(wanted, there)| (wanted / there.max(f64::MIN_POSITIVE)).ln())
            .collect()
    }

    /// The transform times S_given/S, between the periods and beyond them by their logarithms.
    fn correct(&self, accel: &mut [f64], missing: &[f64], transform: &mut [Complex<f64>]) {
        for (x, a) in transform.iter_mut().zip(accel.iter().copied().chain(std::iter::repeat(0.0)))
        {
            *x = Complex::new(a, 0.0);
        }
        self.fourier.forward(transform);
        let n = self.fourier.len();
        let periods = &self.spectrum.periods;
        let (first, step) = (periods[0].ln(), (periods[1] / periods[0]).ln());
        let most = LARGEST_FACTOR.ln();
        for (k, x) in transform.iter_mut().enumerate().take(n / 2 + 1) {
            let period = n as f64 * self.dt / (k as f64).max(0.5);
            let place = ((period.ln() - first) / step).clamp(0.0, (periods.len() - 1) as f64);
            let below = (place as usize).min(periods.len() - 2);
            let share = place - below as f64;
            let ln = missing[below] + share * (missing[below + 1] - missing[below]);
            // longer than all periods: to raise what no spectrum asks for would make the ground
            // drift
            let ln = if place >= (periods.len() - 1) as f64 { ln.min(0.0) } else { ln };
            // the half that is left out is its mirror image: twice what is there, and the real part
            let both = if k == 0 || k == n / 2 { 1.0 } else { 2.0 };
            *x *= both * ln.clamp(-most, most).exp();
        }
        transform[n / 2 + 1..].fill(Complex::new(0.0, 0.0));
        self.fourier.inverse(transform);
        for (a, x) in accel.iter_mut().zip(transform) {
            *a = x.re;
        }
        self.confine(accel);
        self.rest(accel);
    }

    /// What a correction spreads beyond the envelope is taken back.
    fn confine(&self, accel: &mut [f64]) {
        let there = envelope(accel, self.half);
        for ((a, wanted), there) in accel.iter_mut().zip(&self.envelope).zip(there) {
            if there > *wanted {
                *a *= wanted / there;
            }
        }
    }

    /// The ground ends at rest where it began.
    fn rest(&self, accel: &mut [f64]) {
        let last = accel.len() - 1;
        accel[last] = 0.0;
        rest_at_end(accel, &self.envelope[..last], self.dt);
    }
}

/// How long a motion is and how far its ground goes, in units of the given motion's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Likeness {
    /// From 5 to 95 % of the Arias intensity.
    pub duration: f64,
    /// Largest displacement.
    pub displacement: f64,
}

impl Likeness {
    /// Whether that is what is promised.
    pub fn fits(self) -> bool {
        LENGTHS.contains(&self.duration) && self.displacement <= FARTHEST
    }
}

/// How like the given motion one is that was made for it.
pub fn likeness(target: &MotionTarget, made: &Record) -> Likeness {
    let (length, far) = target.given;
    let displacement = farthest(&made.accel, made.dt) / far;
    Likeness { duration: made.measures().duration_5_95_s / length, displacement }
}

/// Largest displacement of a ground that begins at rest (m).
fn farthest(accel: &[f64], dt: f64) -> f64 {
    let (mut v, mut d, mut most) = (0.0, 0.0, 0.0_f64);
    for pair in accel.windows(2) {
        d += dt * v + dt * dt * (2.0 * pair[0] + pair[1]) / 6.0;
        v += dt * (pair[0] + pair[1]) / 2.0;
        most = most.max(f64::abs(d));
    }
    most
}

/// The periods that motions with a time step and a duration (s) are matched at, from and to (s).
fn band(dt: f64, duration: f64) -> (f64, f64) {
    let shortest = PERIODS_S.0.max(3.0 * dt);
    (shortest, PERIODS_S.1.min(duration / 15.0).max(4.0 * shortest))
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Root of the squares, smoothed by three running means of `half` samples to each side, which
/// together are near a Gaussian; its largest is 1.
fn envelope(accel: &[f64], half: usize) -> Vec<f64> {
    let squares: Vec<f64> = accel.iter().map(|a| a * a).collect();
    let smooth = (0..3).fold(squares, |values, _| {
        running_mean(&values, |i| (i.saturating_sub(half), i + half + 1))
    });
    let most = smooth.iter().fold(0.0, |most: f64, x| most.max(*x));
    // running sums leave a rounding error where the motion is zero
    let mut envelope: Vec<f64> = smooth.iter().map(|x| (x / most).max(0.0).sqrt()).collect();
    if let Some(last) = envelope.last_mut() {
        *last = 0.0;
    }
    envelope
}

/// Roots of the squared Fourier amplitudes, smoothed over a fifth of each frequency; none below
/// `lowest` (Hz).
fn amplitudes(record: &Record, fourier: &Fourier, lowest: f64) -> Vec<f64> {
    let mut transform = vec![Complex::new(0.0, 0.0); fourier.len()];
    for (x, a) in transform.iter_mut().zip(&record.accel) {
        x.re = *a;
    }
    fourier.forward(&mut transform);
    let squares: Vec<f64> = transform[..=fourier.len() / 2].iter().map(Complex::norm_sqr).collect();
    let around = |k: usize| ((0.9 * k as f64) as usize, (1.1 * k as f64).ceil() as usize + 1);
    let frequency = |k: usize| k as f64 / (fourier.len() as f64 * record.dt);
    let smooth = running_mean(&squares, around);
    smooth
        .iter()
        .enumerate()
        .map(|(k, x)| if frequency(k) < lowest { 0.0 } else { x.max(0.0).sqrt() })
        .collect()
}

/// Means of the values from and to before an index, as far as there are any.
fn running_mean(values: &[f64], range: impl Fn(usize) -> (usize, usize)) -> Vec<f64> {
    let mut sums = Vec::with_capacity(values.len() + 1);
    sums.push(0.0);
    for value in values {
        sums.push(sums[sums.len() - 1] + value);
    }
    let mean = |i: usize| {
        let (from, to) = range(i);
        let to = to.min(values.len());
        (sums[to] - sums[from]) / (to - from) as f64
    };
    (0..values.len()).map(mean).collect()
}

#[cfg(test)]
mod tests;
