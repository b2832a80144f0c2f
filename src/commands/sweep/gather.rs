//! `tune sweep gather`: tables, figures and a summary from the parts.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{
    super::{CommandError, terminal},
    figures,
};
use run_folder::{
    FolderError,
    folder::{Folder, identity},
    place::write_file,
};
use sweep::{
    SweepError,
    compare::Comparison,
    fragility::Fragility,
    ida::Ida,
    levels,
    manifest::Manifest,
    overturning,
    parts::{MissingParts, SweepParts},
    plan::{InspectedSweep, Plan},
    row,
    spec::SweepKind,
    springs::SpringsTable,
    summary,
};
use sweep_table::SweepTable;

/// Options of `tune sweep gather`.
#[derive(Debug, Args)]
pub struct GatherOptions {
    /// Sweep file (TOML)
    sweep: PathBuf,
    /// Folder with the parts
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Gather what is there, although parts are missing
    #[arg(long)]
    partial: bool,
    /// No figures
    #[arg(long)]
    no_figures: bool,
    /// As for tune sweep; gathering shows no progress
    #[arg(long = "quiet", hide = true)]
    _quiet: bool,
}

/// All that is gathered.
const FILES: &[&str] = &[
    "summary.md",
    "histories.csv",
    "overturning.csv",
    "overturning.png",
    "overturning.svg",
    "rocking.csv",
    "rocking.png",
    "rocking.svg",
    "ida.csv",
    "ida.png",
    "ida.svg",
    "fragility.csv",
    "fragility.png",
    "fragility.svg",
    "fragility_structures.png",
    "fragility_structures.svg",
    "compare.csv",
    "compare.png",
    "compare.svg",
];

/// Histories up to which they are also written as CSV.
const CSV_ROWS: u64 = 20_000;
/// Missing parts named in the message, at most.
const NAMED: usize = 20;

pub fn run(o: &GatherOptions) -> Result<(), CommandError> {
    let plan = Plan::read(&o.sweep)?;
    let inspected = plan.inspect(&mut |_| {})?;
    let folder = o.out.display().to_string();
    Manifest::new(&plan, &inspected.hash).is_in(&o.out)?;
    let mut parts = SweepParts::new(&plan, &o.out, &inspected.hash);
    let all = plan.parts();
    let MissingParts { parts: missing, unfit } = parts.missing(0..all);
    if !missing.is_empty() {
        let first = few(missing.iter().map(u64::to_string), ", ");
        let unfit = unfit.iter().map(|(part, reason)| format!("the file of part {part} {reason}"));
        let unfit = Some(few(unfit, "; "))
            .filter(|unfit| !unfit.is_empty())
            .map_or(String::new(), |u| format!(": {u}"));
        let error = SweepError::Missing {
            folder,
            missing: missing.len(),
            parts: all as usize,
            first,
            unfit,
        };
        if !o.partial || missing.len() as u64 == all {
            return Err(CommandError::Failed(error.to_string()));
        }
        terminal::stderr(format_args!("WARNING: {error}"));
        parts.gathered =
            Some((0..all).filter(|part| missing.binary_search(part).is_err()).collect());
    }
    gather(&parts, &inspected, !o.no_figures)
}

/// The first of many, in a line.
fn few(all: impl Iterator<Item = String>, between: &str) -> String {
    let mut all: Vec<String> = all.take(NAMED + 1).collect();
    if all.len() > NAMED {
        all[NAMED] = "...".into();
    }
    all.join(between)
}

/// Write everything that follows from the parts, and print the summary.
pub fn gather(
    parts: &SweepParts,
    inspected: &InspectedSweep,
    draw: bool,
) -> Result<(), CommandError> {
    let plan = parts.plan;
    let folder = Folder::begin(
        parts.folder,
        "sweep",
        FILES,
        identity(&[&parts.hash, &parts.gathered, &draw]),
    )?;
    let out = folder.path();
    let save = |name: &str, table: &SweepTable| {
        write_file(&out.join(name), (table.csv_head() + &table.csv_rows()).as_bytes())
    };
    let mut said = if plan.kind == SweepKind::Overturning {
        let table = whole(parts, &overturning::table(plan, &[]))?;
        save("overturning.csv", &table)?;
        if draw {
            figures::overturning(plan, &table, &out.join("overturning.png"))?;
        }
        summary::overturning(plan, &table)
    } else {
        histories(parts, out, draw, &save)?
    };
    said.extend(summary::assumptions(plan, inspected.with_vertical));
    let springs = match plan.model.fem() {
        true => SpringsTable::read(plan, parts.folder, parts.hash)?,
        false => None,
    };
    let missed = springs.map_or(Vec::new(), |springs| springs.missed);
    let checks = missed.iter().chain(&inspected.doubts).map(|doubt| format!("CHECK {doubt}."));
    let said = said.into_iter().chain(checks).collect::<Vec<_>>().join("\n") + "\n";
    write_file(&out.join("summary.md"), said.as_bytes())?;
    folder.finish()?;
    terminal::stdout(format_args!("{said}"))?;
    terminal::written(parts.folder);
    Ok(())
}

fn histories(
    parts: &SweepParts,
    out: &Path,
    draw: bool,
    save: &dyn Fn(&str, &SweepTable) -> Result<(), FolderError>,
) -> Result<Vec<String>, CommandError> {
    let plan = parts.plan;
    if plan.cells() <= CSV_ROWS {
        save("histories.csv", &whole(parts, &row::table(plan, &[]))?)?;
    }
    let mut said = vec![summary::head(plan, parts.gathered_cells())];
    if plan.kind == SweepKind::Rocking {
        let ida = Ida::new(parts)?;
        save("rocking.csv", &ida.table(plan))?;
        if draw {
            figures::rocking(plan, &ida, &out.join("rocking.png"))?;
        }
        said.extend(summary::rocking(plan, &ida));
    }
    if plan.kind == SweepKind::Fragility {
        let (ida, fragility) = (Ida::new(parts)?, Fragility::new(parts)?);
        let mut table = ida.table(plan);
        table.columns.extend(levels::columns(plan, &ida, fragility.half_width()).columns);
        save("ida.csv", &table)?;
        save("fragility.csv", &fragility.table(plan))?;
        if draw {
            figures::ida(plan, &ida, &out.join("ida.png"))?;
            figures::fragility(plan, &fragility, &out.join("fragility.png"))?;
        }
        said.extend(summary::fragility(plan, &fragility, &ida));
    }
    if plan.model.housner() && plan.model.fem() {
        let comparison = Comparison::new(parts)?;
        save("compare.csv", &comparison.table(plan))?;
        if draw {
            figures::compare(&comparison, &out.join("compare.png"))?;
        }
        said.extend(summary::compare(&comparison));
    }
    Ok(said)
}

/// All rows of the parts that are there.
fn whole(parts: &SweepParts, columns: &SweepTable) -> Result<SweepTable, CommandError> {
    let mut all = columns.clone();
    parts.each(columns, |table| {
        all.append(table);
        Ok(())
    })?;
    Ok(all)
}

/// Where a cluster's tasks find what they need, as absolute paths.
pub fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf())
}
