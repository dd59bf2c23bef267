//! The absent laws.

use crate::contact::law::{
    NormalForce, PairContext, Rolling, RollingCouple, Tangential, TangentialForce, Touch,
};
use crate::contact::real::{Real, V3};
use crate::spec::SpecError;

/// Perfectly smooth: no tangential force.
#[derive(Clone, Copy, Debug)]
pub struct Frictionless;

impl Tangential for Frictionless {
    type Lanes<R: Real> = ();
    const ACTIVE: bool = false;
    const SLOTS: usize = 0;
    const ODD: u32 = 0;

    fn build(_: &PairContext<'_>) -> Result<Self, SpecError> {
        Ok(Self)
    }

    #[inline(always)]
    fn lanes<R: Real>(_: impl Fn(fn(&Self) -> f64) -> R) {}

    #[inline(always)]
    fn force<R: Real>((): &(), _: &Touch<R>, _: &NormalForce<R>, _: &mut [R]) -> TangentialForce<R> {
        TangentialForce::none()
    }
}

/// Grains roll freely.
#[derive(Clone, Copy, Debug)]
pub struct NoRolling;

impl Rolling for NoRolling {
    type Lanes<R: Real> = ();
    const ACTIVE: bool = false;
    const SLOTS: usize = 0;
    const ODD: u32 = 0;

    fn build(_: &PairContext<'_>) -> Result<Self, SpecError> {
        Ok(Self)
    }

    #[inline(always)]
    fn lanes<R: Real>(_: impl Fn(fn(&Self) -> f64) -> R) {}

    #[inline(always)]
    fn couple<R: Real>((): &(), _: &Touch<R>, _: &NormalForce<R>, _: &mut [R]) -> RollingCouple<R> {
        RollingCouple { couple: V3::zero(), stored: R::zero(), rolled: R::zero() }
    }
}
