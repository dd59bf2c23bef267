//! Fields over cells of a plane or of space.

use super::zone_stats::{FRAME, WEIGHT, ZoneStats, place};
use super::{AXES, Faults, Observe, Setting, plane_axes};
use crate::accumulate::Estimate;
use crate::view::{Needs, View};
use crate::zones::sums::{self, DEFINITIONS, QUANTITIES, SUMS};
use crate::zones::{Direction, Grid, Rings, Zones};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Raster};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use serde::{Deserialize, Serialize};

/// Means over cells, and the mean speed of the convection.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Field {
    stats: ZoneStats,
    plane: [usize; 2],
    least: f64,
}

impl Observe for Field {
    const ENTRY: Entry = Entry {
        name: "field",
        summary: "Mean fields over cells of a plane, of space or of a meridian, and the mean speed of the mean flow.",
        formula: DEFINITIONS,
        source: "Lan 1994, 3.1, 5.1 (Figs A5.1-A5.9)",
    };

    const KEYS: &'static [Key] = &[
        Key::default(
            "plane",
            Kind::Word(&["xz", "yz", "xy", "xyz", "rz"]),
            "\"xz\"",
            "Plane of the cells; `xyz`: cells in space; `rz`: rings about the vertical through the middle of the base.",
        ),
        Key::optional(
            "size",
            Kind::Quantity(Dimension::LENGTH),
            "Edge of a cell, adjusted to divide the cell evenly; one and a half mean diameters if left out.",
        )
        .with(Check::Positive),
        Key::default(
            "least",
            Kind::Quantity(Dimension::NONE),
            "0.05",
            "Cells of a smaller mean solids fraction are left out of the mean speeds and of the arrows.",
        )
        .with(Check::Between(0.0, 0.7)),
        FRAME,
        WEIGHT,
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let cell = setting.cell;
        let size = values.number_opt("size").unwrap_or(1.5 * setting.mean_diameter);
        let plane = values.text("plane");
        let across = |axes: &[usize]| {
            Zones::Grid(Grid::new(cell, axes.iter().map(|&a| Direction::across(cell, a, size)).collect()))
        };
        let fault = |message: String| Err(vec![("plane".to_string(), message)]);
        let flat = cell.flat_axis();
        let zones = match plane {
            "xyz" if flat.is_none() => across(&[0, 1, 2]),
            "rz" if flat.is_none() => {
                Zones::Rings(Rings::new(cell, [0.5 * cell.size.x, 0.5 * cell.size.y], size, size))
            }
            "xyz" | "rz" => return fault(format!("`{plane}` needs three dimensions")),
            _ => {
                let axes = plane_axes(plane);
                if let Some(a) = flat.filter(|a| axes.contains(a)) {
                    return fault(format!("the cell has no extent along {}", AXES[a]));
                }
                across(&axes)
            }
        };
        Ok(Self {
            stats: ZoneStats::new(values, setting, zones)?,
            plane: plane_axes(plane),
            least: values.number("least"),
        })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: true, flow: false }
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let _ = self.stats.sample(view);
        None
    }

    fn results(&self) -> Vec<(String, Table)> {
        let mut all = vec![("long-term".to_string(), self.stats.table(&self.stats.means()))];
        if let Zones::Grid(g) = &self.stats.zones {
            all.push(("speed".into(), self.speed()));
            if g.directions.len() == 2 {
                all.push(("columns".into(), self.columns_of_speed(&g.directions)));
            }
        }
        all
    }

    fn figures(&self, _: &Table) -> Vec<Figure> {
        let Zones::Grid(g) = &self.stats.zones else { return vec![] };
        let [a, b] = g.directions.as_slice() else { return vec![] };
        let means = self.stats.means();
        let n = self.stats.sums.rows();
        let held = |k: usize| means[k][0].value >= self.least;
        let vector = |k: usize| self.plane.map(|axis| means[k][1 + axis].value);
        let extent =
            [a.origin, a.origin + a.count as f64 * a.width, b.origin, b.origin + b.count as f64 * b.width];
        let map = |name: &str, arrows: bool, note: String| Figure {
            title: format!("Field: {}", name.replace('_', " ")),
            caption: format!(
                "Mean over {n} samples in cells of {:.3e} m by {:.3e} m. {note}",
                a.width, b.width
            ),
            body: Body::Map {
                x: Axis::linear(AXES[a.axis], "m"),
                y: Axis::linear(AXES[b.axis], "m"),
                raster: Some(Raster {
                    shape: [a.count, b.count],
                    extent,
                    values: means
                        .iter()
                        .map(|m| if m[0].value >= self.least { m[place(name)].value } else { f64::NAN })
                        .collect(),
                    label: name.replace('_', " "),
                    unit: QUANTITIES[place(name)].1.into(),
                }),
                arrows: (0..means.len())
                    .filter(|&k| arrows && held(k))
                    .map(|k| ([a.centre(k % a.count), b.centre(k / a.count)], vector(k)))
                    .collect(),
                arrow_unit: "m/s".into(),
                lines: vec![],
            },
        };
        let speed = self.speed();
        let columns = self.columns_of_speed(&g.directions);
        let points = |c: usize| columns.rows.iter().map(|r| [r[0], r[c]]).collect();
        vec![
            map(
                "solids_fraction",
                true,
                format!(
                    "Arrows: mean velocity, weighted by mass. Mean speed {:.3e} ± {:.1e} m/s over cells of a solids fraction of at least {}.",
                    speed.rows[0][0], speed.rows[0][1], self.least
                ),
            ),
            map(
                "temperature",
                false,
                "Fluctuations about the cell's mean velocity at the same instant.".into(),
            ),
            Figure {
                title: format!("Mean speed by column across {}", AXES[a.axis]),
                caption: format!(
                    "Mean of |u| over the cells of each column with a solids fraction of at least {} (Lan, Figs A5.2).",
                    self.least
                ),
                body: Body::Curves {
                    x: Axis::linear(AXES[a.axis], "m"),
                    y: Axis::linear("mean speed", "m/s"),
                    curves: vec![Curve {
                        error: columns.rows.iter().map(|r| r[2]).collect(),
                        ..Curve::line("speed", points(1))
                    }],
                },
            },
        ]
    }
}

impl Field {
    /// Mean over `cells` of the magnitude of the mean velocity within the plane; NaN without grains.
    fn mean_speed(&self, sums: &[f64], samples: f64, cells: impl Iterator<Item = usize>) -> f64 {
        let space = matches!(&self.stats.zones, Zones::Grid(g) if g.directions.len() == 3);
        let mut q = [0.0; QUANTITIES.len()];
        let (mut total, mut count) = (0.0, 0.0);
        for k in cells {
            sums::derive(
                &sums[k * SUMS..(k + 1) * SUMS],
                samples,
                self.stats.zones.volume(k),
                self.stats.flat,
                &mut q,
            );
            if q[0] >= self.least && q[1].is_finite() {
                let square: f64 =
                    (0..3).filter(|a| space || self.plane.contains(a)).map(|a| q[1 + a] * q[1 + a]).sum();
                total += square.sqrt();
                count += 1.0;
            }
        }
        total / count
    }

    fn speed(&self) -> Table {
        let n = self.stats.zones.len();
        let e = self.stats.sums.estimates(1, |s, samples, out| out[0] = self.mean_speed(s, samples, 0..n))[0];
        let mut t = Table::new(&[("mean_speed", "m/s"), ("mean_speed_error", "m/s"), ("samples", "1")]);
        t.rows.push(vec![e.value, e.error, self.stats.sums.rows() as f64]);
        t
    }

    fn columns_of_speed(&self, directions: &[Direction]) -> Table {
        let (a, n) = (&directions[0], self.stats.zones.len());
        let e: Vec<Estimate> = self.stats.sums.estimates(a.count, |s, samples, out| {
            for (i, o) in out.iter_mut().enumerate() {
                *o = self.mean_speed(s, samples, (i..n).step_by(a.count));
            }
        });
        let mut t = Table::new(&[(AXES[a.axis], "m"), ("mean_speed", "m/s"), ("mean_speed_error", "m/s")]);
        t.rows = e.iter().enumerate().map(|(i, e)| vec![a.centre(i), e.value, e.error]).collect();
        t
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observer::Selection;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::{Vec3, vec3};

    #[test]
    fn mean_speed_of_a_known_roll() {
        // Solid rotation about the middle of a packed square: the mean of |u| is w times the mean distance.
        let mut stage = Stage::new(vec3(1.0, 0.1, 1.0), "walls");
        for k in 0..400 {
            let at = vec3(0.025 + 0.05 * f64::from(k % 20), 0.05, 0.025 + 0.05 * f64::from(k / 20));
            stage.add(at, 0.02);
            let d = at - vec3(0.5, 0.05, 0.5);
            stage.grains.velocity[k as usize] = 2.0 * Vec3::new(d.z, 0.0, -d.x);
        }
        let cell = stage.cell;
        let species = [("all".to_string(), 400)];
        let mut f =
            Field::from_values(&values(Field::KEYS, &[("size", 0.05)]), &setting(&cell, &species)).unwrap();
        for _ in 0..20 {
            let _ = f.observe(&stage.view());
        }
        let direct: f64 = stage.grains.velocity.iter().map(|v| v.length()).sum::<f64>() / 400.0;
        let results = f.results();
        let speed = results[1].1.column("mean_speed").unwrap()[0];
        assert!((speed / direct - 1.0).abs() < 1e-12, "{speed} {direct}");
        // Error zero: every sample is the same.
        assert!(results[1].1.column("mean_speed_error").unwrap()[0] < 1e-12);
        let columns = results[2].1.column("mean_speed").unwrap();
        assert!(columns[0] > columns[9]);
        assert_eq!(f.stats.of, Selection::All);
    }
}
