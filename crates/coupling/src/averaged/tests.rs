use super::*;
use brazilnut_base::{Side, vec3};
use brazilnut_fluid::Flow;

fn spec(equation: BedEquation) -> Averaged {
    Averaged {
        equation,
        kernel: KernelName::Trilinear,
        porosity_floor: 0.26,
        formulation: Formulation::A,
        density: 1000.0,
        viscosity: 1e-3,
        diameter: vec![0.7e-3, 1.5e-3],
        body: Body::Sphere,
    }
}

/// A random bed in the lower half of a box.
fn bed(sides: [Side; 3]) -> (Grid, Grains) {
    let grid = Grid::new([6, 5, 8], [1.7e-3, 1.6e-3, 1.8e-3], sides);
    let size = grid.size();
    let mut grains = Grains::default();
    for k in 0..900 {
        let t = f64::from(k);
        let u = vec3((t * 0.754_877).fract(), (t * 0.569_840).fract(), 0.5 * (t * 0.318_329).fract());
        let species = u16::from(k % 7 == 0);
        let r = if species == 1 { 0.75e-3 } else { 0.35e-3 };
        grains.push(species, 0, r, 1e-6, 1e-13, u * size);
        grains.velocity[k as usize] = vec3((t * 0.17).sin(), (t * 0.23).cos(), (t * 0.31).sin()) * 0.05;
    }
    (grid, grains)
}

const SIDES: [[Side; 3]; 2] =
    [[Side::Walls, Side::Walls, Side::Walls], [Side::Periodic, Side::Periodic, Side::Walls]];

/// Some smooth flow.
fn flow(grid: &Grid) -> Flow {
    let mut flow = Flow::at_rest(grid);
    for c in 0..3 {
        for (k, v) in flow.velocity.component_mut(c).iter_mut().enumerate() {
            *v = 0.03 * ((k * 13 + c) as f64).sin();
        }
    }
    flow.pressure.fill_with(grid, |i, j, k| 40.0 * ((i + 2 * j + 3 * k) as f64).cos());
    flow
}

#[test]
fn solids_mapped_are_the_volume_of_the_grains() {
    for sides in SIDES {
        let (grid, grains) = bed(sides);
        let spec = spec(BedEquation::Ergun);
        let work = {
            let mut w = AveragedWork::new(&spec, &grid, &[]);
            let mut medium = AveragedWork::medium(&grid);
            w.before_fluid(&spec, &grains, &flow(&grid), &mut medium, &mut AveragedReport::default());
            w
        };
        let volume: f64 = grains.radius.iter().map(|r| spec.body.volume(*r)).sum();
        for c in 0..3 {
            let sum: f64 = work.mapped.solids.component(c).iter().sum();
            // Rounding of 7200 terms.
            assert!((sum / volume - 1.0).abs() < 1e-12, "component {c}: {sum} of {volume}");
        }
    }
}

#[test]
fn drag_is_equal_and_opposite_to_rounding() {
    for sides in SIDES {
        for equation in BedEquation::ALL {
            let (grid, grains) = bed(sides);
            let spec = spec(equation);
            let flow = flow(&grid);
            let mut report = AveragedReport::default();
            let mut medium = AveragedWork::medium(&grid);
            let mut work = AveragedWork::new(&spec, &grid, &[]);
            work.before_fluid(&spec, &grains, &flow, &mut medium, &mut report);
            let mut loads = vec![Load::default(); grains.len()];
            work.after_fluid(&spec, &grains, &flow, &medium, &mut loads, &mut report);
            let left = report.drag_on_fluid + report.drag_on_grains;
            // Rounding of 900 forces and 700 faces against their sum of moduli, here about as large as one force each.
            let scale: f64 = loads.iter().map(|l| l.force.length()).sum();
            assert!(left.length() < 1e-13 * scale, "{equation:?}: {left} of {scale}");
            let total: Vec3 = loads.iter().map(|l| l.force).sum();
            let parts = report.drag_on_grains + report.pressure_on_grains;
            assert!((total - parts).length() < 1e-13 * scale);
        }
    }
}

#[test]
fn a_uniform_gradient_pushes_every_grain_with_its_volume() {
    let (grid, grains) = bed(SIDES[0]);
    let spec = spec(BedEquation::Darcy);
    let mut flow = Flow::at_rest(&grid);
    flow.pressure.fill_with(&grid, |i, j, k| {
        let x = grid.cell_center(i, j, k);
        -100.0 * x.z + 30.0 * x.x
    });
    let mut still = grains.clone();
    still.velocity.fill(Vec3::ZERO);
    let mut report = AveragedReport::default();
    let mut medium = AveragedWork::medium(&grid);
    let mut work = AveragedWork::new(&spec, &grid, &[]);
    work.before_fluid(&spec, &still, &flow, &mut medium, &mut report);
    let mut loads = vec![Load::default(); grains.len()];
    work.after_fluid(&spec, &still, &flow, &medium, &mut loads, &mut report);
    for (l, r) in loads.iter().zip(&grains.radius) {
        let expected = spec.body.volume(*r) * vec3(-30.0, 0.0, 100.0);
        // Rounding; grains at walls included.
        assert!((l.force - expected).length() < 1e-11 * expected.length());
    }
}

/// Formulations A and printed (all gradient counted as drag) give the same force in a steady flow.
#[test]
fn models_agree_in_a_steady_uniform_flow() {
    let sides = [Side::Periodic; 3];
    let (grid, mut grains) = bed(sides);
    for (k, x) in grains.position.iter_mut().enumerate() {
        // One grain per cell, each at its centre: the porosity is the same on every face.
        let (i, j) = (k % 6, k / 6 % 5);
        *x = grid.cell_center(i as isize, j as isize, (k / 30 % 8) as isize);
        grains.velocity[k] = Vec3::ZERO;
        grains.radius[k] = 0.35e-3;
        grains.species[k] = 0;
    }
    grains.position.truncate(720);
    grains.radius.truncate(720);
    grains.velocity.truncate(720);
    let mut flow = Flow::at_rest(&grid);
    flow.velocity.component_mut(2).fill(0.02);
    let mut forces = vec![];
    for formulation in [Formulation::A, Formulation::Printed] {
        let spec = Averaged { formulation, ..spec(BedEquation::Ergun) };
        let mut report = AveragedReport::default();
        let mut medium = AveragedWork::medium(&grid);
        let mut work = AveragedWork::new(&spec, &grid, &[]);
        work.before_fluid(&spec, &grains, &flow, &mut medium, &mut report);
        // Steady: −grad P = rho beta v, the same everywhere, so linear along the bed.
        let beta = medium.resistance.as_ref().unwrap().rate.z.at(1, 1, 1);
        let gradient = spec.density * beta * 0.02;
        let mut loads = vec![Load::default(); grains.len()];
        work.after_fluid(&spec, &grains, &flow, &medium, &mut loads, &mut report);
        let volume = spec.body.volume(0.35e-3);
        // A periodic box cannot hold a linear pressure: its push is added by hand.
        let pressure = if formulation == Formulation::A { volume * gradient } else { 0.0 };
        forces.push(loads[17].force.z + pressure);
        let phi = medium.mixture.as_ref().unwrap().porosity.z.at(1, 1, 1);
        let bed = Bed { porosity: phi, diameter: 0.7e-3, density: 1000.0, viscosity: 1e-3 };
        let by_hand = volume * spec.equation.gradient(phi * 0.02, &bed) / (1.0 - phi);
        // Rounding.
        assert!((forces[forces.len() - 1] / by_hand - 1.0).abs() < 1e-12, "{formulation:?}");
    }
}

#[test]
fn darcy_rate_is_the_printed_one() {
    // beta = 180 eta (1−phi)²/(rho d² phi²) (after Clément eq. 2.62); rounding.
    let bed = Bed { porosity: 0.42, diameter: 0.7e-3, density: 1000.0, viscosity: 1e-3 };
    let printed = 180.0 * 1e-3 * 0.58f64.powi(2) / (1000.0 * 0.7e-3f64.powi(2) * 0.42f64.powi(2));
    let beta = exchange_rate(brazilnut_bed::bed_equation::Darcy, 0.01, &bed);
    assert!((beta / printed - 1.0).abs() < 1e-12);
}

#[test]
fn a_wall_inside_takes_no_share() {
    let (grid, grains) = bed(SIDES[0]);
    let wall = Solid { low: [3, 0, 0], high: [4, 5, 8] };
    let spec = spec(BedEquation::Ergun);
    let mut work = AveragedWork::new(&spec, &grid, &[wall]);
    let mut medium = AveragedWork::medium(&grid);
    let mut report = AveragedReport::default();
    let mut one = Grains::default();
    // Half a radius from the wall's face at x = 5.1 mm.
    one.push(0, 0, 0.35e-3, 1e-6, 1e-13, vec3(4.9e-3, 4e-3, 7e-3));
    work.before_fluid(&spec, &one, &flow(&grid), &mut medium, &mut report);
    for c in 0..3 {
        let on_free: f64 =
            work.mapping.free(c).iter().map(|(p, _)| work.mapped.solids.component(c)[*p]).sum();
        let volume = spec.body.volume(0.35e-3);
        // Rounding.
        assert!((on_free / volume - 1.0).abs() < 1e-12, "component {c}");
    }
    assert!(grains.len() > 1);
}
