//! What each vertex of a model sees.

use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::prt::all_frequency::Reflectance;
use crate::prt::all_frequency::hats::{HatWidth, Hats};
use crate::prt::all_frequency::visibility::{SegmentCensus, VisibilityMaps};
use crate::prt::file::{AllFrequencyFile, MeshDigest};
use crate::prt::transfer::{TransferError, Vertices};
use crate::study::ProgressFn;
use crate::tracer::HostTracer;

/// A model whose visibility is wanted.
#[derive(Debug)]
pub struct SightOfModel<'a> {
    /// Its mesh.
    pub mesh: &'a Mesh,
    /// The vertices that transfer is computed at.
    pub vertices: &'a Vertices,
    /// The hats of the light's texels.
    pub hats: HatWidth,
    /// The reflectance.
    pub reflectance: Reflectance,
}

impl SightOfModel<'_> {
    /// Casts the rays.
    ///
    /// # Errors
    /// [`TransferError`].
    pub fn run(self, progress: &mut ProgressFn<'_>) -> Result<(AllFrequencyFile, SegmentCensus), TransferError> {
        let all: Vec<u32> = (0..self.vertices.len() as u32).collect();
        let mut tracer = HostTracer::new(self.mesh, Sides::Both);
        let mut done = |done: usize, of: usize| progress("visibility", done as u64, of as u64);
        let maps = VisibilityMaps::trace(self.vertices, &all, &mut tracer, &mut done)?;
        let census = SegmentCensus::new(self.vertices, &maps, &Hats::new(self.hats));
        let file = AllFrequencyFile {
            mesh: MeshDigest::new(self.vertices),
            hats: self.hats,
            reflectance: self.reflectance,
            visibility: Some(maps),
            coded: None,
        };
        Ok((file, census))
    }
}
