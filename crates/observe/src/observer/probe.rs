//! Velocity and pressure of the fluid at a point, or along a line.

use super::{AXES, Faults, Observe, Setting};
use crate::accumulate::Batched;
use crate::view::{Needs, View};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table, Vec3};
use serde::{Deserialize, Serialize};

/// Samples of the fluid at fixed places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    at: Vec3,
    to: Vec3,
    points: usize,
    /// Sums of velocity and pressure at each place of a line.
    sums: Option<Batched>,
}

/// Numbers per place.
const NUMBERS: usize = 4;
/// Batches behind the errors of the means.
const BATCHES: usize = 16;

impl Observe for Probe {
    const ENTRY: Entry = Entry {
        name: "probe",
        summary: "Velocity and pressure of the fluid at a point, or their means along a line.",
        formula: "velocity in the frame of the cell (m/s), pressure without its hydrostatic part (Pa), between the values of the grid linearly\n\
                  at a point: a series; with `to`: table `line` of the means at evenly spaced points, both ends included",
        source: "Clément 2009, Figs 2.11, 2.12",
    };

    const KEYS: &'static [Key] = &[
        Key::required("at", Kind::Vector(Dimension::LENGTH), "The point, or where the line begins."),
        Key::optional("to", Kind::Vector(Dimension::LENGTH), "Where the line ends."),
        Key::default("points", Kind::Integer, "65", "Number of points on the line.")
            .with(Check::Between(2.0, 100_000.0)),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let at = values.vector_opt("at").unwrap_or(Vec3::ZERO);
        let to = values.vector_opt("to");
        let size = setting.cell.size;
        let mut faults = vec![];
        for (key, r) in [("at", Some(at)), ("to", to)] {
            let Some(r) = r else { continue };
            if let Some(a) = (0..3).find(|&a| !(0.0..=size[a]).contains(&r[a])) {
                let why = format!("the cell reaches from 0 to {} m along {}", size[a], AXES[a]);
                faults.push((key.to_string(), why));
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let points = if to.is_some() { values.integer("points").max(2) as usize } else { 1 };
        let sums = to.is_some().then(|| Batched::new(NUMBERS * points, BATCHES, 1));
        Ok(Self { at, to: to.unwrap_or(at), points, sums })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: false, flow: true }
    }

    fn columns(&self) -> Vec<Column> {
        if self.sums.is_some() {
            return vec![];
        }
        [("velocity_x", "m/s"), ("velocity_y", "m/s"), ("velocity_z", "m/s"), ("pressure", "Pa")]
            .map(|(n, u)| Column::new(n, u))
            .to_vec()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let flow = view.fluid.and_then(|f| f.flow);
        let look = |r: Vec3| match flow {
            Some(f) => {
                let v = f.velocity(r);
                [v.x, v.y, v.z, f.pressure(r)]
            }
            None => [f64::NAN; NUMBERS],
        };
        let places: Vec<Vec3> = (0..self.points).map(|k| self.place(k)).collect();
        let Some(sums) = &mut self.sums else { return Some(look(self.at).to_vec()) };
        let now: Vec<f64> = places.into_iter().flat_map(look).collect();
        sums.add(&now);
        None
    }

    fn results(&self) -> Vec<(String, Table)> {
        let Some(sums) = &self.sums else { return vec![] };
        let mut t = Table::new(&[("x", "m"), ("y", "m"), ("z", "m")]);
        for (name, unit) in
            [("velocity_x", "m/s"), ("velocity_y", "m/s"), ("velocity_z", "m/s"), ("pressure", "Pa")]
        {
            t.columns.push(Column::new(name, unit));
            t.columns.push(Column::new(format!("{name}_error"), unit));
        }
        if sums.rows() == 0 {
            return vec![("line".into(), t)];
        }
        for (k, e) in sums.means().chunks_exact(NUMBERS).enumerate() {
            let mut row = self.place(k).to_array().to_vec();
            row.extend(e.iter().flat_map(|e| [e.value, e.error]));
            t.rows.push(row);
        }
        vec![("line".into(), t)]
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let (x, curves, caption) = match &self.sums {
            None => {
                let curve = |a: &&str| {
                    let points = super::bed::pairs(series, &format!("velocity_{a}"))?;
                    Some(Curve::line(format!("along {a}"), points))
                };
                let at = self.at;
                let caption = format!("Fluid velocity at ({:.3e}, {:.3e}, {:.3e}) m.", at.x, at.y, at.z);
                (Axis::linear("time", "s"), AXES.iter().filter_map(curve).collect(), caption)
            }
            Some(sums) if sums.rows() > 0 => {
                let means = sums.means();
                let s = |k: usize| (self.place(k) - self.at).length();
                let curve = |a: usize| {
                    let mean = |k: usize| means[NUMBERS * k + a].value;
                    Curve::line(
                        format!("along {}", AXES[a]),
                        (0..self.points).map(|k| [s(k), mean(k)]).collect(),
                    )
                };
                let (a, b) = (self.at, self.to);
                let caption = format!(
                    "Mean fluid velocity over {} sample(s) on the line from ({:.3e}, {:.3e}, {:.3e}) m to ({:.3e}, {:.3e}, {:.3e}) m.",
                    sums.rows(),
                    a.x,
                    a.y,
                    a.z,
                    b.x,
                    b.y,
                    b.z
                );
                (Axis::linear("distance along the line", "m"), (0..3).map(curve).collect(), caption)
            }
            Some(_) => return vec![],
        };
        let title = "Fluid velocity".into();
        vec![Figure { title, caption, body: Body::Curves { x, y: Axis::linear("velocity", "m/s"), curves } }]
    }
}

impl Probe {
    /// Point `k`, m.
    fn place(&self, k: usize) -> Vec3 {
        self.at + (self.to - self.at) * (k as f64 / (self.points - 1).max(1) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, Uniform, setting, values};
    use brazilnut_base::values::Value;
    use brazilnut_base::vec3;

    fn stage() -> Stage {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.flow = Some(Uniform {
            cells: [10; 3],
            size: stage.cell.size,
            velocity: vec3(0.3, 0.0, -0.4),
            slope: 7.0,
            porosity: 1.0,
            resolved: false,
        });
        stage
    }

    fn probe(stage: &Stage, to: Option<Vec3>) -> Result<Probe, Faults> {
        let mut v = values(Probe::KEYS, &[("points", 5.0)]);
        v.insert("at", Value::Vector(vec3(0.2, 0.5, 0.1)), None);
        if let Some(to) = to {
            v.insert("to", Value::Vector(to), None);
        }
        Probe::from_values(&v, &setting(&stage.cell, &[]))
    }

    #[test]
    fn a_point_gives_a_series_and_a_line_its_means() {
        let mut stage = stage();
        let mut point = probe(&stage, None).unwrap();
        let row = point.observe(&stage.view()).unwrap();
        assert_eq!(row.len(), point.columns().len());
        assert_eq!(row, [0.3, 0.0, -0.4, 7.0 * 0.2 - 10.0]);
        let mut line = probe(&stage, Some(vec3(1.0, 0.5, 0.1))).unwrap();
        assert!(line.columns().is_empty() && line.results()[0].1.rows.is_empty());
        for u in [1.0, 2.0, 3.0] {
            if let Some(f) = &mut stage.flow {
                f.velocity.x = u;
            }
            assert!(line.observe(&stage.view()).is_none());
        }
        let t = &line.results()[0].1;
        assert_eq!(t.rows.len(), 5);
        let row = &t.rows[2];
        assert!((row[0] - 0.6).abs() < 1e-15 && row[3] == 2.0 && (row[7] + 0.4).abs() < 1e-15, "{row:?}");
        assert!((row[9] - (4.2 - 10.0)).abs() < 1e-13, "{row:?}");
    }

    #[test]
    fn points_outside_are_refused() {
        let faults = probe(&stage(), Some(vec3(1.2, 0.5, 0.1))).unwrap_err();
        assert!(
            faults.len() == 1 && faults[0].0 == "to" && faults[0].1.contains("0 to 1 m along x"),
            "{faults:?}"
        );
    }
}
