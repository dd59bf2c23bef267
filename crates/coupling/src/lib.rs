//! What grains and fluid hand each other.

pub mod body;
pub mod one_way;
pub mod still;
pub mod transfer;

pub use body::Body;
pub use one_way::SimpleDrag;
pub use still::Still;
