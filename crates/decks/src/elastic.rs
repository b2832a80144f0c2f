//! An elastic structure on its springs as a deck for OpenSees: nodes, corotational beams, stiff
//! arms to the corners.

use std::f64::consts::TAU;

use super::{
    CornerProgram, DeckFormat, EvenEnds, ExportError,
    language::{Language, PYTHON, TCL, record_note},
    model::{SMALL_MOTION, TOLERANCE, digits},
    plain::{self, NamedSprings},
    printable_title, sap2000,
    stepping::EvenSteps,
    typed,
};
use dynamics::spring::{Chain, Springs};
use files::message::significant;
use fixed_steps::contact::HOLDS;
use frames::frame::{Frame, FrameDamper, FrameLayout, FrameMember, FrameTendon, NodePoint};
use rocking::scalar::GRAVITY;
use strong_motion::Record;

/// Stiffness of the arms that stand for a rigid footing, over the stiffest gap spring k1: as for a
/// rigid body's legs.
const ARM_STIFFNESS: f64 = 4.0;
/// The same on the softer springs of steps of one size, whose tolerance leaves the digits for it:
/// on arms as soft as above the columns would give at their ends.
const EVEN_ARM_STIFFNESS: f64 = 100.0;
/// From this part of a record's step on dashpots of beams work where steps follow touches: the
/// first step is shorter.
const SMALL_STEP: f64 = 1e-4;
/// Difference of two beams' damping coefficients that is rounding, relative.
const SAME: f64 = 1e-9;
/// Radians of the structure's sway that a step may take: leaning it sways some three times as fast
/// as fixed, and TRBDF2 lags by a twelfth of the step's square.
const SWAY: f64 = 0.03;
const FASTER: f64 = 3.0;
/// A deck's steps are chosen for this share of the accuracy asked: what they err by at a landing
/// goes on in vibration, of a column's mass too, and small errors grow 30-fold before a history is
/// no longer judged. Errors of rotation (limit 2e-3), at shares of 1/4, 1/64 and 1/256: pier of 14
/// m with a heavy column: 4.8e-3, 1.36e-3, 7.9e-4; pier of 20 m that hardly lifts under vertical
/// motion: not followed, 6.4e-3, 1.7e-3; portal of 6.5 m that rocks for 40 s: 2.4e-3 at 1/256,
/// 1.6e-3 at 1/512, 1.2e-3 at 1/1024.
const SHARE: f64 = 1.0 / 512.0;

/// What stands above the list of springs of beams that give in shear.
const SHEAR_NOTE: &str = "\
# Beams that give in shear, too (Timoshenko), by index: EI above is EI/(1 + Phi), Phi = 12 \
EI/(GA_s L^2), and a spring resists the turn of
# one end against the other: Phi EI/((1 + Phi) L) (N m/rad), with its dashpot (N m s/rad).
";

/// What a deck is made from.
#[derive(Clone, Copy, Debug)]
pub struct ElasticDeck<'a> {
    /// What the structure is, in a line.
    pub title: &'a str,
    /// What it is made of.
    pub layout: &'a FrameLayout,
    /// The same, assembled.
    pub frame: &'a Frame,
    /// Under every corner.
    pub springs: &'a [Springs<Chain>],
    /// The motion.
    pub record: &'a Record,
    /// Samples of it that are followed, the one at t = 0 included.
    pub samples: usize,
    /// How many of these samples are compared: those up to the time to which the motion can be
    /// predicted.
    pub compared: usize,
    /// Node whose motion is checked, and its displacement (x, z) at every sample in our own history
    /// (m).
    pub top: (usize, &'a [[f64; 2]]),
    /// Lean at which the structure topples (rad).
    pub alpha: f64,
    /// Of the structure fixed to the ground, across (Hz).
    pub frequency_hz: f64,
    /// Accuracy of the history, as a normalised error: the steps follow from it.
    pub accuracy: f64,
    /// The program with steps of one size that the springs are for, in place of steps that follow
    /// touches.
    pub program: Option<(&'a CornerProgram, EvenEnds)>,
}

impl ElasticDeck<'_> {
    /// The text of the deck.
    ///
    /// # Errors
    /// A member or a vertical motion that the format does not have.
    pub fn text(&self, format: DeckFormat) -> Result<String, ExportError> {
        Ok(match format {
            DeckFormat::OpenSeesPy => self.fill(&PYTHON, include_str!("elastic_deck.py"))?,
            DeckFormat::OpenSeesTcl => self.fill(&TCL, include_str!("elastic_deck.tcl"))?,
            DeckFormat::Sap2000 => sap2000::tables(&self.sap2000(format)?),
            DeckFormat::Sap2000Sheet => sap2000::sheet(&self.sap2000(format)?),
            DeckFormat::Csv => plain::csv(self.even().as_ref(), &self.places()),
            DeckFormat::Markdown => {
                let even = self.even();
                let mut text = plain::markdown(self.title, even.as_ref(), &self.places());
                text += &plain::beams(self.layout);
                if let Some(damping) = self.damping("") {
                    text.push_str(&format!("\n{damping}\n"));
                }
                if let Some(damped) = even.map(|even| even.forces_at()).filter(|&by| by < 1.0) {
                    text.push_str(&format!(
                        "\nUnder this integrator OpenSees' damping objects act too strongly: in a \
                         script of your own give them {damped:.3} of the structure's damping.\n"
                    ));
                }
                if let Some(even) = even {
                    let model = sap2000::SapModel::elastic(self, even);
                    text += &typed::words(&model, &self.places());
                }
                if let Err(ExportError::Member { name, .. }) = self.without_members(format) {
                    text += &format!("\nThe structure has a {name}, which is not listed here.\n");
                }
                text
            }
        })
    }

    /// The model for SAP2000.
    fn sap2000(&self, format: DeckFormat) -> Result<sap2000::SapModel<'_>, ExportError> {
        self.without_members(format)?;
        let even = self.even().ok_or(ExportError::EventsInTables)?;
        if even.touches > 1 {
            return Err(ExportError::TouchesInTables);
        }
        even.in_tables()?;
        Ok(sap2000::SapModel::elastic(self, even))
    }

    /// Settings of steps of one size, if the springs are for such.
    fn even(&self) -> Option<EvenSteps> {
        self.program.map(|(program, ends)| EvenSteps { ends, ..program.steps() })
    }

    /// The corners from the left, and what is under them.
    fn places(&self) -> Vec<NamedSprings> {
        self.springs
            .iter()
            .enumerate()
            .zip(&self.layout.corners)
            .map(|((i, springs), at)| (format!("corner {}", i + 1), at.place[0], *springs))
            .collect()
    }

    /// Tables leave out what SAP2000's have no word for here.
    fn without_members(&self, format: DeckFormat) -> Result<(), ExportError> {
        let left_out = [
            ("damper", !self.layout.dampers.is_empty()),
            ("tendon", !self.layout.tendons.is_empty()),
        ];
        match left_out.into_iter().find(|(_, there)| *there) {
            Some((name, _)) => Err(ExportError::Member { name, format: format.name() }),
            None => Ok(()),
        }
    }

    /// Where the node that is checked settles (m).
    pub(super) fn settled(&self) -> f64 {
        self.top.1.first().map_or(0.0, |start| start[1])
    }

    /// Its largest displacement towards a side, x or, from where it settled, z (m).
    pub(super) fn peak(&self, k: usize, sign: f64) -> f64 {
        let from = if k == 1 { self.settled() } else { 0.0 };
        let compared = self.top.1.iter().take(self.compared);
        compared.map(|at| sign * (at[k] - from)).fold(f64::NEG_INFINITY, f64::max) * sign
    }

    /// Time of the last sample compared (s).
    pub(super) fn compared_s(&self) -> f64 {
        self.compared.saturating_sub(1) as f64 * self.record.dt
    }

    fn fill(&self, language: &Language, template: &str) -> Result<String, ExportError> {
        let rise = SMALL_MOTION * self.frame.stance() * self.alpha;
        let even = self.even();
        // OpenSees' damping objects act 1/(1 + alpha) times too strongly under HHT: the change of a
        // force over a step, divided by (1 + alpha) dt
        let damped = even.map_or(1.0, |even| even.forces_at());
        let tolerance = even.map_or(TOLERANCE * self.frame.span(), |even| even.tolerance());
        let softer = even.is_some_and(|even| even.touches == 1);
        let values = [
            ("TITLE", printable_title(self.title)),
            ("GRAVITY", digits(GRAVITY)),
            ("NODES", language.lines(self.nodes())),
            ("TOP", (self.top.0 + 1).to_string()),
            ("BEAMS", language.lines(self.beams(language, damped))),
            ("DAMPING", self.damping_note(damped)),
            ("OURS", "our own finite elements".into()),
            ("SHEAR", self.shear(language)),
            (
                "SHEAR_SPRINGS",
                if self.sheared().is_empty() {
                    String::new()
                } else {
                    language.shear_springs.into()
                },
            ),
            ("CORNERS", language.lines(self.corners(language))),
            ("DAMPERS", language.lines(self.dampers(language))),
            ("TENDONS", language.lines(self.tendons(language))),
            ("FRICTION", format!("{HOLDS:e}")),
            ("LEG", digits(if softer { EVEN_ARM_STIFFNESS } else { ARM_STIFFNESS })),
            ("RECORD_DT", digits(self.record.dt)),
            ("DAMPED_FROM", digits(even.map_or(SMALL_STEP * self.record.dt, |e| e.damped_from()))),
            ("ACCURACY", digits(SHARE * self.accuracy)),
            ("LANDING", digits(self.landing())),
            ("RISE", digits(rise)),
            ("STEPS", self.steps().to_string()),
            ("SAMPLES", self.samples.to_string()),
            ("COMPARED", self.compared.to_string()),
            ("COMPARED_S", self.compared_s().to_string()),
            ("DURATION", format!("{}", (self.samples.saturating_sub(1)) as f64 * self.record.dt)),
            ("TOLERANCE", digits(tolerance)),
            ("SETTLED", digits(self.settled())),
            ("X_MAX", digits(self.peak(0, 1.0))),
            ("X_MIN", digits(self.peak(0, -1.0))),
            ("Z_MAX", digits(self.peak(1, 1.0))),
            ("Z_MIN", digits(self.peak(1, -1.0))),
            ("RECORD_NOTE", record_note(self.record)),
        ];
        language.fill(template, &values, self.record, even.as_ref(), false)
    }

    /// x, z, mass, rotational inertia of every node.
    fn nodes(&self) -> impl Iterator<Item = Vec<String>> {
        let mass = self.frame.mass_matrix();
        let of = |at: Option<usize>| digits(at.map_or(0.0, |k| mass[(k, k)]));
        (0..self.layout.nodes.len()).map(move |node| {
            let ([x, z], [at, _, turn]) = (self.frame.centre(node), self.frame.coordinates(node));
            vec![digits(x), digits(z), of(at), of(turn)]
        })
    }

    /// From a node's centre of mass to a place on it.
    fn arm(&self, language: &Language, point: &NodePoint) -> String {
        let [x, z] = self.frame.centre(point.node);
        // a place on its node is there, to the last digit
        language.list(&[plain(point.place[0] - x), plain(point.place[1] - z)])
    }

    /// Beams, their damping this many times what it is.
    fn beams(&self, language: &Language, damped: f64) -> impl Iterator<Item = Vec<String>> {
        self.layout.members.iter().map(move |member| {
            let [a, b] = &member.ends;
            let s = &member.section;
            let ahead = |damping: f64, stiffness: f64| {
                if stiffness > 0.0 { damped * damping / stiffness } else { 0.0 }
            };
            let (axial, bending) =
                (ahead(s.axial_damping, s.axial), ahead(s.bending_damping, s.bending));
            let bent = s.bending / (1.0 + s.shear_ratio(length(member)));
            let numbers = [s.axial, bent, axial, bending].map(digits);
            let ends = [
                a.node.to_string(),
                b.node.to_string(),
                self.arm(language, a),
                self.arm(language, b),
            ];
            [ends, numbers].concat()
        })
    }

    /// What damping the beams have, with its coefficients over stiffness, what a deck has `here` of
    /// it, and that with another one the errors differ; nothing of a structure without.
    pub(super) fn damping(&self, here: &str) -> Option<String> {
        let over = |damping: f64, stiffness: f64| match stiffness > 0.0 {
            true => damping / stiffness,
            false => 0.0,
        };
        let of = |member: &FrameMember| {
            let s = &member.section;
            [over(s.axial_damping, s.axial), over(s.bending_damping, s.bending)]
        };
        let mut all: Vec<[f64; 2]> = Vec::new();
        for pair in self.layout.members.iter().map(of).filter(|[a, b]| a + b > 0.0) {
            let same = |other: &[f64; 2]| {
                pair.iter().zip(other).all(|(a, b)| (a - b).abs() <= SAME * a.abs())
            };
            if !all.iter().any(same) {
                all.push(pair);
            }
        }
        let one = |[axial, bending]: &[f64; 2]| {
            format!("{} s axial, {} s bending", significant(*axial, 4), significant(*bending, 4))
        };
        let all = all.iter().map(one).collect::<Vec<_>>().join("; ");
        (!all.is_empty()).then(|| {
            format!(
                "Damping of the beams: proportional to the stiffness of each, with a coefficient \
                 for axial deformation and another one for bending ({all}){here}. The errors \
                 measured for these springs hold for this damping; with another kind (Rayleigh, or \
                 one coefficient for both) they differ."
            )
        })
    }

    /// The same for OpenSees, whose damping is this many times that of the structure.
    fn damping_note(&self, damped: f64) -> String {
        let here = match damped < 1.0 {
            true => format!(
                ", below {damped:.3} of it, since OpenSees' damping objects act too strongly under \
                 HHT"
            ),
            false => ", by OpenSees' damping objects (SecStif)".into(),
        };
        let damping = self.damping(&here).unwrap_or("Damping of the beams: none.".into());
        plain::lines(&damping, "\n# ")
    }

    /// Beams that give in shear, with the stiffness and the dashpot of the spring between the turns
    /// of their ends [N m/rad, N m s/rad]: k = [4 + Phi, 2 - Phi; 2 - Phi, 4 + Phi]/(1 + Phi) is
    /// that of a beam of EI/(1 + Phi), and [1 -1; -1 1] Phi EI/((1 + Phi) L).
    fn sheared(&self) -> Vec<(usize, [f64; 2])> {
        let spring = |(i, member): (usize, &FrameMember)| {
            let (s, l) = (&member.section, length(member));
            let phi = s.shear_ratio(l);
            let of = |stiffness: f64| phi * stiffness / ((1.0 + phi) * l);
            (phi > 0.0).then(|| (i, [of(s.bending), of(s.bending_damping)]))
        };
        self.layout.members.iter().enumerate().filter_map(spring).collect()
    }

    /// Their list, with what it is; nothing if there are none.
    fn shear(&self, language: &Language) -> String {
        let springs = self.sheared();
        if springs.is_empty() {
            return String::new();
        }
        format!("\n{SHEAR_NOTE}{}", language.shear(&springs))
    }

    fn corners(&self, language: &Language) -> impl Iterator<Item = Vec<String>> {
        let unit = |c: &Chain| language.list(&[c.k1, c.k2, c.c, c.m2].map(digits));
        self.layout.corners.iter().zip(self.springs).map(move |(corner, springs)| {
            let units = [unit(&springs.vertical), unit(&springs.horizontal)];
            [[corner.node.to_string(), self.arm(language, corner)], units].concat()
        })
    }

    fn dampers(&self, language: &Language) -> impl Iterator<Item = Vec<String>> {
        self.layout.dampers.iter().map(|FrameDamper { at, c: [h, v] }| {
            vec![at.node.to_string(), self.arm(language, at), digits(*h), digits(*v)]
        })
    }

    fn tendons(&self, language: &Language) -> impl Iterator<Item = Vec<String>> {
        self.layout.tendons.iter().map(|FrameTendon { at, anchor, stiffness, pretension }| {
            let numbers = [digits(*stiffness), digits(*pretension)];
            [
                vec![
                    at.node.to_string(),
                    self.arm(language, at),
                    language.list(&anchor.map(digits)),
                ],
                numbers.to_vec(),
            ]
            .concat()
        })
    }

    /// Steps per sample, at least: pairs.
    fn steps(&self) -> usize {
        let longest = SWAY / (FASTER * TAU * self.frequency_hz);
        2 * ((self.record.dt / longest / 2.0).ceil() as usize).max(1)
    }

    /// What a landing takes: 1/omega of the mass that lands on the vertical k1 (s).
    fn landing(&self) -> f64 {
        let of = |(i, springs): (usize, &Springs<Chain>)| {
            (self.frame.effective_mass(i)[1] / springs.vertical.k1).sqrt()
        };
        self.springs.iter().enumerate().map(of).fold(f64::INFINITY, f64::min)
    }
}

fn length(member: &FrameMember) -> f64 {
    let [a, b] = member.ends.map(|end| end.place);
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// A number, zero as it is: decks ask whether it is.
fn plain(x: f64) -> String {
    if x == 0.0 { "0.0".into() } else { digits(x) }
}
