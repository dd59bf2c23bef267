//! One run, one directory: a lock that the operating system drops when the
//! process ends, however it ends.
//!
//! The file stays behind after a run and means nothing by itself: a crash
//! leaves no lock to be removed by hand.

use crate::error::{At, Cause, StoreError};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};

/// Name of the file in a run directory.
pub const NAME: &str = ".lock";

/// The right to write a run directory, given back when dropped.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    file: File,
}

impl Lock {
    /// Takes the lock of `folder`.
    ///
    /// # Errors
    /// If another process holds it, which is named; or if the file cannot be made.
    pub fn take(folder: &Path) -> Result<Self, StoreError> {
        let path = folder.join(NAME);
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .at(&path, "make the lock")?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let mut holder = String::new();
                // Who holds it is told if it can be read; that it is held is certain.
                let _ = (&mut file).take(200).read_to_string(&mut holder);
                let holder = if holder.trim().is_empty() { "another run" } else { holder.trim() };
                let why = format!("{holder} is writing it; wait for it to end or choose another --out");
                return Err(StoreError {
                    path: folder.to_path_buf(),
                    doing: "lock",
                    cause: Cause::Locked(why),
                });
            }
            Err(TryLockError::Error(e)) => return Err(StoreError::io(&path, "lock", e)),
        }
        let mut lock = Self { path, file };
        lock.sign().at(&lock.path, "write")?;
        Ok(lock)
    }

    /// Writes who holds the lock, for those who wait.
    fn sign(&mut self) -> std::io::Result<()> {
        self.file.set_len(0)?;
        self.file.rewind()?;
        writeln!(self.file, "process {}{}", std::process::id(), on_host())
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Closing would unlock as well; a failure here has no one to be told.
        let _ = self.file.unlock();
    }
}

/// ` on NAME`, where the system tells its name in a file.
fn on_host() -> String {
    match std::fs::read_to_string("/proc/sys/kernel/hostname") {
        Ok(name) if !name.trim().is_empty() => format!(" on {}", name.trim()),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_run_is_refused_and_told_who_holds_it() {
        let folder = tempfile::tempdir().unwrap();
        let first = Lock::take(folder.path()).unwrap();
        let error = Lock::take(folder.path()).unwrap_err();
        assert!(matches!(error.cause, Cause::Locked(_)));
        assert!(error.to_string().contains(&format!("process {}", std::process::id())), "{error}");
        drop(first);
        Lock::take(folder.path()).unwrap();
    }

    #[test]
    fn a_file_left_by_a_crash_does_not_lock() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(NAME), "process 1 on elsewhere, a longer line than ours\n")
            .unwrap();
        let _lock = Lock::take(folder.path()).unwrap();
        let text = std::fs::read_to_string(folder.path().join(NAME)).unwrap();
        assert!(text.starts_with(&format!("process {}", std::process::id())) && text.lines().count() == 1);
    }
}
