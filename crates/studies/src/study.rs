//! What a study is.

use brazilnut_base::figure::Figure;
use brazilnut_runner::Failure;
use std::path::PathBuf;

/// One published table, figure or statement.
pub struct Study {
    /// Name, that of its folder in `studies/`.
    pub id: &'static str,
    /// What it is about.
    pub title: &'static str,
    /// What was published: the text of `published.toml`.
    pub published: &'static str,
    /// The README of its folder.
    pub readme: &'static str,
    /// Computes the quantities.
    pub run: fn(&Request) -> Result<Ran, Failure>,
}

/// How a study is to be run.
#[derive(Clone, Debug)]
pub struct Request {
    /// The short form.
    pub quick: bool,
    /// Folder for runs and plots.
    pub out: PathBuf,
}

/// What a study found.
#[derive(Clone, Debug, Default)]
pub struct Ran {
    /// The quantities, by the names in `published.toml`.
    pub computed: Vec<Computed>,
    /// Plots, with the published points on them where there are any.
    pub figures: Vec<Figure>,
}

/// One computed quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Computed {
    /// Its name in `published.toml`.
    pub name: String,
    /// Its value in the unit given there.
    pub value: f64,
}

impl Computed {
    /// A quantity.
    #[must_use]
    pub fn new(name: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), value }
    }
}

impl From<(Vec<Computed>, Vec<Figure>)> for Ran {
    fn from((computed, figures): (Vec<Computed>, Vec<Figure>)) -> Self {
        Self { computed, figures }
    }
}
