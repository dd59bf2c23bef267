//! What every part of brazilnut speaks: vectors, the cell, units, menus and
//! keys, schedules, prescribed motion, records and the address of a blow-up.
//! No physics lives here.
//!
//! All quantities are SI and `f64`. The vertical axis is z.

pub mod clock;
pub mod domain;
pub mod figure;
pub mod health;
pub mod keys;
pub mod menu;
pub mod motion;
pub mod parallel;
pub mod plane;
pub mod portable;
pub mod random;
pub mod record;
pub mod schedule;
pub mod units;
pub mod values;

pub use clock::Tick;
pub use domain::{Cell, Side};
pub use glam::{DMat3 as Mat3, DQuat as Quat, DVec3 as Vec3, I64Vec3, dvec3 as vec3};
pub use health::Blowup;
pub use plane::PlaneField;
pub use record::{Column, Table};
