//! What a picture must show, whatever it looks like.

use super::*;
use brazilnut_base::{Side, vec3};

/// Red, green and blue of every pixel.
fn pixels(png: &[u8]) -> (usize, Vec<[u8; 3]>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    (info.width as usize, bytes.chunks(3).map(|c| [c[0], c[1], c[2]]).collect())
}

fn ball(x: f64, y: f64, z: f64, colour: Rgb) -> Sphere {
    Sphere { centre: vec3(x, y, z), radius: 1.0, colour }
}

const SMALL: Format = Format { width: 120, height: 90, samples: 2 };

#[test]
fn the_nearer_sphere_hides_the_farther() {
    let (red, blue) = ([0.9, 0.1, 0.1], [0.1, 0.1, 0.9]);
    let scene =
        Scene { spheres: vec![ball(0.0, 5.0, 0.0, blue), ball(0.0, 0.0, 0.0, red)], ..Scene::default() };
    let (w, p) = pixels(&render(&scene, &Camera::FRONT, SMALL));
    let [r, _, b] = p[45 * w + 60];
    assert!(r > 2 * b, "the middle is red");
}

#[test]
fn a_sphere_is_as_large_as_it_should_be() {
    // A ball of radius 1 in a view of 4 by 3 without perspective, less a margin of 4.5 % of the height at each side:
    // the height decides.
    let view = Some((vec3(-2.0, -1.0, -1.5), vec3(2.0, 1.0, 1.5)));
    let scene = Scene { spheres: vec![ball(0.0, 0.0, 0.0, [0.5; 3])], view, ..Scene::default() };
    let (w, p) = pixels(&render(&scene, &Camera::FRONT, Format { width: 400, height: 300, samples: 2 }));
    let across = p[150 * w..151 * w].iter().filter(|c| c[0] < 225).count() as f64;
    // One pixel at each edge.
    assert!((across - 2.0 * (300.0 - 27.0) / 3.0).abs() <= 2.0, "{across}");
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let spheres =
        (0..60).map(|k| ball(f64::from(k % 8) * 1.9, f64::from(k / 8), f64::from(k % 5), AMBER)).collect();
    let scene =
        Scene { spheres, cell: Some((vec3(-1.0, -1.0, -1.0), vec3(15.0, 8.0, 6.0))), ..Scene::default() };
    let draw = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&scene, &Camera::CORNER, SMALL))
    };
    assert_eq!(draw(1), draw(3));
}

#[test]
fn odd_scenes_are_drawn() {
    let nan = Sphere { centre: Vec3::NAN, radius: 1.0, colour: AMBER };
    let point = Sphere { centre: Vec3::ZERO, radius: 0.0, colour: AMBER };
    for spheres in [vec![], vec![nan], vec![point], vec![ball(0.0, 0.0, 0.0, AMBER), nan]] {
        let png = render(&Scene { spheres, ..Scene::default() }, &Camera::CORNER, SMALL);
        assert_eq!(pixels(&png).1.len(), 120 * 90);
    }
}

#[test]
fn a_neighbour_darkens_where_it_touches() {
    let one = Scene {
        spheres: vec![ball(0.0, 0.0, 0.0, [0.8; 3])],
        view: Some((vec3(-2.0, -1.0, -1.0), vec3(2.0, 1.0, 1.0))),
        ..Scene::default()
    };
    let mut two = one.clone();
    // To the right, away from the lamp: it takes away sky, not lamp light.
    two.spheres.push(ball(2.0, 0.0, 0.0, [0.8; 3]));
    let bright = |scene: &Scene| {
        let (w, p) = pixels(&render(scene, &Camera::FRONT, Format { width: 400, height: 200, samples: 2 }));
        u32::from(p[100 * w + 200 + 75][1])
    };
    assert!(bright(&two) + 8 < bright(&one), "{} {}", bright(&two), bright(&one));
}

#[test]
fn a_plane_case_is_seen_from_the_front() {
    let cell = Cell { size: vec3(10.0, 1.0, 20.0), sides: [Side::Walls, Side::Flat, Side::Walls] };
    let scene = Scene::of_bed(&cell, vec![ball(5.0, 0.0, 1.0, AMBER)], 4.0, false);
    assert_eq!(scene.view, Some((vec3(0.0, -1.0, 0.0), vec3(10.0, 1.0, 4.0))));
    assert!(scene.open_top && scene.fluid.is_none());
    assert_eq!(Camera::for_cell(&cell), Camera::FRONT);
}
