//! Tracers: the points at which a body holds the fluid.

use crate::body::Body;
use brazilnut_base::menu::Entry;
use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_fluid::Grid;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How tracers fill a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// Points of a lattice with the grid's spacing around the centre (Clément 2.5.2, Fig. 2.17).
    Lattice,
    /// Concentric shells one spacing apart, the outermost drawn in below the surface (Breugem 2012).
    Shells,
}

/// What `layout` may name, in the order of [`Layout::ALL`].
pub const LAYOUTS: &[Entry] = &[
    Entry {
        name: "lattice",
        summary: "A lattice with the grid's spacing around the centre; as many points as the body has cells.",
        formula: "",
        source: "Clément 2009, 2.5.2",
    },
    Entry {
        name: "shells",
        summary: "Shells one spacing apart, the outermost drawn in by `retraction`.",
        formula: "",
        source: "Breugem 2012",
    },
];

impl Layout {
    /// Every choice, in the order of [`LAYOUTS`].
    pub const ALL: [Self; 2] = [Self::Lattice, Self::Shells];

    /// The layout called `name`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        LAYOUTS.iter().position(|e| e.name == name).map(|k| Self::ALL[k])
    }
}

/// The tracers of all bodies of nearly one size.
///
/// They do not turn with the body: force and torque depend on the velocity at
/// a place and on no memory, and a sphere or cylinder looks the same from all sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    /// Places from the centre, m, for a scale of 1; by slow, middle, contiguous axis of the grid.
    pub points: Vec<Vec3>,
    /// Part of the body's volume that each stands for; they sum to one.
    pub share: Vec<f64>,
    /// Pieces that span few planes of the grid.
    pub parts: Vec<Part>,
    /// The tracers in batches that are worked on at once.
    pub batches: Vec<Batch>,
    /// Batches are runs of neighbours on the grid's lattice along the contiguous axis.
    pub lattice: bool,
}

/// A piece of a template: tracers within [`PART_SPAN`] planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// First tracer and the one after the last.
    pub points: [usize; 2],
    /// First batch and the one after the last.
    pub batches: [usize; 2],
    /// Box around them from the centre, m, for a scale of 1.
    pub low: Vec3,
    /// Its upper corner, m.
    pub high: Vec3,
}

/// Tracers in a batch.
pub const LANES: usize = 8;

/// A vector for each tracer of a batch, component by component.
pub type Wide = [[f64; LANES]; 3];

/// Up to [`LANES`] tracers; what lies beyond `len` is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Batch {
    /// Number of tracers.
    pub len: usize,
    /// Lattice indices of the first, along the contiguous, middle and slow axis; zero for other layouts.
    pub at: [i16; 3],
    /// Places from the centre, m, for a scale of 1.
    pub arm: Wide,
    /// Part of the body's volume that each stands for.
    pub share: [f64; LANES],
    /// One for each tracer.
    pub mask: [f64; LANES],
    /// Cells that each controls, at most one: less where tracers crowd at the centre.
    pub grip: [f64; LANES],
}

/// Height of a part in planes of the grid.
pub const PART_SPAN: f64 = 2.0;

/// The template of one grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Index of the template.
    pub template: u32,
    /// Factor on its places.
    pub scale: f64,
}

/// Templates for a population of bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Templates {
    /// The templates.
    pub all: Vec<Template>,
    /// The template of each grain, in the order of identity.
    pub of: Vec<Fit>,
}

/// Steps per spacing in which shells are made; sizes between are scaled.
const SIZES_PER_SPACING: f64 = 10.0;

impl Templates {
    /// Templates for bodies of `radii` (m) on `grid`; `retraction` in spacings is for shells.
    #[must_use]
    pub fn new(grid: &Grid, body: Body, radii: &[f64], layout: Layout, retraction: f64) -> Self {
        let mut known = BTreeMap::new();
        let mut all = vec![];
        let lattice = Shell::all(grid, radii.iter().copied().fold(0.0, f64::max));
        let of = radii
            .iter()
            .map(|&r| {
                let (key, scale) = match layout {
                    Layout::Lattice => (count(&lattice, body.volume(r) / grid.cell_volume()), 1.0),
                    Layout::Shells => {
                        let h = spacing(grid);
                        let key = (r / h * SIZES_PER_SPACING).round().max(1.0);
                        let outer = |r: f64| (r - retraction * h).max(0.25 * r);
                        (key as usize, outer(r) / outer(key * h / SIZES_PER_SPACING))
                    }
                };
                let template = *known.entry(key).or_insert_with(|| {
                    let points = match layout {
                        Layout::Lattice => lattice_points(&lattice, key, grid),
                        Layout::Shells => shell_points(grid, key as f64 / SIZES_PER_SPACING, retraction),
                    };
                    all.push(Template::new(grid, points, layout));
                    all.len() - 1
                });
                Fit { template: template as u32, scale }
            })
            .collect();
        Self { all, of }
    }

    /// The template of grain `k` and its scale.
    #[inline]
    #[must_use]
    pub fn fit(&self, k: usize) -> (&Template, f64) {
        let fit = self.of[k];
        (&self.all[fit.template as usize], fit.scale)
    }

    /// Number of tracers of all grains.
    #[must_use]
    pub fn count(&self) -> usize {
        self.of.iter().map(|f| self.all[f.template as usize].points.len()).sum()
    }
}

/// Geometric mean of the spacings of directions that are not flat, m.
#[must_use]
pub fn spacing(grid: &Grid) -> f64 {
    let mut product = 1.0;
    for axis in 0..3 {
        if grid.sides[axis] != Side::Flat {
            product *= grid.spacing[axis];
        }
    }
    product.powf(1.0 / grid.dimensions() as f64)
}

impl Template {
    fn new(grid: &Grid, mut points: Vec<Tracer>, layout: Layout) -> Self {
        let [line, middle, slow] = grid.memory_order();
        let key = |x: &Vec3| [x[slow], x[middle], x[line]];
        points.sort_by(|a, b| key(&a.at).partial_cmp(&key(&b.at)).unwrap_or(std::cmp::Ordering::Equal));
        let total: f64 = points.iter().map(|p| p.share).sum();
        points.iter_mut().for_each(|p| p.share /= total);
        let lattice = layout == Layout::Lattice;
        // Whole planes of a lattice, two to a part.
        let span = if lattice { PART_SPAN - 0.5 } else { PART_SPAN } * grid.spacing[slow];
        let mut parts: Vec<Part> = vec![];
        let mut low = f64::NEG_INFINITY;
        for (k, Tracer { at: x, .. }) in points.iter().enumerate() {
            if x[slow] - low >= span {
                low = x[slow];
                parts.push(Part { points: [k, k], batches: [0, 0], low: *x, high: *x });
            }
            if let Some(last) = parts.last_mut() {
                last.points[1] = k + 1;
                last.low = last.low.min(*x);
                last.high = last.high.max(*x);
            }
        }
        let mut batches = vec![];
        for part in &mut parts {
            part.batches[0] = batches.len();
            let range = part.points[0]..part.points[1];
            batches.extend(batch(grid, lattice, &points[range]));
            part.batches[1] = batches.len();
        }
        let share = points.iter().map(|p| p.share).collect();
        Self { points: points.into_iter().map(|p| p.at).collect(), share, parts, batches, lattice }
    }
}

/// A tracer of a body of one spacing a unit.
struct Tracer {
    at: Vec3,
    /// Volume that it stands for, in any unit.
    share: f64,
    /// Cells that it controls.
    grip: f64,
}

/// Lattice points at one distance from the centre.
struct Shell {
    radius: f64,
    points: Vec<Vec3>,
    /// Points up to this distance.
    count: usize,
}

impl Shell {
    /// All lattice shells up to somewhat beyond `largest` (m).
    fn all(grid: &Grid, largest: f64) -> Vec<Self> {
        let reach = |axis: usize| match grid.sides[axis] {
            Side::Flat => 0,
            _ => (largest / grid.spacing[axis]) as i32 + 2,
        };
        let (a, b, c) = (reach(0), reach(1), reach(2));
        let h = Vec3::from_array(grid.spacing);
        let mut points: Vec<Vec3> = (-c..=c)
            .flat_map(|k| (-b..=b).flat_map(move |j| (-a..=a).map(move |i| [i, j, k])))
            .map(|i| h * Vec3::from_array(i.map(f64::from)))
            .collect();
        points.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let mut shells: Vec<Self> = vec![];
        for x in points {
            let radius = x.length();
            match shells.last_mut() {
                // Distances that differ by rounding are one.
                Some(s) if radius - s.radius <= 1e-9 * radius => s.points.push(x),
                _ => shells.push(Self { radius, points: vec![x], count: 0 }),
            }
        }
        let mut count = 0;
        for s in &mut shells {
            count += s.points.len();
            s.count = count;
        }
        shells
    }
}

/// Number of shells whose points come nearest to `cells`, so that each controls a cell (Clément 2.5.2).
fn count(shells: &[Shell], cells: f64) -> usize {
    let off = |k: &usize| (shells[*k].count as f64 - cells).abs();
    (0..shells.len()).min_by(|a, b| off(a).total_cmp(&off(b))).map_or(0, |k| k + 1)
}

fn lattice_points(shells: &[Shell], count: usize, _: &Grid) -> Vec<Tracer> {
    let all = shells[..count].iter().flat_map(|s| &s.points);
    all.map(|x| Tracer { at: *x, share: 1.0, grip: 1.0 }).collect()
}

/// Points on shells of a body of `radius` spacings, with the volume (2-D: area) that each stands for.
///
/// The innermost shell crowds at sizes between whole ones, by up to six points in one cell: the slip would be removed
/// six times over, and sweeps would pump it up. Its points together control the cells that they fill.
fn shell_points(grid: &Grid, radius: f64, retraction: f64) -> Vec<Tracer> {
    let h = spacing(grid);
    let flat = (0..3).find(|&a| grid.sides[a] == Side::Flat);
    let power = if flat.is_some() { 2 } else { 3 };
    let outermost = (radius - retraction).max(0.25 * radius);
    let mut points = vec![];
    let (mut r, mut beyond) = (outermost, radius);
    loop {
        let innermost = r < 1.25;
        let within = if innermost { 0.0 } else { r - 0.5 };
        let volume = f64::powi(beyond, power) - f64::powi(within, power);
        let directions = match flat {
            Some(axis) => ring(r, axis),
            None => cubed_sphere(r),
        };
        let n = directions.len() as f64;
        let ball = if flat.is_some() { std::f64::consts::PI } else { 4.0 / 3.0 * std::f64::consts::PI };
        let grip = if innermost { (ball * f64::powi(r + 0.5, power) / n).min(1.0) } else { 1.0 };
        points.extend(directions.into_iter().map(|d| Tracer { at: h * r * d, share: volume / n, grip }));
        if innermost {
            return points;
        }
        (r, beyond) = (r - 1.0, within);
    }
}

/// Directions to points about one spacing apart on a circle of `r` spacings, symmetric under quarter turns.
fn ring(r: f64, axis: usize) -> Vec<Vec3> {
    let n = 4 * ((std::f64::consts::TAU * r / 4.0).round() as usize).max(1);
    let (a, b) = (Vec3::AXES[(axis + 1) % 3], Vec3::AXES[(axis + 2) % 3]);
    (0..n)
        .map(|k| {
            let (s, c) = (std::f64::consts::TAU * (k as f64 + 0.5) / n as f64).sin_cos();
            c * a + s * b
        })
        .collect()
}

/// Directions to points about one spacing apart on a sphere of `r` spacings, symmetric as a cube is.
///
/// Equal angles on the six faces of a cube (Ronchi et al. 1996).
fn cubed_sphere(r: f64) -> Vec<Vec3> {
    // n² points a face cover 4 pi r² / 6; the 1/12 is the curvature of a shell one spacing thick.
    let area = 4.0 * std::f64::consts::PI * (r * r + 1.0 / 12.0);
    let n = ((area / 6.0).sqrt().round() as usize).max(1);
    let tangent = |k: usize| (std::f64::consts::FRAC_PI_4 * ((2 * k + 1) as f64 / n as f64 - 1.0)).tan();
    let mut points = vec![];
    for j in 0..n {
        for i in 0..n {
            let (s, t) = (tangent(i), tangent(j));
            for sign in [1.0, -1.0] {
                points.extend([vec3(sign, s, t), vec3(t, sign, s), vec3(s, t, sign)].map(Vec3::normalize));
            }
        }
    }
    points
}

/// The sorted points of a part in batches; on a lattice each is a run of neighbours along the contiguous axis.
fn batch(grid: &Grid, lattice: bool, points: &[Tracer]) -> Vec<Batch> {
    let order = grid.memory_order();
    let h = Vec3::from_array(grid.spacing);
    let mut batches: Vec<Batch> = vec![];
    for Tracer { at: x, share, grip } in points {
        let at = if lattice { order.map(|a| (x[a] / h[a]).round() as i16) } else { [0; 3] };
        let joins = |b: &Batch| {
            let next = at[1..] == b.at[1..] && at[0] == b.at[0] + b.len as i16;
            b.len < LANES && (next || !lattice)
        };
        if !batches.last().is_some_and(joins) {
            batches.push(Batch {
                len: 0,
                at,
                arm: [[0.0; LANES]; 3],
                share: [0.0; LANES],
                mask: [0.0; LANES],
                grip: [0.0; LANES],
            });
        }
        if let Some(b) = batches.last_mut() {
            for c in 0..3 {
                b.arm[c][b.len] = x[c];
            }
            (b.share[b.len], b.mask[b.len], b.grip[b.len]) = (*share, 1.0, *grip);
            b.len += 1;
        }
    }
    batches
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(h: f64) -> Grid {
        Grid::new([20; 3], [h; 3], [Side::Walls; 3])
    }

    #[test]
    fn three_points_per_radius_fill_a_sphere() {
        // 4/3 pi 27 = 113.1 lies between the shells of 93 and 123 lattice points, nearer to 123.
        let t = Templates::new(&cube(1.0), Body::Sphere, &[3.0, 2.9, 3.15], Layout::Lattice, 0.0);
        let n: Vec<usize> = (0..3).map(|k| t.fit(k).0.points.len()).collect();
        assert_eq!(n, [123, 93, 123]);
        assert_eq!(t.all.len(), 2, "equal templates are shared");
        let rows = &t.fit(0).0.batches;
        assert_eq!(rows.len(), 29, "rows of a lattice ball of radius 3");
        assert_eq!(rows.iter().map(|r| r.len).sum::<usize>(), 123);
    }

    #[test]
    fn templates_are_balanced_and_sum_to_one() {
        let flat = Grid::new([20, 1, 20], [1.0, 5.0, 1.2], [Side::Walls, Side::Flat, Side::Walls]);
        let cylinder = Body::Cylinder { length: 5.0 };
        for (grid, body) in [(cube(1.0), Body::Sphere), (flat, cylinder)] {
            for layout in Layout::ALL {
                for r in [0.6, 1.0, 3.0, 5.3, 10.5] {
                    let t = Templates::new(&grid, body, &[r], layout, 0.4);
                    let (t, _) = t.fit(0);
                    // Rounding of up to 5000 terms.
                    assert!((t.share.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                    let centre: Vec3 = t.points.iter().zip(&t.share).map(|(x, s)| *x * *s).sum();
                    assert!(centre.length() < 1e-12 * r, "{layout:?} {r}: {centre}");
                    let covered: usize = t.parts.iter().map(|p| p.points[1] - p.points[0]).sum();
                    assert_eq!(covered, t.points.len());
                }
            }
        }
    }

    /// One sweep removes the slip; more than twice of it would come back larger.
    #[test]
    fn tracers_control_no_more_cells_than_they_fill() {
        for k in 10..60 {
            let r = 0.1 * f64::from(k);
            let t = Templates::new(&cube(1.0), Body::Sphere, &[r], Layout::Shells, 0.4);
            let (t, _) = t.fit(0);
            let near = t.batches.iter().flat_map(|b| (0..b.len).map(move |l| (b, l)));
            let inside = near.filter(|(b, l)| (0..3).map(|c| b.arm[c][*l].powi(2)).sum::<f64>() < 1.0);
            let held: f64 = inside.map(|(b, l)| b.grip[l]).sum();
            // A ball of 1.5 spacings, reached by tracers within one.
            assert!(held < 4.0 / 3.0 * std::f64::consts::PI * 1.5_f64.powi(3), "{r}: {held}");
        }
    }

    #[test]
    fn shells_carry_the_inertia_of_the_body() {
        let t = Templates::new(&cube(1.0), Body::Sphere, &[8.0], Layout::Shells, 0.4);
        let (t, _) = t.fit(0);
        let second: f64 = t.points.iter().zip(&t.share).map(|(x, s)| s * x.length_squared()).sum();
        // Gyration radius squared times 3/2; a retraction of 0.4 spacings in 8 weighs the rim 3 % low.
        let exact = 0.6 * 64.0;
        assert!((second / exact - 1.0).abs() < 0.04, "{second} of {exact}");
    }

    #[test]
    fn shells_reach_to_the_retracted_surface_at_every_size() {
        for r in [2.93, 3.0, 3.31] {
            let t = Templates::new(&cube(1.0), Body::Sphere, &[r], Layout::Shells, 0.4);
            let (t, scale) = t.fit(0);
            let far = t.points.iter().map(|x| scale * x.length()).fold(0.0, f64::max);
            // Rounding only.
            assert!((far - (r - 0.4)).abs() < 1e-12);
        }
    }
}
