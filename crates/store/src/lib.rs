//! Files: checkpoints, tables, ParaView and OVITO output, the lock of a run
//! directory. Knows bytes and no physics.
//!
//! Every write either succeeds or is a [`StoreError`]: no failure is logged and
//! forgotten. Whole files are replaced atomically; growing files report their
//! length, so that a resumed run cuts them back to its checkpoint and goes on.

pub mod append;
pub mod atomic;
pub mod checkpoint;
pub mod dump;
pub mod error;
pub mod frame;
pub mod lock;
pub mod series;
pub mod table;
pub mod vtk;
pub mod xyz;

pub use append::Appender;
pub use checkpoint::{Header, Limits, Loaded, Refused};
pub use error::{Cause, StoreError};
pub use frame::{Array, Data, GrainFrame};
pub use lock::Lock;
pub use series::Series;
pub use table::TableFile;
