//! Which curve is which.

use super::paper::{Hold, Paper, SMALL};
use crate::colour::CURVES;
use crate::text;
use brazilnut_base::figure::{Curve, Style};

/// Height of one entry, px.
pub(crate) const ROW: f64 = 18.0;
/// Width of the sample beside the text, px.
const SAMPLE: f64 = 26.0;
/// Between sample and text, and between entries, px.
const GAP: f64 = 7.0;

/// Colour of curve `k`; they repeat.
pub(crate) fn colour(k: usize) -> &'static str {
    CURVES[k % CURVES.len()]
}

/// Dashes of curve `k`: those that share their colour with an earlier one are dotted.
pub(crate) fn dashes(k: usize, style: Style) -> &'static str {
    match style {
        Style::Dashed => " stroke-dasharray=\"6 4\"",
        _ if k >= CURVES.len() => " stroke-dasharray=\"1.5 3\"",
        _ => "",
    }
}

/// Size of the legend as a column, px.
pub(crate) fn column_size(curves: &[Curve]) -> [f64; 2] {
    [curves.iter().map(|c| entry_width(&c.label)).fold(0.0, f64::max), ROW * curves.len() as f64]
}

/// Draws the legend as a column with its upper left corner at `at`.
pub(crate) fn column(paper: &mut Paper, curves: &[Curve], at: [f64; 2]) {
    let [w, h] = column_size(curves);
    let [x, y] = at;
    paper.put(format_args!(
        "<rect class=\"legend\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"3\"/>",
        x - 5.0,
        y - 3.0,
        w + 10.0,
        h + 6.0
    ));
    for (k, curve) in curves.iter().enumerate() {
        entry(paper, k, curve, [x, y + ROW * k as f64]);
    }
}

/// Places of the entries set in rows of at most `limit` px, and the height of all rows.
pub(crate) fn rows(curves: &[Curve], limit: f64) -> (Vec<[f64; 2]>, f64) {
    let (mut x, mut y) = (0.0, 0.0);
    let mut places = vec![];
    for curve in curves {
        let w = entry_width(&curve.label);
        if x > 0.0 && x + w > limit {
            (x, y) = (0.0, y + ROW);
        }
        places.push([x, y]);
        x += w + 2.0 * GAP;
    }
    (places, y + ROW)
}

/// One entry: a sample of the curve, then its label.
pub(crate) fn entry(paper: &mut Paper, k: usize, curve: &Curve, at: [f64; 2]) {
    let (x, y, c) = (at[0], at[1] + 0.5 * ROW, colour(k));
    paper.put(format_args!("<g class=\"data\">"));
    match curve.style {
        Style::Points => marker(paper, k, [x + 0.5 * SAMPLE, y]),
        style => {
            let dash = dashes(k, style);
            let to = x + SAMPLE;
            paper.put(format_args!(
                "<path fill=\"none\" stroke=\"{c}\" stroke-width=\"1.8\"{dash} d=\"M{x:.1} {y:.1}L{to:.1} {y:.1}\"/>"
            ));
        }
    }
    paper.put(format_args!("</g>"));
    paper.text(x + SAMPLE + GAP, y + 4.2, SMALL, Hold::Start, &curve.label);
}

/// The mark of points of curve `k`: shapes differ, for print without colour.
pub(crate) fn marker(paper: &mut Paper, k: usize, [x, y]: [f64; 2]) {
    let c = colour(k);
    let d = match k % 4 {
        0 => {
            return paper.put(format_args!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.4\" fill=\"{c}\" fill-opacity=\".85\"/>"
            ));
        }
        1 => "m-3.2 -3.2h6.4v6.4h-6.4z",
        2 => "m0 -4.2l4 7h-8z",
        _ => "m0 -4.4l4.4 4.4l-4.4 4.4l-4.4 -4.4z",
    };
    paper.put(format_args!("<path fill=\"{c}\" fill-opacity=\".85\" d=\"M{x:.1} {y:.1}{d}\"/>"));
}

fn entry_width(label: &str) -> f64 {
    SAMPLE + GAP + text::width(label, SMALL)
}
