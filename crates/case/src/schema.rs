//! JSON Schema of the case file, for editors.

use brazilnut_base::keys::{Absent, Check, Key, Kind};
use brazilnut_base::units::Dimension;
use serde_json::{Map, Value, json};

/// The schema (draft 4, which the common TOML editor services understand).
#[must_use]
pub fn schema() -> Value {
    let mut root = table(&crate::keys::root());
    let map = root.as_object_mut().expect("a table is an object");
    let _ = map.insert("$schema".into(), json!("http://json-schema.org/draft-04/schema#"));
    let _ = map.insert("title".into(), json!("brazilnut case"));
    root
}

fn table(keys: &[Key]) -> Value {
    let mut properties = Map::new();
    let mut required = vec![];
    for key in keys {
        let mut p = kind(&key.kind, key.check);
        if let Some(p) = p.as_object_mut() {
            let _ = p.insert("description".into(), json!(key.doc));
            if let Absent::Is(text) = key.absent
                && let Ok(v) = format!("x = {text}").parse::<toml::Table>()
                && let Ok(v) = serde_json::to_value(&v["x"])
            {
                let _ = p.insert("default".into(), v);
            }
        }
        let _ = properties.insert(key.name.into(), p);
        if matches!(key.absent, Absent::Required) {
            required.push(key.name);
        }
    }
    let mut t = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    // Draft 4 forbids an empty list here.
    if !required.is_empty() {
        t["required"] = json!(required);
    }
    t
}

fn quantity(d: Dimension, check: Check) -> Value {
    let mut number = json!({ "type": "number", "description": format!("in {d}") });
    match check {
        Check::Finite => {}
        Check::Positive => {
            number["minimum"] = json!(0);
            number["exclusiveMinimum"] = json!(true);
        }
        Check::NonNegative => number["minimum"] = json!(0),
        Check::Between(a, b) | Check::Inside(a, b) => {
            number["minimum"] = json!(a);
            number["maximum"] = json!(b);
        }
    }
    json!({ "anyOf": [number, { "type": "string", "pattern": "^[+-]?[0-9.]" }] })
}

fn words<'a>(names: impl Iterator<Item = &'a str>) -> Value {
    json!({ "enum": names.collect::<Vec<_>>() })
}

fn kind(k: &Kind, check: Check) -> Value {
    match k {
        Kind::Quantity(d) => quantity(*d, check),
        Kind::QuantityOr(d, w) => json!({ "anyOf": [quantity(*d, check), words(w.iter().copied())] }),
        Kind::Integer => json!({ "type": "integer" }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Text => json!({ "type": "string" }),
        Kind::Word(w) => words(w.iter().copied()),
        Kind::Choice(menu) => words(menu.iter().map(|e| e.name)),
        Kind::Vector(d) => {
            json!({ "type": "array", "items": quantity(*d, check), "minItems": 3, "maxItems": 3 })
        }
        Kind::Every => json!({ "anyOf": [{ "type": "number" }, { "type": "string" }] }),
        Kind::List(inner) => json!({ "type": "array", "items": kind(inner, check) }),
        Kind::Table { keys, shorthand } => match shorthand.and_then(|s| keys.iter().find(|k| k.name == s)) {
            Some(short) => json!({ "anyOf": [table(keys), kind(&short.kind, short.check)] }),
            None => table(keys),
        },
        Kind::Tables(keys) => json!({ "type": "array", "items": table(keys) }),
        Kind::NamedTables(keys) => json!({ "type": "object", "additionalProperties": table(keys) }),
        Kind::Variants { tag, common, menu, keys } => {
            let variants: Vec<Value> = menu()
                .iter()
                .map(|e| {
                    let all: Vec<Key> = common.iter().chain(keys(e.name)).copied().collect();
                    let mut t = table(&all);
                    t["properties"][tag] = json!({ "enum": [e.name], "description": e.summary });
                    t["required"] = json!([tag]);
                    t
                })
                .collect();
            json!({ "type": "array", "items": { "anyOf": variants } })
        }
    }
}
