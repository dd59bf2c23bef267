//! A time series for ParaView: a folder of frames and the `.pvd` that lists them.

use crate::error::At;
use crate::{StoreError, atomic};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// `folder/name.pvd` and `folder/name/name-STEP.EXT`.
#[derive(Debug)]
pub struct Series {
    folder: PathBuf,
    name: String,
    extension: String,
    frames: Vec<(u64, f64)>,
}

impl Series {
    /// A new, empty series called `name` with frames of type `extension` (`vtp`, `vti`).
    ///
    /// # Errors
    /// If its folder or its list cannot be made.
    pub fn create(folder: &Path, name: &str, extension: &str) -> Result<Self, StoreError> {
        let series = Self::empty(folder, name, extension);
        atomic::make_folder(&folder.join(name))?;
        series.write_list()?;
        Ok(series)
    }

    /// The series of an earlier part of the run without the frames after `step`.
    ///
    /// # Errors
    /// If the list cannot be read or written.
    pub fn resume(folder: &Path, name: &str, extension: &str, step: u64) -> Result<Self, StoreError> {
        let mut series = Self::empty(folder, name, extension);
        let list = series.list();
        let text = fs::read_to_string(&list).at(&list, "read")?;
        series.frames = series.parse(&text).map_err(|why| StoreError::content(&list, "continue", why))?;
        let later: Vec<u64> = series.frames.iter().map(|f| f.0).filter(|s| *s > step).collect();
        series.frames.retain(|f| f.0 <= step);
        // The list first: it must never name a frame that is gone.
        series.write_list()?;
        for step in later {
            let path = series.frame(step);
            if path.exists() {
                fs::remove_file(&path).at(&path, "remove")?;
            }
        }
        Ok(series)
    }

    /// Where the frame of `step` goes.
    #[must_use]
    pub fn frame(&self, step: u64) -> PathBuf {
        self.folder.join(self.relative(step))
    }

    /// Lists the frame of `step` at `time` (s), which has been written; a frame
    /// of the same step is listed once.
    ///
    /// # Errors
    /// If the list cannot be written.
    pub fn add(&mut self, step: u64, time: f64) -> Result<(), StoreError> {
        self.frames.retain(|f| f.0 != step);
        self.frames.push((step, time));
        self.write_list()
    }

    /// The list: what ParaView opens.
    #[must_use]
    pub fn list(&self) -> PathBuf {
        self.folder.join(format!("{}.pvd", self.name))
    }

    /// Writes `NAME-in-paraview.py` beside the list: it shows a series of grains as
    /// spheres of the right size, which a list alone cannot ask for.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_paraview_script(&self) -> Result<(), StoreError> {
        let script = include_str!("paraview.py").replace("NAME", &self.name);
        atomic::write(&self.folder.join(format!("{}-in-paraview.py", self.name)), script.as_bytes())
    }

    /// Step and time (s) of every frame.
    #[must_use]
    pub fn frames(&self) -> &[(u64, f64)] {
        &self.frames
    }

    fn empty(folder: &Path, name: &str, extension: &str) -> Self {
        let folder = folder.to_path_buf();
        Self { folder, name: name.to_string(), extension: extension.to_string(), frames: vec![] }
    }

    /// Twelve digits sort by step in any file browser.
    fn relative(&self, step: u64) -> String {
        format!("{0}/{0}-{step:012}.{1}", self.name, self.extension)
    }

    fn write_list(&self) -> Result<(), StoreError> {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for (step, time) in &self.frames {
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{}\"/>",
                self.relative(*step)
            );
        }
        text.push_str("</Collection>\n</VTKFile>\n");
        atomic::write(&self.list(), text.as_bytes())
    }

    fn parse(&self, text: &str) -> Result<Vec<(u64, f64)>, String> {
        let attribute = |line: &str, key: &str| -> Option<String> {
            let (_, rest) = line.split_once(&format!("{key}=\""))?;
            rest.split_once('"').map(|(value, _)| value.to_string())
        };
        let mut frames = vec![];
        for line in text.lines().filter(|l| l.trim_start().starts_with("<DataSet")) {
            let time = attribute(line, "timestep").and_then(|t| t.parse().ok());
            let step = attribute(line, "file").and_then(|f| {
                let digits = f.strip_suffix(&format!(".{}", self.extension))?.rsplit('-').next()?.to_string();
                digits.parse().ok()
            });
            frames.push(step.zip(time).ok_or_else(|| format!("this line is not one of ours: {line}"))?);
        }
        Ok(frames)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resumed_series_equals_an_unbroken_one() {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path();
        let mut s = Series::create(at, "grains", "vtp").unwrap();
        for step in [0, 100, 200, 300] {
            fs::write(s.frame(step), b"frame").unwrap();
            s.add(step, step as f64 * 1e-3).unwrap();
        }
        let unbroken = fs::read(s.list()).unwrap();
        let mut s = Series::resume(at, "grains", "vtp", 150).unwrap();
        assert_eq!(s.frames(), [(0, 0.0), (100, 0.1)]);
        assert!(!s.frame(200).exists() && s.frame(100).exists());
        s.add(200, 0.2).unwrap();
        s.add(300, 300.0 * 1e-3).unwrap();
        assert_eq!(fs::read(s.list()).unwrap(), unbroken);
    }

    #[test]
    fn the_script_names_the_list() {
        let folder = tempfile::tempdir().unwrap();
        Series::create(folder.path(), "grains", "vtp").unwrap().write_paraview_script().unwrap();
        let script = fs::read_to_string(folder.path().join("grains-in-paraview.py")).unwrap();
        assert!(script.contains("\"grains.pvd\"") && !script.contains("NAME"));
    }

    #[test]
    fn a_foreign_list_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a.pvd"), "<DataSet timestep=\"0\" file=\"other.vtp\"/>").unwrap();
        assert!(Series::resume(folder.path(), "a", "vtp", 0).is_err());
    }
}
