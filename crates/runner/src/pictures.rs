//! Pictures of the bed: grains keep the colour of the layer they started in.

use brazilnut_base::{Cell, Vec3};
use brazilnut_grains::Grains;
use brazilnut_report::picture::{self, Camera, Format, Scene, Sphere};
use brazilnut_sim::Plan;
use brazilnut_sim::plan::Medium;
use serde::{Deserialize, Serialize};

/// Layers of this many mean diameters alternate in colour.
const LAYER: f64 = 3.0;

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

    /// A picture as PNG.
    #[must_use]
    pub fn picture(&self, cell: &Cell, grains: &Grains) -> Vec<u8> {
        let spheres = (0..grains.len())
            .map(|k| {
                let species = usize::from(grains.species[k]);
                let colour = if self.special.get(species).copied().unwrap_or(false) {
                    picture::species(2 + species)
                } else {
                    picture::by_layer(self.heights.get(k).copied().unwrap_or(0.0), self.layer)
                };
                Sphere { centre: grains.position[k], radius: grains.radius[k], colour }
            })
            .collect();
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
}
