//! `tune run`: the whole job.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use clap::Args;

use super::{
    CommandError,
    common::{Both, RecordOptions, both, history_csv},
    progress::Progress,
    table, write_file,
};
use crate::{
    case::Case,
    figures::{self, FigureError},
    housner,
    parameters::{Parameters, RecordRow},
    response,
    tuning::{
        inner::{Fit, FitError, fit},
        outer::{self, Benchmark, Bracket, Tuned},
    },
};

/// Options of `tune run`.
#[derive(Debug, Args)]
pub struct Options {
    /// Case file (TOML); the paper's A-frame on El Centro unless given
    case: Option<PathBuf>,
    #[command(flatten)]
    record: RecordOptions,
    /// Stiffest springs allowed, Omega_n / 2 pi [default: 160, or the case's]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    max_hz: Option<f64>,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
    /// No figures
    #[arg(long)]
    no_figures: bool,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

pub fn run(o: &Options) -> Result<(), CommandError> {
    let mut case = match &o.case {
        Some(path) => Case::read(path)?,
        None => Case::paper()?,
    };
    case.record = o.record.record(|| case.record.clone())?;
    case.duration_s = o.record.duration(case.duration_s)?;
    if let Some(hz) = o.max_hz {
        if !(0.1..=1e5).contains(&hz) {
            return Err(CommandError::Option {
                option: "max-hz",
                value: hz.to_string(),
                remedy: "give a frequency between 0.1 and 1e5 Hz",
            });
        }
        case.tuning.max_omega_hz = hz;
    }
    threads(o.jobs)?;

    let record = case.record.truncated(case.duration_s);
    let body = case.structure.body::<f64>();
    let options = housner::Options { restitution: Some(case.restitution), ..Default::default() };
    let rocking = housner::solve(&body, record.dt, &record.accel, &options);
    let motion = rocking.motion(&body);
    if rocking.impacts.is_empty() && rocking.uplifts.is_empty() {
        return Err(CommandError::Result(format!(
            "{}: PGA {:.4} g never lifts the structure (it takes {:.4} g), there is nothing to tune on; raise --scale or give another record",
            record.name,
            record.pga_g(),
            body.half_width / body.height
        )));
    }

    let fits = |mus: &[f64]| -> Result<Vec<Fit>, FitError> {
        mus.iter().map(|&mu| fit(mu, &case.target, &case.bounds)).collect()
    };
    let (vertical, horizontal) = (fits(&case.tuning.mass_ratios_vertical)?, fits(&case.tuning.mass_ratios_horizontal)?);
    let benchmark = Benchmark { body, dt: record.dt, accel: &record.accel, housner: &motion };
    let bracket = Bracket { max_hz: case.tuning.max_omega_hz, max_settlement: case.tuning.max_settlement_m };
    let progress = Progress::new("tuning Omega_n", o.quiet);
    let tuned =
        outer::tune(&benchmark, &vertical, &horizontal, bracket, case.tuning.candidates, &|done, all, error| {
            progress.tell(done, all, &format!("error {error:.4}"));
        });
    progress.done();
    let tuned = tuned.ok_or_else(|| {
        CommandError::Result(
            "no candidate followed the record to its end; raise --max-hz or shorten --duration".to_string(),
        )
    })?;

    let mut parameters = Parameters::new(case.structure, &tuned.best.springs);
    let both = both(&body, case.restitution, &parameters.chains(), &record);
    parameters.record = Some(RecordRow::new(&case.record));
    parameters.matched = Some(both.matched);

    let write = |e| CommandError::Write { path: o.out.display().to_string(), source: e };
    std::fs::create_dir_all(&o.out).map_err(write)?;
    write_file(&o.out.join("parameters.json"), parameters.to_json().as_bytes())?;
    write_file(&o.out.join("parameters.md"), table::markdown(&parameters).as_bytes())?;
    write_file(&o.out.join("history.csv"), history_csv(record.dt, &both.housner, &both.fem.motion).as_bytes())?;
    if !o.no_figures {
        let chosen = |list: &[Fit], mu: f64| list.iter().find(|f| f.mu == mu).cloned();
        let springs = &tuned.best.springs;
        let chains: Vec<(&str, Fit)> = [
            ("vertical", chosen(&vertical, springs.vertical.mu)),
            ("horizontal", chosen(&horizontal, springs.horizontal.mu)),
        ]
        .into_iter()
        .filter_map(|(name, fit)| fit.map(|fit| (name, fit)))
        .collect();
        draw(&o.out, &case, record.dt, &both, &tuned, &chains)?;
    }
    write!(std::io::stdout(), "{}", table::terminal(&parameters))?;
    eprintln!("written to {}", o.out.display());
    Ok(())
}

/// Use this many threads, 0 or none: all cores.
fn threads(jobs: Option<usize>) -> Result<(), CommandError> {
    if let Some(n) = jobs {
        rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build_global()
            .map_err(|e| CommandError::Result(format!("--jobs {n}: {e}; give a smaller number of threads")))?;
    }
    Ok(())
}

/// All figures, side by side.
fn draw(
    dir: &Path,
    case: &Case,
    dt: f64,
    both: &Both,
    tuned: &Tuned,
    chains: &[(&str, Fit)],
) -> Result<(), CommandError> {
    let (housner, fem) = (&both.housner, &both.fem);
    let n = housner.len().min(fem.motion.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * dt).collect();
    let title = |what: &str| format!("{what}: {}", case.record.name);

    let history = |path: &Path| {
        let impacts_housner: Vec<f64> = both.rocking.impacts.iter().map(|i| i.time).collect();
        let impacts_fem: Vec<f64> = fem.landings.iter().filter(|l| l.impact).map(|l| l.time).collect();
        figures::history::render(
            &figures::history::History {
                title: &title("Apex displacement"),
                t: &t,
                reference: figures::history::Trace {
                    label: "Housner",
                    u: &housner.u[..n],
                    v: &housner.v[..n],
                    impacts: &impacts_housner,
                },
                others: &[figures::history::Trace {
                    label: "finite elements on ground springs",
                    u: &fem.motion.u[..n],
                    v: &fem.motion.v[..n],
                    impacts: &impacts_fem,
                }],
                differences: false,
            },
            path,
        )
    };
    let arr = |path: &Path| {
        let g: Vec<f64> = (0..=600).map(|i| 0.02 * f64::powf(1000.0, i as f64 / 600.0)).collect();
        let curves: Vec<_> = chains
            .iter()
            .map(|(name, fit)| {
                let arr: Vec<f64> = g.iter().map(|&g| response::arr(g, fit.mu, fit.f, fit.xi)).collect();
                let active: Vec<_> = fit
                    .certificate
                    .active
                    .iter()
                    .filter(|a| a.g.is_finite())
                    .map(|a| figures::arr::Active { g: a.g, arr: a.arr, multiplier: None })
                    .collect();
                (format!("{name}, mu = {}", fit.mu), arr, active)
            })
            .collect();
        let curves: Vec<_> =
            curves.iter().map(|(label, arr, active)| figures::arr::Curve { label, g: &g, arr, active }).collect();
        figures::arr::render(
            &figures::arr::Response { title: "Frequency response of the ground springs", target: &[], curves: &curves },
            path,
        )
    };
    let candidates = |path: &Path| {
        let candidates: Vec<_> = tuned
            .candidates
            .iter()
            .map(|c| figures::candidates::Candidate {
                vertical_hz: c.springs.vertical.omega_n_hz,
                horizontal_hz: c.springs.horizontal.omega_n_hz,
                error: c.error,
                abandoned: c.abandoned,
            })
            .collect();
        figures::candidates::render(
            &figures::candidates::Candidates {
                title: &title("Error of every candidate"),
                error_label: "NRMSE of u and v",
                candidates: &candidates,
                chosen: Some(tuned.chosen),
            },
            path,
        )
    };
    let contact = |path: &Path| {
        let f = &fem.forces;
        figures::contact::render(
            &figures::contact::Contact {
                title: &title("Forces on the feet"),
                t: &t,
                left_vertical: &f.vertical[0][..n],
                right_vertical: &f.vertical[1][..n],
                left_horizontal: &f.horizontal[0][..n],
                right_horizontal: &f.horizontal[1][..n],
                weight: Some(case.structure.mass_kg * crate::scalar::GRAVITY),
            },
            path,
        )
    };
    let energy = |path: &Path| {
        let a = &fem.account;
        figures::energy::render(
            &figures::energy::Energy {
                title: &title("Energy account"),
                t: &t,
                input: &a.input[..n],
                stored: &a.stored[..n],
                dissipated: &a.dissipated[..n],
                residual: &a.residual[..n],
            },
            path,
        )
    };
    type Draw<'a> = (&'a str, &'a (dyn Fn(&Path) -> Result<(), FigureError> + Sync));
    let all: [Draw; 5] = [
        ("history.png", &history),
        ("response.png", &arr),
        ("candidates.png", &candidates),
        ("contact.png", &contact),
        ("energy.png", &energy),
    ];
    use rayon::prelude::*;
    all.par_iter().map(|(name, draw)| draw(&dir.join(name))).collect::<Result<(), FigureError>>()?;
    Ok(())
}
