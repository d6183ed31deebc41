//! The macro-scale transfer T (section IV-A; equations 1 and 2): the light texels that each vertex sees, and the local
//! direction to which each texel's light is assigned.
//!
//! Row M p + j is local direction j of vertex p. Column k is a light texel, with k = 1024 face + 32 row + column on a
//! cube with Direct3D's faces. A visible texel is assigned to one local direction, the nearest to the texel's center,
//! so a column has at most one entry per vertex. The entry is the visible fraction of the texel's 2^m x 2^m directions,
//! a multiple of 2^-2m. It contains neither solid angle nor cosine, which would make equal entries different: the solid
//! angle is in the light ([`light_vector`]), the cosine in the bidirectional texture.

use rayon::prelude::*;

use super::directions::LocalDirections;
use super::matrix::{MatrixEntry, SparseMatrix};
use crate::bi_scale::matrix::size_error;
use crate::error::InputError;
use crate::transfer::grid::{LIGHT_TEXELS, texel_center, texel_solid_angle};
use crate::transfer::light::CubeLight;
use crate::transfer::visibility::VisibilityMaps;
use crate::transfer::{LocalFrame, Vertices};

/// Number of vertices whose rows are computed together.
const BLOCK: usize = 256;

/// T of the vertices of visibility maps, map by map. Fails with [`InputError`] if there are no rows, or more rows than
/// 32 bits can count. Panics if the maps belong to other vertices.
pub fn transfer_matrix(
    vertices: &Vertices,
    maps: &VisibilityMaps,
    directions: &LocalDirections,
) -> Result<SparseMatrix, InputError> {
    let local = directions.directions().len();
    let rows = maps.len().saturating_mul(local);
    if rows == 0 || u32::try_from(rows).is_err() {
        return Err(size_error(rows, LIGHT_TEXELS));
    }
    let mut matrix = SparseMatrix::new(LIGHT_TEXELS, 2 * maps.sampling().log2_samples)?;
    let all: Vec<usize> = (0..maps.len()).collect();
    for block in all.chunks(BLOCK) {
        let of_block: Vec<Vec<Vec<MatrixEntry>>> = block
            .par_iter()
            .map(|&map| {
                let frame = &vertices.frames()[maps.vertices()[map] as usize];
                vertex_rows(frame, &shares(maps, map), directions)
            })
            .collect();
        for row in of_block.iter().flatten() {
            matrix.push_row(row)?;
        }
    }
    Ok(matrix)
}

/// For each light texel, the number of its directions that a vertex sees.
pub fn shares(maps: &VisibilityMaps, map: usize) -> Vec<u32> {
    let fine = maps.sampling().directions();
    let seen = |texel: usize| fine.in_texel(texel).filter(|&fine| maps.is_visible(map, fine)).count() as u32;
    (0..LIGHT_TEXELS).map(seen).collect()
}

/// T_p: for each local direction, the texels whose light is assigned to it (equation 1).
fn vertex_rows(frame: &LocalFrame, shares: &[u32], directions: &LocalDirections) -> Vec<Vec<MatrixEntry>> {
    let mut rows = vec![Vec::new(); directions.directions().len()];
    for (texel, &share) in shares.iter().enumerate().filter(|(_, share)| **share > 0) {
        let nearest = directions.nearest(frame.to_local(texel_center(texel)));
        rows[nearest].push(MatrixEntry { index: texel as u32, value: share.cast_signed() });
    }
    rows
}

/// [`light_vector`] for a light's red, green and blue.
pub fn light_vectors(light: &CubeLight) -> [Vec<f64>; 3] {
    [0, 1, 2]
        .map(|channel: usize| light_vector(&light.texels().iter().map(|texel| texel[channel]).collect::<Vec<f64>>()))
}

/// Combines three vectors into one vector of colors.
pub fn side_by_side([red, green, blue]: [Vec<f64>; 3]) -> Vec<[f64; 3]> {
    red.into_iter().zip(green).zip(blue).map(|((red, green), blue)| [red, green, blue]).collect()
}

/// L: radiance per texel times the texel's solid angle in steradians, which T does not contain. Panics if there is not
/// one number per texel.
pub fn light_vector(radiance: &[f64]) -> Vec<f64> {
    assert_eq!(radiance.len(), LIGHT_TEXELS, "radiance of each texel");
    radiance.iter().enumerate().map(|(texel, radiance)| radiance * texel_solid_angle(texel)).collect()
}
