//! Threads without a voice in the result: work is cut into blocks by its size
//! alone, and sums run in block order.

use std::ops::Range;

/// Cuts `0..len` into `blocks` nearly equal ranges (fewer if `len` is small).
///
/// The cut depends on `len` and `blocks` only, never on the number of threads.
pub fn cut(len: usize, blocks: usize) -> impl Iterator<Item = Range<usize>> + Clone {
    let n = blocks.clamp(1, len.max(1));
    (0..n).map(move |k| len * k / n..len * (k + 1) / n)
}

/// Sums in a fixed order with Neumaier's compensation.
#[must_use]
pub fn sum(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut s, mut c) = (0.0_f64, 0.0_f64);
    for v in values {
        let t = s + v;
        c += if s.abs() >= v.abs() { (s - t) + v } else { (v - t) + s };
        s = t;
    }
    s + c
}

#[cfg(test)]
mod tests {
    #[test]
    fn blocks_cover_the_range_once() {
        let all: Vec<usize> = super::cut(10, 3).flatten().collect();
        assert_eq!(all, (0..10).collect::<Vec<_>>());
        assert_eq!(super::cut(0, 4).flatten().count(), 0);
    }

    #[test]
    fn compensated_sum_keeps_small_terms() {
        assert_eq!(super::sum([1.0, 1e100, 1.0, -1e100]), 2.0);
    }
}
