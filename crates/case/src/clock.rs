//! How the time of a case is cut into steps.

use crate::build::Facts;
use crate::issue::Issues;
use brazilnut_base::schedule::Every;
use brazilnut_base::values::Values;
use brazilnut_fluid::FluidSpec;
use brazilnut_sim::clock::Clock;

/// Shortest and longest step or cycle that means anything, s.
const TIMES: std::ops::Range<f64> = 1e-18..1e9;

/// Most steps of a cycle or a run: beyond it counting them loses meaning.
const MOST_STEPS: f64 = 1e15;

/// The steps of the run; without them an issue says why.
pub(crate) fn clock(
    v: &Values,
    facts: &Facts,
    flow: Option<&FluidSpec>,
    issues: &mut Issues,
) -> Option<Clock> {
    let t = v.table_opt("time")?;
    if flow.is_none() && !TIMES.contains(&facts.contact_time) {
        return refuse(v, issues, format!("the shortest contact lasts {:.3e} s", facts.contact_time));
    }
    let grain = facts.contact_time / t.number("steps_per_contact");
    let auto = flow.map_or(grain, |f| crate::fluid::largest_step(f, facts.flow_speed));
    let (step, exact) = match (t.number_opt("dt"), flow) {
        (Some(dt), None) => {
            // A contact seen less often than this gains energy (Clément 2.1.3 asks for ten).
            if dt > facts.contact_time / 5.0 {
                issues.add(
                    t.span("dt"),
                    "the time step is too long for the contacts",
                    format!(
                        "the shortest contact lasts {:.3e} s: {:.1} steps",
                        facts.contact_time,
                        facts.contact_time / dt
                    ),
                    format!("leave `dt` out, or take at most {:.2e} s", facts.contact_time / 10.0),
                );
                return None;
            }
            (dt, true)
        }
        (Some(dt), Some(f)) if f.adaptive => (dt, true),
        (Some(dt), Some(f)) => {
            let limits = brazilnut_fluid::step_limits(f, facts.flow_speed);
            if let Some((name, limit)) =
                limits.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).filter(|l| dt > l.1)
            {
                issues.add(
                    t.span("dt"),
                    "the time step is too long for the fluid",
                    format!("the {name} limit is {limit:.3e} s at {:.3} m/s", facts.flow_speed),
                    format!("leave `dt` out, or take at most {limit:.2e} s"),
                );
                return None;
            }
            (dt, true)
        }
        (None, _) => (auto, false),
    };
    let frequency = facts.shake.map(|s| s.1);
    let grain = if flow.is_some() { grain } else { step };
    let cycle = frequency.map_or(step, |f| 1.0 / f);
    if !TIMES.contains(&step) || !TIMES.contains(&cycle) || cycle / step > MOST_STEPS {
        return refuse(v, issues, format!("steps of {step:.3e} s in cycles of {cycle:.3e} s"));
    }
    let mut clock = Clock::new(step, grain, frequency, exact);
    if v.table_opt(v.text("model")).is_some_and(|m| m.table_opt("lubrication").is_some()) {
        // A film sees velocities at the end of a grain step, half of whose acceleration they do not keep.
        clock.substeps = clock.substeps.max(2);
    }
    clock.end = match t.every_opt("end")? {
        Every::Cycles(n) => clock.steps_per_cycle?.saturating_mul(n),
        Every::Time(end) => (end / clock.dt).round().max(1.0) as u64,
        Every::Steps(n) => n,
        Every::PerCycle(_) | Every::End => return None,
    };
    if clock.end as f64 > MOST_STEPS {
        return refuse(v, issues, format!("the run has {:.1e} steps", clock.end as f64));
    }
    Some(clock)
}

/// Says that there are no steps, unless what is known already says it better.
fn refuse(v: &Values, issues: &mut Issues, cause: String) -> Option<Clock> {
    if issues.is_empty() {
        let span = v.table_opt("time").and_then(|t| t.span.clone()).or_else(|| v.span("model"));
        let remedy = "check stiffness, sizes, densities and frequency";
        issues.add(span, "time cannot be cut into steps", cause, remedy);
    }
    None
}
