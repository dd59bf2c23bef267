//! Profiles across the bed.

use super::zone_stats::{FRAME, WEIGHT, ZoneStats, place};
use super::{AXES, Faults, Observe, Setting};
use crate::accumulate::Estimate;
use crate::view::{Needs, View};
use crate::zones::sums::{self, DEFINITIONS, QUANTITIES, SUMS};
use crate::zones::{Direction, Grid, Rings, Zones};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::{Value, Values};
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Means over slabs or rings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Profile {
    stats: ZoneStats,
    /// Along z: mass below is meant.
    vertical: bool,
    /// Quantities of the series, by index.
    series: Vec<u32>,
    /// Samples behind one row of the series.
    window: u64,
    held: u64,
    short: Vec<f64>,
}

/// The names that `series` may hold.
const NAMES: [&str; QUANTITIES.len()] = {
    let mut names = [""; QUANTITIES.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = QUANTITIES[k].0;
        k += 1;
    }
    names
};

impl Observe for Profile {
    const ENTRY: Entry = Entry {
        name: "profile",
        summary: "Profiles over slabs or rings: velocity, temperatures, solids fraction, energy, stresses, coordination, mass below.",
        formula: DEFINITIONS,
        source: "Lan 1994, 3.1",
    };

    const KEYS: &'static [Key] = &[
        Key::default(
            "along",
            Kind::Word(&["x", "y", "z", "r"]),
            "\"z\"",
            "Direction across the slabs; `r`: rings about the vertical through the middle of the base.",
        ),
        Key::optional(
            "size",
            Kind::Quantity(Dimension::LENGTH),
            "Thickness of a slab or ring, adjusted to divide the cell evenly; one mean diameter if left out.",
        )
        .with(Check::Positive),
        Key::optional(
            "bottom",
            Kind::Quantity(Dimension::LENGTH),
            "Height at which slabs along z begin, negative to look below the mean place of a floor that moves down; the base of the cell if left out.",
        ),
        FRAME,
        WEIGHT,
        Key::optional(
            "series",
            Kind::List(&Kind::Word(&NAMES)),
            "Quantities to write down as a series, zone by zone.",
        ),
        Key::optional(
            "short_term",
            Kind::Quantity(Dimension::TIME),
            "Time over which each row of the series is a mean (Lan 3-1-3); one sample, the instant, if left out.",
        )
        .with(Check::Positive),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let cell = setting.cell;
        let size = values.number_opt("size").unwrap_or(setting.mean_diameter);
        let along = values.text("along");
        let fault = |message: String| vec![("along".to_string(), message)];
        let zones = match AXES.iter().position(|a| *a == along) {
            Some(axis) if cell.flat_axis() == Some(axis) => {
                return Err(fault(format!("the cell has no extent along {along}")));
            }
            Some(axis) => {
                let mut slabs = Direction::across(cell, axis, size);
                if let Some(bottom) = values.number_opt("bottom") {
                    if axis != 2 || bottom >= cell.size.z {
                        let message = "is for slabs along z, and lies below the top of the cell";
                        return Err(vec![("bottom".into(), message.into())]);
                    }
                    slabs.origin = bottom;
                    slabs.count = ((cell.size.z - bottom) / slabs.width).round().max(1.0) as usize;
                }
                Zones::Grid(Grid::new(cell, vec![slabs]))
            }
            None if cell.flat_axis().is_some() => return Err(fault("rings need three dimensions".into())),
            None => {
                let middle = [0.5 * cell.size.x, 0.5 * cell.size.y];
                Zones::Rings(Rings::new(cell, middle, size, f64::INFINITY))
            }
        };
        let series: Vec<u32> = values
            .list("series")
            .iter()
            .filter_map(|v| match v {
                Value::Text(name) => Some(place(name) as u32),
                _ => None,
            })
            .collect();
        let window =
            values.number_opt("short_term").map_or(1.0, |t| (t / setting.sampling.interval).round().max(1.0));
        let stats = ZoneStats::new(values, setting, zones)?;
        let short = vec![0.0; if series.is_empty() { 0 } else { SUMS * stats.zones.len() }];
        Ok(Self { stats, vertical: along == "z", series, window: window as u64, held: 0, short })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: true, flow: false }
    }

    fn columns(&self) -> Vec<Column> {
        let zones = self.stats.zones.len();
        self.series
            .iter()
            .map(|&q| QUANTITIES[q as usize])
            .flat_map(|(name, unit)| (0..zones).map(move |k| Column::new(format!("{name}_{k}"), unit)))
            .collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let now = self.stats.sample(view);
        if self.series.is_empty() {
            return None;
        }
        self.short.iter_mut().zip(&now).for_each(|(s, x)| *s += x);
        self.held += 1;
        if self.held < self.window {
            return None;
        }
        let zones = self.stats.zones.len();
        let mut all = vec![0.0; zones * QUANTITIES.len()];
        self.stats.quantities(&self.short, self.held as f64, &mut all);
        self.short.fill(0.0);
        self.held = 0;
        let value = |q: u32, k: usize| all[k * QUANTITIES.len() + q as usize];
        Some(self.series.iter().flat_map(|&q| (0..zones).map(move |k| value(q, k))).collect())
    }

    fn results(&self) -> Vec<(String, Table)> {
        let means = self.stats.means();
        let mut table = self.stats.table(&means);
        if self.stats.zones.coordinates().len() == 2 {
            // Rings over the whole height: the second coordinate says nothing.
            table.columns.remove(1);
            table.rows.iter_mut().for_each(|r| {
                r.remove(1);
            });
        }
        if self.vertical {
            table.columns.push(Column::new("mass_below", "1"));
            table.columns.push(Column::new("mass_below_error", "1"));
            for (row, below) in table.rows.iter_mut().zip(self.mass_below()) {
                row.extend([below.value, below.error]);
            }
        }
        vec![("long-term".into(), table), ("cell".into(), self.stats.cell())]
    }

    fn figures(&self, _: &Table) -> Vec<Figure> {
        let means = self.stats.means();
        let at: Vec<f64> = (0..means.len()).map(|k| self.stats.zones.centre(k)[0]).collect();
        let along = self.stats.zones.coordinates()[0];
        let n = self.stats.sums.rows();
        let figure = |title: &str, unit: &str, names: &[&str], note: &str| {
            let curve = |name: &&str| {
                let q = place(name);
                let held: Vec<usize> = (0..at.len()).filter(|&k| means[k][q].value.is_finite()).collect();
                Curve {
                    error: held.iter().map(|&k| means[k][q].error).collect(),
                    ..Curve::line(
                        name.replace('_', " "),
                        held.iter().map(|&k| [at[k], means[k][q].value]).collect(),
                    )
                }
            };
            Figure {
                title: format!("Profile along {along}: {title}"),
                caption: format!(
                    "Mean over {n} samples, with standard errors (jackknife over batches). {note}"
                ),
                body: Body::Curves {
                    x: Axis::linear(along, "m"),
                    y: Axis::linear(title, unit),
                    curves: names.iter().map(curve).collect(),
                },
            }
        };
        vec![
            figure(
                "solids fraction",
                "1",
                &["solids_fraction"],
                "Volume of grains inside over the volume of the zone (Lan 3-1-11).",
            ),
            figure(
                "granular temperature",
                "m^2/s^2",
                &["temperature", "temperature_x", "temperature_y", "temperature_z", "temperature_rotation"],
                "Fluctuations about the zone's mean velocity at the same instant (Lan 3-1-9).",
            ),
            figure(
                "mean velocity",
                "m/s",
                &["velocity_x", "velocity_y", "velocity_z"],
                "Weighted by mass (Lan 3-1-4).",
            ),
            figure(
                "pressure along the axes",
                "Pa",
                &[
                    "kinetic_stress_xx",
                    "kinetic_stress_yy",
                    "kinetic_stress_zz",
                    "contact_stress_xx",
                    "contact_stress_yy",
                    "contact_stress_zz",
                ],
                "Kinetic part: momentum carried by fluctuations; contact part: forces times branches.",
            ),
        ]
    }
}

impl Profile {
    /// Share of the mass in this slab and those below.
    fn mass_below(&self) -> Vec<Estimate> {
        self.stats.sums.estimates(self.stats.zones.len(), |s, _, out| {
            let mass: Vec<f64> = s.chunks_exact(SUMS).map(sums::mass).collect();
            let total: f64 = mass.iter().sum();
            let mut below = 0.0;
            for (o, m) in out.iter_mut().zip(mass) {
                below += m;
                *o = below / total;
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::vec3;

    #[test]
    fn short_term_rows_and_mass_below() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.add(vec3(0.5, 0.5, 0.1), 0.05);
        stage.add(vec3(0.5, 0.5, 0.7), 0.05);
        let species = [("all".to_string(), 2)];
        let mut v = values(Profile::KEYS, &[("size", 0.2), ("short_term", 0.03)]);
        v.insert("series", Value::List(vec![Value::Text("velocity_z".into())]), None);
        let cell = stage.cell;
        let mut p = Profile::from_values(&v, &setting(&cell, &species)).unwrap();
        let mut rows = vec![];
        for k in 0..9 {
            stage.grains.velocity[0].z = f64::from(k);
            rows.extend(p.observe(&stage.view()));
        }
        assert_eq!(rows.len(), 3);
        assert_eq!(rows.iter().map(|r| r[0]).collect::<Vec<_>>(), [1.0, 4.0, 7.0]);
        let results = p.results();
        let below = results[0].1.column("mass_below").unwrap();
        for (b, e) in below.iter().zip([0.5, 0.5, 0.5, 1.0, 1.0]) {
            assert!((b - e).abs() < 1e-12);
        }
        // Over the cell: half of the mass at the mean of 0 to 8; each zone holds one grain, so nothing fluctuates.
        let cell = |name: &str| results[1].1.column(name).unwrap()[0];
        assert!((cell("velocity_z") - 2.0).abs() < 1e-12 && cell("temperature").abs() < 1e-12);
    }

    #[test]
    fn slabs_may_begin_below_the_cell() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        // Half in the slab below zero, half above.
        stage.add(vec3(0.5, 0.5, 0.0), 0.05);
        let species = [("all".to_string(), 1)];
        let cell = stage.cell;
        let v = values(Profile::KEYS, &[("size", 0.2), ("bottom", -0.4)]);
        let mut p = Profile::from_values(&v, &setting(&cell, &species)).unwrap();
        p.observe(&stage.view());
        let table = &p.results()[0].1;
        let (z, below) = (table.column("z").unwrap(), table.column("mass_below").unwrap());
        assert_eq!(z.len(), 7);
        for (k, (low, part)) in [(-0.4, 0.0), (-0.2, 0.5), (0.0, 1.0)].into_iter().enumerate() {
            assert!((z[k] - low - 0.1).abs() < 1e-12 && (below[k] - part).abs() < 1e-12, "{z:?} {below:?}");
        }
        let v = values(Profile::KEYS, &[("bottom", 2.0)]);
        assert!(Profile::from_values(&v, &setting(&cell, &species)).is_err());
    }
}
