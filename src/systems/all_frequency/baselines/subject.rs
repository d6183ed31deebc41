//! The common input of the baselines.

use glam::DVec3;

use crate::all_frequency::factor::ProductFunction;
use crate::geom::vector::wide;
use crate::transfer::Vertices;
use crate::transfer::linear_basis::LinearBasis;
use crate::transfer::visibility::VisibilityMaps;

/// Vertices with their visibility, and a reflectance that is not factored.
#[derive(Clone, Copy)]
pub struct BaselineSubject<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// Visibility maps of the vertices whose radiance is computed.
    pub maps: &'a VisibilityMaps,
    /// Hat functions of the light's texels.
    pub hats: &'a LinearBasis,
    /// f(v, s) = b(v, s) s_z.
    pub product: &'a dyn ProductFunction,
}

impl std::fmt::Debug for BaselineSubject<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BaselineSubject").field("maps", &self.maps.len()).finish_non_exhaustive()
    }
}

impl BaselineSubject<'_> {
    /// The direction from a map's vertex to an eye, in its local frame; `None` if it lies below the horizon.
    pub(super) fn view(&self, map: usize, eye: DVec3) -> Option<DVec3> {
        let vertex = self.maps.vertices()[map] as usize;
        let view = (eye - wide(self.vertices.positions()[vertex])).normalize_or_zero();
        Some(self.vertices.frames()[vertex].to_local(view)).filter(|view| view.z > 0.0)
    }
}
