//! Every combination of the menu through the engine: lanes, ledger, nothing at a distance.

mod common;

use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_grains::contact::laws::fits;
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::material::Elastic;
use brazilnut_grains::{Dem, DemSpec, Grains, Gravity, Material, PairSpec, Sweep};
use common::*;

const RADIUS: f64 = 1e-3;
const SIZE: f64 = 12e-3;

fn all(mut see: impl FnMut(&DemSpec, &str)) {
    for &normal in NormalLaw::ALL {
        for &tangential in TangentialLaw::ALL {
            for &rolling in RollingLaw::ALL {
                if fits(normal, tangential).is_ok() {
                    let name = format!("{} {} {}", normal.name(), tangential.name(), rolling.name());
                    see(&bed(normal, tangential, rolling), &name);
                }
            }
        }
    }
}

/// A box of soft spheres, some forty steps to a contact.
fn bed(normal: NormalLaw, tangential: TangentialLaw, rolling: RollingLaw) -> DemSpec {
    let hertzian = matches!(normal, NormalLaw::Hertz | NormalLaw::DampedHertz);
    let numbers = PairSpec {
        stiffness: (!hertzian).then_some(1e3),
        restitution: 0.8,
        at_speed: Some(0.3),
        friction: 0.4,
        rolling_friction: 0.05,
        ..PairSpec::default()
    };
    let mut s = spec(SIZE, Side::Walls, 5e-6, numbers);
    let elastic = Some(Elastic { youngs_modulus: 1e7, poisson_ratio: 0.25 });
    s.materials = vec![Material { name: "rubber".into(), density: DENSITY, elastic }];
    s.contact.normal = normal;
    s.contact.tangential = tangential;
    s.contact.rolling = rolling;
    s.rotation = true;
    s.walls = box_walls(Vec3::splat(SIZE));
    s
}

fn grains() -> Grains {
    cloud(90, RADIUS, Vec3::splat(SIZE), 1.1, 0.3, 3)
}

#[test]
fn one_lane_and_eight_give_the_same_bits() {
    all(|spec, name| {
        let results = [Sweep::Plain, Sweep::Fast].map(|sweep| {
            let mut spec = spec.clone();
            spec.search.sweep = sweep;
            let mut dem = Dem::new(spec).unwrap();
            let mut state = dem.start(&grains()).unwrap();
            run(&mut dem, &mut state, 0, 300, &Gravity(vec3(0.0, 0.0, -9.81)));
            (bits(&export(&dem, &state)), dem.ledger(&state).lost().to_bits(), state.contact_count())
        });
        assert!(results[0].2 > 5, "{name}: too few contacts to tell");
        assert_eq!(results[0], results[1], "{name}");
    });
}

#[test]
fn the_ledger_closes() {
    all(|spec, name| {
        let mut dem = Dem::new(spec.clone()).unwrap();
        let mut state = dem.start(&grains()).unwrap();
        run(&mut dem, &mut state, 0, 4000, &Gravity(vec3(0.0, 0.0, -9.81)));
        let l = dem.ledger(&state);
        let share = l.residual() / l.initial;
        assert!(l.lost() > 0.2 * l.initial, "{name}: hardly anything was lost: {l:?}");
        // Some hundred collisions of forty steps, each right to second order, (pi/40)².
        assert!(share.abs() < 2e-3, "{name}: residual {share:e} of the energy at the start, {l:?}");
    });
}

#[test]
fn nothing_at_a_distance() {
    all(|spec, name| {
        let mut spec = spec.clone();
        spec.walls.truncate(1);
        let mut dem = Dem::new(spec).unwrap();
        let mut g = Grains::default();
        // A hair's breadth from the wall and from each other.
        let gap = 1e-12;
        add(&mut g, RADIUS, vec3(RADIUS + gap, 5e-3, 5e-3), Vec3::ZERO);
        add(&mut g, RADIUS, vec3(3.0 * RADIUS + 2.0 * gap, 5e-3, 5e-3), Vec3::ZERO);
        g.angular_velocity = vec![vec3(10.0, 20.0, 30.0); 2];
        let mut state = dem.start(&g).unwrap();
        run(&mut dem, &mut state, 0, 5, &Nothing);
        let out = export(&dem, &state);
        assert_eq!(out.velocity, g.velocity, "{name}");
        assert_eq!(out.position, g.position, "{name}");
        // The engine keeps r w: one rounding there and one back.
        let same = |(a, b): (&Vec3, &Vec3)| (*a - *b).length() < 1e-12;
        assert!(out.angular_velocity.iter().zip(&g.angular_velocity).all(same), "{name}");
    });
}
