//! Which instructions this machine has, asked at run time.
#![allow(unsafe_code, reason = "code for instructions found at run time is entered through unsafe calls")]

use super::Wide;
#[cfg(target_arch = "x86_64")]
use super::{Avx2, Avx512};
use crate::spec::Sweep;

/// Work that can be done with any lane type.
pub trait Job {
    /// What it gives.
    type Output;
    /// Does it. Implementations must be `#[inline(always)]`, with all they call, to be compiled for `R`.
    fn run<R: Wide>(self) -> Self::Output;
}

/// Sets of instructions that sweeps are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// AVX-512 (F, DQ, VL).
    #[cfg(target_arch = "x86_64")]
    Avx512,
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// What every machine has: one contact at a time.
    Plain,
}

impl Sweep {
    /// The instructions that it stands for on this machine.
    pub(crate) fn level(self) -> Level {
        match self {
            Self::Fast => Level::best(),
            Self::Plain => Level::Plain,
        }
    }
}

impl Level {
    /// The widest of this machine. Without wide instructions eight lanes in an array measured slower than
    /// one (3.9 against 5.5 million particle-steps/s with those that every x86-64 has).
    #[must_use]
    pub fn best() -> Self {
        if brazilnut_base::portable::wanted() {
            return Self::Plain;
        }
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
            {
                return Self::Avx512;
            }
            if is_x86_feature_detected!("avx2") {
                return Self::Avx2;
            }
        }
        Self::Plain
    }

    /// Those of this machine, the best first.
    #[must_use]
    #[cfg(test)]
    pub fn all() -> Vec<Self> {
        let mut all = vec![];
        #[cfg(target_arch = "x86_64")]
        {
            if Self::best() == Self::Avx512 {
                all.push(Self::Avx512);
            }
            if is_x86_feature_detected!("avx2") {
                all.push(Self::Avx2);
            }
        }
        all.push(Self::Plain);
        all
    }

    /// Does `job` with this level's lanes.
    #[inline]
    pub fn run<J: Job>(self, job: J) -> J::Output {
        match self {
            // Sound: these levels exist only after `best` or `all` asked the processor.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { avx512(job) },
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { avx2(job) },
            Self::Plain => job.run::<f64>(),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn avx512<J: Job>(job: J) -> J::Output {
    job.run::<Avx512>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<J: Job>(job: J) -> J::Output {
    job.run::<Avx2>()
}
