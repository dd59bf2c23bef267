//! Time on the processor, which other jobs on the machine disturb least, and time on the wall.

use std::fs;
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

/// Time on a processor of all threads of this process, s.
fn processor() -> Option<f64> {
    let mut sum = 0.0;
    for task in fs::read_dir("/proc/self/task").ok()? {
        let text = fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
        sum += nanoseconds * 1e-9;
    }
    Some(sum)
}
