//! The bytes of a checkpoint.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::{self, Read, Write};

/// First bytes of every checkpoint; as in PNG, the line ends and the control
/// character show up a transfer that took the file for text.
const MAGIC: [u8; 8] = *b"\x89BZN\r\n\x1a\n";
/// Version of the format that is written and the newest that is read.
pub const VERSION: u32 = 1;
/// Bytes before the header's text: magic, version, three lengths.
const PREFIX: usize = 8 + 4 + 4 + 8 + 8;
/// Bytes of the hash at the end.
const HASH: usize = 32;
/// Fast, and within a few per cent of the densest levels on doubles.
const ZSTD_LEVEL: i32 = 1;
/// Nesting beyond this is no state of ours; the stack stays small.
const DEPTH: usize = 64;

/// What a checkpoint says about itself, readable without its state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// What the state belongs to: the model's name.
    pub what: String,
    /// Number of the step.
    pub step: u64,
    /// Time, s.
    pub time: f64,
    /// Hash of the resolved case.
    pub case_hash: String,
    /// Version of the program that wrote it.
    pub code_version: String,
}

/// How much a checkpoint may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the file.
    pub file: u64,
    /// Bytes of the state after decompression.
    pub state: u64,
}

impl Default for Limits {
    /// Far above any bed that fits a workstation.
    fn default() -> Self {
        Self { file: 16 << 30, state: 64 << 30 }
    }
}

/// The bytes of a checkpoint.
///
/// # Errors
/// If the state or the header cannot be expressed (a time that is not a number).
pub fn encode<T: Serialize>(header: &Header, state: &T) -> Result<Vec<u8>, String> {
    if !header.time.is_finite() {
        return Err(format!("time {} cannot be stored", header.time));
    }
    let text = serde_json::to_vec(header).map_err(|e| e.to_string())?;
    let mut out = vec![0; PREFIX];
    out.extend_from_slice(&text);
    let body = out.len();
    let mut counter =
        Counter { inner: zstd::Encoder::new(out, ZSTD_LEVEL).map_err(|e| e.to_string())?, bytes: 0 };
    let mut writer = rmp_serde::Serializer::new(&mut counter).with_struct_map();
    state.serialize(&mut writer).map_err(|e| format!("the state cannot be stored: {e}"))?;
    let raw = counter.bytes;
    let mut out = counter.inner.finish().map_err(|e| e.to_string())?;
    let compressed = (out.len() - body) as u64;
    let prefix = [
        MAGIC.as_slice(),
        &VERSION.to_le_bytes(),
        &(text.len() as u32).to_le_bytes(),
        &compressed.to_le_bytes(),
        &raw.to_le_bytes(),
    ]
    .concat();
    out[..PREFIX].copy_from_slice(&prefix);
    let hash = blake3::hash(&out);
    out.extend_from_slice(hash.as_bytes());
    Ok(out)
}

/// The header and state in the bytes of a checkpoint.
///
/// # Errors
/// Why the bytes are refused, as a sentence without a stop.
pub fn decode<T: DeserializeOwned>(bytes: &[u8], limits: Limits) -> Result<(Header, T), String> {
    let parts = split(bytes, limits)?;
    // Past the hash the content is as written, unless someone made the file by
    // hand: everything below is bounded by the limits all the same.
    let header = read_header(parts.header)?;
    let decoder =
        zstd::Decoder::with_buffer(parts.body).map_err(|e| format!("its state cannot be opened: {e}"))?;
    let mut body = decoder.single_frame().take(parts.raw);
    let mut reader = rmp_serde::Deserializer::new(io::BufReader::with_capacity(1 << 16, &mut body));
    reader.set_max_depth(DEPTH);
    let state =
        T::deserialize(&mut reader).map_err(|e| format!("its state does not fit this version: {e}"))?;
    let unread = reader.get_ref().buffer().len() as u64 + body.limit();
    // One byte more than declared would be too many as well.
    let beyond = body.into_inner().read(&mut [0]).map_err(|e| format!("its state cannot be read: {e}"))?;
    if unread > 0 || beyond > 0 {
        return Err("its state does not end where it should".into());
    }
    Ok((header, state))
}

/// The header in the bytes of a checkpoint, the whole of which is checked.
///
/// # Errors
/// Why the bytes are refused, as a sentence without a stop.
pub fn inspect(bytes: &[u8], limits: Limits) -> Result<Header, String> {
    read_header(split(bytes, limits)?.header)
}

struct Parts<'a> {
    header: &'a [u8],
    body: &'a [u8],
    raw: u64,
}

/// Finds the parts and checks the hash over all of them.
fn split(bytes: &[u8], limits: Limits) -> Result<Parts<'_>, String> {
    let start = &bytes[..bytes.len().min(MAGIC.len())];
    if start != &MAGIC[..start.len()] {
        return Err("it is not a checkpoint of brazilnut".into());
    }
    let truncated = |whole: u64| format!("it is cut off: {} of {whole} bytes", bytes.len());
    if bytes.len() < PREFIX + HASH {
        return Err(truncated((PREFIX + HASH) as u64));
    }
    let (head, rest) = bytes.split_at(PREFIX);
    let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    let long = |at: usize| u64::from(word(at)) | u64::from(word(at + 4)) << 32;
    let (version, text, compressed, raw) = (word(8), u64::from(word(12)), long(16), long(24));
    if version != VERSION {
        let age = if version > VERSION { "a newer version of brazilnut" } else { "an unknown version" };
        return Err(format!("it is in format {version}, of {age}; this one reads format {VERSION}"));
    }
    let whole = text.saturating_add(compressed).saturating_add((PREFIX + HASH) as u64);
    if (bytes.len() as u64) < whole {
        return Err(truncated(whole));
    }
    if bytes.len() as u64 > whole {
        return Err(format!("it has {} bytes too many", bytes.len() as u64 - whole));
    }
    let (content, hash) = bytes.split_at(bytes.len() - HASH);
    if blake3::hash(content).as_bytes() != hash {
        return Err("it is damaged: its hash does not match its content".into());
    }
    if raw > limits.state {
        return Err(format!("its state of {raw} bytes exceeds the limit of {}", limits.state));
    }
    // `text` is no longer than the file.
    let (header, body) = rest[..rest.len() - HASH].split_at(text as usize);
    Ok(Parts { header, body, raw })
}

fn read_header(text: &[u8]) -> Result<Header, String> {
    serde_json::from_slice(text).map_err(|e| format!("its header cannot be read: {e}"))
}

/// Counts what passes through.
struct Counter<W> {
    inner: W,
    bytes: u64,
}

impl<W: Write> Write for Counter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let n = self.inner.write(bytes)?;
        self.bytes += n as u64;
        Ok(n)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}
