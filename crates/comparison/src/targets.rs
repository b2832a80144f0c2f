//! The targets, the measured value beside each.

use crate::{
    measurements::Measurements,
    rigid::SECONDS,
    table::{table, time},
};

/// A target and how it fared.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedTarget {
    pub what: String,
    pub wanted: String,
    pub measured: String,
    pub met: bool,
}

impl Measurements {
    /// Every target that something was measured for.
    pub fn targets(&self) -> Vec<SpeedTarget> {
        let mut targets = Vec::new();
        let mut add = |what: &str, wanted: &str, measured: String, met: bool| {
            targets.push(SpeedTarget { what: what.into(), wanted: wanted.into(), measured, met });
        };
        self.rigid_targets(&mut add);
        for own in &self.elements[..self.own.min(self.elements.len())] {
            let Some(ours) = own.cheapest(5e-4) else { continue };
            let springs = own.tool.trim_start_matches("groundspring, ");
            let what = format!("finite elements, {springs}, error below 5e-4");
            add(
                &what,
                "2 ms",
                format!("{} ({})", time(ours.seconds), ours.setting),
                ours.seconds <= 2e-3,
            );
            let peers = self
                .elements
                .iter()
                .filter(|s| s.tool.starts_with("OpenSees") && s.tool.ends_with(springs));
            for (peer, how) in
                peers.filter_map(|s| Some((s.cheapest(5e-4)?, s.tool.split(", ").nth(1)?)))
            {
                let ratio = peer.seconds / ours.seconds;
                let what = format!("the same against OpenSees, {how}, {}", peer.setting);
                add(
                    &what,
                    "2000 times faster",
                    format!("{ratio:.0} times ({})", time(peer.seconds)),
                    ratio >= 2000.0,
                );
            }
        }
        if let (Some(soft), Some(stiff)) = (self.stiffness.first(), self.stiffness.last()) {
            let ratio = stiff.seconds / soft.seconds;
            let what = format!("cost at {} Hz over cost at {} Hz", stiff.at, soft.at);
            add(&what, "does not grow with stiffness: below 2", format!("{ratio:.2}"), ratio < 2.0);
        }
        if let (Some(short), Some(long)) = (self.length.first(), self.length.last()) {
            let ratio = (long.seconds / long.at) / (short.seconds / short.at);
            let what = format!("cost of a second of record, {} s over {} s", long.at, short.at);
            add(
                &what,
                "linear: within 0.5 to 2",
                format!("{ratio:.2}"),
                (0.5..2.0).contains(&ratio),
            );
        }
        let slowest = self.fits.iter().map(|f| f.1).fold(0.0, f64::max);
        if slowest > 0.0 {
            add(
                "inner fit with certificate",
                "10 ms",
                format!("{} (slowest)", time(slowest)),
                slowest <= 10e-3,
            );
        }
        self.program_targets(&mut add);
        targets
    }

    /// Housner's equation: one structure, and many at once.
    fn rigid_targets(&self, add: &mut impl FnMut(&str, &str, String, bool)) {
        let find = |tool: &str| {
            self.rigid.iter().find(|s| s.tool.starts_with(tool)).and_then(|s| s.cheapest(1e-10))
        };
        if let Some(ours) = find("groundspring") {
            let what = "Housner, error below 1e-10 m";
            match find("diffsol") {
                Some(peer) => {
                    let ratio = peer.seconds / ours.seconds;
                    let measured = format!(
                        "{ratio:.1} times ({}, {})",
                        time(ours.seconds),
                        time(peer.seconds)
                    );
                    add(what, "4 times faster than diffsol", measured, ratio >= 4.0);
                }
                None => add(what, "0.1 ms", time(ours.seconds), ours.seconds <= 1e-4),
            }
        }
        if let Some(lanes) = &self.lanes {
            add(
                "Housner, many structures at once",
                "15 us each",
                time(lanes.lanes),
                lanes.lanes <= 15e-6,
            );
        }
    }

    /// Runs of the program.
    fn program_targets(&self, add: &mut impl FnMut(&str, &str, String, bool)) {
        let run = |what: &str| self.runs.iter().find(|run| run.what == what);
        for (what, told) in [
            ("run", "tune run, figures and front"),
            ("run --no-front", "tune run --no-front, figures"),
        ] {
            if let Some(run) = run(what) {
                add(told, "1 s", time(run.seconds), run.seconds <= 1.0);
            }
        }
        let judged: Vec<_> =
            self.runs.iter().filter(|run| run.what.starts_with("validate")).collect();
        let [first, .., two, one] = &judged[..] else { return };
        let records = |what: &str| {
            what.split(' ').find_map(|word| word.parse::<f64>().ok()).unwrap_or(f64::NAN)
        };
        let (few, most) = (records(&first.what), records(&two.what));
        let ratio = (two.seconds / most) / (first.seconds / few);
        let what = format!("tune validate, cost of a record, {most} over {few} records");
        add(&what, "linear: within 0.5 to 1.5", format!("{ratio:.2}"), (0.5..1.5).contains(&ratio));
        let gain = one.seconds / two.seconds;
        add(
            "tune validate, two cores over one",
            "1.9 times faster",
            format!("{gain:.2} times"),
            gain >= 1.9,
        );
        if let Some(memory) = two.memory {
            add(
                &format!("tune validate of {most} histories, memory"),
                "100 MB",
                format!("{memory:.0} MB"),
                memory < 100.0,
            );
        }
    }
}

/// The targets as a table.
pub(crate) fn table_of(measured: &Measurements) -> String {
    let row = |t: SpeedTarget| {
        [t.what, t.wanted, t.measured, (if t.met { "met" } else { "not met" }).to_string()]
    };
    let head = format!("{SECONDS} s of El Centro");
    table([&head, "target", "measured", ""], measured.targets().into_iter().map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{program::ProgramRun, tests::series};

    #[test]
    fn a_peer_that_is_too_inaccurate_does_not_count() {
        let rigid = vec![
            series("groundspring", &[(1e-4, 1e-12)]),
            series("diffsol", &[(2e-4, 1e-5), (5e-4, 1e-11)]),
        ];
        let targets = Measurements { rigid, ..Measurements::default() }.targets();
        assert!(targets[0].met && targets[0].measured.starts_with("5.0 times"), "{targets:?}");
    }

    #[test]
    fn open_sees_is_compared_at_an_error_that_both_reach() {
        let ours = series("groundspring, x", &[(1e-3, 4e-4), (2e-3, 1e-5)]);
        let peer = series("OpenSees TRBDF2, x", &[(1.0, 1e-1), (5.0, 3e-4)]);
        let targets =
            Measurements { elements: vec![ours, peer], own: 1, ..Measurements::default() }
                .targets();
        assert!(targets[0].met && targets[1].met);
        assert!(targets[1].measured.starts_with("5000 times"), "{targets:?}");
    }

    #[test]
    fn linear_time_and_the_gain_of_two_cores_are_told() {
        let run = |what: &str, seconds: f64| ProgramRun {
            what: what.into(),
            seconds,
            memory: Some(20.0),
        };
        let runs = vec![
            run("validate --synthetic 100 --jobs 2", 1.0),
            run("validate --synthetic 1000 --jobs 2", 10.0),
            run("validate --synthetic 1000 --jobs 1", 18.0),
        ];
        let targets = Measurements { runs, ..Measurements::default() }.targets();
        assert_eq!(targets.iter().map(|t| t.met).collect::<Vec<_>>(), [true, false, true]);
        assert_eq!(targets[1].measured, "1.80 times");
    }
}
