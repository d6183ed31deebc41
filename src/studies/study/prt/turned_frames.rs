//! Pictures with the light or the camera carried round a model.

use glam::{DMat3, DVec3};

use super::lit_view::LitView;
use crate::geom::Mesh;
use crate::geom::vector::wide;
use crate::options::one_of::variants;
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, NamedPicture};
use crate::scene::Camera;
use crate::sphere::turn_around_z;
use crate::study::{ProgressFn, StudyError};

/// The object that is carried round a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum Turning {
    /// The light, around z.
    #[default]
    Light,
    /// The camera, around the model.
    Camera,
}

/// Pictures with the light or the camera carried all the way round z.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct TurnedFrames {
    /// Pictures with the light turned around z, or the camera carried around the model, in so many steps.
    #[arg(long = "frames", value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=360))]
    pub count: u32,

    /// The object that --frames turns.
    #[arg(long = "turn", value_name = "WHAT", default_value = "light", requires = "count", value_parser = variants::<Turning>())]
    pub turning: Turning,
}

/// Light or camera of a frame.
pub(super) enum Turned {
    /// The light is turned by this rotation, the camera stays.
    Light(DMat3),
    /// The camera is here, the light stays.
    Camera(Camera),
}

impl TurnedFrames {
    /// Steps of a study that draws these after `before` others.
    pub(super) fn steps(self, before: u64) -> u64 {
        before + u64::from(self.count)
    }

    /// Adds the pictures; `colors` gives linear radiance of the pixels of a frame. `before` steps are done.
    pub(super) fn report(
        self,
        view: &LitView,
        mesh: &Mesh,
        exposure: f64,
        mut colors: impl FnMut(Turned) -> Result<Vec<[f64; 3]>, StudyError>,
        found: &mut Findings,
        before: u64,
        progress: &mut ProgressFn<'_>,
    ) -> Result<(), StudyError> {
        let mut frames = Vec::new();
        for frame in 0..self.count {
            progress("frames", before + u64::from(frame), self.steps(before));
            let turns = f64::from(frame) / f64::from(self.count);
            let turn = turn_around_z(turns);
            let turned = match self.turning {
                Turning::Light => Turned::Light(turn),
                Turning::Camera => Turned::Camera(carried(&view.camera, mesh, &turn)),
            };
            let image = view.picture(&colors(turned)?).display(exposure)?;
            let caption = format!("turned by {} degrees", shown(360.0 * turns, Quantity::Measured));
            frames.push(NamedPicture::new(format!("frame-{frame}"), image, caption));
        }
        if !frames.is_empty() {
            found.heading(match self.turning {
                Turning::Light => "The light turned around z",
                Turning::Camera => "The camera carried around the model",
            });
            found.pictures(frames);
        }
        Ok(())
    }
}

/// A camera carried around the middle of a mesh.
fn carried(camera: &Camera, mesh: &Mesh, turn: &DMat3) -> Camera {
    let middle = mesh.bounds().map_or(DVec3::ZERO, |[low, high]| 0.5 * (wide(low) + wide(high)));
    camera.carried(middle, turn)
}
