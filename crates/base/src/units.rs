//! Quantities with units: SI inside, `"2.5 mm"` when reading.

use std::fmt;

/// Exponents of metre, kilogram and second, doubled so that N m^(-3/2) fits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension {
    /// Twice the exponent of metre.
    pub length: i8,
    /// Twice the exponent of kilogram.
    pub mass: i8,
    /// Twice the exponent of second.
    pub time: i8,
}

/// Shorthand: whole exponents of m, kg, s.
const fn dim(length: i8, mass: i8, time: i8) -> Dimension {
    Dimension { length: 2 * length, mass: 2 * mass, time: 2 * time }
}

impl Dimension {
    /// 1
    pub const NONE: Self = dim(0, 0, 0);
    /// m
    pub const LENGTH: Self = dim(1, 0, 0);
    /// m²
    pub const AREA: Self = dim(2, 0, 0);
    /// m³
    pub const VOLUME: Self = dim(3, 0, 0);
    /// kg
    pub const MASS: Self = dim(0, 1, 0);
    /// s
    pub const TIME: Self = dim(0, 0, 1);
    /// Hz
    pub const FREQUENCY: Self = dim(0, 0, -1);
    /// m/s
    pub const VELOCITY: Self = dim(1, 0, -1);
    /// m/s²
    pub const ACCELERATION: Self = dim(1, 0, -2);
    /// kg/m³
    pub const DENSITY: Self = dim(-3, 1, 0);
    /// Pa
    pub const PRESSURE: Self = dim(-1, 1, -2);
    /// Pa s
    pub const VISCOSITY: Self = dim(-1, 1, -1);
    /// N
    pub const FORCE: Self = dim(1, 1, -2);
    /// N/m
    pub const STIFFNESS: Self = dim(0, 1, -2);
    /// N m^(-3/2)
    pub const HERTZ_STIFFNESS: Self = Dimension { length: -1, mass: 2, time: -4 };
    /// kg/s
    pub const DAMPING: Self = dim(0, 1, -1);
    /// kg m^(-1/2) s^(-1)
    pub const HERTZ_DAMPING: Self = Dimension { length: -1, mass: 2, time: -2 };

    fn add(self, other: Self, times_half: i8) -> Self {
        // An absurd exponent saturates: it then is of the wrong kind, which is what it will be told.
        let sum = |a: i8, b: i8| a.saturating_add(b.saturating_mul(times_half) / 2);
        Self {
            length: sum(self.length, other.length),
            mass: sum(self.mass, other.mass),
            time: sum(self.time, other.time),
        }
    }
}

/// The SI unit as a person writes it.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const NAMED: &[(Dimension, &str)] = &[
            (Dimension::NONE, "1"),
            (Dimension::FREQUENCY, "Hz"),
            (Dimension::VELOCITY, "m/s"),
            (Dimension::ACCELERATION, "m/s^2"),
            (Dimension::DENSITY, "kg/m^3"),
            (Dimension::PRESSURE, "Pa"),
            (Dimension::VISCOSITY, "Pa s"),
            (Dimension::FORCE, "N"),
            (Dimension::STIFFNESS, "N/m"),
            (Dimension::DAMPING, "kg/s"),
            (Dimension::HERTZ_STIFFNESS, "N/m^1.5"),
            (Dimension::HERTZ_DAMPING, "kg/m^0.5/s"),
        ];
        if let Some((_, name)) = NAMED.iter().find(|(d, _)| d == self) {
            return f.write_str(name);
        }
        let mut first = true;
        for (e, name) in [(self.mass, "kg"), (self.length, "m"), (self.time, "s")] {
            if e != 0 {
                if !first {
                    f.write_str(" ")?;
                }
                first = false;
                match e {
                    2 => f.write_str(name)?,
                    _ => write!(f, "{name}^{}", f64::from(e) / 2.0)?,
                }
            }
        }
        Ok(())
    }
}

const UNITS: &[(&str, f64, Dimension)] = &[
    ("m", 1.0, Dimension::LENGTH),
    ("km", 1e3, Dimension::LENGTH),
    ("cm", 1e-2, Dimension::LENGTH),
    ("mm", 1e-3, Dimension::LENGTH),
    ("um", 1e-6, Dimension::LENGTH),
    ("µm", 1e-6, Dimension::LENGTH),
    ("nm", 1e-9, Dimension::LENGTH),
    ("kg", 1.0, Dimension::MASS),
    ("g", 1e-3, Dimension::MASS),
    ("mg", 1e-6, Dimension::MASS),
    ("s", 1.0, Dimension::TIME),
    ("ms", 1e-3, Dimension::TIME),
    ("us", 1e-6, Dimension::TIME),
    ("µs", 1e-6, Dimension::TIME),
    ("ns", 1e-9, Dimension::TIME),
    ("min", 60.0, Dimension::TIME),
    ("h", 3600.0, Dimension::TIME),
    ("Hz", 1.0, Dimension::FREQUENCY),
    ("kHz", 1e3, Dimension::FREQUENCY),
    ("N", 1.0, Dimension::FORCE),
    ("mN", 1e-3, Dimension::FORCE),
    ("kN", 1e3, Dimension::FORCE),
    ("Pa", 1.0, Dimension::PRESSURE),
    ("mPa", 1e-3, Dimension::PRESSURE),
    ("kPa", 1e3, Dimension::PRESSURE),
    ("MPa", 1e6, Dimension::PRESSURE),
    ("GPa", 1e9, Dimension::PRESSURE),
    ("bar", 1e5, Dimension::PRESSURE),
    ("cP", 1e-3, Dimension::VISCOSITY),
    ("L", 1e-3, Dimension::VOLUME),
    ("ml", 1e-6, Dimension::VOLUME),
    ("1", 1.0, Dimension::NONE),
    ("%", 1e-2, Dimension::NONE),
    ("rad", 1.0, Dimension::NONE),
    ("deg", std::f64::consts::PI / 180.0, Dimension::NONE),
    ("°", std::f64::consts::PI / 180.0, Dimension::NONE),
];

/// Why a quantity could not be read.
#[derive(Clone, Debug, PartialEq)]
pub enum UnitError {
    /// No number at the start.
    NoNumber,
    /// The unit is not known; the nearest known one, if any.
    Unknown(String, Option<&'static str>),
    /// An exponent is malformed.
    Exponent(String),
}

/// Reads `"2.5 mm"`, `"1e-3 Pa s"`, `"8900 kg/m^3"`: the value in SI and its
/// dimension. A text without a unit gives [`Dimension::NONE`] and `false`.
///
/// # Errors
/// [`UnitError`] says which part could not be understood.
pub fn parse(text: &str) -> Result<(f64, Dimension, bool), UnitError> {
    let text = text.trim();
    let split = number_end(text);
    let value: f64 = text[..split].trim().parse().map_err(|_| UnitError::NoNumber)?;
    let unit = text[split..].trim();
    if unit.is_empty() {
        return Ok((value, Dimension::NONE, false));
    }
    let (mut factor, mut dimension) = (1.0, Dimension::NONE);
    let mut sign = 1;
    let mut rest = unit;
    while !rest.is_empty() {
        let end = rest.find([' ', '*', '·', '/']).unwrap_or(rest.len());
        let token = &rest[..end];
        if !token.is_empty() {
            let (f, d, half) = power(token)?;
            let half = sign * half;
            factor *= f.powf(f64::from(half) / 2.0);
            dimension = dimension.add(d, half);
        }
        let Some(mark) = rest[end..].chars().next() else { break };
        // Each solidus divides the one factor that follows it.
        sign = match mark {
            '/' => -1,
            ' ' if token.is_empty() => sign,
            _ => 1,
        };
        rest = &rest[end + mark.len_utf8()..];
    }
    Ok((value * factor, dimension, true))
}

/// Where the leading number ends. `1e-3 m` is a number and a unit; the `e`
/// belongs to the number only if digits follow.
fn number_end(text: &str) -> usize {
    let b = text.as_bytes();
    let mut k = 0;
    let digits = |k: &mut usize| {
        while *k < b.len() && (b[*k].is_ascii_digit() || b[*k] == b'.' || b[*k] == b'_') {
            *k += 1;
        }
    };
    if k < b.len() && (b[k] == b'+' || b[k] == b'-') {
        k += 1;
    }
    digits(&mut k);
    if k < b.len() && (b[k] | 32) == b'e' {
        let mut e = k + 1;
        if e < b.len() && (b[e] == b'+' || b[e] == b'-') {
            e += 1;
        }
        if e < b.len() && b[e].is_ascii_digit() {
            k = e;
            digits(&mut k);
        }
    }
    k
}

/// A unit with an optional exponent: factor, dimension, twice the exponent.
fn power(token: &str) -> Result<(f64, Dimension, i8), UnitError> {
    let bad = || UnitError::Exponent(token.to_string());
    let (name, half) = match token.split_once('^') {
        Some((name, e)) => {
            let x: f64 = e.trim_matches(['(', ')']).parse().map_err(|_| bad())?;
            let half = x * 2.0;
            if half.fract() != 0.0 || half.abs() > 12.0 {
                return Err(bad());
            }
            (name, half as i8)
        }
        None => match token.char_indices().next_back() {
            Some((k, '²')) => (&token[..k], 4),
            Some((k, '³')) => (&token[..k], 6),
            Some((k, c)) if k > 0 && ('2'..='4').contains(&c) => (&token[..k], 2 * (c as i8 - b'0' as i8)),
            _ => (token, 2),
        },
    };
    let (_, f, d) = UNITS.iter().find(|(n, ..)| *n == name).ok_or_else(|| {
        UnitError::Unknown(name.to_string(), crate::menu::nearest(name, UNITS.iter().map(|u| u.0)))
    })?;
    Ok((*f, *d, half))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(text: &str) -> (f64, Dimension) {
        let (v, d, _) = parse(text).unwrap();
        (v, d)
    }

    #[test]
    fn reads_what_people_write() {
        assert_eq!(si("2.5 mm"), (2.5e-3, Dimension::LENGTH));
        assert_eq!(si("2.5mm"), (2.5e-3, Dimension::LENGTH));
        assert_eq!(si("1e-3 Pa s"), (1e-3, Dimension::VISCOSITY));
        assert_eq!(si("8900 kg/m^3"), (8900.0, Dimension::DENSITY));
        assert_eq!(si("8900 kg/m³"), (8900.0, Dimension::DENSITY));
        assert_eq!(si("9.81 m/s2"), (9.81, Dimension::ACCELERATION));
        assert_eq!(si("-3 m"), (-3.0, Dimension::LENGTH));
        assert_eq!(si("1.168e10 N/m^1.5"), (1.168e10, Dimension::HERTZ_STIFFNESS));
        assert_eq!(si("15 Hz"), (15.0, Dimension::FREQUENCY));
        assert_eq!(parse("3.5").unwrap(), (3.5, Dimension::NONE, false));
        assert!((si("180 deg").0 - std::f64::consts::PI).abs() < 1e-15);
    }

    #[test]
    fn refuses_with_a_reason() {
        assert_eq!(parse("mm"), Err(UnitError::NoNumber));
        assert_eq!(parse("3 mmm"), Err(UnitError::Unknown("mmm".into(), Some("mm"))));
        assert!(matches!(parse("3 m^x"), Err(UnitError::Exponent(_))));
        assert_ne!(si("1 kg^6 GPa^6 bar^6 mm^6").1, Dimension::NONE);
        assert_eq!(parse(""), Err(UnitError::NoNumber));
    }

    #[test]
    fn prints_a_unit_that_reads_back() {
        for d in [Dimension::DENSITY, Dimension::HERTZ_STIFFNESS, Dimension::VOLUME, Dimension::VISCOSITY] {
            assert_eq!(si(&format!("1 {d}")), (1.0, d));
        }
    }
}
