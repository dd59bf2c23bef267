//! A block of numbers as rows, and its safe division among threads.

use crate::parallel::for_each;
use std::marker::PhantomData;

/// Rows that a transform may change.
pub(crate) trait Rows {
    /// Row `r`.
    fn row(&self, r: usize) -> &[f64];
    /// Row `r`, to be changed.
    fn row_mut(&mut self, r: usize) -> &mut [f64];
    /// How far ahead in memory lies what is needed after `width` columns of a row, if these are taken across all rows.
    fn ahead(&self, width: usize) -> usize;
}

/// The rows of one plane, one after the other.
pub(crate) struct Plane<'a> {
    pub data: &'a mut [f64],
    pub pitch: usize,
}

impl Rows for Plane<'_> {
    #[inline(always)]
    fn row(&self, r: usize) -> &[f64] {
        &self.data[r * self.pitch..][..self.pitch]
    }

    #[inline(always)]
    fn row_mut(&mut self, r: usize) -> &mut [f64] {
        &mut self.data[r * self.pitch..][..self.pitch]
    }

    /// The same place of the next plane: this one was asked for while the last one was worked on.
    #[inline(always)]
    fn ahead(&self, _: usize) -> usize {
        self.data.len()
    }
}

/// How a block of planes of rows lies in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Block {
    /// Numbers in a row, padding included: the distance between rows.
    pub pitch: usize,
    /// Rows in a plane.
    pub rows: usize,
    /// Distance between planes.
    pub plane: usize,
    /// Planes.
    pub planes: usize,
}

/// One row of each plane `first..first + count`, or a stretch of columns of them.
pub(crate) struct Slab<'a> {
    start: *mut f64,
    stride: usize,
    width: usize,
    count: usize,
    lent: PhantomData<&'a mut [f64]>,
}

impl Slab<'_> {
    /// Numbers in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn count(&self) -> usize {
        self.count
    }
}

#[allow(
    unsafe_code,
    reason = "a slab is strided memory that no slice can describe; rows of it are lent as slices"
)]
impl Rows for Slab<'_> {
    #[inline(always)]
    fn row(&self, r: usize) -> &[f64] {
        assert!(r < self.count);
        // SAFETY: `for_each_slab` checked that the row lies in the block it holds exclusively.
        unsafe { std::slice::from_raw_parts(self.start.add(r * self.stride), self.width) }
    }

    #[inline(always)]
    fn row_mut(&mut self, r: usize) -> &mut [f64] {
        assert!(r < self.count);
        // SAFETY: as above; the borrow of the slab keeps rows from being lent twice.
        unsafe { std::slice::from_raw_parts_mut(self.start.add(r * self.stride), self.width) }
    }

    /// The next columns; beyond the end of a row lies the row of the next slab.
    #[inline(always)]
    fn ahead(&self, width: usize) -> usize {
        width
    }
}

/// The block's memory, to be cut into slabs that share no number.
struct Shared(*mut f64);
#[allow(unsafe_code, reason = "slabs cut from it are disjoint")]
// SAFETY: only `for_each_slab` uses it, and hands each thread numbers of its own.
unsafe impl Sync for Shared {}

/// How [`for_each_slab`] cuts.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Cut {
    /// Slab `s` is row `s` of every plane.
    Row,
    /// For one row a plane: slab `s` is columns `s width..` of every plane.
    Columns(usize),
    /// For one row a plane: slab `s` is the whole rows of `count` planes from `s count` on.
    Planes(usize),
}

/// Calls `work(s, slab)` for every slab of `data`, side by side if `parallel`.
#[allow(unsafe_code, reason = "cuts one exclusive borrow into disjoint strided ones")]
pub(crate) fn for_each_slab(
    data: &mut [f64],
    block: Block,
    cut: Cut,
    parallel: bool,
    work: impl Fn(usize, &mut Slab<'_>) + Sync,
) {
    let Block { pitch, rows, plane, planes } = block;
    assert!(pitch * rows <= plane && plane * (planes - 1) + pitch * rows <= data.len());
    assert!(matches!(cut, Cut::Row) || rows == 1);
    let slabs = match cut {
        Cut::Row => rows,
        Cut::Columns(width) => pitch.div_ceil(width),
        Cut::Planes(count) => planes.div_ceil(count),
    };
    let shared = Shared(data.as_mut_ptr());
    let shared = &shared;
    for_each(parallel, slabs, |s| {
        let (offset, width, count) = match cut {
            Cut::Row => (s * pitch, pitch, planes),
            Cut::Columns(width) => (s * width, width.min(pitch - s * width), planes),
            Cut::Planes(count) => (s * count * plane, pitch, count.min(planes - s * count)),
        };
        // SAFETY: rows `offset + r plane .. + width`, r < count, lie inside `data` by the
        // assertion above and belong to slab `s` alone: slabs differ in row, columns or planes.
        let start = unsafe { shared.0.add(offset) };
        work(s, &mut Slab { start, stride: plane, width, count, lent: PhantomData });
    });
}
