//! Grains on faces: volume, flux and diameter by a partition of unity (Clément 2.4.3).

use super::{Averaged, AveragedReport};
use crate::transfer::{Kernel, KernelName, Seat, Stagger};
use crate::with_kernel;
use brazilnut_base::{Side, Vec3};
use brazilnut_fluid::{Faces, Grid, Layout, Mixture, Solid};
use brazilnut_grains::Grains;

/// Tables of the mapping; rebuilt from the case.
#[derive(Clone, Debug)]
pub struct Mapping {
    kernel: KernelName,
    stagger: Stagger,
    cells: [isize; 3],
    sides: [Side; 3],
    layout: Layout,
    spacing: [f64; 3],
    /// Volume of a cell, m³.
    pub cell_volume: f64,
    /// Faces of each component on which the flow is free: place and index.
    free: [Vec<(usize, [isize; 3])>; 3],
    /// 1 on free faces, 0 elsewhere; only where there are inner solids.
    mask: Option<Faces>,
    /// Volume of the cell's space whose grains a face receives, m³.
    capacity: Faces,
}

/// What the grains put on each face.
#[derive(Clone, Debug)]
pub struct Mapped {
    /// Volume of grains, m³.
    pub solids: Faces,
    /// Volume times velocity component, m⁴/s.
    pub flux: Faces,
    /// Volume over the mean diameter of the species, m².
    pub surface: Faces,
}

impl Mapped {
    /// Room on `grid`.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        Self { solids: Faces::new(grid), flux: Faces::new(grid), surface: Faces::new(grid) }
    }

    /// Mean diameter by volume over surface (Sauter), m.
    #[inline]
    #[must_use]
    pub fn diameter(&self, component: usize, place: usize) -> f64 {
        self.solids.component(component)[place] / self.surface.component(component)[place]
    }
}

impl Mapping {
    /// Tables for `grid` with inner `solids`.
    #[must_use]
    pub fn new(kernel: KernelName, grid: &Grid, solids: &[Solid]) -> Self {
        let mut m = Self {
            kernel,
            stagger: Stagger::new(grid, 4),
            cells: grid.cells.map(|n| n as isize),
            sides: grid.sides,
            layout: grid.layout(),
            spacing: grid.spacing,
            cell_volume: grid.cell_volume(),
            free: [0, 1, 2].map(|c| free_faces(grid, solids, c)),
            mask: None,
            capacity: Faces::new(grid),
        };
        if !solids.is_empty() {
            let mut mask = Faces::new(grid);
            for c in 0..3 {
                for (place, _) in &m.free[c] {
                    mask.component_mut(c)[*place] = 1.0;
                }
            }
            m.mask = Some(mask);
        }
        with_kernel!(kernel, kernel => m.measure(kernel, grid, solids));
        m
    }

    /// Spreads the space of every cell as if it were full of grains.
    fn measure<const W: usize>(&mut self, kernel: impl Kernel<W>, grid: &Grid, solids: &[Solid]) {
        // Midpoints of quarters: exact for a kernel that is linear between grid points.
        const PER_CELL: isize = 4;
        let counts = [0, 1, 2].map(|a| if self.sides[a] == Side::Flat { 1 } else { PER_CELL });
        let [a, b, c] = [0, 1, 2].map(|a| self.cells[a] * counts[a]);
        let share = self.cell_volume / counts.iter().product::<isize>() as f64;
        let mut capacity = std::mem::replace(&mut self.capacity, Faces::new(grid));
        for k in 0..c {
            for j in 0..b {
                for i in 0..a {
                    let at = [i, j, k];
                    let cell = [0, 1, 2].map(|a| (at[a] / counts[a]) as usize);
                    if solids.iter().any(|s| (0..3).all(|a| s.low[a] <= cell[a] && cell[a] < s.high[a])) {
                        continue;
                    }
                    let x: [f64; 3] =
                        std::array::from_fn(|a| (at[a] as f64 + 0.5) / counts[a] as f64 * self.spacing[a]);
                    let seat = self.stagger.seat(kernel, Vec3::from_array(x));
                    for c in 0..3 {
                        let whole = self.whole(&seat, c);
                        self.stagger.scatter(&seat, c, share * whole, capacity.component_mut(c), 0);
                    }
                }
            }
        }
        self.capacity = capacity;
    }

    /// One over the weight that falls on free faces: 1 away from inner solids, 0 if none does.
    #[inline]
    fn whole<const W: usize>(&self, seat: &Seat<W>, component: usize) -> f64 {
        let Some(mask) = &self.mask else { return 1.0 };
        let free = self.stagger.gather(seat, component, mask.component(component));
        if free > 0.0 { 1.0 / free } else { 0.0 }
    }

    /// Maps the grains onto the faces.
    pub fn map(&self, spec: &Averaged, grains: &Grains, mapped: &mut Mapped) {
        with_kernel!(self.kernel, kernel => self.map_with(kernel, spec, grains, mapped));
    }

    fn map_with<const W: usize>(
        &self,
        kernel: impl Kernel<W>,
        spec: &Averaged,
        grains: &Grains,
        mapped: &mut Mapped,
    ) {
        let Mapped { solids, flux, surface } = mapped;
        for field in [&mut *solids, flux, surface] {
            field.set_all(0.0);
        }
        for k in 0..grains.len() {
            let seat = self.stagger.seat(kernel, grains.position[k]);
            let volume = spec.body.volume(grains.radius[k]);
            let per_diameter = 1.0 / spec.diameter[grains.species[k] as usize];
            for c in 0..3 {
                if self.stagger.is_flat(c) {
                    continue;
                }
                let volume = volume * self.whole(&seat, c);
                let u = grains.velocity[k][c];
                let (s, f, a) = (solids.component_mut(c), flux.component_mut(c), surface.component_mut(c));
                self.stagger.each(&seat, c, |place, w| {
                    let v = w * volume;
                    s[place] += v;
                    f[place] += v * u;
                    a[place] += v * per_diameter;
                });
            }
        }
    }

    /// Porosity, flux and mean velocity of the grains on every free face.
    pub fn mixture(
        &self,
        floor: f64,
        mapped: &Mapped,
        mixture: &mut Mixture,
        velocity: &mut Faces,
        report: &mut AveragedReport,
    ) {
        (report.least_porosity, report.floored) = (1.0, 0);
        for c in 0..3 {
            let (solids, flux) = (mapped.solids.component(c), mapped.flux.component(c));
            let capacity = self.capacity.component(c);
            let porosity = mixture.porosity.component_mut(c);
            let solids_flux = mixture.solids_flux.component_mut(c);
            let velocity = velocity.component_mut(c);
            for &(place, _) in &self.free[c] {
                let phi = 1.0 - solids[place] / capacity[place];
                report.least_porosity = report.least_porosity.min(phi);
                report.floored += u64::from(phi < floor);
                porosity[place] = phi.max(floor);
                velocity[place] = if solids[place] > 0.0 { flux[place] / solids[place] } else { 0.0 };
                solids_flux[place] = (1.0 - porosity[place]) * velocity[place];
            }
        }
    }

    /// Faces on which component `c` is free: place and index.
    pub fn free(&self, c: usize) -> &[(usize, [isize; 3])] {
        &self.free[c]
    }

    /// dP/dx_c at a face, Pa/m.
    #[inline]
    #[must_use]
    pub fn slope(&self, c: usize, at: [isize; 3], pressure: &[f64]) -> f64 {
        let mut behind = at;
        behind[c] -= 1;
        (pressure[self.place(at)] - pressure[self.place(behind)]) / self.spacing[c]
    }

    /// Place of a grid index, wrapped across periodic sides.
    #[inline]
    fn place(&self, at: [isize; 3]) -> usize {
        let mut place = self.layout.origin;
        for a in 0..3 {
            let i = if self.sides[a] == Side::Periodic { at[a].rem_euclid(self.cells[a]) } else { at[a] };
            place += i as usize * self.layout.stride[a];
        }
        place
    }

    /// The whole vector at a face of component `c`: the others as means of the four faces around.
    #[inline]
    #[must_use]
    pub fn vector_at(&self, c: usize, at: [isize; 3], field: &Faces) -> Vec3 {
        let mut v = Vec3::ZERO;
        v[c] = field.component(c)[self.place(at)];
        for d in 0..3 {
            if d == c || self.sides[d] == Side::Flat {
                continue;
            }
            let values = field.component(d);
            let mut sum = 0.0;
            for (back, ahead) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let mut i = at;
                i[c] -= back;
                i[d] += ahead;
                sum += values[self.place(i)];
            }
            v[d] = 0.25 * sum;
        }
        v
    }

    /// Volume-weighted sums for one grain: calls `f(component, value of each field at the grain)`.
    #[inline]
    pub fn gather<const W: usize, const N: usize>(
        &self,
        kernel: impl Kernel<W>,
        x: Vec3,
        fields: [&Faces; N],
        mut f: impl FnMut(usize, [f64; N]),
    ) {
        let seat = self.stagger.seat(kernel, x);
        for c in 0..3 {
            if self.stagger.is_flat(c) {
                continue;
            }
            let whole = self.whole(&seat, c);
            let values = fields.map(|field| field.component(c));
            let mut sums = [0.0; N];
            self.stagger.each(&seat, c, |place, w| {
                for n in 0..N {
                    sums[n] += w * values[n][place];
                }
            });
            f(c, sums.map(|s| whole * s));
        }
    }
}

/// Faces of `component` that lie neither on a wall nor on or in a solid.
fn free_faces(grid: &Grid, solids: &[Solid], component: usize) -> Vec<(usize, [isize; 3])> {
    let mut free = vec![];
    if grid.sides[component] == Side::Flat {
        return free;
    }
    let [a, b, c] = grid.face_range(component);
    for k in c {
        for j in b.clone() {
            for i in a.clone() {
                let at = [i, j, k];
                let n = at[component];
                let walled =
                    grid.sides[component] == Side::Walls && (n == 0 || n == grid.cells[component] as isize);
                let buried = solids.iter().any(|s| {
                    (0..3).all(|a| {
                        let (low, high) = (s.low[a] as isize, s.high[a] as isize);
                        low <= at[a] && if a == component { at[a] <= high } else { at[a] < high }
                    })
                });
                if !walled && !buried {
                    free.push((grid.layout().index(i, j, k), at));
                }
            }
        }
    }
    free
}
