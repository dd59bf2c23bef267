//! From the names of a case to compiled sweeps: one virtual call per list.

use super::law::{MAX_SLOTS, Normal, PairContext, Tangential, Touch};
use super::laws;
use super::menu::{NormalLaw, RollingLaw, TangentialLaw};
use super::pair::{Answer, Law, Pair};
use super::sweep::{PairJob, Tally, sweep};
use super::wall_sweep::{WallJob, sweep_walls};
use crate::lanes::{Job, Level, Wide};
use crate::spec::{DemSpec, SpecError};
use std::marker::PhantomData;

/// A complete law with its constants, ready to sweep.
pub trait ContactSweep: Send + Sync {
    /// Numbers that a contact remembers.
    fn slots(&self) -> usize;
    /// Slots that change sign when the bodies swap places.
    fn odd(&self) -> u32;
    /// There are rolling couples.
    fn rolls(&self) -> bool;
    /// Evaluates a list of pairs.
    fn pairs(&self, job: PairJob<'_>, counted: &mut Tally);
    /// Evaluates a list of wall contacts.
    fn walls(&self, job: WallJob<'_>, counted: &mut Tally);
    /// Evaluates one contact of pair class `class`, for those who look.
    fn single(&self, class: usize, touch: &Touch<f64>, memory: &mut [f64; MAX_SLOTS]) -> Answer<f64>;
}

/// Builds the sweep that `spec` names: one instance per combination of the menu that fits.
///
/// # Errors
/// Laws that do not fit each other, or a number that one of them needs and the pair lacks.
pub fn build(spec: &DemSpec) -> Result<Box<dyn ContactSweep>, SpecError> {
    let contact = &spec.contact;
    laws::fits(contact.normal, contact.tangential).map_err(|why| SpecError::new("tangential", why))?;
    match contact.normal {
        NormalLaw::Linear => on_linear::<laws::Linear>(spec),
        NormalLaw::WaltonBraun => on_linear::<laws::WaltonBraun>(spec),
        NormalLaw::Hertz => on_hertz::<laws::Hertz>(spec),
        NormalLaw::DampedHertz => on_hertz::<laws::DampedHertz>(spec),
    }
}

/// Tangential laws that take their stiffness from a linear normal law, or none.
fn on_linear<N: Normal>(spec: &DemSpec) -> Result<Box<dyn ContactSweep>, SpecError> {
    match spec.contact.tangential {
        TangentialLaw::LinearSpring => with_rolling::<N, laws::LinearSpring>(spec),
        TangentialLaw::WaltonBraun => with_rolling::<N, laws::WaltonBraunFriction>(spec),
        _ => on_any::<N>(spec),
    }
}

/// Those that take it from a Hertzian one, or none.
fn on_hertz<N: Normal>(spec: &DemSpec) -> Result<Box<dyn ContactSweep>, SpecError> {
    match spec.contact.tangential {
        TangentialLaw::Mindlin => with_rolling::<N, laws::Mindlin>(spec),
        _ => on_any::<N>(spec),
    }
}

/// Those without a spring. [`laws::fits`] keeps all others from coming here.
fn on_any<N: Normal>(spec: &DemSpec) -> Result<Box<dyn ContactSweep>, SpecError> {
    match spec.contact.tangential {
        TangentialLaw::None => with_rolling::<N, laws::Frictionless>(spec),
        TangentialLaw::Coulomb => with_rolling::<N, laws::Coulomb>(spec),
        other => Err(SpecError::new("tangential", format!("`{}` does not fit the normal law", other.name()))),
    }
}

/// Rolling laws are swept one contact at a time: compiling the wide sweep for
/// each product of three laws would take longer than it ever saves.
fn with_rolling<N: Normal, T: Tangential>(spec: &DemSpec) -> Result<Box<dyn ContactSweep>, SpecError> {
    match spec.contact.rolling {
        RollingLaw::None => boxed::<Pair<N, T, laws::NoRolling>, Eight>(spec),
        RollingLaw::ConstantTorque => boxed::<Pair<N, T, laws::ConstantTorque>, One>(spec),
        RollingLaw::Spring => boxed::<Pair<N, T, laws::RollingSpring>, One>(spec),
    }
}

fn boxed<L: Law, W: Width>(spec: &DemSpec) -> Result<Box<dyn ContactSweep>, SpecError> {
    Ok(Box::new(Active::<L, W>::new(spec)?))
}

/// How many contacts of a list are evaluated at a time.
trait Width: Send + Sync + 'static {
    /// Sweeps a list of pairs.
    fn pairs<L: Law>(active: &Active<L, Self>, job: PairJob<'_>, counted: &mut Tally)
    where
        Self: Sized;
}

/// One, whatever the case asks for.
struct One;

/// Eight, unless the case asks for the plain sweep.
struct Eight;

impl Width for One {
    fn pairs<L: Law>(active: &Active<L, Self>, job: PairJob<'_>, counted: &mut Tally) {
        active.pairs_by::<f64>(job, counted);
    }
}

impl Width for Eight {
    fn pairs<L: Law>(active: &Active<L, Self>, job: PairJob<'_>, counted: &mut Tally) {
        active.level.run(Wider { active, job, counted });
    }
}

/// A list of pairs for whatever lanes the machine has.
struct Wider<'a, L, W> {
    active: &'a Active<L, W>,
    job: PairJob<'a>,
    counted: &'a mut Tally,
}

impl<L: Law, W: Width> Job for Wider<'_, L, W> {
    type Output = ();

    #[inline(always)]
    fn run<R: Wide>(self) {
        self.active.pairs_by::<R>(self.job, self.counted);
    }
}

/// A law, its constants for every pair of materials, and how to sweep.
struct Active<L, W> {
    table: Vec<L>,
    spins: bool,
    level: Level,
    width: PhantomData<W>,
}

impl<L: Law, W: Width> Active<L, W> {
    fn new(spec: &DemSpec) -> Result<Self, SpecError> {
        let n = spec.materials.len();
        let mut table = Vec::with_capacity(n * n);
        for a in 0..n {
            for b in 0..n {
                table.push(L::build(&PairContext {
                    pair: spec.contact.pairs.get(a, b),
                    first: &spec.materials[a],
                    second: &spec.materials[b],
                    dt: spec.dt,
                    rotation: spec.rotation,
                })?);
            }
        }
        Ok(Self {
            table,
            spins: spec.rotation && (L::TANGENTIAL || L::ROLLS),
            level: spec.search.sweep.level(),
            width: PhantomData,
        })
    }

    #[inline(always)]
    fn pairs_by<R: Wide>(&self, mut job: PairJob<'_>, counted: &mut Tally) {
        if (L::TANGENTIAL || L::ROLLS) && self.spins {
            sweep::<L, R, true>(&self.table, &mut job, counted);
        } else {
            sweep::<L, R, false>(&self.table, &mut job, counted);
        }
    }

    #[inline(always)]
    fn walls_by<R: Wide>(&self, mut job: WallJob<'_>, counted: &mut Tally) {
        if (L::TANGENTIAL || L::ROLLS) && self.spins {
            sweep_walls::<L, R, true>(&self.table, &mut job, counted);
        } else {
            sweep_walls::<L, R, false>(&self.table, &mut job, counted);
        }
    }
}

impl<L: Law, W: Width> ContactSweep for Active<L, W> {
    fn slots(&self) -> usize {
        L::SLOTS
    }

    fn odd(&self) -> u32 {
        L::ODD
    }

    fn rolls(&self) -> bool {
        L::ROLLS && self.spins
    }

    fn pairs(&self, job: PairJob<'_>, counted: &mut Tally) {
        W::pairs(self, job, counted);
    }

    fn walls(&self, job: WallJob<'_>, counted: &mut Tally) {
        // Wall contacts are few: one at a time.
        self.walls_by::<f64>(job, counted);
    }

    fn single(&self, class: usize, touch: &Touch<f64>, memory: &mut [f64; MAX_SLOTS]) -> Answer<f64> {
        let law = L::lanes::<f64>(&self.table, |_| class);
        L::act(&law, touch, memory)
    }
}
