//! One body falling through a fluid at rest: its speed, its drag, and the fits made to them (Clément 2009, 2.6.1, 2.7).

use crate::runs::{Done, column};
use brazilnut_base::figure::Curve;
use brazilnut_runner::Failure;

/// Gravity of the cases, m/s².
pub const GRAVITY: f64 = 9.81;

/// The path of a falling body, from its table `trajectory`.
#[derive(Clone, Debug, Default)]
pub struct Fall {
    time: Vec<f64>,
    height: Vec<f64>,
    speed: Vec<f64>,
}

impl Fall {
    /// The path in a run with one observed body.
    ///
    /// # Errors
    /// If the run has no such table.
    pub fn new(run: &Done) -> Result<Self, Failure> {
        let t = run.table("trajectory")?;
        let speed = column(&t, "velocity_z").iter().map(|v| -v).collect();
        Ok(Self { time: column(&t, "time"), height: column(&t, "height"), speed })
    }

    /// The part before the centre comes below `stop` (m).
    #[must_use]
    pub fn above(&self, stop: f64) -> Self {
        let n = self.height.iter().take_while(|z| **z >= stop).count();
        let cut = |v: &[f64]| v[..n].to_vec();
        Self { time: cut(&self.time), height: cut(&self.height), speed: cut(&self.speed) }
    }

    /// Mean speed over the last fifth of the path, m/s: the end of the run, over several cells of the grid.
    #[must_use]
    pub fn terminal(&self) -> f64 {
        let n = self.height.len();
        if n < 2 {
            return f64::NAN;
        }
        let from = self.height[n - 1] + 0.2 * (self.height[0] - self.height[n - 1]);
        let k = self.height.iter().position(|z| *z <= from).unwrap_or(n - 1).min(n - 2);
        (self.height[k] - self.height[n - 1]) / (self.time[n - 1] - self.time[k])
    }

    /// How jagged the speed is: root mean square of its second differences in the second half of the time,
    /// over the terminal speed.
    #[must_use]
    pub fn jaggedness(&self) -> f64 {
        let late = &self.speed[self.speed.len() / 2..];
        let second: Vec<f64> = late.windows(3).map(|w| w[0] - 2.0 * w[1] + w[2]).collect();
        let mean = second.iter().map(|d| d * d).sum::<f64>() / second.len() as f64;
        mean.sqrt() / self.terminal()
    }

    /// Downward speed over time.
    #[must_use]
    pub fn curve(&self, label: impl Into<String>) -> Curve {
        Curve::line(label, self.time.iter().zip(&self.speed).map(|(t, v)| [*t, *v]).collect())
    }
}

/// Drag coefficient of a cylinder across the stream, C_D = 1 + 10 Re^(−2/3) (White 1991; Clément eq. 2.107).
#[must_use]
pub fn cylinder_drag(reynolds: f64) -> f64 {
    1.0 + 10.0 * reynolds.powf(-2.0 / 3.0)
}

/// Drag coefficient of a sphere, C_D = 24/Re + 6/(1 + √Re) + 0.4 (White 1991; Clément eq. 2.108).
#[must_use]
pub fn sphere_drag(reynolds: f64) -> f64 {
    24.0 / reynolds + 6.0 / (1.0 + reynolds.sqrt()) + 0.4
}

/// Drag coefficient of a cylinder that falls steadily, C_D = (s − 1) π R g/U² (Clément eq. 2.106), with
/// s the ratio of the densities, `diameter` in m and `speed` in m/s.
#[must_use]
pub fn cylinder_coefficient(ratio: f64, diameter: f64, speed: f64) -> f64 {
    (ratio - 1.0) * std::f64::consts::PI * 0.5 * diameter * GRAVITY / (speed * speed)
}

/// Drag coefficient of a sphere that falls steadily, C_D = (s − 1) 4 d g/(3 U²) (from Clément eq. 2.105).
#[must_use]
pub fn sphere_coefficient(ratio: f64, diameter: f64, speed: f64) -> f64 {
    (ratio - 1.0) * 4.0 * diameter * GRAVITY / (3.0 * speed * speed)
}

/// Speed (m/s) at which the weight balances the drag: where the coefficient that the weight asks for at a speed
/// equals `law` at its Reynolds number U d/ν. Both fall with the speed, the former faster: bisection.
#[must_use]
pub fn terminal_speed(
    coefficient: impl Fn(f64) -> f64,
    law: impl Fn(f64) -> f64,
    diameter: f64,
    kinematic_viscosity: f64,
) -> f64 {
    let (mut low, mut high) = (1e-6_f64, 1e2_f64);
    for _ in 0..80 {
        let u = (low * high).sqrt();
        if coefficient(u) > law(u * diameter / kinematic_viscosity) { low = u } else { high = u }
    }
    low
}

/// Least-squares coefficients of y = Σ c_k x^p_k.
#[must_use]
pub fn fit(points: &[[f64; 2]], powers: &[i32]) -> Vec<f64> {
    let n = powers.len();
    let mut rows = vec![vec![0.0; n + 1]; n];
    for [x, y] in points {
        for i in 0..n {
            let weight = x.powi(powers[i]);
            for j in 0..n {
                rows[i][j] += weight * x.powi(powers[j]);
            }
            rows[i][n] += weight * y;
        }
    }
    // Normal equations of at most three terms: Gauss without pivoting, they are positive definite.
    for k in 0..n {
        let pivot = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != k {
                let factor = row[k] / pivot[k];
                row.iter_mut().zip(&pivot).for_each(|(a, b)| *a -= factor * b);
            }
        }
    }
    (0..n).map(|k| rows[k][n] / rows[k][k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_speeds_of_the_printed_curves() {
        // Hand values (bisection in another program), four digits: D in cm and U in m/s at 1100 against 1000 kg/m³.
        for (d, u) in [(0.01, 0.1029), (0.02, 0.1593), (0.04, 0.2363)] {
            let found = terminal_speed(|u| cylinder_coefficient(1.1, d, u), cylinder_drag, d, 1e-5);
            assert!((found - u).abs() < 1e-4, "{d}: {found}");
        }
        let found = terminal_speed(|u| sphere_coefficient(2.5, 0.01, u), sphere_drag, 0.01, 1e-5);
        assert!((found - 0.5315).abs() < 1e-4, "{found}");
    }

    #[test]
    fn a_polynomial_is_found_again() {
        let points: Vec<[f64; 2]> =
            [0.1, 0.2, 0.4, 0.5].iter().map(|x| [*x, 0.2 - 0.9 * x - 0.3 * x * x]).collect();
        let c = fit(&points, &[0, 1, 2]);
        // Rounding, enlarged by the condition of the normal equations.
        assert!(c.iter().zip([0.2, -0.9, -0.3]).all(|(a, b)| (a - b).abs() < 1e-10), "{c:?}");
        let c = fit(&[[1.0, 3.0], [2.0, 10.0]], &[1, 2]);
        assert!((c[0] - 1.0).abs() < 1e-12 && (c[1] - 2.0).abs() < 1e-12, "{c:?}");
    }

    #[test]
    fn a_steady_fall_has_its_speed_and_is_smooth() {
        let time: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
        let height = time.iter().map(|t| 0.3 - 0.2 * t).collect();
        let fall = Fall { speed: vec![0.2; 100], height, time };
        assert!((fall.terminal() - 0.2).abs() < 1e-12);
        assert_eq!(fall.jaggedness(), 0.0);
        assert_eq!(fall.above(0.2).time.len(), 50);
    }
}
