//! `crossbar radiosity`: matrix radiosity on a card and on the host, side by side.

mod args;
mod ask;
mod values;

use std::path::Path;

use super::memory::{self, MemoryNeed};
use super::part::PartArgs;
use super::scene_name::{self, Viewpoint};
use super::study::StudyArgs;
use crate::atlas::require_side;
use crate::radiosity::Patches;
use crate::radiosity::solve::Options;
use crate::study::radiosity::{Parameters, no_atlas};

pub(super) use args::Args;

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "fewer `--patches`";

    fn folder(&self) -> Option<&Path> {
        Some(&self.out)
    }

    fn part(&self) -> Option<PartArgs> {
        Some(self.part)
    }

    fn inputs(&self) -> Vec<&Path> {
        scene_name::named_file(&self.scene)
    }

    /// By the number of patches that is asked for; faces and parts of sides may make more.
    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        // Before memory, which what cannot be has no need of.
        self.atlas.map_or(Ok(()), require_side).map_err(no_atlas)?;
        self.need(self.per_side.map_or(self.patches as usize, |_| 0)).map(Some)
    }

    fn memory_of(&self, study: &Parameters) -> Option<MemoryNeed> {
        // What is wrong with the patches, the study says itself.
        let patches = Patches::count(&study.scene, study.subdivision).ok()?;
        self.need(patches).ok()
    }

    fn study(&self) -> miette::Result<Parameters> {
        let scene = scene_name::scene(&self.scene)?;
        let viewpoint = Viewpoint { size: self.size, view: self.view.as_deref(), eye: self.eye };
        Ok(Parameters {
            camera: viewpoint.camera(&scene)?,
            subdivision: ask::subdivision(self),
            factors: ask::requirements(self)?,
            methods: ask::methods(self)?,
            profile: self.card.profile("nv35")?,
            switches: self.card.switches(),
            executor: self.card.executor()?,
            options: Options {
                tolerance: self.tolerance.unwrap_or(if self.iterations.is_some() { 0.0 } else { 1e-4 }),
                most_iterations: self.iterations.unwrap_or(1000),
            },
            changes: ask::changes(self),
            exposure: self.exposure,
            frames: self.frames.clone(),
            atlas: self.atlas,
            sweep: self.sweep.clone(),
            scene,
        })
    }
}

impl Args {
    /// Memory of the matrices of that many patches, and of the pictures of every method.
    fn need(&self, patches: usize) -> miette::Result<MemoryNeed> {
        // Measured: 83 with the matrices on a card, whose batch executor keeps decoded texels.
        const PER_PAIR: u64 = 96;
        const PER_PIXEL_AND_PICTURE: u64 = 100;
        // What an atlas knows of a texel, its levels, colors and picture.
        const PER_TEXEL: u64 = 320;
        let pictures = (ask::methods(self)?.len() + self.frames.len()) as u64;
        let texels = self.atlas.map_or(0, |side| u64::from(side) * u64::from(side));
        let matrices = (patches as u64).saturating_mul(patches as u64 * PER_PAIR) + texels * PER_TEXEL;
        Ok(MemoryNeed {
            what: format!("radiosity of {patches} patches with {pictures} pictures of {} pixels", self.size),
            bytes: memory::of_pixels(self.size.width, self.size.height, pictures * PER_PIXEL_AND_PICTURE, matrices),
            help: "ask for fewer `--patches`, name a scene of fewer faces, or ask for a smaller `--size` or `--atlas`",
        })
    }
}
