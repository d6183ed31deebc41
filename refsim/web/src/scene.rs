//! Inputs of programs in the page: one quad over the picture, and textures by sampler.
//!
//! | input | value at (s, t) of the picture, 0 to 1 from the upper left |
//! |---|---|
//! | `t0` | (s, t, 0, 1) |
//! | `t1` | (2 s - 1, 1 - 2 t, 1, 1) |
//! | `t2` and up | (SIDE s, SIDE t, 0, 1): texels of the rectangles |
//! | `v0`, `v1` | (s, t, 1 - s, 1), (t, s, 0.5, 0.5) |
//! | sampler 0, 4, ... | a checkerboard of 8 x 8 |
//! | sampler 1, 5, ... | (s, t, 1 - s) |
//! | sampler 2, 6, ... | normals of a dome, as (n + 1) / 2 |
//! | sampler 3, 7, ... | a ramp: s in all channels |
//!
//! Constants that the text does not define are 0.

use refsim::check::Checked;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::isa::{Instruction, Program, RegisterFile, TextureTarget, Usage};
use refsim::machine::{DrawCall, ExecutorKind, FragmentTrace, Machine, MachineError, TextureId, VertexSource};
use refsim::raster::{PixelCenter, Primitive, Vertex, full_screen_quad};
use refsim::texture::{AddressMode, Image, SamplerState, TexelFormat, TextureError, TextureKind};

/// Side of the picture and of the textures, in pixels.
pub const SIDE: u32 = 32;

/// A program on a device, with all its inputs.
pub(crate) struct Scene<'p> {
    machine: Machine,
    inputs: Inputs<'p>,
}

struct Inputs<'p> {
    program: &'p Checked<Program>,
    constants: Constants,
    quad: [Vertex; 4],
    target: TextureId,
    textures: Vec<(usize, TextureId)>,
}

impl<'p> Scene<'p> {
    /// Creates the textures that the program reads.
    pub(crate) fn new(
        program: &'p Checked<Program>,
        profile: &Profile,
        executor: ExecutorKind,
    ) -> Result<Self, MachineError> {
        let mut machine = Machine::new(profile.clone(), executor);
        let target = machine.create_target(TexelFormat::Bgra8, SIDE, SIDE)?;
        let mut textures = Vec::new();
        for sampler in (0..16).filter(|sampler| (program.facts().samplers >> sampler) & 1 == 1) {
            if let Some(kind) = kind(program, sampler) {
                textures.push((sampler, machine.create_texture(image(sampler, kind)?)?));
            }
        }
        let inputs = Inputs { program, constants: Constants::default(), quad: quad(SIDE), target, textures };
        Ok(Self { machine, inputs })
    }

    /// Draws; returns red, green and blue of each pixel.
    pub(crate) fn picture(mut self) -> Result<Vec<u8>, MachineError> {
        self.machine.draw(&self.inputs.call())?;
        let image = self.machine.read_back(self.inputs.target)?;
        let pixels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
        Ok(pixels.flat_map(|(x, y)| [16, 8, 0].map(|shift| (image.raw(0, 0, y, x) >> shift) as u8)).collect())
    }

    pub(crate) fn trace(&self, pixel: [u32; 2]) -> Result<Vec<FragmentTrace>, MachineError> {
        self.machine.trace(&self.inputs.call(), pixel.into())
    }
}

impl Inputs<'_> {
    fn call(&self) -> DrawCall<'_> {
        let vertices = VertexSource::Transformed(&self.quad);
        let call = DrawCall::new(vertices, Primitive::QuadList, self.program, &self.constants, self.target);
        let state =
            SamplerState { address_u: AddressMode::Wrap, address_v: AddressMode::Wrap, ..SamplerState::NEAREST_CLAMP };
        let call = DrawCall { center: PixelCenter::OpenGl, ..call };
        self.textures.iter().fold(call, |call, &(sampler, texture)| call.with_texture(sampler, texture, state))
    }
}

/// The quad over a picture of `side` x `side` pixels.
pub(crate) fn quad(side: u32) -> [Vertex; 4] {
    let side = side as f32;
    let mut quad = full_screen_quad(|s, t| {
        let texels = [side * s, side * t, 0.0, 1.0];
        [[s, t, 0.0, 1.0], [2.0 * s - 1.0, 1.0 - 2.0 * t, 1.0, 1.0], texels, texels, texels, texels, texels, texels]
    });
    for vertex in &mut quad {
        let [s, t, ..] = vertex.texcoords[0].map(f32::from_bits);
        vertex.colors = [[s, t, 1.0 - s, 1.0], [t, s, 0.5, 0.5]].map(|color| color.map(f32::to_bits));
    }
    quad
}

/// Kind of a sampler's texture; `None` for textures that the page lacks: reading them gives (0, 0, 0, 1).
fn kind(program: &Checked<Program>, sampler: usize) -> Option<TextureKind> {
    let reads = |instruction: &&Instruction| {
        instruction.sources.iter().any(|source| {
            source.register.file == RegisterFile::Sampler && usize::from(source.register.index) == sampler
        })
    };
    let target = program.instructions.iter().find(reads).and_then(|instruction| instruction.fragment.target);
    match (target, program.facts().sampler_usage.get(sampler).copied().flatten()) {
        (Some(TextureTarget::Rect), _) => Some(TextureKind::Rectangle),
        (Some(TextureTarget::D2), _) | (None, None | Some(Usage::Sampler2d)) => Some(TextureKind::D2),
        _ => None,
    }
}

fn image(sampler: usize, kind: TextureKind) -> Result<Image, TextureError> {
    let mut image = Image::new(TexelFormat::Bgra8, kind, [SIDE, SIDE, 1], 1)?;
    let code = |value: f64| (255.0 * value).round() as u8;
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let [s, t] = [x, y].map(|at| (f64::from(at) + 0.5) / f64::from(SIDE));
        let [r, g, b] = match sampler % 4 {
            0 if (x / 4 + y / 4) % 2 == 0 => [1.0, 1.0, 1.0],
            0 => [0.0, 0.25, 0.75],
            1 => [s, t, 1.0 - s],
            2 => {
                let [p, q] = [2.0 * s - 1.0, 1.0 - 2.0 * t];
                let length = (p * p + q * q + 1.0).sqrt();
                [p, q, 1.0].map(|component| (component / length + 1.0) / 2.0)
            }
            _ => [s; 3],
        };
        let [r, g, b] = [r, g, b].map(code);
        image.set_raw(0, 0, y, x, u32::from_be_bytes([255, r, g, b]).into());
    }
    Ok(image)
}
