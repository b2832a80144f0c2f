//! `tune bench`: run time against error, our models beside other tools.

use std::{io::Write, path::PathBuf};

use clap::Args;

use super::{CommandError, output::check_folder, write_file};
use crate::{
    bench::{self, Series, report::Measured},
    figures::precision::{self, Precision},
};

/// Options of `tune bench`.
#[derive(Debug, Args)]
pub struct Options {
    /// A few seconds: few rounds, no other program
    #[arg(long)]
    quick: bool,
    /// Python with SciPy and openseespy
    #[arg(long, value_name = "PATH", default_value = "python3")]
    python: PathBuf,
    /// Folder for the table and the figure
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
}

pub fn run(o: &Options) -> Result<(), CommandError> {
    check_folder(&o.out)?;
    let program = std::env::current_exe().map_err(|e| CommandError::Result(format!("bench: {e}")))?;
    let effort = if o.quick { bench::Effort::quick() } else { bench::Effort::full() };
    let measured = bench::measure(&effort, &o.python, &program, &|what| eprintln!("{what}"))?;
    let text = measured.text();
    let write = |e| CommandError::Write { path: o.out.display().to_string(), source: e };
    std::fs::create_dir_all(&o.out).map_err(write)?;
    write_file(&o.out.join("bench.md"), text.as_bytes())?;
    draw(&measured, &o.out.join("work_precision.png"))?;
    write!(std::io::stdout(), "{text}")?;
    eprintln!("written to {}", o.out.display());
    Ok(())
}

/// A tool's name and its (error, time [ms]).
type Drawn = (String, Vec<(f64, f64)>);

fn series(drawn: &[Drawn]) -> Vec<precision::Series<'_>> {
    drawn.iter().map(|(label, points)| precision::Series { label, points }).collect()
}

/// `work_precision.png`: one sheet a model.
fn draw(measured: &Measured, path: &std::path::Path) -> Result<(), CommandError> {
    // what has no finite error, as a history that went wrong, is in the table only; no error at all cannot be drawn
    let points = |series: &Series| -> Vec<(f64, f64)> {
        let drawn = series.points.iter().filter(|p| p.error > 0.0 && p.error.is_finite());
        drawn.map(|p| (p.error, p.seconds * 1e3)).collect()
    };
    let all = |list: &[Series]| -> Vec<Drawn> {
        let named = |s: &Series, drawn: usize| match s.points.len() - drawn {
            0 => s.tool.clone(),
            lost => format!("{} ({lost} in the table only)", s.tool),
        };
        let all = list.iter().map(|s| (s, points(s))).filter(|(_, points)| !points.is_empty());
        all.map(|(s, points)| (named(s, points.len()), points)).collect()
    };
    let (rigid, elements) = (all(&measured.rigid), all(&measured.elements));
    let (rigid, elements) = (series(&rigid), series(&elements));
    let sheets = [
        Precision {
            title: "Housner's equation, 20 s of El Centro: time against error",
            error_label: "largest error of u against float128 [m]",
            time_label: "time [ms]",
            series: &rigid,
        },
        Precision {
            title: "Finite elements on 160 Hz springs, 20 s of El Centro: time against error",
            error_label: "larger NRMSE of u and v",
            time_label: "time [ms]",
            series: &elements,
        },
    ];
    Ok(precision::draw(&sheets)?.save(path)?)
}
