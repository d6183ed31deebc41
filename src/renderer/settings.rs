//! Settings that all renderers share.

use thiserror::Error;

use crate::scene::Color;
use crate::tracer::CastError;
use crate::tracer::offset::SINGLE;

/// A thin lens in place of the pinhole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius of the aperture, in units of the scene.
    pub radius: f64,
    /// Distance along the view at which everything is sharp.
    pub focus: f64,
}

/// Settings that all renderers share; each documents what it makes of `depth`.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Samples per pixel, at least 1. One goes through the middle of the pixel, several anywhere in it with the same
    /// chance.
    pub samples: u32,
    /// The longest path.
    pub depth: u32,
    /// Random seed.
    pub seed: u64,
    /// Approximate number of rays per bundle: bounds the memory, never changes the picture.
    pub bundle: usize,
    /// Unit roundoff of the caster's arithmetic, 2^-24 by default: says how far off a surface rays start. A card of a
    /// shorter format, told that it has a longer one, sees its surfaces lie in their own shadow.
    pub rounding: f64,
    /// A lens; else a pinhole.
    pub lens: Option<Lens>,
    /// Radiance from where nothing is.
    pub background: Color,
    /// Radiance that Whitted's model adds to what diffuse surfaces scatter, times their albedo (his constant term);
    /// others ignore it.
    pub ambient: Color,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            samples: 1,
            depth: 8,
            seed: 1,
            bundle: 1 << 16,
            rounding: SINGLE,
            lens: None,
            background: [0.0; 3],
            ambient: [0.0; 3],
        }
    }
}

impl Settings {
    /// # Errors
    /// [`RenderError::Settings`] names the first figure that makes no sense.
    pub(super) fn checked(&self) -> Result<(), RenderError> {
        let refuse = |what, found: String, expected| Err(RenderError::Settings { what, expected, found });
        if self.samples == 0 {
            return refuse("samples a pixel", "0".to_owned(), "at least 1");
        }
        if self.depth > 1024 {
            return refuse("a depth", self.depth.to_string(), "at most 1024");
        }
        if !(self.rounding >= 0.0 && self.rounding < 1.0) {
            return refuse("the unit roundoff", self.rounding.to_string(), "a number from 0 to below 1");
        }
        if let Some(Lens { radius, focus }) = self.lens {
            if !(radius.is_finite() && radius >= 0.0) {
                return refuse("the radius of the lens", radius.to_string(), "a number not below 0");
            }
            if !(focus.is_finite() && focus > 0.0) {
                return refuse("the distance of focus", focus.to_string(), "a number above 0");
            }
        }
        for (what, color) in [("the background", self.background), ("the ambient light", self.ambient)] {
            if let Some(wrong) = color.iter().find(|channel| !(channel.is_finite() && **channel >= 0.0)) {
                return refuse(what, wrong.to_string(), "numbers not below 0");
            }
        }
        Ok(())
    }
}

/// Why there is no picture.
#[non_exhaustive]
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum RenderError {
    /// The ray caster failed.
    #[error(transparent)]
    Cast(#[from] CastError),
    /// A figure that makes no sense.
    #[error("expected {expected} for {what}, found {found}")]
    Settings { what: &'static str, expected: &'static str, found: String },
}
