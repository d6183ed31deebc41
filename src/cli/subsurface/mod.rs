//! `crossbar subsurface`: links over an atlas, three passes on a card, all pairs beside them.

mod args;
mod ask;
mod values;

use std::path::Path;

use super::Problem;
use super::memory::{self, MemoryNeed};
use super::model_name;
use super::part::PartArgs;
use super::study::StudyArgs;
use crate::atlas::require_side;
use crate::report::digits::{Quantity, shown};
use crate::study::subsurface::{Parameters, no_atlas};
use crate::subsurface::kernels::{DirectLight, ViewKernel};

pub(super) use args::Args;
use values::LightArg;

/// Diffuse reflectance for direct light, unless asked for.
const DIFFUSE: f64 = 0.1;

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "a smaller `--atlas`, fewer `--links`, or `--all-pairs no`";

    fn folder(&self) -> Option<&Path> {
        Some(&self.out)
    }

    fn part(&self) -> Option<PartArgs> {
        Some(self.part)
    }

    fn inputs(&self) -> Vec<&Path> {
        let lights = self.light.iter().filter_map(|light| match light {
            LightArg::Environment(light) => light.file(),
            LightArg::OfPass(_) => None,
        });
        model_name::named_file(&self.model).into_iter().chain(self.irradiance.as_deref()).chain(lights).collect()
    }

    /// Memory of the atlas, its links, the card's textures and the pictures of every way.
    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        // Before memory, which what cannot be has no need of.
        require_side(self.atlas).map_err(no_atlas)?;
        const PER_TEXEL: u64 = 1000;
        const PER_LINK: u64 = 80;
        const PER_PIXEL_AND_PICTURE: u64 = 100;
        let texels = u64::from(self.atlas) * u64::from(self.atlas);
        let most = u64::from(self.links.iter().copied().max().unwrap_or(0));
        let kinds = [self.choice.len(), self.channels.len(), self.link_format.len(), self.map.len(), self.links.len()];
        let ways: u64 = kinds.into_iter().map(|count| count.max(1) as u64).product();
        let pictures = 3 * ways + u64::from(self.frames);
        // Rows of the table of links, of which there are at most 2^18 per study.
        let table = if self.link_table { 128 << 20 } else { 0 };
        let maps = texels.saturating_mul(PER_TEXEL + PER_LINK * most + 100 * ways).saturating_add(table);
        Ok(Some(MemoryNeed {
            what: format!(
                "{0} x {0} texels with {most} links each, and {pictures} pictures of {1} pixels",
                self.atlas, self.size
            ),
            bytes: memory::of_pixels(self.size.width, self.size.height, pictures * PER_PIXEL_AND_PICTURE, maps),
            help: "ask for a smaller `--atlas`, fewer `--links` or a smaller `--size`",
        }))
    }

    fn study(&self) -> miette::Result<Parameters> {
        let diffuse = self.diffuse.unwrap_or(DIFFUSE);
        if diffuse > 1.0 {
            let (found, help) = (shown(diffuse, Quantity::Exact), "a surface reflects at most all of the light");
            return Err(Problem::usage(format!("expected a `--diffuse` from 0 to 1, found {found}"), help).into());
        }
        ask::require_lights(self)?;
        let material = ask::material(self)?;
        let ways = ask::ways(self, &material)?;
        let reference = ask::all_pairs(self)?;
        let profile = self.card.profile("nv35")?;
        let mesh = model_name::mesh(&self.model)?;
        let camera = self.eye.framing(&mesh, self.size)?;
        Ok(Parameters {
            model: self.model.display().to_string(),
            lighting: ask::lighting(self, &camera)?,
            mm_per_unit: self.mm_per_unit,
            side: self.atlas,
            tolerance: self.tolerance,
            stage: self.pass_1.unwrap_or_default(),
            photons: self.walk,
            link_table: self.link_table,
            probes: self.probe.clone(),
            switches: self.card.switches(),
            executor: self.card.executor()?,
            view: ViewKernel {
                transmittance: self.fresnel,
                direct: self.direct.unwrap_or(DirectLight::ByFragment),
                combine: self.combine,
            },
            diffuse,
            exposure: self.exposure,
            frames: self.frames,
            material,
            ways,
            reference,
            roundings: self.roundings,
            profile,
            mesh,
            camera,
        })
    }
}
