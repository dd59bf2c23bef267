//! Colours that survive print, projection and colour-blind readers.

/// Red, green, blue in 0..=1, as displays take them (sRGB).
pub type Rgb = [f64; 3];

/// Curves in order: Okabe and Ito (2008), told apart by all common kinds of colour vision.
pub const CURVES: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a7f87"];

/// Perceptually uniform, dark to light: `t` in 0..=1.
///
/// Nodes of viridis (van der Walt and Smith 2015, CC0), joined linearly.
#[must_use]
pub fn sequential(t: f64) -> Rgb {
    const NODES: [[u8; 3]; 17] = [
        [68, 1, 84],
        [72, 24, 106],
        [71, 45, 123],
        [66, 64, 134],
        [59, 82, 139],
        [51, 99, 141],
        [44, 114, 142],
        [38, 129, 142],
        [33, 144, 140],
        [31, 159, 136],
        [40, 174, 128],
        [62, 188, 116],
        [93, 201, 99],
        [130, 211, 76],
        [171, 220, 50],
        [213, 226, 26],
        [253, 231, 37],
    ];
    along(&NODES, t)
}

/// Blue, pale grey at the middle, red: for values of both signs, `t` in 0..=1 with zero at 0.5.
#[must_use]
pub fn diverging(t: f64) -> Rgb {
    const NODES: [[u8; 3]; 9] = [
        [20, 60, 120],
        [44, 104, 172],
        [104, 158, 206],
        [180, 206, 228],
        [240, 240, 240],
        [240, 196, 172],
        [222, 136, 106],
        [188, 66, 58],
        [124, 18, 36],
    ];
    along(&NODES, t)
}

fn along(nodes: &[[u8; 3]], t: f64) -> Rgb {
    let x = t.clamp(0.0, 1.0) * (nodes.len() - 1) as f64;
    let k = (x as usize).min(nodes.len() - 2);
    let f = x - k as f64;
    std::array::from_fn(|c| (f64::from(nodes[k][c]) * (1.0 - f) + f64::from(nodes[k + 1][c]) * f) / 255.0)
}

/// Eight bits per channel.
#[must_use]
pub fn to_bytes(colour: Rgb) -> [u8; 3] {
    colour.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// Display value (sRGB) to light.
#[must_use]
pub fn to_linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// Light to display value (sRGB).
#[must_use]
pub fn from_linear(c: f64) -> f64 {
    if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lightness (CIE L*) of a colour.
    fn lightness(c: Rgb) -> f64 {
        let y = 0.2126 * to_linear(c[0]) + 0.7152 * to_linear(c[1]) + 0.0722 * to_linear(c[2]);
        116.0 * y.cbrt() - 16.0
    }

    #[test]
    fn the_sequential_scale_brightens_evenly() {
        let steps: Vec<f64> = (0..16)
            .map(|k| lightness(sequential((k + 1) as f64 / 16.0)) - lightness(sequential(k as f64 / 16.0)))
            .collect();
        // From L* = 15 to 91 in 16 steps: 4.8 each. The scale is published to 1/255 and
        // uniform in another colour space than L*, hence a third of slack.
        assert!(steps.iter().all(|s| (3.2..6.4).contains(s)), "{steps:?}");
    }

    #[test]
    fn the_diverging_scale_is_palest_at_zero() {
        let zero = lightness(diverging(0.5));
        for t in [0.0, 0.25, 0.4, 0.6, 0.75, 1.0] {
            assert!(lightness(diverging(t)) < zero);
        }
    }

    #[test]
    fn light_and_display_values_invert() {
        for k in 0..=10 {
            let c = f64::from(k) / 10.0;
            // The published constants of the standard join to about 1e-8.
            assert!((from_linear(to_linear(c)) - c).abs() < 1e-7);
        }
    }
}
