//! Figures and tables of a vibrated layer.

use super::{KineticTheory, Layer, closure};
use crate::system::Report;
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};

impl KineticTheory {
    /// W(Y) and ν(Y), and the tables `profile` and `summary`.
    #[must_use]
    pub fn report(&self) -> Report {
        let d = self.spec.diameter;
        let note = if self.capped > 0.0 {
            format!(
                " In {:.0} % of the hold-up the equation of state asks for more than the densest packing {}; there it is held at that packing.",
                100.0 * self.capped,
                self.spec.densest
            )
        } else {
            String::new()
        };
        let figure = |title: &str, axis: Axis, value: fn(&Layer) -> f64| Figure {
            title: title.into(),
            caption: format!(
                "Hold-up {}, floor velocity V_b {:.4}.{note}",
                self.spec.hold_up,
                self.spec.boundary_velocity()
            ),
            body: Body::Curves {
                x: Axis::linear("height over diameter", "1"),
                y: axis,
                curves: vec![Curve::line(
                    "kinetic theory",
                    self.layers.iter().map(|l| [l.height / d, value(l)]).collect(),
                )],
            },
        };
        Report {
            figures: vec![
                figure("Granular temperature", Axis::linear("W", "1"), |l| l.w),
                figure("Solids fraction", Axis::linear("solids fraction", "1"), |l| l.solids_fraction),
            ],
            tables: vec![("profile".into(), self.profile_table()), ("summary".into(), self.summary())],
        }
    }

    fn profile_table(&self) -> Table {
        let (d, e) = (self.spec.diameter, self.spec.restitution);
        let mut table = Table::new(&[
            ("height", "m"),
            ("height_over_diameter", "1"),
            ("hold_up_above", "1"),
            ("solids_fraction", "1"),
            ("granular_temperature", "m^2/s^2"),
            ("w", "1"),
            ("self_diffusion", "m^2/s"),
            ("collision_rate", "Hz"),
        ]);
        let row = |l: &Layer| {
            let (t, nu) = (l.temperature, l.solids_fraction);
            vec![
                l.height,
                l.height / d,
                l.hold_up_above,
                nu,
                t,
                l.w,
                closure::self_diffusion(d, t, nu, e),
                closure::collision_rate(d, t, nu),
            ]
        };
        table.rows = self.layers.iter().map(row).collect();
        table
    }

    fn summary(&self) -> Table {
        let mut table = Table::new(&[
            ("hold_up", "1"),
            ("boundary_velocity", "1"),
            ("floor_w", "1"),
            ("top_w", "1"),
            ("floor_solids_fraction", "1"),
            ("largest_solids_fraction", "1"),
            ("densest_height_over_diameter", "1"),
            ("mean_temperature", "m^2/s^2"),
            ("capped_hold_up_fraction", "1"),
        ]);
        table.rows.push(vec![
            self.spec.hold_up,
            self.spec.boundary_velocity(),
            self.floor().w,
            self.top.w,
            self.floor().solids_fraction,
            self.densest.solids_fraction,
            self.densest.height / self.spec.diameter,
            self.mean_temperature(),
            self.capped,
        ]);
        table
    }
}
