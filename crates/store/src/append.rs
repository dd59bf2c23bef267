//! A file that only grows: its length is part of a checkpoint, and a resumed
//! run cuts it back to that length before it goes on.

use crate::StoreError;
use crate::error::At;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// An open file that is written at its end only.
#[derive(Debug)]
pub struct Appender {
    path: PathBuf,
    file: File,
    length: u64,
}

impl Appender {
    /// A new, empty file; what was there before is dropped.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn create(path: &Path) -> Result<Self, StoreError> {
        // In append mode a failed write, cut off again, leaves no hole behind it.
        let file = OpenOptions::new().append(true).create(true).open(path).at(path, "create")?;
        if file.metadata().at(path, "inspect")?.len() > 0 {
            file.set_len(0).at(path, "empty")?;
        }
        Ok(Self { path: path.to_path_buf(), file, length: 0 })
    }

    /// An existing file, cut back to `length` bytes.
    ///
    /// # Errors
    /// If it cannot be opened or is shorter than `length`.
    pub fn resume(path: &Path, length: u64) -> Result<Self, StoreError> {
        let file = OpenOptions::new().append(true).open(path).at(path, "open")?;
        let found = file.metadata().at(path, "inspect")?.len();
        if found < length {
            let why = format!("it holds {found} bytes, but the checkpoint was made after {length}");
            return Err(StoreError::content(path, "continue", why));
        }
        file.set_len(length).at(path, "cut back")?;
        Ok(Self { path: path.to_path_buf(), file, length })
    }

    /// Appends `bytes`, all of them or none.
    ///
    /// # Errors
    /// If they cannot be written; a part that got through is cut off again.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), StoreError> {
        let written = self.file.write_all(bytes);
        if written.is_err() {
            // Best effort: the error that matters is the first.
            let _ = self.file.set_len(self.length);
        }
        written.at(&self.path, "write")?;
        self.length += bytes.len() as u64;
        Ok(())
    }

    /// Bytes written so far: what a checkpoint must remember.
    #[must_use]
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Brings everything written so far onto the disk; call it before a checkpoint.
    ///
    /// # Errors
    /// If the disk says no.
    pub fn sync(&self) -> Result<(), StoreError> {
        self.file.sync_data().at(&self.path, "sync")
    }

    /// The file's path.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn resumes_where_the_checkpoint_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let mut a = Appender::create(&path).unwrap();
        a.append(b"one ").unwrap();
        let at = a.length();
        a.append(b"lost").unwrap();
        drop(a);
        let mut a = Appender::resume(&path, at).unwrap();
        a.append(b"two").unwrap();
        a.sync().unwrap();
        assert_eq!((fs::read(&path).unwrap().as_slice(), a.length()), (&b"one two"[..], 7));
        let error = Appender::resume(&path, 8).unwrap_err();
        assert!(error.to_string().contains("7 bytes, but the checkpoint was made after 8"), "{error}");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_full_disk_is_an_error_with_a_remedy() {
        // /dev/full refuses every write as a full disk does.
        let mut a = Appender::create(Path::new("/dev/full")).unwrap();
        let error = a.append(b"row").unwrap_err();
        assert!(error.is_disk_full(), "{error}");
        assert_eq!(a.length(), 0);
    }
}
