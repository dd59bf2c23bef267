//! The resolved case: every default written out, every quantity in SI.

use brazilnut_base::keys::{Key, Kind};
use brazilnut_base::schedule::Every;
use brazilnut_base::values::{Value, Values};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The TOML text of `values` read by `keys`. Reading it again gives the same values.
#[must_use]
pub fn write(values: &Values, keys: &[Key]) -> String {
    let mut out = String::new();
    table(&mut out, values, keys, "");
    out
}

fn table(out: &mut String, values: &Values, keys: &[Key], path: &str) {
    // A table's own keys must stand before its sub-tables.
    for key in keys {
        if let Some(v) = values.get(key.name)
            && let Some(text) = inline(v, &key.kind)
        {
            let _ = writeln!(out, "{} = {text}{}", key.name, unit(&key.kind));
        }
    }
    for key in keys {
        let Some(v) = values.get(key.name) else { continue };
        let place = if path.is_empty() { key.name.to_string() } else { format!("{path}.{}", key.name) };
        match (v, &key.kind) {
            (Value::Table(t), Kind::Table { keys, .. }) => {
                let _ = writeln!(out, "\n[{place}]");
                table(out, t, keys, &place);
            }
            (Value::List(items), Kind::Tables(keys)) => {
                for item in items {
                    if let Value::Table(t) = item {
                        let _ = writeln!(out, "\n[[{place}]]");
                        table(out, t, keys, &place);
                    }
                }
            }
            (Value::List(items), Kind::Variants { tag, common, keys, .. }) => {
                for item in items {
                    let Value::Table(t) = item else { continue };
                    let Some(name) = t.text_opt(tag) else { continue };
                    let _ = writeln!(out, "\n[[{place}]]");
                    let all: Vec<Key> = common.iter().chain(keys(name)).copied().collect();
                    table(out, t, &all, &place);
                }
            }
            (Value::Named(named), Kind::NamedTables(keys)) => {
                for (name, t) in named {
                    let place = format!("{place}.{}", quote(name));
                    let _ = writeln!(out, "\n[{place}]");
                    table(out, t, keys, &place);
                }
            }
            _ => {}
        }
    }
}

fn inline(v: &Value, kind: &Kind) -> Option<String> {
    Some(match v {
        Value::Number(x) => number(*x),
        Value::Integer(n) => n.to_string(),
        Value::Flag(b) => b.to_string(),
        Value::Text(s) => quote(s),
        Value::Vector(x) => format!("[{}, {}, {}]", number(x.x), number(x.y), number(x.z)),
        Value::Every(e) => quote(&every(*e)),
        Value::List(items) => match kind {
            Kind::List(inner) => {
                format!("[{}]", items.iter().filter_map(|i| inline(i, inner)).collect::<Vec<_>>().join(", "))
            }
            _ => return None,
        },
        Value::Table(_) | Value::Named(_) => return None,
    })
}

/// Every value under its dotted path, as text.
#[must_use]
pub fn flatten(values: &Values) -> BTreeMap<String, String> {
    fn value(path: String, v: &Value, out: &mut BTreeMap<String, String>) {
        match v {
            Value::Table(t) => table(&path, t, out),
            Value::Named(n) => n.iter().for_each(|(name, t)| table(&format!("{path}.{name}"), t, out)),
            Value::List(items) => {
                items.iter().enumerate().for_each(|(k, x)| value(format!("{path}[{k}]"), x, out));
            }
            leaf => {
                let text = inline(leaf, &Kind::Text).unwrap_or_default();
                let _ = out.insert(path, text);
            }
        }
    }
    fn table(path: &str, t: &Values, out: &mut BTreeMap<String, String>) {
        for (k, v) in t.iter() {
            value(if path.is_empty() { k.to_string() } else { format!("{path}.{k}") }, v, out);
        }
    }
    let mut out = BTreeMap::new();
    table("", values, &mut out);
    out
}

/// The shortest text that reads back to the same bits.
fn number(x: f64) -> String {
    format!("{x:?}")
}

/// A schedule as a case writes it.
#[must_use]
pub fn every(e: Every) -> String {
    match e {
        Every::Steps(n) => format!("{n} steps"),
        Every::Time(t) => format!("{t:?} s"),
        Every::PerCycle(n) => format!("{n} per cycle"),
        Every::Cycles(n) => format!("{n} cycles"),
        Every::End => "end".into(),
    }
}

fn quote(s: &str) -> String {
    toml::Value::String(s.to_string()).to_string()
}

fn unit(kind: &Kind) -> String {
    match kind {
        Kind::Quantity(d) | Kind::QuantityOr(d, _) | Kind::Vector(d)
            if *d != brazilnut_base::units::Dimension::NONE =>
        {
            format!("  # {d}")
        }
        _ => String::new(),
    }
}
