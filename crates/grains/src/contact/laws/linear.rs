//! Linear spring and dashpot.

use crate::contact::law::{Normal, NormalForce, PairContext, Touch};
use crate::contact::real::Real;
use crate::material::damping_ratio;
use crate::spec::SpecError;

/// F = k delta + gamma d(delta)/dt, gamma = 2 zeta sqrt(k m) (Clément eq. 2.1, 2.2, 2.23).
///
/// zeta = -ln e / sqrt(pi² + ln² e) gives the restitution e at any speed
/// (eq. 2.18) if the contact lasts until the overlap is gone, during whose
/// last part the force attracts.
#[derive(Clone, Copy, Debug)]
pub struct Linear<R = f64> {
    /// k, N/m.
    pub stiffness: R,
    /// zeta.
    pub damping_ratio: R,
}

impl Normal for Linear {
    type Lanes<R: Real> = Linear<R>;
    const SLOTS: usize = 0;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let stiffness = c
            .pair
            .stiffness
            .ok_or_else(|| SpecError::missing("stiffness", "the linear spring takes its stiffness in N/m"))?;
        Ok(Self { stiffness, damping_ratio: damping_ratio(c.pair.restitution) })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> Linear<R> {
        Linear { stiffness: pick(|c| c.stiffness), damping_ratio: pick(|c| c.damping_ratio) }
    }

    #[inline(always)]
    fn force<R: Real>(law: &Linear<R>, touch: &Touch<R>, _: &mut [R]) -> NormalForce<R> {
        let (k, delta, v) = (law.stiffness, touch.overlap, touch.approach);
        let gamma = R::splat(2.0) * law.damping_ratio * (k * touch.mass).sqrt();
        let elastic = k * delta;
        let damping = gamma * v * touch.presence();
        NormalForce {
            elastic,
            damping,
            secant: k,
            stored: R::splat(0.5) * elastic * delta,
            damped: damping * v * touch.dt,
            latched: R::zero(),
        }
    }
}
