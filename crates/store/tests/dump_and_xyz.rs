//! The text formats, character by character, and their resumption.

use brazilnut_base::{Cell, Side, Vec3, vec3};
use brazilnut_store::GrainFrame;
use brazilnut_store::dump::Dump;
use brazilnut_store::xyz::Xyz;
use std::fs;

const CELL: Cell =
    Cell { size: Vec3::new(0.02, 0.01, 0.1), sides: [Side::Periodic, Side::Walls, Side::Walls] };

const VELOCITY: [Vec3; 2] = [Vec3::ZERO, Vec3::new(1e-9, -0.5, 2.0)];

fn frame<'a>(step: u64, names: &'a [String], position: &'a [Vec3], omega: &'a [Vec3]) -> GrainFrame<'a> {
    GrainFrame {
        step,
        time: step as f64 * 0.1,
        cell: &CELL,
        species_names: names,
        id: &[7, 3],
        species: &[0, 1],
        position,
        velocity: &VELOCITY,
        angular_velocity: omega,
        radius: &[0.001, 0.0035],
        extra: &[],
    }
}

#[test]
fn a_dump_is_what_lammps_writes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grains.dump");
    let position = [vec3(0.001, 0.002, 0.003), vec3(0.01, 0.005, 0.0035)];
    let mut dump = Dump::create(&path).unwrap();
    dump.append(&frame(5, &[], &position, &[])).unwrap();
    let expected = "\
ITEM: UNITS
si
ITEM: TIME
0.5
ITEM: TIMESTEP
5
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp ff ff
0.0 0.02
0.0 0.01
0.0 0.1
ITEM: ATOMS id type x y z vx vy vz radius
7 1 0.001 0.002 0.003 0.0 0.0 0.0 0.001
3 2 0.01 0.005 0.0035 1e-9 -0.5 2.0 0.0035
";
    assert_eq!(fs::read_to_string(&path).unwrap(), expected);
    let at = dump.length();
    let spin = [vec3(1.0, 2.0, 3.0), Vec3::ZERO];
    dump.append(&frame(6, &[], &position, &spin)).unwrap();
    dump.sync().unwrap();
    let unbroken = fs::read(&path).unwrap();
    assert!(
        String::from_utf8_lossy(&unbroken)
            .contains("radius omegax omegay omegaz\n7 1 0.001 0.002 0.003 0.0 0.0 0.0 0.001 1.0 2.0 3.0\n")
    );
    assert_eq!(String::from_utf8_lossy(&unbroken).matches("ITEM: UNITS").count(), 1);
    drop(dump);
    Dump::resume(&path, at).unwrap().append(&frame(6, &[], &position, &spin)).unwrap();
    assert_eq!(fs::read(&path).unwrap(), unbroken);
}

#[test]
fn xyz_names_its_columns() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grains.xyz");
    let position = [vec3(0.001, 0.002, 0.003), vec3(0.01, 0.005, 0.0035)];
    let names = ["host".to_string(), "big \"one\"".to_string()];
    Xyz::create(&path).unwrap().append(&frame(5, &names, &position, &[])).unwrap();
    let expected = "\
2
Lattice=\"0.02 0 0 0 0.01 0 0 0 0.1\" Origin=\"0 0 0\" pbc=\"T F F\" Properties=species:S:1:id:I:1:pos:R:3:velo:R:3:radius:R:1 Time=0.5 Step=5
host 7 0.001 0.002 0.003 0.0 0.0 0.0 0.001
big__one_ 3 0.01 0.005 0.0035 1e-9 -0.5 2.0 0.0035
";
    assert_eq!(fs::read_to_string(&path).unwrap(), expected);
}

#[test]
fn an_array_of_the_wrong_length_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut dump = Dump::create(&folder.path().join("d")).unwrap();
    let error = dump.append(&frame(0, &[], &[Vec3::ZERO], &[])).unwrap_err().to_string();
    assert!(error.contains("id has 2 entries for 1 grains"), "{error}");
    assert_eq!(dump.length(), 0);
}
