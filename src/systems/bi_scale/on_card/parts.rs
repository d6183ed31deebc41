//! Textures with the triangles that show them.

use std::collections::BTreeMap;
use std::ops::Range;

use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::Machine;

use super::options::DisplayOptions;
use super::subject::{CardVertices, TexturedMesh};
use super::textures::VolumeTexture;
use crate::bi_scale::kernels::{DisplayKernel, FIRST_ORIGIN, LocalLayout};
use crate::card::{CardError, WrittenKernel};

/// A texture, its triangles and its programs: a place in a volume depends on the volume's size.
#[derive(Debug)]
pub(super) struct CardPart {
    pub(super) indices: Vec<u32>,
    pub(super) volume: VolumeTexture,
    /// By number of directions: of a full pass, and of the last one if it has fewer.
    pub(super) pixels: BTreeMap<usize, CheckedProgram>,
}

impl CardPart {
    /// The constants of the pixel program for directions: where their blocks begin.
    pub(super) fn constants(&self, directions: Range<usize>) -> Vec<[f32; 4]> {
        let grid = &self.volume.grid;
        let [width, height, _] = grid.extents().map(|side| side as f64);
        let origin = |direction: usize| {
            let [x, y] = grid.origin(direction);
            [(x as f64 / width) as f32, (y as f64 / height) as f32, 0.0, 0.0]
        };
        std::iter::repeat_n([0.0; 4], FIRST_ORIGIN).chain(directions.map(origin)).collect()
    }
}

/// The parts of a mesh: textures that no triangle names stay away.
pub(super) fn parts(
    machine: &mut Machine,
    mesh: &TexturedMesh<'_>,
    vertices: &CardVertices,
    options: DisplayOptions,
    layout: LocalLayout,
    version: Version,
) -> Result<Vec<CardPart>, CardError> {
    let (whole, left) = (layout.directions().min(mesh.directions()), mesh.directions() % layout.directions());
    let mut parts = Vec::new();
    for (number, texture) in mesh.textures.iter().enumerate() {
        let corners = vertices.indices.chunks_exact(3).zip(mesh.texture_of);
        let own = corners.filter(|(_, texture)| **texture as usize == number);
        let indices: Vec<u32> = own.flat_map(|(corners, _)| corners).copied().collect();
        if indices.is_empty() {
            continue;
        }
        let volume = VolumeTexture::new(machine, texture, options.edges, options.texture)?;
        let mut pixels = BTreeMap::new();
        for directions in [whole, left].into_iter().filter(|&directions| directions > 0) {
            let kernel = DisplayKernel { layout, grid: volume.grid, directions, version };
            pixels.insert(directions, kernel.checked(machine.profile())?);
        }
        parts.push(CardPart { indices, volume, pixels });
    }
    Ok(parts)
}
