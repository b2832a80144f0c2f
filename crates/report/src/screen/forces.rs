//! Design forces on the screen: two to a line, the largest moment first.

use super::{WIDTH, lines::wrapped};
use crate::{
    FiledParameters, Run,
    markdown::{held_words, range_words},
};
use files::message::{percent, quantity, significant};
use frames::structure::ElasticStructure;
use results::{DesignForce, DesignForces, ForceName};

/// What is told of a force besides when it is largest, as far as there is room.
#[derive(Clone, Copy, PartialEq)]
enum Told {
    /// Where a shear is, and the axial force beside a moment.
    Both,
    /// The axial force alone.
    Axial,
    /// When alone.
    Time,
    /// Nothing.
    Value,
}

/// What forces of the ground are, where there is room for it.
const AT_SOLES: &str = ", at soles between landings";
/// Blanks before a cell, and between two.
const INDENT: usize = 2;

/// A head, and the forces below it, two to a line where it is `tight`; none without a record.
pub(super) fn lines(run: &Run, tight: bool) -> Vec<String> {
    let Some(forces) = &run.design_forces else { return Vec::new() };
    // an asterisk where some are, a word where all are
    let [some, every] = [run.has_doubted_forces(), forces.all().all(|one| !Run::foretells(&one.1))];
    // of one motion of many the head tells of all
    let mark = if some && !every && !run.one_of_many() { "*" } else { "" };
    let doubt = match run.one_of_many() {
        true => Some("of this one motion: design by many".to_string()),
        false if some && every => Some("not predictable: design by many".to_string()),
        false => some.then(|| format!("{mark} not predictable").trim_start().to_string()),
    };
    let alone = run.peaks.and_then(|pair| pair.reference_ends_s);
    let alone = alone.map(|end| format!("springs alone after {} s", significant(end, 3)));
    let rest = forces.all().any(|(_, force)| force.is_at_rest());
    let rest = rest.then(|| format!("{}: no thrust", at_rest(run)));
    let far = forces.all().find_map(|(_, force)| force.springs_err);
    let far = far.map(|err| format!("withheld: peaks on springs err by {}", percent(err)));
    let notes: Vec<String> =
        changes(run, forces).into_iter().chain(far).chain(alone).chain(doubt).chain(rest).collect();
    let notes = if notes.is_empty() { String::new() } else { format!(" ({})", notes.join("; ")) };
    let head = format!("design forces{}{notes}", which(run, forces));
    // what goes first where it is too long
    let long = head.chars().count() > WIDTH;
    let head = if long { head.replace(AT_SOLES, "") } else { head };
    let mut lines = wrapped("", &head);
    let mut all: Vec<_> = forces.all().filter(|(name, _)| !in_the_report(*name)).collect();
    all.sort_by(|a, b| order(*a).total_cmp(&order(*b)));
    let withheld: Vec<_> =
        all.extract_if(.., |(_, force)| tight && force.value.is_none()).collect();
    let cells = |told: Told| -> Vec<[String; 2]> {
        let cell = |&(name, force): &(ForceName, DesignForce)| {
            let mark = if Run::doubts(&force) { mark } else { "" };
            [short(run, name, &force), value(name, &force, (mark, told, at_rest(run)))]
        };
        all.iter().map(cell).collect()
    };
    // an odd one has a line of its own, which is the first: the moment's; and so has one of which
    // there is more to tell than a pair has room for
    let fits = |told: Told| in_pairs(&cells(told)).is_some();
    let more = all.first().is_some_and(|(_, force)| {
        force.held.is_some() || (force.together.is_some() && !fits(Told::Axial))
    });
    let odd = all.len() % 2 == 1;
    let lone = usize::from(odd || (more && !fits(Told::Both)));
    let first = |told: Told| {
        cells(told).into_iter().take(lone).map(|cell| format!("  {}", cell.join("  ")))
    };
    let rows = [Told::Both, Told::Axial, Told::Time, Told::Value];
    let rows = rows.into_iter().find_map(|told| {
        let pairs = in_pairs(&cells(told)[lone..])?;
        Some(first(Told::Both).chain(pairs).collect::<Vec<_>>())
    });
    let one_each =
        || cells(Told::Both).iter().map(|cell| format!("  {}", cell.join("  "))).collect();
    lines.extend(rows.unwrap_or_else(one_each));
    if !withheld.is_empty() {
        let range = |(name, force): &(ForceName, DesignForce)| {
            let range = force.others.and_then(|others| others.range());
            let range = match range {
                Some(range) => format!(" {}", range_words(*name, range)),
                None => varies(force),
            };
            format!("{}{range}", short(run, *name, force))
        };
        let all: Vec<String> = withheld.iter().map(range).collect();
        lines.extend(wrapped("  withheld: ", &all.join("; ")));
    }
    lines
}

/// Forces of the ground that the report alone tells.
fn in_the_report(name: ForceName) -> bool {
    use ForceName::{AnchorHorizontal, CornerHorizontal, CornerVertical, SoleVertical};
    [SoleVertical, CornerVertical, CornerHorizontal, AnchorHorizontal].contains(&name)
}

/// What they are the largest of.
fn which(run: &Run, forces: &DesignForces) -> String {
    match (&run.parameters, forces.below_hz) {
        (FiledParameters::Rigid(_), _) => " between impacts".into(),
        (_, Some(hz)) => format!(" below {} Hz{AT_SOLES}", significant(hz, 3)),
        (_, None) => AT_SOLES.into(),
    }
}

/// By how much those that are given change, the largest of them.
fn changes(run: &Run, forces: &DesignForces) -> Option<String> {
    let given = forces.all().filter(|(_, force)| force.holds).filter_map(|(_, force)| force.change);
    let with = match run.parameters {
        FiledParameters::Rigid(_) => "springs",
        FiledParameters::Elastic(_) => "springs and mesh",
    };
    Some(format!("{} with {with}", percent(given.reduce(f64::max)?)))
}

/// Moments first, the largest of them before the others.
fn order((name, force): (ForceName, DesignForce)) -> f64 {
    match name {
        ForceName::ColumnBaseMoment | ForceName::ColumnTopMoment | ForceName::ApexMoment => {
            -force.value.or(force.raw).map_or(0.0, f64::abs)
        }
        ForceName::ColumnShear => 1.0,
        ForceName::Axial => 2.0,
        ForceName::AxialTension => 3.0,
        ForceName::SoleShear => 4.0,
        ForceName::SoleVertical | ForceName::CornerVertical => 4.5,
        ForceName::CornerHorizontal | ForceName::AnchorHorizontal => 4.5,
        ForceName::Tendon => 5.0,
        ForceName::Damper => 6.0,
    }
}

/// A name without what the report adds to it.
fn short(run: &Run, name: ForceName, force: &DesignForce) -> String {
    let pier = matches!(&run.parameters, FiledParameters::Elastic(parameters)
        if matches!(parameters.structure, ElasticStructure::Pier(_)));
    match name {
        ForceName::Axial if force.value.is_some_and(|value| value < 0.0) => {
            "axial compression".into()
        }
        ForceName::SoleShear if pier => "shear at the sole".into(),
        ForceName::SoleShear => "shear, all soles".into(),
        _ => run.force_words()(name).into(),
    }
}

/// The magnitude, when, and where; what is withheld lies between what was found.
fn value(name: ForceName, force: &DesignForce, (mark, told, rest): (&str, Told, &str)) -> String {
    let newtons = |x: f64| quantity(x.abs(), name.unit());
    let Some(largest) = force.value else {
        let found = force.others.and_then(|others| others.range());
        return match found {
            Some(range) => {
                let held = match told {
                    Told::Time | Told::Value => String::new(),
                    _ => held_words(name, force),
                };
                format!("withheld: {}{held}", range_words(name, range))
            }
            None => format!("withheld{}", varies(force)),
        };
    };
    let when = match force.is_at_rest() {
        _ if told == Told::Value => String::new(),
        true => format!(", {rest}"),
        false => format!(" at {} s", significant(force.time_s, 4)),
    };
    let up = force.above_base_m.filter(|above| *above > 0.0 && told == Told::Both);
    let up = up.map_or(String::new(), |above| format!(", {} m up", significant(above, 3)));
    // what a section bears at the same time
    let axial = force.together.filter(|_| name == ForceName::ColumnBaseMoment);
    let axial =
        axial.filter(|_| matches!(told, Told::Both | Told::Axial)).map(|together| together.axial_n);
    let axial = axial.map_or(String::new(), |axial| format!(", axial {}", quantity(axial, "N")));
    // what it is before that, where it is largest later
    let until = force.held.filter(|_| matches!(told, Told::Both | Told::Axial));
    let until = until.map_or(String::new(), |_| held_words(name, force));
    format!("{}{mark}{when}{up}{axial}{until}", newtons(largest))
}

/// What a structure bears at rest.
fn at_rest(run: &Run) -> &'static str {
    let pulled = match &run.parameters {
        FiledParameters::Rigid(parameters) => parameters.members().tendon.map(|t| t.pretension),
        FiledParameters::Elastic(_) => None,
    };
    if pulled.is_some_and(|n| n > 0.0) { "weight and pretension" } else { "own weight" }
}

/// Why a force is withheld.
fn varies(force: &DesignForce) -> String {
    // the head tells of springs that check none
    let change = force.change.filter(|_| force.springs_err.is_none());
    change.map_or(String::new(), |change| format!(" (varies {})", percent(change)))
}

/// Two cells to a line, names and values below each other; none if a line would be too long.
fn in_pairs(cells: &[[String; 2]]) -> Option<Vec<String>> {
    let letters = |text: &String| text.chars().count();
    let width = |column: usize, part: usize| {
        cells.iter().skip(column).step_by(2).map(|cell| letters(&cell[part])).max().unwrap_or(0)
    };
    let widths = [0, 1].map(|column| [width(column, 0), width(column, 1)]);
    let line = |pair: &[[String; 2]]| {
        let cells = pair.iter().zip(widths);
        let cells = cells.map(|([name, value], [first, second])| {
            format!("{:INDENT$}{name:<first$}  {value:<second$}", "")
        });
        cells.collect::<String>().trim_end().to_string()
    };
    let lines: Vec<String> = cells.chunks(2).map(line).collect();
    lines.iter().all(|line| letters(line) <= WIDTH).then_some(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_that_is_withheld_has_its_reason() {
        let force = DesignForce { change: Some(0.21), ..DesignForce::default() };
        let told = value(ForceName::ColumnShear, &force, ("", Told::Value, ""));
        assert_eq!(told, "withheld (varies 21.0 %)");
    }

    #[test]
    fn a_force_that_is_largest_at_rest_says_what_it_is_made_of() {
        let force = DesignForce { at_rest: Some(7.2e5), ..DesignForce::measured(7.2e5, 1.0, None) };
        let force = DesignForce { value: Some(7.2e5), ..force };
        let rest = "weight and pretension";
        let told = value(ForceName::ApexMoment, &force, ("", Told::Time, rest));
        assert_eq!(told, "720 kN m, weight and pretension");
    }
}
