//! Head-on collisions of two steel spheres under three contact laws (Clément 2.1.8, Figs 2.4-2.7).

use crate::study::Computed;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::{Cell, Side, Tick, Vec3, vec3};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::material::{
    Elastic, collide, effective_mass, effective_modulus, effective_radius, hertz_contact_time, hertz_overlap,
    hertz_stiffness, linear_contact_time, linear_damping, linear_restitution,
    linear_stiffness_for_contact_time, viscous_damping, viscous_damping_number,
};
use brazilnut_grains::{
    ContactSpec, Dem, DemSpec, Field, GrainAt, Grains, Integrator, Limits, Material, PairSpec, PairTable,
    Push, Search,
};
use std::f64::consts::PI;

/// Clément Table 2.1: radius, m; density, kg/m³.
const RADIUS: f64 = 0.0127;
const DENSITY: f64 = 8030.0;
const STEEL: Elastic = Elastic { youngs_modulus: 1.93e11, poisson_ratio: 0.35 };
/// What the constants are to give (Clément Table 2.2): restitution and contact time, s, at a speed, m/s.
const RESTITUTION: f64 = 0.879;
const TIME: f64 = 81.3e-6;
const SPEED: f64 = 0.84;
/// Relative impact speeds, m/s.
const SPEEDS: [f64; 7] = [0.2, 0.4, 0.6, 0.84, 1.0, 1.2, 1.4];
/// The default of a case.
const STEPS_PER_CONTACT: f64 = 30.0;
/// Where in a step the spheres touch must not matter: this many places are tried.
const PLACES: usize = 10;
/// Stiffnesses over the one that fits, for Fig. 2.7.
const SOFTER: [f64; 5] = [1.0, 0.1, 0.01, 1e-3, 1e-4];

/// Reduced mass of the two spheres, kg.
fn mass() -> f64 {
    let m = DENSITY * 4.0 / 3.0 * PI * RADIUS.powi(3);
    effective_mass(m, m)
}

/// A law and its constants.
#[derive(Clone, Copy, Debug)]
struct Contact {
    law: NormalLaw,
    stiffness: f64,
    restitution: f64,
    at_speed: f64,
}

impl Contact {
    fn hertz() -> Self {
        let stiffness = hertz_stiffness(effective_radius(RADIUS, RADIUS), effective_modulus(&STEEL, &STEEL));
        Self { law: NormalLaw::Hertz, stiffness, restitution: 1.0, at_speed: SPEED }
    }

    fn linear() -> Self {
        let stiffness = linear_stiffness_for_contact_time(mass(), RESTITUTION, TIME);
        Self { law: NormalLaw::Linear, stiffness, restitution: RESTITUTION, at_speed: SPEED }
    }

    /// The duration goes as k^(-2/5) at a given restitution: both targets are met at once.
    fn damped_hertz() -> Self {
        let k = Self::hertz().stiffness;
        let c = viscous_damping(viscous_damping_number(RESTITUTION), mass(), k, SPEED);
        let stiffness = k * (collide(mass(), k, c, SPEED).duration / TIME).powf(2.5);
        Self { law: NormalLaw::DampedHertz, stiffness, restitution: RESTITUTION, at_speed: SPEED }
    }

    /// Damping, kg/s or kg m^(-1/2) s^(-1).
    fn damping(&self) -> f64 {
        let (m, k, e) = (mass(), self.stiffness, self.restitution);
        match self.law {
            NormalLaw::Linear => linear_damping(m, k, e),
            NormalLaw::DampedHertz => viscous_damping(viscous_damping_number(e), m, k, self.at_speed),
            _ => 0.0,
        }
    }

    /// Restitution, contact time and largest overlap by theory (no overlap for the linear law: not needed).
    fn theory(&self, v: f64) -> (f64, f64, f64) {
        let (m, k, c) = (mass(), self.stiffness, self.damping());
        match self.law {
            NormalLaw::Linear => (linear_restitution(m, k, c), linear_contact_time(m, k, c), f64::NAN),
            NormalLaw::DampedHertz => {
                let s = collide(m, k, c, v);
                (s.restitution, s.duration, s.overlap)
            }
            _ => (1.0, hertz_contact_time(m, k, v), hertz_overlap(m, k, v)),
        }
    }

    fn spec(&self, dt: f64) -> DemSpec {
        let pair = PairSpec {
            stiffness: Some(self.stiffness),
            restitution: self.restitution,
            at_speed: Some(self.at_speed),
            ..PairSpec::default()
        };
        DemSpec {
            cell: Cell { size: Vec3::ONE, sides: [Side::Walls; 3] },
            materials: vec![Material { name: "steel".into(), density: DENSITY, elastic: Some(STEEL) }],
            contact: ContactSpec {
                normal: self.law,
                tangential: TangentialLaw::None,
                rolling: RollingLaw::None,
                pairs: PairTable::uniform(1, pair),
            },
            walls: vec![],
            integrator: Integrator::default(),
            rotation: false,
            dt,
            limits: Limits::default(),
            search: Search::default(),
        }
    }
}

/// No force from outside.
struct Nothing;

impl Field for Nothing {
    fn push(&self, _: &Tick, _: &GrainAt) -> Push {
        Push::default()
    }
}

/// What was seen of one collision.
#[derive(Clone, Debug, Default)]
struct Seen {
    restitution: f64,
    duration: f64,
    /// Largest overlap at a step, m.
    overlap: f64,
    /// Overlap (m) and force (N) at each step in contact.
    path: Vec<[f64; 2]>,
}

/// Two spheres fly at each other with relative speed `v`; they touch `place` of a step after a step.
fn collision(contact: &Contact, v: f64, dt: f64, place: f64) -> Seen {
    let m = 2.0 * mass();
    let gap = (1.0 + place) * v * dt;
    let mut grains = Grains::default();
    for side in [-1.0, 1.0] {
        let x = vec3(0.5 + side * (RADIUS + 0.5 * gap), 0.5, 0.5);
        grains.push(0, 0, RADIUS, m, 0.4 * m * RADIUS * RADIUS, x);
    }
    grains.velocity[0].x = 0.5 * v;
    grains.velocity[1].x = -0.5 * v;
    let mut dem = Dem::new(contact.spec(dt)).expect("the study's own parameters are valid");
    let mut state = dem.start(&grains).expect("two spheres fit");
    let mut seen = Seen::default();
    for step in 0.. {
        dem.advance(&mut state, Tick::at(step, dt), &Nothing);
        dem.contacts(&state, |c| seen.path.push([c.overlap, -c.force.x * (-c.normal.x).signum()]));
        dem.export(&state, &mut grains);
        let apart = grains.position[1].x - grains.position[0].x - 2.0 * RADIUS;
        let away = grains.velocity[1].x - grains.velocity[0].x;
        if apart > 0.0 && away > 0.0 {
            // Free flight since they parted, so the moment of parting follows exactly.
            let parted = (step + 1) as f64 * dt - apart / away;
            seen.duration = parted - gap / v;
            seen.restitution = away / v;
            break;
        }
    }
    seen.overlap = seen.path.iter().map(|p| p[0]).fold(0.0, f64::max);
    seen
}

/// Collisions at all places in a step.
fn collisions(contact: &Contact, v: f64, dt: f64) -> Vec<Seen> {
    (0..PLACES).map(|k| collision(contact, v, dt, k as f64 / PLACES as f64)).collect()
}

/// Mean restitution, contact time and largest overlap over the places.
fn mean(seen: &[Seen]) -> (f64, f64, f64) {
    let n = seen.len() as f64;
    let of = |f: fn(&Seen) -> f64| seen.iter().map(f).sum::<f64>() / n;
    (of(|s| s.restitution), of(|s| s.duration), of(|s| s.overlap))
}

/// The step that a case with these impact speeds would take.
fn step(contact: &Contact) -> f64 {
    let shortest = SPEEDS.iter().map(|&v| contact.theory(v).1).fold(f64::INFINITY, f64::min);
    shortest / STEPS_PER_CONTACT
}

/// Everything seen of one law over the speeds.
struct Row {
    contact: Contact,
    label: &'static str,
    seen: Vec<Vec<Seen>>,
}

impl Row {
    fn new(label: &'static str, contact: Contact) -> Self {
        let dt = step(&contact);
        Self { contact, label, seen: SPEEDS.iter().map(|&v| collisions(&contact, v, dt)).collect() }
    }

    /// Largest distance from theory over speeds and places: of restitution and of contact time, relative.
    fn errors(&self) -> (f64, f64) {
        let (mut e, mut t) = (0.0_f64, 0.0_f64);
        for (seen, v) in self.seen.iter().zip(SPEEDS) {
            let (restitution, duration, _) = self.contact.theory(v);
            for s in seen {
                e = e.max((s.restitution / restitution - 1.0).abs());
                t = t.max((s.duration / duration - 1.0).abs());
            }
        }
        (e, t)
    }

    /// Means at the speed of the targets.
    fn at_target(&self) -> (f64, f64, f64) {
        mean(&self.seen[SPEEDS.iter().position(|&v| v == SPEED).expect("it is one of the speeds")])
    }

    /// A curve of `value` of what was seen, and of theory.
    fn curves(&self, value: fn((f64, f64, f64)) -> f64) -> [Curve; 2] {
        let points = self.seen.iter().zip(SPEEDS).map(|(s, v)| [v, value(mean(s))]).collect();
        let fine = (0..=60).map(|k| 0.2 + 0.02 * f64::from(k));
        let theory = fine.map(|v| [v, value(self.contact.theory(v))]).collect();
        [
            Curve::line(self.label, points),
            Curve::line(format!("{}, theory", self.label), theory).styled(Style::Dashed),
        ]
    }
}

/// Restitution and contact time at 0.84 m/s, simulated.
fn simulated(contact: &Contact) -> (f64, f64) {
    let (e, t, _) = mean(&collisions(contact, SPEED, contact.theory(SPEED).1 / STEPS_PER_CONTACT));
    (e, t)
}

/// What comes of the constants that Clément Table 2.2 prints.
fn printed() -> Vec<Computed> {
    let m = mass();
    let hertz = Contact { stiffness: 1.942e9, ..Contact::hertz() };
    let linear =
        Contact { stiffness: 5.16e7, restitution: linear_restitution(m, 5.16e7, 5.58), ..Contact::linear() };
    let e = collide(m, 1.942e9, 3.41e4, SPEED).restitution;
    let damped = Contact { stiffness: 1.942e9, restitution: e, ..Contact::damped_hertz() };
    let (h, l, d) = (simulated(&hertz), simulated(&linear), simulated(&damped));
    vec![
        Computed::new("printed constants: contact time, hertz", 1e6 * h.1),
        Computed::new("printed constants: restitution, linear", l.0),
        Computed::new("printed constants: contact time, linear", 1e6 * l.1),
        Computed::new("printed constants: restitution, damped hertz", d.0),
        Computed::new("printed constants: contact time, damped hertz", 1e6 * d.1),
    ]
}

/// Contact time over overlap, both over the spheres' own, while the spring softens (Fig. 2.7: e 0.9, 1 m/s).
fn softened(contact: Contact) -> Vec<(f64, f64, f64)> {
    let soft = |&s: &f64| {
        let c = Contact { stiffness: s * contact.stiffness, restitution: 0.9, at_speed: 1.0, ..contact };
        let (_, t, overlap) = mean(&collisions(&c, 1.0, c.theory(1.0).1 / STEPS_PER_CONTACT));
        (c.stiffness, t, overlap)
    };
    SOFTER.iter().map(soft).collect()
}

/// Exponents of contact time and overlap in the stiffness.
fn exponents(soft: &[(f64, f64, f64)]) -> (f64, f64) {
    let (first, last) = (soft[0], soft[soft.len() - 1]);
    let decades = (last.0 / first.0).ln();
    ((last.1 / first.1).ln() / decades, (last.2 / first.2).ln() / decades)
}

/// The quantities and plots; the short form is the full one.
#[must_use]
pub fn run(_quick: bool) -> (Vec<Computed>, Vec<Figure>) {
    let rows = [
        Row::new("hertz", Contact::hertz()),
        Row::new("linear", Contact::linear()),
        Row::new("damped hertz", Contact::damped_hertz()),
    ];
    let [hertz, linear, damped] = &rows;
    let mut computed = vec![
        Computed::new("stiffness, hertz", hertz.contact.stiffness),
        Computed::new("stiffness, linear", linear.contact.stiffness),
        Computed::new("damping, linear", linear.contact.damping()),
        Computed::new("stiffness, damped hertz", damped.contact.stiffness),
        Computed::new("damping, damped hertz", damped.contact.damping()),
        Computed::new("restitution, hertz", hertz.at_target().0),
        Computed::new("contact time, hertz", 1e6 * hertz.at_target().1),
        Computed::new("restitution, linear", linear.at_target().0),
        Computed::new("contact time, linear", 1e6 * linear.at_target().1),
    ];
    for row in &rows {
        let (e, t) = row.errors();
        computed.push(Computed::new(format!("largest error of the restitution, {}", row.label), e));
        computed.push(Computed::new(format!("largest error of the contact time, {}", row.label), t));
    }
    for (seen, v) in damped.seen.iter().zip(SPEEDS) {
        let (e, t, _) = mean(seen);
        computed.push(Computed::new(format!("restitution, damped hertz, {v} m/s"), e));
        computed.push(Computed::new(format!("contact time, damped hertz, {v} m/s"), 1e6 * t));
    }
    computed.extend(printed());
    let soft = [softened(linear.contact), softened(damped.contact)];
    for (s, label) in soft.iter().zip(["linear", "damped hertz"]) {
        let (t, overlap) = exponents(s);
        computed.push(Computed::new(format!("exponent of the contact time in the stiffness, {label}"), t));
        computed.push(Computed::new(format!("exponent of the overlap in the stiffness, {label}"), overlap));
    }
    // The loops are drawn and judged with a fine step: they show the law, not the step.
    let loops =
        rows.each_ref().map(|r| collision(&r.contact, SPEED, r.contact.theory(SPEED).1 / 1000.0, 0.5));
    let ends = |s: &Seen| {
        let most = s.path.iter().map(|p| p[1]).fold(0.0, f64::max);
        (s.path[3][1] / most, s.path[s.path.len() - 4][1] / most)
    };
    computed.push(Computed::new("force at first touch over the largest, linear", ends(&loops[1]).0));
    computed.push(Computed::new("force at the end over the largest, linear", ends(&loops[1]).1));
    computed.push(Computed::new("force at the end over the largest, damped hertz", ends(&loops[2]).1));
    (computed, figures(&rows, &loops, &soft))
}

fn figure(title: &str, caption: &str, [x, y]: [Axis; 2], curves: Vec<Curve>) -> Figure {
    Figure { title: title.into(), caption: caption.into(), body: Body::Curves { x, y, curves } }
}

fn figures(rows: &[Row; 3], loops: &[Seen; 3], soft: &[Vec<(f64, f64, f64)>; 2]) -> Vec<Figure> {
    let paths = rows
        .iter()
        .zip(loops)
        .map(|(r, s)| Curve::line(r.label, s.path.iter().map(|p| [1e6 * p[0], 1e-3 * p[1]]).collect()));
    let target =
        |value| Curve::line("measured, as Table 2.2 says", vec![[SPEED, value]]).styled(Style::Points);
    let over_speed = |value: fn((f64, f64, f64)) -> f64, last: Curve| {
        let mut curves: Vec<Curve> = rows.iter().flat_map(|r| r.curves(value)).collect();
        curves.push(last);
        curves
    };
    let speed = || Axis::linear("relative impact speed", "m/s");
    let softer = soft.iter().zip(["linear", "damped hertz"]);
    let times = softer
        .clone()
        .map(|(s, label)| Curve::line(label, s.iter().map(|p| [p.0 / s[0].0, 1e6 * p.1]).collect()));
    let overlaps =
        softer.map(|(s, label)| Curve::line(label, s.iter().map(|p| [p.0 / s[0].0, p.2 / RADIUS]).collect()));
    let stiffness = || Axis::log("stiffness over that of steel", "1");
    vec![
        figure(
            "Force loops",
            "At 0.84 m/s; the upper branch is the approach (Fig. 2.4). The linear law starts with the dashpot's push and ends with its pull.",
            [Axis::linear("overlap", "µm"), Axis::linear("force", "kN")],
            paths.collect(),
        ),
        figure(
            "Restitution",
            "Means over ten places of the touch in a step, 30 steps per contact (Fig. 2.5).",
            [speed(), Axis::linear("restitution", "1")],
            over_speed(|s| s.0, target(RESTITUTION)),
        ),
        figure(
            "Contact time",
            "The same runs (Fig. 2.6).",
            [speed(), Axis::linear("contact time", "µs")],
            over_speed(|s| 1e6 * s.1, target(1e6 * TIME)),
        ),
        figure(
            "Softer springs: contact time",
            "Restitution 0.9 at 1 m/s (Fig. 2.7).",
            [stiffness(), Axis::log("contact time", "µs")],
            times.collect(),
        ),
        figure(
            "Softer springs: overlap",
            "The same runs (inset of Fig. 2.7): what is gained in time is paid in overlap.",
            [stiffness(), Axis::log("overlap over radius", "1")],
            overlaps.collect(),
        ),
    ]
}
