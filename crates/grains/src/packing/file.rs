//! Positions, radii and velocities from a file: CSV with a header, or extended XYZ.

use super::draft::{check_inside, middle, push};
use super::{Filling, PackingError, largest_overlap};
use crate::Grains;
use brazilnut_base::{Vec3, vec3};

/// Overlap over the smaller radius that a starting state may have: more would throw grains about.
const OVERLAP_LIMIT: f64 = 0.05;

/// One grain of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed {
    /// Centre, m.
    pub position: Vec3,
    /// Radius, m; drawn from the species' distribution if none.
    pub radius: Option<f64>,
    /// Velocity, m/s.
    pub velocity: Vec3,
    /// Name of the species; the first one if none.
    pub species: Option<String>,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Columns that both formats share, by name.
#[derive(Default)]
struct Layout {
    position: [Option<usize>; 3],
    velocity: [Option<usize>; 3],
    radius: Option<(usize, f64)>,
    species: Option<usize>,
}

impl Layout {
    /// Notes that `name` stands in column `at`; false if the name is not known.
    fn note(&mut self, name: &str, at: usize) -> bool {
        match name.trim().to_ascii_lowercase().as_str() {
            "x" => self.position[0] = Some(at),
            "y" => self.position[1] = Some(at),
            "z" => self.position[2] = Some(at),
            "vx" => self.velocity[0] = Some(at),
            "vy" => self.velocity[1] = Some(at),
            "vz" => self.velocity[2] = Some(at),
            "radius" | "r" => self.radius = Some((at, 1.0)),
            "diameter" | "d" => self.radius = Some((at, 0.5)),
            "species" => self.species = Some(at),
            _ => return false,
        }
        true
    }

    fn check(&self, line: usize) -> Result<(), PackingError> {
        match self.position.iter().position(Option::is_none) {
            Some(axis) => Err(fail(line, format!("no column `{}`", ["x", "y", "z"][axis]))),
            None => Ok(()),
        }
    }

    fn grain<'a>(&self, fields: &[&'a str], line: usize) -> Result<Listed, PackingError> {
        let text = |at: usize| -> Result<&'a str, PackingError> {
            fields
                .get(at)
                .map(|f| f.trim())
                .ok_or_else(|| fail(line, format!("column {} is missing", at + 1)))
        };
        let number = |at: usize| -> Result<f64, PackingError> {
            let t = text(at)?;
            t.parse()
                .ok()
                .filter(|x: &f64| x.is_finite())
                .ok_or_else(|| fail(line, format!("`{t}` is not a number")))
        };
        let part = |at: Option<usize>| at.map_or(Ok(0.0), number);
        let [x, y, z] = self.position;
        let [vx, vy, vz] = self.velocity;
        let radius = self.radius.map(|(at, factor)| number(at).map(|v| v * factor)).transpose()?;
        if radius.is_some_and(|r| r <= 0.0) {
            return Err(fail(line, "the radius must be greater than zero".into()));
        }
        Ok(Listed {
            position: vec3(part(x)?, part(y)?, part(z)?),
            radius,
            velocity: vec3(part(vx)?, part(vy)?, part(vz)?),
            species: self.species.map(text).transpose()?.map(str::to_string),
            line,
        })
    }
}

fn fail(line: usize, what: String) -> PackingError {
    PackingError::File { line, what }
}

/// Grains of a CSV text: a header names the columns `x, y, z`, `radius` or `diameter`, `vx, vy, vz`, `species`.
///
/// SI units, lines starting with `#` are skipped, other columns ignored.
///
/// # Errors
/// [`PackingError::File`] with the line.
pub fn read_csv(text: &str) -> Result<Vec<Listed>, PackingError> {
    let mut rows =
        csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let broken = |e: &csv::Error| fail(e.position().map_or(1, |p| p.line() as usize), e.to_string());
    let mut layout = Layout::default();
    for (at, name) in rows.headers().map_err(|e| broken(&e))?.iter().enumerate() {
        let _ = layout.note(name, at);
    }
    layout.check(1)?;
    let mut list = vec![];
    for row in rows.records() {
        let row = row.map_err(|e| broken(&e))?;
        let line = row.position().map_or(0, |p| p.line() as usize);
        list.push(layout.grain(&row.iter().collect::<Vec<_>>(), line)?);
    }
    Ok(list)
}

/// Grains of an extended XYZ text (first frame): `Properties=species:S:1:pos:R:3:radius:R:1:velo:R:3`.
///
/// SI units. Other properties are ignored; `vel`, `velocity` and `velocities` stand for `velo`.
///
/// # Errors
/// [`PackingError::File`] with the line.
pub fn read_extended_xyz(text: &str) -> Result<Vec<Listed>, PackingError> {
    let mut lines = text.lines();
    let count: usize = lines
        .next()
        .and_then(|l| l.trim().parse().ok())
        .ok_or_else(|| fail(1, "the first line must hold the number of grains".into()))?;
    let layout = properties(lines.next().unwrap_or_default())?;
    let mut list = vec![];
    for (i, row) in lines.take(count).enumerate() {
        list.push(layout.grain(&row.split_whitespace().collect::<Vec<_>>(), i + 3)?);
    }
    if list.len() < count {
        return Err(fail(list.len() + 3, format!("{} of {count} grains are missing", count - list.len())));
    }
    Ok(list)
}

/// The columns that the comment line of an extended XYZ file announces.
fn properties(comment: &str) -> Result<Layout, PackingError> {
    let list = comment
        .split_whitespace()
        .find_map(|w| w.strip_prefix("Properties="))
        .ok_or_else(|| fail(2, "no `Properties=` on the second line".into()))?;
    let parts: Vec<&str> = list.trim_matches('"').split(':').collect();
    let (mut layout, mut at) = (Layout::default(), 0);
    for p in parts.chunks(3) {
        let width: usize = p.get(2).and_then(|w| w.parse().ok()).ok_or_else(|| {
            fail(2, format!("`Properties` must be triples name:type:columns, found `{}`", p.join(":")))
        })?;
        let names: &[&str] = match p[0] {
            "pos" => &["x", "y", "z"],
            "velo" | "vel" | "velocity" | "velocities" => &["vx", "vy", "vz"],
            name => &[name],
        };
        for (i, name) in names.iter().enumerate().take(width) {
            let _ = layout.note(name, at + i);
        }
        at += width;
    }
    layout.check(2)?;
    Ok(layout)
}

/// Grains from a list; their number follows from the list, not from the species' counts.
///
/// # Errors
/// [`PackingError`] if a species is not known, or a grain lies outside the cell or deep in another.
pub fn from_list(filling: &Filling, list: &[Listed]) -> Result<Grains, PackingError> {
    let mut grains = Grains::default();
    for g in list {
        let s =
            match &g.species {
                None => 0,
                Some(name) => filling.species.iter().position(|s| s.name == *name).ok_or_else(|| {
                    fail(g.line, format!("`{name}` is not the name of grains in this case"))
                })?,
            };
        let species =
            filling.species.get(s).ok_or_else(|| fail(g.line, "the case names no grains".into()))?;
        species.sizes.check()?;
        let r = g.radius.unwrap_or_else(|| 0.5 * species.sizes.draw(filling.seed, grains.len()));
        let (x, _) = filling.cell.wrap(middle(filling, g.position));
        check_inside(filling, &species.name, grains.len() + 1, x, r)?;
        push(&mut grains, filling, s, r, x, g.velocity);
    }
    match largest_overlap(&filling.cell, &grains) {
        (overlap, Some(pair)) if overlap > OVERLAP_LIMIT => Err(PackingError::Overlap { pair, overlap }),
        _ => Ok(grains),
    }
}
