//! Radiance of vertices by compressed factored transfer.

use super::scene::FigureScene;
use super::{HOST, RunResult, Shared, StudyError};
use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{CodeOptions, CodedTransfer};
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::shade::{Shader, exit_radiance};
use crate::study::prt::{SegmentTally, SegmentedCompression};
use crate::transfer::light::HaarLight;
use crate::transfer::visibility::VisibilityMaps;

/// Surface of a scene: the vertices of some visibility maps, with a reflectance and a color.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) scene: &'a FigureScene,
    pub(super) maps: &'a VisibilityMaps,
    pub(super) reflectance: &'a Reflectance,
    pub(super) color: [f64; 3],
    /// Storage of finished pieces, and the prefix of their names.
    pub(super) pieces: (&'a Shared, &'a str),
}

impl Surface<'_> {
    /// Compresses and encodes the transfer.
    pub(super) fn coded(&self, options: SegmentOptions) -> Result<(CodedTransfer, Vec<SegmentTally>), StudyError> {
        let (shared, name) = self.pieces;
        let name = format!("{name}-{}-", options.vectors);
        let compression = SegmentedCompression {
            vertices: &self.scene.vertices,
            maps: self.maps,
            hats: self.scene.hats.width(),
            reflectance: self.reflectance,
            options,
            code: CodeOptions::default(),
            kept: shared.kept().map(|kept| (kept, name.as_str())),
        };
        compression.run(&mut |_, _, _| ()).on(HOST)
    }

    /// Radiance of the maps' vertices towards the scene's eye, from coded transfer.
    pub(super) fn of_code(&self, coded: &CodedTransfer, light: &HaarLight) -> Result<Vec<[f64; 3]>, StudyError> {
        let shader = Shader::new(coded);
        let transferred = shader.transferred(&light.singles()).on(HOST)?;
        let transferred = |vertex, row: usize| transferred.of(vertex)[row].map(f64::from);
        let color = self.color;
        let color = |_: usize| color;
        let all = exit_radiance(&self.scene.vertices, self.reflectance, &color, &transferred, self.scene.eye());
        Ok(self.maps.vertices().iter().map(|&vertex| all[vertex as usize]).collect())
    }
}
