use super::*;

/// What is drawn where the reference topples to 10 m and two others sway by 0.1 m and 0.2 m.
fn toppling(behind: bool) -> Sheet {
    let t: Vec<f64> = (0..2001).map(|i| 0.01 * f64::from(i)).collect();
    let sway = |size: f64| t.iter().map(|t| size * (3.0 * t).sin()).collect::<Vec<f64>>();
    let falls: Vec<f64> = t.iter().take(1000).map(|t| -10.0 * (t / 10.0).powi(4)).collect();
    let (one, other) = (sway(0.1), sway(0.2));
    let trace = |label, u| Trace { label, u, v: u, ..Trace::default() };
    draw(&HistoryFigure {
        title: "Toppling",
        t: &t,
        reference: Trace { behind, ..trace("Housner", &falls) },
        others: &[trace("one", &one), trace("other", &other)],
        differences: !behind,
        ..HistoryFigure::default()
    })
    .unwrap()
}

/// Axes are of those that are compared, and what lies behind is cut within their size beyond them.
#[test]
fn what_lies_behind_does_not_scale_the_axes() {
    let heights =
        |behind: bool| toppling(behind).plots.iter().map(|plot| plot.y).collect::<Vec<_>>();
    let [u, v] = heights(true)[..] else { panic!("two panels") };
    for [low, high] in [u, v] {
        assert!((-700.0..=-200.0).contains(&low) && (200.0..=400.0).contains(&high));
    }
    assert!(heights(false)[0][0] < -10_000.0);
}

/// Labels of the vertical axes stand on the sheet, and numbers of six letters beside them.
#[cfg(feature = "png")]
#[test]
fn labels_are_not_cut_at_the_edge_of_the_sheet() {
    use crate::shape::{Shape, TextLine};
    let sheet = toppling(false);
    let texts = || {
        sheet.shapes.iter().filter_map(|shape| match shape {
            Shape::Text(TextLine { text, at, how }) => Some((text, at.0, how)),
            _ => None,
        })
    };
    let labels: Vec<_> = texts().filter(|(_, _, how)| how.upwards).collect();
    assert_eq!(labels.len(), 3);
    let right = labels.iter().map(|(_, x, how)| x + 0.5 * how.size).fold(0.0, f64::max);
    for (text, x, how) in labels {
        assert!(x >= how.size, "{text} at {x}");
    }
    let number = texts().find(|(text, ..)| text.ends_with("10000")).unwrap();
    let (text, x, how) = number;
    assert!(x - how.length(text) > right, "{text} at {x}, labels to {right}");
}

/// A line at that time in every panel of displacements, none where the figure ends before.
#[test]
fn up_to_when_histories_can_be_foretold_is_marked() {
    let t: Vec<f64> = (0..2001).map(|i| 0.01 * f64::from(i)).collect();
    let sway: Vec<f64> = t.iter().map(|t| 0.1 * (3.0 * t).sin()).collect();
    let reference = Trace { label: "Housner", u: &sway, v: &sway, ..Trace::default() };
    let marks = |time: f64| -> Vec<Vec<(f64, String)>> {
        let foretold = Some(EventMark { time, text: "predictable to there" });
        let data = HistoryFigure { t: &t, reference, foretold, ..HistoryFigure::default() };
        draw(&data).unwrap().plots.into_iter().map(|plot| plot.events).collect()
    };
    let mark = vec![(7.3, "predictable to there".to_string())];
    assert_eq!(marks(7.3), [mark.clone(), mark]);
    assert_eq!(marks(25.0), [Vec::new(), Vec::new()]);
}
