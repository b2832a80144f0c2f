//! `tune response`: the inner fit of one mass ratio and its certificate.

use std::{io::Write, path::PathBuf};

use clap::Args;

use super::CommandError;
use crate::{
    case::Case,
    response::{bounds::Bounds, target::Target},
    tuning::arr::inner::fit,
};

/// Options of `tune response`.
#[derive(Debug, Args)]
pub struct ResponseOptions {
    /// Target shape and bounds; the flat cap unless given
    case: Option<PathBuf>,
    /// Mass ratio m2/m1
    #[arg(long, allow_negative_numbers = true)]
    mu: f64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub fn run(o: &ResponseOptions) -> Result<(), CommandError> {
    let (target, bounds) = match &o.case {
        Some(path) => {
            let case = Case::read(path)?;
            (case.target, case.bounds)
        }
        None => (Target::default(), Bounds::default()),
    };
    let fit = fit(o.mu, &target, &bounds)?;
    let mut out = std::io::stdout().lock();
    if o.json {
        let text = serde_json::to_string_pretty(&fit).map_err(|e| CommandError::Result(e.to_string()))?;
        writeln!(out, "{text}")?;
        return Ok(());
    }
    writeln!(out, "mu       {:.6}", fit.mu)?;
    writeln!(out, "f        {:.6}", fit.f)?;
    writeln!(out, "xi       {:.6}", fit.xi)?;
    writeln!(out, "K        {:.6}   = mu f^2 = k2/k1", fit.k)?;
    writeln!(out, "C        {:.6}   = 2 mu xi = c/(m1 Omega_n)", fit.c)?;
    writeln!(out, "peak     {:.6}   at g = {:.6}", fit.peak, fit.peak_g)?;
    writeln!(out, "ARR(0)   {:.6}   = 1 + 1/K", fit.arr_at_zero)?;
    let certificate = &fit.certificate;
    writeln!(
        out,
        "certificate: KKT residual {:.1e}, {}",
        certificate.residual,
        if certificate.holds() { "optimal" } else { "NOT proven optimal" }
    )?;
    for a in &certificate.active {
        writeln!(out, "  active g {:.6}, ARR {:.6}, multiplier {:.6}", a.g, a.arr, a.multiplier)?;
    }
    for b in &certificate.bounds {
        writeln!(out, "  active bound {}, multiplier {:.6}", b.bound, b.multiplier)?;
    }
    Ok(())
}
