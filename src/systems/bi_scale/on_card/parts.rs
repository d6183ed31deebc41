//! The data that a pass draws: a texture's triangles, and the local light of vertices.

use std::collections::BTreeMap;
use std::ops::Range;

use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::Machine;

use super::options::{DisplayOptions, LightFormat};
use super::subject::{CardVertices, TexturedMesh};
use super::textures::VolumeTexture;
use crate::bi_scale::kernels::{DisplayKernel, FIRST_ORIGIN, LocalLayout};
use crate::card::{Attribute, CardError, WrittenKernel, by_register, check_finite};

#[derive(Debug)]
pub(super) struct CardPart {
    pub(super) indices: Vec<u32>,
    pub(super) volume: VolumeTexture,
    /// Programs by number of directions: for a full pass, and for the last pass if it has fewer.
    pub(super) pixels: BTreeMap<usize, CheckedProgram>,
}

impl CardPart {
    /// The constants of the pixel program for directions: the origins of their blocks.
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

/// Local light of a frame, and its format for the card.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalStream<'a> {
    pub(super) vertices: &'a CardVertices,
    pub(super) layout: LocalLayout,
    /// Local light: one RGB triple per direction, M directions per vertex.
    pub(super) local: &'a [[f32; 3]],
    pub(super) directions: usize,
    /// Exposure times the factor that scales texels to samples.
    pub(super) factor: f64,
    /// Largest magnitude of local light times `factor`.
    pub(super) largest: f64,
    pub(super) format: LightFormat,
}

impl LocalStream<'_> {
    /// All sets but the last of a pass, given by its first direction and number of directions.
    pub(super) fn sets(&self, first: usize, count: usize) -> Result<Vec<Attribute>, CardError> {
        let of_vertex = |at: usize| {
            let vertex = self.vertices.vertices[at] as usize;
            let mut sets = vec![[0_u32; 4]; self.layout.last()];
            let light = &self.local[vertex * self.directions..][..self.directions];
            for (direction, rgb) in light[first..first + count].iter().enumerate() {
                for (channel, &value) in rgb.iter().enumerate() {
                    let (set, component) = self.layout.place(direction, channel);
                    let value = self.format.rounded(self.factor * f64::from(value), self.largest);
                    sets[set][component] = value.to_bits();
                }
            }
            sets
        };
        let sets = by_register(self.layout.last(), self.vertices.vertices.len(), of_vertex);
        check_finite("local light that its format holds", &sets)?;
        Ok(sets)
    }
}

/// Largest magnitude of local light times `factor`. Fails with [`CardError::Input`] if it exceeds single precision.
pub(super) fn largest(local: &[[f32; 3]], factor: f64) -> Result<f64, CardError> {
    let numbers = local.as_flattened().iter();
    let found = numbers.fold(0.0_f64, |most, &value| most.max((factor * f64::from(value)).abs()));
    if found.is_finite() && found <= f64::from(f32::MAX) {
        return Ok(found);
    }
    Err(CardError::figure("local light times exposure that single precision holds", found))
}
