//! What the numbers of a coupling mean for the grains of a case.

use crate::issue::Issues;
use brazilnut_base::values::Values;
use brazilnut_coupling::sheet::{Population, Sheet};
use brazilnut_grains::{Grains, Material};
use brazilnut_sim::clock::Clock;
use brazilnut_sim::plan::{Medium, Species};

/// Mass that a contact of grain `k` accelerates, kg.
///
/// The full one where a template would have none: such grains are refused.
pub(crate) fn contact_mass(medium: Option<&Medium>, grains: &Grains, k: usize) -> f64 {
    let full = grains.mass[k];
    match medium {
        Some(Medium::Coupled(spec, _)) => {
            let (mass, _) = spec.carried(full, grains.inertia[k], grains.radius[k]);
            if mass > 0.0 { mass } else { full }
        }
        _ => full,
    }
}

/// The sheet of the coupling; what cannot work becomes an issue.
pub(crate) fn sheet(
    v: &Values,
    medium: &Medium,
    materials: &[Material],
    species: &[Species],
    grains: &Grains,
    clock: &Clock,
    issues: &mut Issues,
) -> Sheet {
    let Medium::Coupled(spec, fluid) = medium else { return Sheet::default() };
    let populations: Vec<Population> =
        species.iter().enumerate().filter_map(|(k, s)| population(k, s, materials, grains)).collect();
    let frequency = clock.steps_per_cycle.map(|n| 1.0 / (n as f64 * clock.dt));
    let sheet = Sheet::new(spec, Some(&fluid.grid), &populations, clock.dt, frequency);
    let table = v.table_opt(spec.name());
    let span = table.and_then(|t| t.span.clone()).or_else(|| v.span("model"));
    for r in &sheet.refusals {
        issues.add(span.clone(), r.message.as_str(), r.cause.as_str(), r.remedy.as_str());
    }
    sheet
}

fn population(k: usize, species: &Species, materials: &[Material], grains: &Grains) -> Option<Population> {
    let of_kind = || (0..grains.len()).filter(|&i| usize::from(grains.species[i]) == k);
    let first = of_kind().next()?;
    Some(Population {
        name: species.name.clone(),
        mass: of_kind().map(|i| grains.mass[i]).sum::<f64>() / species.count as f64,
        radius: 0.5 * species.diameter,
        density: materials[usize::from(grains.material[first])].density,
        count: species.count,
    })
}
