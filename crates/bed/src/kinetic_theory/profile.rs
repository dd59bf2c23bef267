//! Temperature and solids fraction over the mass above, by shooting.

use super::KineticTheorySpec;
use super::closure::{conductivity, dissipation, floor_flux_over_pressure, solids_fraction};
use crate::ode::{Accuracy, Ending, Step, fall_between, integrate};
use crate::system::Refusals;

/// One height in the layer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Layer {
    /// Height over the floor, m.
    pub height: f64,
    /// Hold-up above this height.
    pub hold_up_above: f64,
    /// Solids fraction ν.
    pub solids_fraction: f64,
    /// Granular temperature T, m²/s².
    pub temperature: f64,
    /// W = √(T/(d g)) (Lan eq. 4-1-4).
    pub w: f64,
    /// Upward energy flux over density of the grains, m³/s³.
    pub flux: f64,
}

/// A vibrated layer in its steady state.
#[derive(Clone, Debug, PartialEq)]
pub struct KineticTheory {
    /// What was solved.
    pub spec: KineticTheorySpec,
    /// From the floor up at equal distances, to where a thousandth of the hold-up remains above.
    pub layers: Vec<Layer>,
    /// The top of the layer, where pressure and flux vanish: only its temperature is finite.
    pub top: Layer,
    /// Where the layer is densest.
    pub densest: Layer,
    /// Part of the hold-up in which the equation of state asked for more than the densest packing.
    pub capped: f64,
}

/// Hold-up above the first point of the profile, over the whole: the layer itself has no end.
const FIRST: f64 = 1e-6;
/// Hold-up above the highest layer that is shown, over the whole.
const SHOWN: f64 = 1e-3;

/// Finds the temperature at the top for which the flux from the floor is what the layer dissipates.
///
/// Lengths are in d, temperatures in d g, pressure in ρ_s d g: P = ξ, the
/// hold-up above. Then dθ/dξ = q/(κ ν) and dq/dξ = γ/ν.
///
/// # Errors
/// The refusals of [`KineticTheorySpec::validate`].
pub fn solve(spec: &KineticTheorySpec) -> Result<KineticTheory, Refusals> {
    spec.validate()?;
    let gas = Gas::new(spec);
    let excess = |ln_top: f64| {
        let [theta, q] = gas.shoot(ln_top.exp());
        spec.hold_up * floor_flux_over_pressure(theta, gas.v2, spec.floor_restitution) - q
    };
    let ln_v2 = gas.v2.ln();
    let (mut low, mut high) = (ln_v2 - 1.0, ln_v2);
    while excess(low) < 0.0 && low > ln_v2 - 600.0 {
        low -= (high - low).min(20.0);
    }
    while excess(high) >= 0.0 && high < ln_v2 + 600.0 {
        high += (high - low).min(20.0);
    }
    let (at_low, at_high) = (excess(low), excess(high));
    if !(at_low >= 0.0 && at_high < 0.0) {
        return Err(vec![(
            "hold_up",
            format!("of {} admits no steady state at this floor velocity and restitution", spec.hold_up),
        )]);
    }
    let ln_top = fall_between(excess, low, at_low, high, at_high);
    Ok(gas.profile(ln_top.exp()))
}

/// The layer without dimensions.
struct Gas<'a> {
    spec: &'a KineticTheorySpec,
    /// V²/(d g).
    v2: f64,
}

impl<'a> Gas<'a> {
    fn new(spec: &'a KineticTheorySpec) -> Self {
        Self { spec, v2: spec.floor_velocity * spec.floor_velocity / (spec.diameter * spec.gravity) }
    }

    fn solids(&self, xi: f64, theta: f64) -> f64 {
        solids_fraction(xi / theta, self.spec.restitution, self.spec.densest)
    }

    /// dθ/dξ and dq/dξ; at the top both vanish, q/(κν) as ξ.
    fn slopes(&self, xi: f64, theta: f64, q: f64) -> [f64; 2] {
        if xi <= 0.0 {
            return [0.0; 2];
        }
        let (nu, theta) = (self.solids(xi, theta), theta.max(f64::MIN_POSITIVE));
        [
            q / (conductivity(nu) * theta.sqrt() * nu),
            dissipation(nu, self.spec.restitution) * theta.powf(1.5) / nu,
        ]
    }

    fn accuracy<const N: usize>(&self, top: f64) -> Accuracy<N> {
        let tolerance = self.spec.tolerance;
        let mut absolute = [tolerance; N];
        absolute[0] = tolerance * top;
        absolute[1] = tolerance * top.powf(1.5) * 1e-3;
        Accuracy { relative: tolerance, absolute, longest: 0.05 * self.spec.hold_up }
    }

    /// θ and q at the floor for a temperature at the top.
    fn shoot(&self, top: f64) -> [f64; 2] {
        let slope = |xi: f64, y: &[f64; 2]| self.slopes(xi, y[0], y[1]);
        match integrate(slope, |_, _| [1.0], 0.0, [top, 0.0], self.spec.hold_up, &self.accuracy(top), |_| ())
        {
            Ending::Reached(y) => y,
            // A temperature that runs away dissipates more than any floor gives.
            Ending::Stuck(_) | Ending::Event { .. } => [f64::MAX, f64::MAX],
        }
    }

    /// The profile under a known top, on equal heights.
    fn profile(&self, top: f64) -> KineticTheory {
        let m = self.spec.hold_up;
        let start = FIRST * m;
        let slope = |xi: f64, y: &[f64; 3]| {
            let [dt, dq] = self.slopes(xi, y[0], y[1]);
            [dt, dq, 1.0 / self.solids(xi, y[0])]
        };
        let mut steps: Vec<Step<3>> = vec![];
        // q = ∫γ/ν: the integrand is proportional to ξ so near the top.
        let q = 0.5 * start * self.slopes(start, top, 0.0)[1];
        let end =
            integrate(slope, |_, _| [1.0], start, [top, q, 0.0], m, &self.accuracy(top), |s| steps.push(*s));
        let depth = match end {
            Ending::Reached(y) => y[2],
            _ => f64::NAN,
        };
        let layer = |xi: f64, y: &[f64; 3]| self.layer(xi, y, depth);
        let first = steps.partition_point(|s| s.end < SHOWN * m).min(steps.len() - 1);
        let shown = depth - steps[first].at(SHOWN * m)[2];
        let n = self.spec.points.max(2);
        let layers: Vec<Layer> = (0..n)
            .map(|k| {
                let below_top = depth - shown * f64::from(k) / f64::from(n - 1);
                let at = steps.partition_point(|s| s.at(s.end)[2] < below_top).min(steps.len() - 1);
                let s = &steps[at];
                let off = |xi: f64| below_top - s.at(xi)[2];
                let xi = fall_between(off, s.start, off(s.start).max(0.0), s.end, off(s.end).min(-0.0));
                layer(xi, &s.at(xi))
            })
            .collect();
        let (xi, y) = self.densest(&steps);
        let densest = layer(xi, &y);
        let in_cap = |s: &&Step<3>| self.solids(s.end, s.at(s.end)[0]) >= self.spec.densest;
        let capped = steps.iter().filter(in_cap).fold(0.0, |sum, s| sum + (s.end - s.start)) / m;
        KineticTheory { spec: self.spec.clone(), layers, top: layer(start, &[top, q, 0.0]), densest, capped }
    }

    /// Where ν is largest: ξ/θ is, hence where θ − ξ dθ/dξ falls through zero; else at the floor.
    fn densest(&self, steps: &[Step<3>]) -> (f64, [f64; 3]) {
        for s in steps {
            let rise = |xi: f64| {
                let y = s.at(xi);
                y[0] - xi * self.slopes(xi, y[0], y[1])[0]
            };
            if rise(s.end) < 0.0 {
                let xi = fall_between(rise, s.start, rise(s.start).max(0.0), s.end, rise(s.end));
                return (xi, s.at(xi));
            }
        }
        let last = steps[steps.len() - 1];
        (last.end, last.at(last.end))
    }

    /// Back to SI.
    fn layer(&self, xi: f64, y: &[f64; 3], depth: f64) -> Layer {
        let (d, dg) = (self.spec.diameter, self.spec.diameter * self.spec.gravity);
        Layer {
            height: d * (depth - y[2]),
            hold_up_above: xi,
            solids_fraction: self.solids(xi, y[0]),
            temperature: dg * y[0],
            w: y[0].sqrt(),
            flux: dg.powf(1.5) * y[1],
        }
    }
}

impl KineticTheory {
    /// The layer at the floor.
    #[must_use]
    pub fn floor(&self) -> Layer {
        self.layers[0]
    }

    /// Mass-weighted mean temperature, m²/s².
    #[must_use]
    pub fn mean_temperature(&self) -> f64 {
        let part = |w: &[Layer]| {
            (w[0].hold_up_above - w[1].hold_up_above, 0.5 * (w[0].temperature + w[1].temperature))
        };
        let (mass, sum) =
            self.layers.windows(2).map(part).fold((0.0, 0.0), |s, (m, t)| (s.0 + m, s.1 + m * t));
        sum / mass
    }
}
