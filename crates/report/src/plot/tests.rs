//! What a plot must show, whatever it looks like.

use super::*;
use brazilnut_base::figure::{Axis, Curve, Raster, Style};

pub(crate) fn curves_figure() -> Figure {
    let theory: Vec<[f64; 2]> =
        (0..200).map(|k| [f64::from(k) * 0.04, 0.03 + 0.004 * (f64::from(k) * 0.1).sin()]).collect();
    let points = theory.iter().step_by(20).map(|p| [p[0], p[1] + 0.001]).collect::<Vec<_>>();
    let error = vec![0.0008; points.len()];
    let mut band = Curve::line("computed", theory.clone());
    band.error = vec![0.001; theory.len()];
    let mut measured = Curve::line("measured <1>", points).styled(Style::Points);
    measured.error = error;
    let body = Body::Curves {
        x: Axis::linear("time", "s"),
        y: Axis::linear("bed height", "m"),
        curves: vec![band, measured, Curve::line("theory", theory).styled(Style::Dashed)],
    };
    Figure { title: "Height & time".into(), caption: String::new(), body }
}

pub(crate) fn map_figure() -> Figure {
    let shape = [20, 12];
    let at = |k: usize| [0.1 * ((k % 20) as f64 + 0.5) / 20.0, 0.06 * ((k / 20) as f64 + 0.5) / 12.0];
    let values = (0..240).map(|k| if k == 7 { f64::NAN } else { at(k)[0] * at(k)[1] }).collect();
    let arrows = (0..240).step_by(2).map(|k| (at(k), [at(k)[1] - 0.03, 0.05 - at(k)[0]])).collect();
    let body = Body::Map {
        x: Axis::linear("x", "m"),
        y: Axis::linear("z", "m"),
        raster: Some(Raster {
            shape,
            extent: [0.0, 0.1, 0.0, 0.06],
            values,
            label: "shade".into(),
            unit: "Pa".into(),
        }),
        arrows,
        arrow_unit: "m".into(),
        lines: vec![vec![[0.0, 0.05], [0.05, 0.055], [0.1, 0.05]]],
    };
    Figure { title: "Map".into(), caption: String::new(), body }
}

#[test]
fn tags_balance_and_text_is_escaped() {
    for figure in [curves_figure(), map_figure()] {
        let svg = svg(&figure);
        assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
        assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count());
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
    let svg = svg(&curves_figure());
    assert!(svg.contains("Height &amp; time") && svg.contains("measured &lt;1&gt;"));
    assert!(svg.contains("bed height [mm]") && svg.contains("time [s]"));
}

#[test]
fn the_same_figure_gives_the_same_bytes() {
    assert_eq!(svg(&curves_figure()), svg(&curves_figure()));
}

#[test]
fn figures_without_data_are_drawn() {
    let axis = || Axis::log("x", "m");
    let empty = Curve::line("", vec![]);
    let broken = Curve::line("b", vec![[f64::NAN, 1.0], [1.0, f64::INFINITY], [-1.0, -1.0]]);
    for curves in [vec![], vec![empty], vec![broken]] {
        let body = Body::Curves { x: axis(), y: axis(), curves };
        let svg = svg(&Figure { title: String::new(), caption: String::new(), body });
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
    let raster = Raster {
        shape: [2, 2],
        extent: [0.0, 1.0, 0.0, 1.0],
        values: vec![f64::NAN; 4],
        label: String::new(),
        unit: "1".into(),
    };
    for raster in [None, Some(raster)] {
        let body =
            Body::Map { x: axis(), y: axis(), raster, arrows: vec![], arrow_unit: "m".into(), lines: vec![] };
        let svg = svg(&Figure { title: String::new(), caption: String::new(), body });
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}

#[test]
fn a_long_curve_is_drawn_small_and_keeps_its_peaks() {
    let mut points: Vec<[f64; 2]> = (0..1_000_000).map(|k| [f64::from(k), 0.0]).collect();
    points[777_777][1] = 1.0;
    let body = Body::Curves {
        x: Axis::linear("x", "1"),
        y: Axis::linear("y", "1"),
        curves: vec![Curve::line("", points)],
    };
    let svg = svg(&Figure { title: String::new(), caption: String::new(), body });
    assert!(svg.len() < 100_000, "{} bytes", svg.len());
    // The peak stands 5 % below the top of the panel: far above every other point.
    let heights = svg.split("stroke-linejoin").nth(1).unwrap();
    let highest = heights
        .split(['L', 'M', '"'])
        .filter_map(|p| p.split_once(' ')?.1.parse::<f64>().ok())
        .fold(f64::INFINITY, f64::min);
    assert!(highest < 0.2 * HEIGHT, "{highest}");
}
