//! The loops over tracers.

use super::schedule::{Item, Schedule, Window};
use super::tracers::Templates;
use crate::transfer::{Kernel, Stagger};
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

/// Everything a sweep reads.
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

/// One tracer: its place from the centre (m), its absolute place (m), the template's velocity there (m/s).
#[derive(Clone, Copy, Debug)]
pub struct Tracer {
    /// From the centre.
    pub arm: Vec3,
    /// In the cell.
    pub at: Vec3,
    /// u + w x arm.
    pub velocity: Vec3,
}

impl Scene<'_> {
    /// The tracers of `item`.
    #[inline(always)]
    pub fn tracers(&self, item: Item) -> impl Iterator<Item = Tracer> {
        let k = item.grain as usize;
        let (template, scale) = self.templates.fit(k);
        let [low, high] = template.parts[item.part as usize].points;
        let (x, u, w) = (self.grains.position[k], self.grains.velocity[k], self.grains.angular_velocity[k]);
        template.points[low..high].iter().map(move |p| {
            let arm = scale * *p;
            Tracer { arm, at: x + arm, velocity: u + w.cross(arm) }
        })
    }

    /// v_f − v_t at every tracer; `tallies` gets the leak.
    pub fn slip<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        field: &Faces,
        slips: &mut [Vec3],
        tallies: &mut [Tally],
    ) {
        self.schedule.gather(slips, tallies, |item, slips, tally| {
            *tally = Tally::default();
            for (t, slip) in self.tracers(item).zip(slips) {
                *slip = self.stagger.interpolate(&self.stagger.seat(kernel, t.at), field) - t.velocity;
                tally.slip += slip.length();
                tally.speed += t.velocity.length();
            }
        });
    }

    /// Gives the fluid the impulse −`grip(grain)` slip at every tracer and adds it to `tallies`.
    ///
    /// `per_mass` is 1/(rho cell volume): what an impulse does to the velocity of a face.
    pub fn push<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        slips: &[Vec3],
        grip: impl Fn(usize) -> f64 + Sync,
        per_mass: f64,
        field: &mut Faces,
        tallies: &mut [Tally],
    ) {
        self.schedule.spread(field, tallies, |item, window, first, tally| {
            let grip = grip(item.grain as usize);
            for (t, slip) in self.tracers(item).zip(&slips[first..]) {
                let impulse = -grip * *slip;
                tally.impulse += impulse;
                tally.twist += t.arm.cross(impulse);
                self.deposit(kernel, t.at, per_mass * impulse, window);
            }
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
            *tally = Tally::default();
            let grip = grip(item.grain as usize);
            for t in self.tracers(item) {
                let seat = self.stagger.seat(kernel, t.at);
                let slip = self.stagger.interpolate(&seat, before) - t.velocity;
                let impulse = -grip * slip;
                tally.impulse += impulse;
                tally.twist += t.arm.cross(impulse);
                tally.slip += slip.length();
                tally.speed += t.velocity.length();
                self.deposit(kernel, t.at, per_mass * impulse, window);
            }
        });
    }

    /// Sums of share × velocity and share × arm × velocity, as impulse and twist, and the leak.
    pub fn enclosed<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        field: &Faces,
        slots: &mut [Vec3],
        tallies: &mut [Tally],
    ) {
        self.schedule.gather(slots, tallies, |item, _, tally| {
            *tally = Tally::default();
            let (template, _) = self.templates.fit(item.grain as usize);
            let [low, high] = template.parts[item.part as usize].points;
            for (t, share) in self.tracers(item).zip(&template.share[low..high]) {
                let v = self.stagger.interpolate(&self.stagger.seat(kernel, t.at), field);
                tally.impulse += *share * v;
                tally.twist += *share * t.arm.cross(v);
                tally.slip += (v - t.velocity).length();
                tally.speed += t.velocity.length();
            }
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

    #[inline(always)]
    fn deposit<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        at: Vec3,
        amount: Vec3,
        window: &mut Window<'_>,
    ) {
        let seat = self.stagger.seat(kernel, at);
        for c in 0..3 {
            if !self.stagger.is_flat(c) {
                self.stagger.scatter(&seat, c, amount[c], window.components[c], window.start);
            }
        }
    }
}
