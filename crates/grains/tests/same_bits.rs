//! The same bits for any number of threads, across stop and resume, and from every sweep.

mod common;

use brazilnut_base::motion::Motion;
use brazilnut_base::{Side, vec3};
use brazilnut_grains::contact::TangentialLaw;
use brazilnut_grains::{Dem, DemSpec, DemState, Grains, Gravity, Integrator, PairSpec, Sweep};
use common::*;
use std::f64::consts::PI;

const R: f64 = 1e-3;
const FIELD: Gravity = Gravity(vec3(0.0, 0.0, -9.81));

/// 1500 grains with friction springs in a cell with periodic sides over a moving floor, cut into blocks;
/// one of them big.
fn bed() -> (DemSpec, Grains) {
    let (k, e) = (2000.0, 0.7);
    let dt = PI * (mass(0.8 * R) / 2.0 / k).sqrt() / 25.0;
    let size = vec3(31.0 * R, 27.0 * R, 200.0 * R);
    let mut s = spec(0.0, Side::Walls, dt, PairSpec { friction: 0.5, ..pair(k, e) });
    s.cell.size = size;
    s.cell.sides = [Side::Periodic, Side::Periodic, Side::Walls];
    s.walls = vec![plane("floor", vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))];
    s.walls[0].motion = Motion::vertical(1e-3, 30.0);
    s.contact.tangential = TangentialLaw::LinearSpring;
    s.rotation = true;
    s.search.block = 300;
    // Pressed together at the start, to have many contacts at once.
    s.limits.overlap = 0.5;
    let mut grains = cloud(1500, R, size, 0.94, 0.3, 11);
    let mut bed = Grains::default();
    let (centre, big) = (vec3(15.0 * R, 13.0 * R, 6.0 * R), 5.0 * R);
    // Room for the big one.
    for k in 0..grains.len() {
        if (grains.position[k] - centre).length() < big + 1.05 * grains.radius[k] {
            grains.position[k].z += 100.0 * R;
        }
        bed.push(0, 0, grains.radius[k], grains.mass[k], grains.inertia[k], grains.position[k]);
        bed.velocity[k] = grains.velocity[k];
        bed.angular_velocity[k] = grains.angular_velocity[k];
    }
    add(&mut bed, big, centre, vec3(0.0, 0.0, 0.0));
    (s, bed)
}

fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}

fn packed(state: &DemState) -> Vec<u8> {
    rmp_serde::to_vec(state).unwrap()
}

#[test]
fn one_two_three_threads_and_a_resume_at_any_step_give_the_same_bits() {
    let (spec, grains) = bed();
    let steps = 400;
    let through = |threads: usize, stop: Option<u64>| {
        pool(threads).install(|| {
            let mut dem = Dem::new(spec.clone()).unwrap();
            let mut state = dem.start(&grains).unwrap();
            let first = stop.unwrap_or(0);
            run(&mut dem, &mut state, 0, first, &FIELD);
            if stop.is_some() {
                // A new process: nothing but the bytes survives.
                let bytes = packed(&state);
                state = rmp_serde::from_slice(&bytes).unwrap();
                dem = Dem::new(spec.clone()).unwrap();
            }
            run(&mut dem, &mut state, first, steps - first, &FIELD);
            packed(&state)
        })
    };
    let unbroken = through(1, None);
    let state: DemState = rmp_serde::from_slice(&unbroken).unwrap();
    assert!(state.counts().builds > 3 && state.counts().prunes > 20, "{:?}", state.counts());
    assert!(state.contact_count() > 100, "{}", state.contact_count());
    for threads in [1, 2, 3] {
        assert!(through(threads, None) == unbroken, "{threads} threads");
        for stop in [1, 97, 255] {
            assert!(through(threads, Some(stop)) == unbroken, "{threads} threads, stopped at {stop}");
        }
    }
}

#[test]
fn every_sweep_gives_the_same_bits() {
    let (mut spec, grains) = bed();
    for integrator in Integrator::ALL {
        let mut all = vec![];
        for sweep in [Sweep::Plain, Sweep::Fast] {
            spec.search.sweep = sweep;
            spec.integrator = *integrator;
            let mut dem = Dem::new(spec.clone()).unwrap();
            let mut state = dem.start(&grains).unwrap();
            run(&mut dem, &mut state, 0, 100, &FIELD);
            all.push(packed(&state));
        }
        assert!(all[0] == all[1], "{integrator:?}");
    }
}

#[test]
fn looking_changes_nothing() {
    let (spec, grains) = bed();
    let through = |look: bool| {
        let mut dem = Dem::new(spec.clone()).unwrap();
        let mut state = dem.start(&grains).unwrap();
        for k in 0..150 {
            run(&mut dem, &mut state, k, 1, &FIELD);
            if look {
                let _ = dem.ledger(&state);
                let _ = export(&dem, &state);
                dem.contacts(&state, |_| {});
            }
        }
        packed(&state)
    };
    assert!(through(true) == through(false));
}
