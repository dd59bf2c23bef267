//! Tables as CSV: a row of names, one `#` line of units, then numbers that
//! read back to the same bits.
//!
//! `pandas.read_csv(path, comment="#")` reads them.

use crate::error::At;
use crate::{Appender, StoreError};
use brazilnut_base::{Column, Table};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// A table on disk that grows row by row.
#[derive(Debug)]
pub struct TableFile {
    out: Appender,
    width: usize,
    line: String,
}

impl TableFile {
    /// A new table with these columns; what was there before is dropped.
    ///
    /// # Errors
    /// If it cannot be written, or a name or unit cannot stand in a CSV file.
    pub fn create(path: &Path, columns: &[Column]) -> Result<Self, StoreError> {
        let head = head(columns).map_err(|why| StoreError::content(path, "create", why))?;
        let mut out = Appender::create(path)?;
        out.append(head.as_bytes())?;
        Ok(Self { out, width: columns.len(), line: String::new() })
    }

    /// The table of an earlier part of the run, cut back to `length` bytes.
    ///
    /// # Errors
    /// If it is missing, too short, or has other columns.
    pub fn resume(path: &Path, columns: &[Column], length: u64) -> Result<Self, StoreError> {
        let expected = head(columns).map_err(|why| StoreError::content(path, "continue", why))?;
        let mut found = vec![];
        let limit = expected.len() as u64;
        File::open(path).and_then(|f| f.take(limit).read_to_end(&mut found)).at(path, "read")?;
        if found != expected.as_bytes() || length < limit {
            let why = format!(
                "its columns differ from those of this run ({})",
                expected.lines().next().unwrap_or("")
            );
            return Err(StoreError::content(path, "continue", why));
        }
        Ok(Self { out: Appender::resume(path, length)?, width: columns.len(), line: String::new() })
    }

    /// Appends one row, at once and whole.
    ///
    /// # Errors
    /// If it cannot be written or is not as wide as the table.
    pub fn append(&mut self, row: &[f64]) -> Result<(), StoreError> {
        if row.len() != self.width {
            let why = format!("a row of {} values for {} columns", row.len(), self.width);
            return Err(StoreError::content(self.out.path(), "write", why));
        }
        self.line.clear();
        push_row(&mut self.line, row);
        self.out.append(self.line.as_bytes())
    }

    /// Bytes written so far: what a checkpoint must remember.
    #[must_use]
    pub fn length(&self) -> u64 {
        self.out.length()
    }

    /// Brings everything written so far onto the disk; call it before a checkpoint.
    ///
    /// # Errors
    /// If the disk says no.
    pub fn sync(&self) -> Result<(), StoreError> {
        self.out.sync()
    }
}

/// Writes a whole table, replacing what was there.
///
/// # Errors
/// If it cannot be written.
pub fn write(path: &Path, table: &Table) -> Result<(), StoreError> {
    let mut text = head(&table.columns).map_err(|why| StoreError::content(path, "write", why))?;
    for row in &table.rows {
        if row.len() != table.columns.len() {
            let why = format!("a row of {} values for {} columns", row.len(), table.columns.len());
            return Err(StoreError::content(path, "write", why));
        }
        push_row(&mut text, row);
    }
    crate::atomic::write(path, text.as_bytes())
}

/// Reads a table of numbers; without a line of units every unit is `1`.
///
/// # Errors
/// If it cannot be read or is not a table of numbers; the line is named.
pub fn read(path: &Path) -> Result<Table, StoreError> {
    let text = fs::read_to_string(path).at(path, "read")?;
    parse(&text).map_err(|why| StoreError::content(path, "read", why))
}

/// Reads a table from text.
///
/// # Errors
/// A sentence that names the line.
pub fn parse(text: &str) -> Result<Table, String> {
    let mut reader =
        csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let names = reader.headers().map_err(|e| e.to_string())?.clone();
    if names.is_empty() {
        return Err("it has no row of column names".into());
    }
    let units: Vec<&str> = match text.lines().nth(1).and_then(|l| l.strip_prefix('#')) {
        Some(l) if l.split(',').count() == names.len() => l.split(',').map(str::trim).collect(),
        _ => vec!["1"; names.len()],
    };
    let columns = names.iter().zip(units).map(|(n, u)| Column::new(n, u)).collect();
    let mut rows = vec![];
    for record in reader.records() {
        let record = record.map_err(|e| e.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |s: &str| s.parse::<f64>().map_err(|_| format!("line {line}: {s:?} is not a number"));
        rows.push(record.iter().map(number).collect::<Result<Vec<f64>, String>>()?);
    }
    Ok(Table { columns, rows })
}

/// The row of names and the line of units.
fn head(columns: &[Column]) -> Result<String, String> {
    let cell = |s: &str| {
        if s.is_empty() || s.contains([',', '"', '#', '\n', '\r']) || s.trim() != s {
            return Err(format!("{s:?} cannot be a column name or unit"));
        }
        Ok(s.to_string())
    };
    let names: Vec<String> = columns.iter().map(|c| cell(&c.name)).collect::<Result<_, _>>()?;
    let units: Vec<String> = columns.iter().map(|c| cell(&c.unit)).collect::<Result<_, _>>()?;
    if names.is_empty() {
        return Err("a table needs at least one column".into());
    }
    Ok(format!("{}\n# {}\n", names.join(","), units.join(",")))
}

fn push_row(line: &mut String, row: &[f64]) {
    for (k, x) in row.iter().enumerate() {
        if k > 0 {
            line.push(',');
        }
        push_number(line, *x);
    }
    line.push('\n');
}

/// The shortest text that reads back to the same bits; whole numbers without a point.
pub(crate) fn push_number(text: &mut String, x: f64) {
    // Writing to a String cannot fail.
    let _ = if x == x.trunc() && x.abs() < 1e15 { write!(text, "{x}") } else { write!(text, "{x:?}") };
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn columns() -> Vec<Column> {
        vec![Column::new("time", "s"), Column::new("height", "m")]
    }

    #[test]
    fn looks_as_pandas_expects() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("height.csv");
        let mut t = TableFile::create(&path, &columns()).unwrap();
        t.append(&[0.0, 0.1]).unwrap();
        t.append(&[1.0, 1e-7]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "time,height\n# s,m\n0,0.1\n1,1e-7\n");
        assert!(t.append(&[1.0]).is_err());
        let back = read(&path).unwrap();
        assert_eq!((back.columns, back.rows), (columns(), vec![vec![0.0, 0.1], vec![1.0, 1e-7]]));
    }

    #[test]
    fn resumes_at_the_offset_of_the_checkpoint() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("height.csv");
        let mut t = TableFile::create(&path, &columns()).unwrap();
        t.append(&[0.0, 1.0]).unwrap();
        let at = t.length();
        t.append(&[1.0, 1.0]).unwrap();
        drop(t);
        let mut t = TableFile::resume(&path, &columns(), at).unwrap();
        t.append(&[1.0, 2.0]).unwrap();
        assert_eq!(read(&path).unwrap().rows, vec![vec![0.0, 1.0], vec![1.0, 2.0]]);
        let other = [Column::new("time", "s"), Column::new("width", "m")];
        let error = TableFile::resume(&path, &other, at).unwrap_err();
        assert!(error.to_string().contains("columns differ"), "{error}");
    }

    #[test]
    fn refuses_what_a_csv_file_cannot_hold() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        for bad in ["a,b", "", "a\nb", "#a", "\"a"] {
            assert!(TableFile::create(&path, &[Column::new(bad, "1")]).is_err(), "{bad:?}");
        }
        assert!(!path.exists());
    }

    #[test]
    fn names_the_bad_line() {
        assert_eq!(parse("a,b\n# 1,1\n1,2\n3,x\n"), Err("line 4: \"x\" is not a number".into()));
        assert!(parse("a,b\n1,2,3\n").is_err());
        assert!(parse("").is_err());
    }

    proptest! {
        #[test]
        fn numbers_read_back_to_the_same_bits(bits in any::<u64>()) {
            let x = f64::from_bits(bits);
            let mut text = String::new();
            push_number(&mut text, x);
            let y: f64 = text.parse().unwrap();
            // The payload of a NaN is not part of a table.
            prop_assert!(x.is_nan() && y.is_nan() || x.to_bits() == y.to_bits(), "{} {}", x, text);
        }
    }
}
