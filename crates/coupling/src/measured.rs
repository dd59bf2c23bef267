//! What a run has measured of its coupling.

use crate::resolved::leak;
use crate::spec::{CouplingSpec, Method};
use crate::state::CouplingState;

/// Numbers by name, and what they warn of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// Name and value.
    pub numbers: Vec<(&'static str, f64)>,
    /// What may surprise.
    pub warnings: Vec<String>,
}

impl Measured {
    /// Of a run with the rung `spec` that stands at `state`.
    #[must_use]
    pub fn of(spec: &CouplingSpec, state: &CouplingState) -> Self {
        let mut m = Self::default();
        match spec {
            CouplingSpec::Dry | CouplingSpec::SimpleDrag(_) => return m,
            CouplingSpec::Averaged(_) => {
                m.numbers.push(("least porosity mapped", state.averaged.least_porosity));
                m.numbers.push(("faces at the porosity floor", state.averaged.floored as f64));
            }
            CouplingSpec::Resolved(r) => {
                let leak = state.leak.mean();
                m.numbers.push(("leak, mean slip over mean speed", leak));
                if leak > leak::WARNING {
                    m.warnings.push(format!(
                        "the grains leak: fluid passes through them at {:.0} % of their own speed in the mean; a shorter step, a shorter `relaxation_time` or more points per radius hold it better",
                        100.0 * leak
                    ));
                }
                if let Method::Template = r.method {
                    m.numbers.push(("force by stress against force by momentum", state.check.ratio()));
                }
            }
        }
        let force = state.exchange.on_fluid.length();
        let residual = if force > 0.0 { state.exchange.residual().length() / force } else { 0.0 };
        m.numbers.push(("force lost between fluid and grains, last step", residual));
        m
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::resolved::sweep::Tally;
    use crate::resolved::{Forcing, Layout};
    use crate::spec::Resolved;
    use crate::transfer::KernelName;

    #[test]
    fn a_leak_is_measured_and_warned_of() {
        let spec = CouplingSpec::Resolved(Resolved {
            method: Method::Forcing(Forcing { sweeps: 3 }),
            kernel: KernelName::Trilinear,
            layout: Layout::Shells,
            retraction: 0.4,
            lubrication: None,
            density: 1000.0,
            viscosity: 1e-3,
            body: Body::Sphere,
        });
        let mut state = CouplingState::default();
        let after = |state: &mut CouplingState, slip: f64| {
            state.leak.book(&Tally { slip, speed: 1.0, ..Tally::default() });
            Measured::of(&spec, state)
        };
        let tight = after(&mut state, 0.0625);
        assert_eq!(tight.numbers[0].1, 0.0625);
        assert!(tight.warnings.is_empty());
        let open = after(&mut state, 0.4375);
        assert_eq!(open.numbers[0].1, 0.25);
        assert_eq!(open.warnings.len(), 1);
    }
}
