//! The largest stable step of a packed bed: what its contacts add up to, and when the engine begins to rattle.

mod common;

use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_grains::contact::TangentialLaw;
use brazilnut_grains::material::{
    Across, RELAXED_PER_STEP, damping_ratio, linear_contact_time, linear_damping, packed_step,
    stability_share,
};
use brazilnut_grains::{Dem, DemSpec, DemState, Grains, Gravity, PairSpec, Partner};
use common::{box_walls, cloud, export, mass, pair, run, spec};

const STIFFNESS: f64 = 1500.0;
const RESTITUTION: f64 = 0.2;
const FRICTION: f64 = 0.2;
const RADIUS: f64 = 0.35e-3;
/// Radius of the smallest grain of [`cloud`].
const LEAST: f64 = 0.8 * RADIUS;

/// Gravity that presses the bed together as landing does.
const HEAVY: Gravity = Gravity(vec3(0.0, 0.0, -4.0 * 9.81));

/// Duration of a contact of the smallest pair, s.
fn contact_time() -> f64 {
    let m = 0.5 * mass(LEAST);
    linear_contact_time(m, STIFFNESS, linear_damping(m, STIFFNESS, RESTITUTION))
}

fn bed(steps_per_contact: f64, friction: f64) -> DemSpec {
    let l = 14.0 * RADIUS;
    let numbers = PairSpec { friction, ..pair(STIFFNESS, RESTITUTION) };
    let mut s = spec(l, Side::Walls, contact_time() / steps_per_contact, numbers);
    s.cell.size.z = 4.0 * l;
    s.walls = box_walls(s.cell.size);
    s.contact.tangential = TangentialLaw::Coulomb;
    s
}

/// 400 grains, ten diameters deep, at rest. They settle without friction: with it they creep for long.
fn settled() -> (Dem, DemState) {
    let s = bed(40.0, 0.0);
    let mut dem = Dem::new(s.clone()).unwrap();
    let mut state = dem.start(&cloud(400, RADIUS, s.cell.size, 1.05, 0.05, 3)).unwrap();
    run(&mut dem, &mut state, 0, (0.2 / s.dt) as u64, &HEAVY);
    (dem, state)
}

/// The contacts of a bed: two bodies, normal, effective mass.
fn contacts(dem: &Dem, state: &DemState, grains: &Grains) -> Vec<(usize, Option<usize>, Vec3, f64)> {
    let mut all = vec![];
    dem.contacts(state, |c| {
        let other = match c.second {
            Partner::Grain(j) => Some(j),
            Partner::Wall(_) => None,
        };
        let inverse = 1.0 / grains.mass[c.first] + other.map_or(0.0, |j| 1.0 / grains.mass[j]);
        all.push((c.first, other, c.normal, 1.0 / inverse));
    });
    all
}

/// Largest eigenvalue of M⁻¹(K dt²/4 + C dt) by power iteration: below 1 the bed is stable.
fn stability_sum(dem: &Dem, state: &DemState, dt: f64) -> f64 {
    let grains = export(dem, state);
    let contacts = contacts(dem, state, &grains);
    assert!(contacts.len() > 2 * grains.len(), "a bed has at least four contacts per grain");
    let zeta = damping_ratio(RESTITUTION);
    let any = |k: usize| (k * 7919 % 101) as f64 / 50.0 - 1.0;
    let mut u: Vec<Vec3> = (0..grains.len()).map(|k| vec3(any(k), any(k + 31), any(k + 67))).collect();
    let norm =
        |u: &[Vec3]| u.iter().zip(&grains.mass).map(|(u, m)| m * u.length_squared()).sum::<f64>().sqrt();
    let mut value = 0.0;
    // Power iteration approaches from below; 400 rounds leave less than a hundredth.
    for _ in 0..400 {
        let mut next = vec![Vec3::ZERO; u.len()];
        for &(i, j, n, m) in &contacts {
            let slip = u[i] - j.map_or(Vec3::ZERO, |j| u[j]);
            let along = n.dot(slip) * n;
            let share = stability_share((STIFFNESS / m).sqrt() * dt, zeta);
            let pull = m * (share * along + RELAXED_PER_STEP * (slip - along));
            next[i] += pull / grains.mass[i];
            if let Some(j) = j {
                next[j] -= pull / grains.mass[j];
            }
        }
        value = norm(&next) / norm(&u);
        let scale = 1.0 / norm(&next);
        u = next.into_iter().map(|x| x * scale).collect();
    }
    value
}

/// Steps per contact at which the sum is 1, by bisection.
fn least_steps(dem: &Dem, state: &DemState) -> f64 {
    let (mut rattles, mut quiet) = (4.0, 40.0);
    while quiet - rattles > 0.01 {
        let n = 0.5 * (quiet + rattles);
        if stability_sum(dem, state, contact_time() / n) > 1.0 { rattles = n } else { quiet = n }
    }
    quiet
}

/// Kinetic energy of the bed after 4000 steps from rest, J.
fn noise(rest: &Grains, steps_per_contact: f64) -> f64 {
    let mut dem = Dem::new(bed(steps_per_contact, FRICTION)).unwrap();
    let mut state = dem.start(rest).unwrap();
    for k in 0..4000 {
        dem.advance(&mut state, Tick::at(k, dem.spec().dt), &HEAVY);
    }
    let g = export(&dem, &state);
    (0..g.len()).map(|k| 0.5 * g.mass[k] * g.velocity[k].length_squared()).sum()
}

#[test]
fn a_bed_rattles_beyond_the_step_that_its_contacts_allow() {
    let (dem, state) = settled();
    let least = least_steps(&dem, &state);
    let mut rest = export(&dem, &state);
    rest.velocity.fill(Vec3::ZERO);
    let (quiet, loud) = (noise(&rest, 1.1 * least), noise(&rest, least / 1.1));
    let omega = (2.0 * STIFFNESS / mass(LEAST)).sqrt();
    let rule = contact_time() / packed_step(omega, damping_ratio(RESTITUTION), Across::Coulomb);
    println!(
        "at least {least:.2} steps per contact; a tenth more leaves {quiet:.1e} J, less {loud:.1e} J; rule {rule:.2}"
    );
    // A tenth on the unstable side the rattling grows until contacts open; on the stable side it dies out: six decades.
    assert!(loud > 1e3 * quiet, "quiet {quiet:e}, loud {loud:e}");
    // The rule is for six contacts per grain, isotropic, all as light as the lightest: on the safe side, not far off.
    assert!((1.0..1.5).contains(&(rule / least)), "rule {rule}, network {least}");
}
