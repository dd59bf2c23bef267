//! The loops over tracers.

use super::reach::Reach;
use super::schedule::{Item, Schedule, Window};
use super::tracers::{Batch, LANES, Template, Templates, Wide};
use crate::transfer::{Kernel, Stagger};
use crate::wide::{self, Task};
use brazilnut_base::Vec3;
use brazilnut_fluid::Faces;
use brazilnut_grains::Grains;

/// What the tracers of one part, or of one grain, did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Momentum given to the fluid, kg m/s.
    pub impulse: Vec3,
    /// Angular momentum about the grain's centre given to the fluid, kg m²/s.
    pub twist: Vec3,
    /// Sum of |v_f − v_t|, m/s.
    pub slip: f64,
    /// Sum of |v_t|, m/s.
    pub speed: f64,
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, t: Self) {
        self.impulse += t.impulse;
        self.twist += t.twist;
        self.slip += t.slip;
        self.speed += t.speed;
    }
}

/// A [`Tally`] lane by lane.
#[derive(Clone, Copy, Default)]
struct WideTally {
    impulse: Wide,
    twist: Wide,
    slip: [f64; LANES],
    speed: [f64; LANES],
}

impl WideTally {
    /// Adds momenta `p` of a batch with arms `r`.
    #[inline(always)]
    fn give(&mut self, r: &Wide, p: &Wide) {
        for l in 0..LANES {
            for c in 0..3 {
                let (a, b) = ((c + 1) % 3, (c + 2) % 3);
                self.impulse[c][l] += p[c][l];
                self.twist[c][l] += r[a][l] * p[b][l] - r[b][l] * p[a][l];
            }
        }
    }

    /// Adds the slip of a batch of velocities `v`.
    #[inline(always)]
    fn leak(&mut self, slip: &Wide, v: &Wide, mask: &[f64; LANES]) {
        let length = |v: &Wide, l: usize| (v[0][l] * v[0][l] + v[1][l] * v[1][l] + v[2][l] * v[2][l]).sqrt();
        for l in 0..LANES {
            self.slip[l] += length(slip, l);
            self.speed[l] += mask[l] * length(v, l);
        }
    }

    #[inline(always)]
    fn sum(&self) -> Tally {
        let add = |x: &[f64; LANES]| x.iter().sum::<f64>();
        let vector = |x: &Wide| Vec3::from_array([add(&x[0]), add(&x[1]), add(&x[2])]);
        Tally {
            impulse: vector(&self.impulse),
            twist: vector(&self.twist),
            slip: add(&self.slip),
            speed: add(&self.speed),
        }
    }
}

/// Everything that a sweep reads.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// Tables of the grid.
    pub stagger: &'a Stagger,
    /// Tracers.
    pub templates: &'a Templates,
    /// Who works when.
    pub schedule: &'a Schedule,
    /// The grains.
    pub grains: &'a Grains,
}

/// A part of a template where its grain is.
struct Placed<'a, K, const W: usize> {
    reach: Reach<'a, K, W>,
    template: &'a Template,
    batches: [usize; 2],
    scale: f64,
    velocity: Vec3,
    spin: Vec3,
}

impl<K: Kernel<W>, const W: usize> Placed<'_, K, W> {
    #[inline(always)]
    fn batches(&self) -> &[Batch] {
        &self.template.batches[self.batches[0]..self.batches[1]]
    }

    /// Arms of a batch, m.
    #[inline(always)]
    fn arms(&self, batch: &Batch) -> Wide {
        times(self.scale, &batch.arm)
    }

    /// u + w x r in every lane.
    #[inline(always)]
    fn velocities(&self, r: &Wide) -> Wide {
        let (u, w) = (self.velocity, self.spin);
        let mut v = ZERO;
        for c in 0..3 {
            let (a, b) = ((c + 1) % 3, (c + 2) % 3);
            for l in 0..LANES {
                v[c][l] = u[c] + w[a] * r[b][l] - w[b] * r[a][l];
            }
        }
        v
    }
}

const ZERO: Wide = [[0.0; LANES]; 3];

/// (a − b) where there are tracers.
#[inline(always)]
fn difference(a: &Wide, b: &Wide, mask: &[f64; LANES]) -> Wide {
    let mut out = ZERO;
    for c in 0..3 {
        for l in 0..LANES {
            out[c][l] = mask[l] * (a[c][l] - b[c][l]);
        }
    }
    out
}

/// The impulse against the slip, for tracers that control `own` cells each.
#[inline(always)]
fn pull(grip: f64, own: &[f64; LANES], slip: &Wide) -> Wide {
    let mut out = ZERO;
    for c in 0..3 {
        for l in 0..LANES {
            out[c][l] = -grip * own[l] * slip[c][l];
        }
    }
    out
}

/// s v in every lane.
#[inline(always)]
fn times(s: f64, v: &Wide) -> Wide {
    let mut out = ZERO;
    for c in 0..3 {
        for l in 0..LANES {
            out[c][l] = s * v[c][l];
        }
    }
    out
}

impl<'a> Scene<'a> {
    #[inline(always)]
    fn placed<K: Kernel<W>, const W: usize>(&self, kernel: K, item: Item) -> Placed<'a, K, W> {
        let k = item.grain as usize;
        let (template, scale) = self.templates.fit(k);
        let part = &template.parts[item.part as usize];
        let x = self.grains.position[k];
        Placed {
            reach: Reach::new(self.stagger, kernel, x, scale, template.lattice, part),
            template,
            batches: part.batches,
            scale,
            velocity: self.grains.velocity[k],
            spin: self.grains.angular_velocity[k],
        }
    }

    /// v_f − v_t at every tracer; `tallies` gets the leak.
    pub fn slip<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        field: &Faces,
        slips: &mut [Wide],
        tallies: &mut [Tally],
    ) {
        self.schedule.gather(slips, tallies, |item, slips, tally| {
            wide::run(Slip { placed: self.placed(kernel, item), field, slips, tally });
        });
    }

    /// Gives the fluid the impulse −`grip(grain)` slip, times the cells that a tracer controls, and adds it to `tallies`.
    ///
    /// `per_mass` is 1/(rho cell volume): what an impulse does to the velocity of a face.
    pub fn push<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        slips: &[Wide],
        grip: impl Fn(usize) -> f64 + Sync,
        per_mass: f64,
        field: &mut Faces,
        tallies: &mut [Tally],
    ) {
        self.schedule.spread(field, tallies, |item, window, first, tally| {
            let (placed, grip) = (self.placed(kernel, item), grip(item.grain as usize));
            wide::run(Push { placed, slips: &slips[first..], grip, per_mass, window, tally });
        });
    }

    /// Both at once where the slip is read from another field than the one pushed.
    pub fn slip_and_push<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        before: &Faces,
        grip: impl Fn(usize) -> f64 + Sync,
        per_mass: f64,
        field: &mut Faces,
        tallies: &mut [Tally],
    ) {
        self.schedule.spread(field, tallies, |item, window, _, tally| {
            let (placed, grip) = (self.placed(kernel, item), grip(item.grain as usize));
            wide::run(SlipAndPush { placed, before, grip, per_mass, window, tally });
        });
    }

    /// Sums of share × velocity and share × arm × velocity, as impulse and twist, and the leak.
    pub fn enclosed<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        field: &Faces,
        slots: &mut [Wide],
        tallies: &mut [Tally],
    ) {
        self.schedule.gather(slots, tallies, |item, _, tally| {
            wide::run(Look { placed: self.placed(kernel, item), field, tally });
        });
    }

    /// Sums over the parts of grain `k`, in the order of parts.
    #[must_use]
    pub fn of_grain(&self, k: usize, tallies: &[Tally]) -> Tally {
        let mut sum = Tally::default();
        for place in self.schedule.of_grain(k) {
            sum += tallies[place];
        }
        sum
    }
}

struct Slip<'a, K, const W: usize> {
    placed: Placed<'a, K, W>,
    field: &'a Faces,
    slips: &'a mut [Wide],
    tally: &'a mut Tally,
}

impl<K: Kernel<W>, const W: usize> Task for Slip<'_, K, W> {
    #[inline(always)]
    fn run(self) {
        let placed = self.placed;
        placed.reach.fetch(self.field);
        let mut sum = WideTally::default();
        for (batch, slip) in placed.batches().iter().zip(self.slips) {
            let arms = placed.arms(batch);
            let wanted = placed.velocities(&arms);
            *slip = difference(&placed.reach.read(batch, &arms, self.field), &wanted, &batch.mask);
            sum.leak(slip, &wanted, &batch.mask);
        }
        *self.tally = sum.sum();
    }
}

struct Push<'a, 'b, K, const W: usize> {
    placed: Placed<'a, K, W>,
    slips: &'a [Wide],
    grip: f64,
    per_mass: f64,
    window: &'a mut Window<'b>,
    tally: &'a mut Tally,
}

impl<K: Kernel<W>, const W: usize> Task for Push<'_, '_, K, W> {
    #[inline(always)]
    fn run(self) {
        let placed = self.placed;
        placed.reach.fetch_window(self.window);
        let mut sum = WideTally::default();
        for (batch, slip) in placed.batches().iter().zip(self.slips) {
            let arms = placed.arms(batch);
            let impulse = pull(self.grip, &batch.grip, slip);
            sum.give(&arms, &impulse);
            placed.reach.write(batch, &arms, &times(self.per_mass, &impulse), self.window);
        }
        *self.tally += sum.sum();
    }
}

struct SlipAndPush<'a, 'b, K, const W: usize> {
    placed: Placed<'a, K, W>,
    before: &'a Faces,
    grip: f64,
    per_mass: f64,
    window: &'a mut Window<'b>,
    tally: &'a mut Tally,
}

impl<K: Kernel<W>, const W: usize> Task for SlipAndPush<'_, '_, K, W> {
    #[inline(always)]
    fn run(self) {
        let placed = self.placed;
        placed.reach.fetch(self.before);
        placed.reach.fetch_window(self.window);
        let mut sum = WideTally::default();
        for batch in placed.batches() {
            let arms = placed.arms(batch);
            let wanted = placed.velocities(&arms);
            let slip = difference(&placed.reach.read(batch, &arms, self.before), &wanted, &batch.mask);
            let impulse = pull(self.grip, &batch.grip, &slip);
            sum.give(&arms, &impulse);
            sum.leak(&slip, &wanted, &batch.mask);
            placed.reach.write(batch, &arms, &times(self.per_mass, &impulse), self.window);
        }
        *self.tally = sum.sum();
    }
}

struct Look<'a, K, const W: usize> {
    placed: Placed<'a, K, W>,
    field: &'a Faces,
    tally: &'a mut Tally,
}

impl<K: Kernel<W>, const W: usize> Task for Look<'_, K, W> {
    #[inline(always)]
    fn run(self) {
        let placed = self.placed;
        placed.reach.fetch(self.field);
        let mut sum = WideTally::default();
        for batch in placed.batches() {
            let arms = placed.arms(batch);
            let wanted = placed.velocities(&arms);
            let v = placed.reach.read(batch, &arms, self.field);
            let mut part = ZERO;
            for c in 0..3 {
                for l in 0..LANES {
                    part[c][l] = batch.share[l] * v[c][l];
                }
            }
            sum.give(&arms, &part);
            sum.leak(&difference(&v, &wanted, &batch.mask), &wanted, &batch.mask);
        }
        *self.tally = sum.sum();
    }
}
