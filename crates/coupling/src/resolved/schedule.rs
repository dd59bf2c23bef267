//! Who spreads when: parts of templates in slabs of planes, of which every
//! other one may be worked on at once; within a slab in columns of the grid,
//! so that neighbours find their faces in the cache.
//!
//! The order of additions to a face depends on the grains and the grid alone,
//! never on the number of threads.

use super::tracers::{PART_SPAN, Templates};
use brazilnut_base::{Side, Vec3};
use brazilnut_fluid::grid::GHOSTS;
use brazilnut_fluid::{Faces, Grid};

/// One part of the template of one grain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Item {
    /// Identity of the grain.
    pub grain: u32,
    /// Part of its template.
    pub part: u32,
}

/// Planes below and above the base plane of a part on which a kernel may put weight.
const BELOW: isize = 1;
const ABOVE: isize = PART_SPAN as isize + 2;

/// Planes in a slab: two slabs of one colour may not touch the same plane.
const THICKNESS: usize = 8;

/// Edge, in cells, of the columns in which grains are taken.
const COLUMN: f64 = 8.0;

/// Fewer tracers than this are swept by one thread: the pool would cost more than it saves.
pub const WORTH_THREADS: usize = 20_000;

/// Planes of the three components that a task may change.
#[derive(Debug)]
pub struct Window<'a> {
    /// Place, in the whole field, where the slices begin.
    pub start: usize,
    /// Components.
    pub components: [&'a mut [f64]; 3],
}

/// Grains by the column of the grid that their centre lies in.
#[derive(Clone, Debug)]
struct Columns {
    axes: [usize; 2],
    per_column: [f64; 2],
    number: [usize; 2],
    starts: Vec<u32>,
    /// Identities, column by column.
    order: Vec<u32>,
}

impl Columns {
    fn new(grid: &Grid, grains: usize) -> Self {
        let [line, middle, _] = grid.memory_order();
        let axes = [middle, line];
        let number = axes.map(|a| (grid.cells[a] as f64 / COLUMN).ceil() as usize);
        let per_column = axes.map(|a| 1.0 / (COLUMN * grid.spacing[a]));
        Self { axes, per_column, number, starts: vec![0; number[0] * number[1] + 1], order: vec![0; grains] }
    }

    fn of(&self, x: Vec3) -> usize {
        let place = |k: usize| {
            let at = (x[self.axes[k]] * self.per_column[k]).max(0.0) as usize;
            at.min(self.number[k] - 1)
        };
        place(0) * self.number[1] + place(1)
    }

    fn sort(&mut self, positions: &[Vec3]) {
        self.starts.fill(0);
        for x in positions {
            let column = self.of(*x);
            self.starts[column + 1] += 1;
        }
        for c in 1..self.starts.len() {
            self.starts[c] += self.starts[c - 1];
        }
        for (k, x) in positions.iter().enumerate() {
            let column = self.of(*x);
            let place = &mut self.starts[column];
            self.order[*place as usize] = k as u32;
            *place += 1;
        }
    }
}

/// Parts in slabs.
#[derive(Clone, Debug)]
pub struct Schedule {
    slow: usize,
    planes: usize,
    periodic: bool,
    stride: usize,
    spacing: f64,
    slabs: usize,
    /// Slab of each plane.
    slab_of: Vec<u32>,
    columns: Columns,
    /// First place of each grain in `rank`.
    first: Vec<usize>,
    /// Slab of each part, grain by grain; then its place in `items`.
    rank: Vec<u32>,
    counts: Vec<u32>,
    /// The parts, slab by slab, those across the periodic side last.
    pub items: Vec<Item>,
    /// First item of each slab; then that of the seam, then the end.
    starts: Vec<usize>,
    /// First batch of each item; then the end.
    batches: Vec<usize>,
    parallel: bool,
}

impl Schedule {
    /// Room for `templates` on `grid`.
    #[must_use]
    pub fn new(grid: &Grid, templates: &Templates) -> Self {
        let slow = grid.memory_order()[2];
        let mut first = vec![0];
        for k in 0..templates.of.len() {
            first.push(first[k] + templates.fit(k).0.parts.len());
        }
        let parts = first[templates.of.len()];
        let planes = grid.cells[slow];
        let slabs = (planes / THICKNESS).max(1);
        let slab_of = |plane| (0..slabs).rfind(|s| planes * s / slabs <= plane).unwrap_or(0) as u32;
        Self {
            slow,
            slab_of: (0..planes).map(slab_of).collect(),
            columns: Columns::new(grid, templates.of.len()),
            planes,
            periodic: grid.sides[slow] == Side::Periodic,
            stride: grid.layout().stride[slow],
            spacing: grid.spacing[slow],
            slabs,
            first,
            rank: vec![0; parts],
            counts: vec![0; slabs + 2],
            items: vec![Item::default(); parts],
            starts: vec![0; slabs + 2],
            batches: vec![0; parts + 1],
            parallel: slabs >= 4 && templates.count() >= WORTH_THREADS,
        }
    }

    /// Sorts the parts of grains at `positions` (m) by slab, in it by column, in it by identity.
    pub fn sort(&mut self, templates: &Templates, positions: &[Vec3]) {
        let n = self.planes as isize;
        self.counts.fill(0);
        for (k, x) in positions.iter().enumerate() {
            let (template, scale) = templates.fit(k);
            for (p, part) in template.parts.iter().enumerate() {
                let low = x[self.slow] + scale * part.low[self.slow];
                let base = (low / self.spacing).floor() as isize;
                let across = base < BELOW || base + ABOVE >= n;
                let slab = match self.periodic && across {
                    true => self.slabs as u32,
                    false => self.slab_of[base.clamp(0, n - 1) as usize],
                };
                self.rank[self.first[k] + p] = slab;
                self.counts[slab as usize + 1] += 1;
            }
        }
        for s in 0..=self.slabs {
            self.counts[s + 1] += self.counts[s];
            self.starts[s] = self.counts[s] as usize;
        }
        self.starts[self.slabs + 1] = self.items.len();
        self.columns.sort(positions);
        for k in &self.columns.order {
            let grain = *k as usize;
            for p in self.first[grain]..self.first[grain + 1] {
                let place = &mut self.counts[self.rank[p] as usize];
                self.rank[p] = *place;
                self.items[*place as usize] = Item { grain: *k, part: (p - self.first[grain]) as u32 };
                *place += 1;
            }
        }
        for (i, item) in self.items.iter().enumerate() {
            let part = templates.fit(item.grain as usize).0.parts[item.part as usize];
            self.batches[i + 1] = self.batches[i] + part.batches[1] - part.batches[0];
        }
    }

    /// First plane of slab `s`.
    fn slab_planes(&self, s: usize) -> usize {
        self.planes * s / self.slabs
    }

    /// Places in `items` of the parts of grain `k`, in the order of parts.
    pub fn of_grain(&self, k: usize) -> impl Iterator<Item = usize> {
        self.rank[self.first[k]..self.first[k + 1]].iter().map(|r| *r as usize)
    }

    /// Number of batches of tracers.
    #[must_use]
    pub fn batch_count(&self) -> usize {
        self.batches[self.items.len()]
    }

    /// Calls `work(item, its batches' slots, its result slot)` for all items; nothing else is shared.
    pub fn gather<T: Send, R: Send>(
        &self,
        slots: &mut [T],
        results: &mut [R],
        work: impl Fn(Item, &mut [T], &mut R) + Sync,
    ) {
        self.halve(0, self.items.len(), slots, results, &work);
    }

    fn halve<T: Send, R: Send>(
        &self,
        low: usize,
        high: usize,
        slots: &mut [T],
        results: &mut [R],
        work: &(impl Fn(Item, &mut [T], &mut R) + Sync),
    ) {
        // Parts of about a thousand tracers keep the pool busy without being lost in it.
        const BLOCK: usize = 64;
        if !self.parallel || high - low <= BLOCK {
            let mut rest = slots;
            for i in low..high {
                let (own, after) = rest.split_at_mut(self.batches[i + 1] - self.batches[i]);
                work(self.items[i], own, &mut results[i - low]);
                rest = after;
            }
            return;
        }
        let middle = low + (high - low) / 2;
        let (a, b) = slots.split_at_mut(self.batches[middle] - self.batches[low]);
        let (q, r) = results.split_at_mut(middle - low);
        rayon::join(|| self.halve(low, middle, a, q, work), || self.halve(middle, high, b, r, work));
    }

    /// Calls `work(item, window, its first batch, its result slot)` for all items,
    /// such that no two tasks at once share a plane.
    pub fn spread<R: Send>(
        &self,
        field: &mut Faces,
        results: &mut [R],
        work: impl Fn(Item, &mut Window<'_>, usize, &mut R) + Sync,
    ) {
        let Faces { x, y, z } = field;
        let components = [&mut x.values[..], &mut y.values[..], &mut z.values[..]];
        let mut all = Window { start: 0, components };
        for colour in 0..2 {
            let slabs = (self.slabs + 1 - colour) / 2;
            let first = if slabs > 0 { self.starts[colour] } else { 0 };
            if slabs > 0 {
                self.colour(colour, 0, slabs, all.reborrow(), &mut results[first..], &work);
            }
        }
        for i in self.starts[self.slabs]..self.items.len() {
            work(self.items[i], &mut all, self.batches[i], &mut results[i]);
        }
    }

    /// Slabs `low..high` of one colour; `results` begins with the first item of the first.
    fn colour<R: Send>(
        &self,
        colour: usize,
        low: usize,
        high: usize,
        mut window: Window<'_>,
        results: &mut [R],
        work: &(impl Fn(Item, &mut Window<'_>, usize, &mut R) + Sync),
    ) {
        let slab = |k: usize| 2 * k + colour;
        let first = self.starts[slab(low)];
        if !self.parallel || high - low == 1 {
            for k in low..high {
                for i in self.starts[slab(k)]..self.starts[slab(k) + 1] {
                    work(self.items[i], &mut window, self.batches[i], &mut results[i - first]);
                }
            }
            return;
        }
        let middle = low + (high - low) / 2;
        // Cut below what the upper half's lowest slab touches; the lower half ends far below.
        let plane = self.slab_planes(slab(middle)) as isize - BELOW;
        let cut = (plane + GHOSTS as isize) as usize * self.stride;
        let (a, b) = window.split(cut);
        let (q, r) = results.split_at_mut(self.starts[slab(middle)] - first);
        rayon::join(
            || self.colour(colour, low, middle, a, q, work),
            || self.colour(colour, middle, high, b, r, work),
        );
    }
}

impl Window<'_> {
    fn reborrow(&mut self) -> Window<'_> {
        let [x, y, z] = &mut self.components;
        Window { start: self.start, components: [x, y, z] }
    }

    /// The parts below and from place `cut` of the whole field on.
    fn split(&mut self, cut: usize) -> (Window<'_>, Window<'_>) {
        let start = self.start;
        let [x, y, z] = &mut self.components;
        let [(xa, xb), (ya, yb), (za, zb)] = [x, y, z].map(|c| c.split_at_mut(cut - start));
        (Window { start, components: [xa, ya, za] }, Window { start: cut, components: [xb, yb, zb] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::resolved::tracers::Layout;
    use brazilnut_base::vec3;

    /// Colours may run at once only if the planes they touch are disjoint.
    #[test]
    fn slabs_of_one_colour_share_no_plane() {
        for n in 16..400 {
            let slabs = n / THICKNESS;
            for s in 0..slabs.saturating_sub(2) {
                let last_touched = (n * (s + 1) / slabs) as isize - 1 + ABOVE;
                let next_touched = (n * (s + 2) / slabs) as isize - BELOW;
                assert!(last_touched < next_touched, "{n} planes, slab {s}");
            }
        }
    }

    #[test]
    fn every_part_stands_once_where_its_grain_looks_for_it() {
        let grid = Grid::new([12, 12, 64], [1.0; 3], [Side::Walls, Side::Walls, Side::Periodic]);
        let radii = vec![3.0; 40];
        let templates = Templates::new(&grid, Body::Sphere, &radii, Layout::Shells, 0.4);
        let mut s = Schedule::new(&grid, &templates);
        let x: Vec<Vec3> = (0..40).map(|k| vec3(6.0, 6.0, (f64::from(k) * 37.77) % 64.0)).collect();
        s.sort(&templates, &x);
        let mut seen: Vec<Item> = s.items.clone();
        seen.sort_by_key(|i| (i.grain, i.part));
        seen.dedup();
        assert_eq!(seen.len(), s.items.len());
        for k in 0..40 {
            for (p, place) in s.of_grain(k).enumerate() {
                assert_eq!(s.items[place], Item { grain: k as u32, part: p as u32 });
            }
        }
        let seam = s.starts[s.slabs];
        assert!(seam < s.items.len(), "some parts lie across the periodic side");
        let batches: usize = (0..40).map(|k| templates.fit(k).0.batches.len()).sum();
        assert_eq!(s.batch_count(), batches);
    }
}
