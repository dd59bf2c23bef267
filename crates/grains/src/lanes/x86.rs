//! What lane types of x86 registers have in common.
#![allow(unsafe_code, reason = "intrinsics; a prefetch is harmless for any address")]

use crate::packed::{Force, Row, Spin};

/// A lane type of one register, with all arithmetic that is one instruction.
macro_rules! lanes_of_a_register {
    (
        $(#[$doc:meta])* $name:ident = $register:ident of $lanes:literal,
        mask $mask:ident,
        add $add:ident, sub $sub:ident, mul $mul:ident, div $div:ident,
        min $min:ident, max $max:ident, sqrt $sqrt:ident,
        xor $xor:ident, andnot $andnot:ident, set1 $set1:ident, loadu $loadu:ident, storeu $storeu:ident
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name($register);

        lanes_of_a_register!(@op $name Add, add, $add);
        lanes_of_a_register!(@op $name Sub, sub, $sub);
        lanes_of_a_register!(@op $name Mul, mul, $mul);
        lanes_of_a_register!(@op $name Div, div, $div);

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                unsafe { Self($xor(self.0, $set1(-0.0))) }
            }
        }

        impl Real for $name {
            type Mask = $mask;
            const WIDTH: usize = $lanes;
            #[inline(always)]
            fn splat(x: f64) -> Self {
                unsafe { Self($set1(x)) }
            }
            #[inline(always)]
            fn from_lanes(mut f: impl FnMut(usize) -> f64) -> Self {
                let mut a = [0.0; $lanes];
                for (k, a) in a.iter_mut().enumerate() {
                    *a = f(k);
                }
                Self::from_slice(&a)
            }
            #[inline(always)]
            fn lane(self, k: usize) -> f64 {
                let mut a = [0.0; $lanes];
                self.to_slice(&mut a);
                a[k]
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                unsafe { Self($sqrt(self.0)) }
            }
            #[inline(always)]
            fn abs(self) -> Self {
                unsafe { Self($andnot($set1(-0.0), self.0)) }
            }
            #[inline(always)]
            fn min(self, o: Self) -> Self {
                unsafe { Self($min(self.0, o.0)) }
            }
            #[inline(always)]
            fn max(self, o: Self) -> Self {
                unsafe { Self($max(self.0, o.0)) }
            }
            #[inline(always)]
            fn lt(self, o: Self) -> $mask {
                $mask::less(self, o)
            }
            #[inline(always)]
            fn le(self, o: Self) -> $mask {
                $mask::at_most(self, o)
            }
            #[inline(always)]
            fn pick(mask: $mask, yes: Self, no: Self) -> Self {
                mask.pick(yes, no)
            }
        }

        impl $name {
            /// The first values.
            #[inline(always)]
            fn from_slice(from: &[f64]) -> Self {
                let from = &from[..$lanes];
                Self(unsafe { $loadu(from.as_ptr()) })
            }

            /// Writes the lanes to the first places.
            #[inline(always)]
            fn to_slice(self, to: &mut [f64]) {
                let to = &mut to[..$lanes];
                unsafe { $storeu(to.as_mut_ptr(), self.0) }
            }
        }
    };
    (@op $name:ident $trait:ident, $method:ident, $instruction:ident) => {
        impl $trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                unsafe { Self($instruction(self.0, o.0)) }
            }
        }
    };
}
pub(super) use lanes_of_a_register;

/// Asks for the cache lines of the rows `j`, to be read some batches later; `base` is the row of `table[0]`.
#[inline(always)]
fn prefetch<T>(table: &[T], base: usize, j: &[u32]) {
    for &j in j {
        let place = table.as_ptr().wrapping_add((j as usize).wrapping_sub(base));
        // Sound for any address: a prefetch reads nothing.
        unsafe { std::arch::x86_64::_mm_prefetch::<{ std::arch::x86_64::_MM_HINT_T0 }>(place.cast()) };
    }
}

/// [`super::Wide::announce`] of every lane type of x86.
#[inline(always)]
pub(super) fn announce<const SPINS: bool>(
    rows: &[Row],
    spins: &[Spin],
    forces: Option<(&[Force], usize)>,
    j: &[u32],
) {
    prefetch(rows, 0, j);
    if let Some((forces, base)) = forces {
        prefetch(forces, base, j);
    }
    if SPINS {
        prefetch(spins, 0, j);
    }
}
