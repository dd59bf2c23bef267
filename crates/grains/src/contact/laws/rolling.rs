//! Resistance against rolling.

use super::history::{Spring, mobilise, store, vector};
use crate::contact::law::{NormalForce, PairContext, Rolling, RollingCouple, Touch};
use crate::contact::real::Real;
use crate::spec::SpecError;

/// Steps in which the dashpot alone would stop the rolling of a free pair; a grain may have a dozen contacts.
const RELAXATION_STEPS: f64 = 8.0;

/// Inertia of a rolling contact over m r², both effective: a solid sphere on a wall; any pair of spheres has more.
const INERTIA: f64 = 0.4;

/// M = -min(mu_r r F_n, c |w|) w/|w|: a couple of constant size against rolling (Zhou et al. 1999, model A).
///
/// w is the relative angular velocity in the contact plane, r the effective
/// radius; twisting is free. The dashpot c = 0.4 m r²/(8 dt) regularises the
/// jump at rest as in Coulomb friction.
#[derive(Clone, Copy, Debug)]
pub struct ConstantTorque<R = f64> {
    /// mu_r.
    pub friction: R,
    /// c/(m r²), 1/s.
    pub rate: R,
}

impl Rolling for ConstantTorque {
    type Lanes<R: Real> = ConstantTorque<R>;
    const ACTIVE: bool = true;
    const SLOTS: usize = 0;
    const ODD: u32 = 0;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        needs_rotation(c)?;
        Ok(Self { friction: c.pair.rolling_friction, rate: INERTIA / (RELAXATION_STEPS * c.dt) })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> ConstantTorque<R> {
        ConstantTorque { friction: pick(|c| c.friction), rate: pick(|c| c.rate) }
    }

    #[inline(always)]
    fn couple<R: Real>(
        law: &ConstantTorque<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        _: &mut [R],
    ) -> RollingCouple<R> {
        let roll = touch.roll.reject(touch.normal);
        let (speed, r) = (roll.length(), touch.radius);
        let limit = law.friction * r * normal.load();
        let c = law.rate * touch.mass * r * r;
        let slides = limit.lt(c * speed);
        let coefficient = R::pick(slides, limit / speed, c);
        RollingCouple {
            couple: -(roll * coefficient),
            stored: R::zero(),
            rolled: coefficient * speed * speed * touch.dt,
        }
    }
}

/// M = -k_r theta - c w, at most mu_r r F_n: an elastic-plastic spring against rolling (Ai et al. 2011, model C).
///
/// Carries a couple at rest, which [`ConstantTorque`] cannot. k_r = 9/4 mu_r² r² F_n/delta
/// (Jiang et al. 2005), c from a third of critical damping of 0.4 m r².
#[derive(Clone, Copy, Debug)]
pub struct RollingSpring<R = f64> {
    /// mu_r.
    pub friction: R,
}

/// Place of 1/k_r in the memory.
const COMPLIANCE: usize = 3;

/// Fraction of critical damping of the rolling oscillation (Ai et al. 2011).
const DAMPING_RATIO: f64 = 0.3;

impl Rolling for RollingSpring {
    type Lanes<R: Real> = RollingSpring<R>;
    const ACTIVE: bool = true;
    const SLOTS: usize = 4;
    const ODD: u32 = 0b0111;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        needs_rotation(c)?;
        Ok(Self { friction: c.pair.rolling_friction })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> RollingSpring<R> {
        RollingSpring { friction: pick(|c| c.friction) }
    }

    #[inline(always)]
    fn couple<R: Real>(
        law: &RollingSpring<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        memory: &mut [R],
    ) -> RollingCouple<R> {
        let held = vector(memory);
        let r = touch.radius;
        let arm = law.friction * r;
        let spring = Spring::new(R::splat(2.25) * arm * arm * normal.secant, memory[COMPLIANCE]);
        let inertia = R::splat(INERTIA) * touch.mass * r * r;
        let c = R::splat(2.0 * DAMPING_RATIO) * (spring.stiffness * inertia).sqrt();
        let roll = touch.roll.reject(touch.normal);
        let m = mobilise(held, touch.normal, &spring, roll, c, arm * normal.load(), touch.dt);
        store(memory, m.held);
        memory[COMPLIANCE] = spring.compliance;
        RollingCouple { couple: m.force, stored: m.stored, rolled: m.slid + m.damped + m.latched }
    }
}

fn needs_rotation(c: &PairContext<'_>) -> Result<(), SpecError> {
    if c.rotation {
        return Ok(());
    }
    Err(SpecError::new(
        "rolling",
        "grains that do not rotate have no rolling friction: set `rotation = true` or leave it out",
    ))
}
