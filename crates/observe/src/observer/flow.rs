//! Flow through an opening or a column.

use super::{AXES, Faults, Observe, Selection, Setting};
use crate::nodes::Nodes;
use crate::view::{Needs, View};
use crate::zones::{Body as Shape, Region};
use brazilnut_base::Vec3;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Mean velocities of grains and fluid in a box along one direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flow {
    of: Selection,
    region: Region,
    axis: usize,
}

impl Observe for Flow {
    const ENTRY: Entry = Entry {
        name: "flow",
        summary: "Flow graph: mean velocity and flux of grains and fluid through a named opening or column.",
        formula: "V^ = volume of the part of a grain inside the box, V = volume of the box\n\
                  grain_velocity = sum V^ u/sum V^ (m/s); solids_fraction = sum V^/V; grain_flux = sum V^ u/V (m/s)\n\
                  fluid_velocity: mean over the grid cells with centres in the box, in a resolved coupling over those outside grains (m/s)\n\
                  fluid_flux: the same times the fluid fraction (m/s); with `every = \"24 per cycle\"` the table by phase is the flow graph",
        source: "Clément 2009, 5.5 (Figs 5.10-5.13)",
    };

    const KEYS: &'static [Key] = &[
        Key::required("low", Kind::Vector(Dimension::LENGTH), "Lower corner of the box."),
        Key::required("high", Kind::Vector(Dimension::LENGTH), "Upper corner of the box."),
        Key::default(
            "direction",
            Kind::Word(&AXES),
            "\"z\"",
            "Direction of the velocities; positive along the axis.",
        ),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let corner = |key: &str| values.vector_opt(key).unwrap_or(Vec3::ZERO);
        let region = Region { low: corner("low"), high: corner("high") };
        let size = setting.cell.size;
        for a in (0..3).filter(|&a| setting.cell.flat_axis() != Some(a)) {
            if region.high[a] <= region.low[a] || region.high[a] < 0.0 || region.low[a] > size[a] {
                let message =
                    format!("the box has no part in the cell along {} (0 to {} m)", AXES[a], size[a]);
                return Err(vec![("high".into(), message)]);
            }
        }
        let axis = AXES.iter().position(|a| *a == values.text("direction")).unwrap_or(2);
        Ok(Self { of: Selection::read(values, setting)?, region, axis })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: false, flow: true }
    }

    fn columns(&self) -> Vec<Column> {
        [
            ("grain_velocity", "m/s"),
            ("fluid_velocity", "m/s"),
            ("solids_fraction", "1"),
            ("grain_flux", "m/s"),
            ("fluid_flux", "m/s"),
        ]
        .map(|(n, u)| Column::new(n, u))
        .to_vec()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        let body = Shape::of(view.cell);
        let (mut volume, mut flow) = (0.0, 0.0);
        for k in (0..g.len()).filter(|&k| self.of.takes(g, k)) {
            let images = Region::images(view.cell, g.position[k]);
            let part: f64 = images.map(|at| self.region.part(body, at, g.radius[k])).sum();
            let v = part * body.volume(g.radius[k]);
            volume += v;
            flow += v * g.velocity[k][self.axis];
        }
        let (fluid, flux) = self.fluid(view);
        let space = self.region.volume();
        Some(vec![flow / volume, fluid, volume / space, flow / space, flux])
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curve =
            |column: &str, label: &str| super::bed::pairs(series, column).map(|p| Curve::line(label, p));
        let Region { low, high } = self.region;
        vec![Figure {
            title: "Flow through a box".into(),
            caption: format!(
                "Volume per area and time along {} of grains and fluid in the box from ({:.3e}, {:.3e}, {:.3e}) m to ({:.3e}, {:.3e}, {:.3e}) m.",
                AXES[self.axis], low.x, low.y, low.z, high.x, high.y, high.z
            ),
            body: Body::Curves {
                x: Axis::linear("time", "s"),
                y: Axis::linear("flux", "m/s"),
                curves: [curve("grain_flux", "grains"), curve("fluid_flux", "fluid")]
                    .into_iter()
                    .flatten()
                    .collect(),
            },
        }]
    }
}

impl Flow {
    /// Mean velocity and flux of the fluid.
    fn fluid(&self, view: &View) -> (f64, f64) {
        let Some(flow) = view.fluid.and_then(|f| f.flow) else { return (f64::NAN, f64::NAN) };
        let (mut cells, mut free, mut sum, mut through) = (0.0, 0.0, 0.0, 0.0);
        Nodes::new(view, flow).each(|cell, at, covered| {
            let times = Region::images(view.cell, at).filter(|&x| self.region.holds(x)).count() as f64;
            cells += times;
            if times > 0.0 && !covered {
                let v = flow.cell_velocity(cell)[self.axis];
                free += times;
                sum += times * v;
                through += times * v * flow.porosity(at);
            }
        });
        (sum / free, through / cells)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, Uniform};
    use brazilnut_base::vec3;

    fn stage(resolved: bool) -> Stage {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        // One grain half inside, one all inside.
        stage.add(vec3(0.5, 0.5, 0.5), 0.1);
        stage.add(vec3(0.7, 0.3, 0.5), 0.1);
        stage.grains.velocity[0].z = 3.0;
        stage.grains.velocity[1].z = 6.0;
        stage.flow = Some(Uniform {
            cells: [100; 3],
            size: stage.cell.size,
            velocity: vec3(0.0, 0.0, -2.0),
            slope: 0.0,
            porosity: if resolved { 1.0 } else { 0.75 },
            resolved,
        });
        stage
    }

    #[test]
    fn grains_count_by_their_part_inside_and_cells_by_what_covers_them() {
        let region = Region { low: vec3(0.5, 0.0, 0.0), high: vec3(1.0, 1.0, 1.0) };
        let mut f = Flow { of: Selection::All, region, axis: 2 };
        for resolved in [false, true] {
            let stage = stage(resolved);
            let row = f.observe(&stage.view()).unwrap();
            let ball = 4.0 / 3.0 * std::f64::consts::PI * 1e-3;
            assert!((row[0] - 5.0).abs() < 1e-12);
            assert!((row[2] - 1.5 * ball / 0.5).abs() < 1e-12);
            assert!((row[3] - 5.0 * row[2]).abs() < 1e-12);
            assert_eq!(row[1], -2.0);
            let filled = if resolved { 1.0 - row[2] } else { 0.75 };
            // Spheres of ten cells' radius are covered to some per cent of their volume.
            assert!((row[4] + 2.0 * filled).abs() < 0.03 * 2.0 * row[2] + 1e-12, "{row:?}");
        }
    }

    #[test]
    fn nothing_is_lost_across_periodic_sides() {
        let mut stage = stage(true);
        stage.cell.sides[..2].fill(brazilnut_base::Side::Periodic);
        // A quarter of the first lies at each vertical edge of the cell.
        stage.grains.position[0] = vec3(0.0, 1.0, 0.5);
        let look = |low: Vec3, high: Vec3| {
            let mut f = Flow { of: Selection::All, region: Region { low, high }, axis: 2 };
            f.observe(&stage.view()).unwrap()
        };
        let ball = 4.0 / 3.0 * std::f64::consts::PI * 1e-3;
        let whole = look(Vec3::ZERO, Vec3::ONE);
        // Both grains at 3 and 6 m/s, each whole.
        assert!((whole[0] - 4.5).abs() < 1e-12 && (whole[2] - 2.0 * ball).abs() < 1e-12, "{whole:?}");
        // A column at one edge holds its quarter; one across the edge holds all four, in a volume of 0.16.
        let corner = look(vec3(0.8, 0.8, 0.0), Vec3::ONE);
        assert!((corner[2] * 0.04 - ball / 4.0).abs() < 1e-15, "{corner:?}");
        let across = look(vec3(-0.2, 0.8, 0.0), vec3(0.2, 1.2, 1.0));
        assert!((across[2] * 0.16 - ball).abs() < 1e-14 && (across[0] - 3.0).abs() < 1e-12, "{across:?}");
        // The fluid fills what the grain does not; its cells count a sphere's volume to some per cent.
        assert_eq!(across[1], -2.0);
        assert!((across[4] + 2.0 * (1.0 - across[2])).abs() < 0.03 * 2.0 * across[2], "{across:?}");
    }
}
