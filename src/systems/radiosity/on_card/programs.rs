//! The programs of an iteration: one for the first pass, one for middle passes, and one for the last block, which may
//! be shorter.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;

use crate::card::{KernelError, KernelText};

/// Program for a block, accepted by the device.
#[derive(Clone, Debug)]
pub struct PassProgram {
    /// Kernel from which the program was unrolled.
    pub kernel: KernelText,
    /// Texels per block.
    pub texels: usize,
    /// Program text.
    pub text: String,
    pub(super) checked: CheckedProgram,
}

impl PassProgram {
    pub(super) fn new(profile: &Profile, kernel: KernelText, texels: usize) -> Result<Self, KernelError> {
        let (text, checked) = kernel.unrolled_and_checked(profile, texels)?;
        Ok(Self { kernel, texels, text, checked })
    }

    /// Number of instructions.
    pub fn instructions(&self) -> usize {
        self.checked.instructions.len()
    }
}

/// Pass over one block: the first texel of the block, and the index of its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct BlockPass {
    pub(super) from: usize,
    pub(super) program: usize,
}

/// The distinct programs of an iteration, and its passes.
#[derive(Clone, Debug)]
pub(super) struct Programs {
    pub(super) list: Vec<PassProgram>,
    pub(super) passes: Vec<BlockPass>,
}

impl Programs {
    pub(super) fn new(
        profile: &Profile,
        [first, next]: [KernelText; 2],
        width: usize,
        block: usize,
    ) -> Result<Self, KernelError> {
        let (mut list, mut passes) = (Vec::<PassProgram>::new(), Vec::new());
        for from in (0..width).step_by(block.max(1)) {
            let kernel = if from == 0 { first } else { next };
            let texels = block.max(1).min(width - from);
            let known = list.iter().position(|p| p.kernel == kernel && p.texels == texels);
            let program = match known {
                Some(place) => place,
                None => {
                    list.push(PassProgram::new(profile, kernel, texels)?);
                    list.len() - 1
                }
            };
            passes.push(BlockPass { from, program });
        }
        Ok(Self { list, passes })
    }
}
