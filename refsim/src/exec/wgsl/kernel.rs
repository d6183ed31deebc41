//! The pixel kernel: its text, and what a draw tells it in words.

use super::number::{format_words, source_word};
use super::{INTERFACE, target};
use crate::device::Rules;
use crate::exec::FragmentFormats;
use crate::num::{Format, FormatKind, NumberOperation, Overflow, ops};
use crate::output::{BlendEquation, BlendFactor, BlendOp, CompareFunction, DepthFormat, OutputRules, OutputState};
use crate::raster::{COMPONENTS, ComponentMask, POSITION_COMPONENT, TriangleSetup};
use crate::texture::TargetRounding;

const WIDE: &str = include_str!("wide.wgsl");
const RASTER: &str = include_str!("raster.wgsl");
const OUTPUT: &str = include_str!("output.wgsl");
const KERNEL: &str = include_str!("kernel.wgsl");

/// The kernel's entry point: a workgroup a tile, an invocation a quad.
pub const ENTRY: &str = "pixel_main";
/// Invocations of a workgroup.
pub const INVOCATIONS: usize = 64;
/// Words of `counts`: the fates of fragments and the reads of each sampler, two words each; then [`UNFINISHED`], [`CUT`] and
/// [`OVERRUN`].
pub const COUNT_WORDS: usize = 47;
/// The word of `counts` that says how many invocations have work left: the dispatch must be made again.
pub const UNFINISHED: usize = 44;
/// The word of `counts` that says how many invocations had their loops ended by the driver: what they drew is wrong.
pub const CUT: usize = 45;
/// The word of `counts` that says how many quads had a fragment that ran out of its step budget.
pub const OVERRUN: usize = 46;
/// Rows of `scratch` after the program's registers in which an invocation puts down how far it came.
pub const SAVED_ROWS: usize = 23;
/// The comparison of [`DrawWords`] that stands for no depth test.
const NO_TEST: u32 = 16;

/// Where things lie in `draw`: after eleven formats of eight words.
const FIELDS: [(&str, usize); 26] = [
    ("D_STRIDE", 88),
    ("D_SETUP_WORDS", 89),
    ("D_GROUPS", 90),
    ("D_TILES", 91),
    // Set of orders, reference.
    ("D_ALPHA", 92),
    // Set of orders, whether it writes.
    ("D_DEPTH", 94),
    ("D_DEPTH_FORMAT", 96),
    ("D_DEPTH_SCALE", 97),
    ("D_DEPTH_BASE", 98),
    ("D_DEPTH_WIDTH", 99),
    ("D_DEPTH_NEAREST", 100),
    ("D_NEAREST", 101),
    // Whether it is on, the equation of colours, that of alpha.
    ("D_BLEND", 102),
    ("D_CONVERTS", 110),
    // How many conversions of weights, of values, and the format that those come from.
    ("D_CONVERTS_BACK", 111),
    // Steps of interpolation.
    ("D_STEPS", 113),
    // Row of `scratch`, whether this goes on with a dispatch, loop passes of an invocation, of a triangle.
    ("D_SAVE", 144),
    ("D_RESUMES", 145),
    ("D_PASSES", 146),
    ("D_COST", 147),
    // Two numbers to multiply by adding.
    ("D_PROOF", 148),
    // How many, then their numbers.
    ("D_COMPONENTS", 150),
    ("D_TARGETS", 193),
    // Where records begin in `video`, words of each, how many words of steps are kept, and from which on.
    ("D_FOLLOW", 193 + 4 * target::WORDS),
    // Whether steps are counted, and how many a fragment may make.
    ("D_STEP_BUDGET", 197 + 4 * target::WORDS),
    ("D_END", DRAW_WORDS),
];

/// Words of `draw` that the kernel reads.
pub const DRAW_WORDS: usize = 199 + 4 * target::WORDS;

/// The component of the window position that a set-up has a plane for; the others are known without.
const RECIPROCAL: usize = POSITION_COMPONENT + 3;

/// Loop passes of finding out whether a triangle covers anything.
const LOOK_COST: u32 = 12;

fn field(name: &str) -> usize {
    FIELDS.iter().find(|f| f.0 == name).map_or(0, |f| f.1)
}

/// Steps of interpolation: operation, result, operands, format (main text: `raster.wgsl`).
const ADD: u32 = NumberOperation::Add.word();
const SUB: u32 = NumberOperation::Sub.word();
const MUL: u32 = NumberOperation::Mul.word();
const DIV: u32 = NumberOperation::Div.word();
const CONVERT: u32 = NumberOperation::Convert.word();
const SINGLE: u32 = 2;
const ITERATOR: u32 = 4;

const LINEAR: [[u32; 5]; 2] = [[DIV, 0, 0, 9, SINGLE], [DIV, 1, 1, 9, SINGLE]];
const PERSPECTIVE: [[u32; 5]; 9] = [
    [SUB, 14, 10, 0, SINGLE],
    [SUB, 14, 14, 1, SINGLE],
    [MUL, 14, 14, 11, SINGLE],
    [MUL, 2, 0, 12, SINGLE],
    [MUL, 3, 1, 13, SINGLE],
    [ADD, 14, 14, 2, SINGLE],
    [ADD, 14, 14, 3, SINGLE],
    [DIV, 2, 2, 14, SINGLE],
    [DIV, 3, 3, 14, SINGLE],
];
const WEIGHTS: [[u32; 5]; 2] = [[CONVERT, 4, 2, 11, ITERATOR], [CONVERT, 5, 3, 11, ITERATOR]];
const STEPS_DEPTH: usize = 13;
const STEPS_COMPONENT: usize = 17;

/// `(base + l1 * d1) + l2 * d2` with the weights in two registers.
const fn along(l1: u32, l2: u32, format: u32) -> [[u32; 5]; 4] {
    [[MUL, 14, l1, 7, format], [ADD, 14, 6, 14, format], [MUL, 15, l2, 8, format], [ADD, 14, 14, 15, format]]
}

/// The text of the kernel with the arithmetic of `library`, without program and textures: `shade` is missing.
pub fn text(library: &str) -> String {
    with_entry(library, KERNEL)
}

/// The parts of the kernel around another way to walk through the triangles.
pub(super) fn with_entry(library: &str, entry: &str) -> String {
    let mut out = String::new();
    for (name, at) in FIELDS {
        out += &format!("const {name}: u32 = {at}u;\n");
    }
    let steps = [
        ("STEPS_LINEAR", LINEAR.len() as u32),
        ("STEPS_PERSPECTIVE", PERSPECTIVE.len() as u32),
        ("STEPS_DEPTH", STEPS_DEPTH as u32),
        ("STEPS_COMPONENT", STEPS_COMPONENT as u32),
        ("TARGET_WORDS", target::WORDS as u32),
        ("LOOK_COST", LOOK_COST),
        ("SAVED_ROWS", SAVED_ROWS as u32),
        ("COUNT_UNFINISHED", UNFINISHED as u32),
        ("COUNT_CUT", CUT as u32),
        ("COUNT_OVERRUN", OVERRUN as u32),
        ("NO_TEST", NO_TEST),
    ];
    for (name, value) in steps {
        out += &format!("const {name}: u32 = {value}u;\n");
    }
    for part in [INTERFACE, library, WIDE, RASTER, OUTPUT, entry] {
        out += part;
        out.push('\n');
    }
    out
}

/// A depth buffer within `video`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthPlace {
    /// The format.
    pub format: DepthFormat,
    /// The first word.
    pub base: u32,
    /// Words from one row to the next.
    pub width: u32,
}

/// What stays the same over a draw.
#[derive(Clone, Copy, Debug)]
pub struct DrawState<'a> {
    /// How the device computes.
    pub rules: &'a Rules,
    /// Tests, blending, masks.
    pub output: &'a OutputState,
    /// Roundings into targets.
    pub output_rules: &'a OutputRules,
    /// Components that the program reads.
    pub components: ComponentMask,
    /// Bit `i`: the program writes colour `i`.
    pub written: u8,
    /// The colour targets.
    pub targets: [Option<target::TargetPlace>; 4],
    /// The depth buffer.
    pub depth: Option<DepthPlace>,
    /// Steps that a fragment may make, if the program may make more.
    pub step_budget: Option<u32>,
}

/// One dispatch of the kernel.
#[derive(Clone, Copy, Debug)]
pub struct Dispatch {
    /// Tiles.
    pub tiles: usize,
    /// Workgroups in a row.
    pub groups: usize,
    /// Rows of `scratch` that the program's registers take; [`SAVED_ROWS`] follow.
    pub registers: usize,
    /// Whether it goes on where the one before, which was the same, ran out of its passes.
    pub resumes: bool,
    /// Loop passes of an invocation, about: not those of the program, those of the shader that runs it.
    pub passes: u32,
}

/// The words of `draw` for a draw.
#[derive(Clone, Debug)]
pub struct DrawWords {
    words: Vec<u32>,
    components: Vec<usize>,
    iterator: Format,
}

impl DrawWords {
    /// Of a draw.
    pub fn new(state: &DrawState<'_>) -> Self {
        let rules = state.rules;
        let components: Vec<usize> = (0..COMPONENTS).chain([RECIPROCAL]).filter(|&c| state.components.has(c)).collect();
        let mut words = Self { words: vec![0; DRAW_WORDS], components, iterator: rules.iterator_format };
        let main = rules.format;
        let fragment = FragmentFormats::new(rules);
        let formats = [
            main,
            rules.partial.unwrap_or(main),
            Format::FP32,
            main.with_overflow(Overflow::Wrap),
            rules.iterator_format,
            Format::FP16,
            Format::FP24,
            Format::FP32,
            rules.vertex_format,
            fragment.half,
            fragment.fixed,
        ];
        for (k, format) in formats.iter().enumerate() {
            words.put(8 * k, &format_words(format));
        }
        if let Some(budget) = state.step_budget {
            words.set("D_STEP_BUDGET", &[1, budget]);
        }
        words.tests(state);
        words.blend(state);
        words.steps();
        let list: Vec<u32> = words.components.iter().map(|&c| c as u32).collect();
        words.set("D_SETUP_WORDS", &[words.setup_words() as u32]);
        words.set("D_COMPONENTS", &[list.len() as u32]);
        words.put(field("D_COMPONENTS") + 1, &list);
        for (i, place) in state.targets.iter().enumerate() {
            if let (Some(place), 1) = (place, state.written >> i & 1) {
                let at = field("D_TARGETS") + i * target::WORDS;
                words.put(at, &target::words(place, state.output.masks[i]));
            }
        }
        words
    }

    fn put(&mut self, at: usize, values: &[u32]) {
        if let Some(slots) = self.words.get_mut(at..at + values.len()) {
            slots.copy_from_slice(values);
        }
    }

    pub(super) fn set(&mut self, name: &str, values: &[u32]) {
        self.put(field(name), values);
    }

    fn tests(&mut self, state: &DrawState<'_>) {
        let main = state.rules.format;
        let alpha = state.output.alpha.map_or([15, 0], |test| {
            let bits = ops::convert(&Format::FP32, main, test.reference).bits;
            [orders(test.function), raw(&main, bits)]
        });
        self.set("D_ALPHA", &alpha);
        self.set("D_DEPTH", &[NO_TEST, 0]);
        if let (Some(function), Some(place)) = (state.output.depth.test, state.depth) {
            let (code, scale) = match place.format {
                DepthFormat::Unorm16 => (0, 0xffff),
                DepthFormat::Unorm24 => (1, 0x00ff_ffff),
                DepthFormat::Unorm32 => (2, 0xffff_ffff),
                DepthFormat::Float32 => (3, 0),
                DepthFormat::Float24 => (4, 0),
            };
            self.set("D_DEPTH", &[orders(function), u32::from(state.output.depth.write)]);
            self.set("D_DEPTH_FORMAT", &[code, scale, place.base, place.width]);
        }
        let nearest = |rounding| u32::from(rounding == TargetRounding::Nearest);
        self.set("D_DEPTH_NEAREST", &[nearest(state.output_rules.depth_rounding)]);
        self.set("D_NEAREST", &[nearest(state.output_rules.target_rounding)]);
    }

    fn blend(&mut self, state: &DrawState<'_>) {
        if let Some(blend) = &state.output.blend {
            let mut words = vec![1];
            words.extend(equation(&blend.color));
            words.extend(equation(&blend.alpha));
            self.set("D_BLEND", &words);
        }
    }

    fn steps(&mut self) {
        let single = self.iterator == Format::FP32;
        let format = if single { SINGLE } else { ITERATOR };
        let mut list = Vec::new();
        list.extend(LINEAR);
        list.extend(PERSPECTIVE);
        list.extend(WEIGHTS);
        list.extend(along(0, 1, SINGLE));
        list.extend(along(4, 5, format));
        list.push([CONVERT, 14, 14, 12, SINGLE]);
        let packed: Vec<u32> = list.iter().map(|[op, r, a, b, k]| op | r << 8 | a << 12 | b << 16 | k << 20).collect();
        self.set("D_STEPS", &packed);
        let [weights, back] = if single { [0, 0] } else { [2, 1] };
        self.set("D_CONVERTS", &[weights, back, source_word(&self.iterator)]);
    }

    pub(super) fn words(&self) -> &[u32] {
        &self.words
    }

    /// Words of one set-up.
    pub fn setup_words(&self) -> usize {
        35 + 3 * self.components.len()
    }

    /// Loop passes that a triangle costs an invocation, but for its program.
    pub(super) fn cost(&self) -> u32 {
        let targets = (0..4).filter(|i| self.words[field("D_TARGETS") + i * target::WORDS] == 1).count();
        1500 + 110 * self.components.len() as u32 + 1500 * targets as u32
    }

    /// The words of `draw` for one dispatch.
    pub fn dispatch(&mut self, dispatch: &Dispatch) -> &[u32] {
        self.set("D_TILES", &[dispatch.tiles as u32]);
        self.set("D_GROUPS", &[dispatch.groups as u32]);
        self.set("D_STRIDE", &[(dispatch.tiles * INVOCATIONS) as u32]);
        let cost = self.cost();
        let resumes = u32::from(dispatch.resumes);
        self.set("D_SAVE", &[dispatch.registers as u32, resumes, dispatch.passes.max(cost + 10_000), cost, 3, 5]);
        &self.words
    }

    /// Appends the words of a set-up.
    pub fn setup(&self, setup: &TriangleSetup, out: &mut Vec<u32>) {
        let pair = |value: i64| {
            let bits = value.cast_unsigned();
            [bits as u32, (bits >> 32) as u32]
        };
        for edge in &setup.edges {
            out.extend([edge.a, edge.b, edge.c].map(pair).as_flattened());
            out.push(edge.bias as u32);
        }
        let constant = if setup.affine { setup.constant.with(RECIPROCAL) } else { setup.constant };
        let varies = !setup.depth_constant || self.components.iter().any(|&c| !constant.has(c));
        let flags = u32::from(setup.affine)
            | u32::from(setup.depth_constant) << 1
            | u32::from(!varies) << 2
            | setup.half_pixels() << 3;
        let bounds = &setup.bounds;
        out.extend([setup.area_bits, bounds.x, bounds.y, bounds.width, bounds.height, flags]);
        out.extend(setup.reciprocal_w);
        out.extend([setup.depth.base, setup.depth.d1, setup.depth.d2].map(|x| raw(&Format::FP32, x)));
        out.extend([constant.0 as u32, (constant.0 >> 32) as u32]);
        for &component in &self.components {
            let (plane, varying) = match setup.planes.get(component) {
                Some(plane) => (*plane, self.iterator),
                None => (setup.reciprocal_w_plane(), Format::FP32),
            };
            let format = if constant.has(component) { Format::FP32 } else { varying };
            out.extend([raw(&format, plane.base), raw(&varying, plane.d1), raw(&varying, plane.d2)]);
        }
    }
}

fn equation(equation: &BlendEquation) -> [u32; 3] {
    let factor = |f| BlendFactor::ALL.iter().position(|&g| g == f).unwrap_or(0) as u32;
    let op = match equation.op {
        BlendOp::Add => 0,
        BlendOp::Subtract => 1,
        BlendOp::ReverseSubtract => 2,
        BlendOp::Min => 3,
        BlendOp::Max => 4,
    };
    [factor(equation.source), factor(equation.destination), op]
}

/// The orders for which a comparison holds: bit 0 below, 1 equal, 2 above, 3 unordered.
fn orders(function: CompareFunction) -> u32 {
    use std::cmp::Ordering::{Equal, Greater, Less};
    let cases = [Some(Less), Some(Equal), Some(Greater), None];
    cases.into_iter().zip(0..).fold(0, |set, (order, bit)| set | u32::from(function.holds(order)) << bit)
}

/// A pattern of a format as the shaders hold it: a sign-extended integer, or the single precision pattern of the same
/// number with the one NaN.
pub fn raw(format: &Format, bits: u32) -> u32 {
    match format.kind {
        FormatKind::Fixed { .. } => {
            let spare = 32 - format.width();
            ((bits << spare).cast_signed() >> spare).cast_unsigned()
        }
        FormatKind::Float { .. } => ops::convert(format, Format::FP32, bits).bits,
    }
}
