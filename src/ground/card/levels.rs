//! A pyramid of targets: each level is drawn by a pass that reads the level before.

use refsim::event::DrawEvents;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{Machine, MachineError, TextureId};
use refsim::output::WriteMask;
use refsim::texture::TexelFormat;

use super::{FullScreenPass, nearest, new_target};

/// The levels below a texture, each half as wide and high as the level before (rounded down, at least 1), down to one
/// texel.
#[derive(Clone, Debug)]
pub struct Levels {
    base: [usize; 2],
    targets: Vec<TextureId>,
}

impl Levels {
    /// Targets for the levels below a texture of size `base`. Fails as [`new_target`] does.
    pub fn new(machine: &mut Machine, format: TexelFormat, base: [usize; 2]) -> Result<Self, MachineError> {
        let sizes = std::iter::successors(Some(base), |&size| (size != [1, 1]).then(|| halved(size)));
        let targets = sizes.skip(1).map(|size| new_target(machine, format, size)).collect::<Result<_, _>>()?;
        Ok(Self { base, targets })
    }

    /// The levels, finest first; `base` itself is not among them.
    pub fn targets(&self) -> &[TextureId] {
        &self.targets
    }

    /// Fills all levels from `base`, one pass each. The program reads the finer level from sampler 0; TEX0 is the
    /// fragment's center in texels of that level: the common corner of the four texels that the fragment covers.
    pub fn fill(
        &self,
        machine: &mut Machine,
        base: TextureId,
        program: &CheckedProgram,
    ) -> Result<DrawEvents, MachineError> {
        let (mut finer, mut size, mut events) = (base, self.base, DrawEvents::default());
        for &target in &self.targets {
            let constants = &Constants::default();
            let textures = &nearest([finer]);
            let pass = FullScreenPass { program, constants, textures, target, mask: WriteMask::ALL, part: None };
            events += pass.draw_counting(machine, size)?;
            (finer, size) = (target, halved(size));
        }
        Ok(events)
    }
}

fn halved(size: [usize; 2]) -> [usize; 2] {
    size.map(|side| (side / 2).max(1))
}
