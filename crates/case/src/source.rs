//! The text of a case and the overrides laid over it.

use crate::issue::Issues;
use toml::de::{DeTable, DeValue};

/// Largest case file that is read, bytes: a case is written by hand.
pub const MAX_BYTES: usize = 4 << 20;

/// Deepest nesting of brackets that is read; the parser recurses.
const MAX_DEPTH: usize = 64;

/// A case as text: the file, and one line per `--set`.
///
/// The overrides are kept behind the file's text, so that an error in one is
/// shown like an error in the file.
pub struct Source {
    whole: String,
    /// Each override after blanks up to its place in `whole`: its spans then refer to `whole`.
    lines: Vec<String>,
    file: usize,
}

impl Source {
    /// The text of a file and its overrides, each `key.path=value`.
    #[must_use]
    pub fn new(text: &str, overrides: &[String]) -> Self {
        let mut whole = text.to_string();
        let mut lines = vec![];
        for o in overrides {
            if !whole.ends_with('\n') {
                whole.push('\n');
            }
            let line = normal(o);
            lines.push(" ".repeat(whole.len()) + &line);
            whole.push_str(&line);
        }
        Self { whole, lines, file: text.len() }
    }

    /// The text that spans refer to.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.whole
    }

    /// The parsed file with the overrides merged in; `None` if it is not worth reading on.
    pub fn parse(&self, issues: &mut Issues) -> Option<DeTable<'_>> {
        let text = &self.whole[..self.file];
        if text.len() > MAX_BYTES {
            issues.source.clear();
            let cause = format!("{} bytes, the limit is {MAX_BYTES}", text.len());
            issues.add(None, "the case file is too large", cause, "is this a case file?");
            return None;
        }
        if depth(&self.whole) > MAX_DEPTH {
            let cause = format!("more than {MAX_DEPTH} levels of brackets or dots");
            issues.add(None, "the case is nested too deeply", cause, "");
            return None;
        }
        let mut root = read(text, issues);
        for line in &self.lines {
            let before = issues.list.len();
            let laid = read(line, issues);
            if issues.list.len() == before {
                merge(&mut root, laid, issues);
            }
        }
        Some(root)
    }
}

fn read<'a>(text: &'a str, issues: &mut Issues) -> DeTable<'a> {
    let (parsed, errors) = DeTable::parse_recoverable(text);
    for e in errors {
        issues.add(e.span(), "this is not valid TOML", e.message(), "");
    }
    parsed.into_inner()
}

/// `key=word` is read as `key="word"`: the shell has eaten the quotes.
fn normal(line: &str) -> String {
    let Some((key, value)) = line.split_once('=') else { return line.to_string() };
    let (key, value) = (key.trim(), value.trim());
    let plain = format!("{key} = {value}");
    if !value.is_empty() && DeTable::parse(&plain).is_err() && !value.contains(['"', '\n', '\\']) {
        return format!("{key} = \"{value}\"");
    }
    plain
}

/// Lays `over` on `root`: tables merge, an array of tables is entered by
/// number or by `name`, anything else is replaced.
fn merge<'a>(root: &mut DeTable<'a>, over: DeTable<'a>, issues: &mut Issues) {
    for (key, value) in over {
        let name = key.get_ref().clone();
        let Some(old) = root.get_mut(name.as_ref()) else {
            let _ = root.insert(key, value);
            continue;
        };
        match (old.get_mut(), value.get_ref()) {
            (DeValue::Table(t), DeValue::Table(_)) => {
                if let DeValue::Table(o) = value.into_inner() {
                    merge(t, o, issues);
                }
            }
            (DeValue::Array(items), DeValue::Table(_)) => {
                let DeValue::Table(o) = value.into_inner() else { continue };
                for (which, inner) in o {
                    let span = which.span();
                    let found = match which.get_ref().parse::<usize>() {
                        Ok(n) => items.get_mut(n),
                        Err(_) => items.iter_mut().find(|t| {
                            let named = t.get_ref().get("name").and_then(|n| n.get_ref().as_str());
                            named == Some(which.get_ref().as_ref())
                        }),
                    };
                    match (found.map(toml::Spanned::get_mut), inner.into_inner()) {
                        (Some(DeValue::Table(t)), DeValue::Table(o)) => merge(t, o, issues),
                        _ => issues.add(
                            Some(span),
                            format!("`{name}` has no entry `{}`", which.get_ref()),
                            "neither a number nor a name in this list",
                            format!("use `{name}.0.key` or `{name}.NAME.key`"),
                        ),
                    }
                }
            }
            _ => *old = value,
        }
    }
}

/// The largest number of brackets or dots open at once: an upper bound of the
/// recursion depth that ignores strings and comments.
fn depth(text: &str) -> usize {
    let (mut open, mut most) = (0_usize, 0);
    for line in text.lines() {
        let dots = line.bytes().filter(|&b| b == b'.').count();
        for b in line.bytes() {
            match b {
                b'[' | b'{' => open += 1,
                b']' | b'}' => open = open.saturating_sub(1),
                _ => {}
            }
            most = most.max(open);
        }
        if !line.trim_start().starts_with('#') && !line.contains(['"', '\'']) {
            most = most.max(dots);
        }
    }
    most
}
