//! Random programs: legal ones of every version, and anything that can be written in Direct3D's assembly.
#![allow(dead_code, unused_imports, reason = "shared by several test binaries, each of which takes what it needs")]

mod anything;
mod fp;
mod grown;

pub(crate) use anything::anything;
pub(crate) use fp::program as fragment;

use crate::random::Random;
use refsim::device::Profile;
use refsim::isa::{FragmentPart, Instruction, Opcode, Span, Version};
use refsim::texture::TextureKind;
use std::fmt::Write as _;

/// The resources that a program may rely on.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    /// The samplers in use (in ps_1_x: stages), each with its texture kind.
    pub(crate) samplers: Vec<(usize, TextureKind)>,
    /// Number of color targets.
    pub(crate) targets: usize,
    /// True if most of the program reads textures.
    pub(crate) sampling: bool,
}

/// A program's text for a device, one line per instruction, after a line with the version. `size` is 0 (shortest) to 3
/// (longest). OpenGL's programs are mostly legal, Direct3D's always if the device takes the plain one that they grow
/// from.
pub(crate) fn program(
    version: Version,
    layout: &Layout,
    profile: &Profile,
    size: usize,
    r: &mut Random,
) -> Vec<String> {
    match version.is_fragment_program() {
        true => fragment(version, layout, size, r),
        false => grown::program(version, layout, profile, size, r),
    }
}

/// A random Direct3D program by seed that is legal on a device without limits, with texture 0 and one target.
pub(crate) fn legal(version: Version, seed: u64) -> String {
    let mut random = Random::new(seed);
    let layout = Layout { samplers: vec![(0, TextureKind::D2)], targets: 1, sampling: false };
    let device = Profile::named("ideal-fp32").expect("a device");
    let size = random.below(4);
    program(version, &layout, &device, size, &mut random).join("\n")
}

/// An instruction without operands.
fn bare(opcode: Opcode) -> Instruction {
    Instruction {
        opcode,
        comparison: None,
        destination: None,
        sources: Vec::new(),
        coissue: false,
        predicate: None,
        fragment: FragmentPart::default(),
        format: None,
        span: Span::default(),
    }
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

fn component(r: &mut Random) -> &'static str {
    r.of(&["x", "y", "z", "w"])
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
