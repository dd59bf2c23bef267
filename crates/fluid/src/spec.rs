//! What a fluid run is made of, checked before the first step.

use crate::boundary::Boundary;
use crate::grid::Grid;
use crate::solid::Solid;
use brazilnut_base::Side;
use brazilnut_base::menu::Entry;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Grid, fluid, sides and numerics.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FluidSpec {
    /// The grid.
    pub grid: Grid,
    /// Density, kg/m³.
    pub density: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity: f64,
    /// Lower and upper side of each axis; not looked at where the direction is periodic or flat.
    pub sides: [[Boundary; 2]; 3],
    /// Solids inside.
    pub solids: Vec<Solid>,
    /// Time stepping.
    pub scheme: Scheme,
    /// Advection.
    pub advection: Advection,
    /// Diffusion.
    pub diffusion: Diffusion,
    /// Steps are cut into as many parts as the flow at hand needs.
    pub adaptive: bool,
    /// A run stops when max over faces of `dt sum |v_i| / h_i` exceeds this.
    pub courant_limit: f64,
    /// Which instructions the sweeps use.
    pub instructions: Instructions,
}

/// Time stepping.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scheme {
    /// Explicit first-order projection (Clément eq. 2.33-2.35).
    FirstOrder,
    /// Adams-Bashforth 2 with incremental pressure.
    SecondOrder,
}

/// Advection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Advection {
    /// Second-order central differences that conserve kinetic energy.
    Central,
    /// Third-order upwind-biased with Koren's limiter.
    Koren,
    /// No advection: creeping flow.
    None,
}

/// Viscous diffusion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Diffusion {
    /// With the advection, limited by eq. 2.37.
    Explicit,
    /// Crank-Nicolson, factored by direction: no viscous limit.
    Implicit,
}

/// Which instructions the sweeps use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Instructions {
    /// The widest vectors the processor has, found at run time.
    #[default]
    Best,
    /// Plain code that runs everywhere.
    Portable,
}

/// All that is wrong with a [`FluidSpec`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpecError {
    /// One sentence each.
    pub problems: Vec<String>,
}

impl fmt::Display for SpecError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.problems.join("; "))
    }
}

impl std::error::Error for SpecError {}

impl FluidSpec {
    /// A box of sticking walls with the default numerics.
    #[must_use]
    pub fn new(grid: Grid, density: f64, viscosity: f64) -> Self {
        Self {
            grid,
            density,
            viscosity,
            sides: std::array::from_fn(|_| [Boundary::NoSlip, Boundary::NoSlip]),
            solids: vec![],
            scheme: Scheme::SecondOrder,
            advection: Advection::Central,
            diffusion: Diffusion::Explicit,
            adaptive: false,
            courant_limit: 1.0,
            instructions: Instructions::Best,
        }
    }

    /// Kinematic viscosity, m²/s (Clément eq. 2.25).
    #[must_use]
    pub fn kinematic_viscosity(&self) -> f64 {
        self.viscosity / self.density
    }

    /// The side at `end` (0 low, 1 high) of `axis`, if the direction has sides.
    #[must_use]
    pub fn side(&self, axis: usize, end: usize) -> Option<&Boundary> {
        (self.grid.sides[axis] == Side::Walls).then(|| &self.sides[axis][end])
    }

    /// The direction that fluid enters or leaves through, if there is one.
    #[must_use]
    pub fn open_axis(&self) -> Option<usize> {
        (0..3).find(|&a| (0..2).any(|e| self.side(a, e).is_some_and(Boundary::is_open)))
    }

    /// Checks the numbers and lays the grid out for the sides.
    ///
    /// # Errors
    /// All that is wrong.
    pub fn checked(mut self) -> Result<Self, SpecError> {
        let mut problems = vec![];
        let mut require = |ok: bool, what: String| {
            if !ok {
                problems.push(what);
            }
        };
        let positive = |x: f64| x.is_finite() && x > 0.0;
        require(positive(self.density), format!("fluid density must be positive, is {}", self.density));
        require(
            self.viscosity.is_finite() && self.viscosity >= 0.0,
            format!("viscosity must not be negative, is {}", self.viscosity),
        );
        require(positive(self.courant_limit), "the Courant limit must be positive".into());
        require(self.grid.dimensions() >= 1, "the grid is flat in every direction".into());
        for axis in 0..3 {
            let (n, h, name) = (self.grid.cells[axis], self.grid.spacing[axis], ["x", "y", "z"][axis]);
            require(positive(h), format!("grid spacing along {name} must be positive, is {h}"));
            let flat = self.grid.sides[axis] == Side::Flat;
            require(!flat || n == 1, format!("a flat direction is one cell wide, {name} has {n}"));
            require(flat || n >= 2, format!("the grid needs at least 2 cells along {name}, has {n}"));
        }
        let open: Vec<usize> =
            (0..3).filter(|&a| (0..2).any(|e| self.side(a, e).is_some_and(Boundary::is_open))).collect();
        require(open.len() <= 1, "inflow and outflow must lie along one axis".into());
        for s in &self.solids {
            let inside = (0..3).all(|a| s.low[a] <= s.high[a] && s.high[a] <= self.grid.cells[a]);
            let thin = (0..3).filter(|&a| s.low[a] == s.high[a]).count();
            require(
                inside && thin <= 1,
                format!("solid {:?}..{:?} is no box or plate in the grid", s.low, s.high),
            );
        }
        require(
            self.solids.is_empty() || self.diffusion == Diffusion::Explicit,
            "implicit diffusion around solids is not available; use explicit diffusion".into(),
        );
        if let Some(&axis) = open.first() {
            self.grid.line_axis = axis;
        }
        require(
            self.grid.sides[self.grid.line_axis] != Side::Flat,
            "the contiguous direction of the grid is flat".into(),
        );
        if problems.is_empty() { Ok(self) } else { Err(SpecError { problems }) }
    }
}

/// Time schemes a case may name.
pub const SCHEMES: &[Entry] = &[
    Entry {
        name: "second-order",
        summary: "Adams-Bashforth 2 with incremental pressure.",
        formula: "v* = v + dt (3/2 R_n - 1/2 R_{n-1} - grad p_n); v_{n+1} = v* - dt grad(p_{n+1} - p_n)",
        source: "Kim & Moin 1985; van Kan 1986",
    },
    Entry {
        name: "first-order",
        summary: "Explicit Euler with projection.",
        formula: "v* = v + dt R_n; v_{n+1} = v* - dt grad p_{n+1}",
        source: "Clément eq. 2.33-2.35",
    },
];

/// Advection schemes a case may name.
pub const ADVECTIONS: &[Entry] = &[
    Entry {
        name: "central",
        summary: "Second-order central differences; conserve momentum and kinetic energy.",
        formula: "sum over faces of F (v_neighbour - v) / 2",
        source: "Harlow & Welch 1965; Morinishi et al. 1998",
    },
    Entry {
        name: "koren",
        summary: "Third-order upwind-biased with a limiter; robust where the grid is too coarse.",
        formula: "v_face = v_C + 1/2 psi(r) (v_C - v_U), psi = max(0, min(2 r, (1 + 2 r)/3, 2))",
        source: "Koren 1993",
    },
    Entry { name: "none", summary: "Creeping flow.", formula: "0", source: "" },
];

/// Treatments of viscosity a case may name.
pub const DIFFUSIONS: &[Entry] = &[
    Entry {
        name: "explicit",
        summary: "Extrapolated with the advection; limits the step to rho h^2 / (2 D eta).",
        formula: "nu laplacian v_n",
        source: "Clément eq. 2.37",
    },
    Entry {
        name: "implicit",
        summary: "Crank-Nicolson, factored by direction; no viscous limit.",
        formula: "nu laplacian (v_n + v*) / 2",
        source: "Kim & Moin 1985",
    },
];
