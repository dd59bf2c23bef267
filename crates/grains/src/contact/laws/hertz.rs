//! Hertzian spring, with a dashpot that gives the same restitution at any speed.

use crate::contact::law::{Normal, NormalForce, PairContext, Touch};
use crate::contact::real::Real;
use crate::material::{damping_ratio, effective_modulus};
use crate::spec::SpecError;

/// F = k delta^(3/2) + c delta^(1/4) d(delta)/dt, k = (4/3) E* sqrt(r), c = sqrt(5) zeta sqrt(m k)
/// (Clément eq. 2.4 corrected, 2.5-2.7; dashpot of Tsuji et al. 1992 as solved by Antypov & Elliott 2011).
///
/// zeta = -ln e / sqrt(pi² + ln² e) gives the restitution e exactly and at any
/// speed; e = 1 is the elastic law of the thesis.
#[derive(Clone, Copy, Debug)]
pub struct Hertz<R = f64> {
    /// Stiffness of the pair.
    pub stiffness: HertzStiffness<R>,
    /// sqrt(5) zeta.
    pub damping: R,
}

/// k of F = k delta^(3/2): either given, or (4/3) E* sqrt(r).
#[derive(Clone, Copy, Debug)]
pub struct HertzStiffness<R = f64> {
    /// k² if given, N² m^(-3), else 0.
    pub given: R,
    /// (16/9) E*² if taken from the materials, Pa², else 0.
    pub modulus: R,
}

impl HertzStiffness {
    /// The stiffness that the case gives, or what the materials say.
    pub(super) fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        if let Some(k) = c.pair.stiffness {
            return Ok(Self { given: k * k, modulus: 0.0 });
        }
        match (c.first.elastic, c.second.elastic) {
            (Some(a), Some(b)) => {
                let e = 4.0 / 3.0 * effective_modulus(&a, &b);
                Ok(Self { given: 0.0, modulus: e * e })
            }
            (a, _) => {
                let name = if a.is_none() { &c.first.name } else { &c.second.name };
                let why = "Hertzian contacts take their stiffness from it; or give `stiffness` in N/m^1.5";
                Err(SpecError::missing(&format!("youngs_modulus of material `{name}`"), why))
            }
        }
    }
}

impl<R: Real> HertzStiffness<R> {
    /// k², N² m^(-3).
    #[inline(always)]
    pub(super) fn squared(&self, touch: &Touch<R>) -> R {
        self.given + self.modulus * touch.radius
    }
}

impl Normal for Hertz {
    type Lanes<R: Real> = Hertz<R>;
    const SLOTS: usize = 0;
    const RADIUS: bool = true;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let damping = 5.0_f64.sqrt() * damping_ratio(c.pair.restitution);
        Ok(Self { stiffness: HertzStiffness::build(c)?, damping })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> Hertz<R> {
        let stiffness =
            HertzStiffness { given: pick(|c| c.stiffness.given), modulus: pick(|c| c.stiffness.modulus) };
        Hertz { stiffness, damping: pick(|c| c.damping) }
    }

    #[inline(always)]
    fn force<R: Real>(law: &Hertz<R>, touch: &Touch<R>, _: &mut [R]) -> NormalForce<R> {
        let secant = (law.stiffness.squared(touch) * touch.overlap).sqrt();
        let elastic = secant * touch.overlap;
        let damping = law.damping * (secant * touch.mass).sqrt() * touch.approach;
        NormalForce {
            elastic,
            damping,
            secant,
            stored: R::splat(0.4) * elastic * touch.overlap,
            damped: damping * touch.approach * touch.dt,
            latched: R::zero(),
        }
    }
}
