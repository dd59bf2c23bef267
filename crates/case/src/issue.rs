//! What is wrong with a case, told so that a person can mend it.

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet, renderer::DecorStyle};
use std::fmt;
use std::ops::Range;

/// One thing wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Issue {
    /// What is wrong, one line.
    pub message: String,
    /// Where, in bytes of the source; `None` for the file as a whole.
    pub span: Option<Range<usize>>,
    /// Why: stands at the caret.
    pub cause: String,
    /// What to do.
    pub remedy: String,
}

/// Everything wrong with one case, in the order of the text.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Issues {
    /// Name of the source, for display.
    pub path: String,
    /// The text that the spans refer to (the file, then one line per override).
    pub source: String,
    /// The issues.
    pub list: Vec<Issue>,
    /// Dotted paths of keys whose value could not be used: that they are absent is no news.
    pub broken: Vec<String>,
}

impl Issues {
    /// An empty collection for `source` shown as `path`.
    #[must_use]
    pub fn new(path: &str, source: String) -> Self {
        Self { path: path.into(), source, list: vec![], broken: vec![] }
    }

    /// Whether the key at `path`, or one inside it, has been reported already.
    #[must_use]
    pub fn is_broken(&self, path: &str) -> bool {
        self.broken.iter().any(|b| b.strip_prefix(path).is_some_and(|r| r.is_empty() || r.starts_with('.')))
    }

    /// Adds one.
    pub fn add(
        &mut self,
        span: Option<Range<usize>>,
        message: impl Into<String>,
        cause: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let issue = Issue { message: message.into(), span, cause: cause.into(), remedy: remedy.into() };
        if !self.list.contains(&issue) {
            self.list.push(issue);
        }
    }

    /// True if nothing is wrong.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// `value` if nothing is wrong, else the issues sorted by place.
    ///
    /// # Errors
    /// The issues, if there are any.
    pub fn or<T>(self, value: T) -> Result<T, Self> {
        if self.list.is_empty() { Ok(value) } else { Err(self.sorted()) }
    }

    /// The same in the order of the text.
    #[must_use]
    pub fn sorted(mut self) -> Self {
        self.list.sort_by_key(|i| i.span.as_ref().map_or(usize::MAX, |s| s.start));
        self
    }

    /// The text for a terminal (`colour`) or a log.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        let renderer = renderer.decor_style(DecorStyle::Ascii);
        let mut out = String::new();
        for issue in &self.list {
            let title = Level::ERROR.primary_title(issue.message.as_str());
            let help = (!issue.remedy.is_empty()).then(|| Level::HELP.message(issue.remedy.as_str()));
            let group = match &issue.span {
                Some(span) => {
                    let end = span.end.min(self.source.len());
                    let span = span.start.min(end)..end;
                    let group = title.element(
                        Snippet::source(self.source.as_str())
                            .path(self.path.as_str())
                            .fold(true)
                            .annotation(AnnotationKind::Primary.span(span).label(issue.cause.as_str())),
                    );
                    match help {
                        Some(h) => group.element(h),
                        None => group,
                    }
                }
                None => {
                    let note = format!("{}: {}", self.path, issue.cause);
                    let group = title.element(Level::NOTE.message(note));
                    let group = match help {
                        Some(h) => group.element(h),
                        None => group,
                    };
                    out.push_str(&renderer.render(&[group]));
                    out.push_str("\n\n");
                    continue;
                }
            };
            out.push_str(&renderer.render(&[group]));
            out.push_str("\n\n");
        }
        let n = self.list.len();
        out.push_str(&format!(
            "{n} error{} in {}; nothing was run\n",
            if n == 1 { "" } else { "s" },
            self.path
        ));
        out
    }
}

impl fmt::Display for Issues {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Issues {}
