//! A spring along the surface that remembers its force, gives in at a limit, and never gives back more than it took.

use crate::contact::law::Touch;
use crate::contact::real::{Mask, Real, V3};

/// Keeps the compliance finite where nothing touches, N/m or N m.
const TINY: f64 = 1e-30;

/// Stiffness of a spring, its inverse, and its inverse when it was loaded last (0 before the first touch).
#[derive(Clone, Copy, Debug)]
pub(super) struct Spring<R> {
    pub stiffness: R,
    pub compliance: R,
    pub before: R,
}

impl<R: Real> Spring<R> {
    /// Of `stiffness` now and compliance `before`.
    #[inline(always)]
    pub fn new(stiffness: R, before: R) -> Self {
        let stiffness = stiffness.max(R::splat(TINY));
        Self { stiffness, compliance: R::splat(1.0) / stiffness, before }
    }
}

/// Outcome of one step of a spring, a dashpot beside it and a slider behind both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mobilised<R> {
    /// What the spring holds half a step on, to be remembered.
    pub held: V3<R>,
    /// Force with the dashpot, at most the limit.
    pub force: V3<R>,
    /// Energy stored.
    pub stored: R,
    /// Energy lost in the slider.
    pub slid: R,
    /// Energy lost in the dashpot.
    pub damped: R,
    /// Energy lost because the stiffness changed under load.
    pub latched: R,
}

/// Advances a spring that held `held` through `rate * dt`, `rate` lying in the plane across `normal`.
///
/// The spring first turns with that plane, see [`turned`].
///
/// `rate` belongs to the time of the force, so the spring is carried from half a step before to half a
/// step after it, and the force is the mean of the two: second order, where the sum of whole steps would
/// damp the spring by `k dt/2`.
///
/// When the stiffness falls the force falls with it, when it rises the force stays: either way the
/// stored energy `held²/(2 k)` cannot grow without work (Thornton, Cummins & Cleary 2013).
#[inline(always)]
pub(super) fn mobilise<R: Real>(
    held: V3<R>,
    normal: V3<R>,
    spring: &Spring<R>,
    rate: V3<R>,
    damping: R,
    limit: R,
    dt: R,
) -> Mobilised<R> {
    let half = R::splat(0.5);
    let (soft_before, soft_now) = (half * spring.before, half * spring.compliance);
    // Sizes and powers come from three products of vectors, since each further one would wait for a vector.
    let size_before = held.dot(held);
    let (flat, scale) = flattened(held, size_before, normal);
    let weaker = (spring.stiffness * spring.before).min(R::splat(1.0));
    let kept = flat * (scale * weaker);
    let size = size_before * (weaker * weaker);
    let latched = size_before * soft_before - size * soft_now;
    let (pace, pull) = (rate.dot(rate), kept.dot(rate));

    let step = spring.stiffness * dt;
    let resistance = half * step + damping;
    let limit_squared = limit * limit;
    let wanted = kept - rate * resistance;
    // - wanted . rate, and wanted²
    let taken = resistance * pace - pull;
    let (cut, slides) = shortening(size + resistance * (taken - pull), limit, limit_squared);
    let force = wanted * cut;
    let next = size + step * (step * pace - (pull + pull));
    let held = (kept - rate * step) * shortening(next, limit, limit_squared).0;
    let damped = (damping * pace * dt).keep(!slides);
    // What the contact took, less what the spring and the dashpot account for, is the slider's: never negative.
    let slid = taken * cut * dt - damped - (next.min(limit_squared) - size) * soft_now;
    let spring = V3::pick(slides, force, kept - rate * (half * step));
    Mobilised { held, force, stored: spring.dot(spring) * soft_now, slid, damped, latched }
}

/// What a vector of this square is multiplied by to be no longer than `limit`, and whether it has to be.
#[inline(always)]
fn shortening<R: Real>(square: R, limit: R, limit_squared: R) -> (R, R::Mask) {
    let one = R::splat(1.0);
    let over = limit_squared.lt(square);
    if !over.any() {
        return (one, over);
    }
    // Where it is over the limit the square is positive; root and quotient do not wait for each other.
    let square = R::pick(over, square, one);
    (R::pick(over, square.sqrt() * (limit / square), one), over)
}

/// `held`, of square `size`, projected on the plane across `normal`, and what restores its length.
#[inline(always)]
fn flattened<R: Real>(held: V3<R>, size: R, normal: V3<R>) -> (V3<R>, R) {
    let across = held.dot(normal);
    let left = size - across * across;
    let any = R::zero().lt(left);
    (held - normal * across, (size / R::pick(any, left, R::splat(1.0))).sqrt().keep(any))
}

/// `v` shortened to `limit`, and whether it had to be.
#[inline(always)]
pub(super) fn capped<R: Real>(v: V3<R>, limit: R) -> (V3<R>, R::Mask) {
    let (cut, over) = shortening(v.dot(v), limit, limit * limit);
    (v * cut, over)
}

/// `held` turned with the contact plane: projected on the plane of `touch`, length kept (Walton & Braun 1986).
///
/// Lan 2-4-16 lets the length shrink; the difference is of second order in the turn of one step.
#[inline(always)]
pub(super) fn turned<R: Real>(held: V3<R>, touch: &Touch<R>) -> V3<R> {
    let (flat, scale) = flattened(held, held.dot(held), touch.normal);
    flat * scale
}

/// The first three numbers of `memory` as a vector.
#[inline(always)]
pub(super) fn vector<R: Real>(memory: &[R]) -> V3<R> {
    V3::new(memory[0], memory[1], memory[2])
}

/// Writes a vector to the first three numbers of `memory`.
#[inline(always)]
pub(super) fn store<R: Real>(memory: &mut [R], v: V3<R>) {
    (memory[0], memory[1], memory[2]) = (v.x, v.y, v.z);
}
