//! A heap on a shaken floor without walls (Clément 4.4.2, Fig. 4.16).

use crate::runs::{Done, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;
use std::f64::consts::TAU;

const CASE: (&str, &str) =
    ("studies/clement-heap/case.toml", include_str!("../../../studies/clement-heap/case.toml"));

/// What is laid over the case: a smaller heap under the rung that takes seconds, three cycles.
const SMALL: [&str; 15] = [
    "model=navier-stokes",
    "time.end=3 cycles",
    "time.settle=0.15 s",
    "grains.0.count=240",
    "cell.size=[\"14 mm\", \"14 mm\", \"9.8 mm\"]",
    "grains.0.from=[\"3.5 mm\", \"3.5 mm\", \"0 mm\"]",
    "grains.0.to=[\"10.5 mm\", \"10.5 mm\", \"9.8 mm\"]",
    "obstacles.0.to=[\"3.5 mm\", \"14 mm\", \"9.8 mm\"]",
    "obstacles.1.from=[\"10.5 mm\", \"0 mm\", \"0 mm\"]",
    "obstacles.1.to=[\"14 mm\", \"14 mm\", \"9.8 mm\"]",
    "obstacles.2.from=[\"3.5 mm\", \"0 mm\", \"0 mm\"]",
    "obstacles.2.to=[\"10.5 mm\", \"3.5 mm\", \"9.8 mm\"]",
    "obstacles.3.from=[\"3.5 mm\", \"10.5 mm\", \"0 mm\"]",
    "obstacles.3.to=[\"10.5 mm\", \"14 mm\", \"9.8 mm\"]",
    "output.pictures=2",
];

/// Width of the floor and of the rings about its middle, m.
const WIDTH: f64 = 14e-3;
const RING: f64 = 1.4e-3;

/// Grains farther from the middle than this part of half the width have left the heap: the confining walls
/// stood at a half, their corners at 0.71.
const LOOSE: f64 = 0.72;

/// Volumes of grains ring by ring over the height of the cell (m²), sample by sample.
fn rings(table: &Table) -> Vec<Vec<f64>> {
    let columns: Vec<Vec<f64>> =
        (0..).map(|k| column(table, &format!("solids_fraction_{k}"))).take_while(|c| !c.is_empty()).collect();
    let area = |k: usize| TAU * (k as f64 + 0.5) * RING * RING;
    let samples = columns.first().map_or(0, Vec::len);
    (0..samples).map(|t| columns.iter().enumerate().map(|(k, c)| area(k) * c[t]).collect()).collect()
}

/// The part of the grains that lies outside the heap, of those within half the width of the middle.
fn loose(rings: &[f64]) -> f64 {
    let within = |part: f64| rings.iter().take((0.5 * WIDTH * part / RING).round() as usize).sum::<f64>();
    1.0 - within(LOOSE) / within(1.0)
}

/// The quantities and plots; the short form is the full one.
///
/// # Errors
/// Whatever the run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let run = Done::new(CASE, &SMALL.map(String::from), &request.out.join("navier-stokes"), !request.quick)?;
    let outside: Vec<f64> = rings(&run.table("profile")?).iter().map(|r| loose(r)).collect();
    let bed = run.table("bed")?;
    let lid = column(&bed, "height_lid");
    let ends = |c: &[f64]| match c {
        [first, .., last] => [*first, *last],
        _ => [f64::NAN; 2],
    };
    let ([low, high], [before, after]) = (ends(&lid), ends(&outside));
    let computed = vec![
        Computed::new("height of the heap, end over start", high / low),
        Computed::new("part of the grains outside the heap, end less start", after - before),
    ];
    let figure = |title: &str, unit: &str, time: &[f64], values: &[f64]| Figure {
        title: title.into(),
        caption: String::new(),
        body: Body::Curves {
            x: Axis::linear("time", "s"),
            y: Axis::linear(&title.to_lowercase(), unit),
            curves: vec![Curve::line("", time.iter().zip(values).map(|(t, v)| [*t, *v]).collect())],
        },
    };
    let cycles: Vec<f64> = (0..outside.len()).map(|k| k as f64 * 0.1).collect();
    let figures = vec![
        figure("Height of the heap", "m", &column(&bed, "time"), &lid),
        figure("Part of the grains outside the heap", "1", &cycles, &outside),
    ];
    Ok(Ran { computed, figures })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loose_grains_are_those_beyond_the_heap() {
        // Five rings within half the width; the heap ends after four, and corners do not count.
        assert!((loose(&[1.0, 2.0, 2.0, 2.0, 1.0, 9.0]) - 1.0 / 8.0).abs() < 1e-14);
    }
}
