//! Jacobi iteration (equation 4) on an emulated card: matrix and emittance are uploaded once, a pass is a full-screen
//! quad, radiosities are a 1-D texture.
//!
//! A target is one row of texels, with one patch (RGB) or four (luminance) per texel, so that a texture coordinate
//! along it is a patch's number, as the paper displays it. Half of each quad of 2 x 2 fragments that the card shades
//! lies below that row and is lost.

mod cycle;
mod fit;
mod layer;
mod programs;
mod solve;

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::{Executor, Machine, TextureId};

pub use cycle::Cycle;
pub use fit::{Fit, Storage};
pub use programs::PassProgram;
pub use solve::{CardSolution, Iteration, to_f64};

use super::System;
use super::card_system::{CardSystem, emittances};
use super::kernels;
use super::packing::Packing;
use crate::card::{CardError, Texels};
use layer::{Layer, SystemLayout};
use programs::Programs;

/// Unit of the sizes in error messages.
const PATCHES: &str = "patches, as the card has";
const SYSTEMS: &str = "systems (RGB: one; luminance: one, or three for the channels)";

/// System on a card. Radiosities are initially 0, and are kept when emittances or reflectances change.
#[derive(Debug)]
pub struct CardSolver {
    machine: Machine,
    fit: Fit,
    layout: SystemLayout,
    programs: Programs,
    /// One system of three channels, or one system per channel.
    layers: Vec<Layer>,
}

impl CardSolver {
    /// Creates a solver and uploads a system: one texture of three matrices, or three textures of one matrix each.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        system: &System,
        packing: Packing,
        storage: Storage,
    ) -> Result<Self, CardError> {
        let profile = profile.into();
        let systems = Fit::of(&profile, packing)?.systems(&profile, packing, system)?;
        Self::of(profile, executor, &systems, storage)
    }

    /// Creates a solver and uploads systems that are already in the card's layout: one system, or three luminance
    /// systems of the same size. Fails as [`Self::new`] does, with [`CardError::Input`] for another number of systems
    /// or for different sizes, and with [`CardError::Program`] for blocks that are too long for the device.
    pub fn of(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        systems: &[CardSystem],
        storage: Storage,
    ) -> Result<Self, CardError> {
        let profile = profile.into();
        let Some(layout) = systems.first().map(SystemLayout::of) else {
            return Err(CardError::input(format!("expected 1 {SYSTEMS}, found 0")));
        };
        let expected = if layout.packing == Packing::Luminance && systems.len() > 1 { 3 } else { 1 };
        CardError::check_size(SYSTEMS, expected, systems.len())?;
        let alike = systems.iter().filter(|system| SystemLayout::of(system) == layout).count();
        CardError::check_size("systems of one layout, size and block", systems.len(), alike)?;
        let fit = Fit::of(&profile, layout.packing)?;
        let kernels = kernels::of(layout.packing, storage == Storage::Fp16);
        let programs = Programs::new(&profile, kernels, layout.width, layout.block)?;
        let mut machine = executor.into().machine(profile)?;
        let layers =
            systems.iter().map(|system| Layer::new(&mut machine, system, storage)).collect::<Result<_, _>>()?;
        Ok(Self { machine, fit, layout, programs, layers })
    }

    /// Number of patches.
    pub fn patches(&self) -> usize {
        self.layout.size
    }

    /// Passes per iteration, of each system.
    pub fn passes(&self) -> usize {
        self.programs.passes.len()
    }

    /// The programs, each once, in the order of their first pass.
    pub fn programs(&self) -> &[PassProgram] {
        &self.programs.list
    }

    /// Runs one iteration: all passes of all systems. Fails with [`CardError::Draw`].
    pub fn iterate(&mut self) -> Result<(), CardError> {
        let passes = self.passes();
        for layer in &mut self.layers {
            (0..passes).try_for_each(|pass| layer.pass(&mut self.machine, &self.programs, pass))?;
            layer.turn(passes);
        }
        Ok(())
    }

    /// Draws only the last pass of the last system, which gives the card the bindings that a whole iteration leaves,
    /// but not its results.
    pub(in crate::radiosity) fn bind_as_after_iteration(&mut self) -> Result<(), CardError> {
        let passes = self.passes();
        if let (Some(layer), Some(last)) = (self.layers.last(), passes.checked_sub(1)) {
            layer.pass(&mut self.machine, &self.programs, last)?;
        }
        self.layers.iter_mut().for_each(|layer| layer.turn(passes));
        Ok(())
    }

    /// Reads the radiosities back: red, green and blue of each patch. A single luminance system is grey.
    pub fn read(&self) -> Result<Vec<[f32; 3]>, CardError> {
        let all = self.read_texels()?;
        let last = all.len().saturating_sub(1);
        let luminance = |i: usize, c: usize| all[c.min(last)].texels[i / 4][i % 4];
        Ok(match self.layout.packing {
            Packing::Rgb => super::packing::from_rgb_vector(&all[0]),
            Packing::Luminance => (0..self.patches()).map(|i| [0, 1, 2].map(|c| luminance(i, c))).collect(),
        })
    }

    /// Reads the radiosities back in the layout of the textures, one per system. Fails with [`CardError::Draw`].
    pub fn read_texels(&self) -> Result<Vec<Texels>, CardError> {
        let layers = self.layers.iter();
        Ok(layers.map(|layer| Texels::read_back(&self.machine, layer.radiosity)).collect::<Result<_, _>>()?)
    }

    /// Replaces the radiosities. Fails with [`CardError::Input`] if there is not one per patch.
    pub fn load(&mut self, radiosity: &[[f32; 3]]) -> Result<(), CardError> {
        CardError::check_size(PATCHES, self.patches(), radiosity.len())?;
        let texel = |c: usize, x: usize| [0, 1, 2, 3].map(|k| radiosity.get(4 * x + k).map_or(0.0, |b| b[c]));
        let layouts: Vec<Texels> = match self.layout.packing {
            Packing::Rgb => vec![Texels::vector(radiosity.iter().map(|&[r, g, b]| [r, g, b, 0.0]).collect())],
            Packing::Luminance => (0..self.layers.len())
                .map(|c| Texels::vector((0..self.layout.width).map(|x| texel(c, x)).collect()))
                .collect(),
        };
        let machine = &mut self.machine;
        self.layers.iter().zip(&layouts).try_for_each(|(layer, texels)| layer.load(machine, texels))
    }

    /// Dynamic relighting: uploads the emittances of a system whose matrix is on the card. Radiosities are
    /// kept. Fails with [`CardError::Input`] if the system has another number of patches.
    pub fn set_emittance(&mut self, system: &System) -> Result<(), CardError> {
        CardError::check_size(PATCHES, self.patches(), system.factors().len())?;
        let texels = emittances(system, self.layout.packing, self.fit.limit)
            .map_err(|problem| fit::too_large(self.machine.profile(), problem))?;
        let machine = &mut self.machine;
        self.layers.iter().zip(&texels).try_for_each(|(layer, texels)| layer.set_emittance(machine, texels))
    }

    /// The textures that hold the radiosities, one row of texels each: one texture of three channels, or one per
    /// channel with four patches per texel. An iteration changes which textures these are.
    pub fn radiosity_textures(&self) -> Vec<TextureId> {
        self.layers.iter().map(|layer| layer.radiosity).collect()
    }

    /// The emulated card, for drawing from the radiosities without reading them back.
    pub fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    /// Starts or stops recording the log.
    pub fn record(&mut self, on: bool) {
        self.machine.record(on);
    }

    /// The log recorded since the last call.
    pub fn take_log(&mut self) -> Vec<Event> {
        self.machine.take_log()
    }
}
