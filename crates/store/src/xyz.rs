//! Grains as extended XYZ: one growing file that OVITO and ASE read.
//!
//! Format: the extended XYZ specification (key=value comment line with
//! `Lattice` and `Properties`).

use crate::{Appender, GrainFrame, StoreError};
use brazilnut_base::Side;
use std::fmt::Write as _;
use std::path::Path;

/// An XYZ file under construction.
#[derive(Debug)]
pub struct Xyz {
    out: Appender,
    text: String,
}

impl Xyz {
    /// A new, empty file; what was there before is dropped.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn create(path: &Path) -> Result<Self, StoreError> {
        Ok(Self { out: Appender::create(path)?, text: String::new() })
    }

    /// The file of an earlier part of the run, cut back to `length` bytes.
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
        let _ = push(&mut self.text, frame);
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

fn push(text: &mut String, frame: &GrainFrame<'_>) -> std::fmt::Result {
    let size = frame.cell.size;
    let periodic = |axis: usize| if frame.cell.sides[axis] == Side::Periodic { "T" } else { "F" };
    let turning = !frame.angular_velocity.is_empty();
    let omega = if turning { ":angular_velocity:R:3" } else { "" };
    writeln!(text, "{}", frame.position.len())?;
    writeln!(
        text,
        "Lattice=\"{:?} 0 0 0 {:?} 0 0 0 {:?}\" Origin=\"0 0 0\" pbc=\"{} {} {}\" \
         Properties=species:S:1:id:I:1:pos:R:3:velo:R:3:radius:R:1{omega} Time={:?} Step={}",
        size.x,
        size.y,
        size.z,
        periodic(0),
        periodic(1),
        periodic(2),
        frame.time,
        frame.step
    )?;
    for k in 0..frame.position.len() {
        let (r, v) = (frame.position[k], frame.velocity[k]);
        word(text, frame.species_names.get(frame.species[k] as usize).map_or("?", String::as_str));
        write!(text, " {} {:?} {:?} {:?} {:?} {:?} {:?}", frame.id[k], r.x, r.y, r.z, v.x, v.y, v.z)?;
        write!(text, " {:?}", frame.radius[k])?;
        if turning {
            let w = frame.angular_velocity[k];
            write!(text, " {:?} {:?} {:?}", w.x, w.y, w.z)?;
        }
        text.push('\n');
    }
    Ok(())
}

/// A name as one word: columns are separated by spaces.
fn word(text: &mut String, name: &str) {
    if name.is_empty() {
        text.push('?');
    }
    text.extend(name.chars().map(|c| if c.is_whitespace() || c == '"' { '_' } else { c }));
}
