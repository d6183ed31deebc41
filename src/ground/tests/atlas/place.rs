use crossbar_base::geom::Mesh;
use crossbar_ground::atlas::{Atlas, FacePlace};

const PLACES: [FacePlace; 4] = [
    FacePlace { x: 8, y: 4, width: 4, height: 4, first: 0, transposed: false },
    FacePlace { x: 0, y: 2, width: 1, height: 2, first: 1, transposed: false },
    FacePlace { x: 2, y: 0, width: 2, height: 4, first: 2, transposed: true },
    FacePlace { x: 5, y: 7, width: 1, height: 1, first: 1, transposed: true },
];

#[test]
fn the_map_and_its_inverse_are_exact() {
    for place in PLACES {
        for step in 0..=16 {
            for other in 0..=16 {
                let x = f64::from(place.x) + f64::from(place.width * step) / 16.0;
                let y = f64::from(place.y) + f64::from(place.height * other) / 16.0;
                let weights = place.weights(x, y);
                assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)), "{weights:?}");
                assert_eq!(weights.iter().sum::<f64>(), 1.0);
                assert_eq!(place.coordinates(weights), [x, y], "{place:?} {weights:?}");
            }
        }
    }
}

#[test]
fn corners_lie_where_the_place_says() {
    let place = PLACES[0];
    assert_eq!(place.weights(8.0, 4.0), [1.0, 0.0, 0.0]);
    assert_eq!(place.weights(12.0, 4.0), [0.0, 1.0, 0.0]);
    assert_eq!(place.weights(12.0, 8.0), [0.0, 0.5, 0.5]);
    assert_eq!(place.weights(8.0, 8.0), [0.0, 0.0, 1.0]);
    let turned = PLACES[2];
    assert_eq!(turned.weights(2.0, 0.0), [0.0, 0.0, 1.0], "corner 2 is a");
    assert_eq!(turned.weights(2.0, 4.0), [1.0, 0.0, 0.0], "b, along y");
    assert_eq!(turned.weights(4.0, 0.0), [0.0, 1.0, 0.0], "c, along x");
}

#[test]
fn a_face_of_one_texel_has_its_mean_at_the_centroid() {
    for place in PLACES {
        let [x, y] = [f64::from(place.x), f64::from(place.y)];
        let far = [x + f64::from(place.width), y + f64::from(place.height)];
        for weight in place.mean_weights([x, y], far) {
            approx::assert_abs_diff_eq!(weight, 1.0 / 3.0, epsilon = 1e-15);
        }
    }
}

#[test]
fn texels_of_a_right_isosceles_face_are_square() {
    let mesh = Mesh::new(vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]], vec![[0, 1, 2]]).expect("a triangle");
    let place = Atlas::new(&mesh, 4).expect("an atlas").places()[0];
    assert_eq!((place.first, place.transposed), (2, false), "the right angle at a");
}
