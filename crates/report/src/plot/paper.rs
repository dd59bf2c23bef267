//! The sheet on which a plot is drawn: SVG text under construction.

use crate::text::escape;
use std::fmt::Write as _;

/// Size of tick labels and legends, px.
pub(crate) const SMALL: f64 = 12.0;
/// Size of axis labels, px.
pub(crate) const LABEL: f64 = 13.0;
/// Size of the title, px.
pub(crate) const TITLE: f64 = 14.5;

/// Light paper, and dark where the reader prefers it on a screen; print is always light.
const STYLE: &str = ".bn{font-family:'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif}\
.bn text{fill:#1f2328}.bn .paper{fill:#fff}.bn .ink{stroke:#1f2328;fill:none}.bn .solid{fill:#1f2328}\
.bn .grid{stroke:#e6e8eb;fill:none}.bn .legend{fill:#fff;fill-opacity:.86}\
.bn .halo{stroke:#fff;fill:none;stroke-opacity:.75}\
@media screen and (prefers-color-scheme:dark){.bn text{fill:#e3e6ea}.bn .paper{fill:#16191d}\
.bn .ink{stroke:#e3e6ea}.bn .solid{fill:#e3e6ea}.bn .grid{stroke:#2b3036}.bn .legend{fill:#16191d}\
.bn .halo{stroke:#16191d}.bn .data{filter:brightness(1.3)}}";

/// Where a text is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hold {
    Start,
    Middle,
    End,
}

impl Hold {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// SVG text under construction.
pub(crate) struct Paper {
    out: String,
}

impl Paper {
    /// A white sheet; `title` is what a screen reader says.
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        let mut paper = Self { out: String::new() };
        paper.put(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"bn\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             width=\"{width:.0}\" height=\"{height:.0}\" role=\"img\"><title>{}</title><style>{STYLE}</style>\
             <rect class=\"paper\" width=\"{width:.0}\" height=\"{height:.0}\"/>",
            escape(title)
        ));
        paper
    }

    /// Raw SVG.
    pub fn put(&mut self, svg: std::fmt::Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = self.out.write_fmt(svg);
        self.out.push('\n');
    }

    /// Text with its baseline at `y`.
    pub fn text(&mut self, x: f64, y: f64, size: f64, hold: Hold, text: &str) {
        let (hold, text) = (hold.name(), escape(text));
        self.put(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{hold}\">{text}</text>"
        ));
    }

    /// Bold text held at its start.
    pub fn bold(&mut self, x: f64, y: f64, size: f64, text: &str) {
        let text = escape(text);
        self.put(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" font-weight=\"600\">{text}</text>"
        ));
    }

    /// Text read from below, held in its middle.
    pub fn upward(&mut self, x: f64, y: f64, size: f64, text: &str) {
        let text = escape(text);
        self.put(format_args!(
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" font-size=\"{size}\" text-anchor=\"middle\">{text}</text>"
        ));
    }

    /// Straight pieces, all of one class and width.
    pub fn strokes(&mut self, class: &str, width: f64, pieces: impl Iterator<Item = [f64; 4]>) {
        let mut d = String::new();
        for [x0, y0, x1, y1] in pieces {
            let _ = write!(d, "M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}");
        }
        if !d.is_empty() {
            self.put(format_args!("<path class=\"{class}\" stroke-width=\"{width}\" d=\"{d}\"/>"));
        }
    }

    /// Opens a group that shows nothing outside the rectangle.
    pub fn clip(&mut self, x: f64, y: f64, width: f64, height: f64) {
        // Nested sheets clip by themselves: no name that could collide in a page of many plots.
        self.put(format_args!(
            "<svg class=\"data\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" viewBox=\"{x:.1} {y:.1} {width:.1} {height:.1}\">"
        ));
    }

    /// Closes what [`Paper::clip`] opened.
    pub fn unclip(&mut self) {
        self.out.push_str("</svg>\n");
    }

    /// The finished SVG.
    pub fn finish(mut self) -> String {
        self.out.push_str("</svg>\n");
        self.out
    }
}

/// A path through points; NaN places break it.
pub(crate) fn path(points: &[[f64; 2]]) -> String {
    let mut d = String::new();
    let mut pen_down = false;
    for [x, y] in points {
        if x.is_finite() && y.is_finite() {
            let _ = write!(d, "{}{x:.1} {y:.1}", if pen_down { 'L' } else { 'M' });
            pen_down = true;
        } else {
            pen_down = false;
        }
    }
    d
}
