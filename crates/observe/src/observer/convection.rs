//! The displacement field J and its strength.

use super::{AXES, Faults, Observe, Sampling, Selection, Setting, few_enough, plane_axes};
use crate::accumulate::{Batched, Estimate};
use crate::view::View;
use crate::zones::{Direction, Grid};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Raster, Style};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table, Vec3, random};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Displacements from cycle to cycle, credited to cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Convection {
    of: Selection,
    plane: [usize; 2],
    grid: Grid,
    /// Cycles between samples.
    cycles: f64,
    seed: u64,
    shuffles: usize,
    /// Paths and cells at the last sample.
    last: Vec<Vec3>,
    last_cell: Vec<u32>,
    /// Sums of J, both components cell by cell.
    field: Batched,
    /// The same for shuffled displacements, one block per shuffle.
    noise: Vec<f64>,
}

impl Observe for Convection {
    const ENTRY: Entry = Entry {
        name: "convection",
        summary: "Displacement field J per cycle and its strength, with the noise floor of shuffled displacements.",
        formula: "J(X) = < 1/2 sum_i [delta_i(X; t) + delta_i(X; t - T)] [r_i(t) - r_i(t - T)] >_t (m per cycle), cells X of edge `size`, \
                  delta_i(X; t) = 1 while the centre of grain i is in X; strength J = sqrt(sum_X |J(X)|^2) (m per cycle)\n\
                  noise: strength after the displacements of each cycle are dealt out to the grains at random (what all grains have in common stays); excess = sqrt(J^2 - noise^2)\n\
                  errors by the jackknife over batches of cycles; J grows with the number of grains per cell, so quote its cell size",
        source: "Clément 2009, eq. 4.1, 4.2",
    };

    const KEYS: &'static [Key] = &[
        Key::default(
            "plane",
            Kind::Word(&["xz", "yz", "xy"]),
            "\"xz\"",
            "Plane of the cells; the third direction is summed over.",
        ),
        Key::optional(
            "size",
            Kind::Quantity(Dimension::LENGTH),
            "Edge of a cell, adjusted to divide the cell evenly; two mean diameters if left out.",
        )
        .with(Check::Positive),
        Key::default(
            "shuffles",
            Kind::Integer,
            "4",
            "Number of independent shuffles behind the noise floor.",
        )
        .with(Check::Between(0.0, 64.0)),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let of = Selection::read(values, setting)?;
        let Sampling { cycles: Some(cycles), .. } = setting.sampling else {
            let message = "displacements are taken from cycle to cycle: write `every = \"cycle\"` or `every = \"5 cycles\"`";
            return Err(vec![("every".into(), message.into())]);
        };
        let plane = plane_axes(values.text("plane"));
        if let Some(flat) = setting.cell.flat_axis().filter(|a| plane.contains(a)) {
            return Err(vec![("plane".into(), format!("the cell has no extent along {}", AXES[flat]))]);
        }
        let size = values.number_opt("size").unwrap_or(2.0 * setting.mean_diameter);
        let grid = Grid::new(setting.cell, plane.map(|a| Direction::across(setting.cell, a, size)).to_vec());
        few_enough(grid.len())?;
        let shuffles = values.integer("shuffles") as usize;
        let width = 2 * grid.len();
        Ok(Self {
            of,
            plane,
            cycles: cycles as f64,
            seed: setting.seed,
            shuffles,
            last: vec![],
            last_cell: vec![],
            field: Batched::new(width, 16, 1),
            noise: vec![0.0; width * shuffles],
            grid,
        })
    }

    fn columns(&self) -> Vec<Column> {
        vec![
            Column::new("strength_of_sample", "m"),
            Column::new("strength_so_far", "m"),
            Column::new("noise_so_far", "m"),
        ]
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        let path: Vec<Vec3> = (0..g.len()).map(|k| view.unwrapped(k)).collect();
        let cell: Vec<u32> = g.position.iter().map(|&r| self.grid.find(r) as u32).collect();
        let before = std::mem::replace(&mut self.last, path);
        let cell_before = std::mem::replace(&mut self.last_cell, cell);
        if before.len() != self.last.len() {
            return Some(vec![f64::NAN; 3]);
        }
        let chosen: Vec<usize> = (0..g.len()).filter(|&k| self.of.takes(g, k)).collect();
        let moved: Vec<[f64; 2]> = chosen
            .iter()
            .map(|&k| {
                let d = (self.last[k] - before[k]) / self.cycles;
                [d[self.plane[0]], d[self.plane[1]]]
            })
            .collect();

        let mut sample = vec![0.0; 2 * self.grid.len()];
        credit(&mut sample, &chosen, &cell_before, &self.last_cell, &moved);
        let sample_number = self.field.rows();
        self.field.add(&sample);

        let mut dealt = moved;
        for (s, sums) in self.noise.chunks_exact_mut(sample.len()).enumerate() {
            let mut rng = random::stream(self.seed, "convection-shuffle", sample_number * 64 + s as u64);
            for k in (1..dealt.len()).rev() {
                dealt.swap(k, rng.random_range(0..=k));
            }
            credit(sums, &chosen, &cell_before, &self.last_cell, &dealt);
        }
        let n = self.field.rows() as f64;
        Some(vec![norm(&sample), norm(&self.field.total()) / n, self.noise().value])
    }

    fn results(&self) -> Vec<(String, Table)> {
        let j = self.strength();
        let noise = self.noise();
        let excess = (j.value * j.value - noise.value * noise.value).max(0.0).sqrt();
        let [a, b] = [0, 1].map(|k| &self.grid.directions[k]);
        let mut strength = Table::new(&[
            ("strength", "m"),
            ("strength_error", "m"),
            ("noise", "m"),
            ("noise_error", "m"),
            ("excess", "m"),
            ("cell_width", "m"),
            ("cell_height", "m"),
            ("samples", "1"),
            ("cycles", "1"),
        ]);
        let n = self.field.rows() as f64;
        strength.rows.push(vec![
            j.value,
            j.error,
            noise.value,
            noise.error,
            excess,
            a.width,
            b.width,
            n,
            n * self.cycles,
        ]);
        vec![("strength".into(), strength), ("field".into(), self.field_table())]
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let j = self.strength();
        let noise = self.noise().value;
        let [a, b] = [0, 1].map(|k| &self.grid.directions[k]);
        let n = self.field.rows() as f64 * self.cycles;
        let mean = self.field.means();
        let vector = |k: usize| [mean[2 * k].value, mean[2 * k + 1].value];
        let place = |k: usize| [a.centre(k % a.count), b.centre(k / a.count)];
        let size = |v: [f64; 2]| v[0].hypot(v[1]);
        let extent =
            [a.origin, a.origin + a.count as f64 * a.width, b.origin, b.origin + b.count as f64 * b.width];
        let map = Figure {
            title: "Displacement field J".into(),
            caption: format!(
                "Displacements per cycle credited half to the cell left and half to the cell reached (Clément eq. 4.1), summed over \
                 the grains of each cell of {:.2} mm by {:.2} mm and averaged over {n} cycles; cells without grains are left blank. \
                 Strength J = {:.1} ± {:.1} µm per cycle; the noise floor, the same displacements shuffled among the grains, is {:.1} µm.",
                1e3 * a.width,
                1e3 * b.width,
                1e6 * j.value,
                1e6 * j.error,
                1e6 * noise
            ),
            body: Body::Map {
                x: Axis::linear(AXES[a.axis], "m"),
                y: Axis::linear(AXES[b.axis], "m"),
                raster: Some(Raster {
                    shape: [a.count, b.count],
                    extent,
                    values: (0..self.grid.len()).map(|k| blank_if_zero(size(vector(k)))).collect(),
                    label: "|J|".into(),
                    unit: "m".into(),
                }),
                arrows: (0..self.grid.len())
                    .filter(|&k| size(vector(k)) > 0.0)
                    .map(|k| (place(k), vector(k)))
                    .collect(),
                arrow_unit: "m".into(),
                lines: vec![],
            },
        };
        let curve =
            |column: &str, label: &str| super::bed::pairs(series, column).map(|p| Curve::line(label, p));
        let curves = [
            curve("strength_so_far", "J of the mean field so far"),
            curve("noise_so_far", "shuffled displacements").map(|c| c.styled(Style::Dashed)),
        ];
        let history = Figure {
            title: "Strength of the convection".into(),
            caption: "Strength of the field averaged from the first sample on (Clément eq. 4.2). The noise of a mean falls \
                      as one over the square root of the number of cycles, convection does not."
                .into(),
            body: Body::Curves {
                x: Axis::linear("time", "s"),
                y: Axis::log("J per cycle", "m"),
                curves: curves.into_iter().flatten().collect(),
            },
        };
        vec![map, history]
    }
}

/// A cell in which nothing has ever moved holds no grains: no colour.
fn blank_if_zero(x: f64) -> f64 {
    if x > 0.0 { x } else { f64::NAN }
}

impl Convection {
    fn strength(&self) -> Estimate {
        self.field.estimates(1, |sums, n, out| out[0] = norm(sums) / n)[0]
    }

    /// Mean over the shuffles, with its error from their scatter.
    fn noise(&self) -> Estimate {
        let rows = self.field.rows() as f64;
        let each: Vec<f64> = self.noise.chunks_exact(2 * self.grid.len()).map(|s| norm(s) / rows).collect();
        let n = each.len() as f64;
        let mean = each.iter().sum::<f64>() / n;
        let spread: f64 = each.iter().map(|x| (x - mean).powi(2)).sum();
        let error = if each.len() < 2 { f64::NAN } else { (spread / (n * (n - 1.0))).sqrt() };
        Estimate { value: mean, error }
    }

    fn field_table(&self) -> Table {
        let [a, b] = [0, 1].map(|k| &self.grid.directions[k]);
        let (p, q) = (AXES[a.axis], AXES[b.axis]);
        let mut t = Table::new(&[
            (p, "m"),
            (q, "m"),
            (&format!("j_{p}"), "m"),
            (&format!("j_{p}_error"), "m"),
            (&format!("j_{q}"), "m"),
            (&format!("j_{q}_error"), "m"),
        ]);
        let mean = self.field.means();
        t.rows = (0..self.grid.len())
            .map(|k| {
                let (u, v) = (mean[2 * k], mean[2 * k + 1]);
                vec![a.centre(k % a.count), b.centre(k / a.count), u.value, u.error, v.value, v.error]
            })
            .collect();
        t
    }
}

/// Half of each displacement to the cell left, half to the cell reached (Clément eq. 4.1).
fn credit(sums: &mut [f64], grains: &[usize], before: &[u32], now: &[u32], moved: &[[f64; 2]]) {
    for (&k, d) in grains.iter().zip(moved) {
        for cell in [before[k], now[k]] {
            for c in 0..2 {
                sums[2 * cell as usize + c] += 0.5 * d[c];
            }
        }
    }
}

/// Square root of the sum of squares (Clément eq. 4.2).
fn norm(field: &[f64]) -> f64 {
    field.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::vec3;

    fn convection(stage: &Stage) -> Convection {
        let species = [("all".to_string(), stage.grains.len())];
        let mut s = setting(&stage.cell, &species);
        s.sampling = Sampling { interval: 0.1, per_cycle: Some(1), cycles: Some(1), phase: 0.0 };
        Convection::from_values(&values(Convection::KEYS, &[("size", 0.25)]), &s).unwrap()
    }

    #[test]
    fn a_known_displacement_is_split_between_two_cells() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.add(vec3(0.2, 0.5, 0.1), 0.01);
        stage.add(vec3(0.9, 0.5, 0.9), 0.01);
        let mut c = convection(&stage);
        c.observe(&stage.view());
        // The first crosses from cell 0 to cell 1 in x, the second stays in its cell.
        stage.grains.position[0].x += 0.2;
        stage.grains.position[1].z -= 0.1;
        let row = c.observe(&stage.view()).unwrap();
        let expected = (0.1_f64.powi(2) + 0.1_f64.powi(2) + 0.1_f64.powi(2)).sqrt();
        assert!((row[0] - expected).abs() < 1e-15);
        let field = c.field.total();
        assert!((field[0] - 0.1).abs() < 1e-15 && (field[2] - 0.1).abs() < 1e-15);
    }

    #[test]
    fn a_periodic_side_is_no_displacement() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "periodic");
        stage.add(vec3(0.99, 0.5, 0.1), 0.01);
        let mut c = convection(&stage);
        c.observe(&stage.view());
        stage.grains.position[0].x = 0.01;
        stage.grains.image[0][0] = 1;
        let row = c.observe(&stage.view()).unwrap();
        // Two halves of 0.02 in two cells.
        assert!((row[0] - 0.02 / 2.0_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn rolls_stand_out_of_the_noise_and_random_motion_does_not() {
        use rand_distr::{Distribution, Normal};
        let kick = Normal::new(0.0, 1e-3).unwrap();
        for rolling in [0.0, 2e-3] {
            let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
            stage.scatter(800, 0.01, 3);
            let mut c = convection(&stage);
            let mut rng = random::stream(5, "test", 0);
            let home = stage.grains.position.clone();
            c.observe(&stage.view());
            for _ in 0..200 {
                for k in 0..800 {
                    let r = stage.grains.position[k];
                    // Up in the middle, down at the sides; back home half of the way keeps it steady.
                    let up = rolling * (std::f64::consts::TAU * (r.x - 0.25)).sin();
                    stage.grains.position[k] += vec3(kick.sample(&mut rng), 0.0, kick.sample(&mut rng) + up);
                    if (stage.grains.position[k] - home[k]).length() > 0.1 {
                        // A jump home between samples would be a displacement: move the record along.
                        let jump = home[k] - stage.grains.position[k];
                        c.last[k] += jump;
                        stage.grains.position[k] = home[k];
                    }
                }
                c.observe(&stage.view());
            }
            let (j, noise) = (c.strength(), c.noise());
            if rolling == 0.0 {
                // 32 sums of squares: relative scatter of the strength sqrt(1/(2*32)) = 0.125; four of those.
                assert!((j.value / noise.value - 1.0).abs() < 0.5, "{j:?} {noise:?}");
            } else {
                assert!(j.value > 5.0 * noise.value, "{j:?} {noise:?}");
            }
        }
    }
}
