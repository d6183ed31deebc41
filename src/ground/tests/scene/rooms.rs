use approx::assert_abs_diff_eq;
use crossbar_base::geom::vector::wide;
use crossbar_ground::scene::Scene;
use crossbar_ground::scene::built::rooms::{CornellBox, cornell, furnace};

#[test]
fn closed_rooms_are_watertight_and_face_inwards() {
    let volume = |scene: &Scene| {
        let six = |[a, b, c]: [[f32; 3]; 3]| wide(a).dot(wide(b).cross(wide(c)));
        scene.mesh().iter_corners().map(six).sum::<f64>() / 6.0
    };
    assert_abs_diff_eq!(volume(&furnace(0.5)), -1.0, epsilon = 1e-12);
    let empty = volume(&cornell(CornellBox::default()));
    assert_abs_diff_eq!(empty, -(5.5 * 5.5 * 5.5), epsilon = 1e-4);
    // A block without a floor has the volume of a closed one, since its floor lies in the plane through the origin.
    let blocks = volume(&cornell(CornellBox { blocks: true, open: false })) - empty;
    assert!((9.0..14.0).contains(&blocks), "two blocks of 1.65 x 1.65, 1.65 and 3.3 high: {blocks}");
    assert_eq!(cornell(CornellBox { blocks: true, open: true }).mesh().len(), 2 * (4 + 9 + 10));
}
