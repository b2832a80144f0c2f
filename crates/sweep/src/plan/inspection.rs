//! What a sweep is known by, and what to look at again before it is believed.

use std::{collections::HashMap, mem::discriminant};

use super::{Measure, Plan};
use crate::{
    SweepError,
    motion::{MotionSource, SweepMotion, whole},
};
use cases::doubts::{Doubt, of_excitation};
use files::message::{printable, significant};
use strong_motion::{Notice, Record, excitation::Excitation, fnv1a};

/// A sweep that was looked at.
#[derive(Clone, Debug)]
pub struct InspectedSweep {
    /// A number that tells sweeps apart: FNV-1a of the program's version, of everything that
    /// decides a result, and of the samples of every file.
    pub hash: String,
    /// What to look at again, a line each.
    pub doubts: Vec<String>,
    /// Motions whose vertical component is used.
    pub with_vertical: usize,
}

/// Records are seldom scaled by more than ten, never by as much as this.
const MOST_SCALE: f64 = 50.0;

/// What to look at again.
enum SweepDoubt {
    /// As in a run.
    Given(Doubt),
    /// The levels scale a record by up to so much.
    Scaled { factor: f64 },
    /// The samples are those of another motion.
    Same { other: String },
}

impl SweepDoubt {
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Given(a), Self::Given(b)) => discriminant(a) == discriminant(b),
            _ => discriminant(self) == discriminant(other),
        }
    }

    fn message(&self) -> String {
        match self {
            Self::Given(doubt) => doubt.message(),
            Self::Scaled { factor } => {
                format!("the levels scale this record by up to {}", significant(*factor, 3))
            }
            Self::Same { other } => format!("the same motion as {other}, and it counts twice"),
        }
    }

    /// What to do about it in the sweep's file.
    fn remedy(&self) -> String {
        match self {
            Self::Scaled { .. } => "take it out, or give a stronger one".into(),
            Self::Same { .. } => "take one of them out".into(),
            Self::Given(Doubt::VerticalLeftOut { .. }) => {
                "write vertical = \"auto\" under [records], and compare".into()
            }
            Self::Given(Doubt::WeakMotion { least_g, whole_g, .. }) if whole_g < least_g => {
                "take it out, or check its unit".into()
            }
            Self::Given(Doubt::WeakMotion { .. } | Doubt::PeakCut { .. }) => {
                "use more of the record (duration_s under [records])".into()
            }
            Self::Given(Doubt::VerticalTaken { .. }) => {
                "take it out, or choose a horizontal one (component under [records])".into()
            }
            Self::Given(doubt) => doubt.remedy(),
        }
    }
}

/// Doubts of many structures and records: the first of each kind, and how many are like it.
#[derive(Default)]
struct DoubtsOfMany(Vec<(String, SweepDoubt, usize)>);

impl DoubtsOfMany {
    fn add(&mut self, of: &str, doubt: SweepDoubt) {
        match self.0.iter_mut().find(|(_, first, _)| first.is_like(&doubt)) {
            Some((.., more)) => *more += 1,
            None => self.0.push((of.to_string(), doubt, 0)),
        }
    }

    fn lines(&self) -> Vec<String> {
        let line = |(of, doubt, more): &(String, SweepDoubt, usize)| {
            let more = match more {
                0 => String::new(),
                more => format!(" (and {more} more like it)"),
            };
            format!("{}: {}; {}{more}", printable(of), doubt.message(), doubt.remedy())
        };
        self.0.iter().map(line).collect()
    }
}

impl Plan {
    /// Read every file, and tell what the sweep is known by. `notice` is told what the readers say
    /// of the files.
    ///
    /// # Errors
    /// A record that cannot be read, or has no motion.
    pub fn inspect(&self, notice: &mut dyn FnMut(&Notice)) -> Result<InspectedSweep, SweepError> {
        let MotionSource { seed, duration_s, p, .. } = &self.making;
        let mut doubts = DoubtsOfMany::default();
        let mut text = format!(
            "{} {:?} {:?} {seed} {duration_s:?} {p:?}",
            env!("CARGO_PKG_VERSION"),
            self.kind,
            self.model
        );
        for subject in &self.subjects {
            // the parts hold the name
            text += &format!("{} {:?} {:?}", subject.name, subject.structure, subject.restitution);
            let given = subject.doubts.iter().cloned().map(SweepDoubt::Given);
            given.for_each(|doubt| doubts.add(&subject.name, doubt));
        }
        text +=
            &format!("{:?} {:?} {:?} {}", self.restitutions, self.measure, self.levels, self.part);
        if self.model.fem() {
            text += &format!("{:?}", self.springs);
        }
        let (mut seen, mut with_vertical) = (HashMap::new(), 0);
        for motion in &self.motions {
            match motion {
                SweepMotion::Like(index, given) => {
                    text += &format!("{} {:x}", motion.name(), given.target.fingerprint());
                    if *index == 0 {
                        given.notices.iter().for_each(&mut *notice);
                    }
                }
                SweepMotion::File(path) => {
                    // not where it lies, but what is in it
                    text += &motion.name();
                    let record = whole(path, &self.making, notice)?;
                    let used = self.making.used(record.clone());
                    if used.pga() == 0.0 {
                        return Err(SweepError::Still { record: used.name });
                    }
                    let name = path.display().to_string();
                    self.doubt(&name, record, &used, &mut doubts);
                    let print = used.fingerprint();
                    text += &format!("{print:x}");
                    let up = used.vertical.as_ref().map(|up| up.as_record(used.dt).fingerprint());
                    with_vertical += usize::from(up.is_some());
                    text += &up.map_or(String::new(), |up| format!("{up:x}"));
                    same(&mut seen, (print, up), name, &mut doubts);
                }
                SweepMotion::ElCentro => {
                    text += &format!("{motion:?}");
                    let record = self.making.used(Record::el_centro());
                    let name = "el_centro".to_string();
                    same(&mut seen, (record.fingerprint(), None), name, &mut doubts);
                }
                _ => text += &format!("{motion:?}"),
            }
        }
        let hash = format!("{:016x}", fnv1a(text.bytes()));
        Ok(InspectedSweep { hash, doubts: doubts.lines(), with_vertical })
    }

    /// Doubts of a record, as it is read and as it is used.
    fn doubt(&self, name: &str, whole: Record, used: &Record, doubts: &mut DoubtsOfMany) {
        let most = self.levels.iter().copied().fold(0.0, f64::max);
        let factors = self.subjects.iter().map(|subject| self.factor(subject, most, used.pga()));
        let factor = factors.fold(0.0, f64::max);
        let scaled = self.measure != Measure::Scale && factor > MOST_SCALE;
        if scaled {
            doubts.add(name, SweepDoubt::Scaled { factor });
        }
        let excitation =
            Excitation { duration_s: self.making.duration_s, ..Excitation::whole(whole) };
        // of records of many lengths some are shorter than what is asked for
        let counts = |doubt: &Doubt| match doubt {
            Doubt::LongDuration { .. } => false,
            Doubt::WeakMotion { whole_g, least_g, .. } => !scaled || whole_g >= least_g,
            _ => true,
        };
        let all = of_excitation(&excitation).into_iter().filter(counts);
        all.for_each(|doubt| doubts.add(name, SweepDoubt::Given(doubt)));
    }
}

/// Whether a motion, by the numbers of its components, was there before.
fn same(
    seen: &mut HashMap<(u64, Option<u64>), String>,
    prints: (u64, Option<u64>),
    name: String,
    doubts: &mut DoubtsOfMany,
) {
    match seen.get(&prints) {
        Some(other) => doubts.add(&name, SweepDoubt::Same { other: printable(other).into() }),
        None => _ = seen.insert(prints, name),
    }
}
