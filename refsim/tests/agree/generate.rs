//! Random programs of every version, legal by construction as far as that is easy; the checker says no to the rest.

use crate::generate_ps_1::{ps_1, ps_1_4};
use crate::random::Random;
use refsim::isa::Version;
use std::fmt::Write as _;

/// A program's text, one line an instruction, the version first.
pub(crate) fn program(version: Version, r: &mut Random) -> Vec<String> {
    let mut lines = vec![version.token().to_owned()];
    match version {
        Version::Ps1_1 | Version::Ps1_2 | Version::Ps1_3 => ps_1(version, r, &mut lines),
        Version::Ps1_4 => ps_1_4(r, &mut lines),
        Version::Ps2_0 | Version::Ps2A | Version::Ps2B => ps_2(version, r, &mut lines),
        Version::Vs1_1 | Version::Vs2_0 => vs(version, r, &mut lines),
    }
    lines
}

pub(crate) fn def(r: &mut Random, range: f32) -> String {
    let mut text = String::new();
    for i in 0..4 {
        let value = (r.below(4097) as f32 / 2048.0 - 1.0) * range;
        let _ = write!(text, "{}{value}", if i == 0 { "" } else { ", " });
    }
    text
}

/// Registers that the generated ps_2 and vs_2 programs use.
const TEMPS: usize = 6;

fn ps_2(version: Version, r: &mut Random, lines: &mut Vec<String>) {
    let a = version == Version::Ps2A;
    lines.extend((0..4).map(|t| format!("dcl t{t}")));
    lines.extend((0..2).map(|v| format!("dcl v{v}")));
    lines.extend(["dcl_2d s0", "dcl_2d s1", "dcl_2d s2", "dcl_cube s3", "dcl_volume s4"].map(str::to_owned));
    lines.push(format!("def c0, {}", def(r, 2.0)));
    lines.push("def c6, -1.5500992e-6, -2.1701389e-5, 0.0026041667, 0.00026041668".to_owned());
    lines.push("def c7, -0.020833334, -0.125, 1.0, 0.5".to_owned());
    if a {
        lines.push(format!("defi i0, {}, 0, 1, 0", r.below(4)));
        lines.push(format!("defi i1, {}, 0, 1, 0", r.below(3)));
        lines.push(format!("defb b0, {}", r.pick(&["true", "false"])));
    }
    for n in 0..TEMPS {
        let from = match r.below(4) {
            0 => format!("v{}", r.below(2)),
            1 => format!("c{}", r.below(6)),
            _ => format!("t{}", r.below(4)),
        };
        lines.push(format!("mov{} r{n}, {from}", partial(r)));
    }
    let mut label = false;
    if a {
        lines.push(format!("setp_{} p0, r0, r1", comparison(r)));
        ps_2_block(version, r, lines, 0, &mut label);
    } else {
        for _ in 0..4 + r.below(14) {
            ps_2_instruction(version, r, lines, false);
        }
    }
    let first = r.below(TEMPS);
    for i in 0..4 {
        lines.push(format!("mov oC{i}, r{}", (first + i) % TEMPS));
    }
    if r.one_in(3) {
        lines.push(format!("mov oDepth, r{}.{}", r.below(TEMPS), component(r)));
    }
    if label {
        lines.extend(["ret", "label l0"].map(str::to_owned));
        for _ in 0..1 + r.below(4) {
            ps_2_instruction(version, r, lines, true);
        }
        lines.push("ret".to_owned());
    }
}

fn partial(r: &mut Random) -> &'static str {
    r.pick(&["", "", "_pp"])
}

fn comparison(r: &mut Random) -> &'static str {
    r.pick(&["gt", "lt", "ge", "le", "eq", "ne"])
}

fn component(r: &mut Random) -> &'static str {
    r.pick(&["x", "y", "z", "w"])
}

/// Instructions with flow control around some of them.
fn ps_2_block(version: Version, r: &mut Random, lines: &mut Vec<String>, depth: usize, label: &mut bool) {
    for _ in 0..3 + r.below(5) {
        let inner = depth < 3;
        match r.below(14) {
            0 if inner => {
                let (a, b) = (r.below(TEMPS), r.below(TEMPS));
                let (x, y) = (component(r), component(r));
                lines.push(match r.below(4) {
                    0 => "if b0".to_owned(),
                    1 => format!("if {}p0.{x}", r.pick(&["", "!"])),
                    _ => format!("if_{} r{a}.{x}, r{b}.{y}", comparison(r)),
                });
                ps_2_block(version, r, lines, depth + 1, label);
                if r.one_in(2) {
                    lines.push("else".to_owned());
                    ps_2_block(version, r, lines, depth + 1, label);
                }
                lines.push("endif".to_owned());
            }
            1 if inner => {
                lines.push(format!("rep i{}", r.below(2)));
                ps_2_block(version, r, lines, depth + 1, label);
                match r.below(4) {
                    0 => lines.push(format!("break_{} r0.{}, r1.{}", comparison(r), component(r), component(r))),
                    1 => lines.push(format!("breakp p0.{}", component(r))),
                    2 => {
                        lines.push(format!("if_{} r2.{}, r1.{}", comparison(r), component(r), component(r)));
                        lines.push("break".to_owned());
                        lines.push("endif".to_owned());
                    }
                    _ => {}
                }
                ps_2_instruction(version, r, lines, true);
                lines.push("endrep".to_owned());
            }
            2 if depth < 2 => {
                *label = true;
                lines.push(match r.below(3) {
                    0 => "call l0".to_owned(),
                    1 => "callnz l0, b0".to_owned(),
                    _ => format!("callnz l0, {}p0.{}", r.pick(&["", "!"]), component(r)),
                });
            }
            3 => lines.push(format!(
                "setp_{} p0{}, r{}, r{}",
                comparison(r),
                r.pick(&["", ".x", ".yz"]),
                r.below(TEMPS),
                r.below(TEMPS)
            )),
            _ => ps_2_instruction(version, r, lines, depth > 0),
        }
    }
}

fn swizzle(r: &mut Random, any: bool) -> String {
    match r.below(6) {
        0 | 1 => format!(".{}", component(r)),
        2 => format!(".{}", r.pick(&["yzxw", "zxyw", "wzyx"])),
        3 if any => format!(".{}{}{}{}", component(r), component(r), component(r), component(r)),
        _ => String::new(),
    }
}

fn ps_2_source(r: &mut Random, constants: &mut usize, any: bool) -> String {
    let negate = if r.one_in(4) { "-" } else { "" };
    let register = match r.below(12) {
        0 | 1 if *constants == 0 => {
            *constants += 1;
            format!("c{}", r.below(6))
        }
        _ => format!("r{}", r.below(TEMPS)),
    };
    format!("{negate}{register}{}", swizzle(r, any))
}

fn ps_2_instruction(version: Version, r: &mut Random, lines: &mut Vec<String>, nested: bool) {
    let a = version == Version::Ps2A;
    let predicate = match a && r.one_in(6) {
        true => format!("({}p0{}) ", r.pick(&["", "!"]), r.pick(&["", ".x", ".w"])),
        false => String::new(),
    };
    let sat = r.pick(&["", "", "", "_sat"]);
    let pp = partial(r);
    let mask = r.pick(&["", "", ".x", ".yz", ".xyz", ".w", ".xw"]);
    let to = format!("r{}", r.below(TEMPS));
    let mut constants = 0;
    let mut s = || ps_2_source(r, &mut constants, a);
    let (x, y, z) = (s(), s(), s());
    let scalar = format!("{}r{}.{}", r.pick(&["", "-"]), r.below(TEMPS), component(r));
    let other = format!("r{}.{}", r.below(TEMPS), component(r));
    let from = r.below(TEMPS);
    let line = match r.below(34) {
        0..=2 => format!("mul{pp}{sat} {to}{mask}, {x}, {y}"),
        3..=5 => format!("mad{pp}{sat} {to}{mask}, {x}, {y}, {z}"),
        6 | 7 => format!("add{pp}{sat} {to}{mask}, {x}, {y}"),
        8 => format!("sub{pp}{sat} {to}{mask}, {x}, {y}"),
        9 => format!("lrp{pp}{sat} {to}{mask}, {x}, {y}, {z}"),
        10 => format!("dp3{pp}{sat} {to}{mask}, {x}, {y}"),
        11 => format!("dp4{pp}{sat} {to}{mask}, {x}, {y}"),
        12 => format!("dp2add{pp}{sat} {to}{mask}, {x}, {y}, {scalar}"),
        13 => format!("cmp{pp}{sat} {to}{mask}, {x}, {y}, {z}"),
        14 => format!("min{pp}{sat} {to}{mask}, {x}, {y}"),
        15 => format!("max{pp}{sat} {to}{mask}, {x}, {y}"),
        16 => format!("abs{pp}{sat} {to}{mask}, {x}"),
        17 => format!("frc{pp} {to}{mask}, {x}"),
        18 => format!("rcp{pp}{sat} {to}{mask}, {scalar}"),
        19 => format!("rsq{pp}{sat} {to}{mask}, {scalar}"),
        20 => format!("exp{pp}{sat} {to}{mask}, {scalar}"),
        21 => format!("log{pp}{sat} {to}{mask}, {scalar}"),
        22 => format!("pow{pp}{sat} {to}{mask}, {scalar}, {other}"),
        23 => format!("nrm{pp}{sat} {to}, {x}"),
        24 => format!("crs{pp}{sat} {to}.xyz, r{from}, r{}", r.below(TEMPS)),
        25 => format!("m3x3{pp}{sat} {to}.xyz, r{from}, c1"),
        26 => format!("m4x4{pp}{sat} {to}, r{from}, c1"),
        27 => format!("sincos{pp} {to}.xy, {scalar}, c6, c7"),
        28 => format!("texld{pp} {to}, {}, s{}", r.pick(&["t0", "t1", "r0", "r3"]), r.below(5)),
        29 => format!("{}{pp} {to}, {}, s{}", r.pick(&["texldb", "texldp"]), r.pick(&["t2", "r1"]), r.below(5)),
        30 if !nested => format!("texkill {}", r.pick(&["t3", "r2", "r4"])),
        31 if a && !nested => format!("{} {to}{mask}, {x}", r.pick(&["dsx", "dsy"])),
        32 if a => format!("texldd{pp} {to}, r{from}, s{}, r{}, r{}", r.below(5), r.below(TEMPS), r.below(TEMPS)),
        _ => format!("mov{pp}{sat} {to}{mask}, {x}"),
    };
    lines.push(format!("{predicate}{line}"));
}

fn vs(version: Version, r: &mut Random, lines: &mut Vec<String>) {
    let two = version == Version::Vs2_0;
    lines.push("dcl_position v0".to_owned());
    lines.push("dcl_texcoord0 v1".to_owned());
    lines.push("dcl_texcoord1 v2".to_owned());
    lines.push("dcl_color0 v3".to_owned());
    lines.push(format!("def c0, {}", def(r, 2.0)));
    if two {
        lines.push("def c6, -1.5500992e-6, -2.1701389e-5, 0.0026041667, 0.00026041668".to_owned());
        lines.push("def c7, -0.020833334, -0.125, 1.0, 0.5".to_owned());
        lines.push(format!("defi i0, {}, 1, 1, 0", r.below(4)));
        lines.push(format!("defb b0, {}", r.pick(&["true", "false"])));
    }
    for n in 0..TEMPS {
        lines.push(format!("mov r{n}, v{}", 1 + r.below(3)));
    }
    lines.push(format!("mov{} a0.x, r0.{}", if two { "a" } else { "" }, component(r)));
    for _ in 0..3 + r.below(12) {
        match r.below(9) {
            0 if two => {
                lines.push(r.pick(&["if b0", "rep i0", "loop aL, i0"]).to_owned());
                let close = match lines.last().map_or("", |l| &l[..2]) {
                    "if" => "endif",
                    "re" => "endrep",
                    _ => {
                        lines.push(format!("add r{}, r1, c[aL + 1]", r.below(TEMPS)));
                        "endloop"
                    }
                };
                vs_instruction(two, r, lines);
                lines.push(close.to_owned());
            }
            _ => vs_instruction(two, r, lines),
        }
    }
    // The position stays a small change of the attribute, so that triangles stay in view.
    lines.push("mad oPos, r0, c5, v0".to_owned());
    for t in 0..4 {
        lines.push(format!("mov oT{t}, r{}", r.below(TEMPS)));
    }
    lines.push(format!("mov oD0, r{}", r.below(TEMPS)));
    lines.push(format!("mov oD1, r{}", r.below(TEMPS)));
}

fn vs_instruction(two: bool, r: &mut Random, lines: &mut Vec<String>) {
    let to = format!("r{}", r.below(TEMPS));
    let mask = r.pick(&["", "", ".x", ".yz", ".xyz", ".w"]);
    let mut constants = 0;
    let mut s = || ps_2_source(r, &mut constants, true);
    let (x, y, z) = (s(), s(), s());
    let scalar = format!("{}r{}.{}", r.pick(&["", "-"]), r.below(TEMPS), component(r));
    lines.push(match r.below(26) {
        0 | 1 => format!("mul {to}{mask}, {x}, {y}"),
        2 | 3 => format!("mad {to}{mask}, {x}, {y}, {z}"),
        4 => format!("add {to}{mask}, {x}, {y}"),
        5 => format!("sub {to}{mask}, {x}, {y}"),
        6 => format!("dp3 {to}{mask}, {x}, {y}"),
        7 => format!("dp4 {to}{mask}, {x}, {y}"),
        8 => format!("{} {to}{mask}, {x}, {y}", r.pick(&["sge", "slt"])),
        9 => format!("{} {to}{mask}, {x}, {y}", r.pick(&["min", "max"])),
        10 => format!("{} {to}{mask}, {scalar}", r.pick(&["rcp", "rsq"])),
        11 => format!("{} {to}{mask}, {scalar}", r.pick(&["exp", "log"])),
        12 => format!("{} {to}, {scalar}", r.pick(&["expp", "logp"])),
        13 => format!("lit {to}, {x}"),
        14 => format!("dst {to}, {x}, {y}"),
        15 => format!("m4x4 {to}, r{}, c1", r.below(TEMPS)),
        16 => format!("m3x3 {to}.xyz, r{}, c1", r.below(TEMPS)),
        17 => format!("add {to}{mask}, {x}, c[a0.x + {}]", r.below(6)),
        18 => format!("mov{} a0.x, r{}.{}", if two { "a" } else { "" }, r.below(TEMPS), component(r)),
        19 => format!("frc {to}.xy, {x}"),
        20 if two => format!("lrp {to}{mask}, {x}, {y}, {z}"),
        21 if two => format!("{} {to}{mask}, {x}", r.pick(&["abs", "nrm"])),
        22 if two => format!("sgn {to}{mask}, {x}, r{}, r{}", r.below(TEMPS), r.below(TEMPS)),
        23 if two => format!("pow {to}{mask}, {scalar}, r{}.{}", r.below(TEMPS), component(r)),
        24 if two => format!("crs {to}.xyz, r{}, r{}", r.below(TEMPS), r.below(TEMPS)),
        _ => format!("mov {to}{mask}, {x}"),
    });
}
