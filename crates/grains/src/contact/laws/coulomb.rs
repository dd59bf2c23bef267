//! Sliding friction without memory.

use crate::contact::law::{NormalForce, PairContext, Tangential, TangentialForce, Touch};
use crate::contact::real::{Mask, Real};
use crate::spec::SpecError;

/// Steps in which the dashpot alone would stop the slip of a free pair.
///
/// The explicit dashpot must stay stable with a dozen neighbours per grain
/// and, when grains rotate, 7/2 times lighter contacts.
const RELAXATION_STEPS: [f64; 2] =
    [1.0 / crate::material::RELAXED_PER_STEP, 3.5 / crate::material::RELAXED_PER_STEP];

/// F_t = -min(mu F_n, gamma_t |v_t|) v_t/|v_t|, F_n = max(0, F_el + F_damp) (Clément eq. 2.3, corrected).
///
/// The dashpot gamma_t regularises Coulomb's jump at rest: slower than
/// mu F_n/gamma_t a contact creeps instead of chattering. By default
/// gamma_t = m_eff/(8 dt), or m_eff/(28 dt) if grains rotate.
#[derive(Clone, Copy, Debug)]
pub struct Coulomb<R = f64> {
    /// mu.
    pub friction: R,
    /// gamma_t if given, kg/s, else 0.
    pub damping: R,
    /// Rate that gives gamma_t = rate * m_eff, 1/s; 0 if gamma_t is given.
    pub rate: R,
}

impl Tangential for Coulomb {
    type Lanes<R: Real> = Coulomb<R>;
    const SLOTS: usize = 0;
    const ODD: u32 = 0;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let rate = 1.0 / (RELAXATION_STEPS[usize::from(c.rotation)] * c.dt);
        Ok(match c.pair.tangential_damping {
            Some(damping) => Self { friction: c.pair.friction, damping, rate: 0.0 },
            None => Self { friction: c.pair.friction, damping: 0.0, rate },
        })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> Coulomb<R> {
        Coulomb { friction: pick(|c| c.friction), damping: pick(|c| c.damping), rate: pick(|c| c.rate) }
    }

    #[inline(always)]
    fn force<R: Real>(
        law: &Coulomb<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        _: &mut [R],
    ) -> TangentialForce<R> {
        let square = touch.slip.dot(touch.slip);
        let limit = law.friction * normal.load();
        let gamma = law.damping + law.rate * touch.mass;
        let slides = (limit * limit).lt(gamma * gamma * square);
        let coefficient = if slides.any() {
            // Where the contact slides the speed is positive, so the quotient is finite.
            R::pick(slides, limit / square.sqrt(), gamma)
        } else {
            gamma
        };
        let lost = coefficient * square * touch.dt;
        TangentialForce {
            force: -(touch.slip * coefficient),
            stored: R::zero(),
            slid: lost.keep(slides),
            damped: lost.keep(!slides),
            latched: R::zero(),
        }
    }
}
