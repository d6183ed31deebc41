//! Visibility at the vertices of a model.

use crate::all_frequency::Reflectance;
use crate::all_frequency::file::AllFrequencyFile;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::study::ProgressFn;
use crate::tracer::HostTracer;
use crate::transfer::file::MeshDigest;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::{SegmentCensus, VisibilityMaps};
use crate::transfer::{TransferError, Vertices};

/// A model whose visibility is wanted.
#[derive(Debug)]
pub struct SightOfModel<'a> {
    /// The occluders: its mesh, or that on its ground.
    pub scene: &'a Mesh,
    /// The vertices that transfer is computed at.
    pub vertices: &'a Vertices,
    /// The hats of the light's texels.
    pub hats: BasisWidth,
    /// The reflectance.
    pub reflectance: Reflectance,
    /// The vertices of the ground below it, which is diffuse: the second part of the scene.
    pub ground: Option<&'a Vertices>,
}

/// Visibility at its vertices.
#[derive(Debug)]
pub struct FoundSight {
    /// The file.
    pub file: AllFrequencyFile,
    /// Segments with transfer.
    pub census: SegmentCensus,
}

impl SightOfModel<'_> {
    /// Casts the rays: the model's, then the ground's.
    ///
    /// # Errors
    /// [`TransferError`].
    pub fn run(self, progress: &mut ProgressFn<'_>) -> Result<(FoundSight, Option<FoundSight>), TransferError> {
        let mut done = |done: usize, of: usize| progress("visibility", done as u64, of as u64);
        let count = self.vertices.len() as u32;
        let mut tracer = HostTracer::new(self.scene, Sides::Both);
        let Some(ground) = self.ground else {
            let all: Vec<u32> = (0..count).collect();
            let maps = VisibilityMaps::trace(self.vertices, &all, &mut tracer, &mut done)?;
            return Ok((self.found(self.vertices, maps, self.reflectance.clone()), None));
        };
        let vertices = self.vertices.joined(ground);
        let mut maps = |of: std::ops::Range<u32>| {
            let of: Vec<u32> = of.collect();
            VisibilityMaps::trace(&vertices, &of, &mut tracer, &mut done)
        };
        let of_model = maps(0..count)?;
        let below = maps(count..vertices.len() as u32)?.counted_from(count);
        let below = self.found(ground, below, Reflectance::Diffuse);
        Ok((self.found(self.vertices, of_model, self.reflectance.clone()), Some(below)))
    }

    fn found(&self, vertices: &Vertices, maps: VisibilityMaps, reflectance: Reflectance) -> FoundSight {
        let census = SegmentCensus::new(vertices, &maps, &LinearBasis::new(self.hats));
        let mesh = MeshDigest::new(vertices);
        let file = AllFrequencyFile { mesh, hats: self.hats, reflectance, visibility: Some(maps), coded: None };
        FoundSight { file, census }
    }
}
