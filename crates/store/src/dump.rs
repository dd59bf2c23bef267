//! Grains for OVITO: the text dump of LAMMPS, all frames in one growing file.
//!
//! Format: LAMMPS documentation, "dump custom".

use crate::{Appender, GrainFrame, StoreError};
use brazilnut_base::Side;
use std::fmt::Write as _;
use std::path::Path;

/// A dump under construction.
#[derive(Debug)]
pub struct Dump {
    out: Appender,
    text: String,
}

impl Dump {
    /// A new, empty dump; what was there before is dropped.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn create(path: &Path) -> Result<Self, StoreError> {
        Ok(Self { out: Appender::create(path)?, text: String::new() })
    }

    /// The dump of an earlier part of the run, cut back to `length` bytes.
    ///
    /// # Errors
    /// If it is missing or too short.
    pub fn resume(path: &Path, length: u64) -> Result<Self, StoreError> {
        Ok(Self { out: Appender::resume(path, length)?, text: String::new() })
    }

    /// Appends a frame, at once and whole.
    ///
    /// # Errors
    /// If it cannot be written or an array has the wrong length.
    pub fn append(&mut self, frame: &GrainFrame<'_>) -> Result<(), StoreError> {
        frame.check().map_err(|why| StoreError::content(self.out.path(), "write", why))?;
        self.text.clear();
        // Writing to a String cannot fail.
        let _ = push(&mut self.text, frame, self.out.length() == 0);
        self.out.append(self.text.as_bytes())
    }

    /// Bytes written so far: what a checkpoint must remember.
    #[must_use]
    pub fn length(&self) -> u64 {
        self.out.length()
    }

    /// Brings everything written so far onto the disk; call it before a checkpoint.
    ///
    /// # Errors
    /// If the disk says no.
    pub fn sync(&self) -> Result<(), StoreError> {
        self.out.sync()
    }
}

fn push(text: &mut String, frame: &GrainFrame<'_>, first: bool) -> std::fmt::Result {
    let n = frame.position.len();
    if first {
        // Once per file: before every frame it would keep OVITO from finding the second.
        writeln!(text, "ITEM: UNITS\nsi")?;
    }
    writeln!(text, "ITEM: TIME\n{:?}\nITEM: TIMESTEP\n{}", frame.time, frame.step)?;
    writeln!(text, "ITEM: NUMBER OF ATOMS\n{n}")?;
    let flag = |axis: usize| if frame.cell.sides[axis] == Side::Periodic { "pp" } else { "ff" };
    writeln!(text, "ITEM: BOX BOUNDS {} {} {}", flag(0), flag(1), flag(2))?;
    for axis in 0..3 {
        writeln!(text, "0.0 {:?}", frame.cell.size[axis])?;
    }
    let turning = !frame.angular_velocity.is_empty();
    let omega = if turning { " omegax omegay omegaz" } else { "" };
    writeln!(text, "ITEM: ATOMS id type x y z vx vy vz radius{omega}")?;
    for k in 0..n {
        // Types count from one there; the id stays that of every other output.
        let (r, v) = (frame.position[k], frame.velocity[k]);
        write!(text, "{} {}", frame.id[k], frame.species[k] + 1)?;
        write!(text, " {:?} {:?} {:?} {:?} {:?} {:?} {:?}", r.x, r.y, r.z, v.x, v.y, v.z, frame.radius[k])?;
        if turning {
            let w = frame.angular_velocity[k];
            write!(text, " {:?} {:?} {:?}", w.x, w.y, w.z)?;
        }
        text.push('\n');
    }
    Ok(())
}
