//! Programs on an adapter compared with the scalar executor, bit for bit: `shade()` alone, on random inputs.

use crate::cases::{self, FORMATS, PIXEL, ideal};
use crate::environment::seeds;
use crate::modules;
use crate::random::Random;
use refsim::device::{Profile, Rules};
use refsim::exec::gpu::{Access, Buffer, Gpu, GpuError, Pipeline};
use refsim::exec::scalar::PixelProgram;
use refsim::exec::wgsl::number::format_words;
use refsim::exec::wgsl::program::{self, PixelShader};
use refsim::exec::wgsl::texture::{image_words, sampler_words};
use refsim::exec::{CheckedProgram, Constants, NoObserver, PixelBindings, SamplerBinding, Step, Trace, sample_rules};
use refsim::isa::{RegisterFile, Version};
use refsim::num::{Flags, Format, Overflow, ops};
use refsim::raster::FragmentInput;
use refsim::texture::{AddressMode, Filter, Image, MipFilter, SamplerState, TexelFormat, TextureKind};
use std::sync::Arc;

/// Quads per run: a workgroup.
const QUADS: usize = 64;
/// Words of a quad's inputs and of its results.
const INPUT_WORDS: usize = 41 * 4 + 2;
const RESULT_WORDS: usize = 64 + 4 + 4 + 4 + 16;
/// Rows of `scratch` for inputs, outputs, and the trace.
const MORE_ROWS: usize = 66 + 4;

fn done<T>(result: Result<T, GpuError>) -> T {
    result.unwrap_or_else(|e| panic!("{e}"))
}

/// The formats table of a draw.
pub(crate) fn formats(rules: &Rules) -> Vec<u32> {
    let main = rules.format;
    let all =
        [main, rules.partial.unwrap_or(main), Format::FP32, main.with_overflow(Overflow::Wrap), rules.iterator_format];
    all.iter().flat_map(format_words).collect()
}

/// A single precision pattern with NaN canonical.
fn clean(bits: u32) -> u32 {
    ops::convert(&Format::FP32, Format::FP32, bits).bits
}

/// Inputs of a test program, and the expected results of each lane.
struct Quads {
    inputs: Vec<[FragmentInput; 4]>,
    covered: Vec<u8>,
}

impl Quads {
    fn random(r: &mut Random) -> Self {
        let mut inputs = Vec::with_capacity(QUADS);
        let mut covered = Vec::with_capacity(QUADS);
        for quad in 0..QUADS {
            r.tame = quad % 3 != 0;
            let base: Vec<u32> = (0..41).map(|_| clean(r.number())).collect();
            // Some components are uniform over the quad.
            let same = r.next();
            inputs.push([0; 4].map(|_: u32| {
                let mut input = FragmentInput::default();
                let mut value = |i: usize| if same >> i & 1 == 1 { base[i] } else { clean(r.number()) };
                for i in 0..32 {
                    input.t[i / 4][i % 4] = value(i);
                }
                for i in 32..40 {
                    input.v[(i - 32) / 4][i % 4] = value(i);
                }
                input
            }));
            covered.push(1 + r.below(15) as u8);
        }
        Self { inputs, covered }
    }

    fn words(&self) -> Vec<u32> {
        let mut out = Vec::with_capacity(QUADS * INPUT_WORDS);
        for (inputs, &covered) in self.inputs.iter().zip(&self.covered) {
            for i in 0..41 {
                out.extend(inputs.iter().map(|input| match i {
                    40 => input.fog,
                    32.. => input.v[(i - 32) / 4][i % 4],
                    _ => input.t[i / 4][i % 4],
                }));
            }
            out.extend([15, covered.into()]);
        }
        out
    }
}

/// Results of the scalar executor in the order of `runs.wgsl`; depth as raw words.
fn expected(checked: &CheckedProgram, rules: &Rules, bindings: &PixelBindings<'_>, quads: &Quads) -> Vec<u32> {
    let scalar = PixelProgram::new(checked, rules, bindings);
    let raw = |format: Format, bits: u32| {
        // Raw values: sign-extended integers, or single precision patterns.
        if format.is_fixed() {
            let spare = 32 - format.width();
            ((bits << spare).cast_signed() >> spare).cast_unsigned()
        } else {
            ops::convert(&format, Format::FP32, bits).bits
        }
    };
    let mut out = Vec::new();
    for (inputs, &covered) in quads.inputs.iter().zip(&quads.covered) {
        let mut fetches = [0; 16];
        let results = scalar.run(inputs, covered, &mut fetches, &mut NoObserver).0;
        for target in 0..4 {
            for c in 0..4 {
                out.extend(results.iter().map(|result| raw(rules.format, result.colors[target][c])));
            }
        }
        out.extend(results.iter().map(|result| u32::from(result.killed)));
        out.extend(results.iter().map(|result| result.depth.map_or(0, |d| raw(d.format, d.bits))));
        // In single precision both representations are the same.
        let is_main = |f: Format| rules.format != Format::FP32 && f == rules.format;
        out.extend(results.iter().map(|result| u32::from(result.depth.is_some_and(|d| is_main(d.format)))));
        out.extend(fetches.map(|f| f as u32));
    }
    out
}

pub(crate) struct Runner {
    gpu: Arc<Gpu>,
    pipeline: Pipeline,
}

impl Runner {
    /// Compiles a module of [`modules`].
    pub(crate) fn new(gpu: &Arc<Gpu>, module: &str) -> Self {
        let access = [4, 6, 7].iter().fold(vec![Access::Read; 8], |mut all, &i| {
            all[i] = Access::ReadWrite;
            all
        });
        let pipeline = gpu.pipeline(module, modules::ENTRY, &access).unwrap_or_else(|e| panic!("{e}"));
        Self { gpu: Arc::clone(gpu), pipeline }
    }

    fn run(&self, rules: &Rules, inputs: &[u32], code: &[u32], slots: usize, trace: u32) -> (Vec<u32>, Vec<u32>) {
        self.run_with(rules, inputs, code, slots, trace, (&[0], &[]))
    }

    /// Runs with the given sampler words and additional words after the results in `video`.
    fn run_with(
        &self,
        rules: &Rules,
        inputs: &[u32],
        code: &[u32],
        slots: usize,
        trace: u32,
        (samplers, texels): (&[u32], &[u32]),
    ) -> (Vec<u32>, Vec<u32>) {
        let of = |words: &[u32]| done(self.gpu.buffer_of(words));
        let mut draw = formats(rules);
        draw.extend([trace, slots as u32]);
        let zeros = |words: usize| done(self.gpu.buffer(words));
        let mut video = vec![0; QUADS * RESULT_WORDS];
        video.extend_from_slice(texels);
        let (results, traced) = (of(&video), zeros(1 << 16));
        let buffers = [
            of(&draw),
            of(inputs),
            of(&[0]),
            of(samplers),
            results,
            of(code),
            zeros((slots + MORE_ROWS) * QUADS * 4),
            traced,
        ];
        let all: Vec<&Buffer> = buffers.iter().collect();
        done(self.gpu.dispatch(&self.pipeline, &all, [1, 1, 1]));
        let results = done(self.gpu.read(&buffers[4], 0..QUADS * RESULT_WORDS));
        (results, done(self.gpu.read(&buffers[7], 0..1 << 16)))
    }
}

fn random_constants(r: &mut Random, count: usize) -> Constants {
    let float = (0..count).map(|_| [0; 4].map(|_: u32| clean(r.number()))).collect();
    let mut small = |bound: usize| i32::try_from(r.below(bound)).unwrap_or_default();
    let int = (0..4).map(|_| [small(4), small(3), 1, 0]).collect();
    Constants { float, int, boolean: (0..4).map(|_| r.one_in(2)).collect(), ..Constants::default() }
}

/// Describes the first word that differs.
fn difference(found: &[u32], wanted: &[u32]) -> Option<String> {
    let at = found.iter().zip(wanted).position(|(f, w)| f != w)?;
    let (quad, word) = (at / RESULT_WORDS, at % RESULT_WORDS);
    let what = match word {
        0..64 => format!("oC{}.{} lane {}", word / 16, word / 4 % 4, word % 4),
        64..68 => format!("killed lane {}", word - 64),
        68..72 => format!("depth lane {}", word - 68),
        72..76 => format!("kind of depth lane {}", word - 72),
        _ => format!("reads of sampler {}", word - 76),
    };
    Some(format!("quad {quad}, {what}: found {:#010x}, expected {:#010x}", found[at], wanted[at]))
}

fn random_case(seed: u64, size: usize) -> (Profile, String, CheckedProgram, Random) {
    let mut r = Random::new(seed);
    let version: Version = PIXEL[seed as usize % PIXEL.len()];
    let profile = ideal(FORMATS[(seed as usize / PIXEL.len()) % FORMATS.len()]);
    let (text, program) = cases::random(version, size, &profile, &mut r);
    (profile, text, program, r)
}

/// Results with masks as ones, and in single precision without the kind of depth, which is ambiguous there.
fn comparable(mut words: Vec<u32>, rules: &Rules) -> Vec<u32> {
    for quad in words.chunks_mut(RESULT_WORDS) {
        quad[64..68].iter_mut().for_each(|mask| *mask = u32::from(*mask != 0));
        quad[72..76].iter_mut().for_each(|mask| *mask = u32::from(*mask != 0 && rules.format != Format::FP32));
    }
    words
}

pub(crate) fn the_machine_runs_random_programs(gpu: &Arc<Gpu>) {
    let runner = Runner::new(gpu, &modules::pixel());
    for seed in seeds(140, 30) {
        let (profile, text, checked, mut r) = random_case(seed, 2);
        let constants = random_constants(&mut r, 32);
        let bindings = PixelBindings::new(&constants);
        let shader = PixelShader::new(&checked, &profile.rules, &bindings, false);
        let code = shader.microcode(None).unwrap_or_else(|e| panic!("{e}"));
        let quads = Quads::random(&mut r);
        let wanted = expected(&checked, &profile.rules, &bindings, &quads);
        let (found, _) = runner.run(&profile.rules, &quads.words(), &code.words, code.slots, 0);
        if let Some(difference) = difference(&comparable(found, &profile.rules), &wanted) {
            panic!("seed {seed}, {}:\n{text}\n{difference}", profile.name);
        }
    }
}

pub(crate) fn the_machine_tells_what_instructions_write(gpu: &Arc<Gpu>) {
    let runner = Runner::new(gpu, &modules::followed());
    let mut told = 0;
    for seed in seeds(70, 30) {
        let (profile, text, checked, mut r) = random_case(seed ^ 0x7ace, 2);
        let constants = random_constants(&mut r, 32);
        let bindings = PixelBindings::new(&constants);
        let shader = PixelShader::new(&checked, &profile.rules, &bindings, true);
        let code = shader.microcode(None).unwrap_or_else(|e| panic!("{e}"));
        let quads = Quads::random(&mut r);
        let lane = r.below(4);
        let (_, words) = runner.run(&profile.rules, &quads.words(), &code.words, code.slots, lane as u32 + 1);
        let count = words[0] as usize;
        let found = program::trace_steps(&words[1..=count], &checked, &profile.rules, lane);
        let mut trace = Trace::of_lane(lane);
        let scalar = PixelProgram::new(&checked, &profile.rules, &bindings);
        scalar.run(&quads.inputs[0], quads.covered[0], &mut [0; 16], &mut trace);
        let wanted: Vec<_> = trace.steps.into_iter().map(|step| written(step, &checked, &profile.rules)).collect();
        for (found, wanted) in found.iter().zip(&wanted) {
            assert_eq!(found, wanted, "seed {seed}, {}:\n{text}", profile.name);
        }
        assert_eq!(found.len(), wanted.len(), "seed {seed}, {}:\n{text}", profile.name);
        told += found.len();
    }
    assert!(told > 0);
}

/// A step of the scalar executor without what other executors lack: flags, NaN payloads, unwritten components.
fn written(mut step: Step, checked: &CheckedProgram, rules: &Rules) -> Step {
    let destination = checked.instructions[step.instruction].destination;
    let file = destination.map(|d| d.register.file);
    if file == Some(RegisterFile::DepthOut) {
        step.mask.0 &= step.mask.0.wrapping_neg();
    }
    step.flags = Flags::empty();
    for (c, value) in step.value.iter_mut().enumerate() {
        if !step.mask.contains(c) {
            *value = 0;
        } else if file != Some(RegisterFile::Predicate) {
            *value = ops::convert(&rules.format, rules.format, *value).bits;
        }
    }
    step
}

/// A small random texture with all levels, and random filters.
fn random_texture(kind: TextureKind, r: &mut Random) -> (Image, SamplerState) {
    let extents = if kind == TextureKind::Volume { [5, 3, 2] } else { [8, 8, 1] };
    let levels = if kind == TextureKind::Volume { 3 } else { 4 };
    let format = r.of(&[TexelFormat::ALL[0], TexelFormat::ALL[1], TexelFormat::ALL[2], TexelFormat::ALL[3]]);
    let mut image = Image::new(format, kind, extents, levels).unwrap_or_else(|e| panic!("{e}"));
    image.bytes_mut().fill_with(|| r.next() as u8);
    let filter = [Filter::Nearest, Filter::Linear];
    let mode = [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border];
    let state = SamplerState {
        min: r.of(&filter),
        mag: r.of(&filter),
        mip: r.of(&[MipFilter::None, MipFilter::Nearest, MipFilter::Linear]),
        address_u: r.of(&mode),
        address_v: r.of(&mode),
        ..SamplerState::NEAREST_CLAMP
    };
    (image, state)
}

pub(crate) fn the_machine_reads_textures(gpu: &Arc<Gpu>) {
    let runner = Runner::new(gpu, &modules::textured());
    let mut reads = 0;
    for seed in seeds(70, 30) {
        let (profile, text, checked, mut r) = random_case(seed ^ 0x7e71, 2);
        let kinds = [TextureKind::D2, TextureKind::Cube, TextureKind::D2, TextureKind::Volume];
        let textures = kinds.map(|kind| random_texture(kind, &mut r));
        let constants = random_constants(&mut r, 32);
        let mut bindings = PixelBindings::new(&constants);
        for (sampler, (image, state)) in bindings.samplers.iter_mut().zip(&textures) {
            *sampler = Some(SamplerBinding { image, state: *state });
        }
        let rules = sample_rules(&profile.rules);
        let (mut samplers, mut texels) = (Vec::new(), Vec::new());
        for binding in &bindings.samplers {
            let first = QUADS * RESULT_WORDS + texels.len();
            samplers.extend(sampler_words(binding.as_ref(), &rules, first as u32));
            texels.extend(binding.iter().flat_map(|b| image_words(b.image)));
        }
        let shader = PixelShader::new(&checked, &profile.rules, &bindings, false);
        let code = shader.microcode(None).unwrap_or_else(|e| panic!("{e}"));
        let quads = Quads::random(&mut r);
        let wanted = expected(&checked, &profile.rules, &bindings, &quads);
        let words = quads.words();
        let (found, _) = runner.run_with(&profile.rules, &words, &code.words, code.slots, 0, (&samplers, &texels));
        if let Some(difference) = difference(&comparable(found, &profile.rules), &wanted) {
            panic!("seed {seed}, {}:\n{text}\n{difference}", profile.name);
        }
        reads += wanted.chunks(RESULT_WORDS).map(|quad| quad[76..92].iter().sum::<u32>()).sum::<u32>();
    }
    assert!(reads > 0, "some programs read textures");
}
