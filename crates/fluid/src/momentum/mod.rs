//! The momentum equation without its new pressure.

pub(crate) mod advection;
pub(crate) mod implicit;
pub(crate) mod predict;
pub(crate) mod rates;
