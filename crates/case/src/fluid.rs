//! The fluid of a case, for each rung that has one.

use brazilnut_base::Cell;
use brazilnut_base::values::Values;
use brazilnut_coupling::{Body, SimpleDrag};
use brazilnut_grains::packing::Shape;
use brazilnut_sim::plan::Species;

/// Body of the grains.
#[must_use]
pub fn body(v: &Values, cell: &Cell) -> Body {
    let cylinder = v.tables("grains").any(|g| g.text_opt("shape") == Some("cylinder"));
    Body::of(if cylinder { Shape::Cylinder } else { Shape::Sphere }, cell)
}

/// The rung `simple-drag`.
#[must_use]
pub fn simple_drag(v: &Values, cell: &Cell, species: &[Species]) -> Option<SimpleDrag> {
    let (t, f) = (v.table_opt("simple-drag")?, v.table_opt("fluid")?);
    let diameter = species.iter().map(|s| s.diameter).collect();
    Some(SimpleDrag::read(t, f.number_opt("density")?, f.number_opt("viscosity")?, diameter, body(v, cell)))
}
