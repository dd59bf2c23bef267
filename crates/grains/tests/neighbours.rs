//! No contact is missed, at any speed, in any cell, with any list.

mod common;

use brazilnut_base::motion::Motion;
use brazilnut_base::{Cell, Side, Vec3, vec3};
use brazilnut_grains::{Dem, DemSpec, DemState, Grains, Partner};
use common::*;
use std::collections::BTreeSet;

/// Touching pairs by testing every pair and every image.
fn by_hand(cell: &Cell, g: &Grains) -> Vec<(usize, usize)> {
    let mut all = vec![];
    let images = |axis: usize| if cell.is_periodic(axis) { -1..=1 } else { 0..=0 };
    for i in 0..g.len() {
        for j in i + 1..g.len() {
            for x in images(0) {
                for y in images(1) {
                    for z in images(2) {
                        let shift = cell.size * vec3(f64::from(x), f64::from(y), f64::from(z));
                        if (g.position[i] - g.position[j] - shift).length() < g.radius[i] + g.radius[j] {
                            all.push((i, j));
                        }
                    }
                }
            }
        }
    }
    all.sort_unstable();
    all
}

fn found(dem: &Dem, state: &DemState) -> Vec<(usize, usize)> {
    let mut all = vec![];
    dem.contacts(state, |c| {
        if let Partner::Grain(other) = c.second {
            all.push((c.first.min(other), c.first.max(other)));
        }
    });
    all.sort_unstable();
    all
}

/// Compares every few steps of a hot cloud.
fn compare(spec: DemSpec, grains: &Grains, steps: u64) -> (usize, DemState) {
    let cell = spec.cell;
    let mut dem = Dem::new(spec).unwrap();
    let mut state = dem.start(grains).unwrap();
    let mut seen = 0;
    for k in 0..steps {
        run(&mut dem, &mut state, k, 1, &Nothing);
        if k % 7 != 0 {
            continue;
        }
        let expected = by_hand(&cell, &export(&dem, &state));
        assert_eq!(found(&dem, &state), expected, "step {k}");
        seen += expected.len();
    }
    (seen, state)
}

#[test]
fn cells_and_lists_find_what_testing_all_pairs_finds() {
    let r = 1e-3;
    for (size, sides) in [
        (Vec3::splat(17.0 * r), [Side::Periodic; 3]),
        // Narrow: two images of a pair touch at once; three cells do not fit.
        (vec3(2.2 * r, 40.0 * r, 60.0 * r), [Side::Periodic; 3]),
        (vec3(4.5 * r, 7.0 * r, 150.0 * r), [Side::Periodic, Side::Periodic, Side::Walls]),
        (vec3(40.0 * r, 12.0 * r, 9.0 * r), [Side::Walls; 3]),
    ] {
        let mut s = spec(0.0, Side::Walls, 5e-6, pair(1e4, 0.9));
        s.cell = Cell { size, sides };
        s.walls = box_walls(size);
        for (axis, side) in sides.into_iter().enumerate() {
            if side == Side::Periodic {
                s.walls.retain(|w| !w.name.starts_with(["x", "y", "z"][axis]));
            }
        }
        let n = ((size / (2.05 * r)).floor().element_product() as usize).min(400);
        let grains = cloud(n, 0.97 * r, size, 1.05, 3.0, 2);
        for (all_pairs_below, block) in [(10_000, 100), (0, 100), (0, 37)] {
            s.search.all_pairs_below = all_pairs_below;
            s.search.block = block;
            let (seen, state) = compare(s.clone(), &grains, 60);
            assert!(seen > 50, "{size} {seen}");
            assert!(state.counts().builds > 2, "{size} {:?}", state.counts());
        }
    }
}

/// The outer skin follows the speed: fast grains would use up that of slow ones in a few steps.
#[test]
fn lists_of_fast_grains_last() {
    let (r, size) = (1e-3, Vec3::splat(30e-3));
    let mut s = spec(0.0, Side::Periodic, 5e-6, pair(1e4, 0.9));
    s.cell.size = size;
    let grains = cloud(200, r, size, 2.0, 3.0, 3);
    let builds = |skin: Option<f64>| {
        let mut s = s.clone();
        s.search.skin = skin;
        let (_, state) = compare(s, &grains, 300);
        state.counts().builds
    };
    // 0.15 and 0.45 of a diameter of 0.95 x 2 mm; the first lists are those of slow grains.
    let (slow, fast, tuned) = (builds(Some(0.28e-3)), builds(Some(0.85e-3)), builds(None));
    assert!(fast < slow / 2 && tuned <= fast + 2, "{slow} lists of slow, {fast} of fast grains, {tuned}");
}

#[test]
fn a_big_body_touches_all_that_it_should() {
    let r = 1e-3;
    let size = Vec3::splat(40.0 * r);
    let mut s = spec(0.0, Side::Periodic, 5e-6, pair(1e4, 0.9));
    s.cell.size = size;
    s.search.all_pairs_below = 0;
    s.search.block = 90;
    let mut grains = Grains::default();
    let centre = vec3(1.0 * r, 20.0 * r, 8.0 * r);
    let cloud = cloud(700, r, size, 1.3, 3.0, 7);
    for k in 0..cloud.len() {
        if (s.cell.nearest(cloud.position[k] - centre)).length() > 10.0 * r + cloud.radius[k] {
            add(&mut grains, cloud.radius[k], cloud.position[k], cloud.velocity[k]);
        }
    }
    add(&mut grains, 10.0 * r, centre, vec3(4.0, 0.0, 0.0));
    let big = grains.len() - 1;
    let p = |g: &Grains| (0..g.len()).map(|k| g.mass[k] * g.velocity[k]).sum::<Vec3>();
    let mut dem = Dem::new(s.clone()).unwrap();
    let mut state = dem.start(&grains).unwrap();
    let mut partners = BTreeSet::new();
    for k in 0..150 {
        run(&mut dem, &mut state, k, 1, &Nothing);
        if k % 7 != 0 {
            continue;
        }
        let expected = by_hand(&s.cell, &export(&dem, &state));
        assert_eq!(found(&dem, &state), expected);
        partners.extend(expected.iter().filter(|&&(_, b)| b == big).copied());
    }
    assert!(partners.len() > 20, "{}", partners.len());
    let out = export(&dem, &state);
    // Rounding of 150 steps; the big body carries most of the momentum.
    assert!((p(&out) - p(&grains)).length() < 1e-13 * p(&grains).length());
}

/// Lan's failure (his Fig. 2.2): a grain fast enough to cross a fixed search radius between two updates.
#[test]
fn a_fast_grain_hits_what_stands_in_its_way() {
    let (r, speed, dt) = (1e-3, 200.0, 1e-7);
    let mut s = spec(0.3, Side::Walls, dt, pair(1e6, 1.0));
    s.limits.overlap = 2.0;
    // Neither a wide skin nor a narrow one may matter.
    for (all_pairs_below, skin) in [(0, 2e-4), (1000, 2e-4), (0, 5e-3), (1000, 1e-5)] {
        s.search.all_pairs_below = all_pairs_below;
        s.search.skin = Some(skin);
        let mut grains = Grains::default();
        add(&mut grains, r, vec3(0.01, 0.15, 0.15), vec3(speed, 0.0, 0.0));
        for k in 0..20 {
            add(&mut grains, r, vec3(0.2, 0.15 + 0.01 * f64::from(k - 10), 0.15), Vec3::ZERO);
        }
        let mut dem = Dem::new(s.clone()).unwrap();
        let mut state = dem.start(&grains).unwrap();
        run(&mut dem, &mut state, 0, (0.22 / speed / dt) as u64, &Nothing);
        let out = export(&dem, &state);
        // Head on and elastic: the two exchange their velocities.
        assert!(out.velocity[0].x.abs() < 0.01 * speed, "{}", out.velocity[0]);
        assert!((out.velocity[11].x / speed - 1.0).abs() < 0.01, "{}", out.velocity[11]);
    }
}

/// A grain at rest is hit by a wall that moves fast, though no grain moves.
#[test]
fn a_fast_wall_hits_a_grain_at_rest() {
    let r = 1e-3;
    let mut s = spec(0.3, Side::Walls, 1e-6, pair(1e5, 1.0));
    s.walls = vec![plane("piston", Vec3::ZERO, Vec3::X)];
    // Moves through 0.1 m within a quarter period.
    s.walls[0].motion = Motion::vertical(0.0, 5.0);
    s.walls[0].motion.harmonics[0].amplitude = vec3(0.1, 0.0, 0.0);
    let mut grains = Grains::default();
    add(&mut grains, r, vec3(0.05, 0.1, 0.1), Vec3::ZERO);
    let mut dem = Dem::new(s).unwrap();
    let mut state = dem.start(&grains).unwrap();
    run(&mut dem, &mut state, 0, 30_000, &Nothing);
    let out = export(&dem, &state);
    // Met at x = 0.049: speed of the wall there is A w cos(asin(0.49)).
    let wall = 0.1 * std::f64::consts::TAU * 5.0 * (0.49_f64.asin()).cos();
    // The wall slows by a w² t_c during the contact: 0.3 % of its speed.
    assert!((out.velocity[0].x / (2.0 * wall) - 1.0).abs() < 0.01, "{} {wall}", out.velocity[0].x);
}
