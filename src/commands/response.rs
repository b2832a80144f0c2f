//! `tune response`: the inner fit of one mass ratio and its certificate.

use std::{fmt::Write, path::PathBuf};

use clap::Args;

use super::{CommandError, terminal};
use cases::Case;
use frequency_response::{
    bounds::Bounds,
    inner::{Fit, fit},
    target::Target,
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
    if o.json {
        return terminal::json(&fit);
    }
    terminal::stdout(table(&fit))
}

fn table(fit: &Fit) -> String {
    let mut out = String::new();
    // writing to a String cannot fail
    let _ = writeln!(out, "mu       {:.6}", fit.mu);
    let _ = writeln!(out, "f        {:.6}", fit.f);
    let _ = writeln!(out, "xi       {:.6}", fit.xi);
    let _ = writeln!(out, "K        {:.6}   = mu f^2 = k2/k1", fit.k);
    let _ = writeln!(out, "C        {:.6}   = 2 mu xi = c/(m1 Omega_n)", fit.c);
    let _ = writeln!(out, "peak     {:.6}   at g = {:.6}", fit.peak, fit.peak_g);
    let _ = writeln!(out, "ARR(0)   {:.6}   = 1 + 1/K", fit.arr_at_zero);
    let certificate = &fit.certificate;
    let _ = writeln!(
        out,
        "certificate: KKT residual {:.1e}, {}",
        certificate.residual,
        if certificate.holds() { "optimal" } else { "NOT proven optimal" }
    );
    for a in &certificate.active {
        let _ = writeln!(
            out,
            "  active g {:.6}, ARR {:.6}, multiplier {:.6}",
            a.g, a.arr, a.multiplier
        );
    }
    for b in &certificate.bounds {
        let _ = writeln!(out, "  active bound {}, multiplier {:.6}", b.bound, b.multiplier);
    }
    out
}
