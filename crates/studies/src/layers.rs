//! Profiles of a vibrated layer over its height, in diameters, and what the sources say about their shapes.

use crate::repeats::Repeats;
use crate::runs::column;
use crate::study::Computed;
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_bed::kinetic_theory::{KineticTheory, KineticTheorySpec, Layer, solve};
use brazilnut_runner::Failure;

/// Gravity of the studies, m/s².
pub const GRAVITY: f64 = 9.81;

/// Layers with a smaller solids fraction are left out of what is said about temperatures: hardly more
/// than one grain at a time is in them.
pub const LEAST: f64 = 0.05;

/// Temperature and solids fraction layer by layer.
#[derive(Clone, Debug)]
pub struct Layers {
    /// Heights of the middles, in diameters.
    pub height: Vec<f64>,
    /// W = sqrt(T/(d g)) (Lan 4-1-4), T about the layer's mean at each instant (Lan 3-1-9).
    pub w: Vec<f64>,
    /// Solids fraction.
    pub solids: Vec<f64>,
    /// Share of the mass in the layer and below.
    pub below: Vec<f64>,
}

impl Layers {
    /// From the long-term table of a profile, for grains of `diameter` (m).
    #[must_use]
    pub fn new(table: &Table, diameter: f64) -> Self {
        let w = |t: &f64| (t / (diameter * GRAVITY)).sqrt();
        Self {
            height: column(table, "z").iter().map(|z| z / diameter).collect(),
            w: column(table, "temperature").iter().map(w).collect(),
            solids: column(table, "solids_fraction"),
            below: column(table, "mass_below"),
        }
    }

    /// The profiles averaged over several runs of one bed; a layer that is empty in some of them has the mean of the others.
    #[must_use]
    pub fn mean(of: &[Self]) -> Self {
        let mean = |part: fn(&Self) -> &Vec<f64>| -> Vec<f64> {
            (0..part(&of[0]).len())
                .map(|k| {
                    let x: Vec<f64> = of.iter().map(|l| part(l)[k]).filter(|x| x.is_finite()).collect();
                    x.iter().sum::<f64>() / x.len() as f64
                })
                .collect()
        };
        Self {
            height: mean(|l| &l.height),
            w: mean(|l| &l.w),
            solids: mean(|l| &l.solids),
            below: mean(|l| &l.below),
        }
    }

    /// The layers that hold enough, from below.
    #[must_use]
    pub fn full(&self) -> Vec<usize> {
        (0..self.w.len()).filter(|&k| self.solids[k] >= LEAST && self.w[k].is_finite()).collect()
    }

    /// W in the lowest layer.
    #[must_use]
    pub fn floor(&self) -> f64 {
        self.full().first().map_or(f64::NAN, |&k| self.w[k])
    }

    /// The same over what the theory has at the middle of that layer.
    #[must_use]
    pub fn floor_over(&self, theory: &KineticTheory) -> f64 {
        let height = self.full().first().map_or(f64::NAN, |&k| self.height[k]);
        let l = &theory.layers;
        let above = l.partition_point(|l| l.height < height).clamp(1, l.len() - 1);
        let (a, b) = (&l[above - 1], &l[above]);
        self.floor() / (a.w + (b.w - a.w) * (height - a.height) / (b.height - a.height))
    }

    /// W in the highest layers: the mean of three.
    #[must_use]
    pub fn top(&self) -> f64 {
        let full = self.full();
        let last = &full[full.len().saturating_sub(3)..];
        last.iter().map(|&k| self.w[k]).sum::<f64>() / last.len() as f64
    }

    /// The densest layer.
    #[must_use]
    pub fn densest(&self) -> usize {
        (0..self.solids.len()).max_by(|&a, &b| self.solids[a].total_cmp(&self.solids[b])).unwrap_or(0)
    }

    /// The layer of the least W.
    #[must_use]
    pub fn coldest(&self) -> usize {
        self.full().into_iter().min_by(|&a, &b| self.w[a].total_cmp(&self.w[b])).unwrap_or(0)
    }

    /// Layers from the one of the least W up to the densest.
    #[must_use]
    pub fn coldest_to_densest(&self) -> f64 {
        self.densest() as f64 - self.coldest() as f64
    }

    /// How far W rises above its least value further down, at most, over W at the floor: 0 for a monotonic decrease.
    #[must_use]
    pub fn rise(&self) -> f64 {
        let (mut least, mut rise) = (f64::INFINITY, 0.0_f64);
        for k in self.full() {
            least = least.min(self.w[k]);
            rise = rise.max(self.w[k] - least);
        }
        rise / self.floor()
    }

    /// A curve of W or of the solids fraction over the layers that hold enough.
    #[must_use]
    pub fn curve(&self, label: &str, values: &[f64]) -> Curve {
        Curve::line(label, self.full().into_iter().map(|k| [self.height[k], values[k]]).collect())
    }
}

/// One bed of a study, run from several seeds.
pub struct Bed {
    /// What it is called.
    pub name: String,
    /// Its profiles, seed by seed.
    pub seeds: Vec<Layers>,
    /// Their mean.
    pub mean: Layers,
}

impl Bed {
    /// Reads the profiles of `runs`, of grains of `diameter` (m).
    ///
    /// # Errors
    /// If a table is missing.
    pub fn new(name: String, runs: &Repeats, diameter: f64) -> Result<Self, Failure> {
        let seeds: Vec<Layers> =
            runs.tables("profile-long-term")?.iter().map(|t| Layers::new(t, diameter)).collect();
        Ok(Self { name, mean: Layers::mean(&seeds), seeds })
    }

    /// The mean over the seeds of what `value` finds in the profiles.
    pub fn find(&self, what: &str, value: impl Fn(&Layers) -> f64) -> Computed {
        let values: Vec<f64> = self.seeds.iter().map(value).collect();
        Computed::mean(format!("{what}, {}", self.name), &values)
    }
}

/// The kinetic theory of a layer of `hold_up` over a floor of `boundary_velocity` V_b, restitution 0.9
/// throughout; lengths in diameters. Its own study is `lan-kinetic-theory`.
#[must_use]
pub fn theory(hold_up: f64, boundary_velocity: f64) -> KineticTheory {
    let spec = KineticTheorySpec {
        gravity: GRAVITY,
        diameter: 1.0,
        hold_up,
        cell_height: None,
        floor_velocity: boundary_velocity * GRAVITY.sqrt(),
        restitution: 0.9,
        floor_restitution: 0.9,
        densest: 0.74,
        tolerance: 1e-9,
        points: 400,
    };
    solve(&spec).expect("the study's own parameters are valid")
}

/// Plots of W and of the solids fraction of some beds, simulation as lines, the theory of each dashed.
#[must_use]
pub fn figures(beds: &[(&Bed, Option<KineticTheory>)], caption: &str) -> [Figure; 2] {
    type Part<'a> = (&'a str, fn(&Layers) -> &Vec<f64>, fn(&Layer) -> f64);
    let figure = |title: &str, (label, of, lines): Part<'_>| {
        let mut curves: Vec<Curve> = beds.iter().map(|(b, _)| b.mean.curve(&b.name, of(&b.mean))).collect();
        for (bed, theory) in beds {
            let Some(theory) = theory else { continue };
            let held = theory.layers.iter().filter(|l| l.solids_fraction >= LEAST);
            let line = held.map(|l| [l.height, lines(l)]).collect();
            curves.push(Curve::line(format!("theory, {}", bed.name), line).styled(Style::Dashed));
        }
        let x = Axis::linear("height over diameter", "1");
        let body = Body::Curves { x, y: Axis::linear(label, "1"), curves };
        Figure { title: title.into(), caption: caption.into(), body }
    };
    [
        figure("Granular temperature", ("W", |l| &l.w, |l| l.w)),
        figure("Solids fraction", ("solids fraction", |l| &l.solids, |l| l.solids_fraction)),
    ]
}
