//! Encoding of programs as words for the virtual machine of `vm.wgsl`, which documents them.

use super::Interpolation;
use super::assembler::{Assembler, COLORS, DEPTH, DEPTH_IS_MAIN, FIRST_CONSTANT, INPUT, SETUP};
use super::error::ProgramError;
use super::lower::PixelShader;
use super::operations as op;
use crate::device::MAX_PROGRAM_FORMATS;
use crate::exec::lower::Arith;
use crate::exec::wgsl::parts::Parts;
use crate::raster::POSITION_COMPONENT;
use std::collections::{BTreeMap, BTreeSet};

/// Words before the first instruction.
const HEADER: usize = 3;
/// Maximum loop iterations of a program that runs in one dispatch; lavapipe terminates all loops after 65,535.
const MAX_PASSES: u32 = 40_000;

/// A program for the virtual machine of `vm.wgsl`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Microcode {
    /// Contents of the binding `code` from `q_code` on.
    pub words: Vec<u32>,
    /// Rows of `scratch` per invocation: `scratch` has this many times `q_stride` entries.
    pub slots: usize,
    /// Parts of the machine that it uses.
    pub parts: Parts,
    /// Samplers that it reads.
    pub samplers: BTreeSet<usize>,
    /// Maximum number of loop iterations, unless the program can be suspended.
    pub passes: u32,
}

impl PixelShader {
    /// Encodes the program for [`super::machine`], preceded by interpolation if given.
    ///
    /// # Errors
    /// [`ProgramError::TooLarge`].
    pub fn microcode(&self, interpolation: Option<&Interpolation>) -> Result<Microcode, ProgramError> {
        let formats = self.formats.own().len();
        if formats > MAX_PROGRAM_FORMATS {
            return Err(ProgramError::TooManyFormats { formats, most: MAX_PROGRAM_FORMATS });
        }
        let mut maker = Assembler {
            graph: &self.graph,
            formats: &self.formats,
            words: vec![0; HEADER],
            pool: BTreeMap::new(),
            next: 0,
            parts: Parts::default(),
            samplers: BTreeSet::new(),
            passes: 0,
        };
        maker.words[0] = HEADER as u32;
        maker.format(Arith::Main);
        maker.push(op::ZERO, 0);
        maker.words.extend([COLORS, DEPTH_IS_MAIN - COLORS + 1].map(u32::from));
        maker.emit(op::COPY, 0, DEPTH, [INPUT + POSITION_COMPONENT as u16 + 2; 3]);
        maker.program(&self.sinks);
        let mut counts: BTreeMap<usize, u32> = BTreeMap::new();
        for &sampler in &self.fetches {
            *counts.entry(sampler).or_default() += 1;
        }
        for (sampler, count) in counts {
            maker.push(op::FETCHED, (sampler as u32) << 16);
            maker.words.push(count);
        }
        maker.push(op::END, 0);
        let passes = maker.passes;
        maker.words[2] = maker.words.len() as u32;
        if let Some(interpolation) = interpolation {
            maker.interpolate(interpolation);
        }
        maker.push(op::ENTER, 0);
        maker.finish(passes)
    }
}

impl Assembler<'_> {
    fn finish(mut self, passes: u32) -> Result<Microcode, ProgramError> {
        let (slots, constants) = (self.next, self.pool.len());
        if slots > FIRST_CONSTANT || constants > usize::from(SETUP) - FIRST_CONSTANT {
            return Err(ProgramError::TooLarge { slots, constants });
        }
        self.words[1] = self.words.len() as u32;
        let mut pool = vec![0; constants];
        for (raw, i) in self.pool {
            pool[i] = raw;
        }
        self.words.extend(pool);
        self.parts.add_if(passes > MAX_PASSES, "HAS_SUSPENSION");
        let passes = if passes > MAX_PASSES { 0 } else { passes };
        Ok(Microcode { words: self.words, slots, parts: self.parts, samplers: self.samplers, passes })
    }
}
