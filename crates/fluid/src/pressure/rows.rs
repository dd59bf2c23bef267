//! A block of numbers as rows, and its safe division among threads.

use crate::parallel::for_each;
use std::marker::PhantomData;

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

/// Rows of numbers at a fixed distance, lent to be changed: those of a plane, one row of every plane, or a
/// stretch of columns of these.
pub(crate) struct Rows<'a> {
    start: *mut f64,
    stride: usize,
    width: usize,
    count: usize,
    in_one_plane: bool,
    lent: PhantomData<&'a mut [f64]>,
}

#[allow(
    unsafe_code,
    reason = "rows at a distance are memory that no slice can describe; each is lent as a slice"
)]
impl<'a> Rows<'a> {
    /// The rows of one plane, one after the other.
    pub fn of_plane(data: &'a mut [f64], pitch: usize) -> Self {
        Self {
            start: data.as_mut_ptr(),
            stride: pitch,
            width: pitch,
            count: data.len() / pitch,
            in_one_plane: true,
            lent: PhantomData,
        }
    }

    /// All but the first `n` rows.
    pub fn after(&mut self, n: usize) -> Rows<'_> {
        assert!(n < self.count);
        // SAFETY: row `n` is one of those that are lent.
        let start = unsafe { self.start.add(n * self.stride) };
        Rows { start, count: self.count - n, lent: PhantomData, ..*self }
    }

    /// Numbers in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Row `r`.
    #[inline(always)]
    pub fn row(&self, r: usize) -> &[f64] {
        assert!(r < self.count);
        // SAFETY: whoever made these rows holds their memory exclusively.
        unsafe { std::slice::from_raw_parts(self.start.add(r * self.stride), self.width) }
    }

    /// Row `r`, to be changed.
    #[inline(always)]
    pub fn row_mut(&mut self, r: usize) -> &mut [f64] {
        assert!(r < self.count);
        // SAFETY: as above; the borrow keeps rows from being lent twice.
        unsafe { std::slice::from_raw_parts_mut(self.start.add(r * self.stride), self.width) }
    }

    /// True for the rows of one plane.
    #[inline(always)]
    pub fn in_one_plane(&self) -> bool {
        self.in_one_plane
    }

    /// How far ahead in memory lies what is needed after these rows: the next plane, or the next row of every plane.
    #[inline(always)]
    pub fn ahead(&self) -> usize {
        if self.in_one_plane { self.count * self.stride } else { self.width }
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
    work: impl Fn(usize, &mut Rows<'_>) + Sync,
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
        work(s, &mut Rows { start, stride: plane, width, count, in_one_plane: false, lent: PhantomData });
    });
}
