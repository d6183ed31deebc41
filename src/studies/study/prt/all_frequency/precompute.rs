//! Visibility at the vertices of a model.

use std::ops::Range;

use crate::all_frequency::Reflectance;
use crate::all_frequency::file::AllFrequencyFile;
use crate::geom::Mesh;
use crate::study::{ProgressFn, StudyError};
use crate::tracer::Caster;
use crate::transfer::Vertices;
use crate::transfer::file::MeshDigest;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::{SegmentCensus, VisibilityMaps};

/// A model whose visibility is computed.
#[derive(Debug)]
pub struct SightOfModel<'a> {
    /// The occluders: the model's mesh, or the mesh with its ground.
    pub scene: &'a Mesh,
    /// The vertices at which transfer is computed.
    pub vertices: &'a Vertices,
    /// Hat functions of the light's texels.
    pub hats: BasisWidth,
    /// The reflectance.
    pub reflectance: Reflectance,
    /// The vertices of the diffuse ground below the model, which is the second part of the scene.
    pub ground: Option<&'a Vertices>,
}

/// Computed visibility at the vertices of a model or its ground.
#[derive(Debug)]
pub struct FoundSight {
    /// The file.
    pub file: AllFrequencyFile,
    /// Segments with transfer.
    pub census: SegmentCensus,
}

impl SightOfModel<'_> {
    /// Casts the model's rays, then the ground's, with a caster of the scene that hits both sides of faces. Fails with
    /// a `StudyError` that contains an [`InputError`](crate::error::InputError).
    pub fn run(
        self,
        caster: &mut dyn Caster,
        progress: &mut ProgressFn<'_>,
    ) -> Result<(FoundSight, Option<FoundSight>), StudyError> {
        let count = self.vertices.len() as u32;
        let joined = self.ground.map(|ground| self.vertices.joined(ground));
        let vertices = joined.as_ref().unwrap_or(self.vertices);
        let mut maps = |of: Range<u32>| {
            let of: Vec<u32> = of.collect();
            let mut done = |done: usize, of: usize| progress("visibility", done as u64, of as u64);
            VisibilityMaps::trace(vertices, &of, caster, &mut done)
        };
        let [model, ground] = [maps(0..count)?, maps(count..vertices.len() as u32)?];
        let below = self.ground.map(|vertices| self.found(vertices, ground.counted_from(count), Reflectance::Diffuse));
        Ok((self.found(self.vertices, model, self.reflectance.clone()), below))
    }

    fn found(&self, vertices: &Vertices, maps: VisibilityMaps, reflectance: Reflectance) -> FoundSight {
        let census = SegmentCensus::new(vertices, &maps, &LinearBasis::new(self.hats));
        let mesh = MeshDigest::new(vertices);
        let file =
            AllFrequencyFile { mesh, hats: self.hats, reflectance, visibility: Some(maps), coded: None, model: None };
        FoundSight { file, census }
    }
}
