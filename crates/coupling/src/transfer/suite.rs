//! What every kernel must satisfy.

use super::{Kernel, Roma, Stagger, Trilinear};
use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_fluid::{Faces, Grid};

const SIDES: [[Side; 3]; 3] = [
    [Side::Walls, Side::Walls, Side::Walls],
    [Side::Periodic, Side::Walls, Side::Periodic],
    [Side::Walls, Side::Flat, Side::Periodic],
];

fn grid(sides: [Side; 3]) -> Grid {
    let cells = if sides[1] == Side::Flat { [9, 1, 8] } else { [9, 7, 8] };
    Grid::new(cells, [0.1, 0.12, 0.15], sides)
}

/// Points all over the box, the corners and slightly beyond included.
fn points(g: &Grid) -> Vec<Vec3> {
    let size = g.size();
    (0..200)
        .map(|k| {
            let t = f64::from(k);
            let u = vec3((t * 0.754_877).fract(), (t * 0.569_840).fract(), (t * 0.318_329).fract());
            size * (1.04 * u - 0.02)
        })
        .collect()
}

fn sums_to_one_and_moves_all<const W: usize>(kernel: impl Kernel<W>) {
    for sides in SIDES {
        let g = grid(sides);
        let s = Stagger::new(&g, 4);
        let mut field = Faces::new(&g);
        let mut given = Vec3::ZERO;
        for (k, x) in points(&g).into_iter().enumerate() {
            let seat = s.seat(kernel, x);
            for c in 0..3 {
                let mut sum = 0.0;
                s.each(&seat, c, |_, w| sum += w);
                // Rounding of 27 products.
                assert!((sum - 1.0).abs() < 1e-14, "weights sum to {sum}");
            }
            let mut amount = vec3(1.0, -2.0, 0.5) * (1.0 + k as f64);
            for a in 0..3 {
                if s.is_flat(a) {
                    amount[a] = 0.0;
                }
            }
            given += amount;
            s.spread(&seat, amount, &mut field);
        }
        for c in 0..3 {
            let [a, b, d] = g.face_range(c);
            let layout = g.layout();
            let mut received = 0.0;
            for k in d {
                for j in b.clone() {
                    for i in a.clone() {
                        let on_wall = sides[c] == Side::Walls && {
                            let n = [i, j, k][c];
                            n == 0 || n == g.cells[c] as isize
                        };
                        let value = field.component(c)[layout.index(i, j, k)];
                        assert!(!on_wall || value == 0.0, "a wall face took a share");
                        received += value;
                    }
                }
            }
            // 200 numbers of order 100 with rounding errors.
            assert!((received - given[c]).abs() < 1e-9, "component {c}: {received} of {}", given[c]);
        }
    }
}

fn linear_fields_are_exact<const W: usize>(kernel: impl Kernel<W>) {
    let g = grid([Side::Walls; 3]);
    let s = Stagger::new(&g, 4);
    let mut field = Faces::new(&g);
    let f = |x: Vec3| vec3(1.0 + 2.0 * x.x - x.y, x.z - 3.0 * x.y, 0.3 * x.x + x.z);
    field.x.fill_with(&g, |i, j, k| f(g.face_center(0, i, j, k)).x);
    field.y.fill_with(&g, |i, j, k| f(g.face_center(1, i, j, k)).y);
    field.z.fill_with(&g, |i, j, k| f(g.face_center(2, i, j, k)).z);
    let margin = 2.0 * Vec3::from_array(g.spacing);
    for x in points(&g) {
        let inside = x.clamp(margin, g.size() - margin);
        let v = s.interpolate(&s.seat(kernel, inside), &field);
        // Rounding only.
        assert!((v - f(inside)).length() < 1e-13, "at {inside}: {v}");
    }
}

/// Moments of what was spread equal those of the points: the torque on the fluid is that taken from the grain.
fn torque_moved_is_torque_received<const W: usize>(kernel: impl Kernel<W>) {
    let g = grid([Side::Walls; 3]);
    let s = Stagger::new(&g, 4);
    let margin = 2.0 * Vec3::from_array(g.spacing);
    let mut field = Faces::new(&g);
    let mut given = Vec3::ZERO;
    for x in points(&g) {
        let x = x.clamp(margin, g.size() - margin);
        let force = vec3(x.y, -1.0, 2.0 * x.x);
        given += x.cross(force);
        s.spread(&s.seat(kernel, x), force, &mut field);
    }
    let mut received = Vec3::ZERO;
    for c in 0..3 {
        let [a, b, d] = g.face_range(c);
        for k in d {
            for j in b.clone() {
                for i in a.clone() {
                    let force = Vec3::AXES[c] * field.component(c)[g.layout().index(i, j, k)];
                    received += g.face_center(c, i, j, k).cross(force);
                }
            }
        }
    }
    // 200 torques of order 1 with rounding errors.
    assert!((received - given).length() < 1e-11, "{received} of {given}");
}

fn interpolation_is_the_transpose_of_spreading<const W: usize>(kernel: impl Kernel<W>) {
    let g = grid([Side::Periodic, Side::Walls, Side::Walls]);
    let s = Stagger::new(&g, 4);
    let mut field = Faces::new(&g);
    for c in 0..3 {
        for (k, v) in field.component_mut(c).iter_mut().enumerate() {
            *v = ((k * 7919 + c) % 101) as f64 - 50.0;
        }
    }
    for x in points(&g).into_iter().take(20) {
        let seat = s.seat(kernel, x);
        let amount = vec3(0.5, 1.0, -2.0);
        let mut other = Faces::new(&g);
        s.spread(&seat, amount, &mut other);
        let dot: f64 = (0..3)
            .map(|c| other.component(c).iter().zip(field.component(c)).map(|(a, b)| a * b).sum::<f64>())
            .sum();
        let other = amount.dot(s.interpolate(&seat, &field));
        // Rounding of 81 products of order 100.
        assert!((dot - other).abs() < 1e-11);
    }
}

macro_rules! suite {
    ($($kernel:ident $module:ident),*) => { $(
        mod $module {
            use super::*;

            #[test]
            fn sums_to_one_and_moves_all() {
                super::sums_to_one_and_moves_all($kernel);
            }

            #[test]
            fn linear_fields_are_exact() {
                super::linear_fields_are_exact($kernel);
            }

            #[test]
            fn torque_moved_is_torque_received() {
                super::torque_moved_is_torque_received($kernel);
            }

            #[test]
            fn interpolation_is_the_transpose_of_spreading() {
                super::interpolation_is_the_transpose_of_spreading($kernel);
            }
        }
    )* };
}

suite!(Trilinear trilinear, Roma roma);

#[test]
fn roma_is_the_published_kernel() {
    let outer = |q: f64| (5.0 - 3.0 * q - (1.0 - 3.0 * (1.0 - q) * (1.0 - q)).sqrt()) / 6.0;
    for k in 0..20 {
        let r = -0.5 + 0.05 * f64::from(k);
        let (first, w) = Roma.weights(5.0 + r);
        assert_eq!(first, 4.0);
        // Rounding.
        assert!((w[0] - outer(1.0 + r)).abs() < 1e-14 && (w[2] - outer(1.0 - r)).abs() < 1e-14, "{r}");
    }
}
