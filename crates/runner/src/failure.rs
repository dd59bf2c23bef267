//! How a run can fail, and the exit code of each way.

use brazilnut_base::Blowup;
use brazilnut_case::Issues;
use brazilnut_store::StoreError;
use std::fmt;

/// Why there is no result.
#[derive(Debug)]
pub enum Failure {
    /// The case is wrong.
    Case(Box<Issues>),
    /// What was asked for cannot be done: a message with its remedy.
    Usage(String),
    /// The physics blew up.
    Blowup(Box<Blowup>),
    /// A file could not be read or written.
    Store(StoreError),
}

impl Failure {
    /// The exit code of the process.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Case(_) | Self::Usage(_) => 2,
            Self::Blowup(_) => 3,
            Self::Store(_) => 5,
        }
    }

    /// The text for a terminal (`colour`) or a log.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        match self {
            Self::Case(issues) => issues.render(colour),
            Self::Usage(text) => format!("error: {text}\n"),
            Self::Blowup(b) => format!("error: {b}\n"),
            Self::Store(e) => format!("error: {e}\n"),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Failure {}

impl From<Issues> for Failure {
    fn from(issues: Issues) -> Self {
        Self::Case(Box::new(issues))
    }
}

impl From<Blowup> for Failure {
    fn from(b: Blowup) -> Self {
        Self::Blowup(Box::new(b))
    }
}

impl From<StoreError> for Failure {
    fn from(e: StoreError) -> Self {
        Self::Store(e)
    }
}
