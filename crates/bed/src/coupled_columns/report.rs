//! Figures and tables of the coupled columns.

use super::{ColumnSample, CoupledColumns};
use crate::system::Report;
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};

impl CoupledColumns {
    /// Δh(t), and gaps and flows of the first cycle; the tables `heights`, `first_cycle` and `summary`.
    #[must_use]
    pub fn report(&self) -> Report {
        let end = self.emptied.map_or_else(
            || "Both columns still hold grains at the end.".to_string(),
            |t| format!("The shallow column is down to one grain at {t:.2} s."),
        );
        let curve = |label: &str, value: &dyn Fn(&ColumnSample) -> f64| {
            Curve::line(label, self.first_cycle.iter().map(|s| [s.phase, value(s)]).collect())
        };
        let cycle = |title: &str, y: Axis, caption: &str, curves: Vec<Curve>| Figure {
            title: title.into(),
            caption: caption.into(),
            body: Body::Curves { x: Axis::linear("phase", "deg"), y, curves },
        };
        let difference = self.history.iter().map(|m| [m.time, m.h2 - m.h1]).collect();
        Report {
            figures: vec![
                Figure {
                    title: "Height difference".into(),
                    caption: format!("Once a cycle, at Γ = {:.3}. {end}", self.gamma),
                    body: Body::Curves {
                        x: Axis::linear("time", "s"),
                        y: Axis::linear("height difference", "m"),
                        curves: vec![Curve::line("coupled columns", difference)],
                    },
                },
                cycle(
                    "Gaps in the first cycle",
                    Axis::linear("gap", "m"),
                    "Column 2 is the deeper one at the start.",
                    vec![curve("column 1", &|s| s.gap[0]), curve("column 2", &|s| s.gap[1])],
                ),
                cycle(
                    "Flow through the channel",
                    Axis::linear("velocity", "m/s"),
                    "From column 1 to column 2, in the first cycle.",
                    vec![curve("fluid", &|s| s.channel)],
                ),
                cycle(
                    "Pressure under column 1",
                    Axis::linear("pressure", "Pa"),
                    "In the first cycle, hydrostatic part removed.",
                    vec![curve("column 1", &|s| s.pressure)],
                ),
            ],
            tables: vec![
                ("heights".into(), self.heights_table()),
                ("first_cycle".into(), self.cycle_table()),
                ("summary".into(), self.summary()),
            ],
        }
    }

    fn heights_table(&self) -> Table {
        let mut table =
            Table::new(&[("time", "s"), ("height_1", "m"), ("height_2", "m"), ("height_difference", "m")]);
        table.rows = self.history.iter().map(|m| vec![m.time, m.h1, m.h2, m.h2 - m.h1]).collect();
        table
    }

    fn cycle_table(&self) -> Table {
        let mut table = Table::new(&[
            ("phase", "deg"),
            ("gap_1", "m"),
            ("gap_2", "m"),
            ("velocity_1", "m/s"),
            ("velocity_2", "m/s"),
            ("flow_1", "m/s"),
            ("flow_2", "m/s"),
            ("channel_velocity", "m/s"),
            ("pressure", "Pa"),
        ]);
        let row = |s: &ColumnSample| {
            vec![s.phase, s.gap[0], s.gap[1], s.u[0], s.u[1], s.v[0], s.v[1], s.channel, s.pressure]
        };
        table.rows = self.first_cycle.iter().map(row).collect();
        table
    }

    fn summary(&self) -> Table {
        let start = self.history[0];
        let mut table = Table::new(&[
            ("gamma", "1"),
            ("time_to_double_difference", "s"),
            ("emptied", "s"),
            ("final_height_difference", "m"),
            ("first_landing_phase_1", "deg"),
            ("first_landing_phase_2", "deg"),
        ]);
        let last = self.history[self.history.len() - 1];
        let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
        table.rows.push(vec![
            self.gamma,
            or_nan(self.time_to(2.0 * (start.h2 - start.h1))),
            or_nan(self.emptied),
            last.h2 - last.h1,
            or_nan(self.landing_phases[0]),
            or_nan(self.landing_phases[1]),
        ]);
        table
    }
}
