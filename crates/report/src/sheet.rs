//! The start-up sheet: labelled values with a note each, for a terminal and for the report.

use crate::text::escape;
use std::fmt::Write as _;

/// Labelled values in groups, and what to be warned of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sheet {
    /// What the sheet is about.
    pub title: String,
    /// Label, value and note of each line; a line with a label alone starts a group.
    pub rows: Vec<(String, String, String)>,
    /// Sentences; each starts a line of its own.
    pub warnings: Vec<String>,
}

impl Sheet {
    /// An empty sheet.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Adds a line.
    pub fn row(
        &mut self,
        label: impl Into<String>,
        value: impl Into<String>,
        note: impl Into<String>,
    ) -> &mut Self {
        self.rows.push((label.into(), value.into(), note.into()));
        self
    }

    /// Starts a group of lines.
    pub fn group(&mut self, name: impl Into<String>) -> &mut Self {
        self.row(name, "", "")
    }

    /// Adds a warning.
    pub fn warn(&mut self, sentence: impl Into<String>) -> &mut Self {
        self.warnings.push(sentence.into());
        self
    }

    /// Aligned text for a terminal of `width` columns; notes are broken to fit.
    #[must_use]
    pub fn to_text(&self, width: usize) -> String {
        let lines = || self.rows.iter().filter(|r| !is_group(r));
        let longest =
            |f: fn(&(String, String, String)) -> &str| lines().map(|r| columns(f(r))).max().unwrap_or(0);
        // A single long value must not push all notes off the terminal.
        let (label, value) = (longest(|r| &r.0), longest(|r| &r.1).min(width / 3));
        let indent = 2 + label + 2 + value + 2;
        let mut out = String::new();
        if !self.title.is_empty() {
            let _ = writeln!(out, "{}\n{}", self.title, "─".repeat(columns(&self.title).min(width)));
        }
        for row in &self.rows {
            if is_group(row) {
                let gap = if out.is_empty() || out.ends_with("─\n") { "" } else { "\n" };
                let _ = writeln!(out, "{gap}{}", row.0);
                continue;
            }
            let mut line = format!("  {}  {}", pad(&row.0, label), pad(&row.1, value));
            let overlong = columns(&row.1) > value;
            let notes = break_words(&row.2, width.saturating_sub(indent).max(20));
            for (k, note) in notes.iter().enumerate() {
                if k > 0 || overlong {
                    let _ = writeln!(out, "{}", line.trim_end());
                    line = " ".repeat(indent - 2);
                }
                let _ = write!(line, "  {note}");
            }
            let _ = writeln!(out, "{}", line.trim_end());
        }
        if !self.warnings.is_empty() {
            out.push('\n');
        }
        for warning in &self.warnings {
            for (k, line) in break_words(warning, width.saturating_sub(11).max(20)).iter().enumerate() {
                let _ = writeln!(out, "  {}{line}", if k == 0 { "warning: " } else { "         " });
            }
        }
        out
    }

    /// A table for the report.
    #[must_use]
    pub fn to_html(&self) -> String {
        let mut out = String::new();
        if !self.title.is_empty() {
            let _ = writeln!(out, "<h3>{}</h3>", escape(&self.title));
        }
        out.push_str(&warnings(&self.warnings));
        out.push_str("<div class=\"scroll\"><table class=\"sheet\">\n");
        for row in &self.rows {
            let [label, value, note] = [&row.0, &row.1, &row.2].map(|t| escape(t));
            let _ = if is_group(row) {
                writeln!(out, "<tr><th colspan=\"3\" scope=\"rowgroup\">{label}</th></tr>")
            } else {
                writeln!(
                    out,
                    "<tr><td>{label}</td><td class=\"value\">{value}</td><td class=\"note\">{note}</td></tr>"
                )
            };
        }
        out.push_str("</table></div>\n");
        out
    }
}

/// Warnings as a marked list for the report; nothing if there are none.
pub(crate) fn warnings(sentences: &[String]) -> String {
    if sentences.is_empty() {
        return String::new();
    }
    let items: String = sentences.iter().map(|w| format!("<li>{}</li>", escape(w))).collect();
    format!("<ul class=\"warnings\">{items}</ul>\n")
}

fn is_group(row: &(String, String, String)) -> bool {
    row.1.is_empty() && row.2.is_empty()
}

fn columns(text: &str) -> usize {
    text.chars().count()
}

fn pad(text: &str, width: usize) -> String {
    format!("{text}{}", " ".repeat(width.saturating_sub(columns(text))))
}

fn break_words(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if columns(line) + 1 + columns(word) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        let mut s = Sheet::new("wet-bed");
        s.group("grains").row("number", "1350", "").row("mass", "14.1 g", "of which 12.7 g host");
        s.group("shaking").row("Γ", "3.5", "peak acceleration over g");
        s.warn("the step is longer than a fiftieth of the shortest contact <soft>");
        s
    }

    #[test]
    fn columns_line_up() {
        let text = sheet().to_text(46);
        let expected = "\
wet-bed
───────
grains
  number  1350
  mass    14.1 g  of which 12.7 g host

shaking
  Γ       3.5     peak acceleration over g

  warning: the step is longer than a fiftieth
           of the shortest contact <soft>
";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_narrow_terminal_gets_broken_notes() {
        let text = sheet().to_text(38);
        assert!(text.contains("  Γ       3.5     peak acceleration\n                  over g\n"), "{text}");
    }

    #[test]
    fn html_escapes() {
        let html = sheet().to_html();
        assert!(html.contains("&lt;soft&gt;") && !html.contains("<soft>"));
        assert_eq!(html.matches("<tr>").count(), 5);
    }
}
