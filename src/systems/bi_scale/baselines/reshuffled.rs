//! The variant that section IV-A rejects: down-sample first, rotate afterwards.
//!
//! Visibility is stored at few texels of a coarse cube in the global frame; a rotation into a vertex's frame becomes a
//! list with the coarse texel of each local direction. This is small, and L~ takes one product per local direction, but
//! down-sampling comes before the rotation. A coarse texel contributes as a whole to the local directions nearest to
//! it, and to no others. Its light and its visibility are means, so an occluder of part of a texel dims the whole
//! texel.

use rayon::prelude::*;

use super::local_transfer::{LocalTransfer, cell_integrals};
use super::stored::{StoredSize, StoredTransfer};
use crate::error::{InputError, ensure};
use crate::sphere::CubeMap;
use crate::transfer::grid::{LIGHT_SIDE, LIGHT_TEXELS, face_row_column};

/// For each vertex, visibility of a coarse cube's texels, and the list of texels.
#[derive(Clone, Debug, PartialEq)]
pub struct ReshuffledVisibility {
    cube: CubeMap,
    /// For each vertex and coarse texel, the mean visible fraction of its light texels.
    visibility: Vec<f32>,
    /// For each vertex and local direction, the coarse texel that contains the direction.
    shuffle: Vec<u16>,
    solid_angles: Vec<f64>,
}

impl ReshuffledVisibility {
    /// Creates the baseline with coarse cubes of `side` texels along an edge, a power of two up to 32. A cube with
    /// `side` 4 has 96 texels, about as many over the hemisphere as 8 x 8 local directions.
    pub fn new(transfer: &LocalTransfer<'_>, side: usize) -> Result<Self, InputError> {
        ensure!(
            side.is_power_of_two() && side <= LIGHT_SIDE,
            "expected 1, 2, 4, 8, 16 or 32 texels along an edge of the coarse cube, found {side}"
        );
        let cube = CubeMap::new(side);
        let share = 1.0 / (LIGHT_SIDE / side).pow(2) as f64;
        let of_vertex = |vertex: usize| {
            let mut means = vec![0.0; cube.len()];
            for (texel, visible) in transfer.visibility(vertex).into_iter().enumerate() {
                means[coarse(texel, side)] += share * visible;
            }
            let frame = &transfer.frames()[vertex];
            let nearest = |direction: &glam::DVec3| {
                let [face, column, row] = cube.texel_of(frame.to_global(*direction));
                ((face * side + row) * side + column) as u16
            };
            let shuffle: Vec<u16> = transfer.directions().directions().iter().map(nearest).collect();
            (means.into_iter().map(|mean| mean as f32).collect::<Vec<f32>>(), shuffle)
        };
        let all: Vec<(Vec<f32>, Vec<u16>)> = (0..transfer.frames().len()).into_par_iter().map(of_vertex).collect();
        let root = (4.0 * std::f64::consts::PI).sqrt();
        let solid_angles = cell_integrals(transfer.directions(), 1).into_iter().map(|cell| root * cell[0]).collect();
        let (visibility, shuffle): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        Ok(Self { cube, visibility: visibility.concat(), shuffle: shuffle.concat(), solid_angles })
    }
}

impl StoredTransfer for ReshuffledVisibility {
    fn sizes(&self) -> Vec<StoredSize> {
        let texel = if self.cube.len() > 256 { 2 } else { 1 };
        let numbers = self.visibility.len() as u64;
        let shuffle = texel * self.shuffle.len() as u64;
        let bytes = |each: u64| each * numbers + shuffle;
        vec![
            StoredSize { layout: "4 bytes per coarse texel, its number per direction", bytes: bytes(4) },
            StoredSize { layout: "a byte a coarse texel, its number a direction", bytes: bytes(1) },
        ]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        assert_eq!(light.len(), LIGHT_TEXELS, "a number per light texel");
        let side = self.cube.side();
        let mut radiance = vec![0.0; self.cube.len()];
        for (texel, light) in light.iter().enumerate() {
            radiance[coarse(texel, side)] += light;
        }
        for (at, radiance) in radiance.iter_mut().enumerate() {
            let [_, row, column] = face_row_column(at, side);
            *radiance /= self.cube.solid_angle(column, row);
        }
        let vertices = self.shuffle.chunks_exact(self.solid_angles.len()).zip(self.visibility.chunks(self.cube.len()));
        let of_vertex = |(shuffle, visibility): (&[u16], &[f32])| -> Vec<f64> {
            let of_direction = |(&at, solid_angle): (&u16, &f64)| {
                let at = usize::from(at);
                f64::from(visibility[at]) * radiance[at] * solid_angle
            };
            shuffle.iter().zip(&self.solid_angles).map(of_direction).collect()
        };
        vertices.flat_map(of_vertex).collect()
    }
}

fn coarse(texel: usize, side: usize) -> usize {
    let [face, row, column] = face_row_column(texel, LIGHT_SIDE);
    let parts = LIGHT_SIDE / side;
    (face * side + row / parts) * side + column / parts
}
