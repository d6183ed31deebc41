//! Pictures of the room, drawn by the card: from the solver's own texture if one texture holds all three channels,
//! otherwise from an uploaded one.

use refsim::machine::Machine;
use refsim::texture::TexelFormat;

use super::solve::Solved;
use super::time::CardFacts;
use super::{Parameters, time};
use crate::picture::metrics::relative_luminance_differences;
use crate::picture::{Picture, RgbImage};
use crate::radiosity::display::Display;
use crate::radiosity::{Patches, System};
use crate::study::StudyError;

/// Linear value perceived as halfway between black and white.
const MIDDLE_GREY: f64 = 0.18;
/// Rec. 709 weights of red, green and blue.
const LUMINANCE: glam::DVec3 = glam::DVec3::new(0.2126, 0.7152, 0.0722);
/// The card multiplies by the exposure without clipping; display encoding follows on the host.
const TARGET: TexelFormat = TexelFormat::Rgba32f;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pictures {
    /// Flat-shaded picture: each patch shows its radiosity.
    pub(super) flat: RgbImage,
    pub(super) smooth: RgbImage,
    /// On the card: per pixel, the luminance minus the direct solution's, relative to the latter.
    pub(super) error: Option<Vec<f64>>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct IterationPicture {
    pub(super) iteration: u32,
    pub(super) flat: RgbImage,
}

/// Computes the auto-exposure: non-emitting surfaces are 18 % grey on average over their area.
pub(in crate::study) fn exposure(patches: &Patches, emittance: &[[f64; 3]], radiosity: &[[f64; 3]]) -> f64 {
    let (mut light, mut area) = (0.0, 0.0);
    for (i, (e, b)) in emittance.iter().zip(radiosity).enumerate() {
        if e.iter().all(|&e| e == 0.0) {
            light += patches.open_area(i) * LUMINANCE.dot((*b).into()) / std::f64::consts::PI;
            area += patches.open_area(i);
        }
    }
    // If everything emits, or nothing is lit, the exposure is 1.
    if light > 0.0 && light.is_finite() { MIDDLE_GREY * area / light } else { 1.0 }
}

/// Renderer of pictures. It has its own card for solutions that are not on one.
pub(super) struct PictureRenderer<'a> {
    patches: &'a Patches,
    parameters: &'a Parameters,
    exposure: f64,
    machine: Machine,
    display: Display,
    /// Picture of the direct solution, flat-shaded.
    reference: Option<Picture>,
}

impl<'a> PictureRenderer<'a> {
    /// `reference` is the solution with which solutions on a card are compared.
    pub(super) fn new(
        patches: &'a Patches,
        parameters: &'a Parameters,
        exposure: f64,
        reference: Option<&[[f64; 3]]>,
    ) -> Result<Self, StudyError> {
        let machine = parameters.executor.clone().machine(parameters.profile.clone());
        let mut machine = machine.map_err(|error| StudyError::coded("radiosity::machine", error))?;
        let display = Display::new(&mut machine, patches, &parameters.camera, TARGET)?;
        let mut made = Self { patches, parameters, exposure, machine, display, reference: None };
        made.reference = reference.map(|reference| made.flat(reference)).transpose()?;
        Ok(made)
    }

    fn flat(&mut self, radiosity: &[[f64; 3]]) -> Result<Picture, StudyError> {
        let texture = self.display.upload(&mut self.machine, radiosity)?;
        Ok(self.display.flat(&mut self.machine, texture, self.exposure)?)
    }

    fn smooth(&mut self, radiosity: &[[f64; 3]]) -> Result<RgbImage, StudyError> {
        let texture = self.display.upload(&mut self.machine, radiosity)?;
        let picture = self.display.smooth(&mut self.machine, texture, self.exposure)?;
        Ok(picture.display(1.0)?)
    }

    pub(super) fn show(
        &mut self,
        solved: &mut Solved,
        system: &System,
    ) -> Result<(Pictures, Option<CardFacts>), StudyError> {
        let Some(card) = &mut solved.card else {
            let (flat, smooth) = (self.flat(&solved.radiosity)?.display(1.0)?, self.smooth(&solved.radiosity)?);
            return Ok((Pictures { flat, smooth, error: None }, None));
        };
        let (flat, smooth) = match card.radiosity_textures()[..] {
            [all] => {
                let display = Display::new(card.machine_mut(), self.patches, &self.parameters.camera, TARGET)?;
                let flat = display.flat(card.machine_mut(), all, self.exposure)?;
                let smooth = display.smooth(card.machine_mut(), all, self.exposure)?;
                (flat, smooth.display(1.0)?)
            }
            _ => (self.flat(&solved.radiosity)?, self.smooth(&solved.radiosity)?),
        };
        let facts = |how| time::facts(card, how, system, self.patches, self.parameters);
        let facts = solved.method.on_card().map(facts).transpose()?;
        let error = |reference| relative_luminance_differences(reference, &flat);
        let error = self.reference.as_ref().map(error).transpose()?;
        Ok((Pictures { flat: flat.display(1.0)?, smooth, error }, facts))
    }

    pub(super) fn frames(&mut self, solved: &[Solved]) -> Result<Vec<IterationPicture>, StudyError> {
        let Some(first) = solved.iter().find(|s| s.card.is_some()) else { return Ok(Vec::new()) };
        let frame = |(iteration, radiosity): &(u32, Vec<[f64; 3]>)| {
            Ok(IterationPicture { iteration: *iteration, flat: self.flat(radiosity)?.display(1.0)? })
        };
        first.recorded.iter().map(frame).collect()
    }
}
