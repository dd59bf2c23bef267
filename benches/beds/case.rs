//! The beds, as the peers run them.

use brazilnut_base::motion::{Harmonic, Motion};
use brazilnut_base::{Cell, Side, Vec3, vec3};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::material::Elastic;
use brazilnut_grains::{
    ContactSpec, DemSpec, Grains, Integrator, Limits, Material, PairSpec, PairTable, Search, WallShape,
    WallSpec,
};
use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};
use std::io::Read;
use std::path::Path;

/// A bed and what is asked of it.
pub struct Case {
    /// A letter.
    pub name: char,
    /// Cell, laws, floor.
    pub spec: DemSpec,
    /// Start state.
    pub grains: Grains,
    /// Steps before the clock starts.
    pub warm: u64,
    /// Steps on the clock.
    pub steps: u64,
    /// Least ratios to the plain sweep and to the fastest peer.
    pub must: [f64; 2],
}

/// Density of the grains of the dense beds, kg/m³.
const DENSITY: f64 = 2500.0;

/// Letter, start state, tiles, steps of warm-up, steps timed, least ratios to the plain sweep and to a peer.
type Bed = (char, &'static str, [usize; 2], u64, u64, [f64; 2]);

/// The table of beds.
const CASES: &[Bed] = &[
    ('A', "A.txt.gz", [1, 1], 20_000, 50_000, [1.1, 2.5]),
    ('B', "bed20k.txt.gz", [1, 1], 500, 1000, [2.0, 2.5]),
    ('C', "bed20k.txt.gz", [5, 2], 100, 100, [1.4, 3.5]),
    ('D', "bed20k.txt.gz", [1, 1], 500, 1000, [1.8, 2.5]),
    ('I', "bed20k.txt.gz", [5, 1], 100, 100, [2.0, 2.5]),
];

impl Case {
    /// Case `name` from the start states in `folder`.
    pub fn read(name: char, folder: &Path) -> Result<Self, Box<dyn Error>> {
        let &(_, file, tiles, warm, steps, must) = CASES
            .iter()
            .find(|c| c.0 == name)
            .ok_or_else(|| format!("there is no case {name}; there are A, B, C, D and I"))?;
        let path = folder.join(file);
        let (mut grains, size) = read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let density = if name == 'A' { 1200.0 } else { DENSITY };
        for k in 0..grains.len() {
            let r = grains.radius[k];
            grains.mass[k] = density * 4.0 / 3.0 * PI * r * r * r;
            grains.inertia[k] = 0.4 * grains.mass[k] * r * r;
        }
        let (grains, size) = tile(&grains, size, tiles);
        let spec = if name == 'A' { dilute(size) } else { dense(name, size) };
        Ok(Self { name, spec, grains, warm, steps, must })
    }
}

impl Case {
    /// The same bed with a sphere ten times as large in its middle, in the place of the grains there.
    pub fn with_intruder(&self) -> Self {
        let mean = self.grains.radius.iter().sum::<f64>() / self.grains.len() as f64;
        let radius = 10.0 * mean;
        let size = self.spec.cell.size;
        let centre = vec3(0.5 * size.x, 0.5 * size.y, 1.2 * radius);
        let mut grains = Grains::default();
        for k in 0..self.grains.len() {
            let r = self.grains.radius[k];
            if (self.grains.position[k] - centre).length() > radius + r {
                grains.push(0, 0, r, self.grains.mass[k], self.grains.inertia[k], self.grains.position[k]);
                let to = grains.len() - 1;
                grains.velocity[to] = self.grains.velocity[k];
                grains.angular_velocity[to] = self.grains.angular_velocity[k];
            }
        }
        let mass = DENSITY * 4.0 / 3.0 * PI * radius.powi(3);
        grains.push(0, 0, radius, mass, 0.4 * mass * radius * radius, centre);
        Self { name: self.name, spec: self.spec.clone(), grains, ..*self }
    }
}

/// 239 smooth elastic grains over a floor of 7 Hz at 9.9 g.
fn dilute(size: [f64; 2]) -> DemSpec {
    let pair = PairSpec { stiffness: Some(2.8e6), restitution: 0.9, ..PairSpec::default() };
    let contact = (NormalLaw::Linear, TangentialLaw::None, pair);
    spec(contact, false, 1200.0, [size[0], size[1], 60.0], 6.3e-5, (0.05, 7.0))
}

/// 20 000 grains, 12 deep, over a floor of 15 Hz at 3 g: D with linear springs and sliding friction,
/// without rotation; else Hertz springs, tangential memory and rotation.
fn dense(name: char, size: [f64; 2]) -> DemSpec {
    let contact = if name == 'D' {
        let pair =
            PairSpec { stiffness: Some(3000.0), restitution: 0.2, friction: 0.2, ..PairSpec::default() };
        (NormalLaw::Linear, TangentialLaw::Coulomb, pair)
    } else {
        let pair = PairSpec { restitution: 0.8, friction: 0.5, ..PairSpec::default() };
        (NormalLaw::Hertz, TangentialLaw::Mindlin, pair)
    };
    spec(contact, name != 'D', DENSITY, [size[0], size[1], 0.5], 2e-6, (0.003_313_202_7, 15.0))
}

fn spec(
    (normal, tangential, pair): (NormalLaw, TangentialLaw, PairSpec),
    rotation: bool,
    density: f64,
    size: [f64; 3],
    dt: f64,
    (amplitude, frequency): (f64, f64),
) -> DemSpec {
    let elastic = Some(Elastic { youngs_modulus: 7e9, poisson_ratio: 0.24 });
    // The peers start from the lowest point: z = A (1 - cos wt).
    let shake =
        Harmonic { amplitude: vec3(0.0, 0.0, amplitude), frequency, phase: vec3(0.0, 0.0, -FRAC_PI_2) };
    DemSpec {
        cell: Cell { size: Vec3::from_array(size), sides: [Side::Periodic, Side::Periodic, Side::Walls] },
        materials: vec![Material { name: "grains".into(), density, elastic }],
        contact: ContactSpec {
            normal,
            tangential,
            rolling: RollingLaw::None,
            pairs: PairTable::uniform(1, pair),
        },
        walls: vec![WallSpec {
            name: "floor".into(),
            shape: WallShape::Plane { point: vec3(0.0, 0.0, amplitude), normal: Vec3::Z },
            material: 0,
            motion: Motion { harmonics: vec![shake], ramp: 0.0 },
        }],
        integrator: Integrator::VelocityVerlet,
        rotation,
        dt,
        limits: Limits::default(),
        search: Search::default(),
    }
}

/// A line `N Lx Ly`, then `x y z vx vy vz wx wy wz radius` per grain, SI.
fn read(path: &Path) -> Result<(Grains, [f64; 2]), Box<dyn Error>> {
    let mut text = String::new();
    flate2::read::GzDecoder::new(std::fs::File::open(path)?).read_to_string(&mut text)?;
    let mut lines = text.lines();
    let head = numbers::<3>(lines.next().ok_or("empty")?)?;
    let mut grains = Grains::default();
    for (k, line) in lines.enumerate() {
        let n = numbers::<10>(line)?;
        grains.push(0, 0, n[9], 0.0, 0.0, vec3(n[0], n[1], n[2]));
        grains.velocity[k] = vec3(n[3], n[4], n[5]);
        grains.angular_velocity[k] = vec3(n[6], n[7], n[8]);
    }
    Ok((grains, [head[1], head[2]]))
}

fn numbers<const N: usize>(line: &str) -> Result<[f64; N], Box<dyn Error>> {
    let all: Vec<f64> = line.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    all.try_into().map_err(|_| format!("`{line}` should hold {N} numbers").into())
}

/// The bed laid `tiles` times side by side.
fn tile(bed: &Grains, size: [f64; 2], tiles: [usize; 2]) -> (Grains, [f64; 2]) {
    let mut all = Grains::default();
    for x in 0..tiles[0] {
        for y in 0..tiles[1] {
            let shift = vec3(x as f64 * size[0], y as f64 * size[1], 0.0);
            for k in 0..bed.len() {
                all.push(0, 0, bed.radius[k], bed.mass[k], bed.inertia[k], bed.position[k] + shift);
                let to = all.len() - 1;
                all.velocity[to] = bed.velocity[k];
                all.angular_velocity[to] = bed.angular_velocity[k];
            }
        }
    }
    (all, [size[0] * tiles[0] as f64, size[1] * tiles[1] as f64])
}
