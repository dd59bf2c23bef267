//! Any bytes as a checkpoint of a run: read or refused. Never a panic, never more memory than the limits allow.

#![no_main]

use brazilnut_sim::State;
use brazilnut_store::checkpoint::{Limits, decode, inspect};
use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};

const LIMITS: Limits = Limits { file: 1 << 20, state: 1 << 22 };

/// Bytes of the frame before the header, and of the hash at the end (docs/checkpoint-format.md).
const FRAME: usize = 32;

/// Header and state of a checkpoint, if `bytes` has the shape of one.
fn parts(bytes: &[u8]) -> Option<(&[u8], Vec<u8>)> {
    let length = u32::from_le_bytes(bytes.get(12..16)?.try_into().ok()?) as usize;
    let header = bytes.get(FRAME..FRAME.checked_add(length)?)?;
    let body = bytes.get(FRAME + length..bytes.len().checked_sub(FRAME)?)?;
    Some((header, zstd::bulk::decompress(body, LIMITS.state as usize).ok()?))
}

/// A file with a valid frame, length and hash around `header` and `state`.
fn whole(header: &[u8], state: &[u8]) -> Vec<u8> {
    let body = zstd::bulk::compress(state, 1).expect("memory");
    let mut bytes = b"\x89BZN\r\n\x1a\n".to_vec();
    bytes.extend_from_slice(&1_u32.to_le_bytes());
    bytes.extend_from_slice(&(header.len() as u32).to_le_bytes());
    bytes.extend_from_slice(&(body.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&(state.len() as u64).to_le_bytes());
    bytes.extend_from_slice(header);
    bytes.extend_from_slice(&body);
    let hash = blake3::hash(&bytes);
    bytes.extend_from_slice(hash.as_bytes());
    bytes
}

// Mutated bytes fail the hash; so three times in four the state inside is mutated, and the file made whole again.
fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    if !seed.is_multiple_of(4)
        && let Some((header, mut state)) = parts(&data[..size])
    {
        let length = state.len();
        state.resize(length + 256, 0);
        let mutated = fuzzer_mutate(&mut state, length, length + 256);
        let bytes = whole(header, &state[..mutated]);
        if bytes.len() <= max_size {
            data[..bytes.len()].copy_from_slice(&bytes);
            return bytes.len();
        }
    }
    fuzzer_mutate(data, size, max_size)
});

fuzz_target!(|bytes: &[u8]| {
    let _ = inspect(bytes, LIMITS);
    let _ = decode::<State>(bytes, LIMITS);
});
