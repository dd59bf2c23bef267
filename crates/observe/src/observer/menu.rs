//! The observers a case may name: a new one costs its file and a line here.

use super::{Faults, Observe, Setting};
use crate::view::{Needs, View};
use brazilnut_base::figure::Figure;
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

macro_rules! observers {
    ($($variant:ident = $module:ident),* $(,)?) => {
        /// Any observer.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[allow(missing_docs, reason = "the entries of the menu say what each is")]
        pub enum Observer {
            $($variant(Box<super::$module::$variant>),)*
        }

        /// Every observer with its definition.
        pub const MENU: &[Entry] = &[$(<super::$module::$variant as Observe>::ENTRY,)*];

        /// Keys of the observer called `what`, beside the common ones.
        #[must_use]
        pub fn keys(what: &str) -> Option<&'static [Key]> {
            $(if what == <super::$module::$variant as Observe>::ENTRY.name {
                return Some(<super::$module::$variant as Observe>::KEYS);
            })*
            None
        }

        impl Observer {
            /// The observer called `what`, from its table.
            ///
            /// # Errors
            /// Everything that is wrong, by key.
            pub fn from_values(what: &str, values: &Values, setting: &Setting) -> Result<Self, Faults> {
                $(if what == <super::$module::$variant as Observe>::ENTRY.name {
                    return super::$module::$variant::from_values(values, setting)
                        .map(|o| Self::$variant(Box::new(o)));
                })*
                Err(vec![("what".into(), format!("no observer is called `{what}`"))])
            }

            /// Its entry in the menu.
            #[must_use]
            pub fn entry(&self) -> Entry {
                match self { $(Self::$variant(_) => <super::$module::$variant as Observe>::ENTRY,)* }
            }

            /// What must be prepared for it.
            #[must_use]
            pub fn needs(&self) -> Needs {
                match self { $(Self::$variant(o) => o.needs(),)* }
            }

            /// Columns of its series; none if it keeps no series.
            #[must_use]
            pub fn columns(&self) -> Vec<Column> {
                match self { $(Self::$variant(o) => o.columns(),)* }
            }

            /// Takes a sample: a row of the series, if there is one.
            pub fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
                match self { $(Self::$variant(o) => o.observe(view),)* }
            }

            /// Means with errors, profiles, fields, spectra.
            #[must_use]
            pub fn results(&self) -> Vec<(String, Table)> {
                match self { $(Self::$variant(o) => o.results(),)* }
            }

            /// Plots for the report.
            #[must_use]
            pub fn figures(&self, series: &Table) -> Vec<Figure> {
                match self { $(Self::$variant(o) => o.figures(series),)* }
            }
        }
    };
}

observers! {
    Bed = bed,
    Energy = energy,
    Convection = convection,
    Trajectory = trajectory,
    Surface = surface,
    Gap = gap,
    Profile = profile,
    Field = field,
    Diffusion = diffusion,
    Rise = rise,
    Walls = walls,
    Collisions = collisions,
    Mixing = mixing,
    Radial = radial,
    Layers = layers,
    BasePressure = base_pressure,
    Flow = flow,
    FlowField = flow_field,
    FlowEnergy = flow_energy,
    Probe = probe,
    Streamfunction = streamfunction,
}
