//! Suites: a name, the kind of cases, and the number of seeds.

use crate::dice::{self, Options};
use crate::files;
use crate::generate::{self, Layout};
use crate::random::Random;
use crate::rules::{self, Family, Group};
use crate::scene::{Case, Scene, build};
use crate::shapes::Shape;
use refsim::device::{Profile, Storage};
use refsim::isa::{Stage, Version};
use refsim::machine::StepRate;
use refsim::output::{BlendOp, CompareFunction, DepthFormat};
use refsim::texture::{AddressMode, TexelFormat, TextureKind};
use strum::VariantArray as _;

/// The kind of cases of a suite, with the properties that are fixed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    /// Random programs of a version, in a family of formats, with random rules of a group.
    Program(Version, Family, Group),
    /// Random programs of a version whose instructions have their own random formats.
    Mixed(Version),
    /// Random programs of a version on a card, with random switches.
    Card(&'static str, Version),
    /// Textures of a format.
    Texture(TexelFormat),
    /// Textures of a kind, with an address mode.
    Address(TextureKind, AddressMode),
    /// Targets of a format.
    Target(TexelFormat),
    /// Depth buffers of a format.
    Depth(DepthFormat),
    /// A depth comparison.
    Compare(CompareFunction),
    /// A blend operation.
    Blend(BlendOp),
    /// A kind of geometry.
    Geometry(Shape),
    /// The project's kernels.
    Kernels,
    /// The shaders among the fixtures.
    Shaders,
}

#[derive(Clone, Debug)]
pub(crate) struct Suite {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    /// The suite's own seeds are 0 up to this number; they cover every random choice.
    pub(crate) seeds: u64,
}

pub(crate) const PIXEL: [Version; 7] =
    [Version::Ps1_1, Version::Ps1_2, Version::Ps1_3, Version::Ps1_4, Version::Ps2_0, Version::Ps2A, Version::Ps2B];

impl Suite {
    pub(crate) fn new(name: impl Into<String>, kind: Kind, seeds: u64) -> Self {
        Self { name: name.into(), kind, seeds }
    }

    /// A random number from which executors that skip cases select theirs, evenly over suites and seeds.
    pub(crate) fn turn(&self, seed: u64) -> u64 {
        Random::named(&self.name, seed).next()
    }

    pub(crate) fn case(&self, seed: u64) -> Case {
        let mut random = Random::named(&self.name, seed);
        let r = &mut random;
        let version = first_throws(r);
        let any = r.next();
        let family = Family::VARIANTS[seed as usize % Family::VARIANTS.len()];
        let together = Group::Together;
        let options = Options::new(version);
        // Small programs, so that the suite's fixed property dominates the picture.
        let of_ideal =
            |options: Options, r: &mut Random| pixel_case(rules::ideal(family, together, any, r), &options, 2, r);
        match self.kind {
            Kind::Program(version, family, group) if version.stage() == Stage::Vertex => {
                vertex_case(rules::vertex_ideal(family, group, seed, r), version, r)
            }
            Kind::Program(version, family, group) => {
                let sampling = group == Group::Sampling && r.one_in(2);
                let options = Options { sampling, ..Options::new(version) };
                pixel_case(rules::ideal(family, group, seed, r), &options, 4, r)
            }
            Kind::Mixed(version) if version.stage() == Stage::Vertex => {
                mixed(version, vertex_case(rules::vertex_ideal(family, together, any, r), version, r), r)
            }
            Kind::Mixed(version) => {
                mixed(version, pixel_case(rules::ideal(family, together, any, r), &Options::new(version), 4, r), r)
            }
            Kind::Card(card, version) if version.stage() == Stage::Vertex => {
                vertex_case(rules::card(card, r), version, r)
            }
            Kind::Card(card, version) => pixel_case(rules::card(card, r), &Options::new(version), 4, r),
            Kind::Texture(format) => {
                let version = if r.one_in(3) { PIXEL[r.below(3)] } else { version };
                of_ideal(Options { texture: Some(format), sampling: true, ..Options::new(version) }, r)
            }
            Kind::Address(kind, address) => {
                of_ideal(Options { kind: Some(kind), address: Some(address), sampling: true, ..options }, r)
            }
            Kind::Target(format) => of_ideal(Options { target: Some(format), ..options }, r),
            Kind::Depth(format) => of_ideal(Options { depth: Some(format), ..options }, r),
            Kind::Compare(compare) => of_ideal(Options { compare: Some(compare), ..options }, r),
            Kind::Blend(blend) => of_ideal(Options { blend: Some(blend), ..options }, r),
            Kind::Geometry(shape) => of_ideal(Options { shape: Some(shape), ..options }, r),
            Kind::Kernels => files::program_case(&files::KERNELS, seed, r),
            Kind::Shaders => files::program_case(&files::SHADERS, seed, r),
        }
    }
}

/// The first random numbers of every case: a pixel program version for suites that fix none.
pub(crate) fn first_throws(r: &mut Random) -> Version {
    r.of(&PIXEL[3..])
}

fn legal(version: Version, layout: &Layout, sizes: usize, profile: &Profile, r: &mut Random) -> Vec<String> {
    let start = r.below(sizes.max(1));
    let mut last = String::new();
    for attempt in 0..1000 {
        let size = start.saturating_sub(attempt / 8);
        let lines = generate::program(version, layout, profile, size, r);
        match build(&lines, profile) {
            Ok(_) => return lines,
            Err(why) => last = format!("{}\n{why}", lines.join("\n")),
        }
    }
    panic!("no legal {version} program for {} in 1000 tries; the last is\n{last}", profile.name)
}

/// A random pixel program in a random scene; some scenes are instanced and use a pass-through vertex program.
fn pixel_case(profile: Profile, options: &Options, sizes: usize, r: &mut Random) -> Case {
    let (mut scene, layout) = dice::scene(profile, options, r);
    let pixel = legal(options.version, &layout, sizes, &scene.profile, r);
    let crossbar = matches!(options.shape, Some(Shape::Flat | Shape::Layers)) || r.one_in(6);
    let vertex = crossbar.then(|| pass_through(&mut scene, r));
    Case { scene, pixel, vertex }
}

/// Turns the scene's vertices into instances: positions per vertex, all other attributes per instance; returns the
/// vertex program.
pub(crate) fn pass_through(scene: &mut Scene, r: &mut Random) -> Vec<String> {
    scene.instances = 1 + r.below(6);
    scene.streams = vec![(0, StepRate::Vertex, scene.vertices.iter().map(|v| v.position).collect())];
    let mut lines = vec!["vs_1_1".to_owned()];
    let usages = ["position", "texcoord0", "texcoord1", "texcoord2", "texcoord3", "texcoord4", "color0"];
    lines.extend(usages.iter().enumerate().map(|(n, usage)| format!("dcl_{usage} v{n}")));
    lines.push("mov oPos, v0".to_owned());
    for register in 1..7 {
        let by_vertex = register == 1 && r.one_in(2);
        let (step, data) = if by_vertex {
            (StepRate::Vertex, scene.vertices.iter().map(|v| v.texcoords[0]).collect())
        } else {
            (StepRate::Instance, (0..scene.instances).map(|_| r.vector()).collect())
        };
        scene.streams.push((register, step, data));
        lines.push(match register {
            6 => "mov oD0, v6".to_owned(),
            _ => format!("mov oT{}, v{register}", register - 1),
        });
    }
    lines
}

/// A random vertex program with a pixel program that shows all its outputs.
fn vertex_case(profile: Profile, version: Version, r: &mut Random) -> Case {
    let options = Options::new(version);
    let (mut scene, layout) = dice::scene(profile, &options, r);
    // Small targets suffice, because vertices are tested here.
    scene.size = scene.size.map(|side| 1 + side % 12);
    let vertex = legal(version, &layout, 4, &scene.profile, r);
    let pixel = shows_all(&scene.profile, layout.targets);
    Case { scene, pixel, vertex: Some(vertex) }
}

/// Gives two in three instructions of this version's program their own formats, and in pixel programs also a third of
/// the storages and accumulators.
fn mixed(version: Version, mut case: Case, r: &mut Random) -> Case {
    let any = |r: &mut Random| {
        let formats = r.of(Family::VARIANTS).formats();
        r.of(&formats).parse().expect("a format")
    };
    for storage in Storage::ALL.into_iter().filter(|_| version.stage() == Stage::Pixel) {
        if r.one_in(3) {
            // Several tries, because registers of most formats cannot hold every other format.
            let _ = (0..8).any(|_| case.scene.profile.set_storage_format(storage, Some(any(r))).is_ok());
        }
    }
    if version.stage() == Stage::Pixel && r.one_in(3) {
        let _ = (0..8).any(|_| case.scene.profile.set_accumulator(Some(any(r))).is_ok());
    }
    let lines = case.vertex.as_ref().filter(|_| version.stage() == Stage::Vertex).unwrap_or(&case.pixel);
    let program = refsim::asm::assemble(&lines.join("\n")).expect("a program that was built before");
    for index in 0..program.instructions.len() {
        if r.one_in(3) {
            continue;
        }
        // Some instructions accept no format.
        case.scene.profile.set_instruction_format(&program, index, Some(any(r)));
    }
    case
}

/// A pixel program whose result depends on every coordinate set and color.
pub(crate) fn shows_all(profile: &Profile, targets: usize) -> Vec<String> {
    let mut lines;
    if profile.supports(Version::Ps2_0) {
        lines = vec!["ps_2_0".to_owned()];
        lines.extend((0..8).map(|t| format!("dcl t{t}")));
        lines.extend((0..2).map(|v| format!("dcl v{v}")));
        lines.extend(["mov r0, t0".to_owned(), "mov r1, v0".to_owned()]);
        lines.extend((1..8).map(|t| format!("mad r{}, r{}, c0, t{t}", t % 2, t % 2)));
        lines.push("mad r1, r1, r0, v1".to_owned());
        lines.extend((0..targets).map(|i| format!("mov oC{i}, r{}", i % 2)));
    } else {
        lines = vec!["ps_1_1".to_owned()];
        lines.extend((0..4).map(|t| format!("texcoord t{t}")));
        lines.extend(["mad r0, t0, v0, t1", "mad r1, t2, v1, t3", "add_d2 r0, r0, r1"].map(str::to_owned));
    }
    lines
}

pub(crate) fn version_name(version: Version) -> &'static str {
    match version {
        Version::Fp1_0 => "fp_1_0",
        Version::ArbFp1_0 => "arbfp_1_0",
        _ => version.token(),
    }
}

/// The name of a variant as used in the names of suites: `less_equal`.
fn snake_case(variant: impl std::fmt::Debug) -> String {
    let text = format!("{variant:?}");
    let inner = |(at, c): (usize, char)| if at > 0 && c.is_ascii_uppercase() { vec!['_', c] } else { vec![c] };
    text.chars().enumerate().flat_map(inner).collect::<String>().to_lowercase()
}

pub(crate) fn all() -> Vec<Suite> {
    let mut out = Vec::new();
    for version in Version::ALL.into_iter().chain(Version::FRAGMENT) {
        let vertex = version.stage() == Stage::Vertex;
        for &family in Family::VARIANTS {
            for &group in Group::VARIANTS {
                if vertex && matches!(group, Group::Sampling | Group::Pipeline) {
                    continue;
                }
                let name =
                    format!("programs::{}::{}::{}", version_name(version), <&str>::from(family), <&str>::from(group));
                let seeds = if vertex { 12 } else { 6 };
                out.push(Suite::new(name, Kind::Program(version, family, group), seeds));
            }
        }
    }
    for version in Version::ALL.into_iter().chain(Version::FRAGMENT) {
        out.push(Suite::new(format!("mixed::{}", version_name(version)), Kind::Mixed(version), 20));
    }
    for card in Profile::card_names() {
        for version in &rules::profile(card).limits.versions {
            out.push(Suite::new(format!("cards::{card}::{}", version_name(*version)), Kind::Card(card, *version), 10));
        }
    }
    for &format in TexelFormat::ALL {
        out.push(Suite::new(format!("textures::{}", format.name()), Kind::Texture(format), 7));
    }
    let kinds = [TextureKind::D1, TextureKind::D2, TextureKind::Rectangle, TextureKind::Cube, TextureKind::Volume];
    for kind in kinds {
        for address in [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border] {
            let name = format!("addressing::{}::{}", snake_case(kind), snake_case(address));
            out.push(Suite::new(name, Kind::Address(kind, address), 7));
        }
    }
    for &format in TexelFormat::ALL {
        out.push(Suite::new(format!("targets::{}", format.name()), Kind::Target(format), 7));
    }
    for &format in DepthFormat::ALL {
        out.push(Suite::new(format!("depth::{}", format.name()), Kind::Depth(format), 7));
    }
    for &compare in CompareFunction::ALL {
        out.push(Suite::new(format!("depth::{}", snake_case(compare)), Kind::Compare(compare), 7));
    }
    for blend in [BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max] {
        out.push(Suite::new(format!("blending::{}", snake_case(blend)), Kind::Blend(blend), 7));
    }
    for &shape in Shape::VARIANTS {
        let seeds = if shape == Shape::Fine { 150 } else { 14 };
        out.push(Suite::new(format!("geometry::{}", <&str>::from(shape)), Kind::Geometry(shape), seeds));
    }
    out.push(Suite::new("project::kernels", Kind::Kernels, files::KERNELS.short()));
    out.push(Suite::new("project::shaders", Kind::Shaders, files::SHADERS.short()));
    out
}

/// Case `first` + `n` of one of the suites whose names fit, drawn once on a target of at most `side` x `side` pixels.
pub(crate) fn small_case(fits: impl Fn(&str) -> bool, n: u64, first: u64, side: u32) -> Case {
    let suites: Vec<Suite> = all().into_iter().filter(|suite| fits(&suite.name)).collect();
    let mut case = suites[(n as usize * 61) % suites.len()].case(first + n);
    (case.scene.draws, case.scene.second_pass) = (1, false);
    case.scene.size = case.scene.size.map(|length| length.min(side));
    case
}
