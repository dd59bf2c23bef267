//! The flow for ParaView.

use brazilnut_base::{Cell, Vec3};
use brazilnut_observe::FlowView;
use brazilnut_store::vtk::{self, FieldFrame};
use brazilnut_store::{Array, StoreError};
use std::path::Path;

/// Writes velocity, pressure and porosity at the centres of the grid cells; in
/// two dimensions also streamfunction and vorticity at their corners.
///
/// # Errors
/// If the file cannot be written.
pub fn write(path: &Path, time: f64, cell: &Cell, flow: &dyn FlowView) -> Result<(), StoreError> {
    let cells = flow.shape();
    let [nx, ny, nz] = cells;
    let centres = || {
        let plane = move |k: usize| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k]));
        (0..nz).flat_map(plane)
    };
    let velocity: Vec<Vec3> = centres().map(|c| flow.cell_velocity(c)).collect();
    let pressure: Vec<f64> = centres().map(|c| flow.pressure(flow.centre(c))).collect();
    let porosity: Vec<f64> = centres().map(|c| flow.porosity(flow.centre(c))).collect();
    let mut cell_data =
        vec![Array::vectors("velocity", "m/s", &velocity), Array::scalars("pressure", "Pa", &pressure)];
    if porosity.iter().any(|&p| p != 1.0) {
        cell_data.push(Array::scalars("porosity", "1", &porosity));
    }
    // Corners on both sides of the flat direction carry the same values.
    let corners = |field: Option<brazilnut_base::PlaneField>| {
        let field = field?;
        let [a, b] = field.axes;
        let plane = move |k: usize| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [i, j, k]));
        Some((0..=nz).flat_map(plane).map(|c| field.at(c[a], c[b])).collect::<Vec<f64>>())
    };
    let (psi, omega) = (corners(flow.streamfunction()), corners(flow.vorticity()));
    let mut point_data = vec![];
    point_data.extend(psi.as_ref().map(|x| Array::scalars("streamfunction", "m^2/s", x)));
    point_data.extend(omega.as_ref().map(|x| Array::scalars("vorticity", "1/s", x)));
    let n = Vec3::new(nx as f64, ny as f64, nz as f64);
    let (origin, spacing) = (Vec3::ZERO, cell.size / n);
    let frame = FieldFrame { time, cells, origin, spacing, cell_data: &cell_data, point_data: &point_data };
    vtk::write_field(path, &frame, vtk::Precision::Single)
}
