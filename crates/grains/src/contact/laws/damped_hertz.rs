//! Hertzian spring with the viscous dashpot of Kuwabara and Kono.

use super::hertz::HertzStiffness;
use super::roots::fifth_root;
use crate::contact::law::{Normal, NormalForce, PairContext, Touch};
use crate::contact::real::Real;
use crate::material::viscous_damping_number;
use crate::spec::SpecError;

/// F = k delta^(3/2) + c delta^(1/2) d(delta)/dt (Clément eq. 2.4 corrected, 2.8), k = (4/3) E* sqrt(r).
///
/// c = beta(e) m^(2/5) k^(3/5) v^(-1/5) gives every pair, whatever its sizes,
/// the restitution e at impact speed v; slower impacts lose less, faster ones more.
#[derive(Clone, Copy, Debug)]
pub struct DampedHertz<R = f64> {
    /// Stiffness of the pair.
    pub stiffness: HertzStiffness<R>,
    /// beta v^(-1/5), (m/s)^(-1/5).
    pub damping: R,
}

/// Smallest restitution that the solver of the collision is made for.
const LOWEST: f64 = 0.01;

impl Normal for DampedHertz {
    type Lanes<R: Real> = DampedHertz<R>;
    const SLOTS: usize = 0;
    const RADIUS: bool = true;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let e = c.pair.restitution;
        if !(e > LOWEST && e <= 1.0) {
            let why = format!("{e} given; the damped Hertz law needs a value above {LOWEST} and at most 1");
            return Err(SpecError::new("restitution", why));
        }
        let stiffness = HertzStiffness::build(c)?;
        if e == 1.0 {
            return Ok(Self { stiffness, damping: 0.0 });
        }
        let v = c.pair.at_speed.filter(|&v| v > 0.0).ok_or_else(|| {
            SpecError::missing(
                "restitution.at_speed",
                "restitution depends on speed in this law: say at which impact speed it holds, as { value = 0.9, at_speed = \"0.5 m/s\" }",
            )
        })?;
        Ok(Self { stiffness, damping: viscous_damping_number(e) * v.powf(-0.2) })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> DampedHertz<R> {
        let stiffness =
            HertzStiffness { given: pick(|c| c.stiffness.given), modulus: pick(|c| c.stiffness.modulus) };
        DampedHertz { stiffness, damping: pick(|c| c.damping) }
    }

    #[inline(always)]
    fn force<R: Real>(law: &DampedHertz<R>, touch: &Touch<R>, _: &mut [R]) -> NormalForce<R> {
        let squared = law.stiffness.squared(touch);
        let root = touch.overlap.sqrt();
        let stiffness = squared.sqrt();
        let secant = stiffness * root;
        let elastic = secant * touch.overlap;
        // m^(2/5) k^(3/5) = (m² k³)^(1/5)
        let scale = fifth_root(touch.mass * touch.mass * squared * stiffness);
        let damping = law.damping * scale * root * touch.approach;
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
