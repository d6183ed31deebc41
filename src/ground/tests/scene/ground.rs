use crossbar_ground::io::scenes;
use crossbar_ground::scene::built::ground::{GROUND_SIDE, ground, ground_of, on_ground};
use glam::DVec3;

#[test]
fn the_ground_of_the_paper_has_36_864_vertices_and_looks_up() {
    let ground = ground(GROUND_SIDE, DVec3::new(1.0, 2.0, -3.0), 4.0);
    assert_eq!((ground.positions().len(), ground.len()), (36_864, 2 * 191 * 191));
    assert_eq!(ground.bounds(), Some([[-3.0, -2.0, -3.0], [5.0, 6.0, -3.0]]));
    assert!(ground.vertex_normals().iter().all(|normal| *normal == DVec3::Z));
}

/// No triangle of a box lies in the plane of its ground, and the gap between them is too small to be visible.
#[test]
fn a_flat_base_lies_above_its_ground() {
    let model = scenes::named("white-box").expect("a scene").mesh().clone();
    let [low, high] = model.bounds().expect("bounds");
    let [below, _] = ground_of(&model, 4).bounds().expect("bounds");
    assert_eq!(f64::from(low[2] - below[2]), f64::from(high[0] - low[0]) / 1024.0);
}

#[test]
fn a_model_stands_on_its_ground() {
    let model = crossbar_base::geom::teapot::teapot(2).expect("a teapot");
    let (both, materials) = on_ground(&model, GROUND_SIDE).expect("a mesh");
    assert_eq!(materials.iter().filter(|&&material| material == 0).count(), model.len());
    assert_eq!(both.positions().len(), model.positions().len() + 36_864);
    assert_eq!(both.bounds().map(|[low, _]| low[2]), model.bounds().map(|[low, _]| low[2]));
    assert_eq!(both.normals().map(<[_]>::len), Some(both.positions().len()));
}
