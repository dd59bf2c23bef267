//! What a contact law is: a formula per contact, generic over the lane type.
//!
//! A law file holds one `Copy` struct with the constants of one pair of
//! materials and one of the traits below. All of its functions must be
//! `#[inline(always)]`, or the wide sweep cannot compile them for the
//! instructions found at run time.

use super::real::{Mask, Real, V3};
use crate::material::Material;
use crate::spec::{PairSpec, SpecError};

/// The most numbers that a contact can remember: normal, tangential and rolling parts together.
pub const MAX_SLOTS: usize = 12;

/// Geometry and motion of one contact, seen from its first body. A wall is a
/// second body of infinite mass and radius.
#[derive(Clone, Copy, Debug)]
pub struct Touch<R> {
    /// Overlap delta >= 0, m.
    pub overlap: R,
    /// Unit vector from the second body to the first.
    pub normal: V3<R>,
    /// d(delta)/dt: speed of approach, positive while closing, m/s.
    pub approach: R,
    /// Velocity of the first surface relative to the second in the tangent plane, m/s.
    pub slip: V3<R>,
    /// Angular velocity of the first body minus that of the second, rad/s (zero unless a rolling law asks).
    pub roll: V3<R>,
    /// Effective mass, kg (Clément eq. 2.21).
    pub mass: R,
    /// Effective radius, m (Clément eq. 2.6); anything unless a part of the law sets `RADIUS`.
    pub radius: R,
    /// Length of the step, s.
    pub dt: R,
}

impl<R: Real> Touch<R> {
    /// Weight of this step for a force that sets in at full strength: 1, but between 0 and 3/2 within two
    /// steps of touching or parting.
    ///
    /// A step sees a contact late by up to `dt`; without this a dashpot, which jumps at touch, makes
    /// restitution scatter by `2 |ln e| / (steps per contact)`. With q = delta/(|d(delta)/dt| dt) steps
    /// since touch, the weights min(3q/2, max(1, 2 - q/2)) of a contact add up to its length, and the
    /// force starts from zero.
    #[inline(always)]
    pub fn presence(&self) -> R {
        let travel = self.approach.abs() * self.dt;
        if !self.overlap.lt(travel + travel).any() {
            return R::splat(1.0);
        }
        let q = self.overlap / travel;
        let late = (R::splat(2.0) - R::splat(0.5) * q).max(R::splat(1.0));
        // Two bodies at rest at zero overlap give 0/0, for which `min` and `max` return their argument.
        (R::splat(1.5) * q).min(late)
    }
}

/// What the normal law answers; forces push the bodies apart when positive.
#[derive(Clone, Copy, Debug)]
pub struct NormalForce<R> {
    /// Force of the spring, N.
    pub elastic: R,
    /// Force of the dashpot, N.
    pub damping: R,
    /// Secant of the spring, `elastic` over the overlap, N/m.
    pub secant: R,
    /// Energy stored in the spring, J.
    pub stored: R,
    /// Energy lost to the dashpot in this step, J.
    pub damped: R,
    /// Energy lost to hysteresis of the spring in this step, J.
    pub latched: R,
}

impl<R: Real> NormalForce<R> {
    /// Normal force in Coulomb's limit: never an attraction, N (Clément eq. 2.3, corrected).
    #[inline(always)]
    pub fn load(&self) -> R {
        (self.elastic + self.damping).max(R::zero())
    }
}

/// What the tangential law answers.
#[derive(Clone, Copy, Debug)]
pub struct TangentialForce<R> {
    /// Force on the first body, in the tangent plane, N.
    pub force: V3<R>,
    /// Energy stored in the tangential spring, J.
    pub stored: R,
    /// Energy lost to sliding in this step, J.
    pub slid: R,
    /// Energy lost to the tangential dashpot in this step, J.
    pub damped: R,
    /// Energy lost to hysteresis of the tangential spring in this step, J.
    pub latched: R,
}

impl<R: Real> TangentialForce<R> {
    /// No force.
    #[inline(always)]
    pub fn none() -> Self {
        let o = R::zero();
        Self { force: V3::zero(), stored: o, slid: o, damped: o, latched: o }
    }
}

/// What the rolling law answers.
#[derive(Clone, Copy, Debug)]
pub struct RollingCouple<R> {
    /// Couple on the first body; the second gets the opposite, N m.
    pub couple: V3<R>,
    /// Energy stored, J.
    pub stored: R,
    /// Energy lost in this step, J.
    pub rolled: R,
}

/// What the constants of a pair may depend on.
#[derive(Clone, Copy, Debug)]
pub struct PairContext<'a> {
    /// What the case says about the pair.
    pub pair: &'a PairSpec,
    /// Material of one body.
    pub first: &'a Material,
    /// Material of the other.
    pub second: &'a Material,
    /// Length of the step, s.
    pub dt: f64,
    /// Grains rotate.
    pub rotation: bool,
}

/// A normal law: its constants for one pair of materials, and its formula.
///
/// Constants may not depend on sizes: what does (damping from the effective
/// mass) is computed in `force` from the touch.
pub trait Normal: Copy + Send + Sync + 'static {
    /// The same constants, lane by lane.
    type Lanes<R: Real>: Copy;
    /// How many numbers the contact remembers; all zero before the first touch.
    const SLOTS: usize;
    /// Reads the effective radius.
    const RADIUS: bool = false;
    /// Derives the constants; says what is missing.
    fn build(pair: &PairContext<'_>) -> Result<Self, SpecError>;
    /// Each constant through `pick`: `Lanes { stiffness: pick(|c| c.stiffness), .. }`.
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> Self::Lanes<R>;
    /// The force. `memory` holds `SLOTS` numbers, the same seen from either body.
    fn force<R: Real>(law: &Self::Lanes<R>, touch: &Touch<R>, memory: &mut [R]) -> NormalForce<R>;
    /// Energy that the spring still stored in the step before the bodies parted, J.
    #[inline(always)]
    fn released<R: Real>(_law: &Self::Lanes<R>, _memory: &[R]) -> R {
        R::zero()
    }
}

/// A tangential law.
pub trait Tangential: Copy + Send + Sync + 'static {
    /// The same constants, lane by lane.
    type Lanes<R: Real>: Copy;
    /// How many numbers the contact remembers.
    const SLOTS: usize;
    /// False only for the absent law: surfaces are then not compared.
    const ACTIVE: bool = true;
    /// Bit `k` set: slot `k` changes sign when the two bodies swap places (components of a vector).
    const ODD: u32;
    /// Derives the constants; says what is missing.
    fn build(pair: &PairContext<'_>) -> Result<Self, SpecError>;
    /// Each constant through `pick`.
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> Self::Lanes<R>;
    /// The force, bounded by `friction * normal.load()`.
    fn force<R: Real>(
        law: &Self::Lanes<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        memory: &mut [R],
    ) -> TangentialForce<R>;
    /// Energy that `memory` still stored in the step before the bodies parted, J.
    #[inline(always)]
    fn released<R: Real>(_law: &Self::Lanes<R>, _memory: &[R]) -> R {
        R::zero()
    }
}

/// A rolling law.
pub trait Rolling: Copy + Send + Sync + 'static {
    /// The same constants, lane by lane.
    type Lanes<R: Real>: Copy;
    /// False only for the absent law: spins are then not compared, nor is the effective radius computed.
    const ACTIVE: bool;
    /// How many numbers the contact remembers.
    const SLOTS: usize;
    /// As [`Tangential::ODD`].
    const ODD: u32;
    /// Derives the constants; says what is missing.
    fn build(pair: &PairContext<'_>) -> Result<Self, SpecError>;
    /// Each constant through `pick`.
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> Self::Lanes<R>;
    /// The couple.
    fn couple<R: Real>(
        law: &Self::Lanes<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        memory: &mut [R],
    ) -> RollingCouple<R>;
}
