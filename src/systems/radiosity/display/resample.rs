//! Resampling of radiosities from patches to corners by fragment passes, for smooth display.

use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{Machine, TextureId};
use refsim::output::WriteMask;
use refsim::texture::TexelFormat;

use super::corners::CornerSets;
use crate::card::{FullScreenPass, PingPong, Texels, nearest};
use crate::radiosity::draw::{DrawError, bits};
use crate::radiosity::kernels;

const WIDTH: usize = 512;
/// Patches per pass.
const PER_PASS: usize = 4;

/// p[0] and p[1] of the program: `(number + 1/2) * p[0] + p[1]` is a patch's texel in the row of radiosities.
const PATCH_TEXEL: [[f64; 4]; 2] = [[1.0, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0]];

#[derive(Debug)]
pub(super) struct Resampler {
    program: CheckedProgram,
    constants: Constants,
    size: [u32; 2],
    /// Textures of patch numbers and weights of each pass.
    passes: Vec<[TextureId; 2]>,
    means: PingPong,
}

impl Resampler {
    pub(super) fn new(machine: &mut Machine, corner_sets: &CornerSets) -> Result<Self, DrawError> {
        let program = kernels::RESAMPLE.checked(machine.profile())?;
        let sets = &corner_sets.sets;
        let width = sets.len().clamp(1, WIDTH);
        let size = [width, sets.len().div_ceil(width).max(1)];
        let most = sets.iter().map(Vec::len).max().unwrap_or(1);
        let passes =
            (0..most.div_ceil(PER_PASS)).map(|pass| upload(machine, sets, size, pass)).collect::<Result<_, _>>()?;
        let means = PingPong::new(machine, TexelFormat::Rgba32f, size)?;
        let constants = Constants { float: PATCH_TEXEL.map(bits).to_vec(), ..Constants::default() };
        Ok(Self { program, constants, size: size.map(|side| side as u32), passes, means })
    }

    /// Computes the texture of corners from the texture of patches.
    pub(super) fn run(&self, machine: &mut Machine, radiosity: TextureId) -> Result<TextureId, DrawError> {
        machine.clear_target(self.means.read_by(0), [0; 4])?;
        for (pass, &[numbers, weights]) in self.passes.iter().enumerate() {
            FullScreenPass {
                program: &self.program,
                constants: &self.constants,
                textures: &nearest([numbers, weights, self.means.read_by(pass), radiosity]),
                target: self.means.written_by(pass),
                mask: WriteMask::ALL,
                part: None,
            }
            .draw_counting(machine, self.size.map(|side| side as usize))?;
        }
        Ok(self.means.read_by(self.passes.len()))
    }

    /// Texel coordinates of a set of patches.
    pub(super) fn texel(&self, set: u32) -> [f64; 2] {
        let [width, _] = self.size;
        [set % width, set / width].map(|at| f64::from(at) + 0.5)
    }
}

/// Uploads the numbers of the patches of a pass, and their weights.
fn upload(
    machine: &mut Machine,
    sets: &[Vec<u32>],
    size: [usize; 2],
    pass: usize,
) -> Result<[TextureId; 2], DrawError> {
    let mut values = [(); 2].map(|()| Texels::from_fn(size, |_, _| [0.0; 4]));
    for (texel, set) in sets.iter().enumerate() {
        let from = pass * PER_PASS;
        // Patches with weight 0 are still read: unused numbers repeat the set's last number, so that no other value is
        // read.
        let number = |k: usize| (f64::from(set[(from + k).min(set.len() - 1)]) + 0.5) as f32;
        let weight = |k: usize| if from + k < set.len() { (1.0 / (from + k + 1) as f64) as f32 } else { 0.0 };
        values[0].texels[texel] = [0, 1, 2, 3].map(number);
        values[1].texels[texel] = [0, 1, 2, 3].map(weight);
    }
    let [numbers, weights] = values.map(|values| values.upload(machine, TexelFormat::Rgba32f));
    Ok([numbers?, weights?])
}
