//! Figures and tables of a plug.

use super::{Plug, Sample};
use crate::system::Report;
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};

impl Plug {
    /// Gap and base pressure against phase, and the tables `phase`, `flights` and `peaks`.
    #[must_use]
    pub fn report(&self) -> Report {
        let samples = self.samples();
        let repeats = match (self.flights.is_empty(), self.multiplicity) {
            (true, _) => "The bed is never thrown.".to_string(),
            (_, Some(1)) => format!("The motion repeats itself every cycle, from cycle {}.", self.transient),
            (_, Some(n)) => {
                format!("The motion repeats itself every {n} cycles, from cycle {}.", self.transient)
            }
            (_, None) => {
                format!("No period was found within {} cycles; the last ones are shown.", self.spec.cycles)
            }
        };
        let curve = |label: &str, value: fn(&Sample) -> f64| {
            Curve::line(label, samples.iter().map(|s| [s.phase, value(s)]).collect())
        };
        let figure = |title: &str, y: Axis, curves: Vec<Curve>, more: &str| Figure {
            title: title.into(),
            caption: format!("{more}{repeats}"),
            body: Body::Curves { x: Axis::linear("phase", "deg"), y, curves },
        };
        let name = if self.spec.modified { "modified Kroll" } else { "Kroll" };
        let mut pressures = vec![curve(name, |s| s.pressure)];
        if self.spec.modified {
            pressures.push(curve("flow through the bed alone", |s| s.viscous_pressure));
        }
        Report {
            figures: vec![
                figure("Gap under the bed", Axis::linear("gap", "m"), vec![curve(name, |s| s.gap)], ""),
                figure(
                    "Pressure under the bed",
                    Axis::linear("pressure", "Pa"),
                    pressures,
                    "Hydrostatic part removed. ",
                ),
                figure(
                    "Velocity of the bed",
                    Axis::linear("velocity", "m/s"),
                    vec![curve(name, |s| s.velocity)],
                    "Relative to the cell. ",
                ),
            ],
            tables: vec![
                ("phase".into(), phase_table(&samples)),
                ("flights".into(), self.flight_table()),
                ("peaks".into(), self.peak_table()),
            ],
        }
    }

    fn flight_table(&self) -> Table {
        let mut table =
            Table::new(&[("takeoff_phase", "deg"), ("landing_phase", "deg"), ("largest_gap", "m")]);
        table.rows = self.flight_phases().into_iter().map(|(a, b, gap)| vec![a, b, gap]).collect();
        table
    }

    fn peak_table(&self) -> Table {
        let p = &self.peaks;
        let mut table = Table::new(&[
            ("gamma", "1"),
            ("multiplicity", "cycles"),
            ("transient", "cycles"),
            ("largest_gap", "m"),
            ("largest_gap_phase", "deg"),
            ("overpressure", "Pa"),
            ("overpressure_phase", "deg"),
            ("underpressure", "Pa"),
            ("underpressure_phase", "deg"),
            ("viscous_overpressure", "Pa"),
            ("viscous_underpressure", "Pa"),
        ]);
        table.rows.push(vec![
            self.gamma,
            self.multiplicity.map_or(f64::NAN, f64::from),
            f64::from(self.transient),
            p.gap.value,
            p.gap.phase,
            p.over.value,
            p.over.phase,
            p.under.value,
            p.under.phase,
            p.viscous_over.value,
            p.viscous_under.value,
        ]);
        table
    }
}

fn phase_table(samples: &[Sample]) -> Table {
    let mut table = Table::new(&[
        ("phase", "deg"),
        ("gap", "m"),
        ("velocity", "m/s"),
        ("pressure", "Pa"),
        ("viscous_pressure", "Pa"),
    ]);
    table.rows =
        samples.iter().map(|s| vec![s.phase, s.gap, s.velocity, s.pressure, s.viscous_pressure]).collect();
    table
}
