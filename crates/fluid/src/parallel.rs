//! Threads that leave no trace in the results, and their scratch memory.

use rayon::prelude::*;
use std::cell::Cell;

/// Cells below which handing work to other threads costs more than it saves.
pub(crate) const WORTH_THREADS: usize = 8192;

/// Calls `work` for each of `0..count`, side by side if `parallel`.
pub(crate) fn for_each(parallel: bool, count: usize, work: impl Fn(usize) + Sync) {
    if parallel && count > 1 {
        (0..count).into_par_iter().for_each(&work);
    } else {
        (0..count).for_each(&work);
    }
}

thread_local! {
    static SCRATCH: Cell<Vec<f64>> = const { Cell::new(Vec::new()) };
}

/// Numbers of arbitrary value, aligned to a cache line, on loan from the thread,
/// so that steps allocate nothing after the first.
///
/// A guard and not a callback: a closure would be compiled without the vector
/// instructions of the kernel around it.
pub(crate) struct Scratch {
    memory: Vec<f64>,
    offset: usize,
    len: usize,
}

impl Scratch {
    /// Borrows `len` numbers.
    pub fn take(len: usize) -> Self {
        let mut memory = SCRATCH.take();
        if memory.len() < len + 8 {
            memory = vec![0.0; len + 8];
        }
        let offset = memory.as_ptr().align_offset(64).min(8);
        Self { memory, offset, len }
    }

    /// The numbers.
    #[inline(always)]
    pub fn as_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.offset..self.offset + self.len]
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        SCRATCH.set(std::mem::take(&mut self.memory));
    }
}
