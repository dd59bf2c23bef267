//! Openings in the box, at the ends of the contiguous direction.

use crate::boundary::{Boundary, Profile};
use crate::field::Faces;
use crate::shape::Shape;
use crate::spec::FluidSpec;
use brazilnut_base::Side;

/// Which ends hold a pressure.
pub(crate) fn held(spec: &FluidSpec) -> [bool; 2] {
    let axis = spec.grid.line_axis;
    [0, 1].map(|end| matches!(spec.side(axis, end), Some(Boundary::Outflow { .. })))
}

/// Prescribed velocity along the axis at each (j, k) of both ends, empty where none is.
pub(crate) fn profiles(spec: &FluidSpec, shape: &Shape) -> [Vec<f64>; 2] {
    [0, 1].map(|end| match spec.side(shape.axis[0], end) {
        Some(Boundary::Inflow { profile }) => {
            let sign = if end == 0 { 1.0 } else { -1.0 };
            values(profile, shape).into_iter().map(|v| sign * v).collect()
        }
        _ => vec![],
    })
}

/// Speed into the box at each (j, k), m/s; its mean over the cells is the given one exactly.
fn values(profile: &Profile, shape: &Shape) -> Vec<f64> {
    let [_, n1, n2] = shape.n;
    let speed = match *profile {
        Profile::Uniform(speed) => return vec![speed; n1 * n2],
        Profile::Parabolic(speed) => speed,
    };
    let across = |level: usize, i: usize| {
        let s = (i as f64 + 0.5) / shape.n[level] as f64;
        if shape.side[level] == Side::Walls { s * (1.0 - s) } else { 1.0 }
    };
    let shapes: Vec<f64> = (0..n2).flat_map(|k| (0..n1).map(move |j| across(1, j) * across(2, k))).collect();
    let mean = shapes.iter().sum::<f64>() / shapes.len() as f64;
    shapes.into_iter().map(|s| speed * s / mean).collect()
}

/// Writes wall and inflow velocities to the faces on the sides.
pub(crate) fn impose(inflow: &[Vec<f64>; 2], spec: &FluidSpec, shape: &Shape, velocity: &mut Faces) {
    for level in 0..3 {
        if shape.side[level] == Side::Flat {
            velocity.component_mut(shape.axis[level]).fill(0.0);
        }
        if !shape.walled(level) {
            continue;
        }
        for end in 0..2 {
            if matches!(spec.sides[shape.axis[level]][end], Boundary::Outflow { .. }) {
                continue;
            }
            let (a, b) = ((level + 1) % 3, (level + 2) % 3);
            let field = velocity.component_mut(shape.axis[level]);
            for y in 0..shape.n[b] {
                for x in 0..shape.n[a] {
                    let mut c = [0; 3];
                    (c[level], c[a], c[b]) = (end * shape.n[level], x, y);
                    let at = shape.origin + (0..3).map(|l| c[l] * shape.stride[l]).sum::<usize>();
                    let profile = if level == 0 { &inflow[end][..] } else { &[] };
                    field[at] = profile.get(c[1] + c[2] * shape.n[1]).copied().unwrap_or(0.0);
                }
            }
        }
    }
}
