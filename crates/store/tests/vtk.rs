//! The VTK files, read back by an independent parser of their text and blocks.

use brazilnut_base::{Cell, Side, Vec3, vec3};
use brazilnut_store::vtk::{FieldFrame, Precision, write_field, write_grains};
use brazilnut_store::{Array, GrainFrame};
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Every `DataArray` of the file as (type, components, raw bytes).
fn arrays(path: &Path) -> BTreeMap<String, (String, usize, Vec<u8>)> {
    let bytes = std::fs::read(path).unwrap();
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let start = bytes.windows(mark.len()).position(|w| w == mark).unwrap() + mark.len();
    let text = std::str::from_utf8(&bytes[..start]).unwrap();
    assert!(bytes.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
    text.lines()
        .filter(|l| l.contains("format=\"appended\""))
        .map(|line| {
            let get = |key: &str| {
                let rest = line.split_once(&format!(" {key}=\"")).unwrap().1;
                rest.split_once('"').unwrap().0.to_string()
            };
            let offset: usize = get("offset").parse().unwrap();
            (
                get("Name"),
                (get("type"), get("NumberOfComponents").parse().unwrap(), blocks(&bytes[start + offset..])),
            )
        })
        .collect()
}

fn blocks(bytes: &[u8]) -> Vec<u8> {
    let word = |k: usize| u64::from_le_bytes(bytes[8 * k..8 * k + 8].try_into().unwrap()) as usize;
    let (count, size, partial) = (word(0), word(1), word(2));
    let mut at = 8 * (3 + count);
    let mut out = vec![];
    for k in 0..count {
        let before = out.len();
        flate2::read::ZlibDecoder::new(&bytes[at..at + word(3 + k)]).read_to_end(&mut out).unwrap();
        let expected = if k + 1 == count && partial > 0 { partial } else { size };
        assert_eq!(out.len() - before, expected);
        at += word(3 + k);
    }
    out
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks(8).map(|c| f64::from_le_bytes(c.try_into().unwrap())).collect()
}

fn cell() -> Cell {
    Cell { size: vec3(1.0, 1.0, 1.0), sides: [Side::Periodic, Side::Walls, Side::Walls] }
}

#[test]
fn grains_read_back() {
    // Enough grains for several blocks of 256 KiB.
    let n = 40_000_usize;
    let position: Vec<Vec3> = (0..n).map(|k| vec3(k as f64, 0.1 * k as f64, -1.0 / (k + 1) as f64)).collect();
    let radius: Vec<f64> = (0..n).map(|k| 1e-3 + 1e-9 * k as f64).collect();
    let id: Vec<u64> = (0..n as u64).rev().collect();
    let heat = vec![7.0; n];
    let frame = GrainFrame {
        step: 3,
        time: 0.25,
        cell: &cell(),
        species_names: &["host".to_string()],
        id: &id,
        species: &vec![0; n],
        position: &position,
        velocity: &position,
        angular_velocity: &[],
        radius: &radius,
        extra: &[Array::scalars("heat <&\">", "J", &heat)],
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("g.vtp");
    write_grains(&path, &frame, Precision::Double).unwrap();
    let found = arrays(&path);
    let (kind, components, bytes) = &found["Points"];
    assert_eq!((kind.as_str(), *components), ("Float64", 3));
    assert_eq!(doubles(bytes), position.iter().flat_map(|v| v.to_array()).collect::<Vec<_>>());
    assert_eq!(doubles(&found["diameter"].2), radius.iter().map(|r| 2.0 * r).collect::<Vec<_>>());
    assert_eq!(doubles(&found["heat &lt;&amp;&quot;&gt;"].2), heat);
    assert_eq!(found["id"].2[..8], (n as u64 - 1).to_le_bytes());
    assert_eq!(found["offsets"].2[..8], 1_u64.to_le_bytes());

    write_grains(&path, &frame, Precision::Single).unwrap();
    let (kind, _, bytes) = &arrays(&path)["radius"];
    assert_eq!((kind.as_str(), bytes[..4].try_into().unwrap()), ("Float32", 1e-3_f32.to_le_bytes()));
}

#[test]
fn fields_read_back_and_lengths_are_checked() {
    let pressure: Vec<f64> = (0..24).map(f64::from).collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("f.vti");
    let mut frame = FieldFrame {
        time: 1.0,
        cells: [2, 3, 4],
        origin: Vec3::ZERO,
        spacing: vec3(0.5, 0.5, 0.25),
        cell_data: &[Array::scalars("pressure", "Pa", &pressure)],
        point_data: &[],
    };
    write_field(&path, &frame, Precision::Double).unwrap();
    assert_eq!(doubles(&arrays(&path)["pressure"].2), pressure);
    let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
    assert!(text.contains("<ImageData WholeExtent=\"0 2 0 3 0 4\""), "{text}");
    frame.cells = [2, 3, 5];
    let error = write_field(&path, &frame, Precision::Double).unwrap_err().to_string();
    assert!(error.contains("pressure has 24 entries for 30 cells"), "{error}");
}
