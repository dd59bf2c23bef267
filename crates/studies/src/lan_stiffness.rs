//! Softer springs leave the profiles of a vibrated layer alone (Lan 4.1.3, Table 4.2, Fig. A4.3).

use crate::layers::{Bed, LEAST, Layers, figures, theory};
use crate::repeats::Repeats;
use crate::runs::first;
use crate::study::{Computed, Ran, Request};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-stiffness/case.toml", include_str!("../../../studies/lan-stiffness/case.toml"));

/// Loading stiffnesses of Lan Table 4.2 as written in a case, N/m, from soft to hard.
const STIFFNESSES: [&str; 3] = ["1.2e5", "3.64e6", "2.7e8"];

const DIAMETER: f64 = 0.01;

/// What the short form lays over the case.
const QUICK: [&str; 2] = ["time.end=2.5 s", "observe.0.from=0.7 s"];

/// One stiffness.
struct Run {
    bed: Bed,
    temperature: f64,
}

impl Run {
    fn new(stiffness: &str, request: &Request) -> Result<Self, Failure> {
        let mut overrides = vec![format!("contact.stiffness={stiffness} N/m")];
        if request.quick {
            overrides.extend(QUICK.map(String::from));
        }
        // One seed: the hardest spring costs more than all else of these studies.
        let runs =
            Repeats::new(CASE, &overrides, &request.out.join(format!("k-{stiffness}")), 1, !request.quick)?;
        let temperature = first(&runs.tables("profile-cell")?[0], "temperature");
        Ok(Self { bed: Bed::new(format!("{stiffness} N/m"), &runs, DIAMETER)?, temperature })
    }
}

/// Largest distance of two solids fractions over the layers.
fn solids_apart(a: &Layers, b: &Layers) -> f64 {
    a.solids.iter().zip(&b.solids).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Largest distance of W from that of `b` over its largest, over the layers that hold enough in both.
fn w_apart(a: &Layers, b: &Layers) -> f64 {
    let most = b.w.iter().copied().filter(|w| w.is_finite()).fold(0.0, f64::max);
    let full = b.full().into_iter().filter(|&k| a.solids[k] >= LEAST);
    full.map(|k| (a.w[k] - b.w[k]).abs() / most).fold(0.0, f64::max)
}

/// The quantities and plots; the short form leaves out the hardest spring.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let chosen = if request.quick { &STIFFNESSES[..2] } else { &STIFFNESSES[..] };
    let runs: Vec<Run> = chosen.iter().map(|s| Run::new(s, request)).collect::<Result<_, _>>()?;
    let mut computed = vec![];
    for (pair, names) in runs.windows(2).zip(chosen.windows(2)) {
        let [soft, hard] = [&pair[0], &pair[1]];
        let name = |what: &str| format!("{what}, {} against {} N/m", names[0], names[1]);
        let (a, b) = (&soft.bed.mean, &hard.bed.mean);
        computed.extend([
            Computed::new(name("ratio of the mean temperatures"), soft.temperature / hard.temperature),
            Computed::new(name("largest distance of the solids fractions"), solids_apart(a, b)),
            Computed::new(name("largest distance of W over its largest"), w_apart(a, b)),
        ]);
    }
    let line = |k: usize| (k == 0).then(|| theory(2.5, 2.0));
    let shown: Vec<_> = runs.iter().enumerate().map(|(k, r)| (&r.bed, line(k))).collect();
    let caption = "Layers one diameter thick where the solids fraction is 0.05 or more, V_b = 2, m_t = 2.5.";
    Ok(Ran { computed, figures: figures(&shown, caption).into() })
}
