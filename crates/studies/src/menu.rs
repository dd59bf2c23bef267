//! The studies: a new one costs its file, its folder and an entry here.

use crate::study::Study;
use crate::{
    clement_cavity, clement_cylinder_drag, clement_falling_cylinder, clement_fig_2_4_to_2_7,
    clement_fig_4_1_to_4_3, clement_fig_5_17, clement_fig_6_11, clement_heap, clement_lubrication,
    clement_modified_kroll_peaks, clement_sedimentation, clement_sphere_drag, clement_thrown_bed,
    clement_tilt, lan_acceleration, lan_arching, lan_convection, lan_coupling_spectra, lan_depth_profiles,
    lan_expansion, lan_kinetic_theory, lan_large_sphere, lan_self_diffusion, lan_stiffness,
    lan_temperature_collisions,
};

/// A study whose folder and id agree.
macro_rules! study {
    ($id:literal, $title:literal, $run:expr) => {
        Study {
            id: $id,
            title: $title,
            published: include_str!(concat!("../../../studies/", $id, "/published.toml")),
            readme: include_str!(concat!("../../../studies/", $id, "/README.md")),
            run: $run,
        }
    };
}

/// All studies.
pub const MENU: &[Study] = &[
    study!(
        "clement-cylinder-drag",
        "Drag of a falling cylinder over its Reynolds number (Clément 2009)",
        clement_cylinder_drag::run
    ),
    study!(
        "clement-falling-cylinder",
        "A falling cylinder: springs, resolution, walls (Clément 2009)",
        clement_falling_cylinder::run
    ),
    study!("clement-cavity", "Flow in a cavity driven by its lid (Clément 2009)", clement_cavity::run),
    study!("clement-fig-2-4-to-2-7", "Two steel spheres under three contact laws (Clément 2009)", |r| Ok(
        clement_fig_2_4_to_2_7::run(r.quick).into()
    )),
    study!(
        "clement-fig-4-1-to-4-3",
        "Convection by the friction of the walls (Clément 2009)",
        clement_fig_4_1_to_4_3::run
    ),
    study!("clement-fig-5-17", "Partition instability of two coupled columns (Clément 2009)", |r| Ok(
        clement_fig_5_17::run(r.quick).into()
    )),
    study!("clement-fig-6-11", "A steel intruder rises in the Brazil-nut column (Clément 2009)", |r| Ok(
        clement_fig_6_11::run(r.quick).into()
    )),
    study!("clement-lubrication", "A sphere hits a wall in water (Clément 2009)", clement_lubrication::run),
    study!("clement-heap", "A heap on a shaken floor without walls (Clément 2009)", clement_heap::run),
    study!(
        "clement-modified-kroll-peaks",
        "Peak pressures of the modified Kroll model (Clément 2009)",
        |r| Ok(clement_modified_kroll_peaks::run(r.quick).into())
    ),
    study!(
        "clement-sedimentation",
        "200 sedimenting cylinders by three rungs (Clément 2009)",
        clement_sedimentation::run
    ),
    study!(
        "clement-sphere-drag",
        "Drag of a falling sphere over its Reynolds number (Clément 2009)",
        clement_sphere_drag::run
    ),
    study!(
        "clement-thrown-bed",
        "A bed in water thrown by a shaken cell, rung by rung (Clément 2009)",
        clement_thrown_bed::run
    ),
    study!("clement-tilt", "A bed in water piles up to one side (Clément 2009)", clement_tilt::run),
    study!("lan-arching", "Arches under a wide bed (Lan 1994)", lan_arching::run),
    study!("lan-convection", "Convection between rough walls (Lan 1994)", lan_convection::run),
    study!("lan-acceleration", "A vibrated layer from 5 to 100 Hz (Lan 1994)", lan_acceleration::run),
    study!(
        "lan-coupling-spectra",
        "How the floor's motion goes up through a layer (Lan 1994)",
        lan_coupling_spectra::run
    ),
    study!(
        "lan-depth-profiles",
        "Profiles of vibrated layers and kinetic theory (Lan 1994)",
        lan_depth_profiles::run
    ),
    study!("lan-expansion", "Expansion of a vibrated layer of 3 mm glass (Lan 1994)", lan_expansion::run),
    study!("lan-kinetic-theory", "Kinetic theory of a vibrated layer (Lan 1994)", |r| Ok(
        lan_kinetic_theory::run(r.quick).into()
    )),
    study!("lan-large-sphere", "A large sphere in a convecting bed (Lan 1994)", lan_large_sphere::run),
    study!("lan-self-diffusion", "Self-diffusion in a vibrated layer (Lan 1994)", lan_self_diffusion::run),
    study!("lan-stiffness", "Softer springs, the same profiles (Lan 1994)", lan_stiffness::run),
    study!(
        "lan-temperature-collisions",
        "Temperature and collisions of a vibrated layer (Lan 1994)",
        lan_temperature_collisions::run
    ),
];
