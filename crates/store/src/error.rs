//! What went wrong with which file.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A file operation that did not succeed.
#[derive(Debug)]
pub struct StoreError {
    /// The file or folder.
    pub path: PathBuf,
    /// What was being done, after "could not": `write`, `read`, `lock`.
    pub doing: &'static str,
    /// Why it failed.
    pub cause: Cause,
}

/// Why a file operation failed.
#[derive(Debug)]
pub enum Cause {
    /// The operating system said no.
    Io(io::Error),
    /// The content is not what it should be.
    Content(String),
    /// Another process holds the run directory.
    Locked(String),
}

impl StoreError {
    /// The operating system refused `doing` on `path`.
    pub fn io(path: &Path, doing: &'static str, cause: io::Error) -> Self {
        Self { path: path.to_path_buf(), doing, cause: Cause::Io(cause) }
    }

    /// The content of `path` is not what `doing` needs.
    pub fn content(path: &Path, doing: &'static str, why: impl Into<String>) -> Self {
        Self { path: path.to_path_buf(), doing, cause: Cause::Content(why.into()) }
    }

    /// True if there was no room left to write.
    #[must_use]
    pub fn is_disk_full(&self) -> bool {
        use io::ErrorKind::{QuotaExceeded, StorageFull};
        matches!(&self.cause, Cause::Io(e) if matches!(e.kind(), StorageFull | QuotaExceeded))
    }
}

impl fmt::Display for StoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "could not {} {}: {}", self.doing, self.path.display(), self.cause)?;
        if self.is_disk_full() {
            f.write_str("\n  remedy: free some space, then resume from the last checkpoint")?;
        }
        Ok(())
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(e) => e.fmt(f),
            Self::Content(why) | Self::Locked(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for StoreError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.cause {
            Cause::Io(e) => Some(e),
            Cause::Content(_) | Cause::Locked(_) => None,
        }
    }
}

/// Adds path and deed to an [`io::Result`].
pub(crate) trait At<T> {
    fn at(self, path: &Path, doing: &'static str) -> Result<T, StoreError>;
}

impl<T> At<T> for io::Result<T> {
    fn at(self, path: &Path, doing: &'static str) -> Result<T, StoreError> {
        self.map_err(|e| StoreError::io(path, doing, e))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_as_a_sentence() {
        let e = StoreError::io(Path::new("a/b.csv"), "write", io::ErrorKind::StorageFull.into());
        let text = e.to_string();
        assert!(text.starts_with("could not write a/b.csv: "), "{text}");
        assert!(text.contains("remedy: free some space"), "{text}");
        assert!(e.is_disk_full());
    }
}
