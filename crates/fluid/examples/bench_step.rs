//! Times the pressure solve.
use brazilnut_base::Side;
use brazilnut_fluid::pressure::{Poisson, Transforms};
use brazilnut_fluid::{Grid, Instructions};
use std::time::Instant;

fn main() {
    for cells in [[100, 100, 100], [128, 128, 128], [180, 45, 180]] {
        let grid = Grid::new(cells, [1.0; 3], [Side::Walls; 3]);
        let mut best = [f64::MAX; 3];
        let solvers = [
            Poisson::new(&grid, [false; 2], Instructions::Best, Transforms::Best),
            Poisson::new(&grid, [false; 2], Instructions::Portable, Transforms::Best),
            Poisson::new(&grid, [false; 2], Instructions::Best, Transforms::Library),
        ];
        let mut data = vec![0.0; solvers[0].len()];
        for (i, x) in data.iter_mut().enumerate() {
            *x = ((i * 7919) % 1013) as f64 - 506.0;
        }
        for _ in 0..10 {
            for (s, b) in solvers.iter().zip(&mut best) {
                let t = Instant::now();
                s.solve(&mut data);
                *b = b.min(t.elapsed().as_secs_f64() * 1e9 / grid.count() as f64);
            }
        }
        println!("{cells:?} best {:.2} portable {:.2} library {:.2} ns/cell", best[0], best[1], best[2]);
    }
}
