//! Text: escaping, its width on paper, numbers and units as a journal prints them.

/// Text inside HTML or SVG.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Neither format allows the other control characters in any form.
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// Width of `text` at `size` pixels in whichever sans-serif face the reader has.
#[must_use]
pub fn width(text: &str, size: f64) -> f64 {
    // Common faces run up to an eighth wider than Helvetica: too much room is better than an overlap.
    1.12 * text.chars().map(advance).sum::<f64>() * size / 1000.0
}

/// Advance of a character in thousandths of the size (Helvetica's published metrics).
fn advance(c: char) -> f64 {
    f64::from(match c {
        'i' | 'j' | 'l' | '\'' => 222,
        ' ' | '!' | ',' | '.' | '/' | ':' | ';' | 'I' | '[' | ']' | '\\' | 'f' | 't' | '·' => 278,
        '(' | ')' | '-' | 'r' | '`' | '⁻' | '°' | '⁰' | '⁴'..='⁹' | '²'..='³' | '¹' => 333,
        '"' => 355,
        '*' => 389,
        '^' => 469,
        'c' | 'k' | 's' | 'v' | 'x' | 'y' | 'z' | 'J' => 500,
        '+' | '<' | '=' | '>' | '~' | '×' | '−' | '±' => 584,
        'F' | 'T' | 'Z' => 611,
        '&' | 'A' | 'B' | 'E' | 'K' | 'P' | 'S' | 'V' | 'X' | 'Y' => 667,
        'C' | 'D' | 'H' | 'N' | 'R' | 'U' | 'w' => 722,
        'G' | 'O' | 'Q' => 778,
        'M' | 'm' => 833,
        '%' => 889,
        'W' => 944,
        '@' => 1015,
        c if c.is_ascii() => 556,
        c if c.is_lowercase() => 570,
        _ => 720,
    })
}

/// Breaks `text` into lines no wider than `limit` pixels.
#[must_use]
pub fn wrap(text: &str, size: f64, limit: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(" ", size) + width(word, size) <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

/// `10` to the `n` with raised digits.
#[must_use]
pub fn power_of_ten(n: i32) -> String {
    format!("10{}", raised(&n.to_string()))
}

/// The number nearest to `10` to the `n`; repeated multiplication would miss it.
pub(crate) fn ten_to(n: i32) -> f64 {
    format!("1e{n}").parse().unwrap_or(f64::NAN)
}

/// Digits and minus raised.
fn raised(digits: &str) -> String {
    digits
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            c => c.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(c),
        })
        .collect()
}

/// A unit with raised exponents and middle dots: `kg/m^3` as kg/m³, `Pa s` as Pa·s.
#[must_use]
pub fn unit(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(k) = rest.find('^') {
        let (before, after) = (&rest[..k], &rest[k + 1..]);
        let end = after.find(|c: char| c != '-' && !c.is_ascii_digit()).unwrap_or(after.len());
        out.push_str(before);
        // A broken exponent has no raised point: it stays as it is.
        if end == 0 || after[end..].starts_with('.') {
            out.push('^');
            rest = after;
        } else {
            out.push_str(&raised(&after[..end]));
            rest = &after[end..];
        }
    }
    out.push_str(rest);
    out.replace(' ', "·")
}

/// A label with its unit in brackets; none for pure numbers.
#[must_use]
pub fn labelled(label: &str, unit: &str) -> String {
    if unit.is_empty() || unit == "1" { label.to_string() } else { format!("{label} [{unit}]") }
}

/// `x` with `decimals` digits after the point and a true minus sign.
#[must_use]
pub fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    // Rounding must not print a negative zero.
    let is_zero = !text.contains(|c: char| ('1'..='9').contains(&c));
    match text.strip_prefix('-') {
        Some(rest) if is_zero => rest.to_string(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

/// `x` with about `digits` significant digits, as a journal prints it: `2.5×10⁻⁷`.
#[must_use]
pub fn significant(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return if x.is_nan() {
            "–".into()
        } else if x > 0.0 {
            "∞".into()
        } else {
            "−∞".into()
        };
    }
    // Rust's own rounding decides the exponent: 9.9999996 is 10.0000.
    let text = format!("{x:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let e: i32 = exponent.parse().unwrap_or(0);
    let trim = |t: &str| {
        if t.contains('.') {
            t.trim_end_matches('0').trim_end_matches('.').to_string()
        } else {
            t.to_string()
        }
    };
    let number = if (-3..digits as i32).contains(&e) {
        trim(&format!("{x:.*}", (digits as i32 - 1 - e).max(0) as usize))
    } else {
        format!("{}×{}", trim(mantissa), power_of_ten(e))
    };
    number.replace('-', "−")
}

/// The unit in which values up to `largest` read well, and its size in `unit`:
/// a prefix where the unit takes one (`mm`), a power of ten elsewhere.
#[must_use]
pub fn readable_unit(text: &str, largest: f64) -> (String, f64) {
    const PREFIXED: [&str; 10] = ["m", "s", "m/s", "N", "J", "W", "Pa", "Hz", "Pa s", "N/m"];
    let takes_prefix = PREFIXED.contains(&text);
    let plain = if takes_prefix { 0.15..1e3 } else { 0.01..1e4 };
    if !largest.is_finite() || largest <= 0.0 || plain.contains(&largest) {
        return (unit(text), 1.0);
    }
    // A hair more than rounding, so that 1e-3 counts as 1e-3.
    let exponent = (largest.log10() + 1e-9).floor() as i32;
    if takes_prefix {
        let thousand = exponent.div_euclid(3);
        let prefix = match thousand {
            -4 => "p",
            -3 => "n",
            -2 => "µ",
            -1 => "m",
            0 => "",
            1 => "k",
            2 => "M",
            3 => "G",
            _ => return (format!("{} {}", power_of_ten(exponent), unit(text)), ten_to(exponent)),
        };
        return (format!("{prefix}{}", unit(text)), ten_to(3 * thousand));
    }
    let factor = power_of_ten(exponent);
    let name = if text.is_empty() || text == "1" { factor } else { format!("{factor} {}", unit(text)) };
    (name, ten_to(exponent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn user_text_cannot_break_out() {
        assert_eq!(
            escape("<script>\"a\" & 'b'\u{1}"),
            "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;\u{fffd}"
        );
    }

    #[test]
    fn units_and_numbers_read_as_printed() {
        assert_eq!(unit("kg/m^3"), "kg/m³");
        assert_eq!(unit("Pa s"), "Pa·s");
        assert_eq!(unit("m s^-1"), "m·s⁻¹");
        assert_eq!(unit("N/m^1.5"), "N/m^1.5");
        assert_eq!(labelled("height", "m"), "height [m]");
        assert_eq!(labelled("Γ", "1"), "Γ");
        assert_eq!(fixed(-1.25, 1), "−1.2");
        assert_eq!(fixed(-0.001, 2), "0.00");
        assert_eq!(power_of_ten(-12), "10⁻¹²");
    }

    #[test]
    fn small_and_large_values_get_a_prefix() {
        assert_eq!(readable_unit("m", 0.0012), ("mm".into(), 1e-3));
        assert_eq!(readable_unit("m", 0.04), ("mm".into(), 1e-3));
        assert_eq!(readable_unit("m", 0.1), ("mm".into(), 1e-3));
        assert_eq!(readable_unit("s", 2.0), ("s".into(), 1.0));
        assert_eq!(readable_unit("Pa", 2e5), ("kPa".into(), 1e3));
        assert_eq!(readable_unit("m^2/s^2", 2e-7), ("10⁻⁷ m²/s²".into(), 1e-7));
        assert_eq!(readable_unit("1", 3e-4), ("10⁻⁴".into(), 1e-4));
        assert_eq!(readable_unit("m", 1e-30), ("10⁻³⁰ m".into(), 1e-30));
    }

    #[test]
    fn significant_digits() {
        assert_eq!(significant(1234.5678, 6), "1234.57");
        assert_eq!(significant(-2.5e-7, 3), "−2.5×10⁻⁷");
        assert_eq!(significant(0.05, 3), "0.05");
        assert_eq!(significant(9.9999996, 6), "10");
        assert_eq!(significant(0.0, 6), "0");
        assert_eq!(significant(f64::NAN, 6), "–");
        assert_eq!(significant(1e20, 3), "1×10²⁰");
    }

    #[test]
    fn lines_fit() {
        let lines = wrap("a rather long title that needs more than one line", 14.0, 130.0);
        assert!(lines.len() > 1 && lines.iter().all(|l| width(l, 14.0) <= 130.0), "{lines:?}");
    }
}
