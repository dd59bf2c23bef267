//! Work along closed paths: none is gained, all is stored or lost.

use super::*;

#[test]
fn no_path_from_touch_to_release_yields_work() {
    let smooth = |c: &Case| c.rolling == RollingLaw::None;
    let elastic = menu().into_iter().map(|c| Case { restitution: 1.0, ..c });
    for case in menu().into_iter().chain(elastic).filter(smooth) {
        let law = case.law(PATH_STEP);
        let mut worst = [f64::NEG_INFINITY; 2];
        for seed in 0..60 {
            let path = Path::new(seed, 0.0);
            for (worst, (gained, moved)) in worst.iter_mut().zip(work(law.as_ref(), &path)) {
                *worst = worst.max(gained / moved.max(1e-30));
            }
        }
        // Midpoint sums over 2000 steps: error of order (2 pi/2000)² of the work moved.
        assert!(worst[0] <= 1e-4, "{case:?}: the normal force yields {:e} of the work it moves", worst[0]);
        assert!(
            worst[1] <= 1e-4,
            "{case:?}: the tangential force yields {:e} of the work it moves",
            worst[1]
        );
    }
}

/// Work that the normal and the tangential force did on the bodies along `path`, each with the sum of its magnitudes, J.
fn work(law: &dyn ContactSweep, path: &Path) -> [(f64, f64); 2] {
    let mut memory = [0.0; MAX_SLOTS];
    let mut sums = [(0.0, 0.0); 2];
    for k in 1..=Path::STEPS {
        let t = path.touch(k, PATH_STEP, Quat::IDENTITY);
        if t.overlap > 0.0 {
            let answer = law.single(0, &t, &mut memory);
            let (force, tangential) = (glam(answer.force), glam(answer.tangential));
            let along = -(force - tangential).dot(glam(t.normal)) * t.approach * PATH_STEP;
            let across = tangential.dot(glam(t.slip)) * PATH_STEP;
            for (sum, w) in sums.iter_mut().zip([along, across]) {
                *sum = (sum.0 + w, sum.1 + w.abs());
            }
        }
    }
    sums
}

#[test]
fn work_is_stored_or_lost_at_every_moment() {
    for case in menu().into_iter().filter(|c| c.rolling == RollingLaw::None) {
        let law = case.law(PATH_STEP);
        let mut memory = [0.0; MAX_SLOTS];
        let path = Path::new(7, 0.0);
        let (mut taken, mut lost, mut most, mut worst) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        for k in 1..=Path::STEPS {
            let t = path.touch(k, PATH_STEP, Quat::IDENTITY);
            if t.overlap <= 0.0 {
                continue;
            }
            let a = law.single(0, &t, &mut memory);
            let w = -glam(a.force).dot(glam(t.slip) - glam(t.normal) * t.approach) * PATH_STEP;
            let l = total(&a.energy);
            // Work and losses of a step run from half a step before the force to half a step after it.
            let miss = taken + 0.5 * w - lost - 0.5 * l - a.energy[energy::STORED];
            most = most.max(a.energy[energy::STORED]);
            worst = worst.max(miss.abs());
            (taken, lost) = (taken + w, lost + l);
        }
        // Half of a step's loss is known to within its change, 2 pi/2000 of it.
        assert!(worst < 2e-3 * most, "{case:?}: {:e} of the energy stored", worst / most);
    }
}
