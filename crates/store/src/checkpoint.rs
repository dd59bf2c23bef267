//! Checkpoints: one file each, compressed, hashed, described in
//! `docs/checkpoint-format.md` so that other programs can read them.
//!
//! A state is anything serde can serialise; it comes back bit for bit,
//! negative zeros and the payload of NaNs included.

mod format;

pub use format::{Header, Limits, VERSION, decode, encode, inspect};

use crate::error::At;
use crate::{StoreError, atomic};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::path::{Path, PathBuf};

/// A state read back.
#[derive(Debug)]
pub struct Loaded<T> {
    /// The state.
    pub state: T,
    /// What the file says about it.
    pub header: Header,
    /// Where it was found.
    pub path: PathBuf,
    /// Newer checkpoints that could not be used, newest first.
    pub refused: Vec<Refused>,
}

/// A checkpoint that could not be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The file.
    pub path: PathBuf,
    /// Why, as a sentence without a stop.
    pub reason: String,
}

/// Name of the checkpoint of `step`: twelve digits sort in any file browser.
#[must_use]
pub fn file_name(step: u64) -> String {
    format!("step-{step:012}.checkpoint")
}

/// Writes the checkpoint of `header.step` into `folder` (made if missing) and
/// then removes all but the `keep` newest of those up to this step. Checkpoints
/// of later steps, which a run that went back may have left, stay.
///
/// # Errors
/// If it cannot be written; every earlier checkpoint is then still there.
pub fn save<T: Serialize>(
    folder: &Path,
    header: &Header,
    state: &T,
    keep: usize,
) -> Result<PathBuf, StoreError> {
    atomic::make_folder(folder)?;
    let path = folder.join(file_name(header.step));
    let bytes = encode(header, state).map_err(|why| StoreError::content(&path, "write", why))?;
    atomic::write(&path, &bytes)?;
    let mut old: Vec<(u64, PathBuf)> = list(folder)?.into_iter().filter(|(s, _)| *s <= header.step).collect();
    old.truncate(old.len().saturating_sub(keep.max(1)));
    for path in old.into_iter().map(|(_, path)| path).chain(leftovers(folder)?) {
        fs::remove_file(&path).at(&path, "remove")?;
    }
    Ok(path)
}

/// Temporary files of checkpoints that a killed process was writing.
fn leftovers(folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
    let ours = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(".step-") && name.ends_with(".checkpoint.tmp") && path.is_file()
    };
    let paths = fs::read_dir(folder).at(folder, "read")?.map(|e| e.map(|e| e.path()).at(folder, "read"));
    paths.filter(|p| p.as_ref().map_or(true, ours)).collect()
}

/// Reads one checkpoint.
///
/// # Errors
/// If it cannot be read or is not whole; the reason is a sentence for a person.
pub fn load<T: DeserializeOwned>(path: &Path, limits: Limits) -> Result<(Header, T), StoreError> {
    let length = fs::metadata(path).at(path, "read")?.len();
    if length > limits.file {
        let why = format!("its {length} bytes exceed the limit of {}", limits.file);
        return Err(StoreError::content(path, "read", why));
    }
    let bytes = fs::read(path).at(path, "read")?;
    decode(&bytes, limits).map_err(|why| StoreError::content(path, "read", why))
}

/// Reads the newest whole checkpoint of `folder`.
///
/// # Errors
/// If there is none; the error lists why each was refused.
pub fn load_latest<T: DeserializeOwned>(folder: &Path, limits: Limits) -> Result<Loaded<T>, StoreError> {
    let mut refused = vec![];
    for (_, path) in list(folder)?.into_iter().rev() {
        match load(&path, limits) {
            Ok((header, state)) => return Ok(Loaded { state, header, path, refused }),
            Err(error) => refused.push(Refused { path, reason: error.cause.to_string() }),
        }
    }
    let why = if refused.is_empty() {
        "there is no checkpoint in it".to_string()
    } else {
        let lines = refused.iter().map(|r| {
            format!("\n  {}: {}", r.path.file_name().unwrap_or_default().to_string_lossy(), r.reason)
        });
        format!("none of its checkpoints is whole{}", lines.collect::<String>())
    };
    Err(StoreError::content(folder, "resume from", why))
}

/// Step and path of every checkpoint in `folder`, oldest step first; none if there is no folder.
///
/// # Errors
/// If the folder cannot be read.
pub fn list(folder: &Path) -> Result<Vec<(u64, PathBuf)>, StoreError> {
    if !folder.exists() {
        return Ok(vec![]);
    }
    let mut found = vec![];
    for entry in fs::read_dir(folder).at(folder, "read")? {
        let path = entry.at(folder, "read")?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let step = name.strip_prefix("step-").and_then(|n| n.strip_suffix(".checkpoint"));
        if let Some(step) = step.and_then(|s| s.parse().ok()) {
            found.push((step, path));
        }
    }
    found.sort();
    Ok(found)
}
