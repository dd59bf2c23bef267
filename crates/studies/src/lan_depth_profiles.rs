//! Temperature and solids fraction of vibrated layers against kinetic theory (Lan 4.1.1-4.1.2, Table 4.1, Figs A4.1-2).

use crate::layers::{Bed, GRAVITY, Layers, figures, theory};
use crate::repeats::Repeats;
use crate::study::{Computed, Ran, Request};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-depth-profiles/case.toml", include_str!("../../../studies/lan-depth-profiles/case.toml"));

/// Grains, hold-up m_t and boundary velocity V_b of Lan Table 4.1.
const CASES: [(u32, f64, f64); 5] =
    [(48, 1.0, 2.0), (119, 2.5, 2.0), (239, 5.0, 0.25), (239, 5.0, 2.0), (239, 5.0, 5.0)];

/// Loading stiffness, N/m: a collision with the floor at its peak velocity gives way by a hundredth of a
/// diameter at most, the thesis's own rule (4.1.3). README.md says what the printed stiffness changes.
fn stiffness(boundary: f64) -> f64 {
    if boundary > 2.0 { 3.2e7 } else { 5e6 }
}

const DIAMETER: f64 = 0.1;

/// What the short form lays over the case.
const QUICK: [&str; 2] = ["time.end=14 s", "observe.0.from=2 s"];

fn bed((grains, hold_up, boundary): (u32, f64, f64), request: &Request) -> Result<Bed, Failure> {
    let velocity = boundary * (2.0 * DIAMETER * GRAVITY).sqrt();
    let mut overrides =
        vec![format!("grains.0.count={grains}"), format!("shaking.peak_velocity={velocity:.5} m/s")];
    overrides.push(format!("contact.stiffness={:e} N/m", stiffness(boundary)));
    if request.quick {
        overrides.extend(QUICK.map(String::from));
    }
    let folder = request.out.join(format!("m-{hold_up}-v-{boundary}"));
    let seeds = if request.quick { 1 } else { 2 };
    let runs = Repeats::new(CASE, &overrides, &folder, seeds, !request.quick)?;
    Bed::new(format!("m_t {hold_up}, V_b {boundary}"), &runs, DIAMETER)
}

/// What the thesis says of one bed, beside the theory's lines that it finds in good agreement.
fn said(bed: &Bed, (_, hold_up, boundary): (u32, f64, f64)) -> Vec<Computed> {
    let k = theory(hold_up, boundary);
    let mut all = vec![
        bed.find("W in the lowest layer over the theory's there", |l| l.floor_over(&k)),
        bed.find("largest rise of W over W at the floor", Layers::rise),
        // Spheres can fill only a part of the lowest layer: the one above tells of the gas.
        bed.find("solids fraction of the second layer over the largest", |l| {
            l.solids[1] / l.solids[l.densest()]
        }),
    ];
    if boundary > 1.0 {
        all.push(bed.find("largest solids fraction over the theory's", |l| {
            l.solids[l.densest()] / k.densest.solids_fraction
        }));
    }
    if boundary > 1.0 && hold_up > 1.0 {
        all.push(bed.find("height of the densest layer over the theory's", |l| {
            l.height[l.densest()] / k.densest.height
        }));
    }
    all
}

/// The quantities and plots; the short form is the layer of 2.5 alone.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let chosen = if request.quick { &CASES[1..2] } else { &CASES[..] };
    let beds: Vec<Bed> = chosen.iter().map(|&c| bed(c, request)).collect::<Result<_, _>>()?;
    let computed = beds.iter().zip(chosen).flat_map(|(b, &c)| said(b, c)).collect();
    let shown = |of: fn(&(u32, f64, f64)) -> bool| -> Vec<_> {
        let some = chosen.iter().zip(&beds).filter(|(c, _)| of(c));
        some.map(|(c, b)| (b, Some(theory(c.1, c.2)))).collect()
    };
    let caption = "Layers one diameter thick, mean over the seeds, where the solids fraction is 0.05 or more; e = e_w = 0.9, 50 Hz.";
    let by_hold_up = figures(&shown(|c| c.2 == 2.0), caption);
    let by_velocity = figures(&shown(|c| c.1 == 5.0), caption);
    let figures = if request.quick { by_hold_up.into() } else { [by_hold_up, by_velocity].concat() };
    Ok(Ran { computed, figures })
}
