//! The vertical part of a periodic shake, and when it throws what lies on it.

use crate::ode::fall_between;
use brazilnut_base::motion::Motion;
use std::f64::consts::TAU;

/// Points per period and harmonic at which a fall is looked for; minima
/// between them are refined, so that a barely thrown bed is not missed.
const LOOKS: u32 = 64;

/// A periodic vertical motion of the floor, with the gravity it works against.
#[derive(Clone, Debug)]
pub struct Shake {
    motion: Motion,
    /// Amplitude of acceleration (m/s²), angular frequency (1/s) and phase of each harmonic.
    harmonics: Vec<[f64; 3]>,
    /// Gravity, m/s².
    pub gravity: f64,
    /// The common period of the harmonics, s.
    pub period: f64,
    looks: u32,
}

impl Shake {
    /// The vertical part of `motion` under `gravity` (m/s²).
    ///
    /// # Errors
    /// Says why if it does not move vertically or is not periodic.
    pub fn new(motion: &Motion, gravity: f64) -> Result<Self, String> {
        let vertical: Vec<_> = motion.harmonics.iter().filter(|h| h.amplitude.z != 0.0).collect();
        if vertical.is_empty() {
            return Err(
                "the floor does not move vertically: give a shake with an acceleration above zero".into()
            );
        }
        if vertical
            .iter()
            .any(|h| !(h.frequency > 0.0 && h.frequency.is_finite() && h.amplitude.z.is_finite()))
        {
            return Err("every frequency must be greater than zero and finite, every amplitude finite".into());
        }
        let frequencies: Vec<f64> = vertical.iter().map(|h| h.frequency).collect();
        let base = base_frequency(&frequencies)
            .ok_or("the frequencies have no common period: use multiples of one frequency")?;
        let highest = frequencies.iter().fold(0.0_f64, |a, &b| a.max(b));
        let harmonics = vertical.iter().map(|h| {
            let w = TAU * h.frequency;
            [h.amplitude.z * w * w, w, h.phase.z]
        });
        Ok(Self {
            harmonics: harmonics.collect(),
            motion: motion.clone(),
            gravity,
            period: 1.0 / base,
            looks: LOOKS * (highest / base).round() as u32,
        })
    }

    /// Duration of the ramp, s.
    #[must_use]
    pub fn ramp(&self) -> f64 {
        self.motion.ramp.max(0.0)
    }

    /// Acceleration of the floor, m/s², upwards.
    #[must_use]
    pub fn acceleration(&self, t: f64) -> f64 {
        if t < self.motion.ramp {
            return self.motion.at(t).acceleration.z;
        }
        self.harmonics.iter().map(|[a, w, p]| -a * (w * t + p).sin()).sum()
    }

    /// Effective gravity on the floor g + z̈_c, m/s²; what lies there is thrown when it turns negative.
    #[must_use]
    pub fn weight(&self, t: f64) -> f64 {
        self.gravity + self.acceleration(t)
    }

    /// The next time, not before `t`, at which a body at rest on the floor leaves it.
    #[must_use]
    pub fn next_throw(&self, t: f64) -> Option<f64> {
        if self.weight(t) < 0.0 {
            return Some(t);
        }
        // Beyond the ramp the search runs in the first cycles, so that equal phases give equal bits.
        let whole = if t > self.ramp() + self.period {
            ((t - self.ramp()) / self.period).floor() * self.period
        } else {
            0.0
        };
        let start = t - whole;
        let end = start.max(self.ramp()) + self.period;
        let step = self.period / f64::from(self.looks);
        let n = ((end - start) / step).ceil() as u64;
        let mut back = (start, self.weight(start));
        let mut here = back;
        for k in 1..=n + 1 {
            let time = start + step * k as f64;
            let ahead = (time, self.weight(time));
            if here.1 < back.1 && here.1 <= ahead.1 && here.1 >= 0.0 {
                let low = minimum(|t| self.weight(t), back.0, ahead.0);
                if self.weight(low) < 0.0 {
                    return Some(
                        whole + fall_between(|t| self.weight(t), back.0, back.1, low, self.weight(low)),
                    );
                }
            }
            if ahead.1 < 0.0 {
                return Some(whole + fall_between(|t| self.weight(t), here.0, here.1, time, ahead.1));
            }
            (back, here) = (here, ahead);
        }
        None
    }

    /// Largest downward acceleration of the floor over gravity, after the ramp:
    /// Γ for a sinusoid (Clément eq. 2.43).
    #[must_use]
    pub fn gamma(&self) -> f64 {
        let a = |t: f64| self.acceleration(self.ramp() + t);
        let step = self.period / f64::from(self.looks);
        let lowest = (0..self.looks).map(|k| step * f64::from(k)).min_by(|x, y| a(*x).total_cmp(&a(*y)));
        let near = lowest.unwrap_or(0.0);
        -a(minimum(a, near - step, near + step)) / self.gravity
    }
}

/// The highest frequency of which all are whole multiples.
fn base_frequency(frequencies: &[f64]) -> Option<f64> {
    let lowest = frequencies.iter().copied().min_by(f64::total_cmp)?;
    (1..=64).map(|n| lowest / f64::from(n)).find(|base| {
        // Decimal fractions of a hertz round at 1e-16; 1e-9 leaves room and still means "equal".
        frequencies.iter().all(|f| (f / base - (f / base).round()).abs() < 1e-9 * f / base)
    })
}

/// Where `f` is least between `a` and `b`, by golden section.
pub(crate) fn minimum(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut c, mut d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut fc, mut fd) = (f(c), f(d));
    // 0.618^60 is 3e-13 of the bracket; a minimum is flat to 1e-8 of it.
    for _ in 0..60 {
        if fc < fd {
            (b, d, fd) = (d, c, fc);
            c = b - GOLDEN * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + GOLDEN * (b - a);
            fd = f(d);
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::{Vec3, motion::Harmonic};

    fn sinusoid(gamma: f64) -> Shake {
        let w = TAU * 10.0;
        Shake::new(&Motion::vertical(gamma * 9.81 / (w * w), 10.0), 9.81).unwrap()
    }

    #[test]
    fn throws_where_the_sine_is_one_over_gamma() {
        for gamma in [1.0001, 1.5, 2.0, 10.0] {
            let expected = (1.0_f64 / gamma).asin() / TAU;
            let found = sinusoid(gamma).next_throw(0.0).unwrap() * 10.0;
            // Near Γ = 1 the root is nearly double: rounding of 1e-16 moves it by 1e-14/√(Γ−1).
            assert!((found - expected).abs() < 1e-11, "{gamma}: {found} {expected}");
        }
        assert!((sinusoid(3.7).gamma() - 3.7).abs() < 1e-12);
    }

    #[test]
    fn never_throws_up_to_gamma_one() {
        assert_eq!(sinusoid(0.999_999).next_throw(0.0), None);
        assert_eq!(sinusoid(0.5).next_throw(0.02), None);
    }

    #[test]
    fn equal_phases_of_later_cycles_throw_alike() {
        let s = sinusoid(2.0);
        let first = s.next_throw(0.07).unwrap();
        let later = s.next_throw(0.07 + 12.3).unwrap();
        assert!((later - first - 12.3).abs() < 1e-13);
    }

    #[test]
    fn period_of_several_harmonics() {
        let h = |f| Harmonic { amplitude: Vec3::Z * 1e-3, frequency: f, phase: Vec3::ZERO };
        let shake = |fs: &[f64]| {
            Shake::new(&Motion { harmonics: fs.iter().map(|&f| h(f)).collect(), ramp: 0.0 }, 9.81)
        };
        assert!((shake(&[10.0, 15.0]).unwrap().period - 0.2).abs() < 1e-12);
        assert!((shake(&[10.0, 20.0]).unwrap().period - 0.1).abs() < 1e-12);
        assert!(shake(&[10.0, 10.0 * std::f64::consts::SQRT_2]).is_err());
        assert!(shake(&[]).is_err());
    }

    #[test]
    fn a_ramp_delays_the_first_throw() {
        let mut m = Motion::vertical(5e-3, 10.0);
        m.ramp = 1.0;
        let s = Shake::new(&m, 9.81).unwrap();
        let t = s.next_throw(0.0).unwrap();
        assert!(t > 0.1 && t < 1.0 && s.weight(t).abs() < 1e-9, "{t}");
    }
}
