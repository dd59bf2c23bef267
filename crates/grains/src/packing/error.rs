//! Why grains could not be placed, and what to do about it.

use std::fmt;

/// Why grains could not be placed.
#[derive(Clone, Debug, PartialEq)]
pub enum PackingError {
    /// There is no room for all.
    DoesNotFit {
        /// The way of placing.
        method: &'static str,
        /// Number of grains that found a place.
        placed: usize,
        /// Number asked for.
        wanted: usize,
        /// Solids fraction reached, in the part of the cell that was open to them.
        reached: f64,
        /// Solids fraction that all would need.
        needed: f64,
        /// What to do.
        remedy: &'static str,
    },
    /// One grain is wider than the space it may be in.
    TooLarge {
        /// Name of the species.
        species: String,
        /// Diameter, m.
        diameter: f64,
        /// Width of the space, m.
        space: f64,
        /// `x`, `y` or `z`.
        axis: char,
    },
    /// A grain placed by hand or by a file sticks out of the cell or into an inner wall.
    Outside {
        /// Name of the species.
        species: String,
        /// Number of the grain within its species, from 1.
        number: usize,
        /// Centre, m.
        at: [f64; 3],
    },
    /// Two grains placed by hand or by a file overlap.
    Overlap {
        /// Identities of the two.
        pair: [usize; 2],
        /// Overlap over the smaller radius.
        overlap: f64,
    },
    /// A size distribution makes no sense.
    Sizes(String),
    /// A file of positions could not be understood.
    File {
        /// Line, from 1.
        line: usize,
        /// What is wrong with it.
        what: String,
    },
}

impl PackingError {
    /// What is wrong.
    #[must_use]
    pub fn cause(&self) -> String {
        match self {
            Self::DoesNotFit { method, placed, wanted, reached, needed, .. } => format!(
                "only {placed} of {wanted} grains fit by `{method}`: solids fraction {reached:.3} reached, {needed:.3} needed"
            ),
            Self::TooLarge { species, diameter, space, axis } => format!(
                "a grain of `{species}` is {diameter:.4e} m wide, the space along {axis} only {space:.4e} m"
            ),
            Self::Outside { species, number, at: [x, y, z] } => format!(
                "grain {number} of `{species}` at ({x:.5e}, {y:.5e}, {z:.5e}) m does not lie inside the free part of the cell"
            ),
            Self::Overlap { pair: [a, b], overlap } => {
                format!("grains {a} and {b} are placed with an overlap of {overlap:.3} radii")
            }
            Self::Sizes(what) => what.clone(),
            Self::File { line, what } => format!("line {line}: {what}"),
        }
    }

    /// What the user can do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::DoesNotFit { remedy, .. } => (*remedy).to_string(),
            Self::TooLarge { .. } => "use smaller grains, a wider cell, or bound the size distribution".into(),
            Self::Outside { .. } => "keep each centre at least one radius from every wall".into(),
            Self::Overlap { .. } => "move the grains apart or make them smaller".into(),
            Self::Sizes(_) => {
                "give `mean` with `spread` below 1, or `standard_deviation` with `minimum` and `maximum`, or `classes`".into()
            }
            Self::File { .. } => {
                "CSV: header with x, y, z, radius or diameter, optional vx, vy, vz, species; extended XYZ: Properties with pos and radius".into()
            }
        }
    }
}

impl fmt::Display for PackingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n  remedy: {}", self.cause(), self.remedy())
    }
}

impl std::error::Error for PackingError {}
