//! Reasons to stop early: a signal, a wall-clock limit.

use signal_hook::consts::{SIGINT, SIGTERM};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Why a run stopped before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Early {
    /// Ctrl-C, SIGTERM or SIGUSR1.
    Signal,
    /// The wall-clock limit.
    WallLimit,
}

/// Watches for a reason to stop.
pub struct Watch {
    signal: Arc<AtomicBool>,
    deadline: Option<Instant>,
}

impl Watch {
    /// Listens for signals from now on. A second Ctrl-C ends the process at once.
    ///
    /// # Errors
    /// If the system refuses a handler.
    pub fn new(wall_limit: Option<Duration>) -> std::io::Result<Self> {
        let signal = Arc::new(AtomicBool::new(false));
        for which in [SIGINT, SIGTERM] {
            let _ = signal_hook::flag::register_conditional_shutdown(which, 130, Arc::clone(&signal))?;
            let _ = signal_hook::flag::register(which, Arc::clone(&signal))?;
        }
        #[cfg(unix)]
        {
            let _ = signal_hook::flag::register(signal_hook::consts::SIGUSR1, Arc::clone(&signal))?;
        }
        Ok(Self { signal, deadline: wall_limit.map(|d| Instant::now() + d) })
    }

    /// The reason to stop now, if there is one.
    #[must_use]
    pub fn early(&self) -> Option<Early> {
        if self.signal.load(Ordering::Relaxed) {
            return Some(Early::Signal);
        }
        self.deadline.filter(|d| Instant::now() >= *d).map(|_| Early::WallLimit)
    }
}
