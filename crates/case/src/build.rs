//! The only place that assembles parts: from values to a plan.

use crate::case::Case;
use crate::clock::clock;
use crate::contact::{self, Body};
use crate::issue::Issues;
use crate::{check, coupling, parts, walls};
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Side, Vec3};
use brazilnut_coupling::sheet::Sheet;
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::packing::{self, Filling, Placement, Region, Shape, Sizes};
use brazilnut_grains::{
    ContactSpec, DemSpec, Grains, Integrator, Limits, Material, PairSpec, PairTable, Search, WallSpec,
};
use brazilnut_observe::{Setting, Watch};
use brazilnut_sim::clock::Clock;
use brazilnut_sim::plan::{Action, Guards, Medium, Plan, Settle, Shaken, Species};

/// A plan and what `check` says about it.
#[derive(Clone, Debug)]
pub struct Built {
    /// What will run.
    pub plan: Plan,
    /// Numbers for the start-up sheet.
    pub facts: Facts,
}

/// Numbers of the start-up sheet that are known once the parts are assembled.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// Shortest contact, s.
    pub contact_time: f64,
    /// Largest stable step of a packed bed, s.
    pub packed_step: f64,
    /// Speed that contact times and overlaps are quoted for, m/s.
    pub speed: f64,
    /// Largest expected overlap over the smaller diameter at that speed.
    pub overlap: f64,
    /// Shortest Hertz contact time at that speed, if the materials have moduli, s.
    pub hertz_time: Option<f64>,
    /// Shortest Rayleigh time, if the materials have moduli, s.
    pub rayleigh_time: Option<f64>,
    /// Mass of all grains, kg.
    pub mass: f64,
    /// Volume that the grains take, m³.
    pub volume: f64,
    /// Estimated height of the settled bed, m.
    pub height: f64,
    /// Displacement amplitude, m, and frequency, Hz.
    pub shake: Option<(f64, f64)>,
    /// Mean grain diameter, m.
    pub diameter: f64,
    /// Density of the lightest grains, kg/m³.
    pub grain_density: f64,
    /// Speed of the fluid that its step limits are taken at, m/s.
    pub flow_speed: f64,
    /// Density (kg/m³) and viscosity (Pa s) of the fluid.
    pub fluid: Option<(f64, f64)>,
    /// What the numbers of the coupling mean.
    pub coupling: Sheet,
}

/// Assembles the plan of a case that moves grains or a flow.
///
/// # Errors
/// Everything that does not fit together.
pub fn build(case: &Case) -> Result<Built, Issues> {
    let v = &case.values;
    let mut issues = case.issues();
    let Some(cell) = parts::cell(v) else { return Err(issues.sorted()) };
    if v.text("model") == "fluid" {
        return fluid_alone(case, cell);
    }
    let materials = materials(v);
    let Some(contact) = contact::read(v, &materials, &mut issues) else { return Err(issues.sorted()) };
    let start = place(case, &cell, &materials, &mut issues);
    let Some(start) = start else { return Err(issues.sorted()) };
    let walls = walls::walls(v, &cell, &materials);
    let species = species(v, &start);
    let medium = medium(v, &cell, &species, &mut issues);
    let mut facts = facts(v, &cell, &materials, &contact, &start, medium.as_ref(), &mut issues);
    let flow = match &medium {
        Some(Medium::Coupled(_, f) | Medium::Fluid(f)) => Some(&**f),
        _ => None,
    };
    let Some(clock) = clock(v, &facts, flow, &mut issues) else { return Err(issues.sorted()) };
    if let Some(medium) = &medium {
        facts.coupling = coupling::sheet(v, medium, &materials, &species, &start, &clock, &mut issues);
    }
    let dem = DemSpec {
        cell,
        materials,
        contact,
        walls: walls.clone(),
        integrator: v
            .table_opt("time")
            .and_then(|t| Integrator::named(t.text("integrator")))
            .unwrap_or_default(),
        rotation: v.table_opt("contact").is_some_and(|c| c.flag("rotation")),
        dt: clock.grain_dt(),
        limits: Limits { overlap: v.table_opt("limits").map_or(0.3, |l| l.number("overlap")) },
        search: Search::default(),
    };
    let settling_walls = walls::obstacles(v, &dem.materials, true);
    let watches = watches(v, &cell, &clock, &species, &walls, &facts, &mut issues);
    let settle = settle(v, facts.diameter);
    let shaken = match v.table_opt("shaking").map(|s| s.text("of")) {
        Some("floor") => Shaken::Floor,
        _ => Shaken::Cell,
    };
    let plan = Plan {
        cell,
        gravity: parts::gravity(v),
        shaking: parts::shaking(v),
        shaken,
        clock,
        settle,
        dem,
        settling_walls,
        start,
        species,
        // Without a medium there is an issue, and this plan is not returned.
        medium: medium.unwrap_or(Medium::Dry),
        watches,
        guards: guards(v),
    };
    issues.or(Built { plan, facts })
}

/// A flow without grains.
fn fluid_alone(case: &Case, cell: Cell) -> Result<Built, Issues> {
    let v = &case.values;
    let mut issues = case.issues();
    let extent = (0..3).filter(|&a| cell.sides[a] != Side::Flat).map(|a| cell.size[a]);
    let spacing = extent.fold(f64::INFINITY, f64::min) / 64.0;
    let Some(spec) = crate::fluid::grid_fluid(v, &cell, spacing, &mut issues) else {
        return issues.or(()).map(|()| unreachable!("a fluid that cannot be built has an issue"));
    };
    let shaking = parts::shaking(v);
    let facts = Facts {
        contact_time: f64::INFINITY,
        flow_speed: crate::fluid::largest_speed(v)
            .unwrap_or_else(|| crate::fluid::driving_speed(v).max(shaking.peak_speed()).max(1e-6)),
        shake: parts::fundamental(v),
        fluid: Some((spec.density, spec.viscosity)),
        diameter: cell.size.min_element(),
        ..Facts::default()
    };
    let Some(clock) = clock(v, &facts, Some(&spec), &mut issues) else { return Err(issues.sorted()) };
    let contact = ContactSpec {
        normal: NormalLaw::Linear,
        tangential: TangentialLaw::None,
        rolling: RollingLaw::None,
        pairs: PairTable::uniform(1, PairSpec { stiffness: Some(1.0), ..PairSpec::default() }),
    };
    // The grain engine runs empty; it wants a material all the same.
    let dem = DemSpec {
        cell,
        materials: vec![Material { name: "none".into(), density: 1.0, elastic: None }],
        contact,
        walls: vec![],
        integrator: Integrator::default(),
        rotation: false,
        dt: clock.dt,
        limits: Limits::default(),
        search: Search::default(),
    };
    let watches = watches(v, &cell, &clock, &[], &[], &facts, &mut issues);
    let plan = Plan {
        cell,
        gravity: parts::gravity(v),
        shaking,
        shaken: Shaken::Cell,
        clock,
        settle: Settle::None,
        dem,
        settling_walls: vec![],
        start: Grains::default(),
        species: vec![],
        medium: Medium::Fluid(Box::new(spec)),
        watches,
        guards: guards(v),
    };
    issues.or(Built { plan, facts })
}

fn guards(v: &Values) -> Guards {
    let limits = v.table_opt("limits");
    Guards {
        every: limits.map_or(100, |l| l.integer("every").max(1) as u64),
        action: if limits.is_some_and(|l| l.text("action") == "warn") { Action::Warn } else { Action::Stop },
        energy_residual: limits.map_or(0.05, |l| l.number("energy_residual")),
    }
}

/// The materials of the case, then those that only walls name.
fn materials(v: &Values) -> Vec<Material> {
    let mut list: Vec<Material> = v.named("materials").iter().map(|(n, t)| Material::read(n, t)).collect();
    // A wall that is not described is made of what the first grains are made of.
    let like = v
        .tables("grains")
        .next()
        .and_then(|g| g.text_opt("material"))
        .and_then(|m| list.iter().find(|x| x.name == m).cloned())
        .or_else(|| list.first().cloned());
    for name in parts::wall_materials(v) {
        if !list.iter().any(|m| m.name == name) {
            let like = like.clone().unwrap_or(Material { name: String::new(), density: 1.0, elastic: None });
            list.push(Material { name, ..like });
        }
    }
    list
}

/// The grains before the first step.
fn place(case: &Case, cell: &Cell, materials: &[Material], issues: &mut Issues) -> Option<Grains> {
    let v = &case.values;
    let index = |name: &str| materials.iter().position(|m| m.name == name).unwrap_or(0);
    let mut shape = Shape::Sphere;
    let species: Vec<packing::Species> = v
        .tables("grains")
        .map(|g| {
            if g.text("shape") == "cylinder" {
                shape = Shape::Cylinder;
            }
            let material = index(g.text("material"));
            let sizes = g.table_opt("diameter").and_then(|d| Sizes::read(d).ok());
            let at: Vec<Vec3> = g.vector_opt("at").into_iter().collect();
            packing::Species {
                name: g.text("name").to_string(),
                material: material as u16,
                density: materials[material].density,
                sizes: sizes.unwrap_or_else(|| Sizes::single(1e-3)),
                count: g.integer_opt("count").unwrap_or(at.len() as i64).max(0) as usize,
                at,
                velocity: g.vector_opt("velocity").unwrap_or(Vec3::ZERO),
                region: region(g, cell),
            }
        })
        .collect();
    let solids = v
        .tables("obstacles")
        .filter_map(|o| Some(Region { low: o.vector_opt("from")?, high: o.vector_opt("to")? }));
    let filling = Filling {
        shape,
        solids: solids.collect(),
        room: walls::room(v, cell),
        ..Filling::new(*cell, species, v.integer("seed") as u64)
    };
    let start = v.table_opt("start")?;
    let placed = match Placement::read(start) {
        Some(p) => p.place(&filling),
        None => {
            let name = start.text_opt("file")?;
            let path = case.folder.join(name);
            match std::fs::read_to_string(&path) {
                Ok(text) => {
                    let list = if name.ends_with(".csv") {
                        packing::read_csv(&text)
                    } else {
                        packing::read_extended_xyz(&text)
                    };
                    list.and_then(|l| packing::from_list(&filling, &l))
                }
                Err(e) => {
                    issues.add(
                        start.span("file"),
                        "the file of positions cannot be read",
                        format!("{}: {e}", path.display()),
                        "the path is relative to the case",
                    );
                    return None;
                }
            }
        }
    };
    match placed {
        Ok(g) if g.is_empty() => {
            issues.add(v.span("grains"), "there are no grains", "every count is zero", "");
            None
        }
        Ok(g) => Some(g),
        Err(e) => {
            let span = if start.is_written("placement") { start.span("placement") } else { v.span("grains") };
            issues.add(span, "the grains cannot be placed", e.cause(), e.remedy());
            None
        }
    }
}

fn region(g: &Values, cell: &Cell) -> Option<Region> {
    let (low, high) = (g.vector_opt("from"), g.vector_opt("to"));
    if low.is_none() && high.is_none() {
        return None;
    }
    Some(Region { low: low.unwrap_or(Vec3::ZERO), high: high.unwrap_or(cell.size) })
}

/// Contact times over all pairs of the smallest grains of each species, and walls.
fn facts(
    v: &Values,
    cell: &Cell,
    materials: &[Material],
    contact: &ContactSpec,
    grains: &Grains,
    medium: Option<&Medium>,
    issues: &mut Issues,
) -> Facts {
    let kinds = v.tables("grains").count();
    let mut smallest: Vec<Option<Body>> = vec![None; kinds];
    for k in 0..grains.len() {
        let s = &mut smallest[usize::from(grains.species[k])];
        if s.is_none_or(|b| grains.radius[k] < b.radius) {
            *s = Some(Body {
                mass: coupling::contact_mass(medium, grains, k),
                radius: grains.radius[k],
                material: usize::from(grains.material[k]),
            });
        }
    }
    let bodies: Vec<Body> = smallest.into_iter().flatten().collect();
    let wall = |material| Body { mass: f64::INFINITY, radius: f64::INFINITY, material };
    let walls: Vec<Body> = parts::wall_materials(v)
        .iter()
        .filter_map(|n| materials.iter().position(|m| m.name == *n))
        .map(wall)
        .collect();
    let shake = parts::fundamental(v);
    // The fall through the cell is the fastest motion before the shaking, twice the peak speed after.
    let fall = (2.0 * v.number("gravity") * cell.size.z).sqrt();
    let thrown = 2.0 * parts::peak_speed(v);
    let own = grains.velocity.iter().map(|u| u.length()).fold(0.0, f64::max);
    let speed = if thrown > 0.0 { thrown.max(own) } else { fall.max(own) }.max(1e-3);
    let mut f =
        Facts { contact_time: f64::INFINITY, packed_step: f64::INFINITY, speed, shake, ..Facts::default() };
    for (n, a) in bodies.iter().enumerate() {
        for b in bodies[n..].iter().chain(&walls) {
            let Some((time, overlap)) = contact::duration(contact, materials, *a, *b, speed) else {
                let (x, y) = (&materials[a.material].name, &materials[b.material].name);
                let hertz = contact::is_hertz(contact.normal);
                issues.add(
                    v.table_opt("contact").and_then(|c| c.span.clone()).or_else(|| v.span("model")),
                    format!("how stiff is a contact of {x} and {y}?"),
                    format!("the law \"{}\" needs a stiffness", contact.normal.name()),
                    if hertz {
                        "add `hertz_stiffness`, or Young's moduli to the materials"
                    } else {
                        "add `stiffness = \"1500 N/m\"` to `contact`"
                    },
                );
                return f;
            };
            f.contact_time = f.contact_time.min(time);
            let packed = contact::packed_step(contact, materials, *a, *b, overlap);
            f.packed_step = f.packed_step.min(packed.unwrap_or(f64::INFINITY));
            f.overlap = f.overlap.max(overlap / (2.0 * a.radius.min(b.radius)));
            if let (Some(x), Some(y)) = (materials[a.material].elastic, materials[b.material].elastic) {
                use brazilnut_grains::material as solid;
                let m = 1.0 / (1.0 / a.mass + 1.0 / b.mass);
                let r = 1.0 / (1.0 / a.radius + 1.0 / b.radius);
                let t = solid::hertz_contact_time(
                    m,
                    solid::hertz_stiffness(r, solid::effective_modulus(&x, &y)),
                    speed,
                );
                f.hertz_time = Some(f.hertz_time.unwrap_or(f64::INFINITY).min(t));
            }
        }
        if let Some(x) = materials[a.material].elastic {
            let t = brazilnut_grains::material::rayleigh_time(a.radius, materials[a.material].density, &x);
            f.rayleigh_time = Some(f.rayleigh_time.unwrap_or(f64::INFINITY).min(t));
        }
    }
    // Fluid drawn under a thrown bed moves as fast as the bed, a few times faster in gaps.
    let settling =
        (2.0 * v.number("gravity") * 2.0 * grains.radius.iter().copied().fold(0.0, f64::max)).sqrt();
    let estimate = parts::peak_speed(v).max(settling).max(own);
    f.flow_speed = crate::fluid::largest_speed(v).unwrap_or(estimate);
    f.mass = grains.mass.iter().sum();
    f.volume = grains.radius.iter().map(|&r| packing::occupied(r, cell)).sum();
    f.diameter = 2.0 * grains.radius.iter().sum::<f64>() / grains.len() as f64;
    f.grain_density = bodies.iter().map(|b| materials[b.material].density).fold(f64::INFINITY, f64::min);
    f.height = packing::bed_height(f.volume, packing::settled_solids_fraction(cell), cell.base_area());
    f.fluid = v.table_opt("fluid").and_then(|t| Some((t.number_opt("density")?, t.number_opt("viscosity")?)));
    f
}

fn species(v: &Values, grains: &Grains) -> Vec<Species> {
    v.tables("grains")
        .enumerate()
        .map(|(k, g)| {
            let radii: Vec<f64> = (0..grains.len())
                .filter(|&i| usize::from(grains.species[i]) == k)
                .map(|i| grains.radius[i])
                .collect();
            let n = radii.len();
            Species {
                name: g.text("name").to_string(),
                count: n,
                diameter: 2.0 * radii.iter().sum::<f64>() / n.max(1) as f64,
            }
        })
        .collect()
}

fn settle(v: &Values, diameter: f64) -> Settle {
    let Some(t) = v.table_opt("time") else { return Settle::None };
    match (t.number_opt("settle"), t.text_opt("settle")) {
        (Some(s), _) if s > 0.0 => Settle::For(s),
        (None, Some("until-at-rest")) if v.number("gravity") > 0.0 => Settle::UntilAtRest {
            speed: t.number("rest_speed"),
            calm: 2.0 * (2.0 * diameter / v.number("gravity")).sqrt(),
            limit: t.number("settle_limit"),
        },
        _ => Settle::None,
    }
}

fn medium(v: &Values, cell: &Cell, species: &[Species], issues: &mut Issues) -> Option<Medium> {
    match v.text("model") {
        "dry" => Some(Medium::Dry),
        "simple-drag" => crate::fluid::simple_drag(v, cell, species).map(Medium::SimpleDrag),
        "navier-stokes" => {
            // Two to three grains per cell: the mapping is smooth, the grid not finer than it means anything.
            let largest = species.iter().map(|s| s.diameter).fold(0.0, f64::max);
            let spec = crate::fluid::averaged(v, cell, species)?;
            let grid = crate::fluid::grid_fluid(v, cell, 2.4 * largest, issues)?;
            Some(Medium::Coupled(Box::new(spec), Box::new(grid)))
        }
        _ => {
            let (spec, spacing) = crate::fluid::resolved(v, cell, species, issues)?;
            let grid = crate::fluid::grid_fluid(v, cell, spacing, issues)?;
            Some(Medium::Coupled(Box::new(spec), Box::new(grid)))
        }
    }
}

fn watches(
    v: &Values,
    cell: &Cell,
    clock: &Clock,
    species: &[Species],
    walls: &[WallSpec],
    facts: &Facts,
    issues: &mut Issues,
) -> Vec<Watch> {
    let kinds: Vec<(String, usize)> = species.iter().map(|s| (s.name.clone(), s.count)).collect();
    let names: Vec<String> = walls.iter().map(|w| w.name.clone()).collect();
    let setting = Setting {
        cell,
        species: &kinds,
        walls: &names,
        ledger: brazilnut_sim::view::LEDGER,
        frequency: facts.shake.map(|s| s.1),
        steps_per_cycle: clock.steps_per_cycle,
        dt: clock.dt,
        steps: clock.end,
        gravity: parts::gravity(v),
        mean_diameter: facts.diameter,
        largest_diameter: species.iter().map(|s| s.diameter).fold(0.0, f64::max),
        has_flow: check::has_flow(v.text("model")),
        seed: v.integer("seed") as u64,
        sampling: Default::default(),
    };
    let mut list: Vec<Watch> = vec![];
    for table in v.tables("observe") {
        if table.text_opt("what").is_none() {
            continue;
        }
        match Watch::from_values(table, &setting) {
            Ok(w) => {
                if list.iter().any(|x| x.name == w.name) {
                    issues.add(
                        table.span("name"),
                        format!("two observers are called \"{}\"", w.name),
                        "their tables would overwrite each other",
                        "give one of them a `name`",
                    );
                }
                list.push(w);
            }
            Err(faults) => {
                for (key, message) in faults {
                    issues.add(table.span(&key), format!("`{key}` of this observer is wrong"), message, "");
                }
            }
        }
    }
    list
}
