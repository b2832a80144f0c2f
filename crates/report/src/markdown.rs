//! A run as Markdown: parameters.md, and what `--verbose` prints.

mod corners;

use self::corners::{at_corners, member_motions, members, on_one_corner};
use super::{FiledParameters, Run, Section, Table, peak_table, sentence};
use files::message::{percent, quantity, significant};
use results::{DesignForce, ForceName, OtherForces};

/// What forces of the ground are.
const OF_SOLES: &str = "forces of the ground are given between landings: what the columns bring \
    and the weight and inertia of the footings. The impulse that stops a landing footing is not \
    among them: on rigid ground it has no largest force.";

/// What the mark "not predictable" of a force means.
const ONE_OF_MANY: &str = " Not predictable: the motion up to that time is one of many alike, \
                           and no model tells which: design by many motions.";

/// The whole of it.
pub fn markdown(run: &Run) -> String {
    let mut out = format!("# Ground springs: {}\n\n{}\n\n", run.taken.structure, run.verdict());
    if let Some(record) = &run.taken.record {
        out.push_str(&format!("- {record}\n"));
    }
    for assumed in &run.taken.assumed {
        out.push_str(&format!("- assumed: {} ({})\n", assumed.what, assumed.key));
    }
    if let Some(accuracy) = &run.accuracy {
        out.push_str(&format!("- accuracy: {}\n", accuracy.sentence()));
    }
    for finding in run.remarks() {
        out.push_str(&format!("- {}\n", finding.line()));
    }
    for part in sections(run) {
        out.push('\n');
        out.push_str(&section(&part));
    }
    out
}

/// The tables of a run: peaks, design forces, springs, accuracy, then what this kind of structure
/// has.
pub(crate) fn sections(run: &Run) -> Vec<Section> {
    let mut all =
        vec![Section {
            id: "case",
            title: "The case".into(),
            table: Some(Table::new(["", ""]).with(
                run.taken.facts.iter().map(|(name, value)| vec![name.clone(), value.clone()]),
            )),
            ..Section::default()
        }];
    if let Some(table) = peak_table(run) {
        all.push(Section {
            id: "peaks",
            title: "Largest displacements".into(),
            text: vec![
                "Displacements of the highest point relative to the ground. By rocking: from the \
                    rotation of its base alone. By bending: across the axis of its base. By moved \
                    feet: how far from where they stood the feet of its base landed, without what \
                    they slid. Each value is the largest over all bases, at its own time."
                    .into(),
            ],
            table: Some(table),
            ..Section::default()
        });
    }
    all.extend(forces_to_design_with(run));
    all.extend(together(run));
    all.push(Section {
        id: "springs",
        title: format!("The springs at {}", run.springs_at),
        text: vec![
            "A numerical contact stiffness, not that of soil. Gap spring k1 between structure and \
                absorber m2, which presses only; k2 beside the dashpot c between absorber and \
                ground. m2 is a numerical mass, not one to be built."
                .into(),
        ],
        table: Some(springs(run)),
        ..Section::default()
    });
    if let Some(accuracy) = &run.accuracy {
        all.push(Section {
            id: "accuracy",
            title: "Accuracy, and on what".into(),
            text: vec![
                format!("{} Measured in this run.", sentence(&accuracy.sentence())),
                "NRMSE is the root mean square of the difference from the reference, divided by \
                    the root mean square of the reference; only motions that can be followed one \
                    to one count."
                    .into(),
            ],
            table: Some(accuracy.table()),
            ..Section::default()
        });
    }
    all.extend(other_forces(run));
    all.extend(run.sections.iter().cloned());
    all
}

fn section(part: &Section) -> String {
    let mut out = format!("## {}\n", part.title);
    let paragraphs = |out: &mut String, all: &[String]| {
        all.iter().for_each(|text| out.push_str(&format!("\n{text}\n")))
    };
    paragraphs(&mut out, &part.text);
    if let Some(table) = &part.table {
        out.push('\n');
        out.push_str(&table.markdown());
    }
    paragraphs(&mut out, &part.notes);
    if !part.commands.is_empty() {
        out.push_str(&format!("\n```sh\n{}\n```\n", part.commands.join("\n")));
    }
    out
}

/// The design forces with what is told of them; none without a record.
pub fn forces_to_design_with(run: &Run) -> Option<Section> {
    let (forces, words) = (run.design_forces.as_ref()?, run.force_words());
    let cell = |x: Option<f64>, name: ForceName| x.map_or("-".into(), |x| quantity(x, name.unit()));
    let row = |(name, force): (ForceName, DesignForce)| {
        let doubt = if Run::doubts(&force) { ", not predictable" } else { "" };
        vec![
            format!("{}{}", words(name), height(&force)),
            force_value(name, &force) + doubt,
            format!("{} s", significant(force.time_s, 4)),
            force.change.map_or("not measured".into(), percent),
            cell(force.rigid, name),
            cell(force.fixed, name),
        ]
    };
    let head = [
        "force",
        "largest",
        "at",
        "change with springs or mesh",
        "rigid body (Housner)",
        "fixed to the ground",
    ];
    let below = match forces.below_hz {
        Some(hz) => {
            let hz = significant(hz, 3);
            format!("Largest value after a low-pass filter at {hz} Hz; {OF_SOLES}")
        }
        None if matches!(run.parameters, FiledParameters::Elastic(_)) => {
            format!("Columns without mass carry no waves: their forces are unfiltered; {OF_SOLES}")
        }
        None => "Largest between impacts: an impact's impulse is not among them.".into(),
    };
    Some(Section {
        id: "forces",
        title: "Forces to design with".into(),
        text: vec![format!(
            "{below} A force is given if it changes by less than 5 % with the springs' stiffness \
                and the mesh, as measured in this run. Column shear is that of the height where it \
                is largest, axial force that at the base; members.csv has all members. Axial force \
                is positive in tension. Each is the largest by itself, at its own time{}.{}",
            if together(run).is_some() { "; what acts together is below" } else { "" },
            if run.has_doubted_forces() { ONE_OF_MANY } else { "" }
        )],
        table: Some(Table::new(head).with(forces.all().map(row))),
        notes: on_one_corner(forces)
            .into_iter()
            .chain(at_corners(members(run), forces))
            .chain(member_motions(forces))
            .collect(),
        ..Section::default()
    })
}

/// A force with its sign, and up to when if that is not all of the record; between what it lies if
/// it does not hold.
pub fn force_value(name: ForceName, force: &DesignForce) -> String {
    let newtons = |x: f64| quantity(x, name.unit());
    let Some(value) = force.value else {
        if let Some(err) = force.springs_err {
            return format!("withheld: peaks on springs err by {}", percent(err));
        }
        return match (force.others.and_then(|others| others.range()), force.change) {
            (Some(range), _) => format!(
                "withheld: {} with springs and mesh{}",
                range_words(name, range),
                held_words(name, force)
            ),
            (None, Some(change)) => format!("withheld: changes by {} on springs", percent(change)),
            (None, None) => "withheld".into(),
        };
    };
    let whole = |whole: OtherForces| format!("; {} over all", newtons(whole.found.abs()));
    let whole = force.whole_record.map_or(String::new(), whole);
    let part = force
        .over_s
        .map_or(String::new(), |over| format!(" (to {} s{whole})", significant(over, 3)));
    newtons(value) + &part + &held_words(name, force)
}

/// Between what a withheld force lies: the unit once, if it is the same.
pub(crate) fn range_words(name: ForceName, range: [f64; 2]) -> String {
    let [low, high] = range.map(|x| quantity(x.abs(), name.unit()));
    let unit = |words: &str| words.split_once(' ').map(|(_, unit)| unit.to_owned());
    match low.split_once(' ') {
        Some((number, _)) if unit(&low) == unit(&high) => format!("{number} to {high}"),
        _ => format!("{low} to {high}"),
    }
}

/// What a force that is larger later is, and holds, up to when a motion can be foretold, in words.
pub(crate) fn held_words(name: ForceName, force: &DesignForce) -> String {
    force.held.map_or(String::new(), |held| {
        let newtons = quantity(held.value.abs(), name.unit());
        format!(" ({newtons} to {} s)", significant(held.over_s, 3))
    })
}

/// Where along the column, in words, if not at its base.
pub fn height(force: &DesignForce) -> String {
    let above = force.above_base_m.filter(|above| *above > 0.0);
    above.map_or(String::new(), |above| format!(", {} m above the base", significant(above, 3)))
}

/// What acts together with the largest forces of a column or a leg: pairs for an interaction
/// diagram.
fn together(run: &Run) -> Option<Section> {
    let words = run.force_words();
    let elastic = matches!(run.parameters, FiledParameters::Elastic(_));
    let forces = run.design_forces?;
    let legs = forces.apex_moment_nm.is_some();
    let row = |(name, force): (ForceName, DesignForce)| {
        // nor is what acts together with one that does not hold
        let with = force.together.filter(|_| force.holds)?;
        let moment = with.apex_moment_nm.unwrap_or(with.column_base_moment_nm);
        let cells = [(with.axial_n, "N"), (moment, "N m"), (with.column_shear_n, "N")];
        let at = format!("{} s", significant(force.time_s, 4));
        Some(
            [
                vec![format!("largest {}", words(name)), at],
                cells.map(|(x, unit)| quantity(x, unit)).into(),
            ]
            .concat(),
        )
    };
    let rows: Vec<_> = forces.all().filter_map(row).collect();
    let moment = if legs { ForceName::ApexMoment } else { ForceName::ColumnBaseMoment };
    let head = ["where", "at", "axial force", words(moment), words(ForceName::ColumnShear)];
    let place = match (legs, elastic) {
        (true, _) => "in a leg",
        (false, true) => "at the column's base",
        (false, false) => "at the base",
    };
    let of = match elastic {
        true => {
            "At the time of each largest force, below the same frequency; means over parts of the \
                record's time step."
        }
        false if members(run) => {
            "At the time of each largest force: near landings by Housner's equation with the \
                members, between them on springs, which add nothing where one foot presses; of a \
                body that stands by statics."
        }
        false if run.members_words() == "with friction" => {
            "At the time of each largest force, on springs with friction: pressing with both feet \
                the body bears what statics say of the friction that it slides by or holds, each \
                foot at most mu times what it presses with."
        }
        false => "At the time of each largest force, of Housner's body.",
    };
    let higher =
        if elastic && !legs { " The largest shear may be higher up the column." } else { "" };
    (!rows.is_empty()).then(|| Section {
        id: "together",
        title: format!("What acts together {place}"),
        text: vec![format!("{of}{higher} Axial force is positive in tension.")],
        table: Some(Table::new(head).with(rows)),
        ..Section::default()
    })
}

/// What forces were with another mesh and on other springs, by which it is decided whether they are
/// given.
fn other_forces(run: &Run) -> Option<Section> {
    let row = |(name, force): (ForceName, DesignForce)| {
        let others = force.others?;
        let cell = |x: Option<f64>| x.map_or("-".into(), |x| quantity(x, name.unit()));
        let held = if force.holds { "holds" } else { "withheld" };
        let cells =
            [Some(others.found), others.doubled_elements, others.softer, others.stiffer].map(cell);
        let beyond = [others.doubled_cutoff, force.raw].map(cell);
        let name = vec![name.words().to_string()];
        Some([name, cells.into(), vec![held.into()], beyond.into()].concat())
    };
    let forces = run.design_forces?;
    let rows: Vec<_> = forces.all().filter_map(row).collect();
    let twice = match forces.below_hz {
        Some(hz) => format!("below {} Hz", significant(2.0 * hz, 3)),
        None => "below twice the frequency".into(),
    };
    let head = ["force", "in this run", "elements doubled", "Omega_n / 4", "4 Omega_n", ""];
    let head = head.map(String::from).into_iter().chain([twice, "unfiltered".into()]);
    let waves = forces.below_hz.map(|hz| {
        format!(
            "Forces are given below {} Hz: one and a half times the third bending mode of the \
                column on a fixed footing. The last two columns have what faster waves of a \
                landing add in this run: how much hangs on how suddenly it lands, which a rigid \
                footing does not tell. Unfiltered, a section has the inertia of the half element \
                below it, too, which members_envelopes.csv has not.",
            significant(hz, 3)
        )
    });
    (!rows.is_empty()).then(|| Section {
        id: "other-forces",
        title: "The same forces with another mesh and on other springs".into(),
        text: vec![
            "The largest magnitude over the same time. A force whose magnitude changes by 5 % or \
                more is withheld."
                .into(),
        ]
        .into_iter()
        .chain(waves)
        .collect(),
        table: Some(Table::new(head).with(rows)),
        ..Section::default()
    })
}

fn springs(run: &Run) -> Table {
    let row = |unit: &super::Unit| {
        let cells = unit.row.numbers().map(|x| significant(x, 5));
        [vec![unit.name.clone()], cells.into()].concat()
    };
    Table::new(["unit", "k1 [N/m]", "k2 [N/m]", "m2 [kg]", "c [N s/m]"])
        .with(run.springs.iter().map(row))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_says_over_how_much_it_holds_or_between_what_it_lies() {
        let held = DesignForce::measured(-4.937e6, 41.0, Some(0.01));
        assert_eq!(force_value(ForceName::Axial, &held), "-4.937 MN");
        let part = DesignForce { over_s: Some(49.42), ..held };
        assert_eq!(force_value(ForceName::Axial, &part), "-4.937 MN (to 49.4 s)");
        let whole = OtherForces { found: -13.6e6, ..OtherForces::default() };
        let part = DesignForce { whole_record: Some(whole), ..part };
        assert_eq!(force_value(ForceName::Axial, &part), "-4.937 MN (to 49.4 s; 13.6 MN over all)");
        let changes = DesignForce::measured(2.48e6, 41.0, Some(0.073));
        assert_eq!(
            force_value(ForceName::AxialTension, &changes),
            "withheld: changes by 7.30 % on springs"
        );
        let others = OtherForces {
            found: 2.48e6,
            doubled_elements: None,
            softer: Some(2.66e6),
            stiffer: Some(2.5e6),
            doubled_cutoff: None,
        };
        let between = DesignForce { others: Some(others), ..changes };
        assert_eq!(
            force_value(ForceName::AxialTension, &between),
            "withheld: 2.48 to 2.66 MN with springs and mesh"
        );
        assert_eq!(
            force_value(ForceName::Axial, &DesignForce { change: None, ..changes }),
            "withheld"
        );
    }
}
