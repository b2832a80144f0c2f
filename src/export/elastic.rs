//! An elastic structure on its springs as a deck for openseespy: nodes, corotational beams, stiff arms to the corners.

use std::{f64::consts::TAU, fmt::Write};

use super::{STEPS, model::digits, opensees::rows, printable};
use crate::{
    elastic::frame::{Frame, Layout, Point},
    record::Record,
    scalar::GRAVITY,
    spring::{Chain, Springs},
};

/// Stiffness of the arms that stand for a rigid footing, over the stiffest gap spring k1: as for a rigid body's legs.
const ARM_STIFFNESS: f64 = 4.0;
/// Newton's displacement tolerance over the span of the structure, some twenty times rounding.
const TOLERANCE: f64 = 2e-14;
/// Rise of a corner that counts as a motion, over that at which the structure topples.
const SMALL_MOTION: f64 = 0.01;
/// Radians of the structure's sway that a step may take: leaning it sways some three times as fast as fixed, and TRBDF2 lags by a twelfth of
/// the step's square.
const SWAY: f64 = 0.03;
const FASTER: f64 = 3.0;
/// A deck's steps are chosen for this share of the accuracy asked: what they err by at a landing goes on in vibration.
const SHARE: f64 = 0.25;

/// What a deck is made from.
#[derive(Clone, Copy, Debug)]
pub struct ElasticDeck<'a> {
    /// What the structure is, in a line.
    pub title: &'a str,
    /// What it is made of.
    pub layout: &'a Layout,
    /// The same, assembled.
    pub frame: &'a Frame,
    /// Under every corner.
    pub springs: &'a [Springs<Chain<f64>>],
    /// The motion.
    pub record: &'a Record,
    /// Samples of it that are followed, the one at t = 0 included.
    pub samples: usize,
    /// Node whose motion is checked, and its displacement (x, z) at every sample in our own history (m).
    pub top: (usize, &'a [[f64; 2]]),
    /// Lean at which the structure topples (rad).
    pub alpha: f64,
    /// Of the structure fixed to the ground, across (Hz).
    pub frequency_hz: f64,
    /// Accuracy of the history, as a normalised error: the steps follow from it.
    pub accuracy: f64,
}

impl ElasticDeck<'_> {
    /// The deck for openseespy.
    pub fn python(&self) -> String {
        let (top, motion) = self.top;
        let settled = motion.first().map_or(0.0, |start| start[1]);
        let peak = |k: usize, sign: f64| {
            let from = if k == 1 { settled } else { 0.0 };
            motion.iter().map(|at| sign * (at[k] - from)).fold(f64::NEG_INFINITY, f64::max) * sign
        };
        let vertical = self.record.vertical.as_ref().map_or(String::new(), |vertical| rows(&vertical.accel, ","));
        let note = format!(
            "{}: {} samples, dt {} s, peak {:.4} g; m/s2, positive to the right",
            printable(&self.record.name),
            self.record.len(),
            self.record.dt,
            self.record.pga_g()
        );
        let rise = SMALL_MOTION * self.frame.stance() * self.alpha;
        let values = [
            ("TITLE", printable(self.title)),
            ("GRAVITY", digits(GRAVITY)),
            ("NODES", self.nodes()),
            ("TOP", top.to_string()),
            ("BEAMS", self.beams()),
            ("CORNERS", self.corners()),
            ("DAMPERS", self.dampers()),
            ("LEG", digits(ARM_STIFFNESS)),
            ("RECORD_DT", digits(self.record.dt)),
            ("ACCURACY", digits(SHARE * self.accuracy)),
            ("LANDING", digits(self.landing())),
            ("RISE", digits(rise)),
            ("STEPS", self.steps().to_string()),
            ("SAMPLES", self.samples.to_string()),
            ("DURATION", format!("{}", (self.samples.saturating_sub(1)) as f64 * self.record.dt)),
            ("TOLERANCE", digits(TOLERANCE * self.frame.span())),
            ("SETTLED", digits(settled)),
            ("X_MAX", digits(peak(0, 1.0))),
            ("X_MIN", digits(peak(0, -1.0))),
            ("Z_MAX", digits(peak(1, 1.0))),
            ("Z_MIN", digits(peak(1, -1.0))),
            ("RECORD_NOTE", note),
        ];
        let mut text = include_str!("elastic_deck.py").to_string();
        for (name, value) in values {
            text = text.replace(&format!("@{name}@"), &value);
        }
        text = text.replace("@ROUTINE@", STEPS.trim_end());
        text.replacen("@VERTICAL@", &vertical, 1).replacen("@RECORD@", &rows(&self.record.accel, ","), 1)
    }

    fn nodes(&self) -> String {
        let mass = self.frame.mass_matrix();
        let line = |node: usize| {
            let ([x, z], [at, _, turn]) = (self.frame.centre(node), self.frame.coordinates(node));
            let mass_of = |k: usize| digits(mass[(k, k)]);
            let inertia = turn.map_or("None".into(), mass_of);
            format!("    ({}, {}, {}, {inertia}),", digits(x), digits(z), at.map_or("0.0".into(), mass_of))
        };
        (0..self.layout.nodes.len()).map(line).collect::<Vec<_>>().join("\n")
    }

    /// From a node's centre of mass to a place on it.
    fn arm(&self, point: &Point) -> String {
        let [x, z] = self.frame.centre(point.node);
        // a place on its node is there, to the last digit
        format!("({}, {})", plain(point.place[0] - x), plain(point.place[1] - z))
    }

    fn beams(&self) -> String {
        let mut out = Vec::new();
        for member in &self.layout.members {
            let [a, b] = &member.ends;
            let s = &member.section;
            let ahead = |damping: f64, stiffness: f64| if stiffness > 0.0 { damping / stiffness } else { 0.0 };
            out.push(format!(
                "    ({}, {}, {}, {}, {}, {}, {}, {}),",
                a.node,
                b.node,
                self.arm(a),
                self.arm(b),
                digits(s.axial),
                digits(s.bending),
                digits(ahead(s.axial_damping, s.axial)),
                digits(ahead(s.bending_damping, s.bending))
            ));
        }
        out.join("\n")
    }

    fn corners(&self) -> String {
        let mut out = String::new();
        for (corner, springs) in self.layout.corners.iter().zip(self.springs) {
            let unit =
                |c: &Chain<f64>| format!("({}, {}, {}, {})", digits(c.k1), digits(c.k2), digits(c.c), digits(c.m2));
            let (vertical, horizontal) = (unit(&springs.vertical), unit(&springs.horizontal));
            // writing to a String cannot fail
            let _ = writeln!(out, "    ({}, {}, {vertical}, {horizontal}),", corner.node, self.arm(corner));
        }
        out.trim_end().to_string()
    }

    fn dampers(&self) -> String {
        let line = |(at, [h, v]): (&Point, [f64; 2])| format!("    ({}, {}, {h:?}, {v:?}),", at.node, self.arm(at));
        self.layout.dampers.iter().map(|damper| line((&damper.at, damper.c))).collect::<Vec<_>>().join("\n")
    }

    /// Steps per sample, at least: pairs.
    fn steps(&self) -> usize {
        let longest = SWAY / (FASTER * TAU * self.frequency_hz);
        2 * ((self.record.dt / longest / 2.0).ceil() as usize).max(1)
    }

    /// What a landing takes: 1/omega of the mass that lands on the vertical k1 (s).
    fn landing(&self) -> f64 {
        let of = |(i, springs): (usize, &Springs<Chain<f64>>)| {
            (self.frame.effective_mass(i)[1] / springs.vertical.k1).sqrt()
        };
        self.springs.iter().enumerate().map(of).fold(f64::INFINITY, f64::min)
    }
}

/// A number, zero as it is: decks ask whether it is.
fn plain(x: f64) -> String {
    if x == 0.0 { "0.0".into() } else { digits(x) }
}
