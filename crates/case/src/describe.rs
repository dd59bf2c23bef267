//! What a case may name, as text: `brazilnut describe contact`.

use brazilnut_base::keys::{Absent, Check, Key, Kind};
use brazilnut_base::menu::{Entry, nearest};
use std::fmt::Write;

/// The topics of `describe`.
#[must_use]
pub fn topics() -> Vec<&'static str> {
    crate::keys::root().iter().map(|k| k.name).collect()
}

/// The page of one topic (a top-level key of the case, or a dotted path into one), or all topics.
///
/// # Errors
/// The nearest topic, if the one asked for does not exist.
pub fn describe(topic: Option<&str>) -> Result<String, String> {
    let root = crate::keys::root();
    let mut out = String::new();
    let Some(topic) = topic else {
        let _ = writeln!(out, "A case may hold these; `brazilnut describe NAME` tells more.\n");
        for key in &root {
            let _ = writeln!(out, "  {:<20} {}", key.name, key.doc);
        }
        return Ok(out);
    };
    let mut keys: Vec<Key> = root;
    let mut found: Option<Key> = None;
    for part in topic.split('.') {
        let Some(key) = keys.iter().find(|k| k.name == part).copied() else {
            let near = nearest(part, keys.iter().map(|k| k.name));
            let hint = near.map(|n| format!("; did you mean `{n}`?")).unwrap_or_default();
            return Err(format!("there is nothing called `{part}` to describe{hint}"));
        };
        keys = match key.kind {
            Kind::Table { keys, .. } | Kind::Tables(keys) | Kind::NamedTables(keys) => keys.to_vec(),
            Kind::Variants { common, .. } => common.to_vec(),
            _ => vec![],
        };
        found = Some(key);
    }
    let key = found.expect("split gives at least one part");
    let _ = writeln!(out, "{topic}: {}\n", key.doc);
    page(&mut out, &key, &keys);
    Ok(out)
}

fn page(out: &mut String, key: &Key, keys: &[Key]) {
    if let Kind::Choice(menu) = key.kind {
        choices(out, menu);
    }
    for k in keys {
        line(out, k);
    }
    for k in keys {
        if let Kind::Choice(menu) = k.kind {
            let _ = writeln!(out, "\n{} may be\n", k.name);
            choices(out, menu);
        }
    }
    if let Kind::Variants { tag, menu, keys, .. } = key.kind {
        let _ = writeln!(out, "\n{tag} may be");
        for e in menu() {
            let _ = writeln!(out);
            choices(out, &[e]);
            for k in keys(e.name) {
                let _ = write!(out, "  ");
                line(out, k);
            }
        }
    }
}

fn choices(out: &mut String, menu: &[Entry]) {
    for e in menu {
        let _ = writeln!(out, "  {}\n      {}", e.name, e.summary);
        for f in e.formula.lines().filter(|f| !f.trim().is_empty()) {
            let _ = writeln!(out, "        {}", f.trim_end());
        }
        if !e.source.is_empty() {
            let _ = writeln!(out, "      [{}]", e.source);
        }
    }
}

fn line(out: &mut String, k: &Key) {
    let what = match &k.kind {
        Kind::Quantity(d) => format!("{d}"),
        Kind::QuantityOr(d, w) => format!("{d} or {}", w.join(", ")),
        Kind::Integer => "whole number".into(),
        Kind::Flag => "true or false".into(),
        Kind::Text => "text".into(),
        Kind::Word(w) => w.join(", "),
        Kind::Choice(_) => "see below".into(),
        Kind::Vector(d) => format!("three in {d}"),
        Kind::Every => "when".into(),
        Kind::List(_) => "list".into(),
        Kind::Table { shorthand: Some(s), .. } => format!("table, or its `{s}` alone"),
        Kind::Table { .. } => "table".into(),
        Kind::Tables(_) | Kind::NamedTables(_) | Kind::Variants { .. } => "tables".into(),
    };
    let absent = match k.absent {
        Absent::Required => "; required".to_string(),
        Absent::Nothing => String::new(),
        Absent::Is(v) => format!("; default {v}"),
    };
    let check = match k.check {
        Check::Finite => String::new(),
        c => format!("; {}", c.words()),
    };
    let _ = writeln!(out, "  {:<24} ({what}{absent}{check})\n      {}", k.name, k.doc);
}
