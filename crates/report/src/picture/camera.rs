//! Where the bed is seen from, and where a point of space falls on the picture.

use brazilnut_base::{Cell, Vec3, vec3};

/// A view of the bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Direction round the vertical, degrees: 0 looks along +y at the x-z plane.
    pub azimuth: f64,
    /// Height above the horizon, degrees.
    pub elevation: f64,
    /// Angle that the bed fills, degrees; 0 is a parallel projection.
    pub perspective: f64,
}

impl Camera {
    /// The x-z plane without perspective, as in a printed figure.
    pub const FRONT: Self = Self { azimuth: 0.0, elevation: 0.0, perspective: 0.0 };
    /// A gentle view from above one corner.
    pub const CORNER: Self = Self { azimuth: 24.0, elevation: 16.0, perspective: 22.0 };

    /// The view that suits a cell: straight at the plane of a two-dimensional case, else from a corner.
    #[must_use]
    pub fn for_cell(cell: &Cell) -> Self {
        match cell.flat_axis() {
            Some(0) => Self { azimuth: 90.0, ..Self::FRONT },
            Some(_) => Self::FRONT,
            None => Self::CORNER,
        }
    }
}

/// A camera aimed at a bed, with the size of its picture in samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    target: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// One over the distance of the eye; 0 is infinitely far.
    pub nearness: f64,
    /// Samples per metre in the plane through the target.
    pub zoom: f64,
    /// Height of the picture in samples.
    pub height: f64,
    centre: [f64; 2],
}

impl Camera {
    /// Aims at the box so that it fills the picture of `width` times `height` samples but for a margin.
    pub(crate) fn aim(&self, (low, high): (Vec3, Vec3), width: usize, height: usize) -> Lens {
        let (sa, ca) = self.azimuth.to_radians().sin_cos();
        let (se, ce) = self.elevation.clamp(-89.0, 89.0).to_radians().sin_cos();
        let forward = vec3(-sa * ce, ca * ce, -se);
        let right = vec3(ca, sa, 0.0);
        let up = right.cross(forward);
        let half = (0.5 * (high - low)).length().max(1e-30);
        // Nearer than twice the box, perspective is a distortion.
        let nearness = (0.5 * self.perspective.clamp(0.0, 50.0)).to_radians().tan() / half;
        let lens = Lens {
            target: 0.5 * (low + high),
            right,
            up,
            forward,
            nearness,
            zoom: 1.0,
            height: height as f64,
            centre: [0.0; 2],
        };

        let (min, max) = lens.frame((low, high));
        let (w, h) = (width as f64, height as f64);
        let margin = 0.045 * w.min(h);
        let zoom = ((w - 2.0 * margin) / (max[0] - min[0]).max(1e-30))
            .min((h - 2.0 * margin) / (max[1] - min[1]).max(1e-30));
        let centre = [0.5 * w - 0.5 * zoom * (min[0] + max[0]), 0.5 * h - 0.5 * zoom * (min[1] + max[1])];
        Lens { zoom, centre, ..lens }
    }
}

impl Camera {
    /// Height over width of a box as seen by this camera.
    pub(crate) fn aspect(&self, bounds: (Vec3, Vec3)) -> f64 {
        let (min, max) = self.aim(bounds, 1000, 1000).frame(bounds);
        (max[1] - min[1]) / (max[0] - min[0]).max(1e-30)
    }
}

impl Lens {
    /// Ends of a box on the picture, in samples.
    fn frame(&self, (low, high): (Vec3, Vec3)) -> ([f64; 2], [f64; 2]) {
        let corners = (0..8).map(|k| {
            self.project(vec3(
                if k & 1 == 0 { low.x } else { high.x },
                if k & 2 == 0 { low.y } else { high.y },
                if k & 4 == 0 { low.z } else { high.z },
            ))
        });
        corners.fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(min, max), [x, y, _]| {
            ([min[0].min(x), min[1].min(y)], [max[0].max(x), max[1].max(y)])
        })
    }

    /// A point in view coordinates: right, up, away.
    pub fn view(&self, p: Vec3) -> Vec3 {
        self.turn(p - self.target)
    }

    /// A direction in view coordinates.
    pub fn turn(&self, d: Vec3) -> Vec3 {
        vec3(d.dot(self.right), d.dot(self.up), d.dot(self.forward))
    }

    /// A direction in space from view coordinates.
    pub fn unturn(&self, d: Vec3) -> Vec3 {
        d.x * self.right + d.y * self.up + d.z * self.forward
    }

    /// A point in space from view coordinates.
    pub fn world(&self, v: Vec3) -> Vec3 {
        self.target + self.unturn(v)
    }

    /// How much larger things at this depth appear than at the target.
    pub fn magnification(&self, depth: f64) -> f64 {
        // Nothing drawn lies behind the eye: the view is a box in front of it.
        1.0 / (1.0 + depth * self.nearness).max(1e-3)
    }

    /// Place in samples from the upper left corner, and depth, m.
    pub fn project(&self, p: Vec3) -> [f64; 3] {
        let v = self.view(p);
        let m = self.zoom * self.magnification(v.z);
        [self.centre[0] + m * v.x, self.centre[1] - m * v.y, v.z]
    }

    /// The line of sight through a place on the picture in view coordinates:
    /// its point at depth 0, and how it moves on per metre of depth.
    pub fn ray(&self, x: f64, y: f64) -> (Vec3, Vec3) {
        let o = vec3((x - self.centre[0]) / self.zoom, (self.centre[1] - y) / self.zoom, 0.0);
        (o, vec3(o.x * self.nearness, o.y * self.nearness, 1.0))
    }

    /// The upward direction of space in view coordinates.
    pub fn vertical(&self) -> Vec3 {
        self.turn(Vec3::Z)
    }

    /// Height of the target, m.
    pub fn target_height(&self) -> f64 {
        self.target.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_sight_meets_what_is_projected_on_it() {
        for camera in [Camera::FRONT, Camera::CORNER] {
            let lens = camera.aim((Vec3::ZERO, vec3(2.0, 1.0, 3.0)), 400, 300);
            let p = vec3(0.3, 0.9, 2.0);
            let [x, y, depth] = lens.project(p);
            let (o, d) = lens.ray(x, y);
            // Rounding of a few operations on numbers of order one.
            assert!((lens.world(o + depth * d) - p).length() < 1e-12);
        }
    }

    #[test]
    fn the_box_is_in_view() {
        let high = vec3(2.0, 1.0, 3.0);
        let lens = Camera::CORNER.aim((Vec3::ZERO, high), 400, 300);
        for p in [Vec3::ZERO, high, vec3(2.0, 0.0, 0.0), vec3(0.0, 1.0, 3.0)] {
            let [x, y, _] = lens.project(p);
            assert!((0.0..400.0).contains(&x) && (0.0..300.0).contains(&y), "{x} {y}");
        }
        let front = Camera::FRONT.aim((Vec3::ZERO, high), 400, 300);
        let ([x0, y0, _], [x1, y1, _]) = (front.project(Vec3::ZERO), front.project(high));
        assert!(x1 > x0 && y1 < y0, "x to the right, z up");
    }
}
