//! Run time against error: our two models and other tools on the same history, in one run
//! (`crates/comparison`).
//!
//! ```sh
//! cargo bench --bench compare -- --quick                       # a few seconds, our own code alone
//! cargo bench --bench compare -- --page docs/benchmarks.md     # everything, some minutes; writes the page anew
//! ```

mod diffsol;

use std::{
    env,
    error::Error,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use clap::Parser;
use comparison::{
    OtherPrograms, draw, measure, page,
    rigid::{RockingProblem, Solver},
};

/// Rounds for what takes less than a millisecond, and for what takes longer: a few seconds in all.
const QUICK: [usize; 2] = [20, 3];
/// The same for a few minutes.
const FULL: [usize; 2] = [400, 40];
/// Tolerances of diffsol.
const LADDER: [f64; 2] = [1e-4, 1e-10];

#[derive(Debug, Parser)]
#[command(name = "compare", about = "Run time against error, beside other tools")]
struct Options {
    /// A few seconds: few rounds, no other program
    #[arg(long)]
    quick: bool,
    /// Python with SciPy and openseespy
    #[arg(long, value_name = "PATH", default_value = "python3")]
    python: PathBuf,
    /// Folder for the table and the figure [default: none]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the documentation's page anew; with --quick what our own code and diffsol do, alone
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Whether the documentation's page has the tables that this program prints
    #[arg(long, value_name = "FILE")]
    check: Option<PathBuf>,
    /// Given by cargo bench
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    // cargo bench runs it in this crate's folder; paths are those of the workspace's
    env::set_current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))?;
    let o = Options::parse();
    let (rounds, programs) = if o.quick {
        (QUICK, None)
    } else {
        (FULL, Some(OtherPrograms { python: o.python, tune: program()? }))
    };
    let solver = Solver {
        tool: "diffsol Tsit45, stopped at every sample",
        ladder: LADDER,
        theta: &|problem: &RockingProblem, rtol| {
            diffsol::DiffsolHistory::of(problem).theta(rtol).ok()
        },
    };
    let measured = measure(rounds, &solver, programs.as_ref(), &|what| eprintln!("{what}"))?;
    let text = measured.text();
    print!("{text}");
    if let Some(out) = &o.out {
        fs::create_dir_all(out)?;
        fs::write(out.join("bench.md"), &text)?;
        draw(&measured, &out.join("work_precision.png"))?;
    }
    if let Some(path) = &o.page {
        fs::write(path, page::page(&text))?;
    }
    if let Some(path) = &o.check {
        page::check(&text, &fs::read_to_string(path)?)?;
        println!("\n{}: all tables are there", path.display());
    }
    Ok(())
}

/// The program, built as users build it, in the folder that this benchmark was built in: Cargo
/// tells where a program is only to tests of its own package.
fn program() -> Result<PathBuf, Box<dyn Error>> {
    let here = env::current_exe()?;
    // DIR/release/deps/compare-...
    let target = here.ancestors().nth(3).ok_or("this benchmark has no folder")?;
    let built = Command::new(env!("CARGO"))
        .args(["build", "--release", "--bin", "tune", "--target-dir"])
        .arg(target)
        .status()?;
    if !built.success() {
        return Err("cargo build --release --bin tune: failed".into());
    }
    Ok(target.join("release").join(format!("tune{}", env::consts::EXE_SUFFIX)))
}
