//! Energy of a flow and where it goes.

use super::{Faults, Observe, Setting};
use crate::view::{Needs, View};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Budget of the kinetic energy, and how well volume is conserved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlowEnergy {}

impl Observe for FlowEnergy {
    const ENTRY: Entry = Entry {
        name: "flow-energy",
        summary: "Kinetic energy of the fluid, its gains and losses, and the divergence.",
        formula: "kinetic_energy = sum rho v²/2 (J); dissipation = rho nu sum (grad v)² (W); power_of_walls: of moving walls, \
                  power_of_body: of gravity and frame along periodic directions (W); dE/dt = walls + body - dissipation\n\
                  divergence = max |div v| (1/s); courant = max dt sum |v_i|/h_i\n\
                  the budget is known in closed and periodic cells without obstacles and grains",
        source: "",
    };

    const KEYS: &'static [Key] = &[];

    fn from_values(_: &Values, _: &Setting) -> Result<Self, Faults> {
        Ok(Self {})
    }

    fn needs(&self) -> Needs {
        Needs { contacts: false, flow: true }
    }

    fn columns(&self) -> Vec<Column> {
        [
            ("kinetic_energy", "J"),
            ("dissipation", "W"),
            ("power_of_walls", "W"),
            ("power_of_body", "W"),
            ("divergence", "1/s"),
            ("courant", "1"),
        ]
        .map(|(n, u)| Column::new(n, u))
        .to_vec()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let flow = view.fluid.and_then(|f| f.flow)?;
        let b = flow.balance(view.tick.dt);
        Some(vec![b.kinetic, b.dissipation, b.walls, b.body, b.divergence, b.courant])
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curve =
            |column: &str, label: &str| super::bed::pairs(series, column).map(|p| Curve::line(label, p));
        let figure = |title: &str, caption: &str, y: Axis, curves: Vec<Option<Curve>>| Figure {
            title: title.into(),
            caption: caption.into(),
            body: Body::Curves {
                x: Axis::linear("time", "s"),
                y,
                curves: curves.into_iter().flatten().collect(),
            },
        };
        vec![
            figure(
                "Kinetic energy of the fluid",
                "Over the whole cell.",
                Axis::linear("kinetic energy", "J"),
                vec![curve("kinetic_energy", "fluid")],
            ),
            figure(
                "Power",
                "What moving walls and body forces put in, and what viscosity takes out.",
                Axis::linear("power", "W"),
                vec![
                    curve("power_of_walls", "walls"),
                    curve("power_of_body", "body force"),
                    curve("dissipation", "dissipation"),
                ],
            ),
        ]
    }
}
