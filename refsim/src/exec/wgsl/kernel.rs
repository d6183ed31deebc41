//! The pixel kernel: its text, and the encoding of draw parameters in words.

use super::number::{format_words, library};
use super::parts::Parts;
use super::program::{IN_OUT_ROWS, Interpolation, Microcode, PLANES};
use super::{INTERFACE, target};
use crate::device::{MAX_PROGRAM_FORMATS, Rules};
use crate::exec::FragmentFormats;
use crate::exec::lower::Formats;
use crate::isa::Program;
use crate::num::{Format, FormatKind, Overflow, ops};
use crate::output::{BlendEquation, BlendFactor, BlendOp, CompareFunction, DepthFormat, OutputRules, OutputState};
use crate::raster::{COMPONENTS, ComponentMask, TriangleSetup};
use crate::texture::TargetRounding;

const WIDE: &str = include_str!("wide.wgsl");
const RASTER: &str = include_str!("raster.wgsl");
const OUTPUT: &str = include_str!("output.wgsl");
const KERNEL: &str = include_str!("kernel.wgsl");

/// Set of all orders, for comparisons that always pass.
const ALL_ORDERS: u32 = 15;
/// Codes of float depth formats in `draw`.
const DEPTH_FLOAT32: u32 = 3;
const DEPTH_FLOAT24: u32 = 4;

/// Entry point; one workgroup per tile, one invocation per quad.
pub const ENTRY: &str = "pixel_main";
/// Invocations per workgroup.
pub const INVOCATIONS: usize = 64;
/// Words of `counts`: outcomes of fragments and reads per sampler, two words each; then [`UNFINISHED`] and [`CUT`].
pub const COUNT_WORDS: usize = 46;
/// Index in `counts` of the number of invocations with work left: unless it is 0, the dispatch must be repeated.
pub const UNFINISHED: usize = 44;
/// Index in `counts` of the number of invocations whose loops the driver ended: unless it is 0, results are invalid.
pub const CUT: usize = 45;
/// Rows of `scratch` after the program's registers: inputs, outputs, and saved state of an invocation.
pub const EXTRA_ROWS: usize = IN_OUT_ROWS + SAVED_ROWS;
const SAVED_ROWS: usize = 2;

/// Fields of `draw`, in order, and their sizes in words.
const FIELDS: [(&str, usize); 21] = [
    ("D_FORMATS", 8 * (11 + MAX_PROGRAM_FORMATS)),
    ("D_STRIDE", 1),
    ("D_SETUP_WORDS", 1),
    ("D_GROUPS", 1),
    ("D_TILES", 1),
    // Alpha test: the set of orders that pass, and the reference.
    ("D_ALPHA", 2),
    // Depth test: the set of orders that pass, and the write enable.
    ("D_DEPTH", 2),
    ("D_DEPTH_FORMAT", 1),
    ("D_DEPTH_SCALE", 1),
    ("D_DEPTH_BASE", 1),
    ("D_DEPTH_WIDTH", 1),
    ("D_DEPTH_NEAREST", 1),
    ("D_NEAREST", 1),
    // Blending: enable flag, equation of colours, equation of alpha.
    ("D_BLEND", 7),
    // First row of `scratch` after the program's registers; resume flag; limit of loop iterations per invocation; loop
    // iterations per triangle.
    ("D_ROWS", 1),
    ("D_RESUMES", 1),
    ("D_PASSES", 1),
    ("D_COST", 1),
    // Two numbers that are multiplied by repeated addition, to detect drivers that terminate loops.
    ("D_PROOF", 2),
    // Offset of records in `video`, words per record, number of step words stored.
    ("D_FOLLOW", 3),
    ("D_TARGETS", 4 * target::WORDS),
];

/// Size of `draw` in words.
pub const DRAW_WORDS: usize = field("");

/// Index in `draw` of the word that is 1 in a dispatch that resumes the previous one.
pub const RESUMES: usize = field("D_RESUMES");

/// Loop iterations for testing whether a triangle covers any pixel.
const LOOK_COST: u32 = 12;

/// Offset of a field; the total size for an unknown name.
const fn field(name: &str) -> usize {
    let (mut at, mut i) = (0, 0);
    while i < FIELDS.len() {
        if same(FIELDS[i].0, name) {
            return at;
        }
        at += FIELDS[i].1;
        i += 1;
    }
    at
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let (mut equal, mut i) = (a.len() == b.len(), 0);
    while equal && i < a.len() {
        equal = a[i] == b[i];
        i += 1;
    }
    equal
}

/// The kernel's complete text, without program and textures: `shade` is undefined.
pub fn text() -> String {
    with_entry(KERNEL)
}

/// The common parts of the kernel, with another entry point.
pub(super) fn with_entry(entry: &str) -> String {
    let fields = FIELDS.iter().map(|&(name, _)| (name, field(name)));
    let others = [
        ("TARGET_WORDS", target::WORDS),
        ("LOOK_COST", LOOK_COST as usize),
        ("IN_OUT_ROWS", IN_OUT_ROWS),
        ("SAVED_ROWS", SAVED_ROWS),
        ("COUNT_UNFINISHED", UNFINISHED),
        ("COUNT_CUT", CUT),
        ("DEPTH_FLOAT32", DEPTH_FLOAT32 as usize),
        ("DEPTH_FLOAT24", DEPTH_FLOAT24 as usize),
    ];
    let constants = fields.chain(others).map(|(name, value)| format!("const {name}: u32 = {value}u;\n"));
    let parts = [INTERFACE, &library(), WIDE, RASTER, OUTPUT, entry].join("\n");
    constants.collect::<String>() + &parts
}

/// A depth buffer in `video`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthPlace {
    /// The format.
    pub format: DepthFormat,
    /// Offset of the first word.
    pub base: u32,
    /// Row stride in words.
    pub width: u32,
}

/// State that is constant over a draw.
#[derive(Clone, Copy, Debug)]
pub struct DrawState<'a> {
    /// The pixel program.
    pub program: &'a Program,
    /// Arithmetic rules of the device.
    pub rules: &'a Rules,
    /// Tests, blending, masks.
    pub output: &'a OutputState,
    /// Rounding into targets.
    pub output_rules: &'a OutputRules,
    /// Components that the program reads.
    pub components: ComponentMask,
    /// Bit `i`: the program writes colour `i`.
    pub written: u8,
    /// The colour targets.
    pub targets: [Option<target::TargetPlace>; 4],
    /// The depth buffer.
    pub depth: Option<DepthPlace>,
}

/// Parameters of a dispatch.
#[derive(Clone, Copy, Debug)]
pub struct DrawDispatch {
    /// Number of tiles.
    pub tiles: usize,
    /// Workgroups per row.
    pub groups: usize,
    /// Register rows of the program in `scratch`; [`EXTRA_ROWS`] follow.
    pub registers: usize,
    /// `true` to resume the previous dispatch, which had the same parameters and exceeded its iteration limit.
    pub resumes: bool,
    /// Approximate limit of loop iterations per invocation. These are iterations of the shader, not of the program that
    /// it executes.
    pub passes: u32,
}

/// Encoded parameters of a draw, for the binding `draw`.
#[derive(Clone, Debug)]
pub struct DrawWords {
    words: Vec<u32>,
    interpolation: Interpolation,
    parts: Parts,
    /// Loop iterations of the program, per triangle.
    program_cost: u32,
}

impl DrawWords {
    /// Encodes the state of a draw.
    pub fn new(state: &DrawState<'_>) -> Self {
        let rules = state.rules;
        let components: Vec<usize> =
            (0..COMPONENTS).chain([Interpolation::RECIPROCAL]).filter(|&c| state.components.has(c)).collect();
        let interpolation = Interpolation { components, iterator: rules.iterator_format };
        let mut words = Self { words: vec![0; DRAW_WORDS], interpolation, parts: Parts::default(), program_cost: 0 };
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
        let own = Formats::pixel(state.program, rules);
        for (k, format) in formats.iter().chain(own.own()).enumerate() {
            words.put(8 * k, &format_words(format));
        }
        words.tests(state);
        words.blend(state);
        words.set("D_SETUP_WORDS", &[words.setup_words() as u32]);
        for (i, place) in state.targets.iter().enumerate() {
            if let (Some(place), 1) = (place, state.written >> i & 1) {
                let at = field("D_TARGETS") + i * target::WORDS;
                words.put(at, &target::words(place, state.output.masks[i]));
                words.target_parts(place, state.output.blend.is_some());
            }
        }
        words
    }

    /// The interpolated components.
    pub fn interpolation(&self) -> &Interpolation {
        &self.interpolation
    }

    /// Parts of the kernel that the draw and its program use.
    pub fn parts_with(&mut self, code: &Microcode) -> Parts {
        self.program_cost = code.passes;
        let mut parts = code.parts.clone();
        parts.extend(&self.parts);
        parts
    }

    fn target_parts(&mut self, place: &target::TargetPlace, blends: bool) {
        let [plain, blending] = match place.format.record().is_float() {
            true => ["HAS_FLOAT_TARGETS", "HAS_FLOAT_BLENDING"],
            false => ["HAS_INTEGER_TARGETS", "HAS_INTEGER_BLENDING"],
        };
        self.parts.add(plain);
        self.parts.add_if(blends, blending);
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
        let alpha = state.output.alpha.map_or([ALL_ORDERS, 0], |test| {
            let bits = ops::convert(&Format::FP32, main, test.reference).bits;
            [orders(test.function), raw(&main, bits)]
        });
        self.set("D_ALPHA", &alpha);
        // All orders pass: the kernel may contain the depth test because of another draw.
        self.set("D_DEPTH", &[ALL_ORDERS, 0]);
        self.parts.add_if(state.output.alpha.is_some(), "HAS_ALPHA_TEST");
        if let (Some(function), Some(place)) = (state.output.depth.test, state.depth) {
            let (code, scale) = match place.format {
                DepthFormat::Unorm16 => (0, 0xffff),
                DepthFormat::Unorm24 => (1, 0x00ff_ffff),
                DepthFormat::Unorm32 => (2, 0xffff_ffff),
                DepthFormat::Float32 => (DEPTH_FLOAT32, 0),
                DepthFormat::Float24 => (DEPTH_FLOAT24, 0),
            };
            self.parts.add("HAS_DEPTH_TEST");
            self.parts.add_if(matches!(place.format, DepthFormat::Float32 | DepthFormat::Float24), "HAS_FLOAT_DEPTH");
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

    pub(super) fn words(&self) -> &[u32] {
        &self.words
    }

    /// Words per set-up.
    pub fn setup_words(&self) -> usize {
        usize::from(PLANES) + 3 * self.interpolation.components.len()
    }

    /// Loop iterations per triangle and invocation, including the program's unless the program can be suspended.
    pub(super) fn cost(&self) -> u32 {
        let targets = (0..4).filter(|i| self.words[field("D_TARGETS") + i * target::WORDS] == 1).count();
        1500 + 110 * self.interpolation.components.len() as u32 + 1500 * targets as u32 + self.program_cost
    }

    /// Encodes the words of `draw` for a dispatch.
    pub fn dispatch(&mut self, dispatch: &DrawDispatch) -> &[u32] {
        self.set("D_TILES", &[dispatch.tiles as u32]);
        self.set("D_GROUPS", &[dispatch.groups as u32]);
        self.set("D_STRIDE", &[(dispatch.tiles * INVOCATIONS) as u32]);
        let cost = self.cost();
        let resumes = u32::from(dispatch.resumes);
        self.set("D_ROWS", &[dispatch.registers as u32, resumes, dispatch.passes.max(cost + 10_000), cost, 3, 5]);
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
        let constant = if setup.affine { setup.constant.with(Interpolation::RECIPROCAL) } else { setup.constant };
        let varies = !setup.depth_constant || self.interpolation.components.iter().any(|&c| !constant.has(c));
        let flags = u32::from(setup.affine)
            | u32::from(setup.depth_constant) << 1
            | u32::from(!varies) << 2
            | setup.half_pixels() << 3;
        let bounds = &setup.bounds;
        out.extend([setup.area_bits, bounds.x, bounds.y, bounds.width, bounds.height, flags]);
        out.extend(setup.reciprocal_w);
        out.extend([setup.depth.base, setup.depth.d1, setup.depth.d2].map(|x| raw(&Format::FP32, x)));
        out.extend([constant.0 as u32, (constant.0 >> 32) as u32]);
        for &component in &self.interpolation.components {
            let (plane, varying) = match setup.planes.get(component) {
                Some(plane) => (*plane, self.interpolation.iterator),
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

/// Set of orders for which a comparison passes: bit 0 less, 1 equal, 2 greater, 3 unordered.
fn orders(function: CompareFunction) -> u32 {
    function as u32 | u32::from(function.holds(None)) << 3
}

/// Converts a pattern of a format to the shaders' representation: a sign-extended integer, or the single-precision
/// pattern of the same number with canonical NaN; for units of cards, the word itself.
pub fn raw(format: &Format, bits: u32) -> u32 {
    match format.kind {
        FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => {
            let spare = 32 - format.width();
            ((bits << spare).cast_signed() >> spare).cast_unsigned()
        }
        FormatKind::Float { .. } if format.unit.is_card() => bits,
        FormatKind::Float { .. } => ops::convert(format, Format::FP32, bits).bits,
    }
}
