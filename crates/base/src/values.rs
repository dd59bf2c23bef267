//! A table that has been read and checked against its keys.

use crate::Vec3;
use crate::schedule::Every;
use std::collections::BTreeMap;
use std::ops::Range;

/// A checked value, in SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A quantity.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// Yes or no.
    Flag(bool),
    /// A text, a word or a menu name.
    Text(String),
    /// Three quantities.
    Vector(Vec3),
    /// A schedule.
    Every(Every),
    /// A list.
    List(Vec<Value>),
    /// A table.
    Table(Values),
    /// Tables by name, in the order written.
    Named(Vec<(String, Values)>),
}

/// The values of one table by key, each with its place in the text (absent for defaults).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values {
    entries: BTreeMap<String, (Value, Option<Range<usize>>)>,
    /// Where the table itself stands.
    pub span: Option<Range<usize>>,
}

/// Asking for a key that the table's key list does not have, or with another
/// type, is a mistake in brazilnut and not in the case: these panic.
impl Values {
    /// Sets `key`; the reader's business.
    pub fn insert(&mut self, key: &str, value: Value, span: Option<Range<usize>>) {
        let _ = self.entries.insert(key.to_string(), (value, span));
    }

    /// The value of `key`, if set.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.entries.get(key).map(|(v, _)| v)
    }

    /// True if `key` is set, by the user or by default.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// Where the user wrote `key`; the table's place if it is a default.
    #[must_use]
    pub fn span(&self, key: &str) -> Option<Range<usize>> {
        self.entries.get(key).and_then(|(_, s)| s.clone()).or_else(|| self.span.clone())
    }

    /// True if the user wrote `key` (it is not a default).
    #[must_use]
    pub fn is_written(&self, key: &str) -> bool {
        self.entries.get(key).is_some_and(|(_, s)| s.is_some())
    }

    /// All keys and values in key order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.entries.iter().map(|(k, (v, _))| (k.as_str(), v))
    }

    /// The number at `key` if set as a number (a word in its place gives `None`).
    #[must_use]
    pub fn number_opt(&self, key: &str) -> Option<f64> {
        match self.get(key)? {
            Value::Number(x) => Some(*x),
            Value::Integer(n) => Some(*n as f64),
            _ => None,
        }
    }

    /// The number at `key`.
    #[must_use]
    pub fn number(&self, key: &str) -> f64 {
        self.number_opt(key).unwrap_or_else(|| panic!("key {key} holds no number"))
    }

    /// The whole number at `key` if set.
    #[must_use]
    pub fn integer_opt(&self, key: &str) -> Option<i64> {
        match self.get(key)? {
            Value::Integer(n) => Some(*n),
            _ => None,
        }
    }

    /// The whole number at `key`.
    #[must_use]
    pub fn integer(&self, key: &str) -> i64 {
        self.integer_opt(key).unwrap_or_else(|| panic!("key {key} holds no whole number"))
    }

    /// The flag at `key`.
    #[must_use]
    pub fn flag(&self, key: &str) -> bool {
        matches!(self.get(key), Some(Value::Flag(true)))
    }

    /// The text at `key` if set as text.
    #[must_use]
    pub fn text_opt(&self, key: &str) -> Option<&str> {
        match self.get(key)? {
            Value::Text(s) => Some(s),
            _ => None,
        }
    }

    /// The text at `key`.
    #[must_use]
    pub fn text(&self, key: &str) -> &str {
        self.text_opt(key).unwrap_or_else(|| panic!("key {key} holds no text"))
    }

    /// The vector at `key` if set.
    #[must_use]
    pub fn vector_opt(&self, key: &str) -> Option<Vec3> {
        match self.get(key)? {
            Value::Vector(v) => Some(*v),
            _ => None,
        }
    }

    /// The schedule at `key` if set.
    #[must_use]
    pub fn every_opt(&self, key: &str) -> Option<Every> {
        match self.get(key)? {
            Value::Every(e) => Some(*e),
            _ => None,
        }
    }

    /// The table at `key` if set.
    #[must_use]
    pub fn table_opt(&self, key: &str) -> Option<&Values> {
        match self.get(key)? {
            Value::Table(t) => Some(t),
            _ => None,
        }
    }

    /// The list at `key`, empty if not set.
    #[must_use]
    pub fn list(&self, key: &str) -> &[Value] {
        match self.get(key) {
            Some(Value::List(l)) => l,
            _ => &[],
        }
    }

    /// The tables of the array at `key`, none if not set.
    pub fn tables(&self, key: &str) -> impl Iterator<Item = &Values> {
        self.list(key).iter().filter_map(|v| match v {
            Value::Table(t) => Some(t),
            _ => None,
        })
    }

    /// The named tables at `key`, none if not set.
    #[must_use]
    pub fn named(&self, key: &str) -> &[(String, Values)] {
        match self.get(key) {
            Some(Value::Named(n)) => n,
            _ => &[],
        }
    }
}
