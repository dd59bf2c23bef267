//! Draws one of each kind into a folder, to be looked at:
//! `cargo run --release -p brazilnut-report --example gallery -- OUT`.

use brazilnut_base::figure::{Axis, Body, Curve, Figure, Raster, Style};
use brazilnut_base::random::stream;
use brazilnut_base::{Cell, Side, Vec3, vec3};
use brazilnut_report::html::{Content, Image, Report};
use brazilnut_report::picture::{self, Arrow, Camera, Format, Scene, Sphere};
use brazilnut_report::{Sheet, svg};
use rand::RngExt;
use std::f64::consts::PI;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let out = env::args().nth(1).unwrap_or_else(|| "gallery".into());
    fs::create_dir_all(&out)?;
    let figures = figures();
    for (k, figure) in figures.iter().enumerate() {
        fs::write(format!("{out}/plot-{k}.svg"), svg(figure))?;
    }
    let mut images = vec![];
    for (name, dome, camera) in
        [("level", 0.0, Camera::CORNER), ("dome", 1.0, Camera::CORNER), ("front", 1.0, Camera::FRONT)]
    {
        let scene = bed(dome);
        let start = std::time::Instant::now();
        let png = picture::render(&scene, &camera, Format::fitting(&scene, &camera, 900));
        println!("{name}: {} ms, {} kB", start.elapsed().as_millis(), png.len() / 1000);
        fs::write(format!("{out}/bed-{name}.png"), &png)?;
        images.push(Image::new(png, format!("bed: {name}")));
    }
    let mut sheet = Sheet::new("");
    sheet.group("grains").row("number", "2500", "bronze").row("mass", "37.1 g", "");
    sheet.group("shaking").row("Γ", "3.00", "Clément 2009, eq. 1.1").row("frequency", "10 Hz", "");
    sheet.warn("the time step is 1/18 of the shortest contact; 1/25 is safer");
    let report = Report::new("Heaping of bronze grains in water")
        .subtitle("a gallery of what a report may hold")
        .section("Start-up sheet", vec![Content::Sheet(sheet)])
        .section("Pictures", vec![Content::Images(images)])
        .section("Plots", vec![Content::Figures(figures)])
        .section("How to cite", vec![Content::Verbatim("@software{brazilnut}".into())]);
    fs::write(format!("{out}/report.html"), report.to_html())
}

fn figure(title: &str, caption: &str, body: Body) -> Figure {
    Figure { title: title.into(), caption: caption.into(), body }
}

/// Some 2500 grains pushed apart under their weight; `dome` heaps them.
fn bed(dome: f64) -> Scene {
    let (w, d, n, mean) = (0.02, 0.0084, 2500_usize, 0.35e-3);
    let mut random = stream(1, "gallery", 0);
    let draws: Vec<f64> = (0..4 * n).map(|_| random.random()).collect();
    let noise = |k: usize| draws[k];
    let radius = |k: usize| mean * (0.93 + 0.14 * noise(4 * k + 3));
    let mut p: Vec<Vec3> =
        (0..n).map(|k| vec3(w * noise(4 * k), d * noise(4 * k + 1), 0.012 * noise(4 * k + 2))).collect();
    for sweep in 0..400 {
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| p[*a].x.total_cmp(&p[*b].x));
        p.iter_mut().for_each(|p| p.z -= 0.09 * mean * (1.0 - f64::from(sweep) / 400.0));
        for (i, &a) in order.iter().enumerate() {
            for &b in &order[i + 1..] {
                if p[b].x - p[a].x > 2.2 * mean {
                    break;
                }
                let (gap, reach) = (p[b] - p[a], radius(a) + radius(b));
                let apart = gap.length();
                if apart < reach {
                    let push = 0.5 * (reach - apart) / apart.max(1e-12) * gap;
                    (p[a], p[b]) = (p[a] - push, p[b] + push);
                }
            }
        }
        for k in 0..n {
            let r = radius(k);
            p[k] = p[k].max(Vec3::splat(r)).min(vec3(w - r, d - r, 1.0));
        }
    }
    let spheres = (0..n)
        .map(|k| {
            let across = 2.0 * p[k].x / w - 1.0;
            let lift = dome * 0.3 * p[k].z * (0.5 - across * across);
            let stirred = p[k].z + dome * 1e-3 * (4.0 * across).cos();
            let colour = picture::by_layer(stirred, 4.0 * mean);
            Sphere { centre: p[k] + vec3(0.0, 0.0, lift), radius: radius(k), colour }
        })
        .collect();
    let top = vec3(w, d, 0.0105);
    let arrows = if dome > 0.0 {
        let rolls = |k: i32| {
            let x = f64::from(k) / 8.0;
            (vec3(w * x, 0.0, 0.003), 0.0016 * -(2.0 * PI * x).cos())
        };
        (1..8)
            .map(rolls)
            .map(|(from, up)| Arrow { from, to: from + vec3(0.0, 0.0, up), colour: [0.1; 3] })
            .collect()
    } else {
        vec![]
    };
    let cell = Cell { size: top.with_z(0.03), sides: [Side::Walls; 3] };
    Scene { arrows, ..Scene::of_bed(&cell, spheres, top.z, true) }
}

fn figures() -> Vec<Figure> {
    vec![height(), force(), convergence(), convection(), pressure(), noisy()]
}

fn height() -> Figure {
    let t = |k: i32| f64::from(k) * 0.1;
    let line =
        |a: f64| (0..=200).map(|k| [t(k), 0.031 + a * (1.0 - (-t(k) / 4.0).exp())]).collect::<Vec<_>>();
    let mut dome = Curve::line("middle of the bed", line(0.006));
    dome.error = vec![0.0006; 201];
    let mut side = Curve::line("at the walls", line(-0.003));
    side.error = vec![0.0004; 201];
    let body = Body::Curves {
        x: Axis::linear("time", "s"),
        y: Axis::linear("surface height", "m"),
        curves: vec![dome, side],
    };
    figure(
        "The surface rises in the middle and sinks at the walls",
        "Means over one cycle; bands: one standard deviation.",
        body,
    )
}

fn force() -> Figure {
    let law = |e: f64| {
        (0..=60)
            .map(|k| {
                let d = f64::from(k) * 1e-7;
                [d, 1.2e10 * d.powf(1.5) * e]
            })
            .collect::<Vec<_>>()
    };
    let mut points =
        Curve::line("measured (Kuwabara)", law(0.97).into_iter().step_by(8).collect()).styled(Style::Points);
    points.error = points.points.iter().map(|p| 0.06 * p[1] + 3.0).collect();
    let curves = vec![
        Curve::line("Hertz", law(1.0)),
        Curve::line("damped Hertz", law(0.8)),
        Curve::line("linear spring", law(1.0).iter().map(|p| [p[0], 2.4e7 * p[0]]).collect())
            .styled(Style::Dashed),
        points,
    ];
    let body = Body::Curves { x: Axis::linear("overlap", "m"), y: Axis::linear("normal force", "N"), curves };
    figure("Force against overlap", "", body)
}

fn convergence() -> Figure {
    let line = |p: f64, a: f64| {
        (0..8)
            .map(|k| {
                let h = 0.1 * 0.5f64.powi(k);
                [h, a * h.powf(p)]
            })
            .collect::<Vec<_>>()
    };
    let mut measured = Curve::line("error of velocity", line(1.97, 3.0)).styled(Style::Points);
    measured.error = measured.points.iter().map(|p| 0.3 * p[1]).collect();
    let curves = vec![
        measured,
        Curve::line("error of pressure", line(1.9, 20.0)).styled(Style::Points),
        Curve::line("second order", line(2.0, 6.0)).styled(Style::Dashed),
    ];
    let body = Body::Curves {
        x: Axis::log("cell size over grain diameter", "1"),
        y: Axis::log("error", "m/s"),
        curves,
    };
    figure("Order of convergence", "", body)
}

fn convection() -> Figure {
    let (nx, nz, w, h) = (21, 13, 0.1, 0.045);
    let at = |i: usize, k: usize| [(i as f64 + 0.5) / nx as f64 * w, (k as f64 + 0.5) / nz as f64 * h];
    let roll = |[x, z]: [f64; 2]| {
        let (a, b) = (2.0 * PI * x / w, PI * z / h);
        [1.1e-3 * a.sin() * b.cos(), -1.1e-3 * 0.9 * a.cos() * b.sin()]
    };
    let arrows = (0..nx * nz).map(|m| (at(m % nx, m / nx), roll(at(m % nx, m / nx)))).collect();
    let outline = vec![[0.0, h], [0.0, 0.0], [w, 0.0], [w, h]];
    let surface = (0..=40)
        .map(|k| {
            let x = f64::from(k) / 40.0;
            [x * w, h * (0.9 + 0.1 * (PI * x).sin())]
        })
        .collect();
    let body = Body::Map {
        x: Axis::linear("x", "m"),
        y: Axis::linear("z", "m"),
        raster: None,
        arrows,
        arrow_unit: "m".into(),
        lines: vec![outline, surface],
    };
    figure("Displacement per cycle", "Two rolls of opposite circulation.", body)
}

fn pressure() -> Figure {
    let shape = [40, 26];
    let extent = [0.0, 0.04, 0.0, 0.026];
    let at = |m: usize| [((m % 40) as f64 + 0.5) * 1e-3, ((m / 40) as f64 + 0.5) * 1e-3];
    let values = (0..1040)
        .map(|m| {
            let [x, z] = at(m);
            if (x - 0.03).hypot(z - 0.013) < 0.004 {
                f64::NAN
            } else {
                -220.0 * (x / 0.04 - 0.4) * (1.0 - z / 0.026)
            }
        })
        .collect();
    let arrows = (0..1040)
        .filter(|m| m % 2 == 0 && (m / 40) % 2 == 0)
        .map(|m| {
            let [x, z] = at(m);
            (at(m), [0.02 * (z / 0.026), 0.02 * (x / 0.04 - 0.5)])
        })
        .collect();
    let ring = (0..=60)
        .map(|k| {
            let a = PI * f64::from(k) / 30.0;
            [0.03 + 0.004 * a.cos(), 0.013 + 0.004 * a.sin()]
        })
        .collect();
    let body = Body::Map {
        x: Axis::linear("x", "m"),
        y: Axis::linear("z", "m"),
        raster: Some(Raster { shape, extent, values, label: "reduced pressure".into(), unit: "Pa".into() }),
        arrows,
        arrow_unit: "m/s".into(),
        lines: vec![ring],
    };
    figure("Pressure and flow round an intruder", "", body)
}

fn noisy() -> Figure {
    let wave = |k: usize, c: f64| {
        let t = k as f64 * 1e-4;
        [t, (40.0 * t + c).sin() * (1.0 + 0.2 * (7000.0 * t).sin()) * 1e-5]
    };
    let curves = (0..6)
        .map(|c| {
            Curve::line(
                format!("{} % along the base", 20 * c),
                (0..20000).map(|k| wave(k, c as f64)).collect(),
            )
        })
        .collect();
    let body = Body::Curves { x: Axis::linear("time", "s"), y: Axis::linear("kinetic energy", "J"), curves };
    figure(
        "Six long curves that leave no corner free for a legend, with a title that is long enough to need a second line",
        "",
        body,
    )
}
