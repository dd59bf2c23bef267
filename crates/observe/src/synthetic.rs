//! Made-up grains and settings whose measures are known, for tests.

use crate::observer::{Sampling, Setting};
use crate::view::{ContactAt, FlowBalance, FlowView, FluidAt, View, WallAt};
use brazilnut_base::keys::{Absent, Key};
use brazilnut_base::motion::Moved;
use brazilnut_base::values::{Value, Values};
use brazilnut_base::{Cell, PlaneField, Side, Tick, Vec3, random, vec3};
use brazilnut_grains::{Collisions, Grains};
use rand::RngExt;

/// What a view is made from.
pub struct Stage {
    pub cell: Cell,
    pub grains: Grains,
    pub contacts: Vec<ContactAt>,
    pub walls: Vec<WallAt<'static>>,
    pub time: f64,
    pub frequency: f64,
    pub floor: Moved,
    pub names: Vec<String>,
    pub flow: Option<Uniform>,
    pub collisions: Collisions,
}

/// A flow of one velocity and a pressure that rises with x, on a regular grid.
pub struct Uniform {
    pub cells: [usize; 3],
    pub size: Vec3,
    pub velocity: Vec3,
    pub slope: f64,
    pub porosity: f64,
    pub resolved: bool,
}

impl FlowView for Uniform {
    fn velocity(&self, _: Vec3) -> Vec3 {
        self.velocity
    }

    fn pressure(&self, at: Vec3) -> f64 {
        // A part that falls with height too: a base that is not the lid.
        self.slope * at.x - 100.0 * at.z
    }

    fn porosity(&self, _: Vec3) -> f64 {
        self.porosity
    }

    fn is_resolved(&self) -> bool {
        self.resolved
    }

    fn shape(&self) -> [usize; 3] {
        self.cells
    }

    fn centre(&self, c: [usize; 3]) -> Vec3 {
        let n = self.cells.map(|n| n as f64);
        let at = c.map(|c| c as f64 + 0.5);
        self.size * vec3(at[0] / n[0], at[1] / n[1], at[2] / n[2])
    }

    fn streamfunction(&self) -> Option<PlaneField> {
        let shape = [self.cells[0] + 1, self.cells[2] + 1];
        let spacing = [self.size.x / self.cells[0] as f64, self.size.z / self.cells[2] as f64];
        let psi = |c: usize| {
            let (i, j) = ((c % shape[0]) as f64, (c / shape[0]) as f64);
            self.velocity.x * j * spacing[1] - self.velocity.z * i * spacing[0]
        };
        Some(PlaneField { axes: [0, 2], shape, spacing, values: (0..shape[0] * shape[1]).map(psi).collect() })
    }

    fn vorticity(&self) -> Option<PlaneField> {
        let mut omega = self.streamfunction()?;
        omega.values.fill(0.0);
        Some(omega)
    }

    fn balance(&self, _: f64) -> FlowBalance {
        let kinetic = 500.0 * self.velocity.length_squared() * self.size.x * self.size.y * self.size.z;
        FlowBalance { kinetic, dissipation: 0.0, walls: 0.0, body: 0.0, divergence: 0.0, courant: 0.0 }
    }
}

impl Stage {
    /// An empty cell; `sides` are "walls" all round or "periodic" in x and y.
    pub fn new(size: Vec3, sides: &str) -> Self {
        let side = if sides == "periodic" { Side::Periodic } else { Side::Walls };
        Self {
            cell: Cell { size, sides: [side, side, Side::Walls] },
            grains: Grains::default(),
            contacts: vec![],
            walls: vec![],
            time: 0.0,
            frequency: 10.0,
            floor: Moved::default(),
            names: vec!["all".into(), "other".into()],
            flow: None,
            collisions: Collisions::default(),
        }
    }

    /// Adds a grain of density 1000 kg/m³.
    pub fn add(&mut self, at: Vec3, radius: f64) {
        let mass = 1000.0 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        self.grains.push(0, 0, radius, mass, 0.4 * mass * radius * radius, at);
    }

    /// Adds grains anywhere, overlaps allowed.
    pub fn scatter(&mut self, count: usize, radius: f64, seed: u64) {
        let mut rng = random::stream(seed, "scatter", 0);
        for _ in 0..count {
            let at = self.cell.size * vec3(rng.random(), rng.random(), rng.random());
            self.add(at, radius);
        }
    }

    pub fn view(&self) -> View<'_> {
        let tick = Tick { time: self.time, dt: 1e-3, index: (self.time / 1e-3).round() as u64 };
        View {
            tick,
            cycle: self.time * self.frequency,
            frequency: Some(self.frequency),
            cell: &self.cell,
            grains: &self.grains,
            contacts: &self.contacts,
            walls: &self.walls,
            ledger: &[],
            collisions: self.collisions,
            fluid: self.flow.as_ref().map(|f| FluidAt {
                density: 1000.0,
                viscosity: 1e-3,
                flow: Some(f),
                drag: &[],
            }),
            frame: Moved::default(),
            floor: self.floor,
            gravity: vec3(0.0, 0.0, -9.81),
            species: &self.names,
        }
    }
}

/// A setting of `cell` sampled every 10 ms, ten times a cycle.
pub fn setting<'a>(cell: &'a Cell, species: &'a [(String, usize)]) -> Setting<'a> {
    Setting {
        cell,
        species,
        walls: &[],
        ledger: &[],
        frequency: Some(10.0),
        steps_per_cycle: Some(100),
        dt: 1e-3,
        steps: 100_000,
        gravity: vec3(0.0, 0.0, -9.81),
        mean_diameter: 0.02,
        largest_diameter: 0.02,
        has_flow: false,
        seed: 1,
        sampling: Sampling { interval: 0.01, per_cycle: Some(10), cycles: None, phase: 0.0 },
    }
}

/// The defaults of `keys`, with these numbers set.
pub fn values(keys: &[Key], numbers: &[(&str, f64)]) -> Values {
    let mut v = Values::default();
    for k in keys {
        if let Absent::Is(text) = k.absent {
            let value = if let Ok(n) = text.parse::<i64>() {
                Value::Integer(n)
            } else if let Ok(x) = text.parse::<f64>() {
                Value::Number(x)
            } else if text == "true" || text == "false" {
                Value::Flag(text == "true")
            } else if let Some(list) = text.strip_prefix('[') {
                let items =
                    list.trim_end_matches(']').split(',').map(|x| Value::Number(x.trim().parse().unwrap()));
                Value::List(items.collect())
            } else {
                Value::Text(text.trim_matches('"').to_string())
            };
            v.insert(k.name, value, None);
        }
    }
    for (name, x) in numbers {
        assert!(keys.iter().any(|k| k.name == *name), "no key {name}");
        let integer =
            keys.iter().any(|k| k.name == *name && matches!(k.kind, brazilnut_base::keys::Kind::Integer));
        v.insert(name, if integer { Value::Integer(*x as i64) } else { Value::Number(*x) }, None);
    }
    v
}
