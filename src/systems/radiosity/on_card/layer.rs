//! The textures of one system: its matrix, its emittance, and three vectors, one of them the radiosities.

use refsim::exec::Constants;
use refsim::machine::{Machine, TextureId};
use refsim::output::WriteMask;

use super::Storage;
use super::programs::{BlockPass, Programs};
use crate::card::{CardError, FullScreenPass, PingPong, Texels, nearest, new_target};
use crate::radiosity::card_system::CardSystem;
use crate::radiosity::packing::Packing;

/// Packing and sizes of a system's textures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SystemLayout {
    pub(super) packing: Packing,
    pub(super) size: usize,
    pub(super) block: usize,
    /// Number of texels of a vector, and of a row of the matrix.
    pub(super) width: usize,
    /// Rows of a matrix.
    pub(super) rows: usize,
}

impl SystemLayout {
    pub(super) fn of(system: &CardSystem) -> Self {
        let &CardSystem { packing, size, block, ref matrix, .. } = system;
        Self { packing, size, block, width: matrix.width, rows: matrix.height }
    }
}

/// A system's textures. A pass reads the radiosities and partial sums; the last pass's sums are the new radiosities.
#[derive(Debug)]
pub(super) struct Layer {
    layout: SystemLayout,
    storage: Storage,
    matrix: TextureId,
    emittance: TextureId,
    pub(super) radiosity: TextureId,
    partial: PingPong,
}

impl Layer {
    /// Uploads a system; radiosities are 0.
    pub(super) fn new(machine: &mut Machine, system: &CardSystem, storage: Storage) -> Result<Self, CardError> {
        let layout = SystemLayout::of(system);
        let format = storage.format();
        let matrix = system.matrix.upload(machine, format)?;
        let emittance = system.emittance.upload(machine, format)?;
        let size = [layout.width, 1];
        let radiosity = new_target(machine, format, size)?;
        let partial = PingPong::new(machine, format, size)?;
        Ok(Self { layout, storage, matrix, emittance, radiosity, partial })
    }

    pub(super) fn set_emittance(&self, machine: &mut Machine, texels: &Texels) -> Result<(), CardError> {
        self.update(machine, self.emittance, texels)
    }

    pub(super) fn load(&self, machine: &mut Machine, texels: &Texels) -> Result<(), CardError> {
        self.update(machine, self.radiosity, texels)
    }

    fn update(&self, machine: &mut Machine, into: TextureId, texels: &Texels) -> Result<(), CardError> {
        CardError::check_size("texels, as the card has", self.layout.width, texels.texels.len())?;
        Ok(texels.update(machine, into, self.storage.format())?)
    }

    fn target(&self, pass: usize) -> TextureId {
        self.partial.written_by(pass)
    }

    pub(super) fn pass(&self, machine: &mut Machine, programs: &Programs, number: usize) -> Result<(), CardError> {
        let Some(&pass) = programs.passes.get(number) else { return Ok(()) };
        match self.layout.packing {
            Packing::Rgb => self.draw(machine, programs, number, pass, 0.0, WriteMask::ALL),
            // Channel c of texel x is row 4x + c; at the middle of the texel the row is 4 (x + 0.5) + c - 1.5.
            Packing::Luminance => (0..4_u8)
                .try_for_each(|c| self.draw(machine, programs, number, pass, f32::from(c) - 1.5, WriteMask(1 << c))),
        }
    }

    /// Draws a quad over the target, whose fragments read the matrix `row` rows below their own.
    fn draw(
        &self,
        machine: &mut Machine,
        programs: &Programs,
        number: usize,
        pass: BlockPass,
        row: f32,
        mask: WriteMask,
    ) -> Result<(), CardError> {
        let Some(program) = programs.list.get(pass.program) else { return Ok(()) };
        let (width, rows) = (self.layout.width as f32, self.layout.rows as f32);
        let column = pass.from as f32 + 0.5;
        let before = if number == 0 { self.emittance } else { self.partial.read_by(number) };
        FullScreenPass {
            program: &program.checked,
            constants: &Constants::default(),
            textures: &nearest([self.matrix, self.radiosity, before]),
            target: self.target(number),
            mask,
            part: None,
        }
        .draw(machine, |u, _| [[column, u * rows + row, 0.5, 1.0], [u * width, 0.5, 0.0, 1.0]])?;
        Ok(())
    }

    /// Makes the last pass's target the radiosities.
    pub(super) fn turn(&mut self, passes: usize) {
        if let Some(last) = passes.checked_sub(1) {
            self.partial.exchange(last, &mut self.radiosity);
        }
    }
}
