//! What a plot shows, apart from how it is drawn: models, observers and
//! studies hand over figures, the report draws them.

use serde::{Deserialize, Serialize};

/// One plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// Short title.
    pub title: String,
    /// What is shown, how it was averaged, what to see.
    pub caption: String,
    /// The content.
    pub body: Body,
}

/// Content of a plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Body {
    /// Curves over a common axis.
    Curves {
        /// Horizontal axis.
        x: Axis,
        /// Vertical axis.
        y: Axis,
        /// The curves.
        curves: Vec<Curve>,
    },
    /// A map of values in a plane, with arrows on it; either may be absent.
    Map {
        /// Horizontal axis.
        x: Axis,
        /// Vertical axis.
        y: Axis,
        /// Shading.
        raster: Option<Raster>,
        /// Arrows: start and vector, the vector in `arrow_unit`.
        arrows: Vec<([f64; 2], [f64; 2])>,
        /// Unit of the arrows' lengths.
        arrow_unit: String,
        /// Polylines in the plane (contours, streamlines, outlines).
        lines: Vec<Vec<[f64; 2]>>,
    },
}

/// One axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What is measured.
    pub label: String,
    /// Its unit, `1` if dimensionless.
    pub unit: String,
    /// Logarithmic.
    pub log: bool,
}

impl Axis {
    /// A linear axis.
    #[must_use]
    pub fn linear(label: &str, unit: &str) -> Self {
        Self { label: label.into(), unit: unit.into(), log: false }
    }

    /// A logarithmic axis.
    #[must_use]
    pub fn log(label: &str, unit: &str) -> Self {
        Self { log: true, ..Self::linear(label, unit) }
    }
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Style {
    /// A line.
    Line,
    /// A dashed line: a reference, a theory.
    Dashed,
    /// Points: measurements, published values.
    Points,
}

/// One curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Entry in the legend.
    pub label: String,
    /// Points in order.
    pub points: Vec<[f64; 2]>,
    /// Half-width of the error band (line) or bar (points) at each point; empty if unknown.
    pub error: Vec<f64>,
    /// Line or points.
    pub style: Style,
}

impl Curve {
    /// A line through `points`.
    #[must_use]
    pub fn line(label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { label: label.into(), points, error: vec![], style: Style::Line }
    }

    /// The same curve in another style.
    #[must_use]
    pub fn styled(mut self, style: Style) -> Self {
        self.style = style;
        self
    }
}

/// Values on a regular grid of a plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Raster {
    /// Number of columns and rows.
    pub shape: [usize; 2],
    /// x0, x1, y0, y1.
    pub extent: [f64; 4],
    /// Row by row from the bottom; NaN is left blank.
    pub values: Vec<f64>,
    /// What the shade means.
    pub label: String,
    /// Its unit.
    pub unit: String,
}
