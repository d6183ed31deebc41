//! Cases from files: the project's kernels, and the shaders among the fixtures.

use crate::dice::{self, Options};
use crate::random::Random;
use crate::rules;
use crate::scene::{Case, build};
use crate::shapes::{self, Shape};
use crate::suite::{pass_through, shows_all};
use refsim::asm;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::{Stage, Usage};
use refsim::texture::TextureKind;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Ideal devices on which programs are tried, in addition to the cards.
const IDEALS: [&str; 6] = ["ideal-s3.12", "ideal-fp16", "ideal-fp24", "ideal-fp32", "ideal-s7.16", "ideal-e8m10"];

/// A program from a file, with the devices that accept it.
pub(crate) struct Program {
    pub(crate) file: String,
    lines: Vec<String>,
    devices: Vec<String>,
    stage: Stage,
}

/// Programs of some folders.
pub(crate) struct Programs(pub(crate) Vec<Program>);

/// All kernels of the project: files in their folders, and kernels that code generates.
pub(crate) static KERNELS: LazyLock<Programs> = LazyLock::new(|| {
    let rooms = walk(&root().join("src"), &["psa", "vsa", "fp"]);
    let mut all = Programs::read(rooms.into_iter().filter(|p| p.parent().is_some_and(|f| f.ends_with("kernels"))));
    let written = crossbar::subsurface::kernels::programs().into_iter();
    let written = written.chain(crossbar::cpca::kernels::programs());
    let written = written.chain(crossbar::all_frequency::kernels::programs());
    let written = written.chain(crossbar::bi_scale::kernels::programs());
    all.0.extend(written.filter_map(|(name, text)| Program::new(name, &text)));
    all
});

pub(crate) static SHADERS: LazyLock<Programs> =
    LazyLock::new(|| Programs::read(walk(&root().join("fixtures/shaders"), &["psa", "vsa"])));

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The files below a folder that end in one of `endings`, sorted.
fn walk(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap_or_else(|e| panic!("{e}")).path();
        if path.is_dir() {
            out.extend(walk(&path, endings));
        } else if path.extension().and_then(|e| e.to_str()).is_some_and(|e| endings.contains(&e)) {
            out.push(path);
        }
    }
    out.sort();
    out
}

impl Program {
    /// A program that assembles, if a device accepts it.
    fn new(file: String, text: &str) -> Option<Self> {
        let program = asm::assemble(text).ok()?;
        let lines: Vec<String> = asm::print(&program).lines().map(str::to_owned).collect();
        let accepts = |device: &&str| build(&lines, &rules::profile(device)).is_ok();
        let devices = Profile::card_names().into_iter().chain(IDEALS).filter(accepts).map(str::to_owned).collect();
        Some(Self { file, lines, devices, stage: program.version.stage() }).filter(|p: &Self| !p.devices.is_empty())
    }
}

impl Programs {
    fn read(files: impl IntoIterator<Item = PathBuf>) -> Self {
        let read = |path: PathBuf| {
            // Fixtures that are wrong on purpose have no case.
            let text = std::fs::read_to_string(&path).ok()?;
            Program::new(path.strip_prefix(root()).unwrap_or(&path).display().to_string(), &text)
        };
        Self(files.into_iter().filter_map(read).collect())
    }

    /// Pairs of a program and a device that accepts it.
    pub(crate) fn pairs(&self) -> u64 {
        self.0.iter().map(|p| p.devices.len() as u64).sum()
    }

    /// Number of pairs drawn by default: every fourth pair, so that a program that four devices accept is included.
    pub(crate) fn short(&self) -> u64 {
        self.pairs().div_ceil(4)
    }

    /// Pair number `seed` modulo the number of pairs; the pairs drawn by default come first.
    fn pair(&self, seed: u64) -> (&Program, &str) {
        let number = seed % self.pairs().max(1);
        let others = |at: u64| 4 * (at / 3) + 1 + at % 3;
        let mut left = number.checked_sub(self.short()).map_or(4 * number, others);
        for program in &self.0 {
            if left < program.devices.len() as u64 {
                return (program, &program.devices[left as usize]);
            }
            left -= program.devices.len() as u64;
        }
        panic!("there are programs")
    }
}

fn kinds(program: &CheckedProgram, r: &mut Random) -> Vec<(usize, TextureKind)> {
    let facts = program.facts();
    let bound = (0..16).filter(|n| facts.samplers >> n & 1 == 1);
    bound
        .map(|n| {
            let kind = match facts.sampler_usage[n] {
                Some(Usage::SamplerCube) => TextureKind::Cube,
                Some(Usage::SamplerVolume) => TextureKind::Volume,
                None if r.one_in(8) => TextureKind::Cube,
                _ => TextureKind::D2,
            };
            (n, kind)
        })
        .collect()
}

/// A program of a folder on a device that accepts it, with random legal inputs.
pub(crate) fn program_case(programs: &Programs, seed: u64, r: &mut Random) -> Case {
    let (program, device) = programs.pair(seed);
    let profile = if device.starts_with("ideal") { rules::profile(device) } else { rules::card(device, r) };
    // A switch can forbid a program that the default allows.
    let fits = build(&program.lines, &profile).is_ok();
    let profile = if fits { profile } else { rules::profile(device) };
    let checked = build(&program.lines, &profile).unwrap_or_else(|e| panic!("{} on {device}: {e}", program.file));
    let shape = r.of(&[Shape::Flat, Shape::Layers, Shape::Ordinary, Shape::Clipped]);
    let options = Options { shape: Some(shape), ..Options::new(checked.version) };
    let (mut scene, layout) = dice::scene(profile, &options, r);
    if program.stage == Stage::Vertex {
        let pixel = shows_all(&scene.profile, layout.targets);
        return Case { scene, pixel, vertex: Some(program.lines.clone()) };
    }
    let kinds = kinds(&checked, r);
    scene.textures = dice::textures(&kinds, &options, &scene.profile, r);
    dice::mipmaps(&mut scene, &options, r);
    let setups: Vec<&Program> =
        programs.0.iter().filter(|p| p.stage == Stage::Vertex && p.devices.iter().any(|d| d == device)).collect();
    let vertex = match r.below(3) {
        0 => None,
        1 => Some(pass_through(&mut scene, r)),
        _ if setups.is_empty() => None,
        _ => {
            shapes::streams(&mut scene, r);
            Some(setups[r.below(setups.len())].lines.clone())
        }
    };
    let vertex = vertex.filter(|lines| build(lines, &scene.profile).is_ok());
    Case { scene, pixel: program.lines.clone(), vertex }
}
