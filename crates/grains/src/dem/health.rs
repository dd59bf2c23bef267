//! Whether the physics still means anything.

use super::Dem;
use super::look::Partner;
use crate::state::DemState;
use brazilnut_base::{Blowup, Side, Tick, Vec3};

impl Dem {
    /// Cheap enough for every step: looks closer only when a bound gives reason to.
    pub fn health(&self, state: &DemState, tick: Tick) -> Result<(), Blowup> {
        let s = &state.sums;
        let finite = s.gravity + s.frame + s.fluid + s.walls + s.lost.iter().sum::<f64>();
        if !finite.is_finite() {
            self.finite(state, tick)?;
        }
        if state.overlap > self.spec.limits.overlap * state.radii[0] {
            self.overlap(state, tick)?;
        }
        self.inside(state, tick)
    }

    fn finite(&self, state: &DemState, tick: Tick) -> Result<(), Blowup> {
        let broken = |k: &usize| {
            !(state.rows[*k].position().is_finite()
                && state.rows[*k].velocity().is_finite()
                && state.spins[*k].0.iter().all(|x| x.is_finite()))
        };
        let first = (0..state.len()).filter(broken).min_by_key(|&k| state.tags[k].id);
        let place = first.map_or_else(|| "energy ledger".into(), |k| grain(state, k));
        Err(Blowup {
            tick,
            quantity: "position or velocity not finite".into(),
            place,
            remedy: "shorten the time step; look for grains that overlap at the start".into(),
        })
    }

    fn overlap(&self, state: &DemState, tick: Tick) -> Result<(), Blowup> {
        let mut worst = None;
        let mut most = self.spec.limits.overlap;
        self.contacts(state, |c| {
            if c.relative_overlap > most {
                most = c.relative_overlap;
                worst = Some(*c);
            }
        });
        let Some(c) = worst else { return Ok(()) };
        let partner = match c.second {
            Partner::Grain(id) => format!("grain {id}"),
            Partner::Wall(k) => format!("wall {}", self.spec.walls[k].name),
        };
        let (p, limit) = (c.point, self.spec.limits.overlap);
        Err(Blowup {
            tick,
            quantity: format!("overlap {most:.3} of the radius (limit {limit})"),
            place: format!("grain {} and {partner} at ({:.6}, {:.6}, {:.6}) m", c.first, p.x, p.y, p.z),
            remedy: "stiffen the contact or shorten the time step".into(),
        })
    }

    fn inside(&self, state: &DemState, tick: Tick) -> Result<(), Blowup> {
        let cell = &self.spec.cell;
        let room =
            self.spec.walls.iter().fold(0.0_f64, |most, w| {
                most.max(w.motion.harmonics.iter().map(|h| h.amplitude.length()).sum())
            });
        let walled = |axis: usize| cell.sides[axis] == Side::Walls;
        let out = |x: Vec3| (0..3).any(|a| walled(a) && (x[a] < -room || x[a] > cell.size[a] + room));
        if !(out(state.extent[0]) || out(state.extent[1])) {
            return Ok(());
        }
        let first =
            (0..state.len()).filter(|&k| out(state.rows[k].position())).min_by_key(|&k| state.tags[k].id);
        match first {
            None => Ok(()),
            Some(k) => Err(Blowup {
                tick,
                quantity: "a grain left the cell".into(),
                place: grain(state, k),
                remedy: "give that side a wall, make the cell higher, or shorten the time step".into(),
            }),
        }
    }
}

fn grain(state: &DemState, k: usize) -> String {
    let r = state.rows[k].position();
    format!("grain {} at ({:.6}, {:.6}, {:.6}) m", state.tags[k].id, r.x, r.y, r.z)
}
