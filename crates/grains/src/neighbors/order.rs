//! Sorting grains by cell, so that neighbours lie near each other in memory.

use super::grid::Grid;
use crate::packed::Row;
use crate::state::DemState;

/// Work space of sorting.
#[derive(Clone, Debug, Default)]
pub struct Order {
    /// Cell of each row before sorting.
    cell: Vec<u32>,
    /// Old row of each new row.
    from: Vec<u32>,
}

impl Order {
    /// Sorts the small grains of `state` by the cells of `grid` and fills `grid.start`.
    pub fn sort(&mut self, state: &mut DemState, grid: &mut Grid) {
        let n = state.small;
        self.count(&state.rows[..n], grid);
        // `cell` has done its work: it marks the rows already moved.
        let done = &mut self.cell;
        permute(&mut state.rows[..n], &self.from, done);
        permute(&mut state.spins[..n], &self.from, done);
        permute(&mut state.halves[..n], &self.from, done);
        permute(&mut state.tags[..n], &self.from, done);
        permute(&mut state.rest[..n], &self.from, done);
        if !state.higher.is_empty() {
            permute(&mut state.higher[..n], &self.from, done);
        }
    }

    /// Counting sort: rows of one cell keep their order.
    fn count(&mut self, rows: &[Row], grid: &mut Grid) {
        let cells = grid.cells();
        let mut start = std::mem::take(&mut grid.start);
        start.clear();
        start.resize(cells + 1, 0);
        self.cell.clear();
        self.cell.extend(rows.iter().map(|r| grid.number(grid.place(r)) as u32));
        for &c in &self.cell {
            start[c as usize + 1] += 1;
        }
        for c in 0..cells {
            start[c + 1] += start[c];
        }
        self.from.clear();
        self.from.resize(rows.len(), 0);
        for (row, &c) in self.cell.iter().enumerate() {
            self.from[start[c as usize] as usize] = row as u32;
            start[c as usize] += 1;
        }
        start.copy_within(0..cells, 1);
        start[0] = 0;
        grid.start = start;
    }
}

/// `data[k] = old data[from[k]]` in place, cycle by cycle.
fn permute<T: Copy>(data: &mut [T], from: &[u32], done: &mut [u32]) {
    const DONE: u32 = u32::MAX;
    done.fill(0);
    for first in 0..from.len() {
        if done[first] == DONE {
            continue;
        }
        let kept = data[first];
        let mut to = first;
        loop {
            done[to] = DONE;
            let source = from[to] as usize;
            if source == first {
                data[to] = kept;
                break;
            }
            data[to] = data[source];
            to = source;
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn permutes_in_place() {
        let from = [2, 0, 1, 4, 3, 5];
        let mut data = [10, 11, 12, 13, 14, 15];
        super::permute(&mut data, &from, &mut [0; 6]);
        assert_eq!(data, [12, 10, 11, 14, 13, 15]);
    }
}
