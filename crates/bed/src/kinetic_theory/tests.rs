use super::*;

/// Lan's acrylic spheres at hold-up `m_t` and boundary velocity `v_b`.
fn lan(m_t: f64, v_b: f64) -> KineticTheorySpec {
    KineticTheorySpec {
        gravity: 9.81,
        diameter: 0.1,
        hold_up: m_t,
        cell_height: None,
        floor_velocity: v_b * (0.1f64 * 9.81).sqrt(),
        restitution: 0.9,
        floor_restitution: 0.9,
        densest: 0.74,
        tolerance: 1e-9,
        points: 400,
    }
}

fn near(value: f64, expected: f64, relative: f64) {
    assert!((value / expected - 1.0).abs() <= relative, "{value} instead of {expected} ± {relative}");
}

/// Values recomputed by an independent solver, W at floor and top, ν at the floor, largest ν and its height in d.
#[test]
fn agrees_with_an_independent_solution() {
    for (m_t, v_b, expected) in [
        (1.0, 2.0, [3.06, 2.03, 0.077, 0.080, 2.6]),
        (2.5, 2.0, [2.62, 0.69, 0.172, 0.301, 5.9]),
        (5.0, 2.0, [2.47, 0.26, 0.257, 0.574, 7.6]),
        (5.0, 5.0, [6.00, 0.35, 0.094, 0.501, 12.4]),
    ] {
        let k = solve(&lan(m_t, v_b)).unwrap();
        let found = [
            k.floor().w,
            k.top.w,
            k.floor().solids_fraction,
            k.densest.solids_fraction,
            k.densest.height / 0.1,
        ];
        for (a, b) in found.into_iter().zip(expected) {
            // Same equations, its own conductivity and dissipation: they differ by factors of order (1+e)/2 = 0.95.
            near(a, b, 0.05);
        }
        assert_eq!(k.capped, 0.0);
    }
    let cold = solve(&lan(5.0, 0.25)).unwrap();
    near(cold.floor().w, 0.335, 0.05);
    near(cold.top.w, 0.095, 0.05);
    near(cold.floor().solids_fraction, 0.69, 0.05);
    assert!(cold.capped > 0.5, "the equation of state reaches close packing: {}", cold.capped);
}

/// Lan 4.1.1, 4.1.2: a shallow layer is flat; a deep one is densest inside; the floor is the hottest place.
#[test]
fn has_the_shapes_that_lan_describes() {
    let shallow = solve(&lan(1.0, 2.0)).unwrap();
    assert!(shallow.floor().solids_fraction > 0.95 * shallow.densest.solids_fraction);
    for (m_t, v_b) in [(2.5, 2.0), (5.0, 2.0), (5.0, 5.0)] {
        let k = solve(&lan(m_t, v_b)).unwrap();
        assert!(k.densest.solids_fraction > 1.5 * k.floor().solids_fraction);
        assert!(k.layers.windows(2).all(|w| w[1].temperature < w[0].temperature));
    }
}

#[test]
fn no_layer_is_denser_than_the_densest() {
    for (m_t, v_b) in [(1.0, 2.0), (2.5, 2.0), (5.0, 5.0)] {
        let k = solve(&lan(m_t, v_b)).unwrap();
        let most = k.layers.iter().map(|l| l.solids_fraction).fold(0.0, f64::max);
        // Four hundred layers lie within a thousandth of it.
        assert!(most <= k.densest.solids_fraction && most > 0.999 * k.densest.solids_fraction);
    }
}

#[test]
fn mass_and_energy_add_up() {
    let k = solve(&lan(5.0, 2.0)).unwrap();
    let d = k.spec.diameter;
    let mass: f64 = k
        .layers
        .windows(2)
        .map(|w| 0.5 * (w[0].solids_fraction + w[1].solids_fraction) * (w[1].height - w[0].height) / d)
        .sum();
    // A thousandth of the hold-up is above the last layer; the trapezoids of 400 layers add 1e-4.
    near(mass, 0.999 * 5.0, 2e-4);
    let lost: f64 = k
        .layers
        .windows(2)
        .map(|w| {
            let gamma =
                |l: &Layer| closure::dissipation(l.solids_fraction, 0.9) * l.temperature.powf(1.5) / d;
            0.5 * (gamma(&w[0]) + gamma(&w[1])) * (w[1].height - w[0].height)
        })
        .sum();
    near(lost, k.floor().flux, 2e-3);
    let v2 = k.spec.floor_velocity.powi(2);
    let given = closure::floor_flux_over_pressure(k.floor().temperature, v2, 0.9) * 9.81 * d * 5.0;
    near(given, k.floor().flux, 1e-6);
}

/// Elastic grains over an inelastic floor: no flux, hence T = V² (1+e_w)/(1−e_w) everywhere.
#[test]
fn elastic_grains_are_isothermal() {
    let k = solve(&KineticTheorySpec { restitution: 1.0, floor_restitution: 0.8, ..lan(2.5, 2.0) }).unwrap();
    let expected = k.spec.floor_velocity.powi(2) * 9.0;
    for l in &k.layers {
        near(l.temperature, expected, 1e-6);
        assert!(l.flux.abs() < 1e-9);
    }
}

/// V → 0: the packed layer comes to rest. Its weight m_t outgrows what it dissipates, of order V³,
/// so that the flux from the floor must vanish by itself: T = V² (1+e_w)/(1−e_w) there.
#[test]
fn a_floor_that_hardly_moves_leaves_a_packed_cold_layer() {
    for v_b in [1e-2, 1e-3, 1e-4] {
        let k = solve(&lan(2.5, v_b)).unwrap();
        println!("{} {}", k.floor().w / v_b, k.layers.last().unwrap().height / 0.1);
        near(k.floor().w, v_b * 19f64.sqrt(), 20.0 * v_b);
        let top = k.layers.last().unwrap().height / 0.1;
        // A thousandth is above the last layer; what is loose has a scale height of T/g.
        near(top, 0.999 * 2.5 / 0.74, v_b);
    }
}

#[test]
fn does_not_depend_on_the_tolerance() {
    let at = |tolerance| solve(&KineticTheorySpec { tolerance, ..lan(5.0, 2.0) }).unwrap();
    let (coarse, fine) = (at(1e-8), at(1e-11));
    // Six digits are promised.
    near(coarse.floor().w, fine.floor().w, 1e-6);
    near(coarse.top.w, fine.top.w, 1e-6);
    near(coarse.densest.solids_fraction, fine.densest.solids_fraction, 1e-6);
    near(coarse.densest.height, fine.densest.height, 1e-6);
}

/// Where the theory needs its cap, the result hangs on it: W at the floor by a quarter.
#[test]
fn the_densest_packing_matters_only_where_it_is_reached() {
    let at = |m_t, v_b, densest| solve(&KineticTheorySpec { densest, ..lan(m_t, v_b) }).unwrap();
    // The same equations; the search for ν starts elsewhere.
    near(at(2.5, 2.0, 0.64).floor().w, at(2.5, 2.0, 0.74).floor().w, 1e-12);
    let (loose, dense) = (at(5.0, 0.25, 0.64), at(5.0, 0.25, 0.74));
    assert_eq!((loose.densest.solids_fraction, dense.densest.solids_fraction), (0.64, 0.74));
    let ratio = loose.floor().w / dense.floor().w;
    assert!(ratio > 1.2 && ratio < 1.3, "{ratio}");
}

#[test]
fn bad_input_is_refused_with_the_reason() {
    let keys = |s: KineticTheorySpec| -> Vec<&str> { solve(&s).unwrap_err().iter().map(|r| r.0).collect() };
    assert_eq!(keys(lan(0.0, 2.0)), ["hold_up"]);
    assert_eq!(keys(lan(2.5, 0.0)), ["floor_velocity"]);
    assert_eq!(keys(KineticTheorySpec { cell_height: Some(0.5), ..lan(5.0, 2.0) }), ["hold_up"]);
    assert_eq!(
        keys(KineticTheorySpec { restitution: 1.0, floor_restitution: 1.0, ..lan(5.0, 2.0) }),
        ["restitution"]
    );
    assert_eq!(
        keys(KineticTheorySpec { restitution: 1.1, densest: 1.0, ..lan(5.0, 2.0) }),
        ["densest", "restitution"]
    );
}

#[test]
fn a_case_gives_hold_up_and_floor_velocity() {
    let system = System {
        shake: brazilnut_base::motion::Motion::vertical(0.01, 50.0),
        gravity: 9.81,
        grain_diameter: Some(0.1),
        solids_height: Some(0.5),
        restitution: Some(0.9),
        ..System::default()
    };
    let spec = KineticTheorySpec::from_values(&Values::default(), &system).unwrap();
    near(spec.hold_up, 5.0, 1e-15);
    // Lan eq. 4-1-2: V = v0/√2.
    near(spec.floor_velocity, TAU * 50.0 * 0.01 / 2f64.sqrt(), 1e-14);
    assert_eq!(spec.floor_restitution, 0.9);
    let report = solve(&spec).unwrap().report();
    assert_eq!((report.figures.len(), report.tables[0].1.rows.len()), (2, 400));
}
