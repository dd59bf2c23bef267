//! The bed as a whole, sample by sample.

use super::{Faults, Observe, Selection, Setting};
use crate::height;
use crate::view::{Needs, Partner, View};
use crate::zones::Body as Shape;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table, Vec3};
use serde::{Deserialize, Serialize};

/// Height, gap, centre of mass, energy and contacts of the bed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bed {
    of: Selection,
    percentile: f64,
    threshold: f64,
    layer: f64,
}

impl Observe for Bed {
    const ENTRY: Entry = Entry {
        name: "bed",
        summary: "The bed as a whole: two heights, gap under it, centre of mass, kinetic energy, contacts, largest overlap.",
        formula: "height_lid: height above the floor (m) below which lie the tops z + r of a fraction `percentile` of the mass\n\
                  height_threshold: highest place (m) where the solids fraction of slabs of thickness `layer` crosses `threshold`, linear between slab centres\n\
                  bulk_solids_fraction = volume of the grains/(area of the base x height_threshold) (1)\n\
                  gap: min(z - r) above the floor (m); gap_percentile: height below which lie the lower edges of 1 - `percentile` of the mass (m)\n\
                  centre_of_mass = sum(m r)/sum(m), z above the floor (m)\n\
                  kinetic_energy = sum(m v^2)/2, rotational_energy = sum(I w^2)/2 (J), in the frame of the cell\n\
                  contacts: touching pairs, walls included; coordination = 2 pairs of grains/grains\n\
                  overlap: largest overlap over the radius of the smaller grain",
        source: "Clément 2009, 3.2.1 (gap); Lan 1994, 4.2 (height from the solids fraction, bulk solids fraction)",
    };

    const KEYS: &'static [Key] = &[
        Key::default(
            "percentile",
            Kind::Quantity(Dimension::NONE),
            "0.95",
            "Fraction of the mass under the lid.",
        )
        .with(Check::Inside(0.5, 1.0)),
        Key::default(
            "threshold",
            Kind::Quantity(Dimension::NONE),
            "0.3",
            "Solids fraction at which the bed is said to end.",
        )
        .with(Check::Inside(0.0, 1.0)),
        Key::optional(
            "layer",
            Kind::Quantity(Dimension::LENGTH),
            "Thickness of the slabs of the solids fraction; one mean diameter if left out.",
        )
        .with(Check::Positive),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        Ok(Self {
            of: Selection::read(values, setting)?,
            percentile: values.number("percentile"),
            threshold: values.number("threshold"),
            layer: values.number_opt("layer").unwrap_or(setting.mean_diameter),
        })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: true, flow: false }
    }

    fn columns(&self) -> Vec<Column> {
        [
            ("height_lid", "m"),
            ("height_threshold", "m"),
            ("bulk_solids_fraction", "1"),
            ("gap", "m"),
            ("gap_percentile", "m"),
            ("centre_of_mass_x", "m"),
            ("centre_of_mass_y", "m"),
            ("centre_of_mass_z", "m"),
            ("kinetic_energy", "J"),
            ("rotational_energy", "J"),
            ("contacts", "1"),
            ("coordination", "1"),
            ("overlap", "1"),
        ]
        .map(|(n, u)| Column::new(n, u))
        .to_vec()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        let (mut mass, mut moment, mut kinetic, mut spin, mut gap) =
            (0.0, Vec3::ZERO, 0.0, 0.0, f64::INFINITY);
        let (body, mut volume) = (Shape::of(view.cell), 0.0);
        for k in (0..g.len()).filter(|&k| self.of.takes(g, k)) {
            mass += g.mass[k];
            volume += body.volume(g.radius[k]);
            moment += g.mass[k] * g.position[k];
            kinetic += 0.5 * g.mass[k] * g.velocity[k].length_squared();
            spin += 0.5 * g.inertia[k] * g.angular_velocity[k].length_squared();
            gap = gap.min(g.position[k].z - g.radius[k]);
        }
        let floor = view.floor_height();
        let centre = moment / mass - Vec3::Z * floor;
        let touch = self.touches(view);
        let height = height::by_solids_fraction(view, self.of, self.threshold, self.layer);
        Some(vec![
            height::lid(view, self.of, self.percentile),
            height,
            volume / (view.cell.base_area() * height),
            gap - floor,
            height::lower_edge(view, self.of, 1.0 - self.percentile),
            centre.x,
            centre.y,
            centre.z,
            kinetic,
            spin,
            touch.contacts,
            touch.coordination,
            touch.overlap,
        ])
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let over = |names: &[(&str, &str)]| -> Vec<Curve> {
            names
                .iter()
                .filter_map(|(column, label)| Some(Curve::line(*label, pairs(series, column)?)))
                .collect()
        };
        let time = Axis::linear("time", "s");
        let figure = |title: &str, caption: String, y: Axis, curves: Vec<Curve>| Figure {
            title: title.into(),
            caption,
            body: Body::Curves { x: time.clone(), y, curves },
        };
        vec![
            figure(
                "Height of the bed",
                format!(
                    "Lid: {:.0} % of the mass has its top below. Threshold: the solids fraction of slabs {:.3e} m thick crosses {}. \
                     Heights and the centre of mass are measured from the floor.",
                    100.0 * self.percentile,
                    self.layer,
                    self.threshold
                ),
                Axis::linear("height", "m"),
                over(&[
                    ("height_lid", "lid"),
                    ("height_threshold", "threshold"),
                    ("centre_of_mass_z", "centre of mass"),
                    ("gap", "gap under the bed"),
                ]),
            ),
            figure(
                "Kinetic energy",
                "Kinetic energy of the grains in the frame of the cell.".into(),
                Axis::linear("energy", "J"),
                over(&[("kinetic_energy", "translation"), ("rotational_energy", "rotation")]),
            ),
            figure(
                "Contacts per grain",
                "Coordination: twice the touching pairs of grains over the number of grains.".into(),
                Axis::linear("coordination", "1"),
                over(&[("coordination", "coordination")]),
            ),
            figure(
                "Largest overlap",
                "Largest overlap over the radius of the smaller grain, at the sampled instants.".into(),
                Axis::linear("overlap over radius", "1"),
                over(&[("overlap", "overlap")]),
            ),
        ]
    }
}

/// What the contact list says about the bed.
struct Touch {
    contacts: f64,
    coordination: f64,
    overlap: f64,
}

impl Bed {
    fn touches(&self, view: &View) -> Touch {
        let g = view.grains;
        let (mut contacts, mut ends, mut overlap) = (0.0, 0.0, 0.0_f64);
        for c in view.contacts {
            let (i, mut r) = (c.i as usize, g.radius[c.i as usize]);
            let mut mine = u32::from(self.of.takes(g, i));
            if let Partner::Grain(j) = c.with {
                r = r.min(g.radius[j as usize]);
                mine += u32::from(self.of.takes(g, j as usize));
                ends += f64::from(mine);
            }
            if mine > 0 {
                contacts += 1.0;
                overlap = overlap.max(c.overlap / r);
            }
        }
        let n = (0..g.len()).filter(|&k| self.of.takes(g, k)).count();
        Touch { contacts, coordination: ends / n as f64, overlap }
    }
}

/// Points (time, column) of a series.
pub(crate) fn pairs(series: &Table, column: &str) -> Option<Vec<[f64; 2]>> {
    let (t, y) = (series.column("time")?, series.column(column)?);
    Some(t.into_iter().zip(y).map(|(t, y)| [t, y]).collect())
}
