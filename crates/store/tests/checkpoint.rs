//! Checkpoints come back bit for bit, or not at all.

use brazilnut_store::checkpoint::{
    self, Header, Limits, decode, encode, file_name, inspect, list, load_latest, save,
};
use proptest::prelude::*;
use serde::{Deserialize, Serialize};
use std::fs;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    positions: Vec<[f64; 3]>,
    memory: Vec<(u64, Option<f64>)>,
    name: String,
    seed: u128,
    kind: Kind,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
enum Kind {
    #[default]
    Dry,
    Wet {
        viscosity: f64,
    },
}

const SMALL: Limits = Limits { file: 1 << 20, state: 1 << 20 };

fn header(step: u64) -> Header {
    Header {
        what: "dry".into(),
        step,
        time: step as f64 * 1e-5,
        case_hash: "abc".into(),
        code_version: "0.1.0".into(),
    }
}

fn state() -> State {
    State {
        positions: vec![[1.0, -0.0, f64::MIN_POSITIVE], [0.1, 1e300, f64::NEG_INFINITY]],
        memory: vec![(1 << 60, Some(0.3)), (2, None)],
        name: "bed".into(),
        seed: u128::MAX - 1,
        kind: Kind::Wet { viscosity: 1e-3 },
    }
}

#[test]
fn round_trip() {
    let bytes = encode(&header(7), &state()).unwrap();
    let (h, s) = decode::<State>(&bytes, SMALL).unwrap();
    assert_eq!((h, s), (header(7), state()));
    assert_eq!(inspect(&bytes, SMALL).unwrap(), header(7));
    assert_eq!(bytes, encode(&header(7), &state()).unwrap(), "the same state gives the same bytes");
}

#[test]
fn every_truncation_is_refused_and_said_to_be_one() {
    let bytes = encode(&header(7), &state()).unwrap();
    for n in 0..bytes.len() {
        let why = decode::<State>(&bytes[..n], SMALL).unwrap_err();
        assert!(why.contains("cut off"), "{n}: {why}");
    }
}

#[test]
fn every_bit_flip_is_refused() {
    let mut bytes = encode(&header(7), &state()).unwrap();
    for bit in 0..8 * bytes.len() {
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(decode::<State>(&bytes, SMALL).is_err(), "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
}

/// A checkpoint made by hand with a valid hash.
fn forge(version: u32, text: &[u8], body: &[u8], raw: u64) -> Vec<u8> {
    let mut bytes = b"\x89BZN\r\n\x1a\n".to_vec();
    bytes.extend_from_slice(&version.to_le_bytes());
    bytes.extend_from_slice(&(text.len() as u32).to_le_bytes());
    bytes.extend_from_slice(&(body.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&raw.to_le_bytes());
    bytes.extend_from_slice(text);
    bytes.extend_from_slice(body);
    let hash = blake3::hash(&bytes);
    bytes.extend_from_slice(hash.as_bytes());
    bytes
}

fn refusal<T: serde::de::DeserializeOwned + std::fmt::Debug>(bytes: &[u8]) -> String {
    decode::<T>(bytes, SMALL).unwrap_err()
}

#[test]
fn reasons_are_told_apart() {
    let good = encode(&header(7), &state()).unwrap();
    assert!(
        refusal::<State>(b"PK\x03\x04 something else entirely, and long enough").contains("not a checkpoint")
    );
    let mut long = good.clone();
    long.push(0);
    assert!(refusal::<State>(&long).contains("1 bytes too many"));
    assert!(refusal::<State>(&forge(2, b"", b"", 0)).contains("a newer version"));
    let mut flipped = good;
    let middle = flipped.len() / 2;
    flipped[middle] ^= 1;
    assert!(refusal::<State>(&flipped).contains("damaged"));
}

#[test]
fn a_forged_file_cannot_take_more_than_the_limits() {
    let text = serde_json::to_vec(&header(1)).unwrap();
    // 1 GiB of zeros in some 100 kB: declared honestly, and declared small.
    let bomb = zstd::encode_all(std::io::repeat(0).take_bytes(1 << 30), 1).unwrap();
    assert!(refusal::<Vec<u8>>(&forge(1, &text, &bomb, 1 << 30)).contains("exceeds the limit"));
    assert!(decode::<Vec<u8>>(&forge(1, &text, &bomb, 1 << 20), SMALL).is_err());
    // An array that claims four thousand million entries, a text that claims as much.
    for claim in
        [[0xdd, 0xff, 0xff, 0xff, 0xff], [0xdb, 0xff, 0xff, 0xff, 0xff], [0xc6, 0xff, 0xff, 0xff, 0xff]]
    {
        let body = zstd::encode_all(&claim[..], 1).unwrap();
        assert!(decode::<Vec<f64>>(&forge(1, &text, &body, 5), SMALL).is_err());
        assert!(decode::<String>(&forge(1, &text, &body, 5), SMALL).is_err());
    }
    // Nesting without end must not eat the stack.
    let deep = vec![0x91; 1 << 19];
    let body = zstd::encode_all(&deep[..], 1).unwrap();
    assert!(decode::<serde_json::Value>(&forge(1, &text, &body, 1 << 19), SMALL).is_err());
}

#[test]
fn what_follows_the_state_is_refused() {
    let text = serde_json::to_vec(&header(1)).unwrap();
    let mut raw = rmp_serde::to_vec_named(&state()).unwrap();
    let bytes = forge(1, &text, &zstd::encode_all(&raw[..], 1).unwrap(), raw.len() as u64);
    assert_eq!(decode::<State>(&bytes, SMALL).unwrap().1, state());
    raw.push(0xc0);
    let body = zstd::encode_all(&raw[..], 1).unwrap();
    for declared in [raw.len() as u64, raw.len() as u64 - 1] {
        assert!(refusal::<State>(&forge(1, &text, &body, declared)).contains("does not end where it should"));
    }
}

#[test]
fn a_missing_field_is_refused_by_name() {
    #[derive(Serialize)]
    struct Older {
        positions: Vec<[f64; 3]>,
    }
    let bytes = encode(&header(1), &Older { positions: vec![] }).unwrap();
    assert!(refusal::<State>(&bytes).contains("missing field `memory`"));
}

#[test]
fn the_last_k_are_kept_and_the_newest_whole_one_is_used() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path().join("checkpoints");
    for step in [100, 200, 300, 400] {
        save(&at, &header(step), &State { name: step.to_string(), ..state() }, 3).unwrap();
    }
    let steps: Vec<u64> = list(&at).unwrap().into_iter().map(|f| f.0).collect();
    assert_eq!(steps, [200, 300, 400]);

    let newest = at.join(file_name(400));
    let whole = fs::read(&newest).unwrap();
    fs::write(&newest, &whole[..whole.len() - 1]).unwrap();
    fs::write(at.join(file_name(300)), b"something else").unwrap();
    let loaded = load_latest::<State>(&at, Limits::default()).unwrap();
    assert_eq!((loaded.header.step, loaded.state.name.as_str()), (200, "200"));
    let reasons: Vec<&str> = loaded.refused.iter().map(|r| r.reason.as_str()).collect();
    assert!(
        reasons[0].starts_with("it is cut off") && reasons[1].starts_with("it is not a checkpoint"),
        "{reasons:?}"
    );

    // The run goes on from 200: its next checkpoint must not be thrown out for the damaged later ones.
    save(&at, &header(250), &state(), 1).unwrap();
    let steps: Vec<u64> = list(&at).unwrap().into_iter().map(|f| f.0).collect();
    assert_eq!(steps, [250, 300, 400]);
    assert_eq!(load_latest::<State>(&at, SMALL).unwrap().header.step, 250);

    fs::write(at.join(file_name(250)), b"\x89BZ").unwrap();
    let error = load_latest::<State>(&at, SMALL).unwrap_err().to_string();
    assert!(
        error.contains("none of its checkpoints is whole") && error.contains("step-000000000250"),
        "{error}"
    );
}

#[test]
fn an_empty_or_absent_folder_is_said_to_be() {
    let folder = tempfile::tempdir().unwrap();
    for at in [folder.path().to_path_buf(), folder.path().join("absent")] {
        let error = load_latest::<State>(&at, SMALL).unwrap_err().to_string();
        assert!(error.contains("there is no checkpoint in it"), "{error}");
    }
}

#[test]
fn what_a_killed_process_left_is_swept() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(format!(".{}.tmp", file_name(1))), b"half").unwrap();
    fs::write(folder.path().join("notes.tmp"), b"not ours").unwrap();
    save(folder.path(), &header(2), &state(), 1).unwrap();
    let mut names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["notes.tmp", "step-000000000002.checkpoint"]);
}

#[test]
fn a_failed_save_leaves_the_checkpoints_before_it() {
    let folder = tempfile::tempdir().unwrap();
    save(folder.path(), &header(1), &state(), 1).unwrap();
    // A folder in the way of the temporary file stands for a disk that says no.
    fs::create_dir(folder.path().join(format!(".{}.tmp", file_name(2)))).unwrap();
    assert!(save(folder.path(), &header(2), &state(), 1).is_err());
    assert_eq!(checkpoint::load_latest::<State>(folder.path(), SMALL).unwrap().header.step, 1);
}

/// `io::Read::take` by another name, for a reader that is no slice.
trait TakeBytes: std::io::Read + Sized {
    fn take_bytes(self, n: u64) -> std::io::Take<Self> {
        self.take(n)
    }
}
impl<R: std::io::Read> TakeBytes for R {}

proptest! {
    #[test]
    fn doubles_come_back_bit_for_bit(bits in prop::collection::vec(any::<u64>(), 0..200)) {
        // Signalling NaNs too: their payload must not be made quiet on the way.
        let values: Vec<f64> = bits.iter().map(|b| f64::from_bits(*b)).chain([-0.0, f64::from_bits(0x7ff0_0000_0000_0001)]).collect();
        let bytes = encode(&header(1), &values).unwrap();
        let (_, back) = decode::<Vec<f64>>(&bytes, SMALL).unwrap();
        let same = values.iter().zip(&back).all(|(a, b)| a.to_bits() == b.to_bits());
        prop_assert!(same && values.len() == back.len());
    }

    #[test]
    fn foreign_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        prop_assert!(decode::<State>(&bytes, SMALL).is_err());
    }

    #[test]
    fn a_forged_body_never_panics(body in prop::collection::vec(any::<u8>(), 0..300), squeezed in any::<bool>()) {
        let text = serde_json::to_vec(&header(1)).unwrap();
        let raw = body.len() as u64;
        let body = if squeezed { zstd::encode_all(&body[..], 1).unwrap() } else { body };
        // Chance does not write six named fields.
        prop_assert!(decode::<State>(&forge(1, &text, &body, raw), SMALL).is_err());
    }

    #[test]
    fn several_flips_are_refused(flips in prop::collection::vec((any::<prop::sample::Index>(), 1_u8..), 1..6)) {
        let whole = encode(&header(7), &state()).unwrap();
        let mut bytes = whole.clone();
        for (at, mask) in &flips {
            let k = at.index(bytes.len());
            bytes[k] ^= mask;
        }
        prop_assert!(bytes == whole || decode::<State>(&bytes, SMALL).is_err());
    }
}
