//! Legal programs of Direct3D's versions. A program grows from a plain one: random instructions are inserted at random
//! places, and kept if the checker accepts them.

mod instructions;

use super::{Layout, values};
use crate::random::Random;
use refsim::asm::{assemble, print};
use refsim::check::check;
use refsim::device::Profile;
use refsim::isa::{Opcode, OpcodeClass, Stage, Version};
use refsim::texture::TextureKind;

/// Number of tries per instruction wanted in a program.
const TRIES: usize = 16;

pub(super) fn program(
    version: Version,
    layout: &Layout,
    profile: &Profile,
    size: usize,
    r: &mut Random,
) -> Vec<String> {
    let (writer, text) = Writer::plain(version, layout, size, r);
    let mut program = assemble(&text).unwrap_or_else(|errors| panic!("{text}\n{errors:?}"));
    let wanted = 1 + r.below([3, 7, 15, 26][size.min(3)]);
    let mut grown = 0;
    for _ in 0..TRIES * wanted {
        let mut next = program.clone();
        writer.insert(&mut next.instructions, r);
        if check(next.clone(), profile).is_ok() {
            program = next;
            grown += 1;
            if grown == wanted {
                break;
            }
        }
    }
    print(&program).lines().map(str::to_owned).collect()
}

/// Names that the instructions of a program may use.
struct Writer {
    version: Version,
    temps: u16,
    /// Coordinate sets, and colors or attributes.
    sets: u16,
    inputs: u16,
    samplers: Vec<u16>,
    /// True if most of the program reads textures.
    sampling: bool,
    /// Instructions before and after the part with flow control: they initialise registers, and write results.
    begin: usize,
    end: usize,
    /// The operations to draw from, without flow control, and those among them that read textures.
    opcodes: Vec<Opcode>,
    reads: Vec<Opcode>,
}

impl Writer {
    /// A program that gives all registers values and writes its results.
    fn plain(version: Version, layout: &Layout, size: usize, r: &mut Random) -> (Self, String) {
        let mut declared = vec![version.token().to_owned()];
        let (mut begin, mut end) = (Vec::new(), Vec::new());
        let many = if size > 0 && r.one_in(4) { 4 + r.below(8) } else { 3 + r.below(4) };
        let mut opcodes: Vec<Opcode> = Opcode::ALL.to_vec();
        opcodes.retain(|o| o.info().available(version) && o.info().class != OpcodeClass::Flow && *o != Opcode::Phase);
        let is_read = |o: &&Opcode| o.info().class == OpcodeClass::Texture && **o != Opcode::TexKill;
        let mut writer = Self {
            version,
            temps: if version.is_ps_1_1_to_1_3() { 2 } else { many },
            sets: if version.is_ps_1_1_to_1_3() { 4 } else { 6 },
            inputs: 2,
            samplers: layout.samplers.iter().map(|(slot, _)| *slot as u16).collect(),
            sampling: layout.sampling,
            begin: 0,
            end: 0,
            reads: opcodes.iter().filter(is_read).copied().collect(),
            opcodes,
        };
        if version.is_ps_1_x() {
            writer.before_ps_2(&mut declared, &mut begin, r);
        } else {
            writer.declare(layout, &mut declared, r);
            writer.values_and_results(layout, &mut begin, &mut end, r);
        }
        if matches!(version, Version::Ps2A | Version::Vs2_0) {
            writer.subroutines(&mut begin, &mut end, r);
        }
        (writer.begin, writer.end) = (begin.len(), end.len());
        (writer, [declared, begin, end].concat().join("\n"))
    }

    fn before_ps_2(&mut self, declared: &mut Vec<String>, begin: &mut Vec<String>, r: &mut Random) {
        declared.extend((0..r.below(3)).map(|c| format!("def c{c}, {}", values(r, 1.0))));
        if self.version != Version::Ps1_4 {
            begin.extend((0..r.below(3)).map(|t| format!("tex t{t}")));
        } else {
            self.temps = 6;
            if !r.one_in(4) {
                let selector = |n: usize| if n % 2 == 1 { ".xyw" } else { "" };
                begin.extend((0..2 + r.below(5)).map(|n| format!("texld r{n}, t{n}{}", selector(n))));
                begin.push("phase".to_owned());
            }
        }
        begin.extend((0..2).map(|n| format!("mov r{n}, {}", r.of(&["v0", "c0", "1-v1", "v1_bx2"]))));
    }

    fn declare(&mut self, layout: &Layout, declared: &mut Vec<String>, r: &mut Random) {
        if self.version.stage() == Stage::Vertex {
            self.inputs = 4 + r.below(4);
            let usages =
                ["position", "texcoord0", "texcoord1", "color0", "normal", "tangent", "blendweight", "binormal"];
            let some = usages.iter().take(self.inputs.into()).enumerate();
            declared.extend(some.map(|(n, usage)| format!("dcl_{usage} v{n}")));
        } else {
            self.sets = 4 + r.below(5);
            let hints = ["", "", "", "_pp", "_centroid"];
            declared.extend((0..self.sets).map(|t| format!("dcl{} t{t}", r.of(&hints))));
            declared.extend((0..2).map(|v| format!("dcl{} v{v}", r.of(&hints[2..4]))));
            for &(slot, kind) in &layout.samplers {
                let usages = ["2d", "cube", "volume"];
                let right = match kind {
                    TextureKind::Cube => "cube",
                    TextureKind::Volume => "volume",
                    _ => "2d",
                };
                declared.push(format!("dcl_{} s{slot}", if r.one_in(12) { r.of(&usages) } else { right }));
            }
        }
        declared.push(format!("def c0, {}", values(r, 2.0)));
        if self.version != Version::Vs1_1 {
            declared.push("def c6, -1.5500992e-6, -2.1701389e-5, 0.0026041667, 0.00026041668".to_owned());
            declared.push("def c7, -0.020833334, -0.125, 1.0, 0.5".to_owned());
        }
        if matches!(self.version, Version::Ps2A | Version::Vs2_0) {
            declared.push(format!("defi i0, {}, {}, {}, 0", r.below(4), r.below(4), r.below(3)));
            if r.coin() {
                declared.push(format!("defb b0, {}", r.coin()));
            }
        }
    }

    fn values_and_results(&self, layout: &Layout, begin: &mut Vec<String>, end: &mut Vec<String>, r: &mut Random) {
        let temp = |r: &mut Random| format!("r{}", r.below(self.temps));
        if self.version.stage() == Stage::Vertex {
            begin.extend((0..self.temps).map(|n| format!("mov r{n}, v{}", 1 + r.below(self.inputs - 1))));
            begin.push(if self.version == Version::Vs2_0 { "mova a0, r0" } else { "mov a0.x, r0.x" }.to_owned());
            // The position stays near the attribute, so that triangles stay in view.
            end.push(r.of(&["mov oPos, v0", "m4x4 oPos, v0, c8", "mad oPos, r0, c5, v0"]).to_owned());
            for t in (0..8).filter(|_| !r.one_in(4)).collect::<Vec<_>>() {
                end.push(format!("mov oT{t}{}, {}", r.of(&["", "", ".x", ".yz", ".xyw"]), temp(r)));
            }
            end.extend((0..2).map(|d| format!("mov oD{d}, {}", temp(r))));
            return;
        }
        for n in 0..self.temps {
            let set = r.below(self.sets);
            begin.push(match r.below(5) {
                0 => format!("mov r{n}, v{}", r.below(2)),
                1 => format!("mov r{n}, c{}", r.below(6)),
                2 if !self.samplers.is_empty() => format!("texld r{n}, t{set}, s{}", r.of(&self.samplers)),
                _ => format!("mov r{n}, t{set}"),
            });
        }
        if self.version == Version::Ps2A {
            begin.push("setp_gt p0, r0, r1".to_owned());
        }
        let first = r.below(self.temps);
        end.extend((0..layout.targets as u16).map(|i| format!("mov oC{i}, r{}", (first + i) % self.temps)));
        if r.one_in(3) {
            end.push(format!("mov oDepth, {}.{}", temp(r), r.of(&["x", "y", "z", "w"])));
        }
    }

    /// Two subroutines, one in vertex programs; the first may call the second.
    fn subroutines(&self, begin: &mut Vec<String>, end: &mut Vec<String>, r: &mut Random) {
        if r.coin() {
            return;
        }
        let is_pixel = self.version == Version::Ps2A;
        let count = if is_pixel { 2 } else { 1 };
        begin.extend((0..count).map(|label| format!("call l{label}")));
        for label in 0..count {
            end.extend(["ret".to_owned(), format!("label l{label}"), "mad r0, r1, c1, r0".to_owned()]);
            if r.coin() {
                end.extend(["if b1", "add r1, r0, c2", "endif"].map(str::to_owned));
            }
            if label == 0 && is_pixel && r.coin() {
                end.push("call l1".to_owned());
            }
        }
        end.push("ret".to_owned());
    }
}
