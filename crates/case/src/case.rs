//! A case that has been read: its values and where they came from.

use crate::issue::Issues;
use crate::source::Source;
use crate::{keys, read, resolved};
use brazilnut_base::values::Values;
use std::path::{Path, PathBuf};

/// A case whose every key has been checked by itself.
#[derive(Clone, Debug)]
pub struct Case {
    /// The values of all tables, defaults included.
    pub values: Values,
    /// The text that spans refer to.
    pub source: String,
    /// Name of the file, for messages.
    pub path: String,
    /// Folder that file names in the case are relative to.
    pub folder: PathBuf,
}

impl Case {
    /// Reads the case file at `path` and lays `overrides` (`key=value`) over it.
    ///
    /// # Errors
    /// Everything that is wrong, the file's absence included.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Self, Issues> {
        Self::load_and_append(path, overrides, "")
    }

    /// As [`Case::load`], with `more` TOML appended to the file's text.
    ///
    /// # Errors
    /// As [`Case::load`].
    pub fn load_and_append(path: &Path, overrides: &[String], more: &str) -> Result<Self, Issues> {
        let shown = path.display().to_string();
        let fail = |cause: String| {
            let mut issues = Issues::new(&shown, String::new());
            issues.add(
                None,
                "the case file cannot be read",
                cause,
                "give the path of a case file (`brazilnut new` makes one)",
            );
            issues
        };
        let size = std::fs::metadata(path).map_err(|e| fail(e.to_string()))?.len();
        if size > crate::source::MAX_BYTES as u64 {
            return Err(fail(format!("it has {size} bytes: this is no case file")));
        }
        let bytes = std::fs::read(path).map_err(|e| fail(e.to_string()))?;
        let text = String::from_utf8(bytes).map_err(|_| fail("it is not text in UTF-8".into()))?;
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Self::parse(&format!("{text}\n{more}"), &shown, folder, overrides)
    }

    /// Reads a case from its text; `path` is for messages.
    ///
    /// # Errors
    /// Everything that is wrong.
    pub fn parse(text: &str, path: &str, folder: PathBuf, overrides: &[String]) -> Result<Self, Issues> {
        let source = Source::new(text, overrides);
        let mut issues = Issues::new(path, source.text().to_string());
        let Some(root) = source.parse(&mut issues) else { return Err(issues) };
        let values = read::table(&root, 0..source.text().len(), &keys::root(), "", &mut issues);
        let case = Self { values, source: issues.source.clone(), path: path.to_string(), folder };
        crate::check::check(&case, &mut issues);
        issues.or(case)
    }

    /// The model's name.
    #[must_use]
    pub fn model(&self) -> &str {
        self.values.text("model")
    }

    /// The resolved copy: every default written out, SI units.
    #[must_use]
    pub fn resolved(&self) -> String {
        let mut text = format!(
            "# resolved by brazilnut {}: every default is written out, bare numbers are SI\n",
            env!("CARGO_PKG_VERSION")
        );
        text += &resolved::write(&self.values, &keys::root());
        text
    }

    /// An empty collection of issues for this case.
    #[must_use]
    pub fn issues(&self) -> Issues {
        Issues::new(&self.path, self.source.clone())
    }
}
