//! Up to where `tune verify` compares, and what its body has that the structure has not, in words.

use std::fmt::Write as _;

use decks::verify::{ComparedReach, OwnEnd, Slip};
use files::message::{percent, significant};
use rocking::motion::{Motion, peak};

/// Up to when something is told, if that is not the record's end, after the word of the verdict.
pub(super) fn up_to(samples: usize, reach: &ComparedReach, dt: f64) -> String {
    let samples = samples.min(reach.samples);
    match samples < reach.of {
        true => format!(" up to {:.2} s", seconds(samples, dt)),
        false => String::new(),
    }
}

fn seconds(samples: usize, dt: f64) -> f64 {
    samples.saturating_sub(1) as f64 * dt
}

/// An error, or a dash where the reference moves no more than `least`: over next to nothing any
/// error is large.
pub(super) fn error(value: f64, reference: &[f64], least: f64) -> String {
    match value.is_finite() && peak(reference).abs() > least {
        true => format!("{value:.2e}"),
        false => "-".into(),
    }
}

/// What errors beside Housner's history are told over.
pub(super) fn counted(housner: &Motion, reach: &ComparedReach) -> Motion {
    housner.first(reach.housner)
}

/// A line for each history that ends early, and for a body that is not the structure's.
pub(super) fn notes(reach: &ComparedReach, dt: f64) -> String {
    let mut out = String::new();
    let at = format!("{:.2} s", seconds(reach.samples, dt));
    let why = reach.own_end.map(|end| match end {
        OwnEnd::Falls => "the body has fallen over",
        OwnEnd::WorkBound => "tune simulate's history ends at its bound on steps",
        OwnEnd::Unstable => "the rotation loses its balance in tune simulate's history",
        OwnEnd::Stopped => "tune simulate's history could not be followed further",
    });
    // writing to a String does not fail
    if let Some(why) = why {
        let _ = writeln!(out, "compared up to {at}: there {why}");
    }
    if reach.housner < reach.samples {
        let _ = match reach.housner_overturns_s {
            Some(time) => writeln!(
                out,
                "Housner's history counts up to {time:.2} s: his body overturns there, the one on \
                    springs does not"
            ),
            None => writeln!(
                out,
                "Housner's history counts up to {:.2} s: it ends there, or the ground would have \
                    to pull its pivot down",
                seconds(reach.housner, dt)
            ),
        };
    }
    if let Some(added) = &reach.added {
        let [own, deck] = added.largest_m.map(|u| significant(1e3 * u, 5));
        let _ = writeln!(
            out,
            "NOTE: all three bodies here have a rotational inertia of {} kg m2 ({} m R^2), the \
                least that the\ndeck needs; tune run follows the structure's own, {} kg m2: its \
                largest u is {own} mm in place of\n{deck} mm, and the two histories are at most \
                {} mm apart",
            significant(added.deck_kgm2, 4),
            significant(added.share, 2),
            significant(added.given_kgm2, 4),
            significant(1e3 * added.apart_m, 2)
        );
    }
    out
}

/// How far OpenSees' slip is from ours, of a body that slides and never lifts: the larger
/// difference is judged over the largest slip, the final one told over itself as well.
pub(super) fn slips(slip: &Slip) -> String {
    let mm = |x: [f64; 2]| x.map(|x| format!("{:.3} mm", 1e3 * x));
    let ([largest, of_deck], [last, last_of_deck]) = (mm(slip.largest_m), mm(slip.last_m));
    let share = |error: f64| match error.is_finite() {
        true => percent(error),
        false => "all".into(),
    };
    format!(
        "nothing lifts; the largest slip of OpenSees differs by {}, the final one by {} of \
            itself;\nthe larger difference is {} of tune simulate's largest slip, of {} allowed\n\
            largest slip {largest}, of OpenSees {of_deck}; final slip {last}, of OpenSees \
            {last_of_deck}",
        share(slip.error_of_largest()),
        share(slip.error_of_last()),
        percent(slip.error()),
        percent(Slip::LIMIT)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use decks::verify::AddedInertia;

    const ALL: ComparedReach = ComparedReach {
        samples: 501,
        of: 501,
        own_end: None,
        housner: 501,
        housner_overturns_s: None,
        added: None,
    };

    #[test]
    fn a_history_that_ends_early_says_when_and_why_and_one_that_does_not_says_nothing() {
        assert_eq!(notes(&ALL, 0.01) + &up_to(501, &ALL, 0.01), "");
        let fallen =
            ComparedReach { samples: 301, own_end: Some(OwnEnd::Falls), housner: 201, ..ALL };
        let said = notes(&fallen, 0.01);
        assert!(said.contains("compared up to 3.00 s: there the body has fallen over"), "{said}");
        assert!(said.contains("Housner's history counts up to 2.00 s"), "{said}");
        assert_eq!(up_to(501, &fallen, 0.01), " up to 3.00 s");
        let steps = ComparedReach { own_end: Some(OwnEnd::WorkBound), ..fallen };
        assert!(notes(&steps, 0.01).contains("bound on steps"));
        let slides = ComparedReach { housner: 201, housner_overturns_s: Some(2.004), ..ALL };
        let said = notes(&slides, 0.01);
        assert!(said.contains("up to 2.00 s: his body overturns there"), "{said}");
    }

    #[test]
    fn a_body_with_more_inertia_than_the_structure_says_by_how_much_it_moves_otherwise() {
        let added = AddedInertia {
            given_kgm2: 96.38,
            deck_kgm2: 4819.0,
            share: 5e-4,
            largest_m: [0.4368, 0.436_64],
            apart_m: 1.5e-3,
        };
        let said = notes(&ComparedReach { added: Some(added), ..ALL }, 0.01);
        for part in ["4819 kg m2", "96.38 kg m2", "436.8 mm", "436.64 mm", "1.5 mm apart"] {
            assert!(said.contains(part), "{said}");
        }
    }

    /// 4.451 mm and 4.210 mm are 5.41 % apart, which is 0.646 % of a largest slip of 37.33 mm.
    #[test]
    fn a_final_slip_is_told_over_itself_and_over_the_largest() {
        let slip = Slip { largest_m: [0.037_33, 0.037_36], last_m: [0.004_451, 0.004_21] };
        let said = slips(&slip);
        for part in ["OpenSees differs by 0.080 %", "the final one by 5.41 % of itself"] {
            assert!(said.contains(part), "{said}");
        }
        assert!(
            said.contains("is 0.646 % of tune simulate's largest slip, of 1.00 % allowed"),
            "{said}"
        );
        let nowhere = Slip { last_m: [0.0, 1e-4], ..slip };
        assert!(slips(&nowhere).contains("the final one by all of itself"));
    }

    #[test]
    fn an_error_over_nothing_is_a_dash() {
        assert_eq!(error(f64::INFINITY, &[0.0; 3], 1e-6), "-");
        assert_eq!(error(1.02e2, &[1e-9, -1e-9], 1e-6), "-");
        assert_eq!(error(1.02e-3, &[0.1, -0.1], 1e-6), "1.02e-3");
    }
}
