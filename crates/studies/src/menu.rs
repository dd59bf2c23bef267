//! The studies: a new one costs its file, its folder and an entry here.

use crate::study::Study;

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
pub const MENU: &[Study] = &[];
