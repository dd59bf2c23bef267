//! One file per law.

mod coulomb;
mod damped_hertz;
mod hertz;
mod history;
mod linear;
mod linear_spring;
mod mindlin;
mod none;
mod rolling;
mod roots;
mod walton_braun;

pub use coulomb::Coulomb;
pub use damped_hertz::DampedHertz;
pub use hertz::{Hertz, HertzStiffness};
pub use linear::Linear;
pub use linear_spring::LinearSpring;
pub use mindlin::Mindlin;
pub use none::{Frictionless, NoRolling};
pub use rolling::{ConstantTorque, RollingSpring};
pub use walton_braun::{WaltonBraun, WaltonBraunFriction};

use super::menu::{NormalLaw, TangentialLaw};

/// Whether the stiffness of `normal` (N/m or N/m^1.5) is the one that `tangential` takes its own from.
///
/// # Errors
/// What to choose instead.
pub fn fits(normal: NormalLaw, tangential: TangentialLaw) -> Result<(), &'static str> {
    let hertzian = matches!(normal, NormalLaw::Hertz | NormalLaw::DampedHertz);
    match tangential {
        TangentialLaw::LinearSpring | TangentialLaw::WaltonBraun if hertzian => Err(
            "this tangential spring needs a linear normal law (`linear`, `walton-braun`): with a Hertzian one use `mindlin` or `coulomb`",
        ),
        TangentialLaw::Mindlin if !hertzian => Err(
            "`mindlin` needs a Hertzian normal law (`hertz`, `damped-hertz`): with a linear one use `linear-spring` or `coulomb`",
        ),
        _ => Ok(()),
    }
}
