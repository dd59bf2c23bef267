//! Named columns with units: what observers hand to whoever writes.

use serde::{Deserialize, Serialize};

/// Name and unit of one column.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Lower snake case, the field's standard term.
    pub name: String,
    /// SI unit as text, `1` if dimensionless.
    pub unit: String,
}

impl Column {
    /// A column `name` in `unit`.
    #[must_use]
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into() }
    }
}

/// A table of numbers, row by row.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows; each as long as `columns`.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// An empty table with the given `(name, unit)` columns.
    #[must_use]
    pub fn new(columns: &[(&str, &str)]) -> Self {
        Self { columns: columns.iter().map(|(n, u)| Column::new(*n, *u)).collect(), rows: vec![] }
    }

    /// The values of the column called `name`, if there is one.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = self.columns.iter().position(|c| c.name == name)?;
        Some(self.rows.iter().map(|r| r[k]).collect())
    }
}
