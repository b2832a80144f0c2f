//! `tune chart`: the design from the geometry, to be read off.

use std::{
    fmt::Write as _,
    path::{Path, PathBuf},
};

use clap::Args;

use super::{CommandError, terminal};
use dynamics::spring::{Design, Springs};
use landing::design::Geometry;
use run_folder::{folder::Folder, folder::identity, place::check_folder, place::write_file};

/// Options of `tune chart`.
#[derive(Debug, Args)]
pub struct ChartOptions {
    /// Slenderness alpha = atan(width / (2 height)) (rad), several with commas
    #[arg(long, value_name = "RAD", value_delimiter = ',',
        default_values_t = [0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5])]
    alpha: Vec<f64>,
    /// Folder for chart.csv, chart.png and chart.svg
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
}

/// m R^2/I0 of an A-frame with all mass at its apex and of a solid block.
const KINDS: [(&str, f64); 2] = [("aframe", 1.0), ("block", 0.75)];
/// Omega_n/p of the chart, a decade in ten steps: from where landings hold.
const DECADES: (i32, i32) = (30, 60);

/// One row of the chart.
struct ChartRow {
    kind: usize,
    geometry: Geometry,
    springs: Springs<Design<f64>>,
}

pub fn run(o: &ChartOptions) -> Result<(), CommandError> {
    check_folder(&o.out)?;
    let mut all = Vec::new();
    for (kind, (_, share)) in KINDS.into_iter().enumerate() {
        for &alpha in &o.alpha {
            for i in DECADES.0..=DECADES.1 {
                let geometry = Geometry::new(alpha, share, 10f64.powf(f64::from(i) / 10.0))?;
                if geometry.landings_hold() {
                    all.push((kind, geometry));
                }
            }
        }
    }
    let rows = parallel::map(&all, |&(kind, geometry)| ChartRow {
        kind,
        geometry,
        springs: geometry.springs(),
    });
    let folder = Folder::begin(
        &o.out,
        "chart",
        &["chart.csv", "chart.png", "chart.svg"],
        identity(&[&o.alpha]),
    )?;
    write_file(&folder.path().join("chart.csv"), csv(&rows).as_bytes())?;
    draw(folder.path(), &rows)?;
    folder.finish()?;
    terminal::stdout(format_args!(
        "{} designs: alpha {:?}, Omega_n/p 1e3 to 1e6; horizontal units: mu 0.3, f 1.8257, xi \
         3.3333\n",
        rows.len(),
        o.alpha
    ))?;
    terminal::written(&o.out);
    Ok(())
}

/// One row a design.
fn csv(rows: &[ChartRow]) -> String {
    let mut out = String::from(
        "kind,alpha,mass_share,omega_n_over_p,k,mu_vertical,f_vertical,xi_vertical,\
            mu_horizontal,f_horizontal,xi_horizontal,omega_h_over_omega_v\n",
    );
    for ChartRow { kind, geometry: g, springs: Springs { vertical: v, horizontal: h } } in rows {
        // writing to a String cannot fail
        let _ = writeln!(
            out,
            "{},{},{},{:.6e},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6}",
            KINDS[*kind].0,
            g.alpha(),
            g.mass_share(),
            g.stiffness(),
            v.k(),
            v.mu,
            v.f,
            v.xi,
            h.mu,
            h.f,
            h.xi,
            h.omega_n_hz / v.omega_n_hz
        );
    }
    out
}

fn draw(out: &Path, rows: &[ChartRow]) -> Result<(), CommandError> {
    type Pick = fn(&Springs<Design<f64>>) -> f64;
    let picks: [Pick; 4] = [
        |s| s.vertical.mu,
        |s| s.vertical.f,
        |s| s.vertical.xi,
        |s| s.horizontal.omega_n_hz / s.vertical.omega_n_hz,
    ];
    // alpha, dashed, Omega_n/p, the values of each panel
    type SlendernessColumn = (f64, bool, Vec<f64>, [Vec<f64>; 4]);
    let columns: Vec<SlendernessColumn> = rows
        .chunk_by(|a, b| a.kind == b.kind && a.geometry.alpha() == b.geometry.alpha())
        .map(|rows| {
            let x = rows.iter().map(|row| row.geometry.stiffness()).collect();
            let values = picks.map(|pick| rows.iter().map(|row| pick(&row.springs)).collect());
            (rows[0].geometry.alpha(), rows[0].kind == 1, x, values)
        })
        .collect();
    let curves: Vec<figures::chart::ChartCurve> = columns
        .iter()
        .map(|(alpha, dashed, x, values)| figures::chart::ChartCurve {
            alpha: *alpha,
            dashed: *dashed,
            omega_n_over_p: x,
            values: [&values[0], &values[1], &values[2], &values[3]],
        })
        .collect();
    figures::chart::draw(&figures::chart::ChartFigure {
        title: "Ground springs from the geometry; horizontal: μ 0.3, f 1.826, ξ 3.333",
        panels: ["vertical μ", "vertical f", "vertical ξ", "horizontal over vertical Ωₙ"],
        kinds: ["A-frame", "solid block"],
        curves: &curves,
    })?
    .save(&out.join("chart.png"))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use landing::design::GeometryError;

    #[test]
    fn a_row_holds_the_design() -> Result<(), GeometryError> {
        let geometry = Geometry::new(0.1, 1.0, 2e4)?;
        let springs = geometry.springs();
        let text = csv(&[ChartRow { kind: 0, geometry, springs }]);
        let numbers: Vec<f64> = text
            .lines()
            .nth(1)
            .unwrap_or("")
            .split(',')
            .skip(1)
            .map(|x| x.parse().unwrap())
            .collect();
        assert_eq!(text.lines().next().unwrap().split(',').count(), numbers.len() + 1);
        assert!(
            (numbers[4] - springs.vertical.mu).abs() < 1e-6
                && (numbers[5] - springs.vertical.f).abs() < 1e-6
        );
        Ok(())
    }
}
