//! What observers see of a simulation.

use brazilnut_grains::Ledger;

/// Names of the ledger's entries, in the order of [`ledger`].
pub const LEDGER: &[&str] = &[
    "initial",
    "work_of_gravity",
    "work_of_frame",
    "work_of_walls",
    "work_of_fluid",
    "translation",
    "rotation",
    "elastic",
    "lost_to_damping",
    "lost_to_sliding",
    "lost_to_tangential_damping",
    "lost_to_rolling",
    "lost_to_hysteresis",
    "residual",
];

/// The ledger by name, J.
#[must_use]
pub fn ledger(l: &Ledger) -> [(&'static str, f64); 14] {
    let values = [
        l.initial,
        l.gravity,
        l.frame,
        l.walls,
        l.fluid,
        l.translation,
        l.rotation,
        l.elastic,
        l.damping,
        l.sliding,
        l.tangential_damping,
        l.rolling,
        l.hysteresis,
        l.residual(),
    ];
    std::array::from_fn(|k| (LEDGER[k], values[k]))
}

/// The ledger counted from the moment of `before`: what was there then is `initial`.
#[must_use]
pub fn since(now: &Ledger, before: &Ledger) -> Ledger {
    Ledger {
        initial: now.initial - before.initial + before.translation + before.rotation + before.elastic,
        gravity: now.gravity - before.gravity,
        frame: now.frame - before.frame,
        walls: now.walls - before.walls,
        fluid: now.fluid - before.fluid,
        translation: now.translation,
        rotation: now.rotation,
        elastic: now.elastic,
        damping: now.damping - before.damping,
        sliding: now.sliding - before.sliding,
        tangential_damping: now.tangential_damping - before.tangential_damping,
        rolling: now.rolling - before.rolling,
        hysteresis: now.hysteresis - before.hysteresis,
    }
}
