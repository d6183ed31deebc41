//! Visibility at the vertices of a model.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::all_frequency::Reflectance;
use crate::all_frequency::file::AllFrequencyFile;
use crate::geom::Mesh;
use crate::split::{Computed, Concatenate, SplitRun};
use crate::study::{ProgressFn, StudyError};
use crate::tracer::Caster;
use crate::transfer::Vertices;
use crate::transfer::file::MeshDigest;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::{SegmentCensus, VisibilityMaps};

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

/// Visibility at the vertices of a range, those of the model before those of the ground.
#[derive(Debug, Serialize, Deserialize)]
struct SightRange {
    /// Number of the model's vertices in all ranges.
    of_model: usize,
    model: VisibilityMaps,
    ground: VisibilityMaps,
}

impl Concatenate for SightRange {
    fn are_of(&self, range: &Range<usize>) -> bool {
        let [model, ground] = parted(range, self.of_model);
        self.model.are_of(&model) && self.ground.are_of(&ground)
    }

    fn append(&mut self, next: Self) {
        self.model.append(next.model);
        self.ground.append(next.ground);
    }
}

/// The vertices of a range that are below a number, and those from there on.
fn parted(range: &Range<usize>, at: usize) -> [Range<usize>; 2] {
    [range.start.min(at)..range.end.min(at), range.start.max(at)..range.end.max(at)]
}

impl SightOfModel<'_> {
    /// Casts the rays by a caster of the scene that sees both sides: the model's, then the ground's; or those of a part.
    /// Fails with
    /// [`InputError`](crate::error::InputError), in a study's.
    pub fn run(
        self,
        caster: &mut dyn Caster,
        split: &SplitRun,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Computed<(FoundSight, Option<FoundSight>)>, StudyError> {
        let count = self.vertices.len();
        let joined = self.ground.map(|ground| self.vertices.joined(ground));
        let vertices = joined.as_ref().unwrap_or(self.vertices);
        let found = split.compute("vertices", vertices.len(), |range| {
            let mut maps = |of: Range<usize>| {
                let of: Vec<u32> = of.map(|vertex| vertex as u32).collect();
                let mut done = |done: usize, of: usize| progress("visibility", done as u64, of as u64);
                VisibilityMaps::trace(vertices, &of, caster, &mut done)
            };
            let [model, ground] = parted(&range, count);
            Ok::<_, StudyError>(SightRange { of_model: count, model: maps(model)?, ground: maps(ground)? })
        })?;
        let SightRange { model, ground, .. } = match found {
            Computed::Whole(found) => found,
            Computed::Part(part) => return Ok(Computed::Part(part)),
        };
        let below =
            self.ground.map(|vertices| self.found(vertices, ground.counted_from(count as u32), Reflectance::Diffuse));
        Ok(Computed::Whole((self.found(self.vertices, model, self.reflectance.clone()), below)))
    }

    fn found(&self, vertices: &Vertices, maps: VisibilityMaps, reflectance: Reflectance) -> FoundSight {
        let census = SegmentCensus::new(vertices, &maps, &LinearBasis::new(self.hats));
        let mesh = MeshDigest::new(vertices);
        let file =
            AllFrequencyFile { mesh, hats: self.hats, reflectance, visibility: Some(maps), coded: None, model: None };
        FoundSight { file, census }
    }
}
