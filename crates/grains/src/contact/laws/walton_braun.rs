//! Partially latching spring and incremental friction of Walton and Braun (Lan 2.4).

use super::history::{capped, store, turned, vector};
use super::roots::cube_root;
use crate::contact::law::{Normal, NormalForce, PairContext, Tangential, TangentialForce, Touch};
use crate::contact::real::{Real, V3};
use crate::material::latching_unloading_stiffness;
use crate::spec::SpecError;

/// F = min(K1 delta, K2 (delta - delta0)), delta0 = delta_max (1 - K1/K2), K2 = K1/e² (Lan 2-4-1, 2-4-12).
///
/// Remembers the largest overlap of the contact; between delta0 and zero there
/// is no force, and the memory goes when the contact opens. The restitution e
/// holds at any speed and there is no attraction.
#[derive(Clone, Copy, Debug)]
pub struct WaltonBraun<R = f64> {
    /// K1, N/m.
    pub loading: R,
    /// K2, N/m.
    pub unloading: R,
    /// 1/K2, m/N.
    pub compliance: R,
    /// 1 - K1/K2.
    pub lost: R,
}

impl Normal for WaltonBraun {
    type Lanes<R: Real> = WaltonBraun<R>;
    const SLOTS: usize = 1;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let why = "the latching spring takes its loading stiffness K1 in N/m";
        let loading = c.pair.stiffness.ok_or_else(|| SpecError::missing("stiffness", why))?;
        if c.pair.restitution <= 0.0 {
            return Err(SpecError::new(
                "restitution",
                "the latching spring needs a value above 0: K2 = K1/e²",
            ));
        }
        let unloading = latching_unloading_stiffness(loading, c.pair.restitution);
        Ok(Self { loading, unloading, compliance: 1.0 / unloading, lost: 1.0 - loading / unloading })
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> WaltonBraun<R> {
        WaltonBraun {
            loading: pick(|c| c.loading),
            unloading: pick(|c| c.unloading),
            compliance: pick(|c| c.compliance),
            lost: pick(|c| c.lost),
        }
    }

    #[inline(always)]
    fn force<R: Real>(law: &WaltonBraun<R>, touch: &Touch<R>, memory: &mut [R]) -> NormalForce<R> {
        let (k1, k2, half) = (law.loading, law.unloading, R::splat(0.5));
        let before = memory[0];
        let largest = before.max(touch.overlap);
        memory[0] = largest;
        let open = largest * law.lost;
        let elastic = (k1 * touch.overlap).min(k2 * (touch.overlap - open)).max(R::zero());
        // Of the work K1 delta²/2 of loading, K1/K2 comes back.
        let latched = half * k1 * law.lost * (largest * largest - before * before);
        NormalForce {
            elastic,
            damping: R::zero(),
            // Asked for by rolling springs only.
            secant: elastic / R::pick(R::zero().lt(touch.overlap), touch.overlap, R::splat(1.0)),
            stored: half * elastic * elastic * law.compliance,
            damped: R::zero(),
            latched,
        }
    }
}

/// Numbers that the friction remembers, as places in its memory.
const TURNING: usize = 3;
const LOAD: usize = 4;
const UNLOADING: usize = 5;

/// T' = T + K_t ds along the force, + K0 ds across it, |T| <= mu N (Lan 2-4-13 to 2-4-21, corrected).
///
/// K_t = K0 [1 - (T - T*)/(mu N - T*)]^(1/3) while the slip adds to the force,
/// K0 [1 - (T* - T)/(mu N + T*)]^(1/3) while it takes away; T* is 0 at first, T
/// at each turn of the slip, and scales with N (Walton & Braun 1986).
/// K0 = ratio * K1.
///
/// Not strictly passive: a force that was built up under a large N and is
/// released under a smaller one meets a softer spring and returns up to 7 %
/// more than it took.
#[derive(Clone, Copy, Debug)]
pub struct WaltonBraunFriction<R = f64> {
    /// K0, N/m.
    pub stiffness: R,
    /// 1/K0, m/N.
    pub compliance: R,
    /// mu.
    pub friction: R,
}

impl WaltonBraunFriction {
    fn new(stiffness: f64, friction: f64) -> Self {
        Self { stiffness, compliance: 1.0 / stiffness, friction }
    }
}

/// Tangential over normal stiffness where the case gives none: 2(1 - nu)/(2 - nu) at nu = 1/3 (Mindlin 1949).
const STIFFNESS_RATIO: f64 = 0.8;

impl Tangential for WaltonBraunFriction {
    type Lanes<R: Real> = WaltonBraunFriction<R>;
    const SLOTS: usize = 6;
    /// The force is odd; its scalars are measured along it.
    const ODD: u32 = 0b111;

    fn build(c: &PairContext<'_>) -> Result<Self, SpecError> {
        let why = "this friction takes its stiffness from that of the linear or latching spring, in N/m";
        let k1 = c.pair.stiffness.ok_or_else(|| SpecError::missing("stiffness", why))?;
        let ratio = c.pair.tangential_ratio.unwrap_or(STIFFNESS_RATIO);
        Ok(Self::new(ratio * k1, c.pair.friction))
    }

    #[inline(always)]
    fn lanes<R: Real>(pick: impl Fn(fn(&Self) -> f64) -> R) -> WaltonBraunFriction<R> {
        WaltonBraunFriction {
            stiffness: pick(|c| c.stiffness),
            compliance: pick(|c| c.compliance),
            friction: pick(|c| c.friction),
        }
    }

    #[inline(always)]
    fn force<R: Real>(
        law: &WaltonBraunFriction<R>,
        touch: &Touch<R>,
        normal: &NormalForce<R>,
        memory: &mut [R],
    ) -> TangentialForce<R> {
        let (zero, one, half) = (R::zero(), R::splat(1.0), R::splat(0.5));
        let (k0, limit) = (law.stiffness, law.friction * normal.load());
        let old = turned(vector(memory), touch);
        let ds = touch.slip * touch.dt;

        // Along the force, or along the slip where there is none yet.
        let (size, path) = (old.length(), ds.length());
        let held = zero.lt(size);
        let unit = V3::pick(held, old, -ds) * (one / R::pick(held, size, R::pick(zero.lt(path), path, one)));
        let along = -ds.dot(unit);
        let across = ds + unit * along;

        // The turning point scales with the load, and is set anew where the slip turns.
        let load_before = memory[LOAD];
        let loaded = zero.lt(load_before);
        let scale = R::pick(loaded, limit / R::pick(loaded, load_before, one), one);
        let turning = memory[TURNING] * scale;
        let magnitude = size.min(limit);
        let was_unloading = half.lt(memory[UNLOADING]);
        let still = along.abs().le(zero);
        let unloads = (along.lt(zero)) | (still & was_unloading);
        let turns = (unloads & !was_unloading) | (!unloads & was_unloading);
        let turning = R::pick(turns, magnitude, turning).min(limit).max(-limit);

        let sign = R::pick(unloads, -one, one);
        let softness = fraction(sign * (magnitude - turning), limit - sign * turning);
        let k = k0 * cube_root((one - softness).max(R::splat(SOFTEST)));

        // Carried from half a step before the force to half a step after it, see `mobilise`.
        let change = unit * (k * along) - across * k0;
        let (force, slides) = capped(old + change * half, limit);
        let (new, _) = capped(old + change, limit);
        // A force that passes through zero goes on in its new direction, where unloading means loading
        // and the turning point lies on the other side.
        let flips = new.dot(unit).lt(zero);
        store(memory, new);
        memory[TURNING] = R::pick(flips, -turning, turning);
        memory[LOAD] = limit;
        memory[UNLOADING] = R::pick(unloads & !flips, one, zero);

        // A spring that softens returns on unloading some of what it seemed to lose on loading: `latched`
        // is negative then, and positive over a closed cycle at steady load.
        let stored = |t: V3<R>| half * t.dot(t) * law.compliance;
        let lost = stored(old) - stored(new) - force.dot(ds);
        TangentialForce {
            force,
            stored: stored(force),
            slid: lost.keep(slides),
            damped: zero,
            latched: lost.keep(!slides),
        }
    }

    #[inline(always)]
    fn released<R: Real>(law: &WaltonBraunFriction<R>, memory: &[R]) -> R {
        let held = vector(memory);
        R::splat(0.5) * held.dot(held) * law.compliance
    }
}

/// Smallest bracket of K_t: keeps a hundredth of K0 where the force reaches the limit.
const SOFTEST: f64 = 1e-6;

/// part/whole between 0 and 1; 1 where the whole is nothing.
#[inline(always)]
fn fraction<R: Real>(part: R, whole: R) -> R {
    let any = R::zero().lt(whole);
    R::pick(any, (part / R::pick(any, whole, R::splat(1.0))).max(R::zero()), R::splat(1.0)).min(R::splat(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const K0: f64 = 1e4;
    const MU: f64 = 0.5;
    const STEP: f64 = 1e-9;

    struct Contact {
        memory: [f64; 6],
        load: f64,
        s: f64,
    }

    impl Contact {
        fn new(load: f64) -> Self {
            Self { memory: [0.0; 6], load, s: 0.0 }
        }

        /// Slips by `ds` (positive: adds to a force along +x); the force held after it.
        fn slip(&mut self, ds: f64) -> f64 {
            let law = WaltonBraunFriction::new(K0, MU);
            let o = 0.0;
            let touch = Touch {
                overlap: 1e-5,
                normal: V3::new(0.0, 0.0, 1.0),
                approach: o,
                slip: V3::new(-ds / STEP, 0.0, 0.0),
                roll: V3::zero(),
                mass: 1.0,
                radius: 1.0,
                dt: STEP,
            };
            let n =
                NormalForce { elastic: self.load, damping: o, secant: o, stored: o, damped: o, latched: o };
            let _ = WaltonBraunFriction::force(&law, &touch, &n, &mut self.memory);
            self.s += ds;
            self.memory[0]
        }
    }

    /// Displacement from a turn at `t0` to `t` at load limit `l`, along the law integrated (Mindlin & Deresiewicz 1953).
    fn displacement(t0: f64, t: f64, l: f64) -> f64 {
        let b = if t > t0 { l - t0 } else { -(l + t0) };
        1.5 * b / K0 * (1.0 - (1.0 - (t - t0) / b).powf(2.0 / 3.0))
    }

    /// Euler's rule over some thousand steps: relative error of order 1/1000.
    const SLACK: f64 = 2e-3;

    #[test]
    fn loading_and_unloading_follow_mindlin_and_deresiewicz() {
        let (load, limit) = (2.0, 1.0);
        let ds = 1e-4 / 4000.0;
        let mut c = Contact::new(load);
        let mut t = 0.0;
        while t < 0.7 * limit {
            t = c.slip(ds);
        }
        assert!((c.s / displacement(0.0, t, limit) - 1.0).abs() < SLACK);
        // Back through zero, where the direction of the force turns over, to the other side.
        let (t1, s1) = (t, c.s);
        for goal in [0.3, 0.01, -0.3, -0.6] {
            while t > goal * limit {
                t = c.slip(-ds);
            }
            let wanted = displacement(t1, t, limit);
            assert!(((c.s - s1) / wanted - 1.0).abs() < SLACK, "T {t}: {} for {wanted}", c.s - s1);
        }
        // A second turn starts afresh at K0.
        let (t2, s2) = (t, c.s);
        while t < 0.0 {
            t = c.slip(ds);
        }
        assert!(((c.s - s2) / displacement(t2, t, limit) - 1.0).abs() < SLACK);
    }

    #[test]
    fn the_turning_point_scales_with_the_load() {
        let ds = 1e-4 / 4000.0;
        let mut c = Contact::new(2.0);
        let mut t = 0.0;
        while t < 0.6 {
            t = c.slip(ds);
        }
        let turn = t;
        while t > 0.4 {
            t = c.slip(-ds);
        }
        c.load = 4.0;
        let before = c.slip(0.0);
        let after = c.slip(-ds);
        // K0 [1 - (2 T* - T)/(2 mu N + 2 T*)]^(1/3), the load doubled with mu N = 1 before.
        let wanted = K0 * (1.0 - (2.0 * turn - before) / (2.0 + 2.0 * turn)).cbrt();
        assert!(((before - after) / ds / wanted - 1.0).abs() < 1e-9, "{} {wanted}", (before - after) / ds);
    }
}
