//! Room of lists: enough for their changes, and not twice as much.

/// Makes room for `len` entries, and a tenth for lists that grow a little.
pub fn hold<T>(list: &mut Vec<T>, len: usize) {
    if list.capacity() < len {
        list.reserve_exact(len + len / SLACK - list.len());
    }
}

/// Gives back what a list has doubled beyond its length and slack.
pub fn settle<T>(list: &mut Vec<T>) {
    let enough = list.len() + list.len() / SLACK + FEW;
    if list.capacity() > enough + enough / SLACK {
        list.shrink_to(enough);
    }
}

/// Part of a list that it may grow by before it moves.
const SLACK: usize = 10;
/// What a short list may grow by.
const FEW: usize = 64;
