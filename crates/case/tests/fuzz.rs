//! Random and damaged case files: each is read or refused, none panics.
//!
//! `BRAZILNUT_FUZZ=1000000 cargo test --release -p brazilnut-case --test fuzz` runs a million.

#![allow(unsafe_code, reason = "an allocator that counts can only be written as one")]

use brazilnut_base::random;
use brazilnut_case::{Case, build, check, resolved};
use rand::{Rng, RngExt};
use std::alloc::{GlobalAlloc, Layout, System};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The allocator of the system, counting.
struct Counting;

static LIVE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is handed on to the system's allocator with its arguments unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let live = LIVE.fetch_add(layout.size(), Relaxed) + layout.size();
        PEAK.fetch_max(live, Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        let live = LIVE.fetch_add(layout.size(), Relaxed) + layout.size();
        PEAK.fetch_max(live, Relaxed);
        // Not touched until it is used, so that a huge request can be reported.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Most memory that any input may take, bytes.
const MOST: usize = 1 << 30;

const GOOD: &[&str] = &[
    include_str!("good/dry.toml"),
    include_str!("good/everything.toml"),
    include_str!("good/modified-kroll.toml"),
    include_str!("good/simple-drag.toml"),
];

/// Pieces that a slip of the hand or a generator of cases may put anywhere.
const PIECES: &[&str] = &[
    "-1",
    "0",
    "1e308",
    "-0.0",
    "nan",
    "inf",
    "1e-320",
    "99999999999999999999",
    "9223372036854775807",
    "true",
    "[]",
    "{}",
    "[[",
    "]]",
    "\"",
    "'''",
    "\"\"\"",
    "\\u0000",
    "\n",
    "=",
    ".",
    "#",
    "\u{0}",
    "\u{feff}",
    "µ",
    "é",
    "\u{202e}",
    "\"1 mm\"",
    "\"1e400 mm\"",
    "\"1 mm^-6\"",
    "\"1 m^6 m^6 m^6 m^6 m^6 m^6 m^6 m^6 m^6 m^6 m^6\"",
    "\"0 per cycle\"",
    "\"18446744073709551615 cycles\"",
    "\"end\"",
    "0x_f",
    "1979-05-27",
    "a.b.c.d = 1\n",
    "[grains]\n",
    "[[grains]]\n",
    "[[observe]]\nwhat = \"bed\"\n",
    "model = \"dry\"\n",
];

fn below(rng: &mut impl Rng, n: usize) -> usize {
    rng.random_range(0..n.max(1))
}

/// A place in `text` between two characters.
fn cut(rng: &mut impl Rng, text: &str) -> usize {
    let mut k = below(rng, text.len() + 1);
    while !text.is_char_boundary(k) {
        k -= 1;
    }
    k
}

/// One small damage.
fn damage(rng: &mut impl Rng, text: &mut String) {
    let lines: Vec<String> = text.lines().map(|l| format!("{l}\n")).collect();
    match below(rng, 8) {
        0 => text.insert_str(cut(rng, text), PIECES[below(rng, PIECES.len())]),
        1 => {
            let (a, b) = (cut(rng, text), cut(rng, text));
            let (a, b) = (a.min(b), a.max(b));
            let b = b.min(a + 20);
            if text.is_char_boundary(b) {
                text.replace_range(a..b, "");
            }
        }
        2 => {
            let mut lines = lines;
            if !lines.is_empty() {
                let _ = lines.remove(below(rng, lines.len()));
            }
            *text = lines.concat();
        }
        3 => {
            let mut lines = lines;
            if !lines.is_empty() {
                let line = lines[below(rng, lines.len())].clone();
                lines.insert(below(rng, lines.len() + 1), line);
            }
            *text = lines.concat();
        }
        // The value of a key becomes another one.
        4 | 5 => {
            let mut lines = lines;
            if !lines.is_empty() {
                let k = below(rng, lines.len());
                if let Some((key, _)) = lines[k].split_once(" = ") {
                    lines[k] = format!("{key} = {}\n", PIECES[below(rng, PIECES.len())]);
                }
            }
            *text = lines.concat();
        }
        // A line of another case.
        6 => {
            let mut lines = lines;
            let other: Vec<&str> = GOOD[below(rng, GOOD.len())].lines().collect();
            lines.insert(below(rng, lines.len() + 1), format!("{}\n", other[below(rng, other.len())]));
            *text = lines.concat();
        }
        _ => {
            let k = cut(rng, text);
            if let Some(c) = text[k..].chars().next() {
                let other = char::from(32 + below(rng, 95) as u8);
                text.replace_range(k..k + c.len_utf8(), &other.to_string());
            }
        }
    }
}

/// Assembles a case that asks for few grains: what is wrong must be said, not panicked.
/// The analytical models have no parts: to assemble them is to solve them, which is another matter.
fn assemble(case: &Case) {
    let few = case.values.tables("grains").all(|g| g.integer_opt("count").is_none_or(|n| n <= 100));
    if few && !check::is_analytical(case.model()) {
        let _ = build::build(case);
    }
}

#[test]
fn no_case_file_makes_the_reader_panic() {
    let n: usize = std::env::var("BRAZILNUT_FUZZ").ok().and_then(|n| n.parse().ok()).unwrap_or(2_000);
    let seed: u64 = std::env::var("BRAZILNUT_FUZZ_SEED").ok().and_then(|n| n.parse().ok()).unwrap_or(7);
    let mut rng = random::stream(seed, "fuzz", 0);
    let (mut accepted, mut longest, mut largest) = (0_usize, 0.0_f64, 0);
    for k in 0..n {
        let mut text = GOOD[below(&mut rng, GOOD.len())].to_string();
        for _ in 0..=below(&mut rng, 5) {
            damage(&mut rng, &mut text);
        }
        let start = std::time::Instant::now();
        PEAK.store(LIVE.load(Relaxed), Relaxed);
        let outcome =
            std::panic::catch_unwind(|| match Case::parse(&text, "fuzz.toml", PathBuf::new(), &[]) {
                Ok(case) => {
                    let copy = case.resolved();
                    let again = Case::parse(&copy, "copy.toml", PathBuf::new(), &[]);
                    let again = again.unwrap_or_else(|e| panic!("the copy is refused: {e}\n{copy}"));
                    assert_eq!(resolved::flatten(&case.values), resolved::flatten(&again.values));
                    assemble(&case);
                    true
                }
                Err(issues) => {
                    assert!(!issues.is_empty() && !issues.render(false).is_empty());
                    false
                }
            });
        longest = longest.max(start.elapsed().as_secs_f64());
        largest = largest.max(PEAK.load(Relaxed));
        assert!(largest < MOST, "input {k} of seed {seed} took {largest} bytes:\n{text}");
        match outcome {
            Ok(ok) => accepted += usize::from(ok),
            Err(_) => panic!("input {k} of seed {seed}:\n{text}"),
        }
    }
    println!("{n} inputs, {accepted} accepted, the slowest took {longest:.3} s, the largest {largest} bytes");
    // Most damage is seen; some (a comment, a blank) is harmless: both roads must have been walked.
    assert!(accepted > 0 && accepted < n);
}
