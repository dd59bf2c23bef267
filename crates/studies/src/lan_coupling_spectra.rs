//! How the floor's motion goes up through a vibrated layer (Lan 4.3, Figs A4.13-14).

use crate::repeats::Repeats;
use crate::runs::column;
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;

const CASE: (&str, &str) = (
    "studies/lan-coupling-spectra/case.toml",
    include_str!("../../../studies/lan-coupling-spectra/case.toml"),
);

/// Frequency of the floor, Hz.
const FLOOR: f64 = 7.0;

/// Layers that follow the floor, as the thesis counts them from 1; those above do not.
const FOLLOWING: usize = 10;
/// The highest layer of the thesis.
const HIGHEST: usize = 13;

/// What the short form lays over the case.
const QUICK: [&str; 3] = ["time.end=12 s", "observe.0.from=4 s", "observe.0.segment=256"];

/// How often a value of the layers that follow is not beyond that of the layer below.
fn against(values: &[f64], beyond: fn(f64, f64) -> bool) -> f64 {
    values[..FOLLOWING].windows(2).filter(|w| !beyond(w[1], w[0])).count() as f64
}

/// What the thesis says, from the table of the layers of one run.
fn said(t: &Table) -> [(String, f64); 7] {
    let [peak, power, lag] = ["peak_frequency", "shake_density", "lag"].map(|c| column(t, c));
    let furthest = peak[..FOLLOWING].iter().map(|f| (f - FLOOR).abs()).fold(0.0, f64::max);
    [
        ("furthest peak from 7 Hz, layers 1 to 10".into(), furthest),
        (format!("frequency of the peak, layer {HIGHEST}"), peak[HIGHEST - 1]),
        (
            "layers of 2 to 10 without less power at 7 Hz than the one below".into(),
            against(&power, |a, b| a < b),
        ),
        ("power at 7 Hz of layer 10 over that of layer 1".into(), power[FOLLOWING - 1] / power[0]),
        ("layers of 2 to 10 without a longer lag than the one below".into(), against(&lag, |a, b| a > b)),
        ("lag of layer 2".into(), lag[1]),
        ("lag of layer 10 over that of layer 2".into(), lag[FOLLOWING - 1] / lag[1]),
    ]
}

/// The quantities and plots; the short form has one seed, less time and shorter segments.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let overrides: Vec<String> = if request.quick { QUICK.map(String::from).into() } else { vec![] };
    let runs = Repeats::new(CASE, &overrides, &request.out.join("7-hz"), 1, !request.quick)?;
    let layers = runs.tables("layers-layers")?;
    let found: Vec<_> = layers.iter().map(said).collect();
    let computed = (0..found[0].len())
        .map(|k| {
            let values: Vec<f64> = found.iter().map(|f| f[k].1).collect();
            Computed::mean(found[0][k].0.clone(), &values)
        })
        .collect();
    let spectra = mean(&runs.tables("layers-spectra")?);
    let correlations = mean(&runs.tables("layers-correlation")?);
    Ok(Ran { computed, figures: figures(&mean(&layers), &spectra, &correlations) })
}

/// Tables averaged entry by entry.
fn mean(tables: &[Table]) -> Table {
    let mut all = tables[0].clone();
    for (r, row) in all.rows.iter_mut().enumerate() {
        for (c, x) in row.iter_mut().enumerate() {
            *x = tables.iter().map(|t| t.rows[r][c]).sum::<f64>() / tables.len() as f64;
        }
    }
    all
}

fn figures(layers: &Table, spectra: &Table, correlations: &Table) -> Vec<Figure> {
    let shown = [1, 4, 7, 10, 13];
    let curves = |t: &Table, x: &str, normal: bool| -> Vec<Curve> {
        let x = column(t, x);
        // The floor's own spectrum is a line and rounding.
        let floor = normal.then(|| ("floor".to_string(), "floor".to_string())).into_iter();
        let series = floor.chain(shown.map(|k| (format!("layer_{}", k - 1), format!("layer {k}"))));
        series
            .map(|(name, label)| {
                let y = column(t, &name);
                let most = y.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
                let scale = if normal { most } else { 1.0 };
                let points = x.iter().zip(&y).filter(|(x, _)| **x != 0.0 || normal);
                Curve::line(label, points.map(|(x, y)| [*x, y / scale]).collect())
            })
            .collect()
    };
    let of_layers = |what: &str, count: usize| -> Vec<[f64; 2]> {
        column(layers, what).iter().take(count).enumerate().map(|(k, y)| [(k + 1) as f64, *y]).collect()
    };
    let figure = |title: &str, caption: &str, x: Axis, y: Axis, curves: Vec<Curve>| Figure {
        title: title.into(),
        caption: caption.into(),
        body: Body::Curves { x, y, curves },
    };
    let number = || Axis::linear("layer, from the floor", "1");
    vec![
        figure(
            "Spectra of the layers' vertical velocity",
            "Power spectral density of the mean vertical velocity of layers one diameter thick (Fig. A4.13b).",
            Axis::log("frequency", "Hz"),
            Axis::log("power spectral density", "(m/s)^2/Hz"),
            curves(spectra, "frequency", false),
        ),
        figure(
            "Power at the floor's frequency",
            "Power spectral density at 7 Hz, layer by layer.",
            number(),
            Axis::log("power spectral density", "(m/s)^2/Hz"),
            vec![Curve::line("at 7 Hz", of_layers("shake_density", HIGHEST)).styled(Style::Points)],
        ),
        figure(
            "Correlation with the floor",
            "Cross-correlation of the floor's velocity and the layers', each over its largest value (Fig. A4.14): a peak to the right comes after the floor.",
            Axis::linear("lag", "s"),
            Axis::linear("cross-correlation", "1"),
            curves(correlations, "lag", true),
        ),
        figure(
            "Lag behind the floor",
            "Lag of the highest correlation, layer by layer; a cycle is 0.143 s.",
            number(),
            Axis::linear("lag", "s"),
            vec![Curve::line("lag", of_layers("lag", FOLLOWING)).styled(Style::Points)],
        ),
    ]
}
