//! What every observer of the menu must satisfy.

use crate::observer::menu::{MENU, Observer, keys};
use crate::observer::{Sampling, Setting};
use crate::synthetic::{Stage, Uniform, setting, values};
use crate::view::{ContactAt, Partner, WallAt};
use crate::watch::COMMON;
use brazilnut_base::values::Value;
use brazilnut_base::{Side, Vec3, random, vec3};
use rand::RngExt;

/// A small bed of two species with contacts and walls, moving at random.
fn stage() -> Stage {
    let mut s = Stage::new(vec3(0.2, 0.1, 0.2), "periodic");
    s.scatter(60, 0.01, 9);
    s.grains.species[59] = 1;
    s.flow = Some(Uniform {
        cells: [10, 5, 10],
        size: s.cell.size,
        velocity: vec3(0.1, 0.0, 0.2),
        slope: 3.0,
        porosity: 0.5,
        resolved: false,
    });
    s.walls.push(WallAt { name: "floor", force: vec3(0.0, 0.0, -1.0), displacement: Vec3::ZERO });
    s.contacts.push(ContactAt {
        i: 0,
        with: Partner::Grain(1),
        overlap: 1e-4,
        force: vec3(0.0, 0.0, 2.0),
        branch: vec3(0.0, 0.0, -0.0199),
    });
    s.contacts.push(ContactAt {
        i: 2,
        with: Partner::Wall(0),
        overlap: 1e-4,
        force: vec3(0.0, 0.0, 1.0),
        branch: vec3(0.0, 0.0, -0.0099),
    });
    s
}

fn advance(s: &mut Stage, sample: u64, interval: f64) {
    let mut rng = random::stream(4, "suite", sample);
    s.time = sample as f64 * interval;
    for k in 0..s.grains.len() {
        let v = vec3(rng.random(), rng.random(), rng.random()) - 0.5;
        s.grains.velocity[k] = v;
        let (r, n) = s.cell.wrap(s.grains.position[k] + 0.01 * v);
        s.grains.position[k] = vec3(r.x, r.y, r.z.clamp(0.0, 0.2));
        for a in 0..3 {
            s.grains.image[k][a] += n[a];
        }
    }
}

fn build(what: &str, setting: &Setting) -> Observer {
    // Short windows, so that they close within the suite's samples.
    let numbers: &[(&str, f64)] = match what {
        "diffusion" => &[("lags", 8.0)],
        "layers" => &[("segment", 16.0)],
        _ => &[],
    };
    let mut v = values(keys(what).unwrap(), numbers);
    if what == "flow" {
        v.insert("low", Value::Vector(Vec3::ZERO), None);
        v.insert("high", Value::Vector(vec3(0.1, 0.1, 0.1)), None);
    }
    if what == "probe" {
        v.insert("at", Value::Vector(Vec3::ZERO), None);
        v.insert("to", Value::Vector(vec3(0.1, 0.1, 0.1)), None);
    }
    if needs_of(what) {
        v.insert("of", Value::Text("other".into()), None);
    }
    Observer::from_values(what, &v, setting).unwrap_or_else(|e| panic!("{what}: {e:?}"))
}

fn needs_of(what: &str) -> bool {
    ["trajectory", "height", "mixing"].contains(&what)
}

fn bytes(o: &Observer) -> Vec<u8> {
    rmp_serde::to_vec(o).unwrap()
}

#[test]
fn a_saved_observer_goes_on_as_if_nothing_had_happened() {
    for entry in MENU {
        let mut stage = stage();
        let species = [("all".to_string(), 59), ("other".to_string(), 1)];
        if entry.name == "streamfunction" {
            stage.cell.sides[1] = Side::Flat;
        }
        let cell = stage.cell;
        let mut setting = setting(&cell, &species);
        let walls = ["floor".to_string()];
        setting.walls = &walls;
        setting.ledger = &["kinetic"];
        let interval = if entry.name == "convection" {
            setting.sampling = Sampling { interval: 0.1, per_cycle: Some(1), cycles: Some(1), phase: 0.0 };
            0.1
        } else {
            0.01
        };
        let mut whole = build(entry.name, &setting);
        for k in 0..37 {
            advance(&mut stage, k, interval);
            let row = whole.observe(&stage.view());
            assert!(row.is_none_or(|r| r.len() == whole.columns().len()), "{}", entry.name);
        }
        let mut resumed: Observer = rmp_serde::from_slice(&bytes(&whole)).unwrap();
        let size = bytes(&whole).len();
        for k in 37..90 {
            advance(&mut stage, k, interval);
            let (a, b) = (whole.observe(&stage.view()), resumed.observe(&stage.view()));
            let same = |x: &[f64], y: &[f64]| x.iter().zip(y).all(|(x, y)| x.to_bits() == y.to_bits());
            assert!(same(&a.unwrap_or_default(), &b.unwrap_or_default()), "{}", entry.name);
        }
        assert_eq!(bytes(&whole), bytes(&resumed), "{}", entry.name);
        // Packed numbers change their length a little; a growing record would grow with the samples.
        assert!(
            bytes(&whole).len() < size + size / 4 + 200,
            "{} grows: {size} to {}",
            entry.name,
            bytes(&whole).len()
        );
        for (name, table) in whole.results() {
            for row in &table.rows {
                assert_eq!(row.len(), table.columns.len(), "{} {name}", entry.name);
            }
        }
        for figure in whole.figures(&brazilnut_base::Table::default()) {
            assert!(!figure.caption.is_empty(), "{}", entry.name);
        }
    }
}

#[test]
fn menu_and_keys_are_in_order() {
    for (k, entry) in MENU.iter().enumerate() {
        assert!(MENU[..k].iter().all(|e| e.name != entry.name), "{} twice", entry.name);
        assert!(!entry.formula.is_empty(), "{} has no definition", entry.name);
        for key in keys(entry.name).unwrap() {
            assert!(COMMON.iter().all(|c| c.name != key.name), "{}.{} is a common key", entry.name, key.name);
        }
    }
}

#[test]
fn a_series_fits_its_columns_and_figures_survive_it() {
    let mut stage = stage();
    let species = [("all".to_string(), 59), ("other".to_string(), 1)];
    let cell = stage.cell;
    let setting = setting(&cell, &species);
    let mut bed = build("bed", &setting);
    advance(&mut stage, 0, 0.01);
    let row = bed.observe(&stage.view()).unwrap();
    let at = |name: &str| row[bed.columns().iter().position(|c| c.name == name).unwrap()];
    let g = &stage.grains;
    let energy: f64 = (0..60).map(|k| 0.5 * g.mass[k] * g.velocity[k].length_squared()).sum();
    assert!((at("kinetic_energy") / energy - 1.0).abs() < 1e-14);
    assert!((at("overlap") - 0.01).abs() < 1e-12 && at("contacts") == 2.0);
    assert!((at("coordination") - 2.0 / 60.0).abs() < 1e-15);
}
