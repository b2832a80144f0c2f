//! Every figure from closed forms: its size, its ink, its bytes, and what it refuses.

#[cfg(feature = "png")]
use std::path::PathBuf;

use super::*;

mod demo;

use demo::FIGURES;

/// Where to draw: a folder of one's own choice, to look at, or one that goes away.
#[cfg(feature = "png")]
fn folder() -> (Option<tempfile::TempDir>, PathBuf) {
    match std::env::var_os("GROUNDSPRING_FIGURES") {
        Some(folder) => (None, folder.into()),
        None => {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().to_path_buf();
            (Some(folder), path)
        }
    }
}

#[cfg(feature = "png")]
#[test]
fn every_figure_has_its_size_and_ink_on_white() {
    let (_keep, folder) = folder();
    for (name, draw) in FIGURES {
        let path = folder.join(format!("{name}.png"));
        let sheet = draw().unwrap();
        sheet.save(&path).unwrap();
        let ((width, height), pixels) = pixels::read(&path);
        // a page shows it 1600 wide; neither a strip nor a scroll
        assert!(width == 1600 && (400..=2400).contains(&height), "{name}: {width} x {height}");
        let svg = std::fs::read_to_string(path.with_extension("svg")).unwrap();
        assert!(svg.contains(&format!(" width=\"{width}\" height=\"{height}\" ")), "{name}");
        let white = pixels.iter().filter(|pixel| **pixel == [255; 3]).count() as f64;
        let share = white / pixels.len() as f64;
        assert!((0.5..0.97).contains(&share), "{name}: {share} of the picture is white");
        // The first series' colour is there, so curves were drawn and not only axes.
        let curve = if name == "overturning" {
            // four fifths of it
            [221, 126, 51]
        } else if matches!(name, "candidates" | "contact" | "energy") {
            [0, 114, 178]
        } else {
            [213, 94, 0]
        };
        let drawn = pixels.iter().filter(|pixel| **pixel == curve).count();
        assert!(drawn > 500, "{name}: {drawn} pixels of its curve");
        let mut edge = pixels.chunks(width as usize).enumerate().flat_map(|(y, row)| {
            let whole = y < 3 || y + 3 >= height as usize;
            let sides = move |&(x, _): &(usize, _)| whole || !(3..1597).contains(&x);
            row.iter().enumerate().filter(sides)
        });
        assert!(edge.all(|(_, pixel)| *pixel == [255; 3]), "{name}: something is cut at the edge");
    }
}

#[cfg(feature = "png")]
#[test]
fn the_same_numbers_give_the_same_bytes_on_any_thread() {
    let folder = tempfile::tempdir().unwrap();
    let draw = |turn: &str| -> Vec<Vec<u8>> {
        std::thread::scope(|scope| {
            let running = FIGURES.map(|(name, draw)| {
                let path = folder.path().join(format!("{name}{turn}.png"));
                scope.spawn(move || {
                    draw().unwrap().save(&path).unwrap();
                    [
                        std::fs::read(&path).unwrap(),
                        std::fs::read(path.with_extension("svg")).unwrap(),
                    ]
                    .concat()
                })
            });
            running.into_iter().map(|thread| thread.join().unwrap()).collect()
        })
    };
    assert_eq!(draw("1"), draw("2"));
}

#[test]
fn a_missing_folder_is_an_error_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for (_, draw) in FIGURES {
        let error =
            draw().unwrap().save(&folder.path().join("missing").join("figure.png")).unwrap_err();
        assert!(matches!(error, FigureError::Write { .. }));
        assert_eq!(error.to_string().lines().count(), 1);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn empty_or_unequal_or_not_finite_numbers_are_errors() {
    let t = [0.0, 1.0, 2.0];
    let good = history::Trace {
        label: "Housner",
        u: &[0.0, 1.0, 0.5],
        v: &[0.0, 0.1, 0.0],
        ..history::Trace::default()
    };
    let with =
        |t, reference| history::HistoryFigure { t, reference, ..history::HistoryFigure::default() };
    let told = |data: &history::HistoryFigure<'_>| history::draw(data).unwrap_err().to_string();
    assert_eq!(
        told(&with(&t, history::Trace { u: &[0.0, f64::NAN, 0.5], ..good })),
        "figure history: u of Housner[1] is NaN, which cannot be drawn; remove it or mend what \
         computed it"
    );
    assert_eq!(
        told(&with(&t, history::Trace { v: &[0.0], ..good })),
        "figure history: v of Housner has 1 values where 3 are wanted; give slices of one length"
    );
    assert_eq!(
        told(&with(&[], good)),
        "figure history: t is empty; give at least 2 values or leave the figure out"
    );
    let empty: [Result<Sheet, FigureError>; 6] = [
        arr::draw(&arr::ResponseFigure { title: "", target: &[], curves: &[] }),
        candidates::draw(&candidates::CandidatesFigure::default()),
        front::draw(&front_of(&[])),
        energy::draw(&energy::EnergyFigure::default()),
        validation::draw(&validation::ValidationFigure::default()),
        precision::draw(&[precision::PrecisionFigure::default()]),
    ];
    for result in empty {
        assert!(matches!(result, Err(FigureError::Empty { .. })));
    }
    let points = precision::ToolSeries { label: "tool", points: &[(1e-3, 0.0)] };
    let data =
        precision::PrecisionFigure { series: &[points], ..precision::PrecisionFigure::default() };
    assert!(matches!(precision::draw(&[data]), Err(FigureError::NotFinite { index: 1, .. })));
}

/// Histories that never move, a single record, one candidate: unusual, but not wrong.
#[test]
fn the_least_data_still_makes_a_picture() {
    let (t, still) = ([0.0, 1.0], [0.0, 0.0]);
    let trace =
        history::Trace { label: "Housner", u: &still, v: &still, ..history::Trace::default() };
    let data = history::HistoryFigure {
        t: &t,
        reference: trace,
        others: &[trace],
        differences: true,
        ..history::HistoryFigure::default()
    };
    history::draw(&data).unwrap();
    let data = contact::ContactFigure {
        t: &t,
        left_vertical: &still,
        right_vertical: &still,
        left_horizontal: &still,
        right_horizontal: &still,
        ..contact::ContactFigure::default()
    };
    contact::draw(&data).unwrap();
    let data = energy::EnergyFigure {
        t: &t,
        input: &still,
        stored: &still,
        dissipated: &still,
        residual: &still,
        ..energy::EnergyFigure::default()
    };
    energy::draw(&data).unwrap();
    let one = candidates::CandidateMark {
        vertical_hz: 20.0,
        horizontal_hz: 30.0,
        error: f64::INFINITY,
        abandoned: false,
    };
    let data = candidates::CandidatesFigure {
        candidates: &[one],
        chosen: Some(0),
        ..candidates::CandidatesFigure::default()
    };
    candidates::draw(&data).unwrap();
    let row = validation::ValidationPoint {
        peak_housner: 0.0,
        peak_fem: f64::INFINITY,
        overturned_housner: false,
        overturned_fem: true,
        sensitivity: f64::INFINITY,
        nrmse: 0.0,
    };
    let data = validation::ValidationFigure {
        title: "",
        rows: &[row],
        ks_distance: 1.0,
        well_conditioned: 10.0,
    };
    validation::draw(&data).unwrap();
    let series = front::DesignSeries { label: "", omega_n_hz: &[160.0], error: &[0.0] };
    front::draw(&front_of(&[series])).unwrap();
}

/// A front of these errors.
fn front_of<'a>(series: &'a [front::DesignSeries<'a>]) -> front::FrontFigure<'a> {
    let cost = front::Cost { label: "", omega_n_hz: &[160.0], value: &[14.0] };
    front::FrontFigure {
        title: "",
        error_label: "",
        series,
        chosen_hz: 160.0,
        accuracy: 0.002,
        costs: [cost; 2],
        notes: &[],
    }
}
