//! A vibrated layer at one floor velocity and several frequencies (Lan 4.1.4, Figs A4.4).

use crate::layers::{Bed, Layers, figures, theory};
use crate::repeats::Repeats;
use crate::study::{Computed, Ran, Request};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-acceleration/case.toml", include_str!("../../../studies/lan-acceleration/case.toml"));

/// Frequencies, Hz.
const FREQUENCIES: [u32; 4] = [5, 10, 50, 100];

const DIAMETER: f64 = 0.01;
const HOLD_UP: f64 = 2.5;
const BOUNDARY_VELOCITY: f64 = 2.0;

/// From here on the layer is as kinetic theory says.
const THERMAL: u32 = 50;

/// What the short form lays over the case.
const QUICK: [&str; 2] = ["time.end=3 s", "observe.0.from=1.5 s"];

fn bed(frequency: u32, request: &Request) -> Result<Bed, Failure> {
    let mut overrides = vec![format!("shaking.frequency={frequency} Hz")];
    if request.quick {
        overrides.extend(QUICK.map(String::from));
    }
    let folder = request.out.join(format!("{frequency}-hz"));
    let runs = Repeats::new(CASE, &overrides, &folder, 1, !request.quick)?;
    Bed::new(format!("{frequency} Hz"), &runs, DIAMETER)
}

/// What the thesis says of one bed.
fn said(bed: &Bed, frequency: u32) -> Vec<Computed> {
    if frequency >= THERMAL {
        let k = theory(HOLD_UP, BOUNDARY_VELOCITY);
        return vec![
            bed.find("W in the lowest layer over the theory's there", |l| l.floor_over(&k)),
            bed.find("largest solids fraction over the theory's", |l| {
                l.solids[l.densest()] / k.densest.solids_fraction
            }),
            bed.find("largest rise of W over W at the floor", Layers::rise),
        ];
    }
    if frequency == FREQUENCIES[1] {
        return vec![bed.find("largest rise of W over W at the floor", Layers::rise)];
    }
    vec![
        bed.find("layers below the least W", |l| l.height[l.coldest()]),
        bed.find("layers from the least W to the densest", Layers::coldest_to_densest),
        bed.find("W at the top over the least", |l| l.top() / l.w[l.coldest()]),
        bed.find("W at the floor over W at the top", |l| l.floor() / l.top()),
    ]
}

/// The quantities and plots; the short form is 5 and 50 Hz.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let chosen: Vec<u32> =
        FREQUENCIES.into_iter().filter(|f| !request.quick || *f == 5 || *f == 50).collect();
    let beds: Vec<Bed> = chosen.iter().map(|&f| bed(f, request)).collect::<Result<_, _>>()?;
    let computed = beds.iter().zip(&chosen).flat_map(|(b, &f)| said(b, f)).collect();
    let line = |f: u32| (f == THERMAL).then(|| theory(HOLD_UP, BOUNDARY_VELOCITY));
    let shown: Vec<_> = beds.iter().zip(&chosen).map(|(b, &f)| (b, line(f))).collect();
    let caption = "Layers one diameter thick, from the floor's mean place, mean over the seeds, where the solids fraction is 0.05 or more. The theory knows no frequency.";
    Ok(Ran { computed, figures: figures(&shown, caption).into() })
}
