//! A crossbar whose rays and triangles are resident on the card, for repeated draws without uploads.

use refsim::event::DrawEvents;

use super::card::{Card, Streams};
use super::{Answer, EngineError, RayBatch};

/// A card with rays in its textures and triangles in its vertex memory. [`super::Crossbar::make_resident`] makes one.
#[derive(Debug)]
pub struct ResidentCrossbar {
    /// `None` if there are no rays or no triangles.
    work: Option<(Card, Streams)>,
    rays: RayBatch,
    kernel: &'static str,
}

impl ResidentCrossbar {
    pub(super) fn new(card: Card, streams: Streams, rays: RayBatch, kernel: &'static str) -> Self {
        Self { work: Some((card, streams)), rays, kernel }
    }

    /// Creates a resident crossbar without work.
    pub(super) fn idle(rays: RayBatch, kernel: &'static str) -> Self {
        Self { work: None, rays, kernel }
    }

    /// Clears the targets, draws every triangle over every ray, and reads back: the result of
    /// [`super::Crossbar::intersect`] with all pairs.
    ///
    /// # Errors
    /// [`EngineError::Machine`] if the card refuses the work.
    pub fn intersect(&mut self) -> Result<Answer, EngineError> {
        let kernel = self.kernel;
        let Some((card, streams)) = &mut self.work else {
            let hits = vec![None; self.rays.rays().len()];
            return Ok(Answer { hits, events: DrawEvents::default(), kernel, log: Vec::new() });
        };
        card.clear()?;
        let events = card.draw(streams)?;
        Ok(Answer { hits: card.read_back(&self.rays)?, events, kernel, log: card.take_log() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Mesh;
    use crate::geom::exact::Sides;
    use crate::geom::teapot::teapot;
    use crate::ray_engine::Crossbar;
    use crate::scene::Camera;
    use refsim::device::Profile;
    use refsim::machine::ExecutorKind;

    #[test]
    fn every_draw_of_resident_rays_is_that_of_a_new_one() {
        let whole = teapot(2).expect("the teapot tessellates");
        let mesh = Mesh::new(whole.positions().to_vec(), whole.triangles()[..64].to_vec()).expect("a part of it");
        let camera = Camera::teapot(16, 16).expect("the default camera");
        let rays = RayBatch::new(16, 16, camera.rays()).expect("a ray a pixel");
        for device in ["ideal-s3.12", "ideal-fp32"] {
            let profile = Profile::named(device).expect("an ideal device");
            let crossbar = Crossbar::new(profile, ExecutorKind::Batch).all_pairs(true);
            let new = crossbar.intersect(&mesh, &rays, Sides::Front).expect("the card intersects");
            assert!(new.hits.iter().any(Option::is_some), "{device}: something is hit");
            let mut resident = crossbar.make_resident(&mesh, &rays, Sides::Front).expect("the card takes them");
            for draw in 0..3 {
                let again = resident.intersect().expect("the card intersects");
                assert_eq!((&again.hits, &again.events), (&new.hits, &new.events), "{device}, draw {draw}");
            }
        }
    }

    #[test]
    fn without_triangles_nothing_is_hit() {
        let rays = RayBatch::new(2, 1, Camera::teapot(2, 1).expect("a camera").rays()).expect("two rays");
        let crossbar = Crossbar::new(Profile::named("ideal-fp32").expect("a device"), ExecutorKind::Batch);
        let mut resident =
            crossbar.make_resident(&Mesh::default(), &rays, Sides::Front).expect("no triangles are no error");
        assert_eq!(resident.intersect().expect("nothing to do").hits, [None, None]);
    }
}
