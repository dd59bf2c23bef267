//! What a person sees while a run goes on: a bar on a terminal, plain lines in a log.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// One look at a running job.
#[derive(Clone, Debug, Default)]
pub struct Look {
    /// What is going on: `settling`, `shaking`.
    pub stage: &'static str,
    /// Simulated time, s.
    pub time: f64,
    /// Phase of the shake in degrees, if anything shakes.
    pub phase: Option<f64>,
    /// Fraction done, 0 to 1.
    pub done: f64,
    /// Steps per second.
    pub steps_per_second: f64,
    /// Mismatch of the energy ledger over the work put in.
    pub residual: Option<f64>,
}

/// Where progress goes.
pub struct Progress {
    bar: Option<ProgressBar>,
    quiet: bool,
    start: Instant,
    last_line: Option<Instant>,
    lines: u32,
}

/// A bar counts in this many parts.
const PARTS: u64 = 10_000;

impl Progress {
    /// A bar if the error stream is a terminal, lines otherwise, nothing if `quiet`.
    #[must_use]
    pub fn new(quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (terminal && !quiet).then(|| {
            let bar = ProgressBar::with_draw_target(Some(PARTS), ProgressDrawTarget::stderr_with_hz(5));
            let style = ProgressStyle::with_template("{bar:30} {percent:>3}% {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self { bar, quiet, start: Instant::now(), last_line: None, lines: 0 }
    }

    /// Shows a look. Lines in a log come ever more rarely: after 2, 4, 8 … up to 60 seconds.
    pub fn show(&mut self, look: &Look) {
        if self.quiet {
            return;
        }
        if let Some(bar) = &self.bar {
            bar.set_position((look.done * PARTS as f64) as u64);
            bar.set_message(self.text(look));
            return;
        }
        let pause = Duration::from_secs(2_u64.saturating_pow(self.lines.min(6) + 1).min(60));
        if self.last_line.is_none_or(|t| t.elapsed() >= pause) {
            eprintln!("{:>5.1} % {}", 100.0 * look.done, self.text(look));
            self.lines += 1;
            self.last_line = Some(Instant::now());
        }
    }

    /// A line above the bar.
    pub fn say(&self, line: &str) {
        match &self.bar {
            _ if self.quiet => {}
            Some(bar) => bar.println(line),
            None => eprintln!("{line}"),
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    fn text(&self, look: &Look) -> String {
        let mut s = format!("{} t = {:.3} s", look.stage, look.time);
        if let Some(p) = look.phase {
            s += &format!(", phase {p:3.0} deg");
        }
        s += &format!(", {:.0} steps/s", look.steps_per_second);
        if let Some(r) = look.residual {
            s += &format!(", energy residual {:.2} %", 100.0 * r);
        }
        if look.done > 0.0 && look.done < 1.0 && look.stage != "settling" {
            let left = self.start.elapsed().as_secs_f64() * (1.0 - look.done) / look.done;
            s += &format!(", {} left", duration(left));
        }
        s
    }
}

/// Seconds as a person says them.
#[must_use]
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() => "unknown".into(),
        s if s < 1.0 => format!("{:.0} ms", 1e3 * s),
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn durations_read_naturally() {
        let said: Vec<String> = [0.5, 42.0, 600.0, 7200.0, 864_000.0].map(super::duration).into();
        assert_eq!(said, ["500 ms", "42 s", "10 min", "2.0 h", "10.0 days"]);
    }
}
