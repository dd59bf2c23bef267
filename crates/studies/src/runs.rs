//! Runs of cases inside a study.

use brazilnut_base::Table;
use brazilnut_case::Case;
use brazilnut_runner::Failure;
use brazilnut_runner::directory::Directory;
use brazilnut_runner::run::{Options, Outcome, resume, run};
use brazilnut_store::table;
use std::path::{Path, PathBuf};

/// Seeds of runs that differ by nothing else: a mean over them has a standard error.
pub const SEEDS: [u64; 3] = [1, 2, 3];

/// A run that has ended.
pub struct Done {
    directory: Directory,
}

impl Done {
    /// Runs the case `text` (the file `name` of the study's folder) with `overrides` in `folder`.
    ///
    /// With `go_on`, a run of the same case that is there is continued, or left as it is if it has ended.
    ///
    /// # Errors
    /// What the run fails with, or that it was stopped.
    pub fn new(
        (name, text): (&str, &str),
        overrides: &[String],
        folder: &Path,
        go_on: bool,
    ) -> Result<Self, Failure> {
        let case = Case::parse(text, name, PathBuf::new(), overrides)?;
        let directory = Directory::new(folder);
        let read = |path: PathBuf| std::fs::read_to_string(path).unwrap_or_default();
        let same = go_on && read(directory.case()) == case.resolved();
        let status: serde_json::Value = serde_json::from_str(&read(directory.status())).unwrap_or_default();
        if same && status["status"] == "done" {
            return Ok(Self { directory });
        }
        let options =
            Options { out: Some(folder.to_path_buf()), replace: true, quiet: !go_on, ..Options::default() };
        let saved = std::fs::read_dir(directory.checkpoints()).is_ok_and(|mut d| d.next().is_some());
        let outcome = if same && saved { resume(folder, &options)? } else { run(&case, &options)? };
        match outcome {
            Outcome::Done => Ok(Self { directory }),
            Outcome::Stopped(_) => Err(Failure::Usage(format!(
                "{} was stopped early; the same command continues it",
                folder.display()
            ))),
        }
    }

    /// The table `name` of the run.
    ///
    /// # Errors
    /// If there is none.
    pub fn table(&self, name: &str) -> Result<Table, Failure> {
        Ok(table::read(&self.directory.tables().join(format!("{name}.csv")))?)
    }
}

/// Grains at one time, from the dump of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Time, s.
    pub time: f64,
    /// Centres, m.
    pub position: Vec<[f64; 3]>,
    /// Velocities, m/s.
    pub velocity: Vec<[f64; 3]>,
}

impl Done {
    /// The frames of the run's dump, in order.
    ///
    /// # Errors
    /// If there is none.
    pub fn frames(&self) -> Result<Vec<Frame>, Failure> {
        let path = self.directory.dump();
        let text = std::fs::read_to_string(&path)
            .map_err(|e| Failure::Usage(format!("{}: {e}; the case needs `output.dump`", path.display())))?;
        Ok(frames(&text))
    }
}

/// The frames of a dump with the columns id, type, x, y, z, vx, vy, vz.
fn frames(text: &str) -> Vec<Frame> {
    let (mut list, mut section) = (vec![], "");
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("ITEM: ") {
            section = name.split(' ').next().unwrap_or_default();
            if section == "TIME" {
                list.push(Frame::default());
            }
            continue;
        }
        let Some(frame) = list.last_mut() else { continue };
        match section {
            "TIME" => frame.time = line.trim().parse().unwrap_or(f64::NAN),
            "ATOMS" => {
                let v: Vec<f64> = line.split(' ').map(|w| w.parse().unwrap_or(f64::NAN)).collect();
                if v.len() >= 8 {
                    frame.position.push([v[2], v[3], v[4]]);
                    frame.velocity.push([v[5], v[6], v[7]]);
                }
            }
            _ => {}
        }
    }
    list
}

/// The first entry of a column; not a number if there is none.
#[must_use]
pub fn first(table: &Table, name: &str) -> f64 {
    table.column(name).and_then(|c| c.first().copied()).unwrap_or(f64::NAN)
}

/// A column, empty if there is none.
#[must_use]
pub fn column(table: &Table, name: &str) -> Vec<f64> {
    table.column(name).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_of_a_dump() {
        let head = "ITEM: UNITS\nsi\nITEM: TIME\n0.5\nITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n1\n";
        let rest = "ITEM: BOX BOUNDS ff ff ff\n0.0 1.0\n0.0 1.0\n0.0 1.0\nITEM: ATOMS id type x y z vx vy vz radius\n0 1 1.0 2.0 3.0 4.0 5.0 6.0 0.1\n";
        let one = Frame { time: 0.5, position: vec![[1.0, 2.0, 3.0]], velocity: vec![[4.0, 5.0, 6.0]] };
        assert_eq!(frames(&format!("{head}{rest}{head}{rest}")), vec![one.clone(), one]);
    }
}
