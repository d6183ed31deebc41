//! Settings shared by all renderers.

use crate::error::{InputError, input_error};
use crate::scene::Color;
use crate::tracer::offset::SINGLE;

/// Thin lens instead of a pinhole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius of the aperture, in scene units.
    pub radius: f64,
    /// Focal distance along the view, in scene units.
    pub focus: f64,
}

/// Settings shared by all renderers; each renderer documents its meaning of `depth`.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Samples per pixel, at least 1: one through the centre, or several distributed uniformly over the pixel.
    pub samples: u32,
    /// Maximum path length.
    pub depth: u32,
    /// Random seed.
    pub seed: u64,
    /// Approximate number of rays per bundle; it bounds the memory, and does not change the picture.
    pub bundle: usize,
    /// Unit roundoff of the caster's arithmetic, 2^-24 by default, which determines the offset of rays from surfaces.
    /// If it is smaller than the card's, surfaces shadow themselves.
    pub rounding: f64,
    /// Thin lens; `None` for a pinhole.
    pub lens: Option<Lens>,
    /// Radiance of rays that hit nothing.
    pub background: Color,
}

impl Default for Settings {
    fn default() -> Self {
        Self { samples: 1, depth: 8, seed: 1, bundle: 1 << 16, rounding: SINGLE, lens: None, background: [0.0; 3] }
    }
}

impl Settings {
    pub(super) fn checked(&self) -> Result<(), InputError> {
        let refuse = |what, found: String, expected| Err(settings_error(what, expected, found));
        if self.samples == 0 {
            return refuse("samples per pixel", "0".to_owned(), "at least 1");
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
        if let Some(wrong) = self.background.iter().find(|channel| !(channel.is_finite() && **channel >= 0.0)) {
            return refuse("the background", wrong.to_string(), "numbers not below 0");
        }
        Ok(())
    }
}

pub(super) fn settings_error(what: &'static str, expected: &'static str, found: String) -> InputError {
    input_error!("expected {expected} for {what}, found {found}")
}
