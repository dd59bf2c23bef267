//! What a case may name: every family of choices is a list of entries.

/// One choice: what `describe` prints and what an error suggests.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Name in the case file, lower case with hyphens.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// The formula in plain text, empty if there is none.
    pub formula: &'static str,
    /// Source with equation number.
    pub source: &'static str,
}

/// The names of a menu.
pub fn names(menu: &[Entry]) -> impl Iterator<Item = &'static str> + '_ {
    menu.iter().map(|e| e.name)
}

/// The candidate nearest to `word`, if one is near enough to be a slip of the hand.
#[must_use]
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .map(|c| (strsim::damerau_levenshtein(word, c), c))
        .filter(|(d, c)| *d <= 1 + c.len().max(word.len()) / 3)
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

#[cfg(test)]
mod tests {
    #[test]
    fn suggests_only_what_is_near() {
        let names = ["frequency", "gamma", "ramp"];
        assert_eq!(super::nearest("freqency", names.into_iter()), Some("frequency"));
        assert_eq!(super::nearest("zzzzzzzz", names.into_iter()), None);
    }
}
