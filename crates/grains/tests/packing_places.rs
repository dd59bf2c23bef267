//! Every way of placing: no overlap, inside the cell, same grains for the same seed, clear refusal.

use brazilnut_base::{Cell, Side, Vec3, vec3};
use brazilnut_grains::Grains;
use brazilnut_grains::packing::{
    Filling, PackingError, Placement, Region, Shape, Sizes, Species, from_list, largest_overlap, read_csv,
    read_extended_xyz,
};

fn species(name: &str, diameter: f64, spread: f64, count: usize) -> Species {
    Species {
        name: name.into(),
        material: 0,
        density: 2500.0,
        sizes: Sizes::Even { mean: diameter, spread },
        count,
        at: vec![],
        velocity: Vec3::ZERO,
        region: None,
    }
}

fn box_of(size: Vec3, x: Side) -> Cell {
    Cell { size, sides: [x, Side::Walls, Side::Walls] }
}

const ALL: [Placement; 4] = [
    Placement::Lattice { gap: 0.05, jitter: 1.0, mixed: true },
    Placement::Random,
    Placement::Expansion,
    Placement::Rain { speed: 0.3, mixed: true },
];

/// Host grains, an intruder set by hand, a wide species kept to one half, an inner wall.
fn crowded(x: Side) -> Filling {
    let mut host = species("host", 2e-3, 0.15, 300);
    host.velocity = vec3(0.1, 0.0, 0.0);
    let mut intruder = species("intruder", 7e-3, 0.0, 1);
    intruder.at = vec![vec3(10e-3, 8e-3, 3.5e-3)];
    let mut coarse = species("coarse", 3e-3, 0.1, 20);
    coarse.region = Some(Region { low: vec3(10e-3, 0.0, 0.0), high: vec3(20e-3, 16e-3, 30e-3) });
    let mut f = Filling::new(box_of(vec3(20e-3, 16e-3, 30e-3), x), vec![host, intruder, coarse], 11);
    f.solids = vec![Region { low: vec3(14e-3, 0.0, 10e-3), high: vec3(15e-3, 16e-3, 30e-3) }];
    f
}

fn check(f: &Filling, g: &Grains) {
    assert_eq!(g.len(), f.count());
    let (overlap, pair) = largest_overlap(&f.cell, g);
    // Touching within 1e-9 of a radius counts as apart.
    assert!(overlap < 2e-9, "{overlap} between {pair:?}");
    for k in 0..g.len() {
        let (r, x) = (g.radius[k], g.position[k]);
        for axis in 0..3 {
            let (low, high) = (f.room.low[axis], f.room.high[axis]);
            match f.cell.sides[axis] {
                Side::Walls => assert!(
                    x[axis] - r >= low - 1e-9 * r && x[axis] + r <= high + 1e-9 * r,
                    "grain {k} at {x}"
                ),
                Side::Periodic => assert!((0.0..high).contains(&x[axis])),
                Side::Flat => assert_eq!(x[axis], 0.5 * high),
            }
        }
        for s in &f.solids {
            assert!((x - x.clamp(s.low, s.high)).length() >= r * (1.0 - 1e-9), "grain {k} in an inner wall");
        }
        if let Some(region) = f.species[usize::from(g.species[k])].region {
            assert!((x - region.low).min_element() >= r * (1.0 - 1e-9));
            assert!((region.high - x).min_element() >= r * (1.0 - 1e-9));
        }
    }
}

#[test]
fn grains_lie_apart_inside_and_where_they_belong() {
    for x in [Side::Walls, Side::Periodic] {
        for p in ALL {
            let mut f = crowded(x);
            if matches!(p, Placement::Lattice { .. }) {
                // Its pitch is that of the coarse grains.
                f.species[0].count = 60;
            }
            let g = p.place(&f).unwrap_or_else(|e| panic!("{p:?}: {e}"));
            check(&f, &g);
            assert_eq!(g.position[f.species[0].count], vec3(10e-3, 8e-3, 3.5e-3));
            let fall = if let Placement::Rain { speed, .. } = p { -speed } else { 0.0 };
            assert_eq!(g.velocity[0], vec3(0.1, 0.0, fall), "{p:?}");
            assert_eq!(g, p.place(&f).unwrap(), "same seed, same grains");
            let other = Filling { seed: 12, ..f.clone() };
            assert_ne!(g.position, p.place(&other).unwrap().position);
        }
    }
}

#[test]
fn flat_cell() {
    let cell = Cell { size: vec3(0.03, 0.002, 0.05), sides: [Side::Periodic, Side::Flat, Side::Walls] };
    let mut f = Filling::new(cell, vec![species("host", 1e-3, 0.1, 300)], 3);
    f.shape = Shape::Cylinder;
    for p in ALL {
        let g = p.place(&f).unwrap_or_else(|e| panic!("{p:?}: {e}"));
        check(&f, &g);
        let r = g.radius[7];
        let m = 2500.0 * std::f64::consts::PI * r * r * 0.002;
        assert!(
            (g.mass[7] / m - 1.0).abs() < 1e-14 && (g.inertia[7] / (0.5 * m * r * r) - 1.0).abs() < 1e-14
        );
    }
}

#[test]
fn expansion_reaches_a_dense_bed() {
    // Solids fraction 0.57: far beyond random insertion, below random close packing.
    let d: f64 = 1e-3;
    let cell = Cell { size: Vec3::splat(10e-3), sides: [Side::Periodic; 3] };
    let n = (0.57 * 1e-6 / (std::f64::consts::PI / 6.0 * d.powi(3))) as usize;
    let f = Filling::new(cell, vec![species("host", d, 0.1, n)], 5);
    check(&f, &Placement::Expansion.place(&f).unwrap());
}

#[test]
fn one_big_grain_among_small_ones() {
    let mut big = species("big", 10e-3, 0.0, 1);
    big.at = vec![Vec3::splat(10e-3)];
    let f = Filling::new(
        box_of(Vec3::splat(20e-3), Side::Walls),
        vec![species("small", 1e-3, 0.1, 3000), big],
        2,
    );
    for p in ALL {
        check(&f, &p.place(&f).unwrap_or_else(|e| panic!("{p:?}: {e}")));
    }
}

#[test]
fn too_many_grains_are_refused_with_the_fraction_reached() {
    let cell = box_of(Vec3::splat(10e-3), Side::Walls);
    // Solids fraction 0.79: beyond any packing of equal spheres.
    let f = Filling::new(cell, vec![species("host", 1e-3, 0.0, 1500)], 5);
    for p in ALL {
        let e = p.place(&f).unwrap_err();
        let PackingError::DoesNotFit { placed, wanted: 1500, reached, needed, .. } = e else {
            panic!("{e:?}")
        };
        assert!(placed < 1500 && reached < needed && (needed - 0.785).abs() < 1e-3, "{p:?} {e}");
        match p {
            // Walls cost random insertion about half a diameter on each side.
            Placement::Random | Placement::Rain { .. } => {
                assert!((0.25..0.4).contains(&reached), "{p:?} {reached}")
            }
            Placement::Lattice { .. } => assert_eq!(placed, 729),
            _ => {}
        }
        assert!(e.to_string().contains("grains fit by") && e.to_string().contains("remedy"));
    }
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let cell = box_of(Vec3::splat(10e-3), Side::Walls);
    let place = |s: Vec<Species>| Placement::Random.place(&Filling::new(cell, s, 1)).unwrap_err();
    assert!(matches!(place(vec![species("a", 11e-3, 0.0, 1)]), PackingError::TooLarge { axis: 'x', .. }));
    let mut out = species("a", 2e-3, 0.0, 1);
    out.at = vec![vec3(0.5e-3, 5e-3, 5e-3)];
    assert!(matches!(place(vec![out]), PackingError::Outside { number: 1, .. }));
    let mut two = species("a", 2e-3, 0.0, 2);
    two.at = vec![vec3(4e-3, 5e-3, 5e-3), vec3(5e-3, 5e-3, 5e-3)];
    let PackingError::Overlap { pair: [0, 1], overlap } = place(vec![two]) else { panic!() };
    assert!((overlap - 1.0).abs() < 1e-12);
}

#[test]
fn exact_fit_of_a_lattice() {
    // Ten grains of 1 mm in 10 mm: rounding of the division must not lose one.
    let f = Filling::new(box_of(Vec3::splat(10e-3), Side::Walls), vec![species("host", 1e-3, 0.0, 1000)], 5);
    check(&f, &Placement::Lattice { gap: 0.0, jitter: 1.0, mixed: true }.place(&f).unwrap());
}

#[test]
fn csv_and_extended_xyz_say_the_same() {
    let f = Filling::new(
        box_of(Vec3::splat(10e-3), Side::Walls),
        vec![species("glass", 2e-3, 0.0, 0), species("steel", 2e-3, 0.0, 0)],
        1,
    );
    let csv = "# m, m/s\nx, y, z, diameter, vx, vy, vz, species, colour\n\
               2e-3, 2e-3, 1e-3, 2e-3, 0, 0, -0.5, steel, red\n5e-3, 5e-3, 5e-3, 1e-3, 1, 0, 0, glass, blue\n";
    let xyz = "2\nLattice=\"0.01 0 0 0 0.01 0 0 0 0.01\" Properties=species:S:1:pos:R:3:radius:R:1:force:R:3:velo:R:3 Time=0\n\
               steel 2e-3 2e-3 1e-3 1e-3 7 7 7 0 0 -0.5\nglass 5e-3 5e-3 5e-3 0.5e-3 7 7 7 1 0 0\n";
    let a = from_list(&f, &read_csv(csv).unwrap()).unwrap();
    assert_eq!(a, from_list(&f, &read_extended_xyz(xyz).unwrap()).unwrap());
    assert_eq!((a.species.clone(), a.radius[0], a.velocity[0]), (vec![1, 0], 1e-3, vec3(0.0, 0.0, -0.5)));
}

#[test]
fn a_broken_file_is_refused_with_its_line() {
    let f = Filling::new(box_of(Vec3::splat(10e-3), Side::Walls), vec![species("glass", 2e-3, 0.0, 0)], 1);
    let csv = |t: &str| read_csv(t).and_then(|l| from_list(&f, &l)).unwrap_err().to_string();
    assert!(csv("x,y\n1,2\n").starts_with("line 1: no column `z`"));
    assert!(
        csv("x,y,z,radius\n5e-3,5e-3,5e-3,1e-3\n1e-3,oops,1e-3,1e-3\n")
            .starts_with("line 3: `oops` is not a number")
    );
    assert!(csv("x,y,z,radius\n5e-3,5e-3,5e-3,-1e-3\n").contains("line 2: the radius"));
    assert!(csv("x,y,z,radius\n5e-3,5e-3,5e-3\n").contains("line"));
    assert!(csv("x,y,z,species\n5e-3,5e-3,5e-3,gold\n").contains("line 2: `gold` is not the name"));
    assert!(csv("x,y,z,radius\n5e-3,5e-3,0,1e-3\n").contains("does not lie inside"));
    assert!(csv("x,y,z,radius\n5e-3,5e-3,5e-3,1e-3\n5e-3,5e-3,6e-3,1e-3\n").contains("grains 0 and 1"));
    let xyz = |t: &str| read_extended_xyz(t).unwrap_err().to_string();
    assert!(xyz("two\n\n").starts_with("line 1"));
    assert!(xyz("1\nno columns\n").starts_with("line 2: no `Properties=`"));
    assert!(xyz("2\nProperties=pos:R:3\n1 2 3\n").starts_with("line 4: 1 of 2 grains are missing"));
}
