//! What every bed equation of the menu must satisfy.

use super::{BedEquation, Medium};

const WATER: Medium = Medium { porosity: 0.42, diameter: 7e-4, density: 1000.0, viscosity: 1e-3 };

/// The superficial velocity at which `m` has the particle Reynolds number `re`.
fn velocity(re: f64, m: &Medium) -> f64 {
    re * m.viscosity / (m.density * m.diameter)
}

/// Reynolds numbers 0.01 to 1000, ten per decade.
fn decades() -> impl Iterator<Item = f64> {
    (0..=50).map(|k| 10f64.powf(-2.0 + 0.1 * f64::from(k)))
}

#[test]
fn drives_the_fluid_the_way_it_flows_and_alike_both_ways() {
    for e in BedEquation::ALL {
        for phi in [0.3, 0.42, 0.6, 0.8, 0.95] {
            let m = Medium { porosity: phi, ..WATER };
            for re in decades() {
                let v = velocity(re, &m);
                assert!(e.gradient(v, &m) > 0.0, "{} at φ {phi}, Re {re}", e.name());
                assert_eq!(e.gradient(-v, &m), -e.gradient(v, &m), "{}", e.name());
            }
        }
    }
}

#[test]
fn becomes_linear_at_rest_and_without_density() {
    for e in BedEquation::ALL {
        let at_rest = e.coefficient(0.0, &WATER);
        assert!(at_rest.is_finite() && at_rest > 0.0, "{}", e.name());
        // The slowest approach is 2·0.63/4.8·√Re = 2.6e-5 at Re 1e-8 (Wen-Yu, Di Felice).
        let slow = e.coefficient(velocity(1e-8, &WATER), &WATER);
        assert!((slow / at_rest - 1.0).abs() < 3e-5, "{}", e.name());
        let massless = Medium { density: 0.0, ..WATER };
        assert_eq!(e.coefficient(0.1, &massless), e.coefficient(0.0, &massless), "{}", e.name());
        let nothing = Medium { viscosity: 0.0, ..massless };
        assert_eq!(e.gradient(0.1, &nothing), 0.0, "{}", e.name());
    }
}

#[test]
fn grows_with_speed_and_with_crowding() {
    for e in BedEquation::ALL {
        let values: Vec<f64> = decades().map(|re| e.gradient(velocity(re, &WATER), &WATER)).collect();
        assert!(values.windows(2).all(|w| w[1] > w[0]), "{}", e.name());
        for re in decades() {
            let at = |phi| e.gradient(velocity(re, &WATER), &Medium { porosity: phi, ..WATER });
            assert!(
                (30..95).all(|k| at(f64::from(k) / 100.0) > at(f64::from(k + 1) / 100.0)),
                "{}",
                e.name()
            );
        }
    }
}

/// No equation of the menu has a declared jump: each is one formula over all
/// speeds and porosities. (Ergun below φ 0.8 joined to Wen-Yu above would have one.)
#[test]
fn has_no_jump_in_speed_or_porosity() {
    for e in BedEquation::ALL {
        for re in decades() {
            let v = velocity(re, &WATER);
            for phi in [0.3, 0.5, 0.7999, 0.8, 0.8001, 0.95] {
                let k = |dv: f64, dphi: f64| {
                    e.coefficient(v * (1.0 + dv), &Medium { porosity: phi + dphi, ..WATER })
                };
                // Logarithmic slopes are below 1 in speed and 25 in porosity.
                assert!((k(1e-9, 0.0) / k(0.0, 0.0) - 1.0).abs() < 1e-8, "{}", e.name());
                assert!((k(0.0, 1e-9) / k(0.0, 0.0) - 1.0).abs() < 1e-7, "{}", e.name());
            }
        }
    }
}

/// Recomputed values at φ 0.42, Re 0.01, in units of η V0/d²; printed to three digits.
#[test]
fn slow_flow_through_a_random_packing() {
    let v = velocity(0.01, &WATER);
    let unit = WATER.viscosity * v / (WATER.diameter * WATER.diameter);
    let value = |e: BedEquation| e.gradient(v, &WATER) / unit;
    for (e, expected) in
        [(BedEquation::Ergun, 681.0), (BedEquation::DiFelice, 606.0), (BedEquation::WenYu, 581.0)]
    {
        assert!((value(e) - expected).abs() < 0.6, "{}: {}", e.name(), value(e));
    }
    let limit = |e: BedEquation| e.coefficient(0.0, &WATER) * v / unit;
    assert!((limit(BedEquation::DiFelice) - 591.0).abs() < 0.6);
    assert!((limit(BedEquation::WenYu) - 566.0).abs() < 0.6);
}

/// Least and largest ratio of two equations over Re 0.01 to 1000 and the given porosities.
fn ratios(a: BedEquation, b: BedEquation, porosities: &[f64]) -> (f64, f64) {
    let mut range = (f64::INFINITY, 0.0_f64);
    for &porosity in porosities {
        let m = Medium { porosity, ..WATER };
        for re in decades() {
            let v = velocity(re, &m);
            let r = a.gradient(v, &m) / b.gradient(v, &m);
            range = (range.0.min(r), range.1.max(r));
        }
    }
    range
}

/// Measured, not postulated: the ranges stated at [`super::DiFelice`], to their last digit.
#[test]
fn di_felice_is_near_ergun_when_dense_and_near_wen_yu_when_dilute() {
    let (low, high) = ratios(BedEquation::DiFelice, BedEquation::Ergun, &[0.40, 0.42, 0.45, 0.50]);
    assert!((low - 0.71).abs() < 0.005 && (high - 0.99).abs() < 0.005, "{low} {high}");
    let (low, high) = ratios(BedEquation::DiFelice, BedEquation::WenYu, &[0.80, 0.85, 0.90, 0.95, 0.99]);
    assert!((low - 0.87).abs() < 0.005 && (high - 1.01).abs() < 0.005, "{low} {high}");
}
