//! Sums over the zones at one instant, and what follows from them.

use super::Zones;
use crate::observer::Selection;
use crate::view::{Partner, View};
use brazilnut_base::Vec3;
use serde::{Deserialize, Serialize};

/// Number of sums in a zone.
pub const SUMS: usize = 23;
const MASS: usize = 0;
const MOMENTUM: usize = 1;
const SQUARE: usize = 4;
const FLUCTUATION: usize = 7;
const SPIN: usize = 13;
const VOLUME: usize = 14;
const NUMBER: usize = 15;
const TOUCHES: usize = 16;
const FORCE: usize = 17;

/// Index pairs of the six parts of a symmetric tensor, diagonal first.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// In whose frame places and velocities are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Frame {
    /// The cell's.
    Cell,
    /// The moving floor's.
    Floor,
}

/// Where a grain counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Weight {
    /// In every zone, by the fraction of its volume there (Lan 3.1).
    Volume,
    /// As a whole in the zone that holds its centre (Lan 5, before 5.1).
    Centre,
}

impl Frame {
    /// Displacement and velocity of the frame in the cell.
    #[must_use]
    pub fn moved(self, view: &View) -> (Vec3, Vec3) {
        match self {
            Self::Cell => (Vec3::ZERO, Vec3::ZERO),
            Self::Floor => (view.floor.displacement, view.floor.velocity),
        }
    }
}

/// The sums of all zones at this instant, [`SUMS`] numbers a zone.
///
/// Fluctuations are about the zone's mean velocity at this instant (Lan eq. 3-1-5).
#[must_use]
pub fn at(view: &View, zones: &Zones, of: Selection, frame: Frame, weight: Weight) -> Vec<f64> {
    let g = view.grains;
    let (shift, drift) = frame.moved(view);
    let mut sums = vec![0.0; SUMS * zones.len()];
    let touches = touches(view);
    // Angular momentum and moment of inertia, for the mean spin.
    let mut turn = vec![(Vec3::ZERO, 0.0); zones.len()];
    let mut scratch = vec![];
    for k in (0..g.len()).filter(|&k| of.takes(g, k)) {
        let (v, w) = (g.velocity[k] - drift, g.angular_velocity[k]);
        let volume = zones.body().volume(g.radius[k]);
        let mut add = |zone: usize, part: f64| {
            let s = &mut sums[zone * SUMS..(zone + 1) * SUMS];
            let m = part * g.mass[k];
            s[MASS] += m;
            for a in 0..3 {
                s[MOMENTUM + a] += m * v[a];
                s[SQUARE + a] += m * v[a] * v[a];
            }
            for (c, (a, b)) in PAIRS.into_iter().enumerate() {
                s[FLUCTUATION + c] += m * v[a] * v[b];
            }
            s[SPIN] += part * g.inertia[k] * w.length_squared();
            turn[zone].0 += part * g.inertia[k] * w;
            turn[zone].1 += part * g.inertia[k];
            s[VOLUME] += part * volume;
            s[NUMBER] += part;
            s[TOUCHES] += part * touches[k];
        };
        match weight {
            Weight::Volume => zones.spread(g.position[k] - shift, g.radius[k], &mut scratch, add),
            Weight::Centre => add(zones.find(g.position[k] - shift), 1.0),
        }
    }
    for (s, (l, i)) in sums.chunks_exact_mut(SUMS).zip(turn) {
        if s[MASS] > 0.0 {
            for (c, (a, b)) in PAIRS.into_iter().enumerate() {
                s[FLUCTUATION + c] -= s[MOMENTUM + a] * s[MOMENTUM + b] / s[MASS];
                if a == b {
                    // A zone with one grain has no fluctuation: not even a negative one by rounding.
                    s[FLUCTUATION + c] = s[FLUCTUATION + c].max(0.0);
                }
            }
            s[SPIN] -= if i > 0.0 { l.length_squared() / i } else { 0.0 };
        }
    }
    forces(view, zones, of, shift, &mut sums);
    sums
}

/// Number of contacts of each grain.
fn touches(view: &View) -> Vec<f64> {
    let mut n = vec![0.0; view.grains.len()];
    for c in view.contacts {
        n[c.i as usize] += 1.0;
        if let Partner::Grain(j) = c.with {
            n[j as usize] += 1.0;
        }
    }
    n
}

/// Forces times branches, shared out along the branches; pressure is positive.
fn forces(view: &View, zones: &Zones, of: Selection, shift: Vec3, sums: &mut [f64]) {
    let mut scratch = vec![];
    for c in view.contacts {
        let other = match c.with {
            Partner::Grain(j) => of.takes(view.grains, j as usize),
            Partner::Wall(_) => false,
        };
        if !of.takes(view.grains, c.i as usize) && !other {
            continue;
        }
        let at = view.grains.position[c.i as usize] - shift;
        zones.cut(at, c.branch, &mut scratch, |zone, part| {
            for (n, (a, b)) in PAIRS.into_iter().enumerate() {
                let moment = 0.5 * (c.force[a] * c.branch[b] + c.force[b] * c.branch[a]);
                sums[zone * SUMS + FORCE + n] -= part * moment;
            }
        });
    }
}

/// What follows from the sums of a zone: names and units.
pub const QUANTITIES: &[(&str, &str)] = &[
    ("solids_fraction", "1"),
    ("velocity_x", "m/s"),
    ("velocity_y", "m/s"),
    ("velocity_z", "m/s"),
    ("temperature", "m^2/s^2"),
    ("temperature_x", "m^2/s^2"),
    ("temperature_y", "m^2/s^2"),
    ("temperature_z", "m^2/s^2"),
    ("temperature_rotation", "m^2/s^2"),
    ("temperature_long_term", "m^2/s^2"),
    ("kinetic_energy_density", "J/m^3"),
    ("fluctuation_energy_density", "J/m^3"),
    ("coordination", "1"),
    ("kinetic_stress_xx", "Pa"),
    ("kinetic_stress_yy", "Pa"),
    ("kinetic_stress_zz", "Pa"),
    ("kinetic_stress_xy", "Pa"),
    ("kinetic_stress_xz", "Pa"),
    ("kinetic_stress_yz", "Pa"),
    ("contact_stress_xx", "Pa"),
    ("contact_stress_yy", "Pa"),
    ("contact_stress_zz", "Pa"),
    ("contact_stress_xy", "Pa"),
    ("contact_stress_xz", "Pa"),
    ("contact_stress_yz", "Pa"),
];

/// Definitions behind [`QUANTITIES`], for `describe`.
pub const DEFINITIONS: &str = "sums over samples t >= t0 and grains i, m^ = mass of the part of i inside the zone, V = volume of the zone, n = number of samples\n\
    velocity u = sum m^ v/sum m^ (m/s, Lan 3-1-4); u(t) the same at one instant\n\
    temperature T = sum m^ |v - u(t)|^2/(3 sum m^) (m^2/s^2, Lan 3-1-9; 2 instead of 3 in two dimensions), about the zone's mean at the same instant; \
    a zone that holds N grains misses the part 1/N of it; temperature_a = sum m^ (v_a - u_a(t))^2/sum m^\n\
    temperature_long_term: the same about u, the mean over the run, so that it holds common motion too\n\
    temperature_rotation = sum I^ |w - w(t)|^2/(3 sum m^) (one instead of 3 in two dimensions), w(t) the mean weighted by the moment of inertia I^\n\
    solids_fraction = sum volume inside/(n V) (Lan 3-1-11)\n\
    kinetic_energy_density = sum m^ v^2/(2 n V), fluctuation_energy_density = sum m^ |v - u(t)|^2/(2 n V) (J/m^3, Lan 3-1-10)\n\
    kinetic_stress_ab = sum m^ (v_a - u_a(t)) (v_b - u_b(t))/(n V); contact_stress_ab = -sum over contacts of the symmetric part of f_a l_b/(n V), \
    f the force on a grain, l from its centre to its partner's (or to the contact point on a wall), shared out along l; pressure is positive (Pa)\n\
    coordination: contacts per grain, each grain counted by its part inside\n\
    over the whole cell (table `cell`): the same sums over all zones, fluctuations about the mean of each zone; mass_below: share of the mass in a slab and those below it";

/// The quantities of one zone from its `sums` over `samples` samples. Zones without grains have no velocity (NaN).
pub fn derive(sums: &[f64], samples: f64, volume: f64, flat: bool, out: &mut [f64]) {
    let (m, space) = (sums[MASS], samples * volume);
    let (dims, spins) = if flat { (2.0, 1.0) } else { (3.0, 3.0) };
    let fluctuation = sums[FLUCTUATION] + sums[FLUCTUATION + 1] + sums[FLUCTUATION + 2];
    let square = sums[SQUARE] + sums[SQUARE + 1] + sums[SQUARE + 2];
    let momentum2: f64 = (0..3).map(|a| sums[MOMENTUM + a] * sums[MOMENTUM + a]).sum();
    out[0] = sums[VOLUME] / space;
    for a in 0..3 {
        out[1 + a] = sums[MOMENTUM + a] / m;
        out[5 + a] = sums[FLUCTUATION + a] / m;
    }
    out[4] = fluctuation / (dims * m);
    out[8] = sums[SPIN] / (spins * m);
    out[9] = (square - momentum2 / m) / (dims * m);
    out[10] = 0.5 * square / space;
    out[11] = 0.5 * fluctuation / space;
    out[12] = sums[TOUCHES] / sums[NUMBER];
    for c in 0..6 {
        out[13 + c] = sums[FLUCTUATION + c] / space;
        out[19 + c] = sums[FORCE + c] / space;
    }
}

/// Mass in a zone.
#[must_use]
pub fn mass(sums: &[f64]) -> f64 {
    sums[MASS]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::Stage;
    use crate::view::ContactAt;
    use crate::zones::{Direction, Grid};
    use brazilnut_base::{random, vec3};
    use rand_distr::{Distribution, Normal};

    fn whole(stage: &Stage) -> Zones {
        Zones::Grid(Grid::new(&stage.cell, vec![Direction::across(&stage.cell, 2, 1.0)]))
    }

    #[test]
    fn a_gas_of_known_temperature() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "periodic");
        stage.scatter(20_000, 0.01, 1);
        let mut rng = random::stream(3, "gas", 0);
        let normal = Normal::new(0.0, 1.0).unwrap();
        for v in &mut stage.grains.velocity {
            let mut z = || normal.sample(&mut rng);
            *v = vec3(0.5 * z() + 3.0, z(), 2.0 * z() - 1.0);
        }
        for w in &mut stage.grains.angular_velocity {
            *w = vec3(10.0 * normal.sample(&mut rng) + 4.0, 0.0, 0.0);
        }
        let mut q = [0.0; 25];
        derive(
            &at(&stage.view(), &whole(&stage), Selection::All, Frame::Cell, Weight::Volume),
            1.0,
            1.0,
            false,
            &mut q,
        );
        // Variances of 20000 values: relative error sqrt(2/20000) = 1 %; four of those.
        for (value, exact) in [(q[5], 0.25), (q[6], 1.0), (q[7], 4.0), (q[4], 1.75), (q[9], 1.75)] {
            assert!((value / exact - 1.0).abs() < 0.04, "{value} {exact}");
        }
        // 0.4 r² 100/3
        assert!((q[8] / (0.4 * 1e-4 * 100.0 / 3.0) - 1.0).abs() < 0.04);
        assert!((q[1] - 3.0).abs() < 0.015 && (q[3] + 1.0).abs() < 0.06);
        let filled = 20_000.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-6;
        assert!((q[0] / filled - 1.0).abs() < 1e-12);
        // Ideal-gas pressure rho T along z.
        assert!((q[15] / (1000.0 * filled * 4.0) - 1.0).abs() < 0.04);
        assert!(q[17].abs() < 0.05 * q[15]);
    }

    #[test]
    fn a_lattice_has_its_known_solids_fraction_in_every_slab() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "periodic");
        for k in 0..1000 {
            stage
                .add((vec3(f64::from(k % 10), f64::from(k / 10 % 10), f64::from(k / 100)) + 0.5) * 0.1, 0.05);
        }
        let zones = Zones::Grid(Grid::new(&stage.cell, vec![Direction::across(&stage.cell, 2, 0.1)]));
        let sums = at(&stage.view(), &zones, Selection::All, Frame::Cell, Weight::Volume);
        let mut q = [0.0; 25];
        for s in sums.chunks_exact(SUMS) {
            derive(s, 1.0, zones.volume(0), false, &mut q);
            assert!((q[0] - std::f64::consts::PI / 6.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_column_at_rest_bears_its_weight() {
        // Ten grains stacked with their weights: contact stress zz = force over area, in every slab.
        let mut stage = Stage::new(vec3(0.1, 0.1, 1.0), "walls");
        for k in 0..10 {
            stage.add(vec3(0.05, 0.05, 0.05 + 0.1 * f64::from(k)), 0.05);
        }
        for k in 1..10_u32 {
            stage.contacts.push(ContactAt {
                i: k,
                with: Partner::Grain(k - 1),
                overlap: 1e-9,
                force: vec3(0.0, 0.0, f64::from(10 - k)),
                branch: vec3(0.0, 0.0, -0.1),
            });
        }
        let zones = Zones::Grid(Grid::new(&stage.cell, vec![Direction::across(&stage.cell, 2, 0.1)]));
        let sums = at(&stage.view(), &zones, Selection::All, Frame::Cell, Weight::Volume);
        let mut q = [0.0; 25];
        derive(&sums[5 * SUMS..6 * SUMS], 1.0, zones.volume(0), false, &mut q);
        // Slab 5 holds half of the contact below grain 5 (5 N) and half of the one above it (4 N).
        assert!((q[21] - 4.5 / 0.01).abs() < 1e-9, "{}", q[21]);
        assert_eq!(q[12], 2.0);
    }

    #[test]
    fn a_grain_may_count_where_its_centre_is() {
        // A fifth of the diameter lies in the upper slab; by its centre all of it lies in the lower one.
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.add(vec3(0.5, 0.5, 0.47), 0.05);
        let zones = Zones::Grid(Grid::new(&stage.cell, vec![Direction::across(&stage.cell, 2, 0.5)]));
        let mass = |weight| {
            let sums = at(&stage.view(), &zones, Selection::All, Frame::Cell, weight);
            [super::mass(&sums), super::mass(&sums[SUMS..])].map(|m| m / stage.grains.mass[0])
        };
        // A cap of height h = 0.4 r holds h²(3 - h)/4 of the ball.
        let cap = 0.25 * 0.4 * 0.4 * 2.6;
        let parts = mass(Weight::Volume);
        assert!((parts[0] - (1.0 - cap)).abs() < 1e-12 && (parts[1] - cap).abs() < 1e-12, "{parts:?}");
        assert_eq!(mass(Weight::Centre), [1.0, 0.0]);
    }

    #[test]
    fn the_floor_may_be_the_frame() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.add(vec3(0.5, 0.5, 0.45), 0.05);
        stage.grains.velocity[0].z = 1.0;
        stage.floor.displacement.z = 0.3;
        stage.floor.velocity.z = 0.75;
        let zones = Zones::Grid(Grid::new(&stage.cell, vec![Direction::across(&stage.cell, 2, 0.1)]));
        let sums = at(&stage.view(), &zones, Selection::All, Frame::Floor, Weight::Volume);
        let mut q = [0.0; 25];
        derive(&sums[SUMS..2 * SUMS], 1.0, zones.volume(0), false, &mut q);
        assert!((q[3] - 0.25).abs() < 1e-14);
    }
}
