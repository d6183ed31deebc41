//! The three passes of section 4.2 on an emulated card.
//!
//! A [`SubsurfaceCard`] holds links, geometry and maps of one model. [`SubsurfaceCard::light`] runs passes 1 and 2 for
//! new lights; links do not change. [`SubsurfaceCard::view`] runs pass 3 for a new camera, without new light.

mod gather;
mod levels;
mod light;
mod link_textures;
mod model;
mod options;
mod radiosity_map;
mod time;
mod view;

use std::sync::Arc;

use refsim::device::Profile;
use refsim::isa::Version;
use refsim::machine::Executor;

pub use gather::GatherProgram;
pub use light::Light;
pub use link_textures::LinkTextures;
pub use model::CardModel;
pub use options::{FloatTexels, LightStage, MapFormat, SubsurfaceCardOptions};
pub use time::{PassEvent, PassKind, PassTime, pass_times};
pub use view::View;

use crate::card::{CardError, Texels, require_versions};
use crate::picture::Picture;
use gather::Gather;
use levels::LeveledMap;
use light::CardLights;
use radiosity_map::LightPass;
use view::ViewPass;

/// Maximum number of texels per side if a device states no limit.
const MAX_TEXELS: u32 = 16384;

/// A model on a card, with its links; initially without light.
#[derive(Debug)]
pub struct SubsurfaceCard {
    options: SubsurfaceCardOptions,
    model: CardModel,
    memory: [u64; 2],
    map: LeveledMap,
    light: LightPass,
    gather: Gather,
    view: ViewPass,
    lights: CardLights,
    /// The log by pass; `None` if it is not recorded.
    log: Option<Vec<PassEvent>>,
}

impl SubsurfaceCard {
    /// Uploads a model and its links. `eta` is the index of refraction.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        model: CardModel,
        links: &LinkTextures,
        eta: f64,
        options: SubsurfaceCardOptions,
    ) -> Result<Self, CardError> {
        let profile = profile.into();
        options.check()?;
        CardError::check_size("texels along a side of the links' atlas", model.side() as usize, links.side as usize)?;
        Self::fits(&profile, links, &options)?;
        links.check(options.links)?;
        let programs = gather::programs(&profile, links, &options)?;
        let memory = memory(links, &options, &programs);
        let mut machine = executor.into().machine(profile)?;
        let map = LeveledMap::new(&mut machine, options.map, model.side(), links.layout())?;
        let light = LightPass::new(&mut machine, &model, options.light, options.map, eta)?;
        let gather = Gather::new(&mut machine, links, &options)?;
        let view = ViewPass::new(machine, &model, eta);
        let lights = CardLights::default();
        Ok(Self { options, model, memory, map, light, gather, view, lights, log: None })
    }

    /// Checks that a device runs the passes. Fails with [`CardError`] if it does not.
    pub fn require(profile: &Profile) -> Result<(), CardError> {
        Ok(require_versions(profile, &[Version::Fp1_0, Version::Vs2_0], "the passes")?)
    }

    fn fits(profile: &Profile, links: &LinkTextures, options: &SubsurfaceCardOptions) -> Result<(), CardError> {
        Self::require(profile)?;
        let sides = [profile.limits.max_texture_size, profile.limits.max_target_size].into_iter().flatten();
        let limit = sides.min().unwrap_or(MAX_TEXELS);
        let row = !options.map.is_leveled() && links.level.is_none();
        let (what, width) = if row { ("the row of levels", 2 * links.side) } else { ("the atlas", links.side) };
        if width > limit {
            return Err(CardError::input(format!(
                "device `{}` has textures of at most {limit}x{limit} texels, {what} needs {width}x{}",
                profile.name, links.side
            )));
        }
        Ok(())
    }

    /// The options of the card.
    pub fn options(&self) -> &SubsurfaceCardOptions {
        &self.options
    }

    /// Bytes of textures and targets, without the picture: of all, and of links alone.
    pub fn memory(&self) -> [u64; 2] {
        self.memory
    }

    /// The programs of pass 2, one per pass over links.
    pub fn gather_programs(&self) -> &[GatherProgram] {
        &self.gather.programs
    }

    /// Runs passes 1 and 2 for new lights. Fails with [`CardError::Input`] or [`CardError::Draw`].
    pub fn light(&mut self, lights: &[Light]) -> Result<(), CardError> {
        self.lights = CardLights::new(lights, &self.model)?;
        self.light.run(self.view.display.machine_mut(), &self.lights, self.map.map)?;
        self.scatter()
    }

    /// Replaces pass 1 by given irradiances (equation 8: the light that enters the surface), one per texel, row by row;
    /// then runs pass 2. There is no direct light then. Fails with [`CardError::Input`] or [`CardError::Draw`].
    pub fn irradiate(&mut self, irradiances: &[[f64; 3]]) -> Result<(), CardError> {
        self.lights = CardLights::default();
        self.light.fill(self.view.display.machine_mut(), &self.model, irradiances, self.map.map)?;
        self.scatter()
    }

    fn scatter(&mut self) -> Result<(), CardError> {
        self.note(PassKind::RadiosityMap);
        self.map.fill(self.view.display.machine_mut())?;
        self.note(PassKind::Levels);
        self.gather()
    }

    /// Runs pass 2 with the current map, as [`Self::light`] and [`Self::irradiate`] do at their end.
    pub fn gather(&mut self) -> Result<(), CardError> {
        self.gather.run(self.view.display.machine_mut(), &self.map)?;
        self.note(PassKind::Gather);
        Ok(())
    }

    /// Draws the model from a camera: pass 3. Background pixels are 0.
    pub fn view(&mut self, view: &View) -> Result<Picture, CardError> {
        Ok(self.view_texels(view)?.picture())
    }

    /// Like [`Self::view`], with alpha 1 where the model is visible. Fails as [`Self::view`] does.
    pub fn view_texels(&mut self, view: &View) -> Result<Texels, CardError> {
        let texels = self.view.show(&self.lights, self.gather.scattered(), view)?;
        self.note(PassKind::View);
        Ok(texels)
    }

    /// Reads all levels of the radiosity map, finest first: irradiance times transmittance times area, divided by the
    /// mean area and multiplied by the map's scale. Fails with [`CardError::Draw`].
    pub fn read_levels(&self) -> Result<Vec<Texels>, CardError> {
        self.map.read_back(self.view.display.machine())
    }

    /// Reads only the finest level of the radiosity map. Fails with [`CardError::Draw`].
    pub fn read_map(&self) -> Result<Texels, CardError> {
        Ok(Texels::read_back(self.view.display.machine(), self.map.map)?)
    }

    /// Reads the scattered irradiance: B of equation 9 per texel. Fails with [`CardError::Draw`].
    pub fn read_scattered(&self) -> Result<Texels, CardError> {
        Ok(Texels::read_back(self.view.display.machine(), self.gather.scattered())?)
    }

    /// Number of channels of the radiosity map's texels at the largest value, where light may have been clamped.
    pub fn saturated(&self) -> Result<usize, CardError> {
        let largest = self.options.map.largest();
        let map = self.read_map()?;
        let channels = map.texels.iter().flat_map(|texel| &texel[..3]);
        Ok(channels.filter(|value| **value >= largest).count())
    }

    /// Starts or stops recording the log.
    pub fn record(&mut self, on: bool) {
        self.view.display.machine_mut().record(on);
        self.view.display.machine_mut().take_log();
        self.log = on.then(Vec::new);
    }

    /// The log recorded since the last call, by pass.
    pub fn take_log(&mut self) -> Vec<PassEvent> {
        self.log.as_mut().map(std::mem::take).unwrap_or_default()
    }

    fn note(&mut self, pass: PassKind) {
        if let Some(log) = &mut self.log {
            log.extend(self.view.display.machine_mut().take_log().into_iter().map(|event| PassEvent { pass, event }));
        }
    }
}

fn memory(links: &LinkTextures, options: &SubsurfaceCardOptions, programs: &[GatherProgram]) -> [u64; 2] {
    let texels = u64::from(links.side) * u64::from(links.side);
    let geometry = if options.light == LightStage::Texels { 2 * 16 * texels } else { 0 };
    let scattered = texels * options.scattered.format().bytes() as u64 * programs.len().min(2) as u64;
    let links_alone = links.bytes(options.links, programs.iter().map(GatherProgram::link_textures).sum());
    [links_alone + LeveledMap::bytes(options.map, links.side, links.layout()) + scattered + geometry, links_alone]
}
