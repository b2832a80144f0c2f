//! What a sweep found, in plain words.

use super::{
    compare::Comparison,
    fragility::{Fragility, FragilityGroup, FragilityRow, LimitState, MEASURES, subject_name},
    ida::{Ida, IdaPoint},
    levels,
    plan::{Measure, Plan},
    reduce::MODELS,
};
use crate::lognormal::LognormalFit;
use files::message::rounded;
use rocking::{scalar::GRAVITY, structure::Kind};
use sweep_table::SweepTable;

/// A model in words.
fn by(model: &str) -> &'static str {
    if model == "fem" { "on springs, by finite elements" } else { "by Housner's equation" }
}

/// What was computed; of some parts alone, of how many histories.
pub fn head(plan: &Plan, gathered: u64) -> String {
    let counted =
        |n: usize, one: &str, several: &str| format!("{n} {}", if n == 1 { one } else { several });
    let part = if gathered < plan.cells() { format!("{gathered} of ") } else { String::new() };
    let restitutions =
        plan.restitutions.as_ref().map_or("each structure's own restitution".into(), |all| {
            counted(all.len(), "restitution", "restitutions")
        });
    format!(
        "{part}{}: {}, {}, {restitutions}, {}.",
        counted(plan.cells() as usize, "history", "histories"),
        counted(plan.subjects.len(), "structure", "structures"),
        counted(plan.motions.len(), "ground motion", "ground motions"),
        counted(plan.levels.len(), "level", "levels"),
    )
}

/// What holds for all histories of a sweep: how many motions have a vertical component, and that
/// bodies do not slide.
pub fn assumptions(plan: &Plan, with_vertical: usize) -> Vec<String> {
    let mut said = Vec::new();
    if plan.takes_vertical() {
        said.push(format!(
            "Motions with a vertical component: {with_vertical} of {}; the others are horizontal.",
            plan.motions.len()
        ));
    }
    let widest = plan.subjects.iter().max_by(|a, b| a.alpha.total_cmp(&b.alpha));
    said.extend(widest.map(|widest| {
        let of = match &plan.subjects[..] {
            all if all.iter().all(|other| other.alpha == widest.alpha) => String::new(),
            _ => format!(" for {}, and less for more slender ones", widest.name),
        };
        format!(
            "To lift, a body needs a friction coefficient of at least b/h = tan(alpha): \
             {:.3}{of}. With less it slides, which a sweep does not follow.",
            widest.alpha.tan()
        )
    }));
    said
}

/// Structures that are spoken of one by one.
const SPOKEN_OF: usize = 12;

/// A paragraph a structure on overturning, and one on which measure tells most.
pub fn fragility(plan: &Plan, fragility: &Fragility, ida: &Ida) -> Vec<String> {
    let mut said = Vec::new();
    let spoken_of =
        |member: &FragilityGroup| member.subject.is_none_or(|subject| subject < SPOKEN_OF);
    for (at, member) in fragility.members.iter().enumerate().filter(|(_, member)| spoken_of(member))
    {
        let rows = || {
            fragility
                .rows
                .iter()
                .filter(move |row| row.member == at && row.state == LimitState::Overturning)
        };
        let Some(pga) =
            rows().find(|row| row.measure == if member.subject.is_some() { 0 } else { 2 })
        else {
            continue;
        };
        let name = subject_name(plan, member.subject);
        let e = match &plan.restitutions {
            Some(all) => format!(", e = {}", all[member.restitution]),
            None => String::new(),
        };
        let share = 100.0 * pga.exceeded as f64 / pga.n.max(1) as f64;
        let fit = fit_words(fragility, member, pga);
        said.push(format!(
            "- {name}{e}, {}: {share:.1} % of {} histories overturn; {fit}.",
            by(MODELS[member.model]),
            pga.n
        ));
        said.extend(at_levels(plan, fragility, ida, member));
        if member.subject.is_none() {
            said.extend(best_measure(rows()));
        }
        if member.excluded > 0 {
            said.push(format!(
                "  {} histories are left out: failed, or the pivot left the ground.",
                member.excluded
            ));
        }
    }
    if plan.subjects.len() > SPOKEN_OF {
        said.push("- All structures are in fragility.csv.".into());
    }
    said.push(on_bounds(fragility));
    said
}

/// What a fit of overturning says, in words.
fn fit_words(fragility: &Fragility, member: &FragilityGroup, pga: &FragilityRow) -> String {
    let percent = 100.0 * fragility.confidence;
    let (measure, unit) = MEASURES[pga.measure];
    let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
    let extrapolated = if pga.is_extrapolated() { ", extrapolated beyond the levels" } else { "" };
    let one = member.records == 1;
    match (&pga.fit, pga.bounds(fragility.half_width())) {
        (LognormalFit::Fitted(fit), Some(bounds)) => format!(
            "half of the motions overturn it at {measure} = {:.3}{unit}{extrapolated} \
             ({percent:.0} % bounds {:.3} to {:.3}), beta {:.2} ({:.2} to {:.2})",
            fit.median(),
            bounds.median.0,
            bounds.median.1,
            fit.beta(),
            bounds.beta.0,
            bounds.beta.1
        ),
        (LognormalFit::Fitted(fit), None) if one => format!(
            "one record gives no bounds: the fit to its levels is 0.5 at {measure} = \
             {:.3}{unit}{extrapolated}, beta {:.2}",
            fit.median(),
            fit.beta()
        ),
        (LognormalFit::Fitted(fit), None) => format!(
            "half of the motions overturn it at {measure} = {:.3}{unit}{extrapolated}, beta \
             {:.2}; the {} records do not differ, so there are no bounds",
            fit.median(),
            fit.beta(),
            member.records
        ),
        (LognormalFit::NoneExceeded, _) if member.excluded > 0 => {
            let model = match MODELS[member.model] {
                "housner" => "; model = \"fem\" follows those that leave the ground",
                _ => "",
            };
            format!("no motion that is not left out overturns it{model}")
        }
        (LognormalFit::NoneExceeded, _) => "no motion overturns it; raise the levels".into(),
        (LognormalFit::AllExceeded, _) => "every motion overturns it; lower the levels".into(),
        (LognormalFit::Separated { below, above }, _) if one => format!(
            "the one motion leaves it standing up to {measure} = {below:.3}{unit} and overturns \
             it from {above:.3}{unit}; another motion has other limits"
        ),
        (LognormalFit::Separated { below, above }, _) => {
            format!(
                "{measure} alone decides: up to {below:.3}{unit} it stands, from \
                 {above:.3}{unit} it overturns"
            )
        }
        (LognormalFit::Undetermined, _) => {
            format!(
                "no fit on {measure}: outcomes are mixed at one level alone; add levels \
                 about it"
            )
        }
        (LognormalFit::Falling, _) => {
            format!("no fit on {measure}: higher levels overturn it less often")
        }
    }
}

/// What the bounds rest on.
fn on_bounds(fragility: &Fragility) -> String {
    let records = fragility.members.first().map_or(0, |member| member.records);
    if records == 1 {
        "One record says nothing of other motions: take more.".into()
    } else if records < 10 {
        format!("Bounds rest on {records} records only: take more.")
    } else {
        "Bounds take the histories of one record for one observation, however many levels it was \
         scaled to."
            .into()
    }
}

/// Rows of levels in all, and at least and at most of one structure.
const LEVEL_ROWS: usize = 24;
const ROWS_EACH: (usize, usize) = (3, 10);

/// Where a structure lifts, and a table of what becomes of it at the levels.
fn at_levels(
    plan: &Plan,
    fragility: &Fragility,
    ida: &Ida,
    member: &FragilityGroup,
) -> Option<String> {
    let subject = &plan.subjects[member.subject?];
    let mine = |point: &&IdaPoint| {
        (point.model, Some(point.subject), point.restitution)
            == (member.model, member.subject, member.restitution)
    };
    let groups = fragility
        .members
        .iter()
        .filter(|member| member.subject.is_some_and(|i| i < SPOKEN_OF))
        .count();
    let most = (LEVEL_ROWS / groups.max(1)).clamp(ROWS_EACH.0, ROWS_EACH.1);
    let (rows, counting) =
        levels::telling(plan, ida.points.iter().filter(mine), fragility.half_width(), most);
    let measure = match plan.measure {
        Measure::Scale => "scale",
        Measure::PgaG => "PGA [g]",
        Measure::PgaOverUplift => "PGA/(g tan alpha)",
    };
    let top = match subject.structure.kind {
        Kind::Block => "top",
        Kind::AFrame => "apex",
    };
    let at = match subject.members.tendon {
        Some(_) => "(1 + N0/W) g tan(alpha)",
        None => "g tan(alpha)",
    };
    let all = ida.points.iter().filter(mine).count();
    let shown = levels::shown_words(rows.len(), counting, all);
    let mut text = format!(
        "  {} at PGA = {at} = {:.3} g.{shown}\n\
         \n  | {measure} | P(overturn) | {:.0} % bounds | lifts | {top} moves, median / 84 % [mm] \
         | foot lifts [mm] |\n  \
         |---|---|---|---|---|---|",
        if plan.takes_vertical() { "Without vertical motion it lifts" } else { "It lifts" },
        subject.lifts_at() / GRAVITY,
        100.0 * fragility.confidence
    );
    for row in rows {
        let millimetres = |x: f64| match 1e3 * x {
            0.0 => "0".into(),
            x if x < 0.1 => "< 0.1".into(),
            x if x.is_finite() => rounded(x, 3).to_string(),
            _ => "overturned".into(),
        };
        let both = |a: f64, b: f64| format!("{} / {}", millimetres(a), millimetres(b));
        text += &format!(
            "\n  | {} | {:.1} % | {:.1} to {:.1} % | {:.0} % | {} | {} |",
            rounded(row.level, 3),
            100.0 * row.overturned,
            100.0 * row.bounds.0,
            100.0 * row.bounds.1,
            100.0 * row.lifted,
            both(row.median.top_m, row.most.top_m),
            both(row.median.uplift_m, row.most.uplift_m),
        );
    }
    Some(text + "\n")
}

/// The measure with the least scatter.
fn best_measure<'a>(rows: impl Iterator<Item = &'a FragilityRow>) -> Option<String> {
    let betas: Vec<(&str, f64)> = rows
        .filter_map(|row| row.probit().map(|fit| (MEASURES[row.measure].0, fit.beta())))
        .collect();
    let (best, beta) = betas.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let others: Vec<String> =
        betas.iter().filter(|(name, _)| name != best).map(|(n, b)| format!("{n} {b:.2}")).collect();
    Some(format!(
        "  Over all structures {best} scatters least: beta {beta:.2} ({}).",
        others.join(", ")
    ))
}

/// What overturns over size and slenderness.
pub fn rocking(plan: &Plan, ida: &Ida) -> Vec<String> {
    let mut said = Vec::new();
    let counts = ida.points.iter().fold([0_u64; 4], |[n, lifted, over, out], p| {
        [n + p.n, lifted + p.lifted, over + p.overturned, out + p.left_out]
    });
    let [n, lifted, over, out] = counts;
    let share = |k: u64| 100.0 * k as f64 / n.max(1) as f64;
    said.push(format!(
        "Of {n} histories {:.1} % never lift the body, {:.1} % rock it without overturning it, \
         {:.1} % overturn it; {out} more are left out.",
        share(n - lifted),
        share(lifted - over),
        share(over)
    ));
    // as in the tables, where the median is infinite
    let overturned = ida.points.iter().filter(|p| p.quantile(0.5) == Some(f64::INFINITY));
    let largest =
        overturned.max_by(|a, b| plan.subjects[b.subject].p.total_cmp(&plan.subjects[a.subject].p));
    if let Some(point) = largest {
        let subject = &plan.subjects[point.subject];
        let who = match plan.motions.len() {
            1 => "The largest body that overturns",
            _ => "The largest body that at least half of the motions overturn",
        };
        said.push(format!("{who}: {} (1/p = {:.3} s).", subject.name, 1.0 / subject.p));
    }
    said
}

/// How both models differ.
pub fn compare(comparison: &Comparison) -> Vec<String> {
    let Some(all) = comparison.all() else { return Vec::new() };
    let number = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.4}"));
    vec![format!(
        "Rigid against springs, {} histories ({} left out): both say the same of overturning in \
         {:.2} % (Housner alone overturns {}, springs alone {}); \
         where Housner's body lifts and neither overturns ({} histories) peaks of theta/alpha \
         differ by {} (median) and {} (90 %); the distributions of all peaks differ by {:.4} (KS); \
         NRMSE of u where Housner's body lifts {} (median), {} (90 %), of motions that cannot be \
         predicted, too: tune validate tells these apart.",
        all.n,
        all.left_out,
        100.0 * all.agreement().unwrap_or(0.0),
        all.housner_only,
        all.fem_only,
        all.difference.count(),
        number(all.difference.quantile(0.5)),
        number(all.difference.quantile(0.9)),
        all.ks_distance(),
        number(all.nrmse.quantile(0.5)),
        number(all.nrmse.quantile(0.9)),
    )]
}

/// What pulses it takes.
pub fn overturning(plan: &Plan, table: &SweepTable) -> Vec<String> {
    let (from, to) = (table.reals("from_over_uplift"), table.reals("to_over_uplift"));
    let mut said = vec![format!(
        "{} pulse frequencies times structures, scanned from {} to {} times g tan(alpha): {} \
         intervals overturn.",
        plan.cells(),
        plan.levels[0],
        plan.levels[plan.levels.len() - 1],
        table.rows()
    )];
    let count =
        |ends: &[Option<f64>], has: bool| ends.iter().filter(|e| e.is_some() == has).count();
    match count(to, true) {
        0 => {}
        finite => said.push(format!(
            "{finite} of them have an upper end, above which a stronger pulse leaves the body \
             standing or overturns it otherwise."
        )),
    }
    match count(from, false) {
        0 => {}
        below => said.push(format!(
            "{below} of them begin below the levels: lower the levels to find where."
        )),
    }
    said.extend(least_pulses(plan, table));
    said
}

/// The pulses that overturn with the least peak, over g tan(alpha) and in g.
fn least_pulses(plan: &Plan, table: &SweepTable) -> Vec<String> {
    let (structure, pulse) = (table.texts("structure"), table.texts("pulse"));
    let [q, e, alpha, from] =
        ["omega_over_p", "restitution", "alpha", "from_over_uplift"].map(|name| table.reals(name));
    // PGA over g tan(alpha), in g
    let peaks = |row: usize| Some([from[row]?, from[row]? * alpha[row]?.tan()]);
    let least = |measure: usize| {
        (0..table.rows())
            .filter_map(|row| Some((row, peaks(row)?)))
            .min_by(|a, b| a.1[measure].total_cmp(&b.1[measure]))
    };
    let words = |(row, [over_uplift, g]): (usize, [f64; 2]), what: &str| {
        let e = match &plan.restitutions {
            Some(_) => format!(", e = {}", e[row].unwrap_or(f64::NAN)),
            None => String::new(),
        };
        format!(
            "Least {what} that overturns: PGA = {g:.4} g, {over_uplift:.4} g tan(alpha), {} at \
             omega/p = {:.3} on {}{e}.",
            pulse[row],
            q[row].unwrap_or(f64::NAN),
            structure[row]
        )
    };
    match (least(0), least(1)) {
        (Some(a), Some(b)) if a.0 == b.0 => vec![words(a, "PGA and PGA/(g tan alpha)")],
        (a, b) => [(a, "PGA/(g tan alpha)"), (b, "PGA")]
            .into_iter()
            .filter_map(|(least, what)| Some(words(least?, what)))
            .collect(),
    }
}
