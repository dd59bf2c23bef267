//! Contacts that begin are counted, each once.

mod common;

use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_grains::contact::{NormalLaw, TangentialLaw};
use brazilnut_grains::{Collisions, Dem, DemSpec, Grains, Gravity, PairSpec, Sweep};
use common::*;
use std::f64::consts::PI;

const R: f64 = 1e-3;

fn contact_time(k: f64) -> f64 {
    PI * (0.5 * mass(R) / k).sqrt()
}

/// Collisions after `steps`.
fn counted(spec: &DemSpec, grains: &Grains, steps: u64) -> Collisions {
    let mut dem = Dem::new(spec.clone()).unwrap();
    let mut state = dem.start(grains).unwrap();
    run(&mut dem, &mut state, 0, steps, &Nothing);
    state.collisions()
}

#[test]
fn two_balls_that_circle_meet_once_a_lap() {
    // Elastic equals exchange velocities: as if they passed through each other, and met again once a lap.
    let (k, v, l) = (1e4, 1.0, 0.02);
    let dt = contact_time(k) / 30.0;
    let mut grains = Grains::default();
    add(&mut grains, R, vec3(0.2 * l, 0.5 * l, 0.5 * l), vec3(v, 0.0, 0.0));
    add(&mut grains, R, vec3(0.7 * l, 0.5 * l, 0.5 * l), Vec3::ZERO);
    // Whether lists are short-lived or outlive many laps, whatever the contact remembers.
    for (skin, normal) in
        [(1e-5, NormalLaw::Linear), (2e-3, NormalLaw::Linear), (1e-5, NormalLaw::WaltonBraun)]
    {
        let mut s = spec(l, Side::Periodic, dt, pair(k, 1.0));
        s.contact.normal = normal;
        s.search.skin = Some(skin);
        // They touch at a distance of 2 R, behind as in front; the first way is half a cell, less a diameter.
        let lap = (l - 4.0 * R) / v + contact_time(k);
        let steps = (10.0 * lap / dt) as u64;
        assert_eq!(counted(&s, &grains, steps), Collisions { grains: 10, walls: 0 }, "{skin} {normal:?}");
    }
}

#[test]
fn a_cradle_of_five_hands_on_four_collisions() {
    let (k, v) = (1e5, 0.5);
    let dt = contact_time(k) / 30.0;
    let mut grains = Grains::default();
    // Gaps in which no collision lasts until the next begins.
    let pitch = 2.0 * R + 4.0 * v * contact_time(k);
    for n in 0..5 {
        add(&mut grains, R, vec3(0.02 + f64::from(n) * pitch, 0.05, 0.05), Vec3::ZERO);
    }
    grains.velocity[0].x = v;
    let mut s = spec(0.1, Side::Walls, dt, pair(k, 1.0));
    let steps = (8.0 * pitch / v / dt) as u64;
    for sweep in [Sweep::Plain, Sweep::Fast] {
        s.search.sweep = sweep;
        assert_eq!(counted(&s, &grains, steps), Collisions { grains: 4, walls: 0 });
    }
}

#[test]
fn contacts_that_last_count_once_and_those_at_the_start_not_at_all() {
    let (k, g) = (1e4, 9.81);
    let dt = contact_time(k) / 30.0;
    let sag = mass(R) * g / k;
    let mut s = spec(0.1, Side::Walls, dt, pair(k, 0.2));
    s.cell.sides[..2].fill(Side::Periodic);
    s.walls = vec![plane("floor", Vec3::ZERO, Vec3::Z)];
    let mut grains = Grains::default();
    add(&mut grains, R, vec3(0.05, 0.05, R - 2.0 * sag), Vec3::ZERO);
    add(&mut grains, R, vec3(0.05, 0.05, 3.0 * R - 3.0 * sag), Vec3::ZERO);
    // A third falls on them, and stays.
    add(&mut grains, R, vec3(0.05, 0.05, 5.0 * R - 3.0 * sag + 1e-9), Vec3::ZERO);
    // A fourth, far away, is so fast that lists are made anew all the time.
    add(&mut grains, R, vec3(0.02, 0.02, 0.04), vec3(3.0, 0.0, 1.0));
    let mut dem = Dem::new(s).unwrap();
    let mut state = dem.start(&grains).unwrap();
    run(&mut dem, &mut state, 0, (0.2 / dt) as u64, &Gravity(vec3(0.0, 0.0, -g)));
    assert!(state.counts().builds > 20, "{:?}", state.counts());
    assert_eq!(state.contact_count(), 3);
    assert_eq!(state.collisions(), Collisions { grains: 1, walls: 0 });
}

/// A dilute gas between two walls: collisions of a sphere with others and with the walls.
#[test]
fn a_gas_collides_as_kinetic_theory_says() {
    let (n, l, speed) = (500, 28.0 * R, 1.0);
    let k = 2e4;
    let dt = contact_time(k) / 10.0;
    let mut s = spec(l, Side::Walls, dt, pair(k, 1.0));
    s.cell.sides[..2].fill(Side::Periodic);
    s.walls = box_walls(Vec3::splat(l)).split_off(4);
    let grains = cloud(n, R, Vec3::splat(l), 1.15, speed, 5);
    let mut dem = Dem::new(s).unwrap();
    let mut state = dem.start(&grains).unwrap();
    // Ten collisions of each make the velocities Gaussian.
    let (mixing, steps) = (6_000, 25_000);
    run(&mut dem, &mut state, 0, mixing, &Nothing);
    let before = state.collisions();
    run(&mut dem, &mut state, mixing, steps, &Nothing);
    let after = state.collisions();
    let out = export(&dem, &state);
    let energy: f64 = (0..n).map(|k| out.mass[k] * out.velocity[k].length_squared()).sum();
    let temperature = energy / out.mass.iter().sum::<f64>() / 3.0;
    let time = steps as f64 * dt;
    let d = 2.0 * out.radius.iter().sum::<f64>() / n as f64;
    // The walls keep centres a radius away.
    let free = l - d;
    let number = n as f64 / (l * l * free);
    let nu = number * out.radius.iter().map(|r| 4.0 / 3.0 * PI * r.powi(3)).sum::<f64>() / n as f64;
    let g0 = (2.0 - nu) / (2.0 * (1.0 - nu).powi(3));
    // Lan 4.2 with its dimensions put right: 4 n d² g0 sqrt(pi T) for each sphere. Within a diameter of a
    // wall a quarter of the partners is missing on average.
    let expected = 4.0 * number * d * d * g0 * (PI * temperature).sqrt() * (1.0 - 0.5 * d / free);
    let rate = 2.0 * (after.grains - before.grains) as f64 / n as f64 / time;
    // 1 % scatter, 2 % of the time in contact, some per cent of second order in d/free and in the spread of sizes.
    assert!((rate / expected - 1.0).abs() < 0.05, "{} of {expected} Hz, nu {nu}", rate / expected);
    // The pressure n T Z is what the walls' collisions hand over: n Z sqrt(T/(2 pi)) of them per area and time.
    let z = (1.0 + nu + nu * nu - nu.powi(3)) / (1.0 - nu).powi(3);
    let flux = number * z * (temperature / (2.0 * PI)).sqrt() * 2.0 * l * l;
    let hits = (after.walls - before.walls) as f64 / time;
    // Three times the scatter of some 1500 hits.
    assert!((hits / flux - 1.0).abs() < 0.08, "{} of {flux} Hz", hits / flux);
}

#[test]
fn threads_and_blocks_count_the_same() {
    let l = 40.0 * R;
    let mut s = spec(l, Side::Periodic, 5e-6, PairSpec { friction: 0.3, ..pair(2e3, 0.9) });
    s.contact.tangential = TangentialLaw::LinearSpring;
    s.limits.overlap = 0.9;
    let grains = cloud(1200, R, Vec3::splat(l), 1.3, 1.0, 3);
    let mut all = vec![];
    for (all_pairs_below, block, skin) in
        [(10_000, 100, None), (0, 100, None), (0, 333, Some(5e-5)), (0, 50, Some(1e-3))]
    {
        s.search.all_pairs_below = all_pairs_below;
        s.search.block = block;
        s.search.skin = skin;
        all.push(counted(&s, &grains, 600));
    }
    assert!(all[0].grains > 500, "{all:?}");
    // The order of sums differs with the blocks, and chaos has no time to make that count.
    assert!(all.iter().all(|c| *c == all[0]), "{all:?}");
}
