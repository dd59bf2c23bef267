//! Which faces the fluid can pass, and which neighbours a solid stands between.

use crate::boundary::Boundary;
use crate::field::Faces;
use crate::shape::Shape;
use crate::solid::Solid;
use crate::spec::FluidSpec;
use brazilnut_base::Side;

/// A face whose neighbour across the flow lies behind a solid surface half a cell away.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// Level of the component.
    pub component: usize,
    /// Level of the direction towards the neighbour.
    pub level: usize,
    /// Place of the face.
    pub here: usize,
    /// Place of the neighbour.
    pub there: usize,
}

/// True if plane `c[axis]` of a face normal to `axis` at cell `c` belongs to `solid`.
fn covers(solid: &Solid, axis: usize, c: [usize; 3]) -> bool {
    (0..3).all(|a| {
        if a == axis {
            (solid.low[a]..=solid.high[a]).contains(&c[a])
        } else {
            (solid.low[a]..solid.high[a]).contains(&c[a])
        }
    })
}

/// 1 on faces that the fluid passes, 0 on walls, inflow sides and solids;
/// ghosts of periodic directions included.
pub(crate) fn open_faces(spec: &FluidSpec) -> Faces {
    let grid = &spec.grid;
    let mut open = Faces::new(grid);
    let layout = grid.layout();
    // One ghost each way, and the far face.
    let range = [0, 1, 2].map(|a| match grid.sides[a] {
        Side::Flat => 0..1,
        Side::Walls => 0..grid.cells[a] as isize + 1,
        Side::Periodic => -1..grid.cells[a] as isize + 1,
    });
    for axis in (0..3).filter(|&a| grid.sides[a] != Side::Flat) {
        let [x, y, z] = range.clone();
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    if passes(spec, axis, [i, j, k]) {
                        open.component_mut(axis)[layout.index(i, j, k)] = 1.0;
                    }
                }
            }
        }
    }
    open
}

/// Whether the fluid passes face `c` normal to `axis`.
fn passes(spec: &FluidSpec, axis: usize, c: [isize; 3]) -> bool {
    let grid = &spec.grid;
    let mut place = [0; 3];
    for a in 0..3 {
        let n = grid.cells[a];
        place[a] = if grid.sides[a] == Side::Periodic { c[a].rem_euclid(n as isize) } else { c[a] } as usize;
        if a != axis && place[a] == n {
            return false;
        }
    }
    let n = grid.cells[axis];
    if grid.sides[axis] == Side::Walls && (place[axis] == 0 || place[axis] == n) {
        let end = usize::from(place[axis] == n);
        if !matches!(spec.sides[axis][end], Boundary::Outflow { .. }) {
            return false;
        }
    }
    // Face 0 of a periodic direction is also the far end of a solid that reaches there.
    let mut far = place;
    if grid.sides[axis] == Side::Periodic && place[axis] == 0 {
        far[axis] = n;
    }
    !spec.solids.iter().any(|s| covers(s, axis, place) || covers(s, axis, far))
}

/// All faces whose neighbour stands behind a surface of a solid.
pub(crate) fn links(spec: &FluidSpec, shape: &Shape, open: &Faces) -> Vec<Link> {
    let mut links = vec![];
    if spec.solids.is_empty() {
        return links;
    }
    let open = open.in_order(shape.axis);
    let (n, s) = (shape.n, shape.stride);
    for component in 0..3 {
        for k in 0..n[2] {
            for j in 0..n[1] {
                for i in 0..n[0] {
                    let here = shape.origin + i * s[0] + j * s[1] + k * s[2];
                    if s[component] == 0 || open[component][here] == 0.0 {
                        continue;
                    }
                    for level in (0..3).filter(|&l| l != component && s[l] != 0) {
                        let c = [i, j, k][level];
                        // The two faces across `level` that share the edge towards the neighbour.
                        let shut =
                            |at: usize| open[level][at] == 0.0 && open[level][at - s[component]] == 0.0;
                        let side = shape.side[level];
                        if shut(here) && (c > 0 || side == Side::Periodic) {
                            links.push(Link { component, level, here, there: here - s[level] });
                        }
                        if shut(here + s[level]) && (c + 1 < n[level] || side == Side::Periodic) {
                            links.push(Link { component, level, here, there: here + s[level] });
                        }
                    }
                }
            }
        }
    }
    links
}
