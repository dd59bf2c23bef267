//! What bounds the grains, and how they start: every way that a case may name really works.

use brazilnut_base::{Vec3, vec3};
use brazilnut_case::{Case, build};
use brazilnut_grains::{Grains, WallShape};
use brazilnut_sim::plan::Plan;
use brazilnut_sim::{Ended, Simulation};
use std::path::Path;

/// One grain of 2 mm in a box of 20 mm on linear springs; `more` is laid over it.
const ONE: &str = r#"
model = "dry"
gravity = 0.0
[cell]
size = ["20 mm", "20 mm", "20 mm"]
[materials.glass]
density = 2500
[[grains]]
name = "one"
material = "glass"
diameter = "2 mm"
at = ["10 mm", "10 mm", "10 mm"]
[contact]
stiffness = 1e5
restitution = 1.0
friction = 0.0
[time]
settle = "none"
end = "0.02 s"
"#;

fn plan(text: &str, overrides: &[&str]) -> Plan {
    in_folder(text, overrides, Path::new(""))
}

fn in_folder(text: &str, overrides: &[&str], folder: &Path) -> Plan {
    let all: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let case =
        Case::parse(text, "x.toml", folder.into(), &all).unwrap_or_else(|e| panic!("{}", e.render(false)));
    build::build(&case).unwrap_or_else(|e| panic!("{}", e.render(false))).plan
}

fn run(plan: Plan) -> Grains {
    let mut sim = Simulation::new(plan).unwrap();
    while sim.ended() == Ended::No {
        sim.step().unwrap_or_else(|b| panic!("{b}"));
    }
    sim.grains().clone()
}

/// The message that refuses a case.
fn refusal(text: &str, overrides: &[&str]) -> String {
    let all: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let case = Case::parse(text, "x.toml", Path::new("").into(), &all);
    case.and_then(|c| build::build(&c).map(|_| ())).unwrap_err().render(false)
}

/// The sides: name, axis, whether it lies at the far end.
const SIDES: [(&str, usize, bool); 6] = [
    ("left", 0, false),
    ("right", 0, true),
    ("front", 1, false),
    ("back", 1, true),
    ("floor", 2, false),
    ("lid", 2, true),
];

#[test]
fn each_side_moves_on_its_own_and_throws_what_it_hits() {
    for (side, axis, far) in SIDES {
        let inward = if far { -1.0 } else { 1.0 };
        let (mut at, mut direction) = ([10.0; 3], [0.0; 3]);
        at[axis] = if far { 18.999 } else { 1.001 };
        direction[axis] = inward;
        let text = format!(
            "{ONE}[walls.{side}.motion]\nfrequency = \"1 Hz\"\npeak_velocity = \"0.1 m/s\"\ndirection = {direction:?}\n"
        );
        let place = format!("grains.0.at=[\"{} mm\", \"{} mm\", \"{} mm\"]", at[0], at[1], at[2]);
        let plan = plan(&text, &[&place]);
        let moving: Vec<&str> = plan
            .dem
            .walls
            .iter()
            .filter(|w| w.motion.frequency().is_some())
            .map(|w| w.name.as_str())
            .collect();
        assert_eq!(moving, [side]);
        let v = run(plan).velocity[0];
        let mut wanted = Vec3::ZERO;
        wanted[axis] = 0.2 * inward;
        // Elastic: twice the speed of the wall, which falls by cos(2 pi t) - 1 = 2e-4 in a millisecond.
        assert!((v - wanted).length() < 1e-3 * 0.2, "{side}: {v}");
    }
}

#[test]
fn a_grain_hits_each_side_and_comes_back() {
    for (_, axis, far) in SIDES {
        let mut velocity = [0.0; 3];
        velocity[axis] = if far { 1.0 } else { -1.0 };
        let v = run(plan(ONE, &[&format!("grains.0.velocity={velocity:?}")])).velocity[0];
        // Elastic to the order of the integrator, at the default 30 steps per contact.
        assert!((v[axis] + velocity[axis]).abs() < 1e-3, "{v}");
    }
}

#[test]
fn a_rotary_shake_has_three_axes_a_ramp_and_harmonics() {
    let shaking = r#"
[shaking]
of = "floor"
frequency = "50 Hz"
peak_velocity = "0.1 m/s"
direction = [1, 1, 1]
phase = [0, "120 deg", "240 deg"]
ramp = "1 s"
"#;
    let floor = |text: &str| {
        let plan = plan(text, &[]);
        plan.dem.walls.iter().find(|w| w.name == "floor").unwrap().motion.clone()
    };
    let motion = floor(&format!("{ONE}{shaking}"));
    for k in 0..50 {
        // cos² at three phases 120 degrees apart is 3/2 at any time (Lan 2-6-7, 4-1-1).
        let v = motion.at(1.0 + 0.0013 * f64::from(k)).velocity;
        assert!((v.length_squared() / (1.5 * 0.01) - 1.0).abs() < 1e-12, "{v}");
    }
    assert_eq!(motion.at(0.0).velocity, Vec3::ZERO);
    assert!(motion.at(0.2).velocity.length() < 0.5 * 0.1);
    let two = floor(&format!("{ONE}{shaking}harmonics = [{{ order = 3, ratio = 0.5 }}]\n"));
    let difference = two.at(1.004).displacement.x - motion.at(1.004).displacement.x;
    let (a, w) = (0.1 / (std::f64::consts::TAU * 50.0), std::f64::consts::TAU * 150.0);
    assert!((difference - 0.5 * a * (w * 1.004).sin()).abs() < 1e-12 * a);
}

/// A few grains in gravity on a floor that shakes alone.
const BED: &str = r#"
model = "dry"
[cell]
size = ["12 mm", "12 mm", "60 mm"]
[shaking]
of = "floor"
frequency = "50 Hz"
gamma = 3.0
[materials.glass]
density = 2500
[[grains]]
name = "glass"
material = "glass"
count = 60
diameter = "2 mm"
[contact]
stiffness = 1e4
restitution = 0.5
friction = 0.3
[time]
rest_speed = "5 mm/s"
end = "0.1 s"
"#;

#[test]
fn the_shake_starts_when_the_bed_has_settled() {
    for settle in ["until-at-rest", "0.3 s"] {
        let mut sim = Simulation::new(plan(BED, &[&format!("time.settle={settle}")])).unwrap();
        while sim.tick().time < 0.0 {
            sim.step().unwrap();
        }
        // At time 0 the bed is at rest; what springs hold is below the weight times a grain's diameter.
        let l = sim.ledger();
        let weight: f64 = sim.grains().mass.iter().sum::<f64>() * 9.81;
        assert!(l.initial < 0.05 * weight * 2e-3, "{settle}: {} J", l.initial);
        let before = sim.grains().velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
        while sim.tick().time < 0.05 {
            sim.step().unwrap();
        }
        let after = sim.grains().velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
        assert!(before < 0.02 && after > 0.05, "{settle}: {before} then {after}");
    }
}

#[test]
fn a_grain_rests_in_the_pocket_of_a_bumpy_floor() {
    let b: f64 = 1e-3;
    // Distance of a pocket's middle from the bumps' axes: sqrt(2) b of four, 2 b/sqrt(3) of three.
    for (surface, away) in [("bumpy-square", 2.0_f64.sqrt()), ("bumpy-triangular", 2.0 / 3.0_f64.sqrt())] {
        let text = format!("{ONE}[walls.floor]\nsurface = \"{surface}\"\nbump_diameter = \"2 mm\"\n");
        let overrides = [
            "gravity=9.81",
            "grains.0.diameter=3 mm",
            "grains.0.at=[\"9.7 mm\", \"9.6 mm\", \"4 mm\"]",
            "contact.restitution=0.3",
            "time.settle=until-at-rest",
            "time.rest_speed=0.1 mm/s",
            "time.end=1 ms",
        ];
        let z = run(plan(&text, &overrides)).position[0].z;
        let wanted = ((1.5e-3 + b).powi(2) - (away * b).powi(2)).sqrt();
        // Rows of the triangular floor are fitted to the wall: 20 mm hold 11.5 of them, the pitch is off by 4 %.
        let slack = if surface == "bumpy-square" { 2e-3 } else { 0.04 };
        assert!((z / wanted - 1.0).abs() < slack, "{surface}: {z} for {wanted}");
    }
}

#[test]
fn any_side_may_be_bumpy() {
    for (side, axis, far) in SIDES {
        let text = format!("{ONE}[walls.{side}]\nsurface = \"bumpy-square\"\n");
        let plan = plan(&text, &[]);
        let wall = plan.dem.walls.iter().find(|w| w.name == side).unwrap();
        let at_end = if far { 0.02 } else { 0.0 };
        assert!(
            matches!(wall.shape, WallShape::Bumps { axis: a, at, radius, .. } if a == axis && at == at_end && radius == 1e-3),
            "{:?}",
            wall.shape
        );
    }
    let shown = refusal(
        &format!("{ONE}[walls]\nleft = {{ surface = \"bumpy-square\", bump_diameter = \"6 mm\" }}\n"),
        &[],
    );
    assert!(shown.contains("grains fall through the wall `left`"), "{shown}");
}

#[test]
fn a_plate_holds_what_its_hole_lets_through() {
    // A plate 1 mm thick from four boxes around a hole of 4 mm, and boxes side by side without a seam.
    let boxes = [
        ("left", [0.0, 0.0], [8.0, 20.0]),
        ("right", [12.0, 0.0], [20.0, 20.0]),
        ("front", [8.0, 0.0], [12.0, 8.0]),
        ("back", [8.0, 12.0], [12.0, 20.0]),
    ];
    let mut text = ONE.to_string();
    for (name, low, high) in boxes {
        text += &format!(
            "[[obstacles]]\nname = \"plate {name}\"\nfrom = [\"{} mm\", \"{} mm\", \"5 mm\"]\nto = [\"{} mm\", \"{} mm\", \"6 mm\"]\n",
            low[0], low[1], high[0], high[1]
        );
    }
    for (x, y, rests) in [(10.0, 10.0, 1.0), (5.0, 10.0, 7.0), (8.0, 4.0, 7.0)] {
        let place = format!("grains.0.at=[\"{x} mm\", \"{y} mm\", \"10 mm\"]");
        let overrides = ["gravity=9.81", "contact.restitution=0.2", "time.end=0.3 s", &place];
        let z = run(plan(&text, &overrides)).position[0].z;
        // The spring gives by m g/k = 1 nm.
        assert!((1e3 * z - rests).abs() < 1e-3, "({x}, {y}): {z}");
    }
}

#[test]
fn an_obstacle_moves_on_its_own_and_may_go_when_the_bed_has_settled() {
    let paddle = "[[obstacles]]\nname = \"paddle\"\nfrom = [\"2 mm\", \"0 mm\", \"0 mm\"]\nto = [\"4 mm\", \"20 mm\", \"20 mm\"]\nmotion = { frequency = \"1 Hz\", peak_velocity = \"0.1 m/s\", direction = [1, 0, 0] }\n";
    let v = run(plan(&format!("{ONE}{paddle}"), &["grains.0.at=[\"5.001 mm\", \"10 mm\", \"10 mm\"]"]))
        .velocity[0];
    assert!((v - vec3(0.2, 0.0, 0.0)).length() < 1e-3 * 0.2, "{v}");
    let shelf = "[[obstacles]]\nname = \"shelf\"\nfrom = [\"0 mm\", \"0 mm\", \"5 mm\"]\nto = [\"20 mm\", \"20 mm\", \"6 mm\"]\nuntil_settled = true\n";
    let overrides = ["gravity=9.81", "contact.restitution=0.2", "time.settle=0.2 s", "time.end=0.3 s"];
    let z = run(plan(&format!("{ONE}{shelf}"), &overrides)).position[0].z;
    assert!((1e3 * z - 1.0).abs() < 1e-3, "{z}");
}

#[test]
fn motions_that_cannot_be_are_refused() {
    let moved = |side: &str, what: &str| format!("{ONE}[walls.{side}.motion]\nfrequency = 5\n{what}\n");
    let shown = refusal(&moved("left", ""), &[]);
    assert!(shown.contains("`walls.left.motion` does not say how hard"), "{shown}");
    let shown = refusal(&moved("left", "peak_velocity = 1"), &["cell.x=periodic"]);
    assert!(shown.contains("there is no wall `left`"), "{shown}");
    let text = format!(
        "{}[shaking]\nof = \"floor\"\nfrequency = 5\npeak_velocity = 1\n",
        moved("floor", "peak_velocity = 1")
    );
    assert!(refusal(&text, &[]).contains("the floor has two motions"));
}

#[test]
fn every_start_gives_the_grains_asked_for() {
    for placement in ["lattice", "random", "expansion", "rain"] {
        let chosen = format!("start.placement={placement}");
        let plan = plan(BED, &[&chosen, "time.settle=0.5 s", "time.end=1 ms", "shaking.gamma=0"]);
        assert_eq!(plan.start.len(), 60);
        let height = |g: &Grains| g.position.iter().map(|p| p.z).sum::<f64>() / 60.0;
        let before = height(&plan.start);
        let grains = run(plan);
        // Poured: the floor stood still for 0.5 s, in which the grains fell (Lan's tpour).
        assert!(height(&grains) < before, "{placement}");
        let speed = grains.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
        assert!(speed < 0.1, "{placement}: {speed} m/s");
    }
}

#[test]
fn a_start_may_come_from_a_file() {
    let folder = std::env::temp_dir().join(format!("brazilnut-start-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let csv = "x,y,z,radius,vx,vy,vz\n0.005,0.005,0.005,0.001,0.1,0,0\n0.012,0.01,0.009,0.0015,0,-0.2,0\n";
    let xyz = "2\nProperties=species:S:1:pos:R:3:radius:R:1:velo:R:3\none 0.005 0.005 0.005 0.001 0.1 0 0\none 0.012 0.01 0.009 0.0015 0 -0.2 0\n";
    let text = ONE.replace("at = [\"10 mm\", \"10 mm\", \"10 mm\"]", "count = 2");
    for (name, list) in [("start.csv", csv), ("start.xyz", xyz)] {
        std::fs::write(folder.join(name), list).unwrap();
        let file = format!("start.file={name}");
        let start = in_folder(&text, &["start.placement=file", &file], &folder).start;
        assert_eq!(start.position, [vec3(0.005, 0.005, 0.005), vec3(0.012, 0.01, 0.009)], "{name}");
        assert_eq!(start.radius, [0.001, 0.0015], "{name}");
        assert_eq!(start.velocity, [vec3(0.1, 0.0, 0.0), vec3(0.0, -0.2, 0.0)], "{name}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
