//! Pictures of the bed: grains keep the colour of the layer they started in.

use crate::plane::Plane;
use brazilnut_base::{Cell, Vec3};
use brazilnut_grains::Grains;
use brazilnut_observe::FlowView;
use brazilnut_report::picture::{self, Arrow, Camera, Format, Scene, Sphere};
use brazilnut_sim::Plan;
use brazilnut_sim::plan::Medium;
use serde::{Deserialize, Serialize};

/// Layers of this many mean diameters alternate in colour.
const LAYER: f64 = 3.0;

/// Length of the longest arrow of the fluid over the width of the cell.
const LONGEST: f64 = 0.09;
/// Its colour.
const ARROW: [f64; 3] = [0.05, 0.16, 0.42];

/// How the grains are coloured: fixed at time 0, so it is saved with the run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Palette {
    /// Thickness of a layer, m.
    layer: f64,
    /// Height of each grain at time 0, m.
    heights: Vec<f64>,
    /// Species that stand out in a colour of their own.
    special: Vec<bool>,
    /// A fluid fills the cell.
    wet: bool,
    /// Top of what all pictures show, m.
    top: f64,
}

impl Palette {
    /// The palette of a plan; the layers follow with [`Palette::start`].
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let most = plan.species.iter().map(|s| s.count).max().unwrap_or(0);
        let n: usize = plan.species.iter().map(|s| s.count).sum();
        let mean = plan.species.iter().map(|s| s.diameter * s.count as f64).sum::<f64>() / n.max(1) as f64;
        Self {
            layer: LAYER * mean,
            heights: vec![],
            special: plan.species.iter().map(|s| s.count * 20 < most).collect(),
            wet: !matches!(plan.medium, Medium::Dry),
            top: plan.cell.size.z,
        }
    }

    /// Notes the layers that `grains` are in at time 0.
    pub fn start(&mut self, grains: &Grains) {
        self.heights = grains.position.iter().map(|p| p.z).collect();
        let highest = grains.position.iter().zip(&grains.radius).map(|(p, r)| p.z + r).fold(0.0, f64::max);
        // Room for a bed that piles up to twice its height; empty space above says nothing.
        self.top = self.top.min(2.0 * highest);
    }

    /// The plane of the flow pictures.
    pub(crate) fn plane(&self, cell: &Cell) -> Plane {
        Plane::of(cell, self.top)
    }

    fn sphere(&self, grains: &Grains, k: usize) -> Sphere {
        let species = usize::from(grains.species[k]);
        let colour = if self.special.get(species).copied().unwrap_or(false) {
            picture::species(2 + species)
        } else {
            picture::by_layer(self.heights.get(k).copied().unwrap_or(0.0), self.layer)
        };
        Sphere { centre: grains.position[k], radius: grains.radius[k], colour }
    }

    /// A picture as PNG.
    #[must_use]
    pub fn picture(&self, cell: &Cell, grains: &Grains) -> Vec<u8> {
        let spheres = (0..grains.len()).map(|k| self.sphere(grains, k)).collect();
        let top = Vec3::new(cell.size.x, cell.size.y, self.top);
        let scene = Scene {
            spheres,
            cell: Some((Vec3::ZERO, top)),
            fluid: self.wet.then_some((Vec3::ZERO, top)),
            view: Some((Vec3::ZERO, top)),
            ..Scene::default()
        };
        let camera = if cell.flat_axis().is_some() { Camera::FRONT } else { Camera::CORNER };
        picture::render(&scene, &camera, Format::default())
    }

    /// The bed cut open in the middle, with arrows of the fluid's velocity on the cut, as PNG;
    /// and the speed of the longest arrow, m/s.
    #[must_use]
    pub fn flow_picture(&self, cell: &Cell, grains: &Grains, flow: &dyn FlowView) -> (Vec<u8>, f64) {
        let plane = self.plane(cell);
        let fluid = plane.fluid(grains, flow);
        let fastest = fluid.iter().map(|(_, v)| v.length()).fold(0.0, f64::max);
        let scale = if fastest > 0.0 { LONGEST * cell.size.x.max(cell.size.y) / fastest } else { 0.0 };
        let arrow = |(r, v): &(Vec3, Vec3)| Arrow { from: *r, to: *r + scale * *v, colour: ARROW };
        let behind = (0..grains.len()).filter(|&k| plane.is_behind(grains.position[k]));
        let mut scene =
            Scene::of_bed(cell, behind.map(|k| self.sphere(grains, k)).collect(), self.top, self.wet);
        scene.arrows = fluid.iter().map(arrow).collect();
        let camera = match cell.flat_axis() {
            Some(0) => Camera::for_cell(cell),
            _ => Camera::FRONT,
        };
        (picture::render(&scene, &camera, Format::fitting(&scene, &camera, 1000)), fastest)
    }
}
