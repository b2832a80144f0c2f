//! What a sweep is known by, and what to look at again before it is believed.

use std::{collections::HashMap, mem::discriminant};

use super::{Measure, Plan};
use crate::{
    SweepError,
    motion::{GivenMotion, MotionSource, SweepMotion, whole},
};
use cases::doubts::{Doubt, of_excitation};
use files::message::{printable, significant};
use rocking::synthetic::{Likeness, likeness};
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
    /// The vertical component of a motion that others are made like.
    LikeHorizontal(Doubt),
    /// Motions of those looked at that are not as they should be, and the farthest of them.
    Unlike { motions: usize, of: usize, worst: Likeness },
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

    /// What tells the worst of several that are alike.
    fn severity(&self) -> f64 {
        match self {
            Self::Scaled { factor } => *factor,
            Self::Given(Doubt::WeakMotion { pga_g, .. }) => -pga_g,
            Self::Given(Doubt::PeakCut { pga_g, whole_g }) => whole_g / pga_g,
            Self::Given(Doubt::StrongMotion { pga_g, .. }) => *pga_g,
            Self::Given(Doubt::VerticalLeftOut { peak_g, horizontal_g }) => peak_g / horizontal_g,
            _ => 0.0,
        }
    }

    fn message(&self) -> String {
        match self {
            Self::Given(doubt) | Self::LikeHorizontal(doubt) => doubt.message(),
            Self::Unlike { motions, of, worst } => format!(
                "of the first {of} motions made like it {motions} differ: the time from 5 to 95 % \
                 of the Arias intensity is {} times its own at worst, and the ground goes up to {} \
                 times as far",
                significant(worst.duration, 3),
                significant(worst.displacement, 3)
            ),
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
            Self::LikeHorizontal(_) => {
                "motions like it are horizontal; compare with the record itself (files and \
                 vertical = \"auto\" under [records])"
                    .into()
            }
            Self::Unlike { .. } => {
                "use its strong part alone (duration_s under [records] cuts its end), or take \
                 recorded motions (files)"
                    .into()
            }
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

/// Doubts of many structures and records: the worst of each kind, or the first of equal ones, and
/// how many are like it.
#[derive(Default)]
struct DoubtsOfMany(Vec<(String, SweepDoubt, usize)>);

impl DoubtsOfMany {
    fn add(&mut self, of: &str, doubt: SweepDoubt) {
        match self.0.iter_mut().find(|(_, first, _)| first.is_like(&doubt)) {
            Some((worst_of, worst, more)) => {
                *more += 1;
                if doubt.severity() > worst.severity() {
                    (*worst_of, *worst) = (of.to_string(), doubt);
                }
            }
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
            if subject.members.act() {
                text += &format!(" {:?}", subject.members);
            }
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
                        self.doubt_given(given, &mut doubts);
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
                    self.doubt(record, &used, |doubt| doubts.add(&name, doubt));
                    let print = used.fingerprint();
                    text += &format!("{print:x}");
                    let up = used.vertical.as_ref().map(|up| up.as_record(used.dt).fingerprint());
                    with_vertical += usize::from(up.is_some());
                    text += &up.map_or(String::new(), |up| format!("{up:x}"));
                    same(&mut seen, (print, up), name, &mut doubts);
                }
                SweepMotion::ElCentro => {
                    text += &format!("{motion:?}");
                    let record = Record::el_centro();
                    let used = self.making.used(record.clone());
                    let name = "el_centro".to_string();
                    self.doubt(record, &used, |doubt| doubts.add(&name, doubt));
                    same(&mut seen, (used.fingerprint(), None), name, &mut doubts);
                }
                _ => text += &format!("{motion:?}"),
            }
        }
        let hash = format!("{:016x}", fnv1a(text.bytes()));
        Ok(InspectedSweep { hash, doubts: doubts.lines(), with_vertical })
    }

    /// Doubts of a motion that others are made like, and of the first of these.
    fn doubt_given(&self, given: &GivenMotion, doubts: &mut DoubtsOfMany) {
        let used = self.making.used(given.whole.clone());
        let name = format!("like {}", given.target.name());
        self.doubt(given.whole.clone(), &used, |doubt| match doubt {
            SweepDoubt::Given(left_out @ Doubt::VerticalLeftOut { .. }) => {
                doubts.add(&name, SweepDoubt::LikeHorizontal(left_out));
            }
            // those that are made are scaled, not this one
            SweepDoubt::Scaled { .. } => {}
            other => doubts.add(&name, other),
        });
        let is_like = |motion: &&SweepMotion| matches!(motion, SweepMotion::Like(..));
        let looked_at = self.motions.iter().filter(is_like).count().min(LOOKED_AT);
        let (made, peaks): (Vec<_>, Vec<_>) = parallel::map_range(0..looked_at, |i| {
            let motion = given.target.motion(self.making.seed, i, self.making.p.0);
            (likeness(&given.target, &motion), motion.pga())
        })
        .into_iter()
        .unzip();
        if let Some(scaled) = peaks.into_iter().reduce(f64::min).and_then(|pga| self.scaled(pga)) {
            doubts.add(&name, scaled);
        }
        if let Some(unlike) = unlike(&made) {
            doubts.add(&name, unlike);
        }
    }

    /// That a record of this peak (m/s2) is scaled by more than is usual.
    fn scaled(&self, pga: f64) -> Option<SweepDoubt> {
        let most = self.levels.iter().copied().fold(0.0, f64::max);
        let factors = self.subjects.iter().map(|subject| self.factor(subject, most, pga));
        let factor = factors.fold(0.0, f64::max);
        let scaled = self.measure != Measure::Scale && factor > MOST_SCALE;
        scaled.then_some(SweepDoubt::Scaled { factor })
    }

    /// Doubts of a record, as it is read and as it is used.
    fn doubt(&self, whole: Record, used: &Record, mut add: impl FnMut(SweepDoubt)) {
        let scaled = self.scaled(used.pga());
        let is_scaled = scaled.is_some();
        scaled.into_iter().for_each(&mut add);
        let excitation =
            Excitation { duration_s: self.making.duration_s, ..Excitation::whole(whole) };
        // of records of many lengths some are shorter than what is asked for
        let counts = |doubt: &Doubt| match doubt {
            Doubt::LongDuration { .. } => false,
            Doubt::WeakMotion { whole_g, least_g, .. } => !is_scaled || whole_g >= least_g,
            _ => true,
        };
        let all = of_excitation(&excitation).into_iter().filter(counts);
        all.for_each(|doubt| add(SweepDoubt::Given(doubt)));
    }
}

/// Motions made like a given one that are looked at before the sweep; each takes a second or so.
const LOOKED_AT: usize = 10;

/// What is told of motions that are longer or shorter than the given one, or go farther.
fn unlike(made: &[Likeness]) -> Option<SweepDoubt> {
    let differ: Vec<&Likeness> = made.iter().filter(|likeness| !likeness.fits()).collect();
    let far = |ratio: f64| ratio.ln().abs();
    let duration = differ.iter().map(|like| like.duration);
    let worst = Likeness {
        duration: duration.max_by(|a, b| far(*a).total_cmp(&far(*b)))?,
        displacement: differ.iter().map(|like| like.displacement).fold(0.0, f64::max),
    };
    Some(SweepDoubt::Unlike { motions: differ.len(), of: made.len(), worst })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::SweepSource;

    #[test]
    fn of_several_records_the_worst_is_named() {
        let mut doubts = DoubtsOfMany::default();
        for (of, factor) in [("a", 60.0), ("b", 90.0), ("c", 70.0)] {
            doubts.add(of, SweepDoubt::Scaled { factor });
        }
        assert_eq!(
            doubts.lines(),
            ["b: the levels scale this record by up to 90; take it out, or give a stronger one \
              (and 2 more like it)"]
        );
    }

    #[test]
    fn motions_that_are_not_like_the_given_one_are_told_with_what_came_out() {
        let like = |duration, displacement| Likeness { duration, displacement };
        assert!(unlike(&[like(1.0, 1.0), like(1.2, 2.0)]).is_none());
        let told = unlike(&[like(1.0, 1.0), like(1.62, 1.0), like(0.7, 3.0)]).unwrap().message();
        assert!(told.starts_with("of the first 3 motions made like it 2 differ: "), "{told}");
        assert!(told.contains("is 1.62 times its own at worst"), "{told}");
        assert!(told.ends_with("the ground goes up to 3 times as far"), "{told}");
    }

    fn doubts_of(records: &str, levels: &str) -> Vec<String> {
        let text = format!(
            "[sweep]\nkind = 'fragility'\n[records]\n{records}\n[levels]\n{levels}\n\
             [[structure]]\nkind = 'block'\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 1200.0\n"
        );
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tuning/sweep.toml");
        let plan = Plan::new(&SweepSource::parse(path.into(), text).unwrap()).unwrap();
        plan.inspect(&mut |_| {}).unwrap().doubts
    }

    /// El Centro has 0.09 g of its 0.313 g in the first 1.5 s.
    #[test]
    fn el_centro_and_a_given_motion_are_doubted_as_files_are() {
        let like = "like = 'records/IELC180.AT2'\nlike_count = 1";
        for (records, name) in [("el_centro = true", "el_centro"), (like, "like IELC180")] {
            let strong = doubts_of(records, "pga_g = 20.0");
            assert!(
                strong.iter().any(|d| d.starts_with(&format!("{name}: the levels scale this"))),
                "{strong:?}"
            );
        }
        let short = doubts_of("el_centro = true\nduration_s = 1.5", "scale = 1.0");
        assert!(short.iter().any(|d| d.starts_with("el_centro: ") && d.contains("duration_s")));
        let up = "like = '../tests/records/20161113_110259_WTMC_20.V2A'\nlike_count = 1";
        let left_out = doubts_of(up, "scale = 1.0");
        let told = |d: &String| d.starts_with("like ") && d.contains("motions like it are horiz");
        assert!(left_out.iter().any(told), "{left_out:?}");
    }
}
