//! Values beyond the sides, such that plain differences meet the conditions there.
//!
//! ```text
//! tangential, no slip:   v(-1) = 2 U - v(0)         Clément 2.2.2
//! tangential, free slip: v(-1) = v(0)
//! normal, wall at face 0: u(-1) = 2 u(0) - u(1)
//! open: v(-1) = v(0); P(-1) = 2 P_out - P(0)
//! ```

use crate::boundary::Boundary;
use crate::field::{CellField, Faces};
use crate::grid::GHOSTS;
use crate::shape::Shape;
use crate::spec::FluidSpec;
use brazilnut_base::Side;

/// One layer of ghosts: `add` plus weighted layers of the interior.
#[derive(Clone, Copy, Debug, Default)]
struct Layer {
    to: usize,
    from: [usize; 2],
    weight: [f64; 2],
    add: f64,
}

/// The ghost layers of one field along one level.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Layers {
    layers: [Layer; 4],
    count: usize,
}

/// The ghost layers of the three velocity components (by level) and the pressure, along each level.
pub(crate) type Table = [[Layers; 3]; 4];

/// What stands at one end of a field along a level.
#[derive(Clone, Copy, Debug)]
enum Rule {
    Periodic,
    /// `twice` plus `sign` times the mirror image about the wall, half a cell beyond the last value.
    Mirror {
        sign: f64,
        twice: f64,
    },
    /// The wall holds a value itself; beyond it the field goes on straight.
    Straight,
    /// The last value goes on.
    Level,
}

impl Layers {
    /// `points` is the number of values of the field proper between the ghosts:
    /// `n` at centres, `n + 1` for faces across the level.
    fn new(n: usize, across: bool, rules: [Rule; 2]) -> Self {
        let mut all = Self::default();
        let g = GHOSTS;
        let last = if across { n } else { n - 1 };
        if matches!(rules[0], Rule::Periodic) {
            for (to, from) in [(g - 1, g + n - 1), (g - 2, g + n - 2), (g + n, g), (g + n + 1, g + 1)] {
                all.push(Layer { to, from: [from; 2], weight: [1.0, 0.0], add: 0.0 });
            }
            return all;
        }
        for depth in 1..=GHOSTS {
            all.end(g - depth, g, depth, rules[0], |i, d| i + d);
            if last + depth < n + GHOSTS {
                all.end(g + last + depth, g + last, depth, rules[1], |i, d| i - d);
            }
        }
        all
    }

    /// The layer `to`, `depth` beyond the last value at `edge`; `inward` steps from the edge.
    fn end(&mut self, to: usize, edge: usize, depth: usize, rule: Rule, inward: fn(usize, usize) -> usize) {
        self.push(match rule {
            Rule::Mirror { sign, twice } => {
                Layer { to, from: [inward(edge, depth - 1); 2], weight: [sign, 0.0], add: twice }
            }
            Rule::Straight => Layer { to, from: [edge, inward(edge, depth)], weight: [2.0, -1.0], add: 0.0 },
            Rule::Level | Rule::Periodic => Layer { to, from: [edge; 2], weight: [1.0, 0.0], add: 0.0 },
        });
    }

    fn push(&mut self, layer: Layer) {
        self.layers[self.count] = layer;
        self.count += 1;
    }

    /// Fills the ends of a row, given from its first ghost on.
    #[inline(always)]
    pub fn fill_row(&self, row: &mut [f64]) {
        for l in &self.layers[..self.count] {
            row[l.to] = l.add + l.weight[0] * row[l.from[0]] + l.weight[1] * row[l.from[1]];
        }
    }

    /// Fills ghost rows of a plane or ghost planes of a field, `unit` numbers each.
    pub fn fill_units(&self, data: &mut [f64], unit: usize) {
        for l in &self.layers[..self.count] {
            for x in 0..unit {
                let (a, b) = (data[l.from[0] * unit + x], data[l.from[1] * unit + x]);
                data[l.to * unit + x] = l.add + l.weight[0] * a + l.weight[1] * b;
            }
        }
    }
}

/// All ghost layers at time `time` (s).
pub(crate) fn table(spec: &FluidSpec, shape: &Shape, time: f64) -> Table {
    std::array::from_fn(|field| {
        std::array::from_fn(|level| {
            let rules = [0, 1].map(|end| match shape.side[level] {
                Side::Walls => side_rule(spec, shape, field, level, end, time),
                _ => Rule::Periodic,
            });
            if shape.side[level] == Side::Flat {
                Layers::default()
            } else {
                Layers::new(shape.n[level], field == level, rules)
            }
        })
    })
}

/// The ghost layers of a change of pressure: none of it at held ends.
pub(crate) fn change(spec: &FluidSpec, shape: &Shape) -> [Layers; 3] {
    let mut spec = spec.clone();
    for side in spec.sides.iter_mut().flatten() {
        if let Boundary::Outflow { pressure } = side {
            *pressure = 0.0;
        }
    }
    table(&spec, shape, 0.0)[3]
}

fn side_rule(spec: &FluidSpec, shape: &Shape, field: usize, level: usize, end: usize, time: f64) -> Rule {
    let side = &spec.sides[shape.axis[level]][end];
    let even = Rule::Mirror { sign: 1.0, twice: 0.0 };
    let odd = |value: f64| Rule::Mirror { sign: -1.0, twice: 2.0 * value };
    if field == 3 {
        return if let Boundary::Outflow { pressure } = side { odd(*pressure) } else { even };
    }
    let normal = field == level;
    match side {
        Boundary::Outflow { .. } if normal => Rule::Level,
        _ if normal => Rule::Straight,
        Boundary::FreeSlip | Boundary::Outflow { .. } => even,
        Boundary::NoSlip | Boundary::Inflow { .. } => odd(0.0),
        Boundary::MovingLid { velocity, motion } => {
            odd((*velocity + motion.at(time).velocity)[shape.axis[field]])
        }
    }
}

/// Fills all ghosts of one field from its interior, level by level so that edges and corners follow.
pub(crate) fn fill_field(values: &mut [f64], shape: &Shape, layers: &[Layers; 3]) {
    let row = if shape.stride[1] == 0 { shape.plane } else { shape.stride[1] };
    for row in values.chunks_exact_mut(row) {
        layers[0].fill_row(row);
    }
    for plane in values.chunks_exact_mut(shape.plane) {
        layers[1].fill_units(plane, shape.stride[1]);
    }
    layers[2].fill_units(values, shape.stride[2]);
}

/// Fills all ghosts of velocity and pressure.
pub(crate) fn fill(velocity: &mut Faces, pressure: &mut CellField, shape: &Shape, table: &Table) {
    for level in 0..3 {
        fill_field(velocity.component_mut(shape.axis[level]), shape, &table[level]);
    }
    fill_field(&mut pressure.values, shape, &table[3]);
}
