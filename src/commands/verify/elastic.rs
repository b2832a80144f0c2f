//! `tune verify` of an elastic structure's deck.

use std::{fmt::Write as _, path::Path};

use super::{FORCES, VerifyOptions, peaks_table, scaled, title};
use crate::commands::{CommandError, export::check_accuracy, progress::Progress, terminal};
use decks::verify::{ComparedPeak, DeckRun, Program, VerifyError, number_before, run_deck};
use figures::stack::{self, StackFigure, StackQuantity};
use frames::{
    answer::{Compared, ComparedEnd, ElasticHistories, Reference},
    assembled::{Assembled, Sway, errors},
    fem::ElasticHistory,
    reference::{MOST_WORK, TRIED},
};
use parameters::{elastic::ElasticParameters, predictability::standing_share};
use run_folder::{
    elastic::{
        deck,
        pictures::{of_base, subtitle},
        words,
    },
    folder::Folder,
    place::{check_folder, write_file},
    tables::csv_row,
};
use springs::suite::LOOSER;
use strong_motion::{Record, excitation::Excitation};

/// Largest NRMSE of rotation between OpenSees and our own history, while a change of the motion
/// grows less than 30-fold: OpenSees' steps miss more than ours; of bending, five times that.
const LIMIT: f64 = 0.002;

/// Share of the structure's span, and rotation (rad), below which nothing moves to speak of.
const STILL: f64 = 1e-8;

/// Run the deck beside our own history.
pub fn run(
    o: &VerifyOptions,
    parameters: &ElasticParameters,
    program: &Program,
) -> Result<(), CommandError> {
    let excitation = o.record.checked_excitation(|| parameters.excitation(&o.parameters))?;
    let record = excitation.used()?;
    check_folder(&o.out)?;
    check_accuracy(o.accuracy)?;
    let assembled = parameters.assembled().map_err(CommandError::result)?;
    let springs = parameters.chains();
    let histories = Reference::new(&assembled, &record, TRIED, MOST_WORK)
        .and_then(|reference| ElasticHistories::new(&assembled, &springs, &record, reference))
        .map_err(CommandError::result)?;
    let part = histories.compared(&record, &[]);
    if part.samples < 2 {
        let refusal = "verify: nothing can be compared, the history ends with its first sample; \
            give another record";
        return Err(CommandError::Failed(refusal.into()));
    }
    // what cannot be foretold is not followed: nothing could be judged by it
    let samples = part.samples;
    let ours = ElasticHistory {
        q: histories.fem.q[..samples.min(histories.fem.q.len())].to_vec(),
        ..histories.fem
    };
    let text = deck(&assembled, &springs, &record, (&ours, None), (program.format(), o.accuracy))?;
    let progress = Progress::new("OpenSees [s]", o.quiet);
    let samples = ours.q.len();
    let read = |path: &Path| configurations(&assembled, path, samples);
    let ran = run_deck(
        &text,
        program,
        (samples, record.dt),
        &|done, all| progress.tell(done, all, ""),
        read,
    );
    progress.done();
    let ran = ran?;

    let sways = |all: &[Vec<f64>]| assembled.sways(all.iter().map(Vec::as_slice));
    let (of_ours, of_opensees) = (sways(&ours.q), sways(&ran.motion));
    let [rotation, drift] = errors(&of_ours, &of_opensees, samples);
    // one that only stands turns by what its springs give way
    let rotations = of_ours.iter().flat_map(|sway| &sway.rotation);
    let rotation = rotation * standing_share(rotations, assembled.structure.body().alpha());
    let peaks = peaks(&assembled, &ours.q, &ran.motion);
    let pairs: Vec<[Sway; 2]> =
        of_ours.into_iter().zip(of_opensees).map(|(ours, opensees)| [ours, opensees]).collect();
    let folder =
        Folder::begin(&o.out, "verify", super::FILES, super::of(parameters, &record, o.accuracy))?;
    write_file(&folder.path().join("verify.csv"), csv(&pairs, record.dt).as_bytes())?;
    draw(folder.path(), (&assembled, parameters.omega_n_hz), &excitation, (&pairs, record.dt))?;
    folder.finish()?;

    let said = said((&excitation, &record), &part, &peaks, &ran, [rotation, drift]);
    terminal::stdout(format_args!("{said}"))?;
    terminal::stderr(excitation.line());
    terminal::written(&o.out);
    if within([rotation, drift]) {
        return Ok(());
    }
    let refusal = format!(
        "verify: OpenSees is off by {rotation:.1e} in rotation and {drift:.1e} in bending; ask for \
            finer steps with --accuracy, or stiffer springs"
    );
    Err(CommandError::Failed(refusal))
}

/// Whether OpenSees is as near as is asked, in rotation and bending.
fn within([rotation, drift]: [f64; 2]) -> bool {
    rotation <= LIMIT && drift <= LOOSER * LIMIT
}

/// Peaks first, then errors, for a terminal.
fn said<T>(
    (excitation, record): (&Excitation, &Record),
    part: &Compared,
    peaks: &[ComparedPeak],
    ran: &DeckRun<T>,
    [rotation, drift]: [f64; 2],
) -> String {
    let title = title(excitation, record, part.seconds);
    let mut said = format!(
        "{}\n\nOpenSees took {:.1} s and {} steps\n",
        peaks_table(&title, peaks),
        ran.seconds,
        number_before(&ran.report, " steps")
    );
    let over = match part.end {
        ComparedEnd::Foretold => {
            format!(
                "over its first {:.2} s, in which a change of the motion grows less than \
                    {TRIED}-fold",
                part.seconds
            )
        }
        _ => words::over(part),
    };
    // writing to a String does not fail
    let _ = writeln!(
        said,
        "{}: OpenSees is {} {LIMIT} of our own rotation ({rotation:.1e}) and {} of our bending \
            ({drift:.1e}), NRMSE {over}",
        if within([rotation, drift]) { "AGREES" } else { "DOES NOT AGREE" },
        if within([rotation, drift]) { "within" } else { "NOT within" },
        LOOSER * LIMIT
    );
    let late = number_before(&ran.report, " touches or lifts");
    if late > 0 {
        let _ = writeln!(
            said,
            "WARNING: {late} touches or lifts of a corner within too long a step of OpenSees"
        );
    }
    said + FORCES
}

/// Displacement of the top, uplift of a corner, rotation and displacement by bending; of several
/// bases the largest.
fn peaks(assembled: &Assembled, ours: &[Vec<f64>], opensees: &[Vec<f64>]) -> Vec<ComparedPeak> {
    let frame = &assembled.frame;
    let top = assembled.watched.first().map_or(0, |watched| watched.top);
    let small = STILL * frame.span();
    let at_top =
        |all: &[Vec<f64>]| all.iter().map(|q| frame.displacement(top, q)[0]).collect::<Vec<_>>();
    let highest = |q: &Vec<f64>| {
        frame.places().iter().map(|corner| corner.reach(q).place[1]).fold(0.0, f64::max)
    };
    let uplift = |all: &[Vec<f64>]| all.iter().map(highest).collect::<Vec<_>>();
    let sways = |all: &[Vec<f64>]| assembled.sways(all.iter().map(Vec::as_slice));
    let joined = |all: &[Vec<f64>], of: fn(Sway) -> Vec<f64>| {
        sways(all).into_iter().flat_map(of).collect::<Vec<_>>()
    };
    let of = |quantity, pick: fn(Sway) -> Vec<f64>, least| {
        ComparedPeak::new(quantity, &joined(ours, pick), &joined(opensees, pick), least)
    };
    vec![
        ComparedPeak::new(("top displacement", "m"), &at_top(ours), &at_top(opensees), small),
        ComparedPeak::new(("uplift", "m"), &uplift(ours), &uplift(opensees), small),
        of(("rotation", "rad"), |sway| sway.rotation, STILL),
        of(("displacement by bending", "m"), |sway| sway.drift, small),
    ]
}

/// Coordinates at every sample from the deck's history: t, then x, z, rotation of every node.
fn configurations(
    assembled: &Assembled,
    path: &Path,
    samples: usize,
) -> Result<Vec<Vec<f64>>, VerifyError> {
    let bad = |reason: String| VerifyError::History { path: path.display().to_string(), reason };
    let mut reader = csv::Reader::from_path(path).map_err(|e| bad(e.to_string()))?;
    let nodes = assembled.layout.nodes.len();
    let mut all = Vec::with_capacity(samples);
    for row in reader.deserialize() {
        let row: Vec<f64> = row.map_err(|e| bad(e.to_string()))?;
        if row.len() != 1 + 3 * nodes {
            return Err(bad(format!("{} columns instead of {}", row.len(), 1 + 3 * nodes)));
        }
        // of the coordinates that the frame has
        let mut q = vec![0.0; assembled.frame.mass_matrix().nrows()];
        for node in 0..nodes {
            for (k, at) in assembled.frame.coordinates(node).into_iter().enumerate() {
                if let Some(at) = at {
                    q[at] = row[1 + 3 * node + k];
                }
            }
        }
        all.push(q);
    }
    if all.len() != samples {
        return Err(bad(format!("{} samples instead of {samples}", all.len())));
    }
    Ok(all)
}

/// Our own histories and OpenSees', 12 significant digits.
fn csv(pairs: &[[Sway; 2]], dt: f64) -> String {
    let mut head = vec!["t".to_string()];
    for i in 1..=pairs.len() {
        for model in ["fem", "opensees"] {
            head.extend([format!("theta_{model}_{i}"), format!("drift_{model}_{i}")]);
        }
    }
    let mut out = head.join(",") + "\n";
    for sample in
        0..pairs.first().map_or(0, |pair| pair[0].rotation.len().min(pair[1].rotation.len()))
    {
        let mut row = vec![sample as f64 * dt];
        row.extend(
            pairs.iter().flatten().flat_map(|sway| [sway.rotation[sample], sway.drift[sample]]),
        );
        csv_row(&mut out, &row);
    }
    out
}

fn draw(
    out: &Path,
    (assembled, omega_n_hz): (&Assembled, f64),
    excitation: &Excitation,
    (pairs, dt): (&[[Sway; 2]], f64),
) -> Result<(), CommandError> {
    let n = pairs.first().map_or(0, |pair| pair[0].rotation.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * dt).collect();
    let of = |pick: fn(&Sway) -> &[f64]| -> Vec<[&[f64]; 2]> {
        pairs.iter().map(|[ours, opensees]| [pick(ours), pick(opensees)]).collect()
    };
    let (rotations, drifts) = (of(|sway| &sway.rotation), of(|sway| &sway.drift));
    let names: Vec<[String; 2]> = (0..pairs.len())
        .map(|i| ["rotation", "bending"].map(|what| of_base(what, (i, pairs.len()))))
        .collect();
    let panels: Vec<StackQuantity> = rotations
        .iter()
        .zip(&drifts)
        .zip(&names)
        .flat_map(|((rotation, drift), [turned, bent])| {
            [
                StackQuantity { name: turned, unit: "rad", curves: rotation },
                StackQuantity { name: bent, unit: "m", curves: drift },
            ]
        })
        .collect();
    let title = format!(
        "The exported model in OpenSees\n{}",
        subtitle(&assembled.structure, &scaled(excitation), omega_n_hz)
    );
    let names = ["tune run", "OpenSees"];
    let data = StackFigure { title: &title, t: &t, names: &names, panels: &panels, event: None };
    Ok(stack::draw(&data)?.save(&out.join("verify.png"))?)
}
