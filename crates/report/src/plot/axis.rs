//! From values to places on the paper, and where the ticks go.

use crate::text;

/// An axis laid out: its range in the printed unit, its ticks, its place.
#[derive(Clone, Debug)]
pub(crate) struct Scale {
    /// Ends of the range, in the printed unit.
    pub range: [f64; 2],
    /// Logarithmic.
    pub log: bool,
    /// Size of the printed unit in the data's unit.
    pub factor: f64,
    /// Label with the printed unit.
    pub label: String,
    /// Labelled ticks, in the printed unit.
    pub ticks: Vec<(f64, String)>,
    /// Ticks without a label.
    pub minor: Vec<f64>,
    /// Where the ends of the range lie, px.
    pub place: [f64; 2],
}

/// How wide the axis is chosen around the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fit {
    /// Ends where the data end.
    Tight,
    /// A little room at both ends; from zero if the data come near it.
    Roomy,
}

impl Scale {
    /// An axis for data between `low` and `high`, with at most about `count` ticks.
    pub fn new(axis: &brazilnut_base::figure::Axis, low: f64, high: f64, fit: Fit, count: usize) -> Self {
        if axis.log { Self::log(axis, low, high, count) } else { Self::linear(axis, low, high, fit, count) }
    }

    fn linear(axis: &brazilnut_base::figure::Axis, low: f64, high: f64, fit: Fit, count: usize) -> Self {
        let (mut low, mut high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if high - low <= 1e-12 * high.abs().max(low.abs()) {
            // One value only: show it in the middle of something.
            let half = if high == 0.0 { 1.0 } else { 0.1 * high.abs() };
            (low, high) = (low - half, high + half);
        }
        if fit == Fit::Roomy {
            let span = high - low;
            let (zero_below, zero_above) =
                (low >= 0.0 && low < 0.35 * high, high <= 0.0 && high > 0.35 * low);
            low = if zero_below { 0.0 } else { low - 0.05 * span };
            high = if zero_above { 0.0 } else { high + 0.05 * span };
        }
        let (unit, factor) = text::readable_unit(&axis.unit, low.abs().max(high.abs()));
        let range = [low / factor, high / factor];
        let (label, ticks) = (text::labelled(&axis.label, &unit), linear_ticks(range, count));
        Self { range, log: false, factor, label, ticks, minor: vec![], place: [0.0, 1.0] }
    }

    /// The same linear axis printed in the unit that is `factor` of the data's.
    pub fn in_unit_of(self, axis: &brazilnut_base::figure::Axis, factor: f64, count: usize) -> Self {
        let (unit, factor) = text::readable_unit(&axis.unit, factor);
        let range = self.range.map(|v| v * self.factor / factor);
        let (label, ticks) = (text::labelled(&axis.label, &unit), linear_ticks(range, count));
        Self { range, factor, label, ticks, ..self }
    }

    fn log(axis: &brazilnut_base::figure::Axis, low: f64, high: f64, count: usize) -> Self {
        let (low, high) = if low > 0.0 && low <= high { (low, high) } else { (1.0, 10.0) };
        // At least a factor of two, and a little room at both ends.
        let room = 0.04 * (high / low).log10().max(0.3);
        let range = [low * 10f64.powf(-room), high * 10f64.powf(room)];
        let (ticks, minor) = log_ticks(range, count);
        let label = text::labelled(&axis.label, &text::unit(&axis.unit));
        Self { range, log: true, factor: 1.0, label, ticks, minor, place: [0.0, 1.0] }
    }

    /// Place of the data value `x`, px; `None` if it cannot be shown.
    pub fn at(&self, x: f64) -> Option<f64> {
        let y = self.printed(x / self.factor);
        y.is_finite().then_some(y)
    }

    /// Place of a value in the printed unit, px.
    pub fn printed(&self, x: f64) -> f64 {
        let [a, b] = self.range;
        let t = if self.log { (x / a).ln() / (b / a).ln() } else { (x - a) / (b - a) };
        self.place[0] + t * (self.place[1] - self.place[0])
    }

    /// Width of the widest tick label, px.
    pub fn label_width(&self, size: f64) -> f64 {
        self.ticks.iter().map(|(_, l)| text::width(l, size)).fold(0.0, f64::max)
    }
}

/// Ticks at whole multiples of 1, 2 or 5 times a power of ten.
pub(crate) fn linear_ticks(range: [f64; 2], count: usize) -> Vec<(f64, String)> {
    let step = nice_step((range[1] - range[0]) / count.max(1) as f64);
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
    // Half a millionth of a step keeps the ends in spite of rounding.
    let (first, last) = ((range[0] / step - 5e-7).ceil() as i64, (range[1] / step + 5e-7).floor() as i64);
    (first..=last).map(|k| (k as f64 * step, text::fixed(k as f64 * step, decimals))).collect()
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `rough`.
pub(crate) fn nice_step(rough: f64) -> f64 {
    let power = text::ten_to(rough.log10().floor() as i32);
    let nice = [1.0, 2.0, 5.0].into_iter().find(|m| m * power >= rough * (1.0 - 1e-9)).unwrap_or(10.0);
    nice * power
}

/// Labelled and unlabelled ticks of a logarithmic axis.
fn log_ticks(range: [f64; 2], count: usize) -> (Vec<(f64, String)>, Vec<f64>) {
    let decades = (range[1] / range[0]).log10();
    let [first, last] = [range[0].log10().floor() as i32, range[1].log10().ceil() as i32];
    let inside = |x: f64| x >= range[0] * (1.0 - 1e-9) && x <= range[1] * (1.0 + 1e-9);
    let every = (decades / (count as f64 + 1.5)).ceil().max(1.0) as i32;
    // Few decades need labels between the powers of ten.
    let digits: &[i32] = match decades {
        ..1.0 => &[1, 2, 3, 5, 7],
        ..2.2 => &[1, 2, 5],
        _ => &[1],
    };
    let (mut labelled, mut minor) = (vec![], vec![]);
    for (e, d) in (first..=last).flat_map(|e| (1..10).map(move |d| (e, d))) {
        let x = f64::from(d) * text::ten_to(e);
        if !inside(x) {
        } else if digits.contains(&d) && (d > 1 || e.rem_euclid(every) == 0) {
            labelled.push((x, d, e));
        } else if every == 1 || d == 1 {
            minor.push(x);
        }
    }
    // Plain numbers near one, powers of ten elsewhere; never both on one axis.
    let plain = labelled.iter().all(|(.., e)| (-2..=3).contains(e));
    let ticks = labelled.into_iter().map(|(x, d, e)| match d {
        _ if plain => (x, text::fixed(x, (-e).max(0) as usize)),
        1 => (x, text::power_of_ten(e)),
        _ => (x, format!("{d}×{}", text::power_of_ten(e))),
    });
    (ticks.collect(), minor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::figure::Axis;

    fn labels(s: &Scale) -> Vec<&str> {
        s.ticks.iter().map(|t| t.1.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_numbers_inside_the_range() {
        let s = Scale::new(&Axis::linear("height", "m"), 0.0301, 0.0432, Fit::Roomy, 6);
        assert_eq!((s.label.as_str(), s.factor), ("height [mm]", 1e-3));
        assert_eq!(labels(&s), ["30", "35", "40"]);
        let s = Scale::new(&Axis::linear("time", "s"), 0.0, 8.0, Fit::Tight, 6);
        assert_eq!(labels(&s), ["0", "2", "4", "6", "8"]);
        let s = Scale::new(&Axis::linear("x", "1"), -0.3, 0.3, Fit::Tight, 6);
        assert_eq!(labels(&s), ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]);
    }

    #[test]
    fn logarithmic_ticks_suit_few_and_many_decades() {
        let s = Scale::new(&Axis::log("k", "N/m"), 1e3, 1e9, Fit::Roomy, 6);
        assert_eq!(labels(&s), ["10³", "10⁴", "10⁵", "10⁶", "10⁷", "10⁸", "10⁹"]);
        let s = Scale::new(&Axis::log("k", "N/m"), 2.0, 8.0, Fit::Roomy, 6);
        assert_eq!(labels(&s), ["2", "3", "5", "7"]);
        assert_eq!(s.at(-1.0), None);
    }

    #[test]
    fn odd_data_still_give_an_axis() {
        for (low, high) in
            [(f64::INFINITY, f64::NEG_INFINITY), (3.0, 3.0), (0.0, 0.0), (-1e-300, 1e-300), (-1e300, 1e300)]
        {
            for axis in [Axis::linear("x", "m"), Axis::log("x", "m")] {
                let s = Scale::new(&axis, low, high, Fit::Roomy, 6);
                assert!(s.range[0] < s.range[1] && s.ticks.len() < 40, "{low} {high} {s:?}");
            }
        }
    }
}
