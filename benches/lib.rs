//! What the benchmarks share: time on the processor, which other jobs on the machine disturb least, time on the
//! wall, and the median.

use std::time::Instant;

/// Started when made.
pub struct Clock {
    wall: Instant,
    processor: Option<f64>,
}

/// What a clock showed, s.
#[derive(Clone, Copy)]
pub struct Lap {
    /// Time that passed.
    pub wall: f64,
    /// Time that all threads of this process spent on a processor, where the system tells.
    pub processor: Option<f64>,
}

impl Clock {
    /// Starts a clock.
    pub fn start() -> Self {
        Self { processor: processor(), wall: Instant::now() }
    }

    /// Reads it.
    pub fn lap(&self) -> Lap {
        let wall = self.wall.elapsed().as_secs_f64();
        let processor = self.processor.zip(processor()).map(|(from, to)| to - from);
        Lap { wall, processor }
    }
}

impl Lap {
    /// The time to rate a run on `threads` threads by: several threads also wait for each other.
    pub fn seconds(&self, threads: usize) -> f64 {
        match self.processor {
            Some(t) if threads == 1 => t,
            _ => self.wall,
        }
    }

    /// Processors that the run was given.
    pub fn processors(&self) -> f64 {
        self.processor.map_or(f64::NAN, |t| t / self.wall)
    }
}

/// Time on a processor of all threads of this process, s. Not from `/proc`: what stands there moves on once in
/// some 4 ms, and a solve takes one.
#[cfg(unix)]
fn processor() -> Option<f64> {
    let t = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64)
}

#[cfg(not(unix))]
fn processor() -> Option<f64> {
    None
}

/// The middle of `x`.
pub fn median(mut x: Vec<f64>) -> f64 {
    x.sort_by(f64::total_cmp);
    let n = x.len();
    if n == 0 { f64::NAN } else { 0.5 * (x[(n - 1) / 2] + x[n / 2]) }
}
