//! The number type of contact formulae: one text serves the scalar sweep and the eight-wide one.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A truth value per lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// True if any lane is.
    fn any(self) -> bool;
    /// One bit per lane, lane 0 lowest.
    fn bits(self) -> u8;
}

/// A number, or several side by side that take the same path.
///
/// All operations are the IEEE ones, rounded one by one: every implementation
/// gives the same bits in each lane. `min`/`max` return `other` unless `self`
/// is strictly smaller/larger.
pub trait Real:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// What a comparison gives.
    type Mask: Mask;
    /// Number of lanes.
    const WIDTH: usize;
    /// `x` in every lane.
    fn splat(x: f64) -> Self;
    /// `f(k)` in lane `k`.
    fn from_lanes(f: impl FnMut(usize) -> f64) -> Self;
    /// The value of lane `k`.
    fn lane(self, k: usize) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The smaller one.
    fn min(self, other: Self) -> Self;
    /// The larger one.
    fn max(self, other: Self) -> Self;
    /// `self < other`
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`
    fn le(self, other: Self) -> Self::Mask;
    /// `yes` where `mask` holds, else `no`.
    fn pick(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Zero in every lane.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// `f` lane by lane: slow, for functions that no instruction has.
    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        Self::from_lanes(|k| f(self.lane(k)))
    }
    /// Cube root.
    #[inline(always)]
    fn cbrt(self) -> Self {
        self.each(f64::cbrt)
    }
    /// `self` where `mask` holds, else zero.
    #[inline(always)]
    fn keep(self, mask: Self::Mask) -> Self {
        Self::pick(mask, self, Self::zero())
    }
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn bits(self) -> u8 {
        u8::from(self)
    }
}

impl Real for f64 {
    type Mask = bool;
    const WIDTH: usize = 1;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn from_lanes(mut f: impl FnMut(usize) -> f64) -> Self {
        f(0)
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn pick(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

/// A vector of such numbers.
#[derive(Clone, Copy, Debug)]
pub struct V3<R> {
    /// x component.
    pub x: R,
    /// y component.
    pub y: R,
    /// z component.
    pub z: R,
}

impl<R: Real> V3<R> {
    /// The vector (x, y, z).
    #[inline(always)]
    pub fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::new(R::zero(), R::zero(), R::zero())
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, b: Self) -> R {
        self.x * b.x + self.y * b.y + self.z * b.z
    }
    /// Vector product.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        Self::new(self.y * b.z - self.z * b.y, self.z * b.x - self.x * b.z, self.x * b.y - self.y * b.x)
    }
    /// Length.
    #[inline(always)]
    pub fn length(self) -> R {
        self.dot(self).sqrt()
    }
    /// The part perpendicular to the unit vector `n`.
    #[inline(always)]
    pub fn reject(self, n: Self) -> Self {
        self - n * self.dot(n)
    }
    /// `yes` where `mask` holds, else `no`.
    #[inline(always)]
    pub fn pick(mask: R::Mask, yes: Self, no: Self) -> Self {
        Self::new(R::pick(mask, yes.x, no.x), R::pick(mask, yes.y, no.y), R::pick(mask, yes.z, no.z))
    }
    /// `self` where `mask` holds, else zero.
    #[inline(always)]
    pub fn keep(self, mask: R::Mask) -> Self {
        Self::pick(mask, self, Self::zero())
    }
}

impl<R: Real> Add for V3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::new(self.x + b.x, self.y + b.y, self.z + b.z)
    }
}

impl<R: Real> AddAssign for V3<R> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl<R: Real> Sub for V3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::new(self.x - b.x, self.y - b.y, self.z - b.z)
    }
}

impl<R: Real> Neg for V3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Real> Mul<R> for V3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: R) -> Self {
        Self::new(self.x * s, self.y * s, self.z * s)
    }
}
