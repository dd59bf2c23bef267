//! Random streams, keyed so that no draw depends on another's order.

use rand_pcg::Pcg64;

/// The stream of `purpose` and `index` under a run's `seed`.
///
/// The same three always give the same stream; different purposes are
/// independent. `Pcg64` is pinned because its stream is part of a run's identity.
#[must_use]
pub fn stream(seed: u64, purpose: &str, index: u64) -> Pcg64 {
    // FNV-1a over the purpose: a name, not a place in a list, picks the stream.
    let hash = purpose
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
    // `new` shifts the stream number left before it sets the low bit; `from_seed` would lose that bit.
    Pcg64::new(u128::from(seed) << 64 | u128::from(hash), u128::from(index))
}

#[cfg(test)]
mod tests {
    use rand::RngExt;

    #[test]
    fn streams_differ_by_every_part_of_the_key() {
        let draw = |s, p, i| super::stream(s, p, i).random::<u64>();
        let base = draw(1, "placement", 0);
        assert_eq!(base, draw(1, "placement", 0));
        assert_ne!(base, draw(2, "placement", 0));
        assert_ne!(base, draw(1, "jitter", 0));
        assert_ne!(base, draw(1, "placement", 1));
    }
}
