//! The matrix T: the texels that a vertex sees, and the local directions to which their light is assigned.

use crossbar::bi_scale::directions::LocalDirections;
use crossbar::bi_scale::matrix::MatrixEntry;
use crossbar::bi_scale::transfer::transfer_matrix;
use crossbar::sphere::CUBE_FACES;
use crossbar::transfer::visibility::Horizon;
use glam::DVec3;

use super::sight;

/// The direction of a light texel's center, computed from the axes of its face.
pub(super) fn center(texel: usize) -> DVec3 {
    let axes = CUBE_FACES[texel / 1024];
    let place = |at: usize| (2 * at + 1) as f64 / 32.0 - 1.0;
    (axes.center + place(texel % 32) * axes.right + place(texel / 32 % 32) * axes.down).normalize()
}

/// The matrix T equals loops over texels and directions, as section IV-A defines it.
#[test]
fn texels_go_to_the_nearest_local_direction() {
    for (log2_samples, side, horizon) in [(0, 4, Horizon::Normal), (1, 8, Horizon::Geometry), (2, 5, Horizon::Normal)] {
        let (vertices, maps) = sight(log2_samples, horizon);
        let directions = LocalDirections::new(side).expect("a side");
        let matrix = transfer_matrix(&vertices, &maps, &directions).expect("a matrix");
        let (local, samples) = (side * side, 1 << log2_samples);
        assert_eq!((matrix.rows(), matrix.columns()), (vertices.len() * local, 6144));
        assert_eq!(matrix.fraction_bits(), 2 * log2_samples);
        for vertex in 0..vertices.len() {
            let frame = &vertices.frames()[vertex];
            let mut expected = vec![Vec::new(); local];
            for texel in 0..6144 {
                let (face, row, column) = (texel / 1024, texel / 32 % 32, texel % 32);
                let fine = |i: usize, j: usize| {
                    (face * 32 * samples + row * samples + i) * 32 * samples + column * samples + j
                };
                let all = (0..samples).flat_map(|i| (0..samples).map(move |j| (i, j)));
                let seen = all.filter(|&(i, j)| maps.is_visible(vertex, fine(i, j))).count();
                if seen > 0 {
                    let nearest = directions.nearest_of_all(frame.to_local(center(texel)));
                    expected[nearest].push(MatrixEntry {
                        index: texel as u32,
                        value: i32::try_from(seen).expect("sixteen at most"),
                    });
                }
            }
            for (direction, expected) in expected.iter().enumerate() {
                let differs = matrix.row(vertex * local + direction) != &expected[..];
                assert!(!differs, "vertex {vertex}, direction {direction}, {side} x {side}");
            }
        }
    }
}
