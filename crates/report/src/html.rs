//! The report: one HTML file that needs nothing else.

use crate::plot::{ColourScale, scale_bar};
use crate::sheet::{self, Sheet};
use crate::text::escape;
use base64::Engine as _;
use brazilnut_base::Table;
use brazilnut_base::figure::Figure;
use std::fmt::Write as _;

const STYLE: &str = include_str!("report.css");

/// One piece of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A paragraph of plain text.
    Paragraph(String),
    /// Text kept as it is: commands, a citation.
    Verbatim(String),
    /// A table of texts.
    Table {
        /// Head of each column.
        columns: Vec<String>,
        /// The rows.
        rows: Vec<Vec<String>>,
        /// What it shows; may be empty.
        caption: String,
    },
    /// Labelled values.
    Sheet(Sheet),
    /// Plots side by side where there is room.
    Figures(Vec<Figure>),
    /// Pictures side by side where there is room.
    Images(Vec<Image>),
    /// Sentences that must be noticed.
    Warnings(Vec<String>),
}

/// A picture with its caption.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The PNG file.
    pub png: Vec<u8>,
    /// What it shows.
    pub caption: String,
    /// What its shades mean, if they show values.
    pub scale: Option<ColourScale>,
}

impl Image {
    /// A picture whose colours need no scale.
    #[must_use]
    pub fn new(png: Vec<u8>, caption: impl Into<String>) -> Self {
        Self { png, caption: caption.into(), scale: None }
    }
}

impl Content {
    /// A table of numbers, six digits each, with units in the head; a single row is stood upright.
    #[must_use]
    pub fn numbers(table: &Table, caption: impl Into<String>) -> Self {
        if let [row] = &table.rows[..] {
            return upright(table, row, caption.into());
        }
        let columns =
            table.columns.iter().map(|c| crate::text::labelled(&c.name, &crate::text::unit(&c.unit)));
        let number = |x: &f64| crate::text::significant(*x, 6);
        let rows = table.rows.iter().map(|r| r.iter().map(number).collect()).collect();
        Self::Table { columns: columns.collect(), rows, caption: caption.into() }
    }
}

/// What the name of a column may end in that belongs to the quantity of another column.
const ABOUT: [(&str, &str); 3] =
    [("_error", "error"), ("_correlation_time", "correlation time"), ("_steady_from", "steady from")];

/// One line per quantity: its value, and beside it what other columns say about it.
fn upright(table: &Table, row: &[f64], caption: String) -> Content {
    let find = |name: &str| table.columns.iter().position(|c| c.name == name);
    let about = |name: &str| {
        ABOUT.iter().any(|(tail, _)| name.strip_suffix(tail).is_some_and(|stem| find(stem).is_some()))
    };
    let value = |k: usize| {
        let (unit, size) = crate::text::readable_unit(&table.columns[k].unit, row[k].abs());
        let unit = if unit == "1" { String::new() } else { unit };
        if row[k].is_nan() {
            return "–".to_string();
        }
        format!("{} {unit}", crate::text::significant(row[k] / size, 6)).trim_end().to_string()
    };
    let quantities: Vec<usize> =
        (0..table.columns.len()).filter(|&k| !about(&table.columns[k].name)).collect();
    let beside = |k: usize, tail: &str| find(&format!("{}{tail}", table.columns[k].name));
    let tails: Vec<_> =
        ABOUT.iter().filter(|t| quantities.iter().any(|&k| beside(k, t.0).is_some())).collect();
    let line = |&k: &usize| {
        let name = table.columns[k].name.replace('_', " ");
        let others = tails.iter().map(|t| beside(k, t.0).map_or(String::new(), value));
        [name, value(k)].into_iter().chain(others).collect()
    };
    let columns = ["quantity", "value"].into_iter().chain(tails.iter().map(|t| t.1));
    Content::Table {
        columns: columns.map(String::from).collect(),
        rows: quantities.iter().map(line).collect(),
        caption,
    }
}

/// A report under construction.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    title: String,
    subtitle: String,
    sections: Vec<(String, Vec<Content>)>,
}

impl Report {
    /// An empty report.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), subtitle: String::new(), sections: vec![] }
    }

    /// The line under the title: model, version, date.
    #[must_use]
    pub fn subtitle(mut self, text: impl Into<String>) -> Self {
        self.subtitle = text.into();
        self
    }

    /// Adds a section; one without content is left out.
    #[must_use]
    pub fn section(mut self, title: impl Into<String>, content: Vec<Content>) -> Self {
        if !content.is_empty() {
            self.sections.push((title.into(), content));
        }
        self
    }

    /// The whole page.
    #[must_use]
    pub fn to_html(&self) -> String {
        let title = escape(&self.title);
        let mut out = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n"
        );
        if !self.subtitle.is_empty() {
            let _ = writeln!(out, "<p class=\"subtitle\">{}</p>", escape(&self.subtitle));
        }
        out.push_str("<nav>");
        for (k, (name, _)) in self.sections.iter().enumerate() {
            let _ = write!(out, "<a href=\"#s{k}\">{}</a> ", escape(name));
        }
        out.push_str("</nav>\n</header>\n<main>\n");
        for (k, (name, content)) in self.sections.iter().enumerate() {
            let _ = writeln!(out, "<section id=\"s{k}\">\n<h2>{}</h2>", escape(name));
            content.iter().for_each(|c| push(&mut out, c));
            out.push_str("</section>\n");
        }
        out.push_str("</main>\n</body>\n</html>\n");
        out
    }
}

fn push(out: &mut String, content: &Content) {
    // Writing to a String cannot fail.
    let _ = match content {
        Content::Paragraph(text) => writeln!(out, "<p>{}</p>", escape(text)),
        Content::Verbatim(text) => writeln!(out, "<pre>{}</pre>", escape(text)),
        Content::Table { columns, rows, caption } => {
            push_table(out, columns, rows, caption);
            Ok(())
        }
        Content::Sheet(sheet) => out.write_str(&sheet.to_html()),
        Content::Warnings(sentences) => out.write_str(&sheet::warnings(sentences)),
        Content::Figures(figures) => {
            out.push_str("<div class=\"figures\">\n");
            for figure in figures {
                let _ = writeln!(
                    out,
                    "<figure>\n{}{}</figure>",
                    crate::plot::svg(figure),
                    caption_of(&figure.caption)
                );
            }
            writeln!(out, "</div>")
        }
        Content::Images(images) => {
            out.push_str("<div class=\"images\">\n");
            for image in images {
                let data = base64::engine::general_purpose::STANDARD.encode(&image.png);
                let (alt, caption) = (escape(&image.caption), caption_of(&image.caption));
                let scale = image.scale.as_ref().map_or(String::new(), scale_bar);
                let _ = writeln!(
                    out,
                    "<figure>\n<img alt=\"{alt}\" src=\"data:image/png;base64,{data}\">{scale}{caption}</figure>"
                );
            }
            writeln!(out, "</div>")
        }
    };
}

fn caption_of(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("<figcaption>{}</figcaption>", escape(text)) }
}

fn push_table(out: &mut String, columns: &[String], rows: &[Vec<String>], caption: &str) {
    out.push_str("<div class=\"scroll\"><table>\n");
    if !caption.is_empty() {
        let _ = writeln!(out, "<caption>{}</caption>", escape(caption));
    }
    // A column is set as numbers if all its cells are.
    let numeric: Vec<bool> =
        (0..columns.len()).map(|k| rows.iter().all(|r| r.get(k).is_none_or(|c| is_number(c)))).collect();
    let class = |k: usize| if numeric.get(k) == Some(&true) { " class=\"number\"" } else { "" };
    let cells = |out: &mut String, tag: &str, texts: &[String]| {
        out.push_str("<tr>");
        for (k, text) in texts.iter().enumerate() {
            let _ = write!(out, "<{tag}{}>{}</{tag}>", class(k), escape(text));
        }
        out.push_str("</tr>\n");
    };
    out.push_str("<thead>");
    cells(out, "th", columns);
    out.push_str("</thead>\n<tbody>\n");
    rows.iter().for_each(|r| cells(out, "td", r));
    out.push_str("</tbody>\n</table></div>\n");
}

/// True for text that begins as a number does, and for an empty or absent value.
fn is_number(text: &str) -> bool {
    let text = text.trim_start_matches(['−', '-', '+', '±', '<', '>', '≈', ' ']);
    text.is_empty() || matches!(text, "–" | "NaN" | "∞") || text.starts_with(|c: char| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> Report {
        let table = Content::Table {
            columns: vec!["what".into(), "energy".into()],
            rows: vec![vec!["shaker".into(), "1.25 J".into()], vec!["<b>".into(), "−0.5 J".into()]],
            caption: String::new(),
        };
        Report::new("Bed <1>")
            .subtitle("dry & shaken")
            .section("Ledger", vec![table])
            .section("Nothing", vec![])
            .section("Pictures", vec![Content::Images(vec![Image::new(vec![1, 2, 3], "\"t\"")])])
    }

    #[test]
    fn needs_nothing_from_outside_and_escapes() {
        let html = report().to_html();
        for outside in ["http:", "https:", "src=\"/", "@import", "url(", "<script", "<b>", "<link"] {
            assert!(!html.contains(outside), "{outside}");
        }
        assert!(html.contains("<title>Bed &lt;1&gt;</title>") && html.contains("alt=\"&quot;t&quot;\""));
        assert!(html.contains("data:image/png;base64,AQID"));
        assert!(!html.contains("Nothing"), "a section without content is left out");
    }

    #[test]
    fn columns_of_numbers_are_set_as_numbers() {
        let html = report().to_html();
        assert!(html.contains("<th>what</th><th class=\"number\">energy</th>"), "{html}");
        assert!(html.contains("<td class=\"number\">−0.5 J</td>"));
    }

    #[test]
    fn a_single_row_stands_upright() {
        let mut t =
            Table::new(&[("gap", "m"), ("gap_error", "m"), ("gap_steady_from", "s"), ("cycles", "1")]);
        t.rows = vec![vec![0.0012, 3e-5, f64::NAN, 40.0]];
        let Content::Table { columns, rows, .. } = Content::numbers(&t, "") else { panic!("a table") };
        assert_eq!(columns, ["quantity", "value", "error", "steady from"]);
        assert_eq!(rows, [vec!["gap", "1.2 mm", "30 µm", "–"], vec!["cycles", "40", "", ""]]);
    }

    #[test]
    fn every_tag_is_closed() {
        let html = report().to_html();
        for tag in ["section", "table", "tr", "td", "th", "figure", "div", "main", "thead", "tbody", "nav"] {
            let opened =
                html.matches(&format!("<{tag}>")).count() + html.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, html.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }
}
