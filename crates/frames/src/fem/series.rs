//! Forces finely sampled: means over equal parts of the record's time step, so that a low-pass
//! filter finds all that is slower than its cutoff, however short a landing is.
//!
//! ```text
//!   mean over a part = 1/b sum over steps of the integral of f over what the step has of the part        b: length of a part
//!   f within a step of length h: the cubic through its start and its three stages, at 0, c_1 h, c_2 h, h
//! ```
//!
//! A part's mean times its length is the impulse of the force: no landing is between two samples.

use super::{
    filter::low_pass,
    run::ElasticView,
    running_peaks::{RunningPeaks, StepForces},
    step::ElasticStages,
};
use crate::frame::{Frame, FrameColumn};
use dynamics::fem::radau::C;
use rocking::scalar::GRAVITY;

/// What is sampled at every column's base, in this order: shear across its axis, axial force
/// (tension positive), moment.
const BASE_FORCES: usize = 3;

/// Window of the median (s); a landing is over in half of it.
pub(crate) const LANDING_OVER: f64 = 0.02;

/// One force.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FineSeries {
    /// Means over equal parts [N, N m].
    pub means: Vec<f64>,
    /// Largest magnitude at any step, unfiltered, with its sign.
    pub largest: f64,
    /// Largest value at any step, unfiltered; 0 if all are below.
    pub most: f64,
}

/// Forces of one column.
///
/// ```text
///   an element has one shear and one axial force, those of its middle: half its mass is above it
///   shear at an end: the middle's and what the half between them needs, m_el a/2 of the end
///   axial force at the base: N_1 + (N_1 - N_2)/2, which holds the weight of the lower half, too;
///   at the top: N_n + (N_n - N_n-1)/2
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FineColumn {
    /// Of its base: shear (N), axial force (N), moment (N m).
    pub base: [FineSeries; BASE_FORCES],
    /// Shear of every element and of the top; none of a column without mass, whose shear is one
    /// (N).
    pub above: Vec<FineSeries>,
    /// Axial force at the same places (N).
    pub axial_above: Vec<FineSeries>,
    /// Of the middle of each element and of the top, above the base along the column (m).
    pub heights: Vec<f64>,
    /// Moment at its top (N m).
    pub top_moment: FineSeries,
    /// At the ends of steps: shear, axial force and moment of its base, moment of its top.
    pub at_steps: RunningPeaks<4>,
}

impl FineColumn {
    fn series(&self) -> impl Iterator<Item = &FineSeries> {
        let above = self.above.iter().chain(&self.axial_above);
        self.base.iter().chain(above).chain([&self.top_moment])
    }

    fn series_mut(&mut self) -> impl Iterator<Item = &mut FineSeries> {
        let above = self.above.iter_mut().chain(&mut self.axial_above);
        self.base.iter_mut().chain(above).chain([&mut self.top_moment])
    }
}

/// Means of forces over equal parts of the time step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FineForces {
    /// Length of a part (s).
    pub part_s: f64,
    /// Of every column.
    pub columns: Vec<FineColumn>,
    /// Of the ground on all corners together, horizontally and vertically (N).
    pub sole: [FineSeries; 2],
    /// Forces of the footings on the columns, all together, in the same directions (N).
    pub held: [FineSeries; 2],
    /// The same at the ends of steps.
    pub held_at_steps: Vec<StepForces<2>>,
    /// At the ends of steps: of the tendon that pulls most, of the damper with the largest force
    /// on the structure, upwards (N).
    pub members: RunningPeaks<2>,
}

impl FineForces {
    /// What the ground's force has besides what footings hold of columns, between landings (N):
    /// weight and inertia of the footings. The impulse of a landing is in few of its parts, and the
    /// median over [`LANDING_OVER`] does not see it.
    pub(crate) fn rest_between_landings(&self, direction: usize) -> Vec<f64> {
        let [sole, held] = [&self.sole, &self.held].map(|of| &of[direction].means);
        let rest: Vec<f64> = sole.iter().zip(held).map(|(sole, held)| sole - held).collect();
        running_median(&rest, (0.5 * LANDING_OVER / self.part_s).round() as usize)
    }

    /// The ground's vertical force below a frequency (Hz), at times dt (s) apart, so many.
    pub fn sole_vertical_below(&self, hz: f64, dt: f64, samples: usize) -> Vec<f64> {
        let smooth = low_pass(&self.sole[1].means, self.part_s, hz);
        let parts = (dt / self.part_s).round() as usize;
        // a sample is where two parts meet
        let at = |sample: usize| {
            let [before, after] = [(sample * parts).saturating_sub(1), sample * parts];
            let last = smooth.len().checked_sub(1)?;
            Some(0.5 * (smooth[before.min(last)] + smooth[after.min(last)]))
        };
        (0..samples).filter_map(at).collect()
    }

    /// All series, columns first.
    pub(crate) fn series(&self) -> impl Iterator<Item = &FineSeries> {
        self.columns.iter().flat_map(FineColumn::series).chain(&self.sole).chain(&self.held)
    }

    fn series_mut(&mut self) -> impl Iterator<Item = &mut FineSeries> {
        let columns = self.columns.iter_mut().flat_map(FineColumn::series_mut);
        columns.chain(&mut self.sole).chain(&mut self.held)
    }
}

/// Gathers them step by step.
pub(super) struct FineRecorder {
    columns: Vec<FrameColumn>,
    forces: FineForces,
    /// At the start of the step.
    start: Vec<f64>,
    started: bool,
}

impl FineRecorder {
    /// So many parts to a time step of a record of so many samples.
    pub(crate) fn new(frame: &Frame, dt: f64, samples: usize, parts: usize) -> Self {
        let columns = frame.columns();
        let series = || FineSeries {
            means: vec![0.0; samples.saturating_sub(1) * parts],
            ..FineSeries::default()
        };
        let of = |column: &FrameColumn| {
            let mut below = 0.0;
            let mut heights: Vec<f64> = Vec::new();
            for &beam in &column.beams {
                heights.push(below + 0.5 * frame.length(beam));
                below += frame.length(beam);
            }
            heights.push(below);
            if frame.line_mass(column.beams[0]) == 0.0 {
                heights.clear();
            }
            FineColumn {
                base: [(); BASE_FORCES].map(|()| series()),
                above: heights.iter().map(|_| series()).collect(),
                axial_above: heights.iter().map(|_| series()).collect(),
                heights,
                top_moment: series(),
                at_steps: RunningPeaks::default(),
            }
        };
        let fine = columns.iter().map(of).collect();
        let forces = FineForces {
            part_s: dt / parts as f64,
            columns: fine,
            sole: [series(), series()],
            held: [series(), series()],
            held_at_steps: Vec::new(),
            members: RunningPeaks::default(),
        };
        let count = forces.series().count();
        Self { columns, forces, start: vec![0.0; count], started: false }
    }

    /// All forces of a motion q, q', q'' over a ground that accelerates, in the order of the
    /// series.
    fn at(&self, view: &ElasticView, [q, v, a]: [&[f64]; 3], ground: [f64; 2]) -> Vec<f64> {
        let (model, n) = (view.model, view.model.n);
        let (frame, free) = (model.frame, [&q[..n], &v[..n], &a[..n]]);
        let mut out = Vec::with_capacity(self.start.len());
        for column in &self.columns {
            column_forces(frame, column, (free, ground), &mut out);
        }
        let mut sole = [0.0; 2];
        for (i, foot) in view.feet.iter().enumerate() {
            let force = model.contact(i, foot, q, v);
            sole = [sole[0] + force[0], sole[1] + force[1]];
        }
        out.extend(sole);
        let mut held = [0.0; 2];
        for column in &self.columns {
            let [across, up] = frame.held_at(column.beams[0], column.base_end, free[0], free[1]);
            held = [held[0] + across, held[1] + up];
        }
        out.extend(held);
        out
    }

    /// Before the first step.
    pub(crate) fn begin(&mut self, view: &ElasticView) {
        if !self.started {
            let still = vec![0.0; view.q.len()];
            self.start = self.at(view, [view.q, view.v, &still], [0.0; 2]);
            self.started = true;
        }
    }

    /// After a step, which ended where the view is.
    pub(crate) fn step(&mut self, view: &ElasticView, stages: &ElasticStages) {
        let within = [0, 1, 2]
            .map(|j| self.at(view, [&stages.q[j], &stages.v[j], &stages.a[j]], stages.ground[j]));
        let h = stages.h;
        let begun = view.time - h;
        let part = self.forces.part_s;
        let end = within[2].clone();
        for (series, end) in self.forces.series_mut().zip(&end) {
            if end.abs() > series.largest.abs() {
                series.largest = *end;
            }
            series.most = series.most.max(*end);
        }
        let mut place = 0;
        for column in &mut self.forces.columns {
            let all = &end[place..place + column.series().count()];
            if let [shear, axial, moment, .., top] = *all {
                let forces = [shear, axial, moment, top];
                column.at_steps.take(StepForces { time: view.time, forces }, part);
            }
            place += all.len();
        }
        if let [.., across, up] = *end {
            self.forces.held_at_steps.push(StepForces { time: view.time, forces: [across, up] });
        }
        let model = view.model;
        let (q, v) = (&view.q[..model.n], &view.v[..model.n]);
        let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        let [tendon, damper] = [model.frame.tensions(q), model.frame.damper_forces(q, v)]
            .map(|all| all.into_iter().fold(0.0, larger));
        let forces = StepForces { time: view.time, forces: [tendon, damper] };
        self.forces.members.take(forces, part);
        let curves: Vec<[f64; 4]> = (0..end.len())
            .map(|k| integral([self.start[k], within[0][k], within[1][k], within[2][k]]))
            .collect();
        let last = self.forces.sole[0].means.len().saturating_sub(1);
        let mut i = ((begun / part + 1e-9).max(0.0) as usize).min(last);
        let mut from = 0.0;
        while from < 1.0 {
            // rounding at the end of a step does not begin another part
            let edge = ((i + 1) as f64 * part - begun) / h;
            let to = if edge >= 1.0 - 1e-9 || i == last { 1.0 } else { edge.max(from) };
            for (series, curve) in self.forces.series_mut().zip(&curves) {
                if let Some(mean) = series.means.get_mut(i) {
                    *mean += h / part * (antiderivative(curve, to) - antiderivative(curve, from));
                }
            }
            (from, i) = (to, (i + 1).min(last));
        }
        self.start = end;
    }

    /// What was gathered, of a history that ended at a time (s).
    pub(crate) fn finish(mut self, end: f64) -> FineForces {
        let kept = (end / self.forces.part_s).round() as usize;
        self.forces.series_mut().for_each(|series| series.means.truncate(kept));
        self.forces
    }
}

/// The median of every value and so many on either side of it; at the ends that of the nearest
/// value that has as many.
fn running_median(series: &[f64], beside: usize) -> Vec<f64> {
    let beside = beside.min(series.len().saturating_sub(1) / 2);
    let mut window = Vec::with_capacity(2 * beside + 1);
    let median = |i: usize| {
        window.clear();
        let i = i.clamp(beside, series.len() - 1 - beside);
        window.extend_from_slice(&series[i - beside..=i + beside]);
        *window.select_nth_unstable_by(beside, f64::total_cmp).1
    };
    (0..series.len()).map(median).collect()
}

/// A column's forces, in the order of its series.
fn column_forces(
    frame: &Frame,
    column: &FrameColumn,
    motion: ([&[f64]; 3], [f64; 2]),
    out: &mut Vec<f64>,
) {
    let ([q, v, a], [across, up]) = motion;
    let lacks = |beam, end| frame.half_inertia(beam, end, [q, v, a], [across, up + GRAVITY]);
    let beams = &column.beams;
    let (lowest, highest) = (beams[0], beams[beams.len() - 1]);
    let massive = frame.line_mass(lowest) > 0.0;
    let first = frame.bearing(lowest, q, v);
    let axial = out.len() + 1;
    out.extend([
        first.shear + lacks(lowest, column.base_end),
        first.axial,
        first.moments[column.base_end],
    ]);
    let mut last = first;
    let mut axials = Vec::new();
    for (i, &beam) in beams.iter().enumerate() {
        let before = std::mem::replace(&mut last, frame.bearing(beam, q, v));
        if massive {
            out.push(last.shear);
            axials.push(last.axial);
        }
        if i == 1 {
            out[axial] += 0.5 * (first.axial - last.axial);
        }
        if massive && i + 1 == beams.len() {
            out.push(last.shear + lacks(highest, column.top_end));
            axials.push(last.axial + 0.5 * (last.axial - before.axial));
        }
    }
    out.extend(axials);
    out.push(last.moments[column.top_end]);
}

/// Coefficients of the integral from 0 of the cubic through values at 0, c_1, c_2, 1: of s, s^2,
/// s^3, s^4.
fn integral(values: [f64; 4]) -> [f64; 4] {
    let at = [0.0, C[0], C[1], C[2]];
    // Newton's divided differences
    let mut d = values;
    for order in 1..4 {
        for i in (order..4).rev() {
            d[i] = (d[i] - d[i - 1]) / (at[i] - at[i - order]);
        }
    }
    let [a, b] = [at[1], at[2]];
    // d0 + d1 s + d2 s (s - a) + d3 s (s - a)(s - b)
    let powers = [d[0], d[1] - d[2] * a + d[3] * a * b, d[2] - d[3] * (a + b), d[3]];
    [powers[0], powers[1] / 2.0, powers[2] / 3.0, powers[3] / 4.0]
}

fn antiderivative(c: &[f64; 4], s: f64) -> f64 {
    s * (c[0] + s * (c[1] + s * (c[2] + s * c[3])))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A median leaves a straight line and a bend as they are, and takes out what is in fewer parts
    /// than half of its window, however large.
    #[test]
    fn a_running_median_does_not_see_an_impulse() {
        let smooth = |i: usize| 5.0 + 0.1 * i as f64;
        let clean: Vec<f64> = (0..40).map(smooth).collect();
        assert_eq!(running_median(&clean, 6)[6..34], clean[6..34]);
        // in the last parts, too
        let mut last = clean.clone();
        last[36..].fill(1e9);
        let found = running_median(&last, 6);
        assert!(
            found.iter().zip(&clean).all(|(found, due)| (found - due).abs() <= 0.8),
            "{found:?}"
        );
        assert_eq!(
            (running_median(&[], 6), running_median(&[1.0, 2.0], 6)),
            (vec![], vec![1.0, 2.0])
        );
        let mut struck = clean.clone();
        struck[20..25].fill(1e9);
        // the middle moves by no more than half a window of the line
        for (found, due) in running_median(&struck, 6).iter().zip(&clean) {
            assert!((found - due).abs() <= 0.6, "{found} {due}");
        }
    }

    /// x^3 - 2 x^2 + 3 x + 4: its integral to s is s^4/4 - 2 s^3/3 + 3 s^2/2 + 4 s.
    #[test]
    fn a_cubic_is_integrated_as_it_is() {
        let f = |s: f64| s * s * s - 2.0 * s * s + 3.0 * s + 4.0;
        let curve = integral([f(0.0), f(C[0]), f(C[1]), f(C[2])]);
        for s in [0.1_f64, 0.5, 1.0] {
            let exact = s.powi(4) / 4.0 - 2.0 * s.powi(3) / 3.0 + 1.5 * s * s + 4.0 * s;
            assert!((antiderivative(&curve, s) - exact).abs() < 1e-12);
        }
    }
}
