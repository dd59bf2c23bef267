//! Pixels to PNG.

/// A PNG of `width` times `height` pixels, red, green, blue and opacity, row by row from the top.
///
/// # Panics
/// If `pixels` has another length than four times the area.
#[must_use]
pub fn rgba(width: usize, height: usize, pixels: &[u8]) -> Vec<u8> {
    encode(width, height, pixels, png::ColorType::Rgba)
}

/// A PNG of `width` times `height` pixels, red, green and blue, row by row from the top.
///
/// # Panics
/// If `pixels` has another length than three times the area.
#[must_use]
pub fn rgb(width: usize, height: usize, pixels: &[u8]) -> Vec<u8> {
    encode(width, height, pixels, png::ColorType::Rgb)
}

fn encode(width: usize, height: usize, pixels: &[u8], colour: png::ColorType) -> Vec<u8> {
    let mut out = vec![];
    let mut encoder = png::Encoder::new(&mut out, width as u32, height as u32);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    // Only a wrong length can fail: memory takes every write.
    let written = encoder.write_header().and_then(|mut w| w.write_image_data(pixels));
    written.expect("as many pixels as the size says");
    out
}
