//! Every set of instructions gives the bits of plain arithmetic.

use super::{Job, Level, Wide};
use crate::contact::{Mask, V3};
use crate::packed::{Force, Row, Spin};
use brazilnut_base::random::stream;
use rand::RngExt;

const N: usize = 40;

struct Probe {
    rows: Vec<Row>,
    spins: Vec<Spin>,
    i: [u32; 8],
    j: [u32; 8],
    count: usize,
}

impl Probe {
    fn new(seed: u64) -> Self {
        let mut rng = stream(seed, "lanes", 0);
        let mut any = || 2.0 * rng.random::<f64>() - 1.0;
        let rows = (0..N).map(|_| Row(std::array::from_fn(|_| any()))).collect();
        let spins = (0..N).map(|_| Spin(std::array::from_fn(|_| any()))).collect();
        let mut index = || ((any() + 1.0) * 0.5 * N as f64) as u32;
        // Bodies may come twice in a batch, as in a bed.
        let (i, j) =
            (std::array::from_fn(|k| if k < 3 { 7 } else { index() }), std::array::from_fn(|_| index()));
        Self { rows, spins, i, j, count: 1 + seed as usize % 8 }
    }
}

/// All that a lane type does, as bits.
impl Job for &Probe {
    type Output = Vec<u64>;

    #[inline(always)]
    fn run<R: Wide>(self) -> Vec<u64> {
        let mut all = vec![[0.0; 8]; 40];
        // One set per way of adding: sums of the same body must run in the order of the pairs.
        let mut forces = vec![Force::default(); 6 * N];
        let mut masks = [0u64; 2];
        for p in (0..8).step_by(R::WIDTH) {
            let (i, j) = (&self.i[p..p + R::WIDTH], &self.j[p..p + R::WIDTH]);
            let a = R::relative(&self.rows, i, j);
            let b = R::spin_sum(&self.spins, i, j);
            let w = R::spin_difference(&self.spins, i, j);
            let v = V3::new(a[0], a[1], a[2]);
            let u = V3::new(b[0], b[1], b[2]);
            let c = v.cross(u);
            let (less, most) = (a[0].lt(b[0]), a[1].le(a[1]));
            masks[0] |= u64::from((less & !b[1].lt(a[1])).bits()) << p;
            masks[1] |= u64::from((less | most).bits()) << p;
            let nan = R::zero() / R::zero();
            let values = [
                a[0],
                a[1],
                a[2],
                a[3],
                a[4],
                a[5],
                a[6],
                a[7],
                b[0],
                b[1],
                b[2],
                b[3],
                w[0],
                w[1],
                w[2],
                c.x,
                c.y,
                c.z,
                v.dot(u),
                v.length(),
                a[0] / a[1],
                -a[2],
                a[3].abs(),
                a[4].min(a[5]),
                a[4].max(a[5]),
                R::pick(less, a[6], a[7]),
                a[0].keep(less),
                a[0].abs().cbrt(),
                nan.min(a[0]),
                nan.max(a[0]),
            ];
            for (slot, x) in all.iter_mut().zip(values) {
                x.store(&mut slot[p..]);
            }
            let count = R::WIDTH.min(self.count.saturating_sub(p));
            let columns = [c.x, c.y, c.z, u.x, u.y, u.z];
            for (set, sides) in [(true, true), (true, false), (false, true)].into_iter().enumerate() {
                let (near, far) = forces[2 * set * N..2 * (set + 1) * N].split_at_mut(N);
                R::scatter::<true>(&columns, near, (0, 0), i, j, count, sides);
                R::scatter::<false>(&columns, far, (0, 0), i, j, count, sides);
            }
        }
        let numbers = all.into_iter().flatten().chain(forces.into_iter().flat_map(|f| f.0));
        numbers.map(f64::to_bits).chain(masks).collect()
    }
}

#[test]
fn every_level_gives_the_same_bits() {
    for seed in 0..50 {
        let probe = Probe::new(seed);
        let plain = Level::Plain.run(&probe);
        let filled = plain.iter().filter(|&&b| b != 0).count();
        assert!(filled > 200, "only {filled} numbers to compare");
        for level in Level::all() {
            let wide = level.run(&probe);
            let differs = (0..plain.len()).find(|&k| wide[k] != plain[k]);
            assert!(differs.is_none(), "{level:?} at {differs:?} of {}", plain.len());
        }
    }
}
