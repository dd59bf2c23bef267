//! The flow on its grid as observers see it.

use brazilnut_base::{PlaneField, Side, Vec3};
use brazilnut_coupling::one_way::LocalPorosity;
use brazilnut_fluid::{Flow, Grid, Solver, diagnose};
use brazilnut_observe::{FlowBalance, FlowView};

/// A flow between two steps.
pub(crate) struct Seen<'a> {
    pub flow: &'a Flow,
    pub grid: &'a Grid,
    pub solver: &'a Solver,
    /// The uniform acceleration, m/s².
    pub body: Vec3,
    /// Grains share the flow.
    pub shared: bool,
    /// Grains are larger than grid cells.
    pub resolved: bool,
    /// Porosity of an unresolved coupling.
    pub porosity: Option<&'a LocalPorosity>,
}

/// Lower neighbour and weight of the upper one for coordinate `x` in units of the spacing.
fn between(x: f64, highest: isize) -> (isize, f64) {
    let low = (x.floor() as isize).clamp(-1, highest);
    (low, (x - low as f64).clamp(0.0, 1.0))
}

impl Seen<'_> {
    /// The axes of the plane of a flow in two dimensions.
    fn plane(&self) -> Option<[usize; 2]> {
        let flat = self.grid.sides.iter().position(|s| *s == Side::Flat)?;
        Some([[1, 2], [0, 2], [0, 1]][flat])
    }

    /// Trilinear interpolation of a field whose point (0, 0, 0) lies `shift` spacings from the corner.
    fn interpolate(&self, r: Vec3, shift: Vec3, at: impl Fn(isize, isize, isize) -> f64) -> f64 {
        let g = self.grid;
        let axis = |a: usize| {
            if g.sides[a] == Side::Flat {
                return (0, 0.0);
            }
            between(r[a] / g.spacing[a] - shift[a], g.cells[a] as isize - 1)
        };
        let [(i, wx), (j, wy), (k, wz)] = [axis(0), axis(1), axis(2)];
        let line =
            |j, k| if wx == 0.0 { at(i, j, k) } else { (1.0 - wx) * at(i, j, k) + wx * at(i + 1, j, k) };
        let plane = |k| if wy == 0.0 { line(j, k) } else { (1.0 - wy) * line(j, k) + wy * line(j + 1, k) };
        if wz == 0.0 { plane(k) } else { (1.0 - wz) * plane(k) + wz * plane(k + 1) }
    }
}

impl FlowView for Seen<'_> {
    fn velocity(&self, at: Vec3) -> Vec3 {
        let v = &self.flow.velocity;
        let half = |a: usize| {
            let mut shift = Vec3::splat(0.5);
            shift[a] = 0.0;
            shift
        };
        Vec3::new(
            self.interpolate(at, half(0), |i, j, k| v.x.at(i, j, k)),
            self.interpolate(at, half(1), |i, j, k| v.y.at(i, j, k)),
            self.interpolate(at, half(2), |i, j, k| v.z.at(i, j, k)),
        )
    }

    fn pressure(&self, at: Vec3) -> f64 {
        self.interpolate(at, Vec3::splat(0.5), |i, j, k| self.flow.pressure.at(i, j, k))
    }

    fn porosity(&self, at: Vec3) -> f64 {
        self.porosity.map_or(1.0, |p| p.at(at))
    }

    fn is_resolved(&self) -> bool {
        self.resolved
    }

    fn shape(&self) -> [usize; 3] {
        self.grid.cells
    }

    fn centre(&self, cell: [usize; 3]) -> Vec3 {
        self.grid.cell_center(cell[0] as isize, cell[1] as isize, cell[2] as isize)
    }

    fn streamfunction(&self) -> Option<PlaneField> {
        Some(diagnose::streamfunction(self.grid, &self.flow.velocity, self.plane()?, 0))
    }

    fn vorticity(&self) -> Option<PlaneField> {
        Some(diagnose::vorticity(self.grid, &self.flow.velocity, self.plane()?, 0))
    }

    fn balance(&self, dt: f64) -> FlowBalance {
        let spec = self.solver.spec();
        let known = !self.shared && spec.solids.is_empty() && spec.open_axis().is_none();
        let b = diagnose::budget(self.solver, self.flow, self.body);
        let only = |x: f64| if known { x } else { f64::NAN };
        FlowBalance {
            kinetic: b.kinetic,
            dissipation: only(b.dissipation),
            walls: only(b.walls),
            body: only(b.body),
            divergence: diagnose::divergence(self.grid, &self.flow.velocity),
            courant: diagnose::courant(self.grid, self.flow, dt),
        }
    }
}
