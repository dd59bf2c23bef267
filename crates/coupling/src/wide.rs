//! Sweeps compiled twice: for the baseline and for vectors of four numbers, chosen at run time.
//!
//! The same operations in the same order, so the same bits.

/// Work to be compiled twice; `run` and all that it calls is `#[inline(always)]`.
pub(crate) trait Task {
    /// Does it.
    fn run(self);
}

/// Runs `task` with the widest vectors that the processor has.
#[inline]
#[allow(
    unsafe_code,
    reason = "code compiled for a processor feature is unsafe to call; it is looked for first"
)]
pub(crate) fn run(task: impl Task) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has the feature.
        return unsafe { avx2(task) };
    }
    task.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2(task: impl Task) {
    task.run();
}
