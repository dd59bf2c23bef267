//! Vector fields of grains, fluid and their mixture at equal phase.

use super::{AXES, Faults, Observe, Selection, Setting, few_enough, plane_axes};
use crate::accumulate::Estimate;
use crate::nodes::{Nodes, spacing};
use crate::phase::PhaseAverage;
use crate::view::{Needs, View};
use crate::zones::{Direction, Grid};
use brazilnut_base::figure::{Axis, Body, Figure, Raster};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::{Value, Values};
use brazilnut_base::{Column, Table, Vec3};
use serde::{Deserialize, Serialize};

/// Phase-averaged fields in a plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlowField {
    of: Selection,
    plane: [usize; 2],
    grid: Grid,
    /// Weighted sums per phase and cell.
    sums: PhaseAverage,
    /// Phases to draw, degrees.
    draw: Vec<f64>,
    point: Option<[f64; 2]>,
}

/// Numbers in a cell: for grains, fluid and mixture a weight and two components.
const SUMS: usize = 9;
/// Batches behind the errors of each phase.
const BATCHES: usize = 8;
/// What the three fields are called.
const FIELDS: [&str; 3] = ["grain", "fluid", "mixture"];

impl Observe for FlowField {
    const ENTRY: Entry = Entry {
        name: "flow-field",
        summary: "Phase-averaged vector fields of grains, fluid and their mixture in a plane.",
        formula: "cells of edge `size` in the plane, over the whole depth; velocities in the frame of the cell (m/s), averaged over cycles at equal phase\n\
                  averaged couplings: grains u = sum V^ u_i/sum V^ over the parts V^ of grains inside; fluid: mean of v over the grid cells that reach inside, by what they cover; \
                  mixture w = phi v + (1 - phi) u (Clément eq. 4.7), phi the fluid fraction of each grid cell\n\
                  resolved couplings: the grid cells inside grains count as grains, the others as fluid, each by the velocity of the flow there; mixture: all of them",
        source: "Clément 2009, 4.4, eq. 4.7, Figs 4.6-4.9, Table 4.4; Lan 1994, Fig. A5.11",
    };

    const KEYS: &'static [Key] = &[
        Key::default("plane", Kind::Word(&["xz", "yz", "xy"]), "\"xz\"", "Plane of the arrows."),
        Key::optional(
            "size",
            Kind::Quantity(Dimension::LENGTH),
            "Edge of a cell, adjusted to divide the cell evenly; one and a half mean diameters if left out.",
        )
        .with(Check::Positive),
        Key::default(
            "draw",
            Kind::List(&Kind::Quantity(Dimension::NONE)),
            "[2.356194490192345, 3.9269908169872414]",
            "Phases to draw, as angles; the nearest that are sampled.",
        ),
        Key::optional(
            "point",
            Kind::Vector(Dimension::LENGTH),
            "A place at which the speeds at each phase are tabled (Clément, Table 4.4).",
        ),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let plane = plane_axes(values.text("plane"));
        if let Some(flat) = setting.cell.flat_axis().filter(|a| plane.contains(a)) {
            return Err(vec![("plane".into(), format!("the cell has no extent along {}", AXES[flat]))]);
        }
        let size = values.number_opt("size").unwrap_or(1.5 * setting.mean_diameter);
        let grid = Grid::new(setting.cell, plane.map(|a| Direction::across(setting.cell, a, size)).to_vec());
        few_enough(grid.len())?;
        let phases = setting.sampling.per_cycle.unwrap_or(1) as usize;
        let numbers = phases * BATCHES * SUMS * grid.len();
        if numbers > 50_000_000 {
            let message = format!(
                "{phases} phases of {} cells would take {} MB: make the cells larger",
                grid.len(),
                numbers / 125_000
            );
            return Err(vec![("size".into(), message)]);
        }
        let angle = |v: &Value| match v {
            Value::Number(x) => Some(x.to_degrees().rem_euclid(360.0)),
            Value::Integer(n) => Some((*n as f64).to_degrees().rem_euclid(360.0)),
            _ => None,
        };
        Ok(Self {
            of: Selection::read(values, setting)?,
            plane,
            sums: PhaseAverage::new(phases, setting.sampling.phase, SUMS * grid.len(), BATCHES),
            grid,
            draw: values.list("draw").iter().filter_map(angle).collect(),
            point: values.vector_opt("point").map(|p| plane.map(|a| p[a])),
        })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: false, flow: true }
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let mut now = vec![0.0; SUMS * self.grid.len()];
        match view.fluid.and_then(|f| f.flow) {
            Some(flow) if flow.is_resolved() => self.resolved(view, &mut now),
            Some(_) => {
                self.grains(view, &mut now);
                self.averaged(view, &mut now);
            }
            None => self.grains(view, &mut now),
        }
        self.sums.add(view.cycle, &now);
        None
    }

    fn results(&self) -> Vec<(String, Table)> {
        let mut all = vec![("field".to_string(), self.table())];
        if let Some(p) = self.point {
            all.push(("point".into(), self.speeds(p)));
        }
        all
    }

    fn figures(&self, _: &Table) -> Vec<Figure> {
        let mut figures = vec![];
        let mut drawn = vec![];
        for &degrees in &self.draw {
            let held = (0..self.sums.bins().len()).filter(|&k| self.sums.bins()[k].rows() > 0);
            let apart = |k: usize| {
                let d = (self.sums.degrees(k) - degrees).rem_euclid(360.0);
                d.min(360.0 - d)
            };
            let Some(k) = held.min_by(|&a, &b| apart(a).total_cmp(&apart(b))) else { continue };
            if !drawn.contains(&k) {
                drawn.push(k);
                figures.extend((0..3).filter_map(|field| self.map(k, field)));
            }
        }
        figures
    }
}

impl FlowField {
    /// Grains by their parts inside, weights in volume over that of a cell.
    fn grains(&self, view: &View, now: &mut [f64]) {
        let g = view.grains;
        let mut scratch = vec![];
        for k in (0..g.len()).filter(|&k| self.of.takes(g, k)) {
            let volume = self.grid.body().volume(g.radius[k]) / self.grid.zone_volume();
            self.grid.spread(g.position[k], g.radius[k], &mut scratch, |zone, part| {
                self.put(&mut now[SUMS * zone..], 0, part * volume, g.velocity[k]);
            });
        }
    }

    /// Fluid and mixture of an averaged coupling: its grid is coarse, and each of its cells belongs to all that it meets.
    fn averaged(&self, view: &View, now: &mut [f64]) {
        let Some(flow) = view.fluid.and_then(|f| f.flow) else { return };
        let half = 0.5 * Vec3::from_array([0, 1, 2].map(|a| spacing(flow, a, view.cell.size[a])));
        Nodes::new(view, flow).each(|cell, at, _| {
            let (v, phi) = (flow.cell_velocity(cell), flow.porosity(at));
            self.grid.spread_box(at - half, at + half, |zone, part| {
                let zone = &mut now[SUMS * zone..];
                let mut u = Vec3::ZERO;
                if zone[0] > 0.0 {
                    u[self.plane[0]] = zone[1] / zone[0];
                    u[self.plane[1]] = zone[2] / zone[0];
                }
                self.put(zone, 1, part, v);
                self.put(zone, 2, part, phi * v + (1.0 - phi) * u);
            });
        });
    }

    /// Grid cells by what covers them.
    fn resolved(&self, view: &View, now: &mut [f64]) {
        let Some(flow) = view.fluid.and_then(|f| f.flow) else { return };
        Nodes::new(view, flow).each(|cell, at, covered| {
            let zone = &mut now[SUMS * self.grid.find(at)..];
            let v = flow.cell_velocity(cell);
            self.put(zone, usize::from(!covered), 1.0, v);
            self.put(zone, 2, 1.0, v);
        });
    }

    /// Adds a velocity with its weight to field `field` of a cell.
    fn put(&self, cell: &mut [f64], field: usize, weight: f64, v: Vec3) {
        let s = &mut cell[3 * field..3 * field + 3];
        s[0] += weight;
        s[1] += weight * v[self.plane[0]];
        s[2] += weight * v[self.plane[1]];
    }

    /// Two components of field `field` in each cell at phase `k`.
    fn means(&self, k: usize, field: usize) -> Vec<[Estimate; 2]> {
        let n = self.grid.len();
        let e = self.sums.bins()[k].estimates(2 * n, |s, _, out| {
            for c in 0..n {
                let q = &s[SUMS * c + 3 * field..SUMS * c + 3 * field + 3];
                out[2 * c] = q[1] / q[0];
                out[2 * c + 1] = q[2] / q[0];
            }
        });
        e.chunks_exact(2).map(|p| [p[0], p[1]]).collect()
    }

    fn table(&self) -> Table {
        let [p, q] = self.plane.map(|a| AXES[a]);
        let [a, b] = [0, 1].map(|k| &self.grid.directions[k]);
        let mut t = Table::new(&[("phase", "deg"), (p, "m"), (q, "m")]);
        for field in FIELDS {
            for axis in [p, q] {
                t.columns.push(Column::new(format!("{field}_{axis}"), "m/s"));
                t.columns.push(Column::new(format!("{field}_{axis}_error"), "m/s"));
            }
        }
        for k in (0..self.sums.bins().len()).filter(|&k| self.sums.bins()[k].rows() > 0) {
            let fields: Vec<_> = (0..3).map(|f| self.means(k, f)).collect();
            for c in 0..self.grid.len() {
                let mut row = vec![self.sums.degrees(k), a.centre(c % a.count), b.centre(c / a.count)];
                for f in &fields {
                    row.extend(f[c].iter().flat_map(|e| [e.value, e.error]));
                }
                t.rows.push(row);
            }
        }
        t
    }

    /// Speeds of the mean flows at a place, phase by phase.
    fn speeds(&self, point: [f64; 2]) -> Table {
        let mut t = Table::new(&[("phase", "deg")]);
        for field in FIELDS {
            t.columns.push(Column::new(format!("{field}_speed"), "m/s"));
            t.columns.push(Column::new(format!("{field}_speed_error"), "m/s"));
        }
        let mut at = Vec3::ZERO;
        at[self.plane[0]] = point[0];
        at[self.plane[1]] = point[1];
        let c = self.grid.find(at);
        for (k, bin) in self.sums.bins().iter().enumerate().filter(|(_, b)| b.rows() > 0) {
            let e = bin.estimates(3, |s, _, out| {
                for (f, o) in out.iter_mut().enumerate() {
                    let q = &s[SUMS * c + 3 * f..SUMS * c + 3 * f + 3];
                    *o = (q[1] / q[0]).hypot(q[2] / q[0]);
                }
            });
            let mut row = vec![self.sums.degrees(k)];
            row.extend(e.iter().flat_map(|e| [e.value, e.error]));
            t.rows.push(row);
        }
        t
    }

    fn map(&self, k: usize, field: usize) -> Option<Figure> {
        let means = self.means(k, field);
        let [a, b] = [0, 1].map(|d| &self.grid.directions[d]);
        let speed = |m: &[Estimate; 2]| m[0].value.hypot(m[1].value);
        let arrows: Vec<_> = means
            .iter()
            .enumerate()
            .filter(|(_, m)| speed(m) > 0.0)
            .map(|(c, m)| ([a.centre(c % a.count), b.centre(c / a.count)], [m[0].value, m[1].value]))
            .collect();
        if arrows.is_empty() {
            return None;
        }
        let cycles = self.sums.bins()[k].rows();
        Some(Figure {
            title: format!(
                "{} velocity at {:.0}°",
                ["Grain", "Fluid", "Mixture"][field],
                self.sums.degrees(k)
            ),
            caption: format!(
                "Mean over {cycles} cycles at this phase, in cells of {:.3e} m by {:.3e} m, in the frame of the cell. \
                 Phase 0° is the floor moving up at its fastest.",
                a.width, b.width
            ),
            body: Body::Map {
                x: Axis::linear(AXES[a.axis], "m"),
                y: Axis::linear(AXES[b.axis], "m"),
                raster: Some(Raster {
                    shape: [a.count, b.count],
                    extent: [
                        a.origin,
                        a.origin + a.count as f64 * a.width,
                        b.origin,
                        b.origin + b.count as f64 * b.width,
                    ],
                    values: means.iter().map(speed).collect(),
                    label: "speed".into(),
                    unit: "m/s".into(),
                }),
                arrows,
                arrow_unit: "m/s".into(),
                lines: vec![],
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, Uniform, setting, values};
    use brazilnut_base::vec3;

    fn run(resolved: bool) -> FlowField {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.add(vec3(0.5, 0.5, 0.5), 0.2);
        stage.flow = Some(Uniform {
            cells: [40; 3],
            size: stage.cell.size,
            velocity: vec3(0.3, 0.0, -0.4),
            slope: 0.0,
            porosity: 0.75,
            resolved,
        });
        let cell = stage.cell;
        let species = [("all".to_string(), 1)];
        let mut v = values(FlowField::KEYS, &[("size", 1.0)]);
        v.insert("point", Value::Vector(vec3(0.5, 0.0, 0.5)), None);
        let mut f = FlowField::from_values(&v, &setting(&cell, &species)).unwrap();
        for k in 0..40 {
            stage.time = 0.01 * f64::from(k);
            // Up in one half of the cycle, down in the other.
            let up = if k % 10 < 5 { 2.0 } else { -2.0 };
            stage.grains.velocity[0] = vec3(0.0, 0.0, up);
            let _ = f.observe(&stage.view());
        }
        f
    }

    #[test]
    fn mixture_of_an_averaged_coupling() {
        let t = run(false).table();
        assert_eq!(t.rows.len(), 10);
        for (k, row) in t.rows.iter().enumerate() {
            let up = if k < 5 { 2.0 } else { -2.0 };
            let near = |x: f64, y: f64| (x - y).abs() < 1e-12;
            assert!(near(row[5], up) && near(row[7], 0.3) && near(row[9], -0.4), "{row:?}");
            // Clément eq. 4.7 with phi = 0.75.
            assert!(near(row[11], 0.75 * 0.3) && near(row[13], 0.75 * -0.4 + 0.25 * up), "{row:?}");
        }
    }

    #[test]
    fn nodes_inside_grains_count_as_grains() {
        let f = run(true);
        let row = &f.table().rows[0];
        // The uniform flow fills grains and pores alike.
        assert!(
            (row[3] - 0.3).abs() < 1e-12 && (row[7] - 0.3).abs() < 1e-12 && (row[13] + 0.4).abs() < 1e-12
        );
        let bin = &f.sums.bins()[0].total();
        let share = bin[0] / bin[6];
        // Cells in a sphere of eight cells' radius: some per cent of its volume.
        assert!((share / (4.0 / 3.0 * std::f64::consts::PI * 0.008) - 1.0).abs() < 0.03, "{share}");
        let speeds = f.speeds([0.5, 0.5]);
        assert!((speeds.rows[0][3] - 0.5).abs() < 1e-12);
        // Both phases drawn by default, three fields each.
        assert_eq!(f.figures(&Table::default()).len(), 6);
    }
}
