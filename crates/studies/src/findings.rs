//! Computed beside published: the verdicts.

use crate::study::{Computed, Study};
use brazilnut_report::text::significant;
use serde::{Deserialize, Serialize};

/// How a quantity compares with what was published.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Within the tolerance.
    Match,
    /// Outside, as the study's folder admits with evidence.
    Deviates,
    /// Outside, and nobody has admitted it.
    Broken,
}

impl Verdict {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Match => "match",
            Self::Deviates => "deviates",
            Self::Broken => "broken",
        }
    }
}

/// One entry of `published.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Name of the quantity.
    pub name: String,
    /// Unit, `1` if dimensionless.
    pub unit: String,
    /// The published number.
    pub published: Option<f64>,
    /// Allowed distance over the published number.
    pub tolerance: Option<f64>,
    /// Allowed distance.
    pub tolerance_abs: Option<f64>,
    /// A statement: the quantity is at least this.
    pub at_least: Option<f64>,
    /// A statement: the quantity is at most this.
    pub at_most: Option<f64>,
    /// The tolerance of the short form, if it is another (same kind as the full form's).
    pub quick_tolerance: Option<f64>,
    /// The bound of the short form, if it is another.
    pub quick_at_least: Option<f64>,
    /// The bound of the short form, if it is another.
    pub quick_at_most: Option<f64>,
    /// Why this tolerance.
    pub why: String,
    /// Place in the source.
    pub place: String,
    /// The recorded verdict of the full form.
    pub verdict: Verdict,
    /// The recorded verdict of the short form; absent if the short form does not compute it.
    pub quick_verdict: Option<Verdict>,
}

/// One judged quantity.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// Name of the quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// What was computed.
    pub computed: f64,
    /// Its standard error over the seeds, if there are several.
    pub error: Option<f64>,
    /// What was published, if it is a number.
    pub published: Option<f64>,
    /// What is allowed, in words.
    pub tolerance: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The verdict recorded in the study's folder.
    pub recorded: Verdict,
    /// Place in the source.
    pub place: String,
}

impl Finding {
    /// One line for a terminal.
    #[must_use]
    pub fn line(&self) -> String {
        let published = self.published.map_or(String::new(), |p| format!(" published {p}"));
        let differs = if self.verdict == self.recorded { "" } else { " (recorded otherwise)" };
        format!(
            "{:<9} {:<44} {} {}{published} [{}]{differs}",
            self.verdict.name(),
            self.quantity,
            self.value(),
            self.unit,
            self.tolerance
        )
    }

    /// What was computed with its standard error, as text.
    fn value(&self) -> String {
        let value = significant(self.computed, 5);
        self.error.map_or(value.clone(), |e| format!("{value} ± {}", significant(e, 2)))
    }

    /// One row for the report.
    #[must_use]
    pub fn row(&self) -> Vec<String> {
        let published = self.published.map_or("—".into(), |p| p.to_string());
        vec![
            self.quantity.clone(),
            self.unit.clone(),
            self.value(),
            published,
            self.tolerance.clone(),
            self.verdict.name().into(),
            self.place.clone(),
        ]
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    quantity: Vec<Published>,
}

/// What the folder of `study` records.
///
/// # Errors
/// If `published.toml` is malformed.
pub fn published(study: &Study) -> Result<Vec<Published>, String> {
    let file: File =
        toml::from_str(study.published).map_err(|e| format!("studies/{}/published.toml: {e}", study.id))?;
    Ok(file.quantity)
}

/// The published number called `name` of the study `id`; not a number if there is none.
#[must_use]
pub fn printed(id: &str, name: &str) -> f64 {
    let study = crate::menu::MENU.iter().find(|s| s.id == id);
    let list = study.and_then(|s| published(s).ok()).unwrap_or_default();
    list.iter().find(|p| p.name == name).and_then(|p| p.published).unwrap_or(f64::NAN)
}

/// Judges what was computed. Every published quantity of this form must be
/// computed, and nothing else.
///
/// # Errors
/// If the two lists differ, or the record is malformed.
pub fn judge(study: &Study, computed: &[Computed], quick: bool) -> Result<Vec<Finding>, String> {
    let mut list = vec![];
    let published = published(study)?;
    if let Some(c) = computed.iter().find(|c| !published.iter().any(|p| p.name == c.name)) {
        return Err(format!("{}: `{}` is computed but not in published.toml", study.id, c.name));
    }
    for p in published {
        let Some(recorded) = (if quick { p.quick_verdict } else { Some(p.verdict) }) else { continue };
        let Some(c) = computed.iter().find(|c| c.name == p.name) else {
            return Err(format!("{}: `{}` was not computed", study.id, p.name));
        };
        let (inside, tolerance) = allowed(&p, c.value, quick);
        let verdict = match (inside, recorded) {
            (true, _) => Verdict::Match,
            (false, Verdict::Deviates) => Verdict::Deviates,
            (false, _) => Verdict::Broken,
        };
        list.push(Finding {
            quantity: p.name,
            unit: p.unit,
            computed: c.value,
            error: c.error,
            published: p.published,
            tolerance,
            verdict,
            recorded,
            place: p.place,
        });
    }
    Ok(list)
}

/// Whether `x` is allowed, and what is, in words.
fn allowed(p: &Published, x: f64, quick: bool) -> (bool, String) {
    let pick = |full: Option<f64>, short: Option<f64>| if quick { short.or(full) } else { full };
    if let Some(low) = pick(p.at_least, p.quick_at_least) {
        return (x >= low, format!("at least {low}"));
    }
    if let Some(high) = pick(p.at_most, p.quick_at_most) {
        return (x <= high, format!("at most {high}"));
    }
    let Some(value) = p.published else { return (false, "nothing to compare with".into()) };
    if let Some(t) = p.tolerance_abs {
        let t = pick(Some(t), p.quick_tolerance).unwrap_or(t);
        return ((x - value).abs() <= t, format!("± {t}"));
    }
    let t = pick(p.tolerance, p.quick_tolerance).unwrap_or(0.0);
    ((x - value).abs() <= t * value.abs(), format!("± {} %", significant(100.0 * t, 3)))
}
