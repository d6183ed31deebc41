//! Coverage of the random cases: every feature of programs, devices and scenes occurs among the suites' seeds.

use crate::generate::{self, Layout};
use crate::random::Random;
use crate::rules;
use crate::scene::{Case, build};
use crate::shapes::PRIMITIVES;
use crate::suite::{self, Kind};
use refsim::asm;
use refsim::device::Profile;
use refsim::isa::{
    Comparison, ConditionTest, FogMode, Instruction, MatrixForm, Modifier, Opcode, ParameterSource, Precision, Program,
    RegisterFile, Relative, Source, Stage, StateBinding, TextureTarget, Usage, Version,
};
use refsim::output::{BlendFactor, BlendOp, CompareFunction, DepthFormat};
use refsim::raster::{ClipSpace, Cull, PixelCenter};
use refsim::texture::{AddressMode, Filter, MipFilter, TexelFormat, TextureKind};
use std::collections::BTreeSet;
use std::fmt::Debug;
use std::ops::Range;

/// The features seen so far, as text.
#[derive(Default)]
struct SeenFeatures(BTreeSet<String>);

impl SeenFeatures {
    fn add(&mut self, what: &str, value: impl Debug) {
        self.0.insert(format!("{what} {value:?}"));
    }

    /// Panics with all `wanted` features that were not seen.
    fn require(&self, wanted: impl IntoIterator<Item = String>) {
        let missing: Vec<String> = wanted.into_iter().filter(|w| !self.0.contains(w)).collect();
        assert!(missing.is_empty(), "the dice never throw:\n{}", missing.join("\n"));
    }
}

fn each<T: Debug>(what: &str, all: impl IntoIterator<Item = T>) -> Vec<String> {
    all.into_iter().map(|value| format!("{what} {value:?}")).collect()
}

/// The legal ones of these random programs of a version, for the device without limits.
fn programs(version: Version, seeds: Range<u64>) -> Vec<Program> {
    let mut samplers = vec![(0, TextureKind::D2), (2, TextureKind::Cube), (3, TextureKind::Volume)];
    if version.is_fragment_program() {
        samplers.extend([(4, TextureKind::D1), (5, TextureKind::Rectangle)]);
    }
    let layout = |sampling, targets| Layout { samplers: samplers.clone(), targets, sampling };
    let profile = rules::profile("ideal-fp32");
    let mut out = Vec::new();
    for seed in seeds {
        let mut r = Random::new(seed);
        let layout = layout(seed % 4 == 0, 1 + seed as usize % 4);
        let lines = generate::program(version, &layout, &profile, seed as usize % 4, &mut r);
        if let Ok(program) = build(&lines, &profile) {
            // The checker replaces fog by instructions, so it is taken from the assembled text.
            let fog = asm::assemble(&lines.join("\n")).ok().and_then(|program| program.fog);
            out.push(Program { fog, ..program.into_inner() });
        }
    }
    out
}

fn note_source(seen: &mut SeenFeatures, version: Version, source: &Source) {
    seen.add(&format!("{version} modifier"), source.modifier);
    seen.add(&format!("{version} file"), source.register.file);
    let swizzle: String = source.swizzle.0.iter().map(|c| ['x', 'y', 'z', 'w', '0', '1'][usize::from(*c)]).collect();
    seen.add(&format!("{version} swizzle"), swizzle);
    match source.register.relative {
        Some(Relative::Address(component)) => seen.add(&format!("{version} relative a0"), component),
        Some(Relative::Loop) => seen.add(&format!("{version} relative"), "aL"),
        None => {}
    }
}

fn note(seen: &mut SeenFeatures, version: Version, instruction: &Instruction) {
    let name = format!("{version} {:?}", instruction.opcode);
    seen.add(&format!("{version} opcode"), instruction.opcode);
    if let Some(comparison) = instruction.comparison {
        seen.add(&name, comparison);
    }
    for source in &instruction.sources {
        note_source(seen, version, source);
    }
    if let Some(d) = instruction.destination {
        seen.add(&format!("{version} mask"), d.mask.0);
        seen.add(&format!("{version} shift"), d.shift);
        seen.add(&format!("{version} saturate"), d.saturate);
        seen.add(&format!("{version} partial"), d.partial_precision);
        seen.add(&format!("{version} writes"), d.register.file);
    }
    let part = &instruction.fragment;
    seen.add(&format!("{version} precision"), part.precision);
    seen.add(&format!("{version} updates"), part.updates);
    seen.add(&format!("{version} condition"), part.condition.map(|c| c.test));
    seen.add(&format!("{version} target"), part.target);
    seen.add(&format!("{version} co-issued"), instruction.coissue);
    if let Some(predicate) = instruction.predicate {
        seen.add(&format!("{version} predicate"), (predicate.not, predicate.swizzle.0));
    }
}

/// The features of a version that must occur.
fn wanted(version: Version) -> Vec<String> {
    use Modifier as M;
    let named = |what: &str| format!("{version} {what}");
    let opcodes: Vec<Opcode> = Opcode::ALL.iter().copied().filter(|o| o.info().available(version)).collect();
    let mut out = Vec::new();
    for &opcode in opcodes.iter().filter(|o| o.info().comparison) {
        out.extend(each(&named(&format!("{opcode:?}")), Comparison::ALL));
    }
    out.extend(each(&named("opcode"), opcodes));
    let modifiers: &[Modifier] = match version {
        Version::Ps1_4 => {
            &[M::Negate, M::Invert, M::Bias, M::BiasNegate, M::Bx2, M::Bx2Negate, M::X2, M::X2Negate, M::Dz, M::Dw]
        }
        v if v.is_ps_1_x() => &[M::Negate, M::Invert, M::Bias, M::BiasNegate, M::Bx2, M::Bx2Negate],
        Version::Ps2A | Version::Vs2_0 => &[M::Negate, M::Not],
        Version::Fp1_0 => &[M::Negate, M::Absolute, M::AbsoluteNegate],
        _ => &[M::Negate],
    };
    out.extend(each(&named("modifier"), modifiers));
    let shifts: &[i8] = match version {
        Version::Ps1_4 => &[-3, -2, -1, 0, 1, 2, 3],
        v if v.is_ps_1_x() => &[-1, 0, 1, 2],
        _ => &[0],
    };
    out.extend(each(&named("shift"), shifts));
    let masks: Vec<u8> = if version.is_ps_1_1_to_1_3() { vec![7, 8, 15] } else { (1..16).collect() };
    let masks = masks.into_iter().filter(|m| version != Version::Ps1_4 || [1, 2, 3, 4, 5, 6, 7, 8, 15].contains(m));
    out.extend(each(&named("mask"), masks));
    if version.stage() == Stage::Pixel {
        out.extend(each(&named("saturate"), [false, true]));
    }
    if version.is_fragment_program() {
        out.extend(each(&named("writes"), [RegisterFile::Temp, RegisterFile::ColorOut, RegisterFile::DepthOut]));
        let targets =
            [TextureTarget::D1, TextureTarget::D2, TextureTarget::D3, TextureTarget::Cube, TextureTarget::Rect];
        out.extend(each(&named("target"), targets.map(Some)));
        let read = [RegisterFile::Input, RegisterFile::Texture, RegisterFile::FogIn, RegisterFile::WindowPosition];
        out.extend(each(&named("file"), read));
        if version == Version::Fp1_0 {
            let halves =
                [RegisterFile::Half, RegisterFile::HalfColorOut, RegisterFile::Discard, RegisterFile::HalfDiscard];
            out.extend(each(&named("writes"), halves));
            out.extend(each(&named("precision"), Precision::ALL.map(Some).into_iter().chain([None])));
            out.extend(each(&named("updates"), [false, true]));
            out.extend(each(&named("condition"), ConditionTest::ALL.map(Some).into_iter().chain([None])));
        }
    } else if version.is_ps_2() {
        out.extend(each(&named("partial"), [false, true]));
        out.extend(each(&named("writes"), [RegisterFile::ColorOut, RegisterFile::DepthOut]));
        out.extend(each(&named("swizzle"), ["xxxx", "yyyy", "zzzz", "wwww", "yzxw", "zxyw", "wzyx"]));
    } else if version.is_ps_1_x() {
        out.extend(each(&named("co-issued"), [false, true]));
    } else {
        let outputs = [
            RegisterFile::PositionOut,
            RegisterFile::FogOut,
            RegisterFile::PointSizeOut,
            RegisterFile::DiffuseOut,
            RegisterFile::TexCoordOut,
        ];
        out.extend(each(&named("writes"), outputs));
        let components = if version == Version::Vs1_1 { 0..1_u8 } else { 0..4 };
        out.extend(each(&named("relative a0"), components));
    }
    if version == Version::Vs2_0 {
        out.extend(each(&named("relative"), ["aL"]));
    }
    if version == Version::Ps2A {
        let plain = [[0, 1, 2, 3], [0; 4], [1; 4], [2; 4], [3; 4]];
        out.extend(each(&named("predicate"), plain.into_iter().flat_map(|s| [(false, s), (true, s)])));
    }
    if matches!(version, Version::Ps2A | Version::Vs1_1 | Version::Vs2_0) {
        let swizzles = (0..256).map(|n: usize| {
            [n & 3, n >> 2 & 3, n >> 4 & 3, n >> 6].map(|c| ['x', 'y', 'z', 'w'][c]).iter().collect::<String>()
        });
        out.extend(each(&named("swizzle"), swizzles));
    }
    out
}

pub(crate) fn programs_reach_every_opcode_modifier_and_swizzle() {
    for version in Version::ALL.into_iter().chain(Version::FRAGMENT) {
        let mut seen = SeenFeatures::default();
        // OpenGL's programs are not all legal.
        let count = if version.is_fragment_program() || version == Version::Ps2A { 1500 } else { 1000 };
        let (mut wanted, mut legal, mut tried) = (wanted(version), 0, 0);
        if version == Version::ArbFp1_0 {
            wanted.extend(wanted_state());
        }
        if version.is_ps_2() {
            wanted.extend(each("usage", [Usage::Sampler2d, Usage::SamplerCube, Usage::SamplerVolume]));
        }
        for seeds in (0..count).step_by(50).map(|first| first..first + 50) {
            let all = programs(version, seeds);
            legal += all.len() as u64;
            tried += 50;
            for program in &all {
                program.instructions.iter().for_each(|instruction| note(&mut seen, version, instruction));
                program.declarations.iter().for_each(|declaration| seen.add("usage", declaration.usage));
                note_state(&mut seen, program);
            }
            wanted.retain(|feature| !seen.0.contains(feature));
            if wanted.is_empty() {
                break;
            }
        }
        seen.require(wanted);
        assert!(4 * legal > tried, "{version}: only {legal} of {tried} programs are legal");
    }
}

/// Notes the kinds of OpenGL state that a program reads, and its fog.
fn note_state(seen: &mut SeenFeatures, program: &Program) {
    seen.add("fog", program.fog.map(|fog| fog.mode));
    for parameter in &program.parameters {
        let ParameterSource::State(binding) = parameter.source else { continue };
        let kind = |text: String| text.split('(').next().unwrap_or_default().to_owned();
        seen.add("state", kind(format!("{binding:?}")));
        if let StateBinding::MatrixRow(matrix, form, row) = binding {
            seen.add("matrix", kind(format!("{matrix:?}")));
            seen.add("form", form);
            seen.add("row", row);
        }
    }
}

fn wanted_state() -> Vec<String> {
    let kinds = "Material Emission Shininess Light LightPosition LightAttenuation SpotDirection LightHalf \
                 LightModelAmbient SceneColor LightProduct TextureEnvironment FogColor FogParams FogFactors \
                 DepthRange";
    let mut out = each("state", kinds.split(' '));
    out.extend(each("fog", FogMode::ALL.map(Some).into_iter().chain([None])));
    // Executors treat a matrix row like any constant, so not all combinations of matrix, form and row must occur.
    out.extend(each("matrix", ["ModelView", "Projection", "Mvp", "Texture", "Program"]));
    let forms = [MatrixForm::Plain, MatrixForm::Inverse, MatrixForm::Transpose, MatrixForm::InvTrans];
    out.extend(each("form", forms));
    out.extend(each("row", 0..4_u8));
    out
}

fn note_scene(seen: &mut SeenFeatures, case: &Case) {
    let scene = &case.scene;
    for (slot, image, state) in &scene.textures {
        seen.add("texture", image.format());
        seen.add("generated", scene.generated.contains(slot).then(|| image.format().record().is_float()));
        seen.add("levels", image.levels().len() > 1);
        seen.add("address", (image.kind(), state.address_u));
        seen.add("filter", (image.kind(), state.min, state.mag, state.mip));
    }
    for &target in &scene.targets {
        seen.add("target", target);
    }
    seen.add("targets", scene.targets.len());
    seen.add("depth", scene.depth.map(|(format, _)| format));
    seen.add("depth test", scene.depth_state.test);
    seen.add("depth write", scene.depth_state.write);
    seen.add("alpha", scene.alpha.map(|a| a.function));
    for equation in scene.blend.iter().flat_map(|b| [b.color, b.alpha]) {
        seen.add("source", equation.source);
        seen.add("destination", equation.destination);
        seen.add("blend", equation.op);
    }
    for mask in scene.masks {
        seen.add("write mask", mask.0);
    }
    seen.add("primitive", scene.primitive);
    seen.add("indices", scene.indices.is_some());
    seen.add("instances", scene.instances > 1);
    seen.add("center", scene.center);
    seen.add("clip space", scene.clip_space);
    seen.add("cull", scene.cull);
    seen.add("viewport", scene.viewport.is_some());
    seen.add("scissor", scene.scissor.is_some());
    seen.add("draws", scene.draws);
    seen.add("second pass", scene.second_pass);
    seen.add("target levels", scene.levels.map(|state| state.mip));
}

pub(crate) fn scenes_reach_every_state() {
    let mut seen = SeenFeatures::default();
    for suite in suite::all() {
        let quick = matches!(suite.kind, Kind::Texture(_) | Kind::Address(..) | Kind::Target(_) | Kind::Geometry(_));
        let quick = quick || matches!(suite.kind, Kind::Depth(_) | Kind::Compare(_) | Kind::Blend(_));
        for seed in 0..if quick { suite.seeds } else { 0 } {
            note_scene(&mut seen, &suite.case(seed));
        }
    }
    let kinds = [TextureKind::D1, TextureKind::D2, TextureKind::Rectangle, TextureKind::Cube, TextureKind::Volume];
    let modes = [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border];
    seen.require(each("texture", TexelFormat::ALL));
    seen.require(each("target", TexelFormat::ALL));
    seen.require(each("address", kinds.into_iter().flat_map(|k| modes.map(|m| (k, m)))));
    let filters = [Filter::Nearest, Filter::Linear];
    let mips = [MipFilter::None, MipFilter::Nearest, MipFilter::Linear];
    let all = filters.into_iter().flat_map(|a| filters.into_iter().flat_map(move |b| mips.map(|m| (a, b, m))));
    seen.require(each("filter", all.flat_map(|(a, b, m)| kinds.map(|k| (k, a, b, m)))));
    seen.require(each("depth", DepthFormat::ALL.iter().map(|f| Some(*f)).chain([None])));
    seen.require(each("depth test", CompareFunction::ALL.iter().map(|f| Some(*f)).chain([None])));
    seen.require(each("alpha", CompareFunction::ALL.iter().map(|f| Some(*f)).chain([None])));
    seen.require(each("source", BlendFactor::ALL));
    seen.require(each("destination", BlendFactor::ALL));
    let ops = [BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max];
    seen.require(each("blend", ops));
    seen.require(each("write mask", 0..16_u8));
    seen.require(each("targets", 1..5_usize));
    seen.require(each("primitive", PRIMITIVES));
    seen.require(each("center", [PixelCenter::Direct3d, PixelCenter::OpenGl]));
    seen.require(each("clip space", [ClipSpace::Direct3d, ClipSpace::OpenGl]));
    seen.require(each("cull", [Cull::None, Cull::Clockwise, Cull::CounterClockwise]));
    seen.require(each("draws", [1, 2]));
    seen.require(each("generated", [None, Some(false), Some(true)]));
    seen.require(each("target levels", mips.map(Some).into_iter().chain([None])));
    let switches = ["levels", "depth write", "indices", "instances", "viewport", "scissor", "second pass"];
    seen.require(switches.iter().flat_map(|s| each(s, [false, true])));
}

pub(crate) fn devices_reach_every_switch_value() {
    let mut seen = SeenFeatures::default();
    for suite in suite::all() {
        let Kind::Card(card, _) = suite.kind else { continue };
        for seed in 0..suite.seeds {
            // Repeats the random stream of `Suite::case`, up to the device.
            let mut r = Random::named(&suite.name, seed);
            suite::first_throws(&mut r);
            for switch in rules::card(card, &mut r).switches() {
                seen.add(card, (&switch.name, &switch.current));
            }
        }
    }
    for card in Profile::card_names() {
        let switches = rules::profile(card);
        let all = switches.switches().iter().flat_map(|s| s.values.iter().map(|v| (s.name.clone(), v.clone())));
        seen.require(each(card, all));
    }
}

pub(crate) fn suites_have_names_of_their_own() {
    let suites = suite::all();
    let names: BTreeSet<&str> = suites.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names.len(), suites.len(), "two suites have one name");
}
