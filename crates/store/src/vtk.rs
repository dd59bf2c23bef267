//! Grains and fields for ParaView: VTK XML with appended, zlib-compressed blocks.
//!
//! Format: VTK File Formats, "XML File Formats"; every array carries its unit
//! under VTK's own key `UNITS_LABEL`.

use crate::{Array, Data, GrainFrame, StoreError, atomic};
use brazilnut_base::Vec3;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Precision {
    /// 8 bytes: what the run had.
    #[default]
    Double,
    /// 4 bytes: enough for pictures, half the disk.
    Single,
}

/// Values on a regular grid.
#[derive(Clone, Copy, Debug)]
pub struct FieldFrame<'a> {
    /// Time, s.
    pub time: f64,
    /// Number of cells along x, y, z.
    pub cells: [usize; 3],
    /// Corner of the first cell, m.
    pub origin: Vec3,
    /// Edges of a cell, m.
    pub spacing: Vec3,
    /// Arrays with one entry for each cell, x fastest.
    pub cell_data: &'a [Array<'a>],
    /// Arrays with one entry for each corner, x fastest.
    pub point_data: &'a [Array<'a>],
}

/// Bytes before compression in one block: small enough to be read in parts,
/// large enough to compress well.
const BLOCK: usize = 1 << 18;

/// Writes the grains as `.vtp`: one vertex each, with radius and diameter.
///
/// # Errors
/// If the file cannot be written or an array has the wrong length.
pub fn write_grains(path: &Path, frame: &GrainFrame<'_>, precision: Precision) -> Result<(), StoreError> {
    frame.check().map_err(|why| StoreError::content(path, "write", why))?;
    let n = frame.position.len();
    let diameter: Vec<f64> = frame.radius.iter().map(|r| 2.0 * r).collect();
    let mut arrays = vec![
        Array::integers("id", frame.id),
        Array::integers("species", frame.species),
        Array::scalars("radius", "m", frame.radius),
        Array::scalars("diameter", "m", &diameter),
        Array::vectors("velocity", "m/s", frame.velocity),
    ];
    if !frame.angular_velocity.is_empty() {
        arrays.push(Array::vectors("angular_velocity", "rad/s", frame.angular_velocity));
    }
    arrays.extend_from_slice(frame.extra);
    let each: Vec<u64> = (0..n as u64).collect();
    let ends: Vec<u64> = (1..=n as u64).collect();

    let mut file = Document::new("PolyData", precision);
    file.time(frame.time);
    file.open(&format!("Piece NumberOfPoints=\"{n}\" NumberOfVerts=\"{n}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\""));
    file.open("PointData Scalars=\"radius\" Vectors=\"velocity\"");
    arrays.iter().for_each(|a| file.array(a));
    file.close("PointData");
    file.open("Points");
    file.array(&Array::vectors("Points", "m", frame.position));
    file.close("Points");
    file.open("Verts");
    file.array(&Array::integers("connectivity", &each));
    file.array(&Array::integers("offsets", &ends));
    file.close("Verts");
    file.close("Piece");
    file.finish(path)
}

/// Writes fields as `.vti`.
///
/// # Errors
/// If the file cannot be written or an array has the wrong length.
pub fn write_field(path: &Path, frame: &FieldFrame<'_>, precision: Precision) -> Result<(), StoreError> {
    let cells: usize = frame.cells.iter().product();
    let points: usize = frame.cells.iter().map(|n| n + 1).product();
    for (arrays, n, of) in [(frame.cell_data, cells, "cells"), (frame.point_data, points, "points")] {
        if let Some(a) = arrays.iter().find(|a| a.data.len() != n) {
            let why = format!("{} has {} entries for {n} {of}", a.name, a.data.len());
            return Err(StoreError::content(path, "write", why));
        }
    }
    let [nx, ny, nz] = frame.cells;
    let extent = format!("0 {nx} 0 {ny} 0 {nz}");
    let triple = |v: Vec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);

    let mut file = Document::new("ImageData", precision);
    file.attributes(&format!(
        "WholeExtent=\"{extent}\" Origin=\"{}\" Spacing=\"{}\"",
        triple(frame.origin),
        triple(frame.spacing)
    ));
    file.time(frame.time);
    file.open(&format!("Piece Extent=\"{extent}\""));
    for (tag, arrays) in [("PointData", frame.point_data), ("CellData", frame.cell_data)] {
        file.open(tag);
        arrays.iter().for_each(|a| file.array(a));
        file.close(tag);
    }
    file.close("Piece");
    file.finish(path)
}

/// A VTK XML file under construction: the text and the data appended to it.
struct Document {
    kind: &'static str,
    precision: Precision,
    text: String,
    appended: Vec<u8>,
    raw: Vec<u8>,
}

impl Document {
    fn new(kind: &'static str, precision: Precision) -> Self {
        let text = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<{kind}>\n"
        );
        Self { kind, precision, text, appended: vec![], raw: vec![] }
    }

    /// Attributes of the data set itself; directly after `new`.
    fn attributes(&mut self, attributes: &str) {
        self.text.truncate(self.text.len() - 2);
        self.put(format_args!(" {attributes}>\n"));
    }

    fn put(&mut self, text: std::fmt::Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = self.text.write_fmt(text);
    }

    fn open(&mut self, tag: &str) {
        self.put(format_args!("<{tag}>\n"));
    }

    fn close(&mut self, tag: &str) {
        self.put(format_args!("</{tag}>\n"));
    }

    /// The time of the frame, as ParaView looks for it in a single file.
    fn time(&mut self, time: f64) {
        self.put(format_args!(
            "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{time:?}</DataArray></FieldData>\n"
        ));
    }

    fn array(&mut self, array: &Array<'_>) {
        let (float, width): (_, fn(&mut Vec<u8>, f64)) = match self.precision {
            Precision::Double => ("Float64", |out, x| out.extend_from_slice(&x.to_le_bytes())),
            Precision::Single => ("Float32", |out, x| out.extend_from_slice(&(x as f32).to_le_bytes())),
        };
        self.raw.clear();
        let (kind, components) = match array.data {
            Data::Scalars(a) => {
                a.iter().for_each(|x| width(&mut self.raw, *x));
                (float, 1)
            }
            Data::Vectors(a) => {
                a.iter().flat_map(|v| v.to_array()).for_each(|x| width(&mut self.raw, x));
                (float, 3)
            }
            Data::Integers(a) => {
                // VTK keeps its ids and offsets signed.
                a.iter().for_each(|n| self.raw.extend_from_slice(&(*n as i64).to_le_bytes()));
                ("Int64", 1)
            }
        };
        let (name, unit, offset) = (escape(array.name), escape(array.unit), self.appended.len());
        self.put(format_args!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\">\
             <InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{unit}</InformationKey></DataArray>\n"
        ));
        append_compressed(&mut self.appended, &self.raw);
    }

    fn finish(mut self, path: &Path) -> Result<(), StoreError> {
        let kind = self.kind;
        self.put(format_args!("</{kind}>\n<AppendedData encoding=\"raw\">\n_"));
        atomic::write_with(path, |out| {
            out.write_all(self.text.as_bytes())?;
            out.write_all(&self.appended)?;
            out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
        })
    }
}

/// Number of blocks, size of a block, size of the last if it is partial (else 0),
/// compressed sizes, blocks.
fn append_compressed(out: &mut Vec<u8>, raw: &[u8]) {
    let blocks: Vec<Vec<u8>> = raw.chunks(BLOCK).map(deflate).collect();
    let partial = raw.len() % BLOCK;
    let head = [blocks.len(), BLOCK, partial].into_iter().chain(blocks.iter().map(Vec::len));
    head.for_each(|n| out.extend_from_slice(&(n as u64).to_le_bytes()));
    blocks.iter().for_each(|b| out.extend_from_slice(b));
}

fn deflate(raw: &[u8]) -> Vec<u8> {
    // Level 1: grain data hardly shrink further, and frames are written during the run.
    let mut out = ZlibEncoder::new(Vec::new(), Compression::new(1));
    out.write_all(raw).and_then(|()| out.finish()).expect("writing to memory cannot fail")
}

/// Text as XML wants it.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
