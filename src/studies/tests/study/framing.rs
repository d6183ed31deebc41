//! Views in which a model fills the picture.

use crossbar_base::geom::exact::Sides;
use crossbar_base::geom::teapot::teapot;
use crossbar_base::geom::vector::wide;
use crossbar_ground::tracer::HostTracer;
use crossbar_studies::study::framing::framed;
use glam::DVec3;

/// From any eye position, the teapot touches the margin on two opposite sides, and lies within the picture.
#[test]
fn a_model_fills_its_picture_from_any_eye() {
    let mesh = teapot(4).expect("a teapot");
    let points: Vec<DVec3> = mesh.positions().iter().map(|&at| wide(at)).collect();
    for (eye, [width, height]) in
        [([4.0, -9.0, 3.0], [64, 48]), ([-3.0, 7.0, 8.0], [64, 64]), ([9.0, 0.5, 0.2], [40, 80])]
    {
        let view = framed(DVec3::from(eye), &points, f64::from(width) / f64::from(height));
        let camera = view.camera(width, height).expect("a camera");
        let (hits, _) = HostTracer::new(&mesh, Sides::Both).nearest_all(&camera.rays());
        let seen: Vec<[u32; 2]> =
            (0..width * height).filter(|at| hits[*at as usize].is_some()).map(|at| [at % width, at / width]).collect();
        let range = |axis: usize| {
            let of = || seen.iter().map(|at| at[axis]);
            [of().min().expect("pixels"), of().max().expect("pixels")]
        };
        let gaps = [(0, width), (1, height)].map(|(axis, side)| {
            let [low, high] = range(axis);
            [low, side - 1 - high]
        });
        let tight = |[low, high]: [u32; 2]| (1..=4).contains(&low) && (1..=4).contains(&high);
        assert!(gaps.into_iter().any(tight) && gaps.iter().flatten().all(|gap| *gap > 0), "{eye:?}: {gaps:?}");
    }
}
