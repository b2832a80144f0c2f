//! `tune sweep gather`: tables, figures and a summary from the parts.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{
    super::{CommandError, terminal, write_file},
    figures,
};
use crate::sweep::{
    SweepError,
    compare::Comparison,
    fragility::Fragility,
    ida::Ida,
    manifest::{self, Manifest},
    overturning,
    parts::SweepParts,
    plan::Plan,
    row,
    spec::SweepKind,
    summary,
    table::Table,
};

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
}

/// Histories up to which they are also written as CSV.
const CSV_ROWS: u64 = 20_000;
/// Missing parts that are named.
const NAMED: usize = 20;

pub fn run(o: &GatherOptions) -> Result<(), CommandError> {
    let plan = Plan::read(&o.sweep)?;
    let hash = plan.hash(&mut |_| {})?;
    let folder = o.out.display().to_string();
    match Manifest::there(&o.out)? {
        None => return Err(SweepError::NoSweep { folder }.into()),
        Some(there) if there != hash => return Err(SweepError::OtherSweep { folder, there, here: hash }.into()),
        Some(_) => {}
    }
    let parts = SweepParts { plan: &plan, folder: &o.out, hash: &hash };
    let missing = parts.missing();
    if !missing.is_empty() {
        let names: Vec<String> = missing.iter().take(NAMED).map(|part| part.to_string()).collect();
        let more = if missing.len() > NAMED { ", ..." } else { "" };
        let first = format!("{}{more}", names.join(", "));
        let parts = plan.parts() as usize;
        let error = SweepError::Missing { folder, missing: missing.len(), parts, first };
        if !o.partial || missing.len() == parts {
            return Err(CommandError::Failed(error.to_string()));
        }
        terminal::stderr(format_args!("WARNING: {error}"));
    }
    gather(&parts, !o.no_figures)
}

/// Write everything that follows from the parts, and print the summary.
pub fn gather(parts: &SweepParts, draw: bool) -> Result<(), CommandError> {
    let (plan, out) = (parts.plan, parts.folder);
    let save =
        |name: &str, table: &Table| write_file(&out.join(name), (table.csv_head() + &table.csv_rows()).as_bytes());
    let said = if plan.kind == SweepKind::Overturning {
        let table = whole(parts, &overturning::table(plan, &[]))?;
        save("overturning.csv", &table)?;
        if draw {
            figures::overturning(plan, &table, &out.join("overturning.png"))?;
        }
        summary::overturning(plan, &table)
    } else {
        histories(parts, draw, &save)?
    };
    if parts.missing().is_empty() {
        manifest::tidy(out);
        manifest::tidy(&out.join("parts"));
    }
    let said = said.join("\n") + "\n";
    write_file(&out.join("summary.md"), said.as_bytes())?;
    terminal::stdout(format_args!("{said}"))?;
    terminal::stderr(format_args!("written to {}", terminal::shown(out)));
    Ok(())
}

fn histories(
    parts: &SweepParts,
    draw: bool,
    save: &dyn Fn(&str, &Table) -> Result<(), CommandError>,
) -> Result<Vec<String>, CommandError> {
    let (plan, out) = (parts.plan, parts.folder);
    if plan.cells() <= CSV_ROWS {
        save("histories.csv", &whole(parts, &row::table(plan, &[]))?)?;
    }
    let mut said = vec![summary::head(plan)];
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
        save("ida.csv", &ida.table(plan))?;
        save("fragility.csv", &fragility.table(plan))?;
        if draw {
            figures::ida(plan, &ida, &out.join("ida.png"))?;
            figures::fragility(plan, &fragility, &out.join("fragility.png"))?;
        }
        said.extend(summary::fragility(plan, &fragility));
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
fn whole(parts: &SweepParts, columns: &Table) -> Result<Table, CommandError> {
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
