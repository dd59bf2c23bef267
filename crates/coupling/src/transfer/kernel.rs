//! Partitions of unity along one axis; in three dimensions they multiply.

use brazilnut_base::menu::Entry;
use serde::{Deserialize, Serialize};

/// Weights of `W` neighbouring grid points.
pub trait Kernel<const W: usize>: Copy + Send + Sync {
    /// The first point and the weights for a place `s`, in spacings from point 0.
    fn weights(self, s: f64) -> (f64, [f64; W]);
}

/// Two points, linear: w = 1 − |s − i| (Clément eq. 2.67).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trilinear;

/// Three points, with a continuous derivative (Roma, Peskin & Berger 1999, eq. 22):
/// w = (1 + √(1 − 3q²))/3 for q ≤ ½, (5 − 3q − √(1 − 3(1 − q)²))/6 for ½ ≤ q ≤ 3/2, q = |s − i|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roma;

/// ⌊s⌋ without the call into the library that processors before SSE4.1 need.
#[inline(always)]
fn floor(s: f64) -> f64 {
    let i = f64::from(s as i32);
    if i > s { i - 1.0 } else { i }
}

impl Kernel<2> for Trilinear {
    #[inline(always)]
    fn weights(self, s: f64) -> (f64, [f64; 2]) {
        let i = floor(s);
        let f = s - i;
        (i, [1.0 - f, f])
    }
}

impl Kernel<3> for Roma {
    #[inline(always)]
    fn weights(self, s: f64) -> (f64, [f64; 3]) {
        let i = floor(s + 0.5);
        let r = s - i;
        let middle = (1.0 + (1.0 - 3.0 * r * r).sqrt()) / 3.0;
        // The outer pair follows from the sum (one) and the first moment (r).
        let rest = 1.0 - middle;
        (i - 1.0, [0.5 * (rest - r), middle, 0.5 * (rest + r)])
    }
}

/// A kernel chosen by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum KernelName {
    /// `trilinear`
    #[default]
    Trilinear,
    /// `roma`
    Roma,
}

/// What `kernel` may name, in the order of [`KernelName::ALL`].
pub const KERNELS: &[Entry] = &[
    Entry {
        name: "trilinear",
        summary: "The two nearest grid points along each axis.",
        formula: "w = 1 - |s - i|",
        source: "Clément eq. 2.67",
    },
    Entry {
        name: "roma",
        summary: "Three points along each axis, smoother as a grain crosses the grid.",
        formula: "w = (1 + sqrt(1 - 3 q^2))/3 inside q = 1/2, (5 - 3 q - sqrt(1 - 3 (1-q)^2))/6 outside",
        source: "Roma, Peskin & Berger 1999",
    },
];

impl KernelName {
    /// Every choice, in the order of [`KERNELS`].
    pub const ALL: [Self; 2] = [Self::Trilinear, Self::Roma];

    /// The kernel called `name`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        KERNELS.iter().position(|e| e.name == name).map(|k| Self::ALL[k])
    }
}

/// Evaluates an expression with the kernel of a [`KernelName`] bound to a name.
#[macro_export]
macro_rules! with_kernel {
    ($name:expr, $kernel:ident => $body:expr) => {
        match $name {
            $crate::transfer::KernelName::Trilinear => {
                let $kernel = $crate::transfer::Trilinear;
                $body
            }
            $crate::transfer::KernelName::Roma => {
                let $kernel = $crate::transfer::Roma;
                $body
            }
        }
    };
}
