//! Where everything of a run lies.

use crate::failure::Failure;
use std::path::{Path, PathBuf};

/// The paths of a run directory.
#[derive(Clone, Debug)]
pub struct Directory {
    /// The directory itself.
    pub root: PathBuf,
}

impl Directory {
    /// The directory at `root`.
    #[must_use]
    pub fn new(root: &Path) -> Self {
        Self { root: root.to_path_buf() }
    }

    /// The resolved case.
    #[must_use]
    pub fn case(&self) -> PathBuf {
        self.root.join("case.toml")
    }

    /// Status and summary.
    #[must_use]
    pub fn status(&self) -> PathBuf {
        self.root.join("run.json")
    }

    /// The report.
    #[must_use]
    pub fn report(&self) -> PathBuf {
        self.root.join("report.html")
    }

    /// One table per observer.
    #[must_use]
    pub fn tables(&self) -> PathBuf {
        self.root.join("tables")
    }

    /// Grains for ParaView.
    #[must_use]
    pub fn grains(&self) -> PathBuf {
        self.root.join("grains")
    }

    /// The flow for ParaView.
    #[must_use]
    pub fn fields(&self) -> PathBuf {
        self.root.join("fields")
    }

    /// Grains for OVITO.
    #[must_use]
    pub fn dump(&self) -> PathBuf {
        self.root.join("grains.lammpstrj")
    }

    /// Pictures of the bed.
    #[must_use]
    pub fn pictures(&self) -> PathBuf {
        self.root.join("pictures")
    }

    /// Checkpoints.
    #[must_use]
    pub fn checkpoints(&self) -> PathBuf {
        self.root.join("checkpoints")
    }

    /// Refuses a directory that holds another run, unless it may be replaced;
    /// then clears away what a run writes, and nothing else.
    ///
    /// # Errors
    /// If there is a run, or the old one cannot be cleared away.
    pub fn claim(&self, replace: bool) -> Result<(), Failure> {
        if !self.status().exists() && !self.checkpoints().exists() {
            return Ok(());
        }
        let shown = self.root.display();
        if !replace {
            return Err(Failure::Usage(format!(
                "{shown} holds a run already\n  remedy: `--force` replaces it, `--out DIR` writes elsewhere, `brazilnut resume {shown}` continues it"
            )));
        }
        for folder in [self.tables(), self.grains(), self.pictures(), self.checkpoints(), self.fields()] {
            if folder.exists() {
                std::fs::remove_dir_all(&folder).map_err(|e| cannot(&folder, &e))?;
            }
        }
        for file in [self.case(), self.status(), self.report(), self.dump()] {
            if file.exists() {
                std::fs::remove_file(&file).map_err(|e| cannot(&file, &e))?;
            }
        }
        Ok(())
    }
}

fn cannot(path: &Path, e: &std::io::Error) -> Failure {
    Failure::Usage(format!("{} cannot be replaced: {e}", path.display()))
}
