//! Figures and tables of the Brazil-nut column.

use super::BrazilNut;
use crate::system::Report;
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};

impl BrazilNut {
    /// The intruder's gap over time and the first flight; the tables `rise`, `first_flight` and `summary`.
    #[must_use]
    pub fn report(&self) -> Report {
        let end = match self.cycles_to_surface() {
            Some(n) => format!("Its top is level with the surface after {n} cycles."),
            None => format!("It has not reached the surface after {} cycles.", self.spec.cycles),
        };
        let radius = 0.5 * self.spec.intruder_diameter;
        let flight = |k: usize, less: f64| self.first_flight.iter().map(|p| [p[0], p[k] - less]).collect();
        Report {
            figures: vec![
                Figure {
                    title: "Gap under the intruder".into(),
                    caption: format!("After each landing of the bed, at Γ = {:.3}. {end}", self.gamma),
                    body: Body::Curves {
                        x: Axis::linear("time", "s"),
                        y: Axis::linear("gap", "m"),
                        curves: vec![Curve::line(
                            "Brazil-nut column",
                            self.history.iter().map(|r| [r.time, r.gap]).collect(),
                        )],
                    },
                },
                Figure {
                    title: "First flight".into(),
                    caption:
                        "Bed and intruder over the floor of the cell; the bed's landing ends both flights."
                            .into(),
                    body: Body::Curves {
                        x: Axis::linear("phase", "deg"),
                        y: Axis::linear("height", "m"),
                        curves: vec![
                            Curve::line("gap under the bed", flight(1, 0.0)),
                            Curve::line("rise of the intruder", flight(2, self.spec.start + radius)),
                        ],
                    },
                },
            ],
            tables: vec![
                ("rise".into(), self.rise_table()),
                ("first_flight".into(), self.flight_table()),
                ("summary".into(), self.summary()),
            ],
        }
    }

    fn rise_table(&self) -> Table {
        let mut table = Table::new(&[("time", "s"), ("gap", "m")]);
        table.rows = self.history.iter().map(|r| vec![r.time, r.gap]).collect();
        table
    }

    fn flight_table(&self) -> Table {
        let mut table = Table::new(&[("phase", "deg"), ("bed_gap", "m"), ("intruder_height", "m")]);
        table.rows = self.first_flight.iter().map(|p| p.to_vec()).collect();
        table
    }

    fn summary(&self) -> Table {
        let mut table = Table::new(&[
            ("gamma", "1"),
            ("cycles_to_surface", "1"),
            ("time_to_surface", "s"),
            ("final_gap", "m"),
            ("alpha_over_immersed_weight", "1"),
        ]);
        let last = self.history[self.history.len() - 1];
        table.rows.push(vec![
            self.gamma,
            self.cycles_to_surface().unwrap_or(f64::NAN),
            self.emerged.unwrap_or(f64::NAN),
            last.gap,
            self.spec.alpha / self.spec.immersed_weight(),
        ]);
        table
    }
}
