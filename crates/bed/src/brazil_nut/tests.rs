use super::*;

fn shaken(gamma: f64) -> Motion {
    Motion::vertical(gamma * 9.81 / (std::f64::consts::TAU * 15.0).powi(2), 15.0)
}

/// Clément 6.5 with Tables 6.1 and 6.2.
fn thesis(gamma: f64, alpha: f64, range: f64) -> BrazilNutSpec {
    BrazilNutSpec {
        shake: shaken(gamma),
        gravity: 9.81,
        height: 26e-3,
        cell_height: Some(43e-3),
        porosity: 0.42,
        diameter: 2e-3,
        grain_density: 2500.0,
        fluid_density: 1000.0,
        viscosity: 1e-3,
        bed_equation: BedEquation::Ergun,
        intruder_diameter: 7e-3,
        intruder_density: 7750.0,
        alpha,
        range,
        drag_factor: 1.0 / (1.0 - 0.42),
        start: 0.0,
        cycles: 600,
        tolerance: 1e-10,
    }
}

const FITS: [(f64, f64, f64); 3] = [(3.5, 9.83e-3, 4.0e-3), (4.0, 1.208e-2, 4.2e-3), (4.5, 1.445e-2, 4.5e-3)];

fn near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected} ± {tolerance}");
}

/// With the published α and l: up at all three Γ, faster for larger Γ, accelerating (Clément Fig. 6.11).
#[test]
fn rises_with_the_published_fits() {
    let rides = FITS.map(|(g, a, l)| solve(&thesis(g, a, l)).unwrap());
    let cycles = rides.each_ref().map(|r| r.cycles_to_surface().unwrap());
    assert!(cycles[0] > cycles[1] && cycles[1] > cycles[2], "{cycles:?}");
    for r in &rides {
        let way = |a: f64, b: f64| r.time_to(b).unwrap() - r.time_to(a).unwrap();
        assert!(way(0.0, 3e-3) > way(3e-3, 6e-3) && way(3e-3, 6e-3) > way(6e-3, 9e-3));
        assert!(r.history.windows(2).all(|w| w[1].gap > w[0].gap - 1e-12));
    }
}

/// The fits lie at the edge of the model: one percent more of α and nothing rises, one percent less
/// and Γ 3.5 takes the hundred cycles that the simulations took.
#[test]
fn the_published_strength_is_critical() {
    for (g, a, l) in FITS {
        assert_eq!(solve(&BrazilNutSpec { cycles: 300, ..thesis(g, 1.01 * a, l) }).unwrap().emerged, None);
    }
    let cycles = |s: f64| solve(&thesis(3.5, s * 9.83e-3, 4e-3)).unwrap().cycles_to_surface().unwrap();
    assert!(cycles(1.0) > 101.0 && cycles(0.985) < 101.0);
}

#[test]
fn without_a_fluid_intruder_and_bed_fly_alike() {
    let dry =
        BrazilNutSpec { fluid_density: 0.0, viscosity: 1e-15, cycles: 20, ..thesis(3.0, 9.83e-3, 4e-3) };
    for alpha in [0.0, 9.83e-3] {
        let r = solve(&BrazilNutSpec { alpha, ..dry.clone() }).unwrap();
        // Twenty flights of a millimetre to 1e-10 each.
        assert_eq!(r.history.len(), 21);
        near(r.history.last().unwrap().gap, 0.0, 1e-11);
    }
}

#[test]
fn an_intruder_like_its_host_stays_where_it_is() {
    // A massless fluid has neither buoyancy nor added mass: the force per mass is that of the bed.
    let like = BrazilNutSpec {
        fluid_density: 0.0,
        intruder_density: 2500.0,
        start: 5e-3,
        cycles: 20,
        ..thesis(3.5, 0.0, 4e-3)
    };
    let history = solve(&like).unwrap().history;
    assert_eq!(history.len(), 21);
    near(history[20].gap, 5e-3, 1e-11);
}

#[test]
fn strong_friction_holds_the_intruder() {
    let held = BrazilNutSpec { start: 5e-3, cycles: 20, ..thesis(3.5, 1.0, 4e-3) };
    near(solve(&held).unwrap().history.last().unwrap().gap, 5e-3, 1e-11);
}

/// α over the immersed weight, recomputed: 0.83, 1.02, 1.21.
#[test]
fn strengths_are_near_the_immersed_weight() {
    for ((g, a, l), ratio) in FITS.into_iter().zip([0.83, 1.02, 1.21]) {
        near(a / thesis(g, a, l).immersed_weight(), ratio, 0.006);
    }
}

/// Landing of the host bed, recomputed: 292.2, 299.2, 304.8 degrees; largest gap 0.845, 0.981, 1.106 mm.
#[test]
fn the_bed_flies_as_a_modified_kroll_plug() {
    for ((g, a, l), (phase, gap)) in
        FITS.into_iter().zip([(292.2, 0.845e-3), (299.2, 0.981e-3), (304.8, 1.106e-3)])
    {
        let r = solve(&BrazilNutSpec { cycles: 1, ..thesis(g, a, l) }).unwrap();
        near(360.0 * r.history[1].time / r.period, phase, 0.06);
        // The flight is sampled eight times a step.
        near(r.first_flight.iter().map(|p| p[1]).fold(0.0, f64::max), gap, 1e-6);
    }
}

#[test]
fn results_do_not_depend_on_the_tolerance() {
    // Ten flights: the critical strength magnifies errors over hundreds.
    let at = |tolerance| {
        let spec = BrazilNutSpec { tolerance, cycles: 10, start: 3e-3, ..thesis(4.5, 1.3e-2, 4.5e-3) };
        solve(&spec).unwrap().history.last().unwrap().gap
    };
    assert!(at(1e-9) > 3.1e-3);
    near(at(1e-9) / at(1e-12), 1.0, 1e-6);
}

#[test]
fn bad_input_is_refused_with_the_reason() {
    let keys = |s: BrazilNutSpec| -> Vec<&str> { solve(&s).unwrap_err().iter().map(|r| r.0).collect() };
    let good = thesis(3.5, 9.83e-3, 4e-3);
    assert_eq!(keys(BrazilNutSpec { range: 0.0, ..good.clone() }), ["range"]);
    assert_eq!(keys(BrazilNutSpec { intruder_density: 900.0, ..good.clone() }), ["intruder_density"]);
    assert_eq!(keys(BrazilNutSpec { height: 6e-3, ..good.clone() }), ["intruder_diameter"]);
    assert_eq!(keys(BrazilNutSpec { porosity: 1.2, ..good.clone() }), ["porosity"]);
    assert_eq!(keys(BrazilNutSpec { shake: Motion::default(), ..good }), ["gamma"]);
}

#[test]
fn the_report_has_its_parts() {
    let report = solve(&thesis(4.5, 1.4e-2, 4.5e-3)).unwrap().report();
    assert_eq!((report.figures.len(), report.tables.len()), (2, 3));
    assert!(report.tables[0].1.rows.len() > 10);
}

#[test]
fn a_case_has_to_give_the_fits() {
    let system = System {
        shake: shaken(3.5),
        gravity: 9.81,
        fluid_density: Some(1000.0),
        viscosity: Some(1e-3),
        grain_density: Some(2500.0),
        grain_diameter: Some(2e-3),
        bed_height: Some(26e-3),
        intruder_density: Some(7750.0),
        intruder_diameter: Some(7e-3),
        ..System::default()
    };
    let missing = BrazilNutSpec::from_values(&Values::default(), &system).unwrap_err();
    assert_eq!(missing.iter().map(|r| r.0).collect::<Vec<_>>(), ["alpha", "range"]);
    let mut table = Values::default();
    table.insert("alpha", brazilnut_base::values::Value::Number(9.83e-3), None);
    table.insert("range", brazilnut_base::values::Value::Number(4e-3), None);
    let spec = BrazilNutSpec::from_values(&table, &system).unwrap();
    assert_eq!(BrazilNutSpec { cell_height: Some(43e-3), ..spec }, thesis(3.5, 9.83e-3, 4e-3));
}
