//! From radiosities of patches to radiosities at corners, by fragment passes: the paper's resampling before it can interpolate.

use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Machine, MachineError, TextureId, VertexSource};
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::{SamplerState, TexelFormat};

use super::VectorTexture;
use super::corners::Meetings;
use super::programs::checked;
use crate::card;
use crate::radiosity::draw::DrawError;
use crate::radiosity::kernels;

/// Texels across, at most.
const WIDTH: usize = 512;
/// Patches that a pass adds to the mean.
const PER_PASS: usize = 4;

/// The texture of corners, and what fills it.
#[derive(Debug)]
pub(super) struct Resampler {
    program: CheckedProgram,
    constants: Constants,
    size: [u32; 2],
    /// Numbers and weights of each pass.
    passes: Vec<[TextureId; 2]>,
    targets: [TextureId; 2],
}

impl Resampler {
    /// Uploads which patches meet where.
    pub(super) fn new(machine: &mut Machine, meetings: &Meetings, vector: VectorTexture) -> Result<Self, DrawError> {
        let program = checked(machine.profile(), kernels::RESAMPLE)?;
        let sets = &meetings.sets;
        let width = sets.len().clamp(1, WIDTH);
        let size = [width, sets.len().div_ceil(width).max(1)];
        let most = sets.iter().map(Vec::len).max().unwrap_or(1);
        let passes =
            (0..most.div_ceil(PER_PASS)).map(|pass| upload(machine, sets, size, pass)).collect::<Result<_, _>>()?;
        let mut target = || -> Result<TextureId, DrawError> {
            let image = card::empty_image(TexelFormat::Rgba32f, size).map_err(MachineError::from)?;
            Ok(machine.create_target_from(image)?)
        };
        let targets = [target()?, target()?];
        let constants = Constants { float: vector.constants().to_vec(), ..Constants::default() };
        Ok(Self { program, constants, size: size.map(|side| side as u32), passes, targets })
    }

    /// Fills the texture of corners from one of patches.
    pub(super) fn run(&self, machine: &mut Machine, radiosity: TextureId) -> Result<TextureId, DrawError> {
        let [mut next, mut last] = self.targets;
        machine.clear_target(last, [0; 4])?;
        let [width, height] = self.size.map(|side| side as f32);
        let quad = card::quad(|u, v| [[u * width, v * height, 0.0, 1.0]]);
        for [numbers, weights] in &self.passes {
            let source = VertexSource::Transformed(&quad);
            let mut call = DrawCall::new(source, Primitive::QuadList, &self.program, &self.constants, next);
            call.center = PixelCenter::OpenGl;
            for (sampler, texture) in [*numbers, *weights, last, radiosity].into_iter().enumerate() {
                call = call.with_texture(sampler, texture, SamplerState::NEAREST_CLAMP);
            }
            machine.draw(&call)?;
            (next, last) = (last, next);
        }
        Ok(last)
    }

    /// Where a set of patches has its mean.
    pub(super) fn texel(&self, set: u32) -> [f64; 2] {
        let [width, _] = self.size;
        [set % width, set / width].map(|at| f64::from(at) + 0.5)
    }
}

/// Numbers of the patches that a pass adds, and what they count for.
fn upload(
    machine: &mut Machine,
    sets: &[Vec<u32>],
    size: [usize; 2],
    pass: usize,
) -> Result<[TextureId; 2], DrawError> {
    let mut values = [vec![[0.0; 4]; size[0] * size[1]], vec![[0.0; 4]; size[0] * size[1]]];
    for (texel, set) in sets.iter().enumerate() {
        let from = pass * PER_PASS;
        // A number that counts for nothing is still read: one of the set's own, so that nothing foreign gets in.
        let number = |k: usize| (f64::from(set[(from + k).min(set.len() - 1)]) + 0.5) as f32;
        let weight = |k: usize| if from + k < set.len() { (1.0 / (from + k + 1) as f64) as f32 } else { 0.0 };
        values[0][texel] = [0, 1, 2, 3].map(number);
        values[1][texel] = [0, 1, 2, 3].map(weight);
    }
    let [numbers, weights] = values.map(|values| -> Result<TextureId, DrawError> {
        let image = card::float_image(TexelFormat::Rgba32f, size, &values).map_err(MachineError::from)?;
        Ok(machine.create_texture(image)?)
    });
    Ok([numbers?, weights?])
}
