//! A normal, a tangential and a rolling law as one contact law.

use super::law::{MAX_SLOTS, Normal, PairContext, Rolling, Tangential, Touch};
use super::real::{Real, V3};
use crate::spec::SpecError;

/// The three parts for one pair of materials.
#[derive(Clone, Copy, Debug)]
pub struct Pair<N, T, O> {
    normal: N,
    tangential: T,
    rolling: O,
}

/// Kinds of energy that a contact reports, as indices into [`Answer::energy`].
pub mod energy {
    /// Stored in springs, J.
    pub const STORED: usize = 0;
    /// Lost to the normal dashpot in this step, J.
    pub const DAMPED: usize = 1;
    /// Lost to sliding.
    pub const SLID: usize = 2;
    /// Lost to the tangential dashpot.
    pub const TANGENTIAL: usize = 3;
    /// Lost to rolling friction.
    pub const ROLLED: usize = 4;
    /// Lost to hysteresis of springs, or released when bodies part.
    pub const LATCHED: usize = 5;
    /// Number of kinds.
    pub const KINDS: usize = 6;
}

/// What a contact does.
#[derive(Clone, Copy, Debug)]
pub struct Answer<R> {
    /// Force on the first body, N.
    pub force: V3<R>,
    /// Its tangential part, N.
    pub tangential: V3<R>,
    /// Couple on the first body, N m.
    pub couple: V3<R>,
    /// Energies by kind, J.
    pub energy: [R; energy::KINDS],
}

/// What the sweeps need of a complete law.
pub trait Law: Copy + Send + Sync + 'static {
    /// Constants lane by lane.
    type Lanes<R: Real>: Copy;
    /// Numbers remembered.
    const SLOTS: usize;
    /// Slots that change sign when the bodies swap.
    const ODD: u32;
    /// There is a tangential force.
    const TANGENTIAL: bool;
    /// There is a rolling couple.
    const ROLLS: bool;
    /// A part reads the effective radius.
    const RADIUS: bool;
    /// Losses that may not be zero, as bits.
    const LOSSES: u32 = 1 << energy::DAMPED
        | (Self::TANGENTIAL as u32) << energy::SLID
        | (Self::TANGENTIAL as u32) << energy::TANGENTIAL
        | (Self::ROLLS as u32) << energy::ROLLED
        | ((Self::SLOTS > 0) as u32) << energy::LATCHED;
    /// Derives the constants.
    fn build(pair: &PairContext<'_>) -> Result<Self, SpecError>;
    /// Lane `k` takes the constants of `table[class(k)]`.
    fn lanes<R: Real>(table: &[Self], class: impl Fn(usize) -> usize) -> Self::Lanes<R>;
    /// The contact's answer.
    fn act<R: Real>(law: &Self::Lanes<R>, touch: &Touch<R>, memory: &mut [R; MAX_SLOTS]) -> Answer<R>;
    /// Energy released by the springs of bodies that no longer touch, J.
    fn released<R: Real>(law: &Self::Lanes<R>, memory: &[R; MAX_SLOTS]) -> R;
}

impl<N: Normal, T: Tangential, O: Rolling> Law for Pair<N, T, O> {
    type Lanes<R: Real> = (N::Lanes<R>, T::Lanes<R>, O::Lanes<R>);
    const SLOTS: usize = {
        let n = N::SLOTS + T::SLOTS + O::SLOTS;
        assert!(n <= MAX_SLOTS);
        n
    };
    const ODD: u32 = T::ODD << N::SLOTS | O::ODD << (N::SLOTS + T::SLOTS);
    const TANGENTIAL: bool = T::ACTIVE;
    const ROLLS: bool = O::ACTIVE;
    const RADIUS: bool = N::RADIUS || O::ACTIVE;

    fn build(pair: &PairContext<'_>) -> Result<Self, SpecError> {
        Ok(Self { normal: N::build(pair)?, tangential: T::build(pair)?, rolling: O::build(pair)? })
    }

    #[inline(always)]
    fn lanes<R: Real>(table: &[Self], class: impl Fn(usize) -> usize) -> Self::Lanes<R> {
        (
            N::lanes(|get| R::from_lanes(|k| get(&table[class(k)].normal))),
            T::lanes(|get| R::from_lanes(|k| get(&table[class(k)].tangential))),
            O::lanes(|get| R::from_lanes(|k| get(&table[class(k)].rolling))),
        )
    }

    #[inline(always)]
    fn act<R: Real>(law: &Self::Lanes<R>, touch: &Touch<R>, memory: &mut [R; MAX_SLOTS]) -> Answer<R> {
        let (mine, rest) = memory.split_at_mut(N::SLOTS);
        let (tangent, rest) = rest.split_at_mut(T::SLOTS);
        let n = N::force(&law.0, touch, mine);
        let t = T::force(&law.1, touch, &n, tangent);
        let o = O::couple(&law.2, touch, &n, &mut rest[..O::SLOTS]);
        Answer {
            force: touch.normal * (n.elastic + n.damping) + t.force,
            tangential: t.force,
            couple: o.couple,
            energy: [
                n.stored + t.stored + o.stored,
                n.damped,
                t.slid,
                t.damped,
                o.rolled,
                n.latched + t.latched,
            ],
        }
    }

    #[inline(always)]
    fn released<R: Real>(law: &Self::Lanes<R>, memory: &[R; MAX_SLOTS]) -> R {
        let end = N::SLOTS + T::SLOTS;
        N::released(&law.0, &memory[..N::SLOTS]) + T::released(&law.1, &memory[N::SLOTS..end])
    }
}
