//! The fits of every group, and their bounds.

use std::collections::HashMap;

use super::{
    Bin, FragilityGroup, FragilityRow, GroupPlaces, LimitState, MEASURES, bin, exceeds, measures,
    sorted,
};
use crate::{
    SweepError,
    lognormal::{Group, LognormalFit, Outcomes, Probit, SymmetricMatrix},
    parts::SweepParts,
    reduce,
};

/// The fits of every group, on every measure, of every state.
pub(super) fn fits(members: &[FragilityGroup], states: &[LimitState]) -> Vec<FragilityRow> {
    let all: Vec<(usize, usize)> = (0..members.len())
        .flat_map(|place| (0..MEASURES.len()).map(move |measure| (place, measure)))
        .collect();
    let of = |&(place, measure): &(usize, usize)| -> Vec<FragilityRow> {
        let bins = sorted(&members[place].bins[measure]);
        let ends = (bins.first(), bins.last());
        let mean = |bin: Option<&&Bin>| bin.map_or(1.0, |bin| (bin.sum_ln / bin.n as f64).exp());
        let range = (mean(ends.0), mean(ends.1));
        let fitted = |(s, state): (usize, &LimitState)| {
            let group =
                |bin: &&Bin| Group { ln_x: bin.sum_ln / bin.n as f64, n: bin.n, k: bin.k[s] };
            let groups: Vec<Group> = bins.iter().map(group).collect();
            let (n, exceeded) =
                groups.iter().fold((0, 0), |(n, k), group| (n + group.n, k + group.k));
            let fit = if n == 0 { LognormalFit::NoneExceeded } else { LognormalFit::new(&groups) };
            FragilityRow {
                member: place,
                state: *state,
                measure,
                n,
                exceeded,
                range,
                fit,
                covariance: None,
            }
        };
        states.iter().enumerate().map(fitted).collect()
    };
    parallel::map(&all, of).into_iter().flatten().collect()
}

/// The second pass: sums of u u^T over records, whose histories come one after the other.
pub(super) fn bounds(
    parts: &SweepParts,
    places: &GroupPlaces,
    members: &[FragilityGroup],
    states: &[LimitState],
    rows: &mut [FragilityRow],
) -> Result<(), SweepError> {
    let fitted: Vec<Option<Probit>> = rows.iter().map(|row| row.probit().copied()).collect();
    // of each fit and bin: the scores of an outcome that exceeds and of one that does not, times 1
    // and ln x
    let table: Vec<HashMap<i32, Vec<[f64; 3]>>> =
        parallel::map_range(0..members.len() * MEASURES.len(), |at| {
            let fits = &fitted[at * states.len()..(at + 1) * states.len()];
            let bins = &members[at / MEASURES.len()].bins[at % MEASURES.len()];
            let scores = |bin: &Bin| -> Vec<[f64; 3]> {
                let ln_x = bin.sum_ln / bin.n as f64;
                let of = |fit: &Option<Probit>| {
                    fit.map_or([0.0; 3], |fit| {
                        let at = Outcomes::at(fit.a + fit.b * ln_x);
                        [at.score_over, at.score_under, ln_x]
                    })
                };
                fits.iter().map(of).collect()
            };
            bins.iter().map(|(key, bin)| (*key, scores(bin))).collect()
        });
    let (mut sums, mut current) = (vec![[0.0; 3]; rows.len()], vec![[0.0; 2]; rows.len()]);
    let flush = |current: &mut [[f64; 2]], sums: &mut [SymmetricMatrix]| {
        for (u, sum) in current.iter_mut().zip(sums) {
            *sum = [sum[0] + u[0] * u[0], sum[1] + u[0] * u[1], sum[2] + u[1] * u[1]];
            *u = [0.0; 2];
        }
    };
    let mut motion = None;
    reduce::each(parts, |seen| {
        if motion.replace(seen.cell.motion) != Some(seen.cell.motion) {
            flush(&mut current, &mut sums);
        }
        let xs = measures(places.plan, seen);
        for (place, model) in places.of(seen) {
            let Some(known) = &seen.answers[model] else { continue };
            for (measure, x) in xs.iter().enumerate() {
                let at = place * MEASURES.len() + measure;
                let Some(scores) = table[at].get(&bin(*x)) else { continue };
                let current = &mut current[at * states.len()..(at + 1) * states.len()];
                for ((u, state), [over, under, ln_x]) in current.iter_mut().zip(states).zip(scores)
                {
                    let score = if exceeds(*state, known) { over } else { under };
                    *u = [u[0] + score, u[1] + score * ln_x];
                }
            }
        }
    })?;
    flush(&mut current, &mut sums);
    for (row, scores) in rows.iter_mut().zip(sums) {
        row.covariance =
            row.probit().and_then(|fit| fit.covariance(scores, members[row.member].records));
    }
    Ok(())
}
