//! Contact laws of a case: the table of pairs, and how long contacts last.

use crate::issue::Issues;
use brazilnut_base::values::{Value, Values};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::material::{self as solid, Across};
use brazilnut_grains::{ContactSpec, Material, PairSpec, PairTable};

/// The laws and the constants of all pairs of `materials`.
pub fn read(v: &Values, materials: &[Material], issues: &mut Issues) -> Option<ContactSpec> {
    let c = v.table_opt("contact")?;
    let normal = NormalLaw::named(c.text_opt("normal")?)?;
    let tangential = TangentialLaw::named(c.text_opt("tangential")?)?;
    let rolling = RollingLaw::named(c.text_opt("rolling")?)?;
    let hertz = is_hertz(normal);
    let general = constants(c, &PairSpec { friction: 0.0, ..PairSpec::default() }, hertz);
    let mut pairs = PairTable::uniform(materials.len(), general.clone());
    let mut says_restitution = c.has("restitution");
    for pair in c.tables("pairs") {
        let index = |x: &Value| match x {
            Value::Text(s) => materials.iter().position(|m| m.name == *s),
            _ => None,
        };
        let between: Vec<usize> = pair.list("between").iter().filter_map(index).collect();
        if let [a, b] = between[..] {
            pairs.set(a, b, constants(pair, &general, hertz));
            says_restitution |= pair.has("restitution");
        }
    }
    let needs_restitution = c.text_opt("normal") != Some("hertz");
    if needs_restitution && !says_restitution {
        issues.add(
            c.span.clone().or_else(|| v.span("model")),
            "`contact.restitution` is missing",
            format!("the law \"{}\" loses energy", normal.name()),
            "add `restitution = 0.9` to `contact`",
        );
    }
    if !hertz && c.has("hertz_stiffness") || hertz && c.has("stiffness") {
        let (wrong, right) =
            if hertz { ("stiffness", "hertz_stiffness") } else { ("hertz_stiffness", "stiffness") };
        issues.add(
            c.span(wrong),
            format!("`{wrong}` is not for this law"),
            format!("\"{}\" takes `{right}`", normal.name()),
            format!("give `{right}`{}", if hertz { ", or Young's moduli of the materials" } else { "" }),
        );
    }
    Some(ContactSpec { normal, tangential, rolling, pairs })
}

/// Whether the law is one of F = k delta^(3/2).
#[must_use]
pub fn is_hertz(law: NormalLaw) -> bool {
    law.name().contains("hertz")
}

fn constants(t: &Values, general: &PairSpec, hertz: bool) -> PairSpec {
    let restitution = t.table_opt("restitution");
    PairSpec {
        stiffness: t.number_opt(if hertz { "hertz_stiffness" } else { "stiffness" }).or(general.stiffness),
        restitution: restitution.and_then(|r| r.number_opt("value")).unwrap_or(general.restitution),
        at_speed: match restitution {
            Some(r) => r.number_opt("at_speed"),
            None => general.at_speed,
        },
        friction: t.number_opt("friction").unwrap_or(general.friction),
        tangential_ratio: t.number_opt("tangential_ratio").or(general.tangential_ratio),
        tangential_damping: t.number_opt("tangential_damping").or(general.tangential_damping),
        rolling_friction: t.number_opt("rolling_friction").unwrap_or(general.rolling_friction),
    }
}

/// One body of a contact as far as its duration goes.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Mass, kg; infinite for a wall.
    pub mass: f64,
    /// Radius, m; infinite for a wall.
    pub radius: f64,
    /// Index of the material.
    pub material: usize,
}

/// Stiffness of a Hertzian contact, N m^(-3/2): as given, else from the materials.
fn hertz_stiffness(pair: &PairSpec, materials: &[Material], a: Body, b: Body) -> Option<f64> {
    let r = 1.0 / (1.0 / a.radius + 1.0 / b.radius);
    let from_moduli = || {
        let (x, y) = (materials[a.material].elastic?, materials[b.material].elastic?);
        Some(solid::hertz_stiffness(r, solid::effective_modulus(&x, &y)))
    };
    pair.stiffness.or_else(from_moduli)
}

/// Duration (s) and largest overlap (m) of a head-on contact of two bodies that meet at `speed` (m/s).
#[must_use]
pub fn duration(
    spec: &ContactSpec,
    materials: &[Material],
    a: Body,
    b: Body,
    speed: f64,
) -> Option<(f64, f64)> {
    let pair = spec.pairs.get(a.material, b.material);
    let m = 1.0 / (1.0 / a.mass + 1.0 / b.mass);
    let e = pair.restitution;
    if is_hertz(spec.normal) {
        let k = hertz_stiffness(pair, materials, a, b)?;
        return Some((solid::hertz_contact_time(m, k, speed), solid::hertz_overlap(m, k, speed)));
    }
    let k = pair.stiffness?;
    let overlap = solid::linear_overlap(m, k, speed);
    let time = if spec.normal.name() == "walton-braun" {
        solid::latching_contact_time(m, k, e)
    } else {
        solid::linear_contact_time(m, k, solid::linear_damping(m, k, e))
    };
    Some((time, overlap))
}

/// Largest stable step (s) of a packed bed whose contacts are like that of `a` and `b`, at the overlap `overlap` (m)
/// where their stiffness depends on it.
#[must_use]
pub fn packed_step(
    spec: &ContactSpec,
    materials: &[Material],
    a: Body,
    b: Body,
    overlap: f64,
) -> Option<f64> {
    let pair = spec.pairs.get(a.material, b.material);
    let m = 1.0 / (1.0 / a.mass + 1.0 / b.mass);
    let e = pair.restitution;
    let (omega, zeta) = match spec.normal {
        NormalLaw::Linear => ((pair.stiffness? / m).sqrt(), solid::damping_ratio(e)),
        // Unloading is the stiffer of the two branches; it loses no energy by damping.
        NormalLaw::WaltonBraun => ((solid::latching_unloading_stiffness(pair.stiffness?, e) / m).sqrt(), 0.0),
        NormalLaw::Hertz | NormalLaw::DampedHertz => {
            let k = hertz_stiffness(pair, materials, a, b)?;
            let omega = (1.5 * k * overlap.sqrt() / m).sqrt();
            let damping = match spec.normal {
                NormalLaw::Hertz => {
                    5.0_f64.sqrt() * solid::damping_ratio(e) * (m * k).sqrt() * overlap.powf(0.25)
                }
                _ => {
                    let beta = solid::viscous_damping_number(e);
                    solid::viscous_damping(beta, m, k, pair.at_speed?) * overlap.sqrt()
                }
            };
            (omega, damping / (2.0 * m * omega))
        }
    };
    let (zeta, across) = match (spec.tangential, pair.tangential_damping) {
        (TangentialLaw::None, _) => (zeta, Across::Nothing),
        (TangentialLaw::Coulomb, None) => (zeta, Across::Coulomb),
        // A given dashpot weighs with the normal one: z/3 of 2 zeta h beside 2z/3 of gamma dt/m.
        (TangentialLaw::Coulomb, Some(gamma)) => (zeta + gamma / (m * omega), Across::Nothing),
        _ => (zeta, Across::Springs),
    };
    Some(solid::packed_step(omega, zeta, across))
}
