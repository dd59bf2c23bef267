//! Walls that stand only until the bed has settled.

use brazilnut_base::Vec3;
use brazilnut_case::{Case, build};
use brazilnut_sim::{Plan, Simulation, Stage};
use std::path::PathBuf;

/// A column of grains between four obstacles in the middle of a floor without walls.
const CASE: &str = r#"
model = "dry"

[cell]
size = ["12 mm", "12 mm", "12 mm"]
x = "periodic"
y = "periodic"

[materials.glass]
density = 2500

[[grains]]
name = "glass"
material = "glass"
count = 60
diameter = { mean = "1 mm", spread = 0.1 }
from = ["4 mm", "4 mm", "0 mm"]
to = ["8 mm", "8 mm", "12 mm"]

[start]
placement = "random"

[[obstacles]]
name = "left"
from = ["0 mm", "0 mm", "0 mm"]
to = ["4 mm", "12 mm", "12 mm"]
until_settled = true

[[obstacles]]
name = "right"
from = ["8 mm", "0 mm", "0 mm"]
to = ["12 mm", "12 mm", "12 mm"]
until_settled = true

[[obstacles]]
name = "front"
from = ["4 mm", "0 mm", "0 mm"]
to = ["8 mm", "4 mm", "12 mm"]
until_settled = true

[[obstacles]]
name = "back"
from = ["4 mm", "8 mm", "0 mm"]
to = ["8 mm", "12 mm", "12 mm"]
until_settled = true

[contact]
rotation = false
stiffness = 500
restitution = 0.3
friction = 0.1

[time]
rest_speed = "3 mm/s"
end = "1 ms"
"#;

fn plan() -> Plan {
    let case = Case::parse(CASE, "heap.toml", PathBuf::new(), &[]).unwrap();
    build::build(&case).unwrap().plan
}

/// How far the outermost grain reaches from the middle along x or y, m.
fn reach(run: &mut Simulation) -> f64 {
    let grains = run.grains();
    let off = |r: &Vec3| (r.x - 6e-3).abs().max((r.y - 6e-3).abs());
    grains.position.iter().zip(&grains.radius).map(|(r, a)| off(r) + a).fold(0.0, f64::max)
}

fn freed(run: &Simulation) -> bool {
    !matches!(run.state().stage, Stage::Settling { freed: false, .. })
}

#[test]
fn a_heap_stands_until_its_walls_go_then_spreads_and_rests_before_time_0() {
    let mut run = Simulation::new(plan()).unwrap();
    while !freed(&run) {
        run.step().unwrap();
    }
    // Inside but for the overlap with the walls, at most a few per cent of a radius.
    assert!(reach(&mut run) < 4e-3 / 2.0 + 0.05 * 0.5e-3);
    let first = run.state().settled_after;
    while run.state().stage != Stage::Running {
        run.step().unwrap();
    }
    assert!(reach(&mut run) > 2.5e-3, "the heap spreads by half a diameter at least");
    assert!(run.state().settled_after > first && run.state().step == 0);
    let fastest = run.grains().velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
    // The mean of squares is below that of 3 mm/s; of 60 grains none then exceeds its 8-fold.
    assert!(fastest < 24e-3, "{fastest} m/s at time 0");
}

#[test]
fn a_run_resumed_before_and_after_its_walls_go_takes_the_same_way() {
    let mut whole = Simulation::new(plan()).unwrap();
    let mut parts = Simulation::new(plan()).unwrap();
    for _ in 0..400 {
        whole.step().unwrap();
        parts.step().unwrap();
    }
    parts = Simulation::resume(plan(), parts.state().clone()).unwrap();
    while !freed(&whole) {
        whole.step().unwrap();
        parts.step().unwrap();
    }
    parts = Simulation::resume(plan(), parts.state().clone()).unwrap();
    for _ in 0..400 {
        whole.step().unwrap();
        parts.step().unwrap();
    }
    assert!(freed(&parts));
    assert_eq!(whole.grains().position, parts.grains().position);
}
