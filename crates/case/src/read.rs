//! From TOML to checked values, by the key lists; every error is collected.

use crate::issue::Issues;
use brazilnut_base::keys::{Absent, Check, Key, Kind};
use brazilnut_base::menu::nearest;
use brazilnut_base::schedule::Every;
use brazilnut_base::units::{self, Dimension, UnitError};
use brazilnut_base::values::{Value, Values};
use brazilnut_base::vec3;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

type Span = Range<usize>;
type Spot<'a, 'i> = &'a Spanned<DeValue<'i>>;

/// Reads `table` by `keys`; what is wrong goes to `issues`, and the value of a
/// broken key is left out.
pub fn table(table: &DeTable<'_>, span: Span, keys: &[Key], path: &str, issues: &mut Issues) -> Values {
    let mut values = Values::default();
    values.span = Some(span.clone());
    for (name, _) in table.iter() {
        if !keys.iter().any(|k| k.name == name.get_ref().as_ref()) {
            unknown(name.get_ref(), name.span(), keys, path, issues);
        }
    }
    for key in keys {
        let place = join(path, key.name);
        match table.iter().find(|(n, _)| n.get_ref().as_ref() == key.name) {
            Some((name, written)) => {
                if let Some(v) = value(written, &key.kind, key.check, &place, issues) {
                    // A header like [cell] has no span of its own worth showing: point at the name.
                    let span = if written.get_ref().is_table() { name.span() } else { written.span() };
                    values.insert(key.name, v, Some(span));
                } else {
                    issues.broken.push(place);
                }
            }
            None => match key.absent {
                Absent::Nothing => {}
                Absent::Is(text) => values.insert(key.name, default(key, text), None),
                Absent::Required if issues.is_broken(&place) => {}
                Absent::Required => issues.add(
                    Some(header(&span, issues)),
                    format!("`{place}` is missing"),
                    format!("needs `{}`", key.name),
                    format!("add `{} = {}`: {}", key.name, example(&key.kind), first_sentence(key.doc)),
                ),
            },
        }
    }
    values
}

/// The value that a default text stands for. Defaults are ours: they must read.
fn default(key: &Key, text: &str) -> Value {
    let mut issues = Issues::default();
    let source = format!("x = {text}");
    let parsed = DeTable::parse(&source).unwrap_or_else(|e| panic!("default of {}: {e}", key.name));
    let written = parsed.get_ref().get("x").expect("just written");
    let v = value(written, &key.kind, key.check, key.name, &mut issues);
    v.filter(|_| issues.is_empty()).unwrap_or_else(|| panic!("default of {}: {issues}", key.name))
}

fn value(v: Spot<'_, '_>, kind: &Kind, check: Check, path: &str, issues: &mut Issues) -> Option<Value> {
    let span = v.span();
    match kind {
        Kind::Quantity(d) => quantity(v, *d, check, path, issues).map(Value::Number),
        Kind::QuantityOr(d, words) => match v.get_ref().as_str() {
            Some(s) if words.contains(&s) => Some(Value::Text(s.to_string())),
            Some(s) if s.starts_with(|c: char| c.is_ascii_alphabetic()) => {
                let hint = nearest(s, words.iter().copied());
                issues.add(
                    Some(span),
                    format!("`{path}` cannot be \"{s}\""),
                    format!("expected a quantity in {d} or {}", list(words.iter().copied())),
                    did_you_mean(hint),
                );
                None
            }
            _ => quantity(v, *d, check, path, issues).map(Value::Number),
        },
        Kind::Integer => integer(v, check, path, issues).map(Value::Integer),
        Kind::Flag => match v.get_ref().as_bool() {
            Some(b) => Some(Value::Flag(b)),
            None => wrong(v, "`true` or `false`", path, issues),
        },
        Kind::Text => match v.get_ref().as_str() {
            Some(s) => Some(Value::Text(s.to_string())),
            None => wrong(v, "a text in quotes", path, issues),
        },
        Kind::Word(words) => word(v, words.iter().copied(), path, issues),
        Kind::Choice(menu) => word(v, menu.iter().map(|e| e.name), path, issues),
        Kind::Vector(d) => vector(v, *d, check, path, issues),
        Kind::Every => every(v, path, issues),
        Kind::List(inner) => {
            // A single value stands for a list of one.
            let Some(array) = v.get_ref().as_array() else {
                return value(v, inner, check, path, issues).map(|x| Value::List(vec![x]));
            };
            let items: Vec<_> = array.iter().filter_map(|x| value(x, inner, check, path, issues)).collect();
            (items.len() == array.len()).then_some(Value::List(items))
        }
        Kind::Table { keys, shorthand } => match (v.get_ref().as_table(), shorthand) {
            (Some(t), _) => Some(Value::Table(table(t, span, keys, path, issues))),
            (None, Some(short)) => {
                let mut t = DeTable::new();
                let name = Spanned::new(span.clone(), (*short).into());
                let _ = t.insert(name, v.clone());
                Some(Value::Table(table(&t, span, keys, path, issues)))
            }
            (None, None) => wrong(v, "a table", path, issues),
        },
        Kind::Tables(keys) => each_table(v, path, issues, |t, span, path, issues| {
            Value::Table(table(t, span, keys, path, issues))
        }),
        Kind::Variants { tag, common, menu, keys } => each_table(v, path, issues, |t, span, path, issues| {
            let mut list = common.to_vec();
            let names: Vec<_> = menu().iter().map(|e| e.name).collect();
            if let Some(chosen) = t.get(*tag) {
                match chosen.get_ref().as_str() {
                    Some(s) if names.contains(&s) => list.extend_from_slice(keys(s)),
                    // An unknown variant has unknown keys: only its name is worth a word.
                    _ => {
                        let _ = word(chosen, names.iter().copied(), &join(path, tag), issues);
                        return Value::Table(Values::default());
                    }
                }
            }
            Value::Table(table(t, span, &list, path, issues))
        }),
        Kind::NamedTables(keys) => {
            let Some(t) = v.get_ref().as_table() else { return wrong(v, "a table of tables", path, issues) };
            let mut named = vec![];
            for (name, inner) in t.iter() {
                let place = join(path, name.get_ref());
                match inner.get_ref().as_table() {
                    Some(t) => {
                        named.push((name.get_ref().to_string(), table(t, name.span(), keys, &place, issues)));
                    }
                    None => {
                        let _: Option<Value> = wrong(inner, "a table", &place, issues);
                    }
                }
            }
            Some(Value::Named(named))
        }
    }
}

fn each_table(
    v: Spot<'_, '_>,
    path: &str,
    issues: &mut Issues,
    mut read: impl FnMut(&DeTable<'_>, Span, &str, &mut Issues) -> Value,
) -> Option<Value> {
    let Some(array) = v.get_ref().as_array() else {
        return wrong(v, &format!("an array of tables, `[[{path}]]`"), path, issues);
    };
    let mut items = vec![];
    for (k, item) in array.iter().enumerate() {
        match item.get_ref().as_table() {
            Some(t) => items.push(read(t, item.span(), &format!("{path}[{k}]"), issues)),
            None => {
                let _: Option<Value> = wrong(item, "a table", path, issues);
            }
        }
    }
    Some(Value::List(items))
}

fn quantity(v: Spot<'_, '_>, want: Dimension, check: Check, path: &str, issues: &mut Issues) -> Option<f64> {
    let span = Some(v.span());
    let x = if let Some(text) = v.get_ref().as_str() {
        match units::parse(text) {
            Ok((x, d, true)) if d == want => x,
            Ok((x, _, false)) => x,
            Ok((_, d, true)) => {
                issues.add(
                    span,
                    format!("`{path}` has a unit of the wrong kind"),
                    format!("this is in {d}, but `{path}` is in {want}"),
                    format!("write it as {}", example(&Kind::Quantity(want))),
                );
                return None;
            }
            Err(e) => {
                let (cause, remedy) = match e {
                    UnitError::NoNumber => ("there is no number here".to_string(), String::new()),
                    UnitError::Unknown(u, hint) => {
                        (format!("`{u}` is not a unit I know"), did_you_mean(hint))
                    }
                    UnitError::Exponent(t) => (format!("`{t}` has an exponent I cannot read"), String::new()),
                };
                let remedy = if remedy.is_empty() {
                    format!("write it as {}", example(&Kind::Quantity(want)))
                } else {
                    remedy
                };
                issues.add(span, format!("`{path}` is not a quantity"), cause, remedy);
                return None;
            }
        }
    } else if let Some(x) = bare_number(v) {
        x
    } else {
        return wrong(v, &format!("a quantity like {}", example(&Kind::Quantity(want))), path, issues);
    };
    checked(x, check, want, v, path, issues)
}

fn checked(
    x: f64,
    check: Check,
    d: Dimension,
    v: Spot<'_, '_>,
    path: &str,
    issues: &mut Issues,
) -> Option<f64> {
    if check.passes(x) {
        return Some(x);
    }
    let unit = if d == Dimension::NONE { String::new() } else { format!(" {d}") };
    issues.add(
        Some(v.span()),
        format!("`{path}` must be {}", if x.is_finite() { check.words() } else { "finite".into() }),
        format!("this is {x}{unit}"),
        String::new(),
    );
    None
}

fn bare_number(v: Spot<'_, '_>) -> Option<f64> {
    let v = v.get_ref();
    if let Some(f) = v.as_float() {
        return f.as_str().replace('_', "").parse().ok();
    }
    let n = v.as_integer()?;
    i64::from_str_radix(&n.as_str().replace('_', ""), n.radix()).ok().map(|n| n as f64)
}

fn integer(v: Spot<'_, '_>, check: Check, path: &str, issues: &mut Issues) -> Option<i64> {
    let Some(n) = v.get_ref().as_integer() else { return wrong(v, "a whole number", path, issues) };
    match i64::from_str_radix(&n.as_str().replace('_', ""), n.radix()) {
        Ok(n) => checked(n as f64, check, Dimension::NONE, v, path, issues).map(|_| n),
        Err(_) => wrong(v, "a whole number below 2^63", path, issues),
    }
}

fn vector(v: Spot<'_, '_>, d: Dimension, check: Check, path: &str, issues: &mut Issues) -> Option<Value> {
    let ok = v.get_ref().as_array().filter(|a| a.len() == 3);
    let Some(array) = ok else { return wrong(v, "three quantities in brackets", path, issues) };
    let mut x = [0.0; 3];
    let mut complete = true;
    for (k, item) in array.iter().enumerate() {
        match quantity(item, d, check, path, issues) {
            Some(q) => x[k] = q,
            None => complete = false,
        }
    }
    complete.then(|| Value::Vector(vec3(x[0], x[1], x[2])))
}

fn every(v: Spot<'_, '_>, path: &str, issues: &mut Issues) -> Option<Value> {
    const FORMS: &str = "\"cycle\", \"12 per cycle\", \"5 cycles\", \"100 steps\", \"0.1 s\" or \"end\"";
    if let Some(text) = v.get_ref().as_str() {
        let words: Vec<&str> = text.split_whitespace().collect();
        let whole = |s: &str| s.parse::<u64>().ok().filter(|&n| n > 0);
        let found = match words.as_slice() {
            ["cycle"] => Some(Every::Cycles(1)),
            ["step"] => Some(Every::Steps(1)),
            ["end"] => Some(Every::End),
            [n, "steps" | "step"] => whole(n).map(Every::Steps),
            [n, "cycles" | "cycle"] => whole(n).map(Every::Cycles),
            [n, "per", "cycle"] => whole(n).map(Every::PerCycle),
            _ => None,
        };
        if let Some(e) = found {
            return Some(Value::Every(e));
        }
        if !words.first().is_some_and(|w| w.starts_with(|c: char| c.is_ascii_digit() || c == '.')) {
            return wrong(v, FORMS, path, issues);
        }
    }
    quantity(v, Dimension::TIME, Check::Positive, path, issues).map(|t| Value::Every(Every::Time(t)))
}

fn word<'a>(
    v: Spot<'_, '_>,
    words: impl Iterator<Item = &'a str> + Clone,
    path: &str,
    issues: &mut Issues,
) -> Option<Value> {
    let Some(s) = v.get_ref().as_str() else {
        return wrong(v, &format!("one of {}", list(words)), path, issues);
    };
    if words.clone().any(|w| w == s) {
        return Some(Value::Text(s.to_string()));
    }
    issues.add(
        Some(v.span()),
        format!("`{path}` cannot be \"{s}\""),
        format!("expected one of {}", list(words.clone())),
        did_you_mean(nearest(s, words)),
    );
    None
}

fn wrong<T>(v: Spot<'_, '_>, want: &str, path: &str, issues: &mut Issues) -> Option<T> {
    let span = if v.get_ref().is_table() { header(&v.span(), issues) } else { v.span() };
    issues.add(
        Some(span),
        format!("`{path}` is of the wrong type"),
        format!("this is {}, expected {want}", article(v.get_ref().type_str())),
        String::new(),
    );
    None
}

fn unknown(name: &str, span: Span, keys: &[Key], path: &str, issues: &mut Issues) {
    let hint = nearest(name, keys.iter().map(|k| k.name));
    let place = if path.is_empty() { "a case".to_string() } else { format!("`{path}`") };
    let remedy = match hint {
        Some(meant) => {
            issues.broken.push(join(path, meant));
            did_you_mean(hint)
        }
        None => format!("{place} knows {}", list(keys.iter().map(|k| k.name))),
    };
    issues.add(Some(span), format!("unknown key `{name}`"), format!("{place} has no such key"), remedy);
}

/// The first line of a table's span: its header.
fn header(span: &Span, issues: &Issues) -> Span {
    let text = issues.source.get(span.clone()).unwrap_or("");
    let len = text.find('\n').unwrap_or(text.len());
    if text.is_empty() { span.start..span.start } else { span.start..span.start + len.min(60) }
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}

fn did_you_mean(hint: Option<&str>) -> String {
    hint.map(|h| format!("did you mean `{h}`?")).unwrap_or_default()
}

fn list<'a>(words: impl Iterator<Item = &'a str>) -> String {
    words.map(|w| format!("`{w}`")).collect::<Vec<_>>().join(", ")
}

fn article(type_name: &str) -> String {
    let an = type_name.starts_with(['a', 'e', 'i', 'o', 'u']);
    format!("{} {type_name}", if an { "an" } else { "a" })
}

pub(crate) fn first_sentence(doc: &str) -> &str {
    doc.split_once(". ").map_or(doc.trim_end_matches('.'), |(s, _)| s)
}

/// How such a value looks in a case file.
#[must_use]
pub fn example(kind: &Kind) -> String {
    match kind {
        Kind::Quantity(d) | Kind::QuantityOr(d, _) => match *d {
            Dimension::NONE => "0.5".into(),
            Dimension::LENGTH => "\"2 mm\"".into(),
            d => format!("\"1 {d}\""),
        },
        Kind::Integer => "100".into(),
        Kind::Flag => "true".into(),
        Kind::Text => "\"name\"".into(),
        Kind::Word(w) => format!("\"{}\"", w[0]),
        Kind::Choice(m) => format!("\"{}\"", m[0].name),
        Kind::Vector(d) => {
            let e = example(&Kind::Quantity(*d));
            format!("[{e}, {e}, {e}]")
        }
        Kind::Every => "\"cycle\"".into(),
        Kind::List(k) => format!("[{}]", example(k)),
        Kind::Table { keys, shorthand: Some(s) } => {
            keys.iter().find(|k| k.name == *s).map_or("{}".into(), |k| example(&k.kind))
        }
        _ => "{ … }".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use brazilnut_base::keys::Check;

    const INNER: &[Key] = &[
        Key::required("mean", Kind::Quantity(Dimension::LENGTH), "Mean.").with(Check::Positive),
        Key::default("spread", Kind::Quantity(Dimension::NONE), "0.0", "Spread."),
    ];
    const KEYS: &[Key] = &[
        Key::default("title", Kind::Text, "\"untitled\"", "Title."),
        Key::required("frequency", Kind::Quantity(Dimension::FREQUENCY), "Frequency.").with(Check::Positive),
        Key::optional("diameter", Kind::Table { keys: INNER, shorthand: Some("mean") }, "Size."),
        Key::optional("every", Kind::Every, "When."),
        Key::optional("grains", Kind::Tables(INNER), "Grains."),
        Key::optional("at", Kind::Vector(Dimension::LENGTH), "Place."),
    ];

    fn read(text: &str, set: &[&str]) -> Result<Values, Issues> {
        let set: Vec<String> = set.iter().map(|s| (*s).to_string()).collect();
        let source = Source::new(text, &set);
        let mut issues = Issues::new("bed.toml", source.text().to_string());
        let root = source.parse(&mut issues).unwrap_or_default();
        let values = table(&root, 0..source.text().len(), KEYS, "", &mut issues);
        issues.or(values)
    }

    #[test]
    fn shorthand_defaults_and_units() {
        let v = read("frequency = \"10 Hz\"\ndiameter = \"2 mm\"\nevery = \"12 per cycle\"", &[]).unwrap();
        assert_eq!(v.number("frequency"), 10.0);
        assert_eq!(v.table_opt("diameter").unwrap().number("mean"), 2e-3);
        assert_eq!(v.every_opt("every"), Some(Every::PerCycle(12)));
        assert_eq!(v.text("title"), "untitled");
        assert!(!v.is_written("title") && v.is_written("frequency"));
    }

    #[test]
    fn every_error_in_one_go_in_the_order_of_the_text() {
        let text = "freqency = 3\ndiameter = { mean = \"-2 mm\", spred = 1 }\nat = [1, 2]\nevery = \"now\"";
        let issues = read(text, &[]).unwrap_err();
        let said: Vec<&str> = issues.list.iter().map(|i| i.message.as_str()).collect();
        // That the key so misspelt is missing would be said twice.
        assert!(!said.iter().any(|m| m.contains("is missing")), "{said:?}");
        assert!(said[0].contains("unknown key `freqency`"), "{said:?}");
        assert!(said.iter().any(|m| m.contains("`diameter.mean` must be greater than zero")));
        assert!(said.iter().any(|m| m.contains("unknown key `spred`")));
        assert!(said.iter().any(|m| m.contains("`at` is of the wrong type")));
        assert_eq!(said.len(), 5);
        let shown = issues.render(false);
        assert!(shown.contains("bed.toml:1:1") && shown.contains("did you mean `frequency`?"), "{shown}");
    }

    #[test]
    fn overrides_replace_merge_and_are_shown_when_wrong() {
        let text = "frequency = 1\n[[grains]]\nmean = 1\n";
        let v = read(text, &["frequency=20 Hz", "grains.0.mean=\"3 mm\"", "title=a b"]).unwrap();
        assert_eq!(v.number("frequency"), 20.0);
        assert_eq!(v.tables("grains").next().unwrap().number("mean"), 3e-3);
        assert_eq!(v.text("title"), "a b");
        let shown = read(text, &["frequency=20 mm"]).unwrap_err().render(false);
        assert!(shown.contains("wrong kind") && shown.contains("frequency = \"20 mm\""), "{shown}");
        let shown = read(text, &["grains.7.mean=1"]).unwrap_err().render(false);
        assert!(shown.contains("`grains` has no entry `7`"), "{shown}");
    }

    #[test]
    fn resolved_reads_back_to_the_same_values() {
        let text = "frequency = 0.1\ndiameter = \"2 mm\"\nevery = \"5 cycles\"\nat = [1,2,\"3 mm\"]\n[[grains]]\nmean=1\n";
        let v = read(text, &[]).unwrap();
        let w = read(&crate::resolved::write(&v, KEYS), &[]).unwrap();
        let plain = |v: &Values| v.iter().map(|(k, v)| format!("{k} {}", shown(v))).collect::<Vec<_>>();
        fn shown(v: &Value) -> String {
            match v {
                Value::Table(t) => t.iter().map(|(k, v)| format!("{k}={}", shown(v))).collect(),
                Value::List(l) => l.iter().map(shown).collect(),
                v => format!("{v:?}"),
            }
        }
        assert_eq!(plain(&v), plain(&w));
    }
}
