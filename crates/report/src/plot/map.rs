//! Values in a plane, with arrows and outlines on them.

use super::axis::{Fit, Scale, linear_ticks, nice_step};
use super::curves::{Panel, frame, heading};
use super::paper::{Hold, LABEL, Paper, SMALL, path};
use super::{ColourScale, WIDTH};
use crate::colour::{self, Rgb};
use crate::{png, text};
use base64::Engine as _;
use brazilnut_base::figure::{Axis, Body, Figure, Raster};
use std::fmt::Write as _;

type Arrow = ([f64; 2], [f64; 2]);

/// The tallest panel, px.
const TALLEST: f64 = 430.0;
/// Room for the colour bar with its ticks and label, px.
const BAR_ROOM: f64 = 92.0;

pub(super) fn draw(figure: &Figure) -> String {
    let Body::Map { x, y, raster, arrows, arrow_unit, lines } = &figure.body else { return String::new() };
    let raster =
        raster.as_ref().filter(|r| r.shape[0] * r.shape[1] == r.values.len() && !r.values.is_empty());
    let [x0, x1, y0, y1] = extent(raster, arrows, lines);
    let mut sx = Scale::new(&linear(x), x0, x1, Fit::Tight, 6);
    let mut sy = Scale::new(&linear(y), y0, y1, Fit::Tight, 6);
    if x.unit == y.unit {
        // One plane, one unit: the finer of the two.
        let factor = sx.factor.min(sy.factor);
        sx = sx.in_unit_of(&linear(x), factor, 6);
        sy = sy.in_unit_of(&linear(y), factor, 6);
    }

    // The heading is laid out on a sheet of its own to know its height first.
    let key_room = if arrows.is_empty() { 0.0 } else { 16.0 };
    let top = heading(&mut Paper::new(WIDTH, 0.0, ""), &figure.title) + key_room;
    let left = 22.0 + sy.label_width(SMALL) + LABEL + 6.0;
    let widest = WIDTH - left - if raster.is_some() { BAR_ROOM } else { 18.0 };
    let [w, h] = panel_size(x, y, [x1 - x0, y1 - y0], widest);
    let panel = Panel { left, right: left + w, top, bottom: top + h };
    (sx.place, sy.place) = ([panel.left, panel.right], [panel.bottom, panel.top]);

    let mut paper = Paper::new(WIDTH, panel.bottom + 50.0, &figure.title);
    heading(&mut paper, &figure.title);
    if let Some(r) = raster {
        let tint = Tint::of(&r.values);
        image(&mut paper, r, &tint, &sx, &sy);
        colour_bar(&mut paper, r, &tint, panel);
    }
    paper.clip(panel.left, panel.top, w, h);
    outlines(&mut paper, lines, &sx, &sy, raster.is_some());
    let drawn = Arrows::of(arrows, &sx, &sy, panel);
    drawn.draw(&mut paper, arrows, &sx, &sy, raster.is_some());
    paper.unclip();
    drawn.key(&mut paper, arrow_unit, panel);
    frame(&mut paper, &sx, &sy, panel);
    paper.strokes(
        "ink",
        1.0,
        [
            [panel.left, panel.top, panel.right, panel.top],
            [panel.right, panel.top, panel.right, panel.bottom],
        ]
        .into_iter(),
    );
    paper.finish()
}

/// Planes are never logarithmic.
fn linear(axis: &Axis) -> Axis {
    Axis { log: false, ..axis.clone() }
}

/// x0, x1, y0, y1 of everything in the map.
fn extent(raster: Option<&Raster>, arrows: &[Arrow], lines: &[Vec<[f64; 2]>]) -> [f64; 4] {
    if let Some(r) = raster {
        return r.extent;
    }
    let [mut x0, mut x1, mut y0, mut y1] =
        [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    for [x, y] in arrows.iter().map(|a| a.0).chain(lines.iter().flatten().copied()) {
        if x.is_finite() && y.is_finite() {
            (x0, x1, y0, y1) = (x0.min(x), x1.max(x), y0.min(y), y1.max(y));
        }
    }
    // Without an outline the arrows need room to stand in.
    let room = if lines.is_empty() { 0.06 } else { 0.02 };
    let (rx, ry) = (room * (x1 - x0), room * (y1 - y0));
    [x0 - rx, x1 + rx, y0 - ry, y1 + ry]
}

/// Equal scales where both axes have the same unit and the panel stays readable.
fn panel_size(x: &Axis, y: &Axis, span: [f64; 2], widest: f64) -> [f64; 2] {
    let ratio = span[1] / span[0];
    if x.unit != y.unit || !(0.15..8.0).contains(&ratio) {
        return [widest, 0.6 * widest];
    }
    if widest * ratio <= TALLEST { [widest, widest * ratio] } else { [TALLEST / ratio, TALLEST] }
}

/// From values to colours.
struct Tint {
    low: f64,
    high: f64,
    scale: fn(f64) -> Rgb,
}

impl Tint {
    /// Values of both signs get a scale that is pale at zero, others one from dark to light.
    fn of(values: &[f64]) -> Self {
        let finite = || values.iter().copied().filter(|v| v.is_finite());
        let (low, high) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let largest = low.abs().max(high.abs());
        if low > high {
            return Self { low: 0.0, high: 1.0, scale: colour::sequential };
        }
        if low < -0.1 * largest && high > 0.1 * largest {
            return Self { low: -largest, high: largest, scale: colour::diverging };
        }
        let room = if high - low > 1e-12 * largest { 0.0 } else { 0.5 * largest.max(1e-300) };
        Self { low: low - room, high: high + room, scale: colour::sequential }
    }

    fn colour(&self, value: f64) -> Rgb {
        (self.scale)((value - self.low) / (self.high - self.low))
    }
}

/// The raster as an embedded picture, enlarged so that viewers show sharp cells.
fn image(paper: &mut Paper, r: &Raster, tint: &Tint, sx: &Scale, sy: &Scale) {
    let [nx, ny] = r.shape;
    let (fx, fy) = ((640 / nx).clamp(1, 64), (640 / ny).clamp(1, 64));
    let mut pixels = Vec::with_capacity(4 * nx * fx * ny * fy);
    for j in (0..ny).rev() {
        let row: Vec<u8> = (0..nx)
            .flat_map(|i| {
                let v = r.values[j * nx + i];
                let [red, green, blue] =
                    colour::to_bytes(if v.is_finite() { tint.colour(v) } else { [0.0; 3] });
                [red, green, blue, if v.is_finite() { 255 } else { 0 }].repeat(fx)
            })
            .collect();
        (0..fy).for_each(|_| pixels.extend_from_slice(&row));
    }
    let data = base64::engine::general_purpose::STANDARD.encode(png::rgba(nx * fx, ny * fy, &pixels));
    let at = |s: &Scale, v: f64| s.at(v).unwrap_or(0.0);
    let (x, y) = (at(sx, r.extent[0]), at(sy, r.extent[3]));
    let (w, h) = (at(sx, r.extent[1]) - x, at(sy, r.extent[2]) - y);
    paper.put(format_args!(
        "<image x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" preserveAspectRatio=\"none\" href=\"data:image/png;base64,{data}\"/>"
    ));
}

/// The scale of shades beside the panel.
fn colour_bar(paper: &mut Paper, r: &Raster, tint: &Tint, p: Panel) {
    let (x, w) = (p.right + 14.0, 13.0);
    let (unit, factor) = text::readable_unit(&r.unit, tint.low.abs().max(tint.high.abs()));
    let range = [tint.low / factor, tint.high / factor];
    let steps = 64;
    for k in 0..steps {
        let t = (f64::from(k) + 0.5) / f64::from(steps);
        let [red, green, blue] = colour::to_bytes((tint.scale)(t));
        // Each reaches to the top, under those that follow: neighbours leave no seam.
        let h = (p.bottom - p.top) * (1.0 - f64::from(k) / f64::from(steps));
        let y = p.top;
        paper.put(format_args!(
            "<rect x=\"{x:.1}\" y=\"{y:.2}\" width=\"{w}\" height=\"{h:.2}\" fill=\"#{red:02x}{green:02x}{blue:02x}\"/>"
        ));
    }
    let ticks = linear_ticks(range, 6);
    let place = |v: f64| p.bottom - (v - range[0]) / (range[1] - range[0]) * (p.bottom - p.top);
    paper.strokes("ink", 1.0, ticks.iter().map(|t| [x + w, place(t.0), x + w + 4.0, place(t.0)]));
    let mut widest = 0.0_f64;
    for (v, label) in &ticks {
        paper.text(x + w + 8.0, place(*v) + 4.2, SMALL, Hold::Start, label);
        widest = widest.max(text::width(label, SMALL));
    }
    let middle = 0.5 * (p.top + p.bottom);
    paper.upward(x + w + 8.0 + widest + 16.0, middle, LABEL, &text::labelled(&r.label, &unit));
}

/// The sequential scale lying down, as wide as half a plot.
pub(super) fn scale_bar(scale: &ColourScale) -> String {
    let (width, height, bar) = (0.5 * WIDTH, 56.0, 11.0);
    let axis = Axis::linear(&scale.label, &scale.unit);
    let mut s = Scale::new(&axis, scale.low, scale.high, Fit::Tight, 5);
    s.place = [18.0, width - 18.0];
    let mut paper = Paper::new(width, height, &scale.label);
    let steps = 96;
    for k in 0..steps {
        let [red, green, blue] =
            colour::to_bytes(colour::sequential((f64::from(k) + 0.5) / f64::from(steps)));
        // Each reaches to the right end, under those that follow: neighbours leave no seam.
        let w = (s.place[1] - s.place[0]) * (1.0 - f64::from(k) / f64::from(steps));
        let x = s.place[1] - w;
        paper.put(format_args!(
            "<rect x=\"{x:.2}\" y=\"4\" width=\"{w:.2}\" height=\"{bar}\" fill=\"#{red:02x}{green:02x}{blue:02x}\"/>"
        ));
    }
    let bottom = 4.0 + bar;
    paper.strokes("ink", 1.0, s.ticks.iter().map(|t| [s.printed(t.0), bottom, s.printed(t.0), bottom + 4.0]));
    for (v, label) in &s.ticks {
        paper.text(s.printed(*v), bottom + 17.0, SMALL, Hold::Middle, label);
    }
    paper.text(0.5 * width, bottom + 34.0, SMALL, Hold::Middle, &s.label);
    paper.finish()
}

fn outlines(paper: &mut Paper, lines: &[Vec<[f64; 2]>], sx: &Scale, sy: &Scale, on_raster: bool) {
    let place = |p: &[f64; 2]| [sx.at(p[0]).unwrap_or(f64::NAN), sy.at(p[1]).unwrap_or(f64::NAN)];
    let mut d = String::new();
    lines.iter().for_each(|l| d.push_str(&path(&l.iter().map(place).collect::<Vec<_>>())));
    if d.is_empty() {
        return;
    }
    if on_raster {
        paper.put(format_args!(
            "<path class=\"halo\" stroke-width=\"2.6\" stroke-linejoin=\"round\" d=\"{d}\"/>"
        ));
    }
    paper.put(format_args!("<path class=\"ink\" stroke-width=\"1.1\" stroke-linejoin=\"round\" d=\"{d}\"/>"));
}

/// How long arrows are drawn.
struct Arrows {
    /// Length in px of a vector of length one in the arrows' unit.
    px: f64,
    /// The longest vector that counts; the few beyond it are drawn longer.
    typical: f64,
}

impl Arrows {
    /// The typical large arrow spans one spacing between arrows.
    fn of(arrows: &[Arrow], sx: &Scale, sy: &Scale, p: Panel) -> Self {
        let place = |a: &Arrow| Some([sx.at(a.0[0])?, sy.at(a.0[1])?]);
        let mut lengths: Vec<f64> =
            arrows.iter().map(|a| a.1[0].hypot(a.1[1])).filter(|l| l.is_finite() && *l > 0.0).collect();
        lengths.sort_by(f64::total_cmp);
        // The 95th percentile: one wild arrow must not shrink all others to dots.
        let typical = lengths.get(lengths.len().saturating_sub(1) * 95 / 100).copied().unwrap_or(0.0);
        let places: Vec<[f64; 2]> = arrows.iter().filter_map(place).collect();
        let area = (p.right - p.left) * (p.bottom - p.top);
        let spacing = (area / places.len().max(1) as f64).sqrt().clamp(12.0, 60.0);
        Self { px: if typical > 0.0 { spacing / typical } else { 0.0 }, typical }
    }

    fn draw(&self, paper: &mut Paper, arrows: &[Arrow], sx: &Scale, sy: &Scale, on_raster: bool) {
        let mut d = String::new();
        for (start, vector) in arrows {
            let (Some(x), Some(y)) = (sx.at(start[0]), sy.at(start[1])) else { continue };
            if vector.iter().all(|v| v.is_finite()) {
                d.push_str(&arrow([x, y], [vector[0] * self.px, -vector[1] * self.px]));
            }
        }
        if d.is_empty() {
            return;
        }
        if on_raster {
            paper.put(format_args!("<path fill=\"#fff\" stroke=\"#111\" stroke-width=\".5\" d=\"{d}\"/>"));
        } else {
            paper.put(format_args!("<path class=\"solid\" d=\"{d}\"/>"));
        }
    }

    /// An arrow of round length above the panel, with what it stands for.
    fn key(&self, paper: &mut Paper, unit: &str, p: Panel) {
        if self.px == 0.0 {
            return;
        }
        let (unit, factor) = text::readable_unit(unit, self.typical);
        let step = nice_step(self.typical / factor);
        let round =
            if step * factor * self.px > 90.0 { nice_step(self.typical / factor / 2.5) } else { step };
        let decimals = (-(round.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
        let label = format!("{} {unit}", text::fixed(round, decimals));
        let length = round * factor * self.px;
        let (y, text_at) = (p.top - 11.0, p.right);
        paper.text(text_at, y + 4.0, SMALL, Hold::End, label.trim());
        let x = text_at - text::width(label.trim(), SMALL) - 8.0 - length;
        let d = arrow([x, y], [length, 0.0]);
        paper.put(format_args!("<path class=\"solid\" d=\"{d}\"/>"));
    }
}

/// The outline of an arrow that starts at `start`; too short ones are dots.
fn arrow([x, y]: [f64; 2], [u, v]: [f64; 2]) -> String {
    let length = u.hypot(v);
    let mut d = String::new();
    if length < 1.5 {
        let _ = write!(d, "M{:.1} {y:.1}a.8 .8 0 1 0 1.6 0a.8 .8 0 1 0 -1.6 0z", x - 0.8);
        return d;
    }
    let (c, s) = (u / length, v / length);
    // The head keeps its shape and shrinks with short arrows.
    let head = (0.45 * length).min(8.0);
    let (neck, barb, shaft) = (length - 0.9 * head, 0.42 * head, (0.085 * head).max(0.35));
    let outline = [
        [0.0, shaft],
        [neck, shaft],
        [length - head, barb],
        [length, 0.0],
        [length - head, -barb],
        [neck, -shaft],
        [0.0, -shaft],
    ];
    for (k, [a, b]) in outline.into_iter().enumerate() {
        let _ =
            write!(d, "{}{:.1} {:.1}", if k == 0 { 'M' } else { 'L' }, x + a * c - b * s, y + a * s + b * c);
    }
    d.push('z');
    d
}
