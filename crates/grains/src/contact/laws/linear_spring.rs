//! Tangential spring and dashpot of constant stiffness behind a slider.

use super::history::{Spring, mobilise, store, vector};
use crate::contact::law::{NormalForce, PairContext, Tangential, TangentialForce, Touch};
use crate::contact::real::Real;
use crate::material::damping_ratio;
use crate::spec::SpecError;

/// F_t = -k_t xi - gamma_t v_t, at most mu F_n, with xi the slip since touch that the spring still holds
/// (Cundall & Strack 1979).
///
/// k_t = ratio * k (2/7 by default); gamma_t as given, or such that the
/// tangential oscillation has the damping ratio of the normal one.
#[derive(Clone, Copy, Debug)]
pub struct LinearSpring<R = f64> {
    /// k_t, N/m.
    pub stiffness: R,
    /// 1/k_t, m/N.
    pub compliance: R,
    /// mu.
    pub friction: R,
    /// gamma_t if given, kg/s.
    pub damping: R,
    /// (gamma_t)²/m otherwise, kg/s².
    pub damping_squared: R,
}

/// Tangential over normal stiffness where the case gives none: equal periods along and across for solid spheres.
const STIFFNESS_RATIO: f64 = 2.0 / 7.0;

/// Mass that a tangential impulse moves over the effective mass, without and with rotation of solid spheres.
pub(super) const TANGENTIAL_MASS: [f64; 2] = [1.0, 2.0 / 7.0];

impl Tangential for LinearSpring {
    type Lanes<R: Real> = LinearSpring<R>;
    const SLOTS: usize = 3;
    const ODD: u32 = 0b111;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let why = "the tangential spring takes its stiffness from that of the linear or latching spring, in N/m; with a Hertzian law use `mindlin`";
        let k = c.pair.stiffness.ok_or_else(|| SpecError::missing("stiffness", why))?;
        let stiffness = c.pair.tangential_ratio.unwrap_or(STIFFNESS_RATIO) * k;
        let zeta = damping_ratio(c.pair.restitution);
        let (damping, damping_squared) = match c.pair.tangential_damping {
            Some(gamma) => (gamma, 0.0),
            None => (0.0, 4.0 * zeta * zeta * stiffness * TANGENTIAL_MASS[usize::from(c.rotation)]),
        };
        Ok(Self {
            stiffness,
            compliance: 1.0 / stiffness,
            friction: c.pair.friction,
            damping,
            damping_squared,
        })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> LinearSpring<R> {
        LinearSpring {
            stiffness: pick(|c| c.stiffness),
            compliance: pick(|c| c.compliance),
            friction: pick(|c| c.friction),
            damping: pick(|c| c.damping),
            damping_squared: pick(|c| c.damping_squared),
        }
    }

    #[inline(always)]
    fn force<R: Real>(
        law: &LinearSpring<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        memory: &mut [R],
    ) -> TangentialForce<R> {
        let held = vector(memory);
        let gamma = law.damping + (law.damping_squared * touch.mass).sqrt();
        let limit = law.friction * normal.load();
        let spring = Spring { stiffness: law.stiffness, compliance: law.compliance, before: law.compliance };
        let m = mobilise(held, touch.normal, &spring, touch.slip, gamma, limit, touch.dt);
        store(memory, m.held);
        TangentialForce {
            force: m.force,
            stored: m.stored,
            slid: m.slid,
            damped: m.damped,
            latched: R::zero(),
        }
    }

    #[inline(always)]
    fn released<R: Real>(law: &LinearSpring<R>, memory: &[R]) -> R {
        let held = vector(memory);
        R::splat(0.5) * held.dot(held) * law.compliance
    }
}
