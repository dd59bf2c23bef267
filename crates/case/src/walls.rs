//! What bounds the grains: the sides of the cell and the obstacles inside it.

use crate::parts::{self, SIDES};
use brazilnut_base::motion::Motion;
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Side, Vec3};
use brazilnut_grains::packing::{Region, Sizes};
use brazilnut_grains::{Arrangement, Material, WallShape, WallSpec};

/// The walls of the cell's sides and the lasting obstacles.
pub(crate) fn walls(v: &Values, cell: &Cell, materials: &[Material]) -> Vec<WallSpec> {
    let index = |name: &str| materials.iter().position(|m| m.name == name).unwrap_or(0) as u16;
    let names = parts::side_materials(v);
    let floor_alone = parts::shakes_the_floor(v);
    let mut walls = vec![];
    for (k, side) in SIDES.iter().enumerate().filter(|(k, _)| cell.sides[k / 2] == Side::Walls) {
        let axis = k / 2;
        let at = if k % 2 == 0 { 0.0 } else { cell.size[axis] };
        let shape = match bumps(v, side) {
            Some((arrangement, radius)) => {
                WallShape::Bumps { axis, at, radius, spacing: 2.0 * radius, arrangement }
            }
            None => {
                let (mut point, mut normal) = (Vec3::ZERO, Vec3::ZERO);
                point[axis] = at;
                normal[axis] = if k % 2 == 0 { 1.0 } else { -1.0 };
                WallShape::Plane { point, normal }
            }
        };
        let motion = match side_table(v, side).and_then(|t| t.table_opt("motion")) {
            Some(own) => parts::motion(own, v.number("gravity")),
            None if floor_alone && *side == "floor" => parts::shaking(v),
            None => Motion::default(),
        };
        walls.push(WallSpec { name: (*side).to_string(), shape, material: index(&names[k]), motion });
    }
    walls.extend(obstacles(v, materials, false));
    walls
}

/// Obstacles that last (`until_settled` false) or are taken away after settling.
pub(crate) fn obstacles(v: &Values, materials: &[Material], until_settled: bool) -> Vec<WallSpec> {
    let general = v.table_opt("walls").map_or("wall", |w| w.text("material"));
    v.tables("obstacles")
        .filter(|o| o.flag("until_settled") == until_settled)
        .filter_map(|o| {
            let material = o.text_opt("material").unwrap_or(general);
            Some(WallSpec {
                name: o.text("name").to_string(),
                shape: WallShape::Box { low: o.vector_opt("from")?, high: o.vector_opt("to")? },
                material: materials.iter().position(|m| m.name == material).unwrap_or(0) as u16,
                motion: o
                    .table_opt("motion")
                    .map_or_else(Motion::default, |m| parts::motion(m, v.number("gravity"))),
            })
        })
        .collect()
}

/// The part of the cell between bumpy sides.
pub(crate) fn room(v: &Values, cell: &Cell) -> Region {
    let mut room = Region { low: Vec3::ZERO, high: cell.size };
    for (k, side) in SIDES.iter().enumerate().filter(|(k, _)| cell.sides[k / 2] == Side::Walls) {
        let radius = bumps(v, side).map_or(0.0, |b| b.1);
        if k % 2 == 0 {
            room.low[k / 2] += radius;
        } else {
            room.high[k / 2] -= radius;
        }
    }
    room
}

/// Diameter of a sphere that just passes between three or four bumps of diameter 1 side by side.
pub(crate) fn hole(arrangement: Arrangement) -> f64 {
    match arrangement {
        Arrangement::Square => 2.0_f64.sqrt() - 1.0,
        Arrangement::Triangular => 2.0 / 3.0_f64.sqrt() - 1.0,
    }
}

/// Arrangement and radius of the bumps of a side.
pub(crate) fn bumps(v: &Values, side: &str) -> Option<(Arrangement, f64)> {
    let wall = side_table(v, side)?;
    let arrangement = match wall.text_opt("surface")? {
        "bumpy-square" => Arrangement::Square,
        "bumpy-triangular" => Arrangement::Triangular,
        _ => return None,
    };
    let diameter = wall.number_opt("bump_diameter").or_else(|| {
        let g = v.tables("grains").next()?;
        let [a, b] = Sizes::read(g.table_opt("diameter")?).ok()?.range();
        Some(0.5 * (a + b))
    })?;
    Some((arrangement, 0.5 * diameter))
}

/// What the case says of a side.
pub(crate) fn side_table<'a>(v: &'a Values, side: &str) -> Option<&'a Values> {
    v.table_opt("walls")?.table_opt(side)
}
