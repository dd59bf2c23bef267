//! Tangential spring of a Hertzian contact behind a slider.

use super::history::{Spring, mobilise, store, vector};
use super::linear_spring::TANGENTIAL_MASS;
use crate::contact::law::{NormalForce, PairContext, Tangential, TangentialForce, Touch};
use crate::contact::real::Real;
use crate::material::{damping_ratio, mindlin_ratio};
use crate::spec::SpecError;

/// dF_t = -k_t dxi, k_t = 8 G* sqrt(r delta), |F_t| <= mu F_n (Mindlin 1949, no-slip limit).
///
/// Remembers the force, not the displacement, and lets it shrink with k_t on
/// unloading: a stored displacement would create energy (Thornton, Cummins &
/// Cleary 2013). k_t = ratio * dF_n/d(delta) with ratio 4 G*/E*, or as given.
#[derive(Clone, Copy, Debug)]
pub struct Mindlin<R = f64> {
    /// k_t over the secant F_n/delta: 3/2 of the ratio.
    pub ratio: R,
    /// mu.
    pub friction: R,
    /// gamma_t if given, kg/s.
    pub damping: R,
    /// gamma_t over sqrt(m F_n/delta) otherwise.
    pub damping_number: R,
}

/// Place of 1/k_t in the memory.
const COMPLIANCE: usize = 3;

impl Tangential for Mindlin {
    type Lanes<R: Real> = Mindlin<R>;
    const SLOTS: usize = 4;
    const ODD: u32 = 0b0111;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let ratio = match (c.pair.tangential_ratio, c.first.elastic, c.second.elastic) {
            (Some(ratio), ..) => ratio,
            (None, Some(a), Some(b)) => mindlin_ratio(&a, &b),
            _ => {
                let why = "without youngs_modulus and poisson_ratio of both materials it must be given";
                return Err(SpecError::missing("tangential_ratio", why));
            }
        };
        let zeta = damping_ratio(c.pair.restitution);
        let ratio = 1.5 * ratio;
        let (damping, damping_number) = match c.pair.tangential_damping {
            Some(gamma) => (gamma, 0.0),
            None => (0.0, 2.0 * zeta * (ratio * TANGENTIAL_MASS[usize::from(c.rotation)]).sqrt()),
        };
        Ok(Self { ratio, friction: c.pair.friction, damping, damping_number })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> Mindlin<R> {
        Mindlin {
            ratio: pick(|c| c.ratio),
            friction: pick(|c| c.friction),
            damping: pick(|c| c.damping),
            damping_number: pick(|c| c.damping_number),
        }
    }

    #[inline(always)]
    fn force<R: Real>(
        law: &Mindlin<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        memory: &mut [R],
    ) -> TangentialForce<R> {
        let held = vector(memory);
        let spring = Spring::new(law.ratio * normal.secant, memory[COMPLIANCE]);
        let gamma = law.damping + law.damping_number * (normal.secant * touch.mass).sqrt();
        let limit = law.friction * normal.load();
        let m = mobilise(held, touch.normal, &spring, touch.slip, gamma, limit, touch.dt);
        store(memory, m.held);
        memory[COMPLIANCE] = spring.compliance;
        TangentialForce {
            force: m.force,
            stored: m.stored,
            slid: m.slid,
            damped: m.damped,
            latched: m.latched,
        }
    }

    #[inline(always)]
    fn released<R: Real>(_: &Mindlin<R>, memory: &[R]) -> R {
        let held = vector(memory);
        R::splat(0.5) * held.dot(held) * memory[COMPLIANCE]
    }
}
