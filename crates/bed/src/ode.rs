//! Ordinary differential equations with events: Dormand-Prince 5(4), the
//! polynomial through each step, and falls of a function through zero.
//!
//! Dormand & Prince, J. Comput. Appl. Math. 6 (1980) 19; dense output after
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.6.

/// How closely and how boldly to integrate.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy<const N: usize> {
    /// Relative error per step.
    pub relative: f64,
    /// Absolute error per step, in the unit of each component.
    pub absolute: [f64; N],
    /// Longest step; event functions are looked at four times in each, so that
    /// a stay on one side should last longer than a quarter of it.
    pub longest: f64,
}

/// One accepted step, perhaps cut short by an event, and the polynomial through it.
#[derive(Clone, Copy, Debug)]
pub struct Step<const N: usize> {
    /// Where it starts.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
    length: f64,
    shape: [[f64; N]; 5],
}

impl<const N: usize> Step<N> {
    /// The state at `t` within the step, of fourth order.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; N] {
        let s = (t - self.start) / self.length;
        let r = 1.0 - s;
        let c = &self.shape;
        std::array::from_fn(|i| c[0][i] + s * (c[1][i] + r * (c[2][i] + s * (c[3][i] + r * c[4][i]))))
    }
}

/// Why an integration ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending<const N: usize> {
    /// The end of the interval, with the state there.
    Reached([f64; N]),
    /// Event function `which` fell through zero.
    Event {
        /// Its index.
        which: usize,
        /// When.
        time: f64,
        /// The state there.
        state: [f64; N],
    },
    /// The step shrank to nothing at this time, or too many were needed: the right side is not smooth there, or stiff.
    Stuck(f64),
}

/// Most steps that one integration tries: a stiff one would go on for hours and fill the memory.
pub const MOST_STEPS: usize = 1_000_000;

/// Integrates y' = `slope`(t, y) from `t0` to `t_end`, or to the first fall of
/// one of the `events` functions through zero; `seen` gets every step.
///
/// A function that starts below zero, or at zero and falls, is an event at
/// once; one that starts at zero and rises is not. Falls are looked for at four
/// points of each step, refined on the polynomial, then on the fifth-order formula.
pub fn integrate<const N: usize, const M: usize>(
    slope: impl Fn(f64, &[f64; N]) -> [f64; N],
    events: impl Fn(f64, &[f64; N]) -> [f64; M],
    t0: f64,
    y0: [f64; N],
    t_end: f64,
    accuracy: &Accuracy<N>,
    mut seen: impl FnMut(&Step<N>),
) -> Ending<N> {
    // Of two events at one time the second one starts below zero by rounding.
    if let Some(which) = events(t0, &y0).iter().position(|e| *e < 0.0) {
        return Ending::Event { which, time: t0, state: y0 };
    }
    let (mut t, mut y) = (t0, y0);
    let mut k1 = slope(t, &y);
    // Short at first, so that a brief stay above zero after the start is not stepped over.
    let mut h = (accuracy.longest * 1e-4).min(t_end - t0);
    let mut tried = 0;
    while t < t_end {
        tried += 1;
        if tried > MOST_STEPS {
            return Ending::Stuck(t);
        }
        h = h.min(accuracy.longest);
        let last = t + h >= t_end;
        if last {
            h = t_end - t;
        }
        if t + h <= t {
            return if last { break } else { Ending::Stuck(t) };
        }
        let trial = stages(&slope, t, &y, &k1, h);
        let error = trial.error(&y, accuracy);
        if error > 1.0 || error.is_nan() {
            h *= if error.is_nan() { 0.1 } else { (0.9 * error.powf(-0.2)).max(0.2) };
            continue;
        }
        let step = trial.step(t, &y, h);
        if let Some((which, time)) = first_fall(&events, &step) {
            let (time, state) = polish(&slope, &events, which, time, &step, &y, &k1);
            seen(&Step { end: time, ..step });
            return Ending::Event { which, time, state };
        }
        seen(&step);
        t = if last { t_end } else { t + h };
        y = trial.y;
        k1 = trial.k[6];
        h *= (0.9 * error.max(1e-10).powf(-0.2)).min(5.0);
    }
    Ending::Reached(y)
}

/// The seven slopes of one trial step and its end.
struct Trial<const N: usize> {
    k: [[f64; N]; 7],
    y: [f64; N],
    h: f64,
}

const C: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const A: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Fifth minus fourth order.
const E: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];
/// Quartic term of the dense output.
const D: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

#[inline]
fn stages<const N: usize>(
    slope: &impl Fn(f64, &[f64; N]) -> [f64; N],
    t: f64,
    y: &[f64; N],
    k1: &[f64; N],
    h: f64,
) -> Trial<N> {
    let mut k = [[0.0; N]; 7];
    k[0] = *k1;
    let mut point = *y;
    for s in 1..7 {
        point = std::array::from_fn(|i| y[i] + h * (0..s).map(|j| A[s][j] * k[j][i]).sum::<f64>());
        k[s] = slope(t + C[s] * h, &point);
    }
    Trial { k, y: point, h }
}

impl<const N: usize> Trial<N> {
    /// Root mean square of the error over its allowance.
    #[inline]
    fn error(&self, y: &[f64; N], a: &Accuracy<N>) -> f64 {
        let mut sum = 0.0;
        for i in 0..N {
            let e: f64 = self.h * (0..7).map(|j| E[j] * self.k[j][i]).sum::<f64>();
            let allowed = a.absolute[i] + a.relative * y[i].abs().max(self.y[i].abs());
            sum += (e / allowed) * (e / allowed);
        }
        (sum / N as f64).sqrt()
    }

    fn step(&self, t: f64, y: &[f64; N], h: f64) -> Step<N> {
        let mut shape = [[0.0; N]; 5];
        for i in 0..N {
            let change = self.y[i] - y[i];
            let bend = h * self.k[0][i] - change;
            shape[0][i] = y[i];
            shape[1][i] = change;
            shape[2][i] = bend;
            shape[3][i] = change - h * self.k[6][i] - bend;
            shape[4][i] = h * (0..7).map(|j| D[j] * self.k[j][i]).sum::<f64>();
        }
        Step { start: t, end: t + h, length: h, shape }
    }
}

/// The first fall through zero on the polynomial: which function, and when.
fn first_fall<const N: usize, const M: usize>(
    events: &impl Fn(f64, &[f64; N]) -> [f64; M],
    step: &Step<N>,
) -> Option<(usize, f64)> {
    let mut before = (step.start, events(step.start, &step.at(step.start)));
    for part in 1..=4 {
        let t = step.start + step.length * 0.25 * f64::from(part);
        let now = events(t, &step.at(t));
        let first = (0..M)
            .filter(|&m| before.1[m] >= 0.0 && now[m] < 0.0)
            .map(|m| (m, fall_between(|t| events(t, &step.at(t))[m], before.0, before.1[m], t, now[m])))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        if first.is_some() {
            return first;
        }
        before = (t, now);
    }
    None
}

/// The root of `f` between `a`, where it is not negative, and `b`, where it
/// is: the Illinois variant of false position, to the spacing of the numbers.
pub fn fall_between(f: impl Fn(f64) -> f64, mut a: f64, mut fa: f64, mut b: f64, mut fb: f64) -> f64 {
    if fa == 0.0 {
        return a;
    }
    let mut side = 0;
    for _ in 0..200 {
        let mut c = (a * fb - b * fa) / (fb - fa);
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        if !(c > low && c < high) {
            c = 0.5 * (a + b);
        }
        if c == a || c == b || (b - a).abs() <= 2.0 * f64::EPSILON * a.abs().max(b.abs()) {
            break;
        }
        let fc = f(c);
        if fc >= 0.0 {
            (a, fa) = (c, fc);
            if side == 1 {
                fb *= 0.5;
            }
            side = 1;
        } else {
            (b, fb) = (c, fc);
            if side == -1 {
                fa *= 0.5;
            }
            side = -1;
        }
        if fc == 0.0 {
            return c;
        }
    }
    0.5 * (a + b)
}

/// Moves an event found on the fourth-order polynomial to where the
/// fifth-order formula, taken exactly that far, has it.
fn polish<const N: usize, const M: usize>(
    slope: &impl Fn(f64, &[f64; N]) -> [f64; N],
    events: &impl Fn(f64, &[f64; N]) -> [f64; M],
    which: usize,
    found: f64,
    step: &Step<N>,
    y: &[f64; N],
    k1: &[f64; N],
) -> (f64, [f64; N]) {
    if found <= step.start {
        return (found, *y);
    }
    let reach = |t: f64| stages(slope, step.start, y, k1, t - step.start).y;
    let on_curve = |t: f64| events(t, &step.at(t))[which];
    let d = 1e-3 * step.length;
    let rate = (on_curve(found + d) - on_curve(found - d)) / (2.0 * d);
    let (mut t, mut state) = (found, reach(found));
    for _ in 0..3 {
        let shift = -events(t, &state)[which] / rate;
        // A grazing fall has no slope to follow: the polynomial's answer stands.
        if !shift.is_finite() || shift.abs() > d || t + shift <= step.start {
            break;
        }
        t += shift;
        state = reach(t);
    }
    (t, state)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn oscillator(_: f64, y: &[f64; 2]) -> [f64; 2] {
        [y[1], -y[0]]
    }

    fn accuracy(relative: f64) -> Accuracy<2> {
        Accuracy { relative, absolute: [relative; 2], longest: 0.5 }
    }

    #[test]
    fn a_turn_of_the_oscillator_comes_back() {
        let tau = std::f64::consts::TAU;
        let end = integrate(oscillator, |_, _| [1.0], 0.0, [1.0, 0.0], tau, &accuracy(1e-10), |_| ());
        let Ending::Reached(y) = end else { panic!("{end:?}") };
        // Some thirty steps of error 1e-10 each.
        assert!((y[0] - 1.0).abs() < 3e-9 && y[1].abs() < 3e-9, "{y:?}");
    }

    #[test]
    fn error_of_the_formula_falls_with_the_fifth_power() {
        let error = |n: u32| {
            let h = 1.0 / f64::from(n);
            let mut y = [1.0, 0.0];
            for k in 0..n {
                let t = f64::from(k) * h;
                y = stages(&oscillator, t, &y, &oscillator(t, &y), h).y;
            }
            (y[0] - 1f64.cos()).hypot(y[1] + 1f64.sin())
        };
        let order = (error(8) / error(16)).log2();
        assert!((order - 5.0).abs() < 0.2, "order {order}");
    }

    #[test]
    fn the_polynomial_is_of_fourth_order() {
        let error = |h: f64| {
            let y = [1.0, 0.0];
            let step = stages(&oscillator, 0.0, &y, &oscillator(0.0, &y), h).step(0.0, &y, h);
            (1..10)
                .map(|k| h * 0.1 * f64::from(k))
                .map(|t| (step.at(t)[0] - t.cos()).abs())
                .fold(0.0, f64::max)
        };
        // The local error of a fourth-order curve falls with the fifth power.
        let order = (error(0.4) / error(0.2)).log2();
        assert!(order > 4.7, "order {order}");
    }

    #[test]
    fn an_event_is_found_to_a_billionth() {
        let mut last = 0.0;
        let end =
            integrate(oscillator, |_, y| [y[0]], 0.0, [1.0, 0.0], 9.0, &accuracy(1e-10), |s| last = s.end);
        let Ending::Event { which: 0, time, state } = end else { panic!("{end:?}") };
        assert!((time - std::f64::consts::FRAC_PI_2).abs() < 1e-9, "{time}");
        assert!(state[0].abs() < 1e-15 && last == time);
    }

    #[test]
    fn leaving_zero_upwards_is_no_event_and_downwards_is_one_at_once() {
        let rise = integrate(oscillator, |_, y| [y[0]], 0.0, [0.0, 1.0], 9.0, &accuracy(1e-10), |_| ());
        let Ending::Event { time, .. } = rise else { panic!("{rise:?}") };
        assert!((time - std::f64::consts::PI).abs() < 1e-9);
        let fall = integrate(oscillator, |_, y| [y[0]], 0.0, [0.0, -1.0], 9.0, &accuracy(1e-10), |_| ());
        assert_eq!(fall, Ending::Event { which: 0, time: 0.0, state: [0.0, -1.0] });
        let below = integrate(oscillator, |_, y| [y[0]], 0.0, [-1e-18, 1.0], 9.0, &accuracy(1e-10), |_| ());
        assert_eq!(below, Ending::Event { which: 0, time: 0.0, state: [-1e-18, 1.0] });
    }

    #[test]
    fn the_earlier_of_two_events_wins() {
        let events = |_: f64, y: &[f64; 2]| [y[0], y[0] - 0.1];
        let end = integrate(oscillator, events, 0.0, [1.0, 0.0], 9.0, &accuracy(1e-10), |_| ());
        let Ending::Event { which, time, .. } = end else { panic!("{end:?}") };
        assert!(which == 1 && (time - 0.1f64.acos()).abs() < 1e-9);
    }
}
