//! What rivals are compared on.

use glam::DVec3;

use crate::all_frequency::factor::ProductFunction;
use crate::geom::vector::wide;
use crate::transfer::Vertices;
use crate::transfer::hats::Hats;
use crate::transfer::visibility::VisibilityMaps;

/// Vertices with what they see, and a reflectance that is not factored.
#[derive(Clone, Copy)]
pub struct RivalSubject<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// Visibility of the vertices that radiance is wanted of.
    pub maps: &'a VisibilityMaps,
    /// The hats of the light's texels.
    pub hats: &'a Hats,
    /// f(v, s) = b(v, s) s_z.
    pub product: &'a dyn ProductFunction,
}

impl std::fmt::Debug for RivalSubject<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RivalSubject").field("maps", &self.maps.len()).finish_non_exhaustive()
    }
}

impl RivalSubject<'_> {
    /// The direction of a map's vertex towards an eye, in its local frame; `None` below the horizon, where there is
    /// nothing to see.
    pub(super) fn view(&self, map: usize, eye: DVec3) -> Option<DVec3> {
        let vertex = self.maps.vertices()[map] as usize;
        let view = (eye - wide(self.vertices.positions()[vertex])).normalize_or_zero();
        Some(self.vertices.frames()[vertex].to_local(view)).filter(|view| view.z > 0.0)
    }
}
