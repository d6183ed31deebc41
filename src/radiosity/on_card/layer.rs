//! One system on the card: its matrix and emittance, and three vectors that take turns.

use refsim::exec::Constants;
use refsim::machine::{DrawCall, Machine, TextureId, VertexSource};
use refsim::output::WriteMask;
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::SamplerState;

use super::programs::{Pass, Programs};
use super::{CardError, Storage};
use crate::card;
use crate::radiosity::card_order::CardSystem;
use crate::radiosity::packing::{Packing, Texels};

/// Sizes of a system's textures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    pub(super) packing: Packing,
    pub(super) size: usize,
    pub(super) block: usize,
    /// Texels of a vector, and of a matrix across.
    pub(super) width: usize,
    /// Rows of a matrix.
    pub(super) rows: usize,
}

impl Shape {
    pub(super) fn of(system: &CardSystem) -> Self {
        let matrix = system.matrix();
        let (packing, size, block) = (system.packing(), system.len(), system.block());
        Self { packing, size, block, width: matrix.width, rows: matrix.height }
    }

    /// Whether a texture is one of this system's vectors.
    pub(super) fn check_vector(&self, texels: &Texels) -> Result<(), CardError> {
        same("texels, as the card has", self.width, texels.texels.len())
    }
}

pub(super) fn same(what: &'static str, expected: usize, found: usize) -> Result<(), CardError> {
    if expected == found { Ok(()) } else { Err(CardError::Size { what, expected, found }) }
}

/// A system's textures. Its radiosities are one of three vectors: a pass reads it and what the pass before wrote, and writes the third.
#[derive(Debug)]
pub(super) struct Layer {
    shape: Shape,
    storage: Storage,
    matrix: TextureId,
    emittance: TextureId,
    pub(super) radiosity: TextureId,
    partial: [TextureId; 2],
}

impl Layer {
    /// Uploads a system; radiosities are 0.
    pub(super) fn new(machine: &mut Machine, system: &CardSystem, storage: Storage) -> Result<Self, CardError> {
        let shape = Shape::of(system);
        let format = storage.format();
        let upload = |machine: &mut Machine, texels: &Texels| -> Result<TextureId, CardError> {
            let image = card::float_image(format, [texels.width, texels.height], &texels.texels)?;
            Ok(machine.create_texture(image)?)
        };
        let matrix = upload(machine, system.matrix())?;
        let emittance = upload(machine, system.emittance())?;
        let mut vector = || -> Result<TextureId, CardError> {
            Ok(machine.create_target_from(card::empty_image(format, [shape.width, 1])?)?)
        };
        let (radiosity, partial) = (vector()?, [vector()?, vector()?]);
        Ok(Self { shape, storage, matrix, emittance, radiosity, partial })
    }

    pub(super) fn set_matrix(&self, machine: &mut Machine, texels: &Texels) -> Result<(), CardError> {
        same("texels, as the card has", self.shape.width * self.shape.rows, texels.texels.len())?;
        self.update(machine, self.matrix, texels)
    }

    pub(super) fn set_emittance(&self, machine: &mut Machine, texels: &Texels) -> Result<(), CardError> {
        self.shape.check_vector(texels)?;
        self.update(machine, self.emittance, texels)
    }

    pub(super) fn load(&self, machine: &mut Machine, texels: &Texels) -> Result<(), CardError> {
        self.shape.check_vector(texels)?;
        self.update(machine, self.radiosity, texels)
    }

    fn update(&self, machine: &mut Machine, texture: TextureId, texels: &Texels) -> Result<(), CardError> {
        let image = card::float_image(self.storage.format(), [texels.width, texels.height], &texels.texels)?;
        Ok(machine.update_texture(texture, &image)?)
    }

    /// What a texture of vectors holds.
    pub(super) fn read(&self, machine: &Machine, texture: TextureId) -> Result<Texels, CardError> {
        let texels = card::floats(machine.read_back(texture)?);
        Ok(Texels { width: self.shape.width, height: 1, texels })
    }

    /// The texture into which a pass draws.
    pub(super) fn target(&self, pass: usize) -> TextureId {
        self.partial[pass % 2]
    }

    /// One pass of equation 4.
    pub(super) fn pass(&self, machine: &mut Machine, programs: &Programs, number: usize) -> Result<(), CardError> {
        let Some(&pass) = programs.passes.get(number) else { return Ok(()) };
        match self.shape.packing {
            Packing::Rgb => self.draw(machine, programs, (number, pass), 0.0, WriteMask::ALL),
            // Channel c of texel x is row 4x + c; at the middle of the texel the row is 4 (x + 0.5) + c - 1.5.
            Packing::Luminance => (0..4_u8)
                .try_for_each(|c| self.draw(machine, programs, (number, pass), f32::from(c) - 1.5, WriteMask(1 << c))),
        }
    }

    /// A quad over the target, `row` added to the matrix's row that its place stands for.
    fn draw(
        &self,
        machine: &mut Machine,
        programs: &Programs,
        (number, pass): (usize, Pass),
        row: f32,
        mask: WriteMask,
    ) -> Result<(), CardError> {
        let Some(program) = programs.list.get(pass.program) else { return Ok(()) };
        let (width, rows) = (self.shape.width as f32, self.shape.rows as f32);
        let column = pass.from as f32 + 0.5;
        let corners = card::quad(|u, _| [[column, u * rows + row, 0.5, 1.0], [u * width, 0.5, 0.0, 1.0]]);
        let before = if number == 0 { self.emittance } else { self.target(number - 1) };
        let constants = Constants::default();
        let source = VertexSource::Transformed(&corners);
        let mut call = DrawCall::new(source, Primitive::QuadList, &program.checked, &constants, self.target(number));
        for (sampler, texture) in [self.matrix, self.radiosity, before].into_iter().enumerate() {
            call = call.with_texture(sampler, texture, SamplerState::NEAREST_CLAMP);
        }
        call.center = PixelCenter::OpenGl;
        call.masks[0] = mask;
        machine.draw(&call)?;
        Ok(())
    }

    /// The last pass's target holds the radiosities from now on.
    pub(super) fn turn(&mut self, passes: usize) {
        if let Some(last) = passes.checked_sub(1) {
            std::mem::swap(&mut self.radiosity, &mut self.partial[last % 2]);
        }
    }
}
