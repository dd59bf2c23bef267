//! Pressure on the base: what grains and fluid each contribute.

use super::{AXES, Faults, Observe, Setting};
use crate::view::Needs;
use crate::view::{Partner, View};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::{Value, Values};
use brazilnut_base::{Column, Table, Vec3, vec3};
use serde::{Deserialize, Serialize};

/// Pressure at places along the base.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BasePressure {
    axis: usize,
    /// Places along the axis, parts of the cell's length.
    at: Vec<f64>,
    /// Width of the strip about each place, m.
    strip: f64,
}

/// Least number of points across the depth over which the fluid's pressure is averaged.
const ACROSS: usize = 8;

impl Observe for BasePressure {
    const ENTRY: Entry = Entry {
        name: "base-pressure",
        summary: "Pressure on the base at places along it: fluid and grains apart, hydrostatic part removed.",
        formula: "fluid = p(base) - mean p(lid) (Pa), p without the hydrostatic part of gravity and of the shaken frame, extrapolated to the base from the two lowest grid cells, mean over the depth of the cell; \
                  where the fluid is at rest (simple-drag): sum of the drag along z on the grains above the strip per area of the strip, negative (underpressure) while the bed rises through the fluid\n\
                  grains = force of the grains on the floor in a strip of width `strip` about the place per area of the strip (Pa)\n\
                  fluid_mean, grains_mean: over the whole base",
        source: "Clément 2009, 3.2.1, Figs 3.1, 4.10, 4.11",
    };

    const KEYS: &'static [Key] = &[
        Key::default("across", Kind::Word(&["x", "y"]), "\"x\"", "Direction along which the places lie."),
        Key::default(
            "at",
            Kind::List(&Kind::Quantity(Dimension::NONE)),
            "[0.2, 0.4, 0.6, 0.8]",
            "Places, as parts of the length of the base.",
        )
        .with(Check::Between(0.0, 1.0)),
        Key::optional(
            "strip",
            Kind::Quantity(Dimension::LENGTH),
            "Width of the strips; four mean diameters if left out.",
        )
        .with(Check::Positive),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let axis = usize::from(values.text("across") == "y");
        if setting.cell.flat_axis() == Some(axis) {
            return Err(vec![("across".into(), format!("the cell has no extent along {}", AXES[axis]))]);
        }
        let number = |v: &Value| match v {
            Value::Number(x) => Some(*x),
            Value::Integer(n) => Some(*n as f64),
            _ => None,
        };
        let at = values.list("at").iter().filter_map(number).collect();
        let strip = values.number_opt("strip").unwrap_or(4.0 * setting.mean_diameter);
        Ok(Self { axis, at, strip: strip.min(setting.cell.size[axis]) })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: true, flow: true }
    }

    fn columns(&self) -> Vec<Column> {
        let places =
            |what: &str| self.at.iter().map(|x| format!("{what}_at_{:.0}", 100.0 * x)).collect::<Vec<_>>();
        places("fluid")
            .into_iter()
            .chain(places("grains"))
            .chain(["fluid_mean".to_string(), "grains_mean".to_string()])
            .map(|n| Column::new(n, "Pa"))
            .collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let mut row: Vec<f64> = self.strips(view).map(|s| self.fluid(view, s)).collect();
        row.extend(self.strips(view).map(|s| grains(view, self.axis, s)));
        let whole = (0.0, view.cell.size[self.axis]);
        row.extend([self.fluid(view, whole), grains(view, self.axis, whole)]);
        Some(row)
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let columns = self.columns();
        let curve =
            |c: &Column| Some(Curve::line(c.name.replace('_', " "), super::bed::pairs(series, &c.name)?));
        vec![Figure {
            title: "Pressure on the base".into(),
            caption: "Fluid and grains apart, at places along the base in percent of its length; hydrostatic part removed.".into(),
            body: Body::Curves {
                x: Axis::linear("time", "s"),
                y: Axis::linear("pressure", "Pa"),
                curves: columns.iter().filter_map(curve).collect(),
            },
        }]
    }
}

impl BasePressure {
    /// Ends of the strips along the axis, kept inside the cell, m.
    fn strips<'a>(&'a self, view: &View) -> impl Iterator<Item = (f64, f64)> + use<'a> {
        let size = view.cell.size[self.axis];
        self.at.iter().map(move |x| {
            let low = (x * size - 0.5 * self.strip).clamp(0.0, size - self.strip);
            (low, low + self.strip)
        })
    }

    /// Pressure of the fluid on the strip, Pa; NaN without a fluid.
    fn fluid(&self, view: &View, strip: (f64, f64)) -> f64 {
        let Some(fluid) = view.fluid else { return f64::NAN };
        if let Some(flow) = fluid.flow {
            let size = view.cell.size;
            let other = 1 - self.axis;
            let [along, deep] = [self.axis, other].map(|a| flow.shape()[a].max(ACROSS));
            let mean = |low: f64, high: f64, z: f64| {
                let point = |k: usize| {
                    let x = low + (high - low) * ((k / deep) as f64 + 0.5) / along as f64;
                    let y = size[other] * ((k % deep) as f64 + 0.5) / deep as f64;
                    if self.axis == 0 { vec3(x, y, z) } else { vec3(y, x, z) }
                };
                let points = (0..along * deep).map(|k| flow.pressure(point(k)));
                points.sum::<f64>() / (along * deep) as f64
            };
            let cell = size.z / flow.shape()[2] as f64;
            let base = |low: f64, high: f64| {
                let z = view.floor_height().max(0.0);
                1.5 * mean(low, high, z + 0.5 * cell) - 0.5 * mean(low, high, z + 1.5 * cell)
            };
            // At a place the pressure itself, over the whole base its mean.
            let (low, high) = if strip.1 - strip.0 < size[self.axis] {
                let middle = 0.5 * (strip.0 + strip.1);
                (middle, middle)
            } else {
                strip
            };
            return base(low, high) - mean(0.0, size[self.axis], size.z);
        }
        if fluid.drag.len() != view.grains.len() {
            return f64::NAN;
        }
        let inside = |r: &Vec3| r[self.axis] >= strip.0 && r[self.axis] < strip.1;
        let drag: f64 =
            view.grains.position.iter().zip(fluid.drag).filter(|(r, _)| inside(r)).map(|(_, d)| d.z).sum();
        // What the grains give back to the fluid has only the base to rest on: a bed that rises is pulled
        // down by the fluid and leaves an underpressure.
        drag / area(view, self.axis, strip)
    }
}

fn area(view: &View, axis: usize, strip: (f64, f64)) -> f64 {
    (strip.1 - strip.0) * view.cell.size[1 - axis]
}

/// Force of the grains on the floor in the strip over its area, Pa.
fn grains(view: &View, axis: usize, strip: (f64, f64)) -> f64 {
    let mut force = 0.0;
    for c in view.contacts {
        let at = view.grains.position[c.i as usize] + c.branch;
        let r = view.grains.radius[c.i as usize];
        // A wall contact below the centre and at the floor's height.
        let below = c.branch.z < -0.5 * c.branch.length() && (at.z - view.floor_height()).abs() < 0.5 * r;
        if matches!(c.with, Partner::Wall(_)) && below && at[axis] >= strip.0 && at[axis] < strip.1 {
            force += c.force.z;
        }
    }
    force / area(view, axis, strip)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, Uniform, setting, values};
    use crate::view::{ContactAt, FluidAt};

    fn observer(stage: &Stage) -> BasePressure {
        let species = [("all".to_string(), stage.grains.len())];
        let v = values(BasePressure::KEYS, &[("strip", 0.2)]);
        BasePressure::from_values(&v, &setting(&stage.cell, &species)).unwrap()
    }

    #[test]
    fn a_slope_along_the_base_and_a_load_in_one_strip() {
        let mut stage = Stage::new(vec3(1.0, 0.5, 2.0), "walls");
        stage.add(vec3(0.42, 0.2, 0.1), 0.1);
        let touch = |with| ContactAt {
            i: 0,
            with,
            overlap: 1e-4,
            force: vec3(0.0, 0.0, 3.0),
            branch: vec3(0.0, 0.0, -0.1),
        };
        stage.contacts.extend([touch(Partner::Wall(0)), touch(Partner::Grain(0))]);
        stage.flow = Some(Uniform {
            cells: [4; 3],
            size: stage.cell.size,
            velocity: Vec3::ZERO,
            slope: 50.0,
            porosity: 1.0,
            resolved: true,
        });
        let mut o = observer(&stage);
        let row = o.observe(&stage.view()).unwrap();
        // p = 50 x - 100 z; mean over the lid 25 - 200.
        for (k, x) in [0.2, 0.4, 0.6, 0.8].into_iter().enumerate() {
            assert!((row[k] - (50.0 * x + 175.0)).abs() < 1e-9, "{row:?}");
        }
        let near = |x: f64, y: f64| (x - y).abs() < 1e-9;
        assert!(row[4..8].iter().zip([0.0, 30.0, 0.0, 0.0]).all(|(x, y)| near(*x, y)), "{row:?}");
        assert!((row[8] - 200.0).abs() < 1e-9 && (row[9] - 6.0).abs() < 1e-12);
    }

    #[test]
    fn drag_on_the_grains_bears_on_the_base() {
        let mut stage = Stage::new(vec3(1.0, 0.5, 2.0), "walls");
        stage.add(vec3(0.42, 0.2, 0.1), 0.1);
        stage.add(vec3(0.95, 0.2, 0.1), 0.1);
        let mut o = observer(&stage);
        let drag = [vec3(0.0, 0.0, -2.0), vec3(0.0, 0.0, 1.0)];
        let fluid = FluidAt { density: 1000.0, viscosity: 1e-3, flow: None, drag: &drag };
        let row = o.observe(&View { fluid: Some(fluid), ..stage.view() }).unwrap();
        assert!(row[..4].iter().zip([0.0, -20.0, 0.0, 0.0]).all(|(x, y)| (x - y).abs() < 1e-9), "{row:?}");
        assert!((row[8] + 2.0).abs() < 1e-12);
    }
}
