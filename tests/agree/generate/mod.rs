//! Random programs of every version, mostly legal by construction; the checker rejects the others.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

mod flow;
mod fp;
mod ps_1;
mod ps_1_4;
mod ps_2;
mod vs;

use crate::random::Random;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::isa::Version;
use refsim::texture::TextureKind;
use std::fmt::Write as _;

/// The resources that a program may rely on.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    /// The samplers in use (in ps_1_x: stages), each with its texture kind.
    pub(crate) samplers: Vec<(usize, TextureKind)>,
    /// Number of color targets.
    pub(crate) targets: usize,
    /// True if the version's own limits hold; otherwise only the emulator's limits.
    pub(crate) limited: bool,
    /// True if most of the program reads textures.
    pub(crate) sampling: bool,
}

/// A program's text, one line per instruction, after a line with the version. `size` is 0 (shortest) to 3 (longest).
pub(crate) fn program(version: Version, layout: &Layout, size: usize, r: &mut Random) -> Vec<String> {
    let mut lines = vec![version.token().to_owned()];
    match version {
        Version::Ps1_1 | Version::Ps1_2 | Version::Ps1_3 => ps_1::program(version, layout, size, r, &mut lines),
        Version::Ps1_4 => ps_1_4::program(layout, size, r, &mut lines),
        Version::Ps2_0 | Version::Ps2A | Version::Ps2B => ps_2::program(version, layout, size, r, &mut lines),
        Version::Fp1_0 | Version::ArbFp1_0 => fp::program(version, layout, size, r, &mut lines),
        Version::Vs1_1 | Version::Vs2_0 => vs::program(version, layout, size, r, &mut lines),
        _ => panic!("no program is drawn for {version}"),
    }
    lines
}

/// A random program by seed that the checker accepts for a device without limits, with texture 0 and one target.
pub(crate) fn legal(version: Version, seed: u64) -> String {
    let mut random = Random::new(seed);
    let layout = Layout { samplers: vec![(0, TextureKind::D2)], targets: 1, limited: false, sampling: false };
    let device = Profile::named("ideal-fp32").expect("a device");
    let mut texts = (0..1000).map(|attempt| {
        let size = random.below(4) >> (attempt / 100).min(3);
        program(version, &layout, size, &mut random).join("\n")
    });
    let is_legal = |text: &String| assemble(text).is_ok_and(|program| check(program, &device).is_ok());
    texts.find(is_legal).unwrap_or_else(|| panic!("no legal {version} program in 1000 tries"))
}

/// Four values of a `def`, within `range` of 0; if `range` exceeds 1, also special values, written as bits.
fn values(r: &mut Random, range: f32) -> String {
    let mut text = String::new();
    for i in 0..4 {
        let comma = if i == 0 { "" } else { ", " };
        let _ = if range > 1.0 && r.one_in(24) {
            write!(text, "{comma}{:#010x}", r.number())
        } else {
            write!(text, "{comma}{}", (r.below(4097) as f32 / 2048.0 - 1.0) * range)
        };
    }
    text
}

fn comparison(r: &mut Random) -> &'static str {
    r.of(&["gt", "lt", "ge", "le", "eq", "ne"])
}

fn component(r: &mut Random) -> &'static str {
    r.of(&["x", "y", "z", "w"])
}

/// A swizzle with its dot, or nothing; any of the 256 if `any`, otherwise one that ps_2_0 supports.
fn swizzle(r: &mut Random, any: bool) -> String {
    match r.below(8) {
        0 | 1 => format!(".{}", component(r)),
        2 => format!(".{}", r.of(&["yzxw", "zxyw", "wzyx"])),
        3 | 4 if any => format!(".{}{}{}{}", component(r), component(r), component(r), component(r)),
        _ => String::new(),
    }
}

/// One of the fifteen write masks with its dot, or nothing.
fn mask(r: &mut Random) -> String {
    if r.one_in(3) {
        return String::new();
    }
    let bits = 1 + r.below(15);
    let letters: String =
        ['x', 'y', 'z', 'w'].into_iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, c)| c).collect();
    if bits == 15 { String::new() } else { format!(".{letters}") }
}
