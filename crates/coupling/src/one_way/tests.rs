use super::*;
use brazilnut_base::{Cell, Side, vec3};
use brazilnut_bed::bed_equation::Darcy;

fn drag(porosity: Porosity, superficial: Superficial) -> SimpleDrag {
    SimpleDrag {
        equation: BedEquation::Darcy,
        porosity,
        superficial,
        density: 1000.0,
        viscosity: 1e-3,
        diameter: vec![1e-3],
        body: Body::Sphere,
    }
}

fn grain(velocity: Vec3) -> GrainAt {
    GrainAt {
        id: 0,
        species: 0,
        radius: 0.5e-3,
        mass: 1e-6,
        position: vec3(5e-3, 5e-3, 5e-3),
        velocity,
        angular_velocity: Vec3::ZERO,
    }
}

const REST: Still = Still { gravity: Vec3::ZERO, frame: Vec3::ZERO };

#[test]
fn hand_value_of_the_drag() {
    // Darcy at phi 0.5, d 1 mm: K = 3.6e5; V_p = 5.2360e-10; V_p K / 0.5 = 3.7699e-4 kg/s; five digits by hand.
    let d = drag(Porosity::Fixed(0.5), Superficial::U);
    let p = d.field(Darcy, None, REST).push(&Tick::at(0, 1.0), &grain(vec3(0.0, 0.0, 0.01)));
    assert!((p.fluid.z / -3.7699e-6 - 1.0).abs() < 1e-4, "{}", p.fluid);
    let half = drag(Porosity::Fixed(0.5), Superficial::PhiU);
    let q = half.field(Darcy, None, REST).push(&Tick::at(0, 1.0), &grain(vec3(0.0, 0.0, 0.01)));
    assert!((q.fluid.z / p.fluid.z - 0.5).abs() < 1e-14, "Darcy is linear: phi times the drag");
}

#[test]
fn a_frame_in_free_fall_pushes_nothing() {
    let d = drag(Porosity::Fixed(0.42), Superficial::U);
    let g = vec3(0.0, 0.0, -9.81);
    let p = d.field(Darcy, None, Still { gravity: g, frame: g }).push(&Tick::at(0, 1.0), &grain(Vec3::ZERO));
    assert_eq!(p.gravity + p.frame, Vec3::ZERO);
    assert_eq!(p.fluid, Vec3::ZERO);
}

#[test]
fn a_shaken_frame_acts_like_gravity_on_grain_and_fluid() {
    // Eq. 2.57 with g' (3.3): a neutrally buoyant grain feels nothing of either.
    let d = drag(Porosity::Fixed(0.42), Superficial::U);
    let mut g = grain(Vec3::ZERO);
    g.mass = 1000.0 * d.body.volume(g.radius);
    let still = Still { gravity: vec3(0.0, 0.0, -9.81), frame: vec3(1.0, 2.0, 30.0) };
    let p = d.field(Darcy, None, still).push(&Tick::at(0, 1.0), &g);
    let left = p.gravity + p.frame + p.fluid;
    // Rounding of terms of order m g.
    assert!(left.length() < 1e-14 * g.mass * 30.0, "{left}");
}

#[test]
fn local_porosity_keeps_the_volume_of_the_grains() {
    let sides = [Side::Periodic, Side::Walls, Side::Walls];
    let cell = Cell { size: vec3(10e-3, 8e-3, 12e-3), sides };
    let mut map = LocalPorosity::new(&cell, 2e-3);
    let mut grains = Grains::default();
    let r = 0.5e-3;
    for k in 0..50 {
        let t = f64::from(k);
        let x = vec3((t * 0.618).fract() * 10e-3, (t * 0.414).fract() * 8e-3, (t * 0.732).fract() * 12e-3);
        grains.push(0, 0, r, 1.0, 1.0, x);
    }
    map.refresh(&grains, Body::Sphere);
    let volume = cell.size.element_product() / map.values.len() as f64;
    let solids: f64 = map.values.iter().map(|phi| (1.0 - phi) * volume).sum();
    // Only rounding is lost, at walls and across periodic sides too.
    assert!((solids / (50.0 * Body::Sphere.volume(r)) - 1.0).abs() < 1e-12);
}

#[test]
fn drag_forces_are_those_of_the_field() {
    let cell = Cell { size: vec3(10e-3, 10e-3, 10e-3), sides: [Side::Walls; 3] };
    let d = drag(Porosity::Local { spacing: 2e-3, refresh: 5 }, Superficial::U);
    let mut map = d.start(&cell);
    let mut grains = Grains::default();
    grains.push(0, 0, 0.5e-3, 1e-6, 1e-13, vec3(5e-3, 5e-3, 5e-3));
    grains.velocity[0] = vec3(0.1, 0.0, -0.2);
    d.refresh(&mut map, &grains, 0);
    let mut out = vec![];
    d.drag_forces(map.as_ref(), &grains, &mut out);
    let push = d.field(Darcy, map.as_ref(), REST).push(&Tick::at(0, 1.0), &grain(grains.velocity[0]));
    assert_eq!(out, [push.fluid]);
    assert!(out[0].dot(grains.velocity[0]) < 0.0, "drag opposes the motion");
    let before = map.clone();
    grains.position[0].x = 1e-3;
    d.refresh(&mut map, &grains, 3);
    assert_eq!(map, before, "no mapping between the steps for it");
    d.refresh(&mut map, &grains, 5);
    assert_ne!(map, before);
}
