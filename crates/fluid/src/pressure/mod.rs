//! The pressure equation.

pub(crate) mod conjugate_gradient;
pub(crate) mod fft;
pub(crate) mod library;
pub(crate) mod panel;
pub(crate) mod poisson;
pub(crate) mod rows;
#[cfg(test)]
mod suite;
pub(crate) mod transform;
pub(crate) mod tridiagonal;

use brazilnut_base::menu::Entry;

pub use conjugate_gradient::Convergence;
pub use poisson::{Poisson, Transforms};

/// Solvers of the pressure equation; the flow picks, not the case.
pub const PRESSURE_SOLVERS: &[Entry] = &[
    Entry {
        name: "direct",
        summary: "Fast transforms along two directions, tridiagonal along the third; for boxes without obstacles.",
        formula: "laplacian p = rho / dt div v*",
        source: "Clément eq. 2.35; Makhoul 1980",
    },
    Entry {
        name: "conjugate-gradient",
        summary: "Iteration preconditioned by the direct solver; around obstacles and through porous media.",
        formula: "div(phi m grad p) = rho / dt div(phi v* + (1 - phi) u)",
        source: "Clément eq. 2.63, 2.65, eliminated exactly",
    },
];
