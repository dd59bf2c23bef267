//! Curves over a common axis.

use super::axis::{Fit, Scale};
use super::legend;
use super::paper::{Hold, LABEL, Paper, SMALL, TITLE, path};
use super::{HEIGHT, WIDTH};
use crate::text;
use brazilnut_base::figure::{Axis, Curve, Style};
use std::ops::Range;

/// Where the axes cross the paper, px.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

pub(super) fn draw(title: &str, x: &Axis, y: &Axis, curves: &[Curve]) -> String {
    let (xs, ys) = extents(x, y, curves);
    let mut sx = Scale::new(x, xs.start, xs.end, Fit::Tight, 7);
    let mut sy = Scale::new(y, ys.start, ys.end, Fit::Roomy, 6);
    // One curve that says what the axis says needs no legend.
    let told = |c: &Curve| c.label.is_empty() || c.label == y.label;
    let shown = if curves.len() < 2 && curves.iter().all(told) { &[] } else { curves };

    let mut paper = Paper::new(WIDTH, HEIGHT, title);
    let mut top = heading(&mut paper, title);
    let mut panel = Panel {
        left: 22.0 + sy.label_width(SMALL) + LABEL + 6.0,
        right: WIDTH - 18.0,
        top,
        bottom: HEIGHT - 50.0,
    };
    (sx.place, sy.place) = ([panel.left, panel.right], [panel.bottom, panel.top]);
    let corner = free_corner(shown, &sx, &sy, panel);
    if !shown.is_empty() && corner.is_none() {
        let (places, height) = legend::rows(shown, panel.right - panel.left);
        for (k, (curve, at)) in shown.iter().zip(&places).enumerate() {
            legend::entry(&mut paper, k, curve, [panel.left + at[0], top + at[1] - 4.0]);
        }
        top += height;
        panel.top = top;
        sy.place = [panel.bottom, panel.top];
    }
    axes(&mut paper, &sx, &sy, panel);
    paper.clip(panel.left, panel.top - 1.0, panel.right - panel.left + 1.0, panel.bottom - panel.top + 2.0);
    curves.iter().enumerate().for_each(|(k, c)| error(&mut paper, k, c, &sx, &sy));
    curves.iter().enumerate().for_each(|(k, c)| curve(&mut paper, k, c, &sx, &sy));
    paper.unclip();
    if let Some(at) = corner {
        legend::column(&mut paper, shown, at);
    }
    paper.finish()
}

/// Writes the title; returns where the space below it starts, px.
pub(crate) fn heading(paper: &mut Paper, title: &str) -> f64 {
    let mut y = 12.0;
    for line in text::wrap(title, TITLE, WIDTH - 40.0).iter().take(2) {
        y += TITLE + 3.0;
        paper.bold(20.0, y - 4.0, TITLE, line);
    }
    y + 12.0
}

/// Grid, ticks, tick labels and axis labels.
pub(crate) fn axes(paper: &mut Paper, sx: &Scale, sy: &Scale, p: Panel) {
    let xs = || sx.ticks.iter().map(|t| sx.printed(t.0));
    let ys = || sy.ticks.iter().map(|t| sy.printed(t.0));
    paper.strokes("grid", 1.0, xs().map(|x| [x, p.top, x, p.bottom]));
    paper.strokes("grid", 1.0, ys().map(|y| [p.left, y, p.right, y]));
    frame(paper, sx, sy, p);
}

/// Axis lines, ticks and labels without a grid.
pub(crate) fn frame(paper: &mut Paper, sx: &Scale, sy: &Scale, p: Panel) {
    let xs =
        sx.ticks.iter().map(|t| (sx.printed(t.0), 5.0)).chain(sx.minor.iter().map(|t| (sx.printed(*t), 3.0)));
    let ys =
        sy.ticks.iter().map(|t| (sy.printed(t.0), 5.0)).chain(sy.minor.iter().map(|t| (sy.printed(*t), 3.0)));
    let lines = [[p.left, p.bottom, p.right, p.bottom], [p.left, p.top, p.left, p.bottom]];
    let all = lines
        .into_iter()
        .chain(xs.map(|(x, l)| [x, p.bottom, x, p.bottom + l]))
        .chain(ys.map(|(y, l)| [p.left - l, y, p.left, y]));
    paper.strokes("ink", 1.0, all);
    for (value, label) in &sx.ticks {
        paper.text(sx.printed(*value), p.bottom + 18.0, SMALL, Hold::Middle, label);
    }
    for (value, label) in &sy.ticks {
        paper.text(p.left - 9.0, sy.printed(*value) + 4.2, SMALL, Hold::End, label);
    }
    paper.text(0.5 * (p.left + p.right), p.bottom + 39.0, LABEL, Hold::Middle, &sx.label);
    paper.upward(p.left - 9.0 - sy.label_width(SMALL) - 11.0, 0.5 * (p.top + p.bottom), LABEL, &sy.label);
}

/// Range of the data with their errors along both axes, as far as they can be shown.
fn extents(x: &Axis, y: &Axis, curves: &[Curve]) -> (Range<f64>, Range<f64>) {
    let empty = f64::INFINITY..f64::NEG_INFINITY;
    let (mut xs, mut ys) = (empty.clone(), empty);
    let widen = |range: &mut Range<f64>, v: f64, log: bool| {
        if v.is_finite() && (!log || v > 0.0) {
            *range = range.start.min(v)..range.end.max(v);
        }
    };
    for c in curves {
        for (k, p) in c.points.iter().enumerate() {
            if p.iter().all(|v| v.is_finite()) && (!x.log || p[0] > 0.0) && (!y.log || p[1] > 0.0) {
                let e = c.error.get(k).copied().filter(|e| e.is_finite()).unwrap_or(0.0);
                widen(&mut xs, p[0], x.log);
                [p[1], p[1] - e, p[1] + e].into_iter().for_each(|v| widen(&mut ys, v, y.log));
            }
        }
    }
    if curves.iter().any(|c| c.style == Style::Points) && xs.start < xs.end && !x.log {
        // Whole markers at both ends.
        let room = 0.02 * (xs.end - xs.start);
        xs = xs.start - room..xs.end + room;
    }
    (xs, ys)
}

/// Upper left corner of the legend in a corner, or at the middle of a side,
/// that no curve touches.
fn free_corner(curves: &[Curve], sx: &Scale, sy: &Scale, p: Panel) -> Option<[f64; 2]> {
    let [w, h] = legend::column_size(curves);
    if curves.is_empty() || w > 0.6 * (p.right - p.left) || h > 0.5 * (p.bottom - p.top) {
        return None;
    }
    let (left, right, top, bottom) = (p.left + 14.0, p.right - 12.0 - w, p.top + 8.0, p.bottom - 10.0 - h);
    let middle = 0.5 * (top + bottom);
    let places =
        [[right, top], [left, top], [left, bottom], [right, bottom], [right, middle], [left, middle]];
    places.into_iter().find(|[x, y]| {
        let inside =
            |[u, v]: [f64; 2]| (x - 10.0..x + w + 10.0).contains(&u) && (y - 8.0..y + h + 8.0).contains(&v);
        !curves.iter().any(|c| trace(c, sx, sy).any(inside))
    })
}

/// Points of a curve and its errors close enough together to notice what they cross, px.
fn trace<'a>(c: &'a Curve, sx: &'a Scale, sy: &'a Scale) -> impl Iterator<Item = [f64; 2]> + 'a {
    let place = move |k: usize, d: f64| -> [f64; 2] {
        let [x, y] = c.points[k];
        let e = c.error.get(k).map_or(0.0, |e| e * d);
        [sx.at(x).unwrap_or(f64::NAN), sy.at(y + e).unwrap_or(f64::NAN)]
    };
    (0..c.points.len()).flat_map(move |k| {
        let next = if c.style == Style::Points { k } else { (k + 1).min(c.points.len() - 1) };
        [-1.0, 0.0, 1.0].into_iter().flat_map(move |d| {
            let (a, b) = (place(k, d), place(next, d));
            let pieces = ((b[0] - a[0]).hypot(b[1] - a[1]) / 6.0).ceil().clamp(1.0, 200.0) as usize;
            (0..=pieces).map(move |i| {
                let t = i as f64 / pieces as f64;
                [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
            })
        })
    })
}

/// The error of a curve: a band around lines, bars at points.
fn error(paper: &mut Paper, k: usize, c: &Curve, sx: &Scale, sy: &Scale) {
    let colour = legend::colour(k);
    // The lower end of an error that reaches below zero on a logarithmic axis is the edge.
    let y_at = |v: f64| sy.at(v).unwrap_or(sy.place[0]);
    let ends = c.points.iter().zip(&c.error).filter_map(|(p, e)| {
        (e.is_finite() && p[1].is_finite())
            .then(|| Some([sx.at(p[0])?, y_at(p[1] - e), y_at(p[1] + e)]))
            .flatten()
    });
    match c.style {
        Style::Points => {
            let mut d = String::new();
            for [x, a, b] in ends {
                d.push_str(&path(&[
                    [x, a],
                    [x, b],
                    [f64::NAN; 2],
                    [x - 3.0, a],
                    [x + 3.0, a],
                    [f64::NAN; 2],
                    [x - 3.0, b],
                    [x + 3.0, b],
                ]));
            }
            if !d.is_empty() {
                paper.put(format_args!(
                    "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.2\" d=\"{d}\"/>"
                ));
            }
        }
        _ => {
            let ends: Vec<[f64; 3]> = ends.collect();
            let upper = ends.iter().map(|[x, _, b]| [*x, *b]);
            let lower = ends.iter().rev().map(|[x, a, _]| [*x, *a]);
            let d = path(&upper.chain(lower).collect::<Vec<_>>());
            if !d.is_empty() {
                paper.put(format_args!("<path fill=\"{colour}\" fill-opacity=\".18\" d=\"{d}Z\"/>"));
            }
        }
    }
}

fn curve(paper: &mut Paper, k: usize, c: &Curve, sx: &Scale, sy: &Scale) {
    let place = |p: &[f64; 2]| [sx.at(p[0]).unwrap_or(f64::NAN), sy.at(p[1]).unwrap_or(f64::NAN)];
    let places: Vec<[f64; 2]> = c.points.iter().map(place).collect();
    if c.style == Style::Points {
        places
            .iter()
            .filter(|p| p[0].is_finite() && p[1].is_finite())
            .for_each(|p| legend::marker(paper, k, *p));
        return;
    }
    let (colour, dash, d) = (legend::colour(k), legend::dashes(k, c.style), path(&thin(places)));
    paper.put(format_args!(
        "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.7\" stroke-linejoin=\"round\"{dash} d=\"{d}\"/>"
    ));
}

/// A long curve in fewer points that look the same: of all in one pixel
/// column, the first, the lowest, the highest and the last.
fn thin(places: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    if places.len() < 3000 {
        return places;
    }
    let column = |p: &[f64; 2]| p[0].floor();
    let mut out = vec![];
    for group in places.chunk_by(|a, b| column(a) == column(b)) {
        let pick = |better: fn(f64, f64) -> bool| {
            (0..group.len()).reduce(|a, b| if better(group[b][1], group[a][1]) { b } else { a }).unwrap_or(0)
        };
        let mut kept = [0, pick(|a, b| a < b), pick(|a, b| a > b), group.len() - 1];
        kept.sort_unstable();
        out.extend(
            kept.iter().enumerate().filter(|(i, k)| *i == 0 || kept[i - 1] != **k).map(|(_, k)| group[*k]),
        );
    }
    out
}
