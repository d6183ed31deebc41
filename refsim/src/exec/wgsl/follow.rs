//! Kernel for pixel traces: its text, its parameters, and its records.

use super::kernel::{DrawWords, with_entry};
use super::program::{Interpolation, TRACE_WORDS, machine, trace_delivered, trace_steps};
use super::texture;
use crate::device::Rules;
use crate::exec::lower::{Arith, Formats};
use crate::exec::{CheckedProgram, DepthValue, FragmentResult, Shading, inputs_read, program};
use crate::isa::Opcode;
use crate::num::Format;
use crate::output::FragmentFate;
use crate::raster::{COLOR_COMPONENT, ComponentMask, FOG_COMPONENT, FragmentInput, POSITION_COMPONENT};

/// Entry point; one invocation per pixel, in workgroups of one.
pub const ENTRY: &str = "follow_main";
/// Words of `tiles` per pixel: column, row, offset and length of its triangle list, column in the targets.
pub const JOB_WORDS: usize = 5;
/// Number of words of a record before its steps.
pub const HEAD: usize = RESULTS + 19;
/// Offsets in a record: interpolated components and depth; outputs of the program.
const INPUT: usize = 4;
const RESULTS: usize = INPUT + 45;
const NOTHING: u32 = 1;
/// Value of the first word of a record with a fragment.
pub const FRAGMENT: u32 = 2;
/// Value of the first word of a record whose dispatch must be repeated.
pub const UNFINISHED: u32 = 3;

/// The complete module: the kernel, the machine that runs programs, and texture reads.
pub fn module() -> String {
    text() + &machine() + &texture::library()
}

/// The kernel's complete text, without program and textures.
pub fn text() -> String {
    let names = [("NOTHING", NOTHING), ("FRAGMENT", FRAGMENT), ("UNFINISHED", UNFINISHED)];
    let places = [("HEAD", HEAD as u32), ("INPUT", INPUT as u32), ("RESULTS", RESULTS as u32)];
    let constants: String =
        names.iter().chain(&places).map(|(name, value)| format!("const FOLLOW_{name}: u32 = {value}u;\n")).collect();
    with_entry(&(constants + include_str!("follow.wgsl")))
}

/// Parameters of a dispatch.
#[derive(Clone, Copy, Debug)]
pub struct FollowDispatch {
    /// Number of pixels.
    pub jobs: usize,
    /// Register rows of the program in `scratch`; [`super::kernel::EXTRA_ROWS`] follow.
    pub registers: usize,
    /// `true` to resume the previous dispatch, which had the same parameters and exceeded its iteration limit.
    pub resumes: bool,
    /// Approximate limit of loop iterations per invocation.
    pub passes: u32,
    /// Offset of the records in `video`, in words.
    pub records: usize,
    /// Capacity of a record, in steps.
    pub room: usize,
    /// Number of leading steps that are not stored.
    pub skipped: usize,
}

impl FollowDispatch {
    /// Size of a record, in words.
    pub fn record_words(&self) -> usize {
        HEAD + TRACE_WORDS * self.room
    }
}

impl DrawWords {
    /// Encodes the words of `draw` for a pixel trace.
    pub fn follow(&mut self, dispatch: &FollowDispatch) -> &[u32] {
        let cost = self.cost();
        let resumes = u32::from(dispatch.resumes);
        self.set("D_TILES", &[dispatch.jobs as u32]);
        self.set("D_STRIDE", &[dispatch.jobs as u32]);
        self.set("D_ROWS", &[dispatch.registers as u32, resumes, dispatch.passes.max(cost + 10_000), cost, 3, 5]);
        let kept = [dispatch.record_words(), TRACE_WORDS * dispatch.room, TRACE_WORDS * dispatch.skipped];
        self.set("D_FOLLOW", &[dispatch.records, kept[0], kept[1], kept[2]].map(|word| word as u32));
        self.words()
    }
}

/// The kernel's record of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Record<'w> {
    words: &'w [u32],
}

impl<'w> Record<'w> {
    /// Wraps the words of a record, at least [`HEAD`].
    pub fn new(words: &'w [u32]) -> Option<Self> {
        (words.len() >= HEAD).then_some(Self { words })
    }

    /// Returns `true` if the dispatch must be repeated.
    pub fn is_unfinished(&self) -> bool {
        self.words[0] == UNFINISHED
    }

    /// Index, in the pixel's list, of the first triangle that covers the pixel; `None` if there is none.
    pub fn triangle(&self) -> Option<usize> {
        (self.words[0] == FRAGMENT).then_some(self.words[1] as usize)
    }

    /// Total number of steps, including those not stored.
    pub fn steps(&self) -> usize {
        self.words[3] as usize / TRACE_WORDS
    }

    /// Words of the stored steps; `skipped` as in the dispatch.
    pub fn kept(&self, skipped: usize) -> &'w [u32] {
        let words = &self.words[HEAD..];
        let count = self.steps().saturating_sub(skipped) * TRACE_WORDS;
        &words[..count.min(words.len())]
    }

    /// Decodes the execution of the fragment; `steps` are the words of all steps.
    pub fn shading(&self, steps: &[u32], checked: &CheckedProgram, rules: &Rules, lane: usize) -> Shading {
        Shading {
            input: self.input(inputs_read(program(checked))),
            delivered: trace_delivered(steps, checked, rules),
            steps: trace_steps(steps, checked, rules, lane),
            output: self.output(checked, rules),
            fate: match self.words[2] {
                1 => FragmentFate::KilledByShader,
                2 => FragmentFate::AlphaFailed,
                3 => FragmentFate::DepthFailed,
                _ => FragmentFate::Passed,
            },
        }
    }

    /// Decodes the interpolated components that the program reads.
    fn input(&self, read: ComponentMask) -> FragmentInput {
        let at = |component: usize| if read.has(component) { self.words[INPUT + component] } else { 0 };
        let position = read.has(Interpolation::RECIPROCAL);
        FragmentInput {
            t: std::array::from_fn(|set| std::array::from_fn(|c| at(4 * set + c))),
            v: std::array::from_fn(|color| std::array::from_fn(|c| at(COLOR_COMPONENT + 4 * color + c))),
            fog: at(FOG_COMPONENT),
            position: std::array::from_fn(|c| if position { self.words[INPUT + POSITION_COMPONENT + c] } else { 0 }),
            depth: self.words[INPUT + POSITION_COMPONENT + 2],
        }
    }

    fn output(&self, checked: &CheckedProgram, rules: &Rules) -> FragmentResult {
        let formats = Formats::pixel(program(checked), rules);
        let main = |raw| formats.encode(Arith::Main, raw);
        let words = &self.words[RESULTS..HEAD];
        let (killed, depth, is_main) = (words[16] != 0, words[17], words[18] != 0);
        // Only texm3x2depth writes depth in single precision, and always does.
        let single = program(checked).instructions.iter().any(|i| i.opcode == Opcode::TexM3x2Depth);
        FragmentResult {
            killed,
            colors: std::array::from_fn(|target| std::array::from_fn(|c| main(words[4 * target + c]))),
            depth: match (is_main, single) {
                (true, _) => Some(DepthValue { format: rules.format, bits: main(depth) }),
                (false, true) => Some(DepthValue { format: Format::FP32, bits: depth }),
                (false, false) => None,
            },
        }
    }
}
