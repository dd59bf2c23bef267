//! Flows known in closed form, to measure the solver against.

pub mod channel;
pub mod manufactured;
pub mod stokes_layer;
pub mod taylor_green;
