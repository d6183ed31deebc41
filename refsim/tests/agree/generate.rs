//! Random programs of every version, legal by construction as far as that is easy; the checker says no to the rest.

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

fn def(r: &mut Random, range: f32) -> String {
    let mut text = String::new();
    for i in 0..4 {
        let value = (r.below(4097) as f32 / 2048.0 - 1.0) * range;
        let _ = write!(text, "{}{value}", if i == 0 { "" } else { ", " });
    }
    text
}

// ---------------------------------------------------------------------------------------------------- ps_1_1 to 1_3

fn ps_1(version: Version, r: &mut Random, lines: &mut Vec<String>) {
    let later = version != Version::Ps1_1;
    for c in 0..r.below(3) {
        lines.push(format!("def c{c}, {}", def(r, 1.0)));
    }
    let mut stage = 0;
    let mut free = Vec::new();
    while stage < 4 {
        let before = if stage > 0 { r.below(stage) } else { 0 };
        let scaled = if r.one_in(3) { "_bx2" } else { "" };
        let n = stage;
        match r.below(14) {
            0..=3 => lines.push(format!("tex t{n}")),
            4 => lines.push(format!("texcoord t{n}")),
            5 if r.one_in(2) => lines.push(format!("texkill t{n}")),
            6 if n > 0 => lines.push(format!("{} t{n}, t{before}", r.pick(&["texbem", "texbeml"]))),
            7 if n > 0 => lines.push(format!("{} t{n}, t{before}", r.pick(&["texreg2ar", "texreg2gb"]))),
            8 if n > 0 && later => {
                lines.push(format!("{} t{n}, t{before}", r.pick(&["texreg2rgb", "texdp3", "texdp3tex"])))
            }
            9 | 10 if n == 1 || n == 2 => {
                let last = if version == Version::Ps1_3 && r.one_in(2) { "texm3x2depth" } else { "texm3x2tex" };
                lines.push(format!("texm3x2pad t{n}, t{before}{scaled}"));
                lines.push(format!("{last} t{}, t{before}{scaled}", n + 1));
                free.push(n + 1);
                stage += 2;
                continue;
            }
            11..=13 if n == 1 => {
                lines.push(format!("texm3x3pad t1, t0{scaled}"));
                lines.push(format!("texm3x3pad t2, t0{scaled}"));
                lines.push(match r.below(4) {
                    0 => format!("texm3x3spec t3, t0{scaled}, c{}", r.below(8)),
                    1 => format!("texm3x3vspec t3, t0{scaled}"),
                    2 if later => format!("texm3x3 t3, t0{scaled}"),
                    _ => format!("texm3x3tex t3, t0{scaled}"),
                });
                break;
            }
            _ => {
                stage += 1;
                continue;
            }
        }
        free.push(stage);
        stage += 1;
    }
    lines.push(format!("mov r0, {}", r.pick(&["v0", "c0", "1-v1", "v1_bx2"])));
    lines.push(format!("mov r1, {}", r.pick(&["v0", "c1", "v0_bias", "v1"])));
    for _ in 0..r.below(6) {
        ps_1_arithmetic(version, r, lines);
    }
}

/// What stands before and after a register: the source modifiers of every ps_1 version.
const MODIFIERS: [(&str, &str); 10] = [
    ("", ""),
    ("", ""),
    ("", ""),
    ("", ""),
    ("-", ""),
    ("1-", ""),
    ("", "_bias"),
    ("-", "_bias"),
    ("", "_bx2"),
    ("-", "_bx2"),
];

fn ps_1_source(r: &mut Random, alpha: bool) -> String {
    let register = match r.below(10) {
        0..=3 => format!("r{}", r.below(2)),
        4 | 5 => format!("c{}", r.below(8)),
        6 | 7 => format!("t{}", r.below(4)),
        _ => format!("v{}", r.below(2)),
    };
    let selector = match r.below(5) {
        0 => ".a",
        1 if alpha => ".b",
        _ => "",
    };
    let (before, after) = r.choose(&MODIFIERS);
    format!("{before}{register}{after}{selector}")
}

fn ps_1_arithmetic(version: Version, r: &mut Random, lines: &mut Vec<String>) {
    let later = version != Version::Ps1_1;
    let mask = r.pick(&["", "", ".rgb", ".a"]);
    let line = one_ps_1(version, r, mask, later, false);
    lines.push(line);
    if mask == ".rgb" && r.one_in(2) {
        let partner = one_ps_1(version, r, ".a", later, true);
        lines.push(format!("+{partner}"));
    }
}

fn one_ps_1(version: Version, r: &mut Random, mask: &str, later: bool, partner: bool) -> String {
    let shift = r.pick(&["", "", "", "_x2", "_x4", "_d2"]);
    let sat = r.pick(&["", "", "_sat"]);
    let alpha = mask == ".a";
    let mut s = || ps_1_source(r, alpha);
    let (a, b, c) = (s(), s(), s());
    let to = format!("r{}", r.below(2));
    match r.below(12) {
        0 | 1 => format!("mul{shift}{sat} {to}{mask}, {a}, {b}"),
        2 | 3 => format!("mad{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
        4 => format!("add{shift}{sat} {to}{mask}, {a}, {b}"),
        5 => format!("sub{shift}{sat} {to}{mask}, {a}, {b}"),
        6 => format!("lrp{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
        7 if !alpha => format!("dp3{shift}{sat} {to}{mask}, {a}, {b}"),
        8 if !partner => format!("cnd{shift}{sat} {to}{mask}, r0.a, {a}, {b}"),
        9 if later && !partner => format!("cmp{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
        10 if later && !partner && version != Version::Ps1_1 => format!("dp4{shift}{sat} {to}{mask}, {a}, {b}"),
        _ => format!("mov{shift}{sat} {to}{mask}, {a}"),
    }
}

// ----------------------------------------------------------------------------------------------------------- ps_1_4

/// What of each register is written.
#[derive(Clone, Copy, Default)]
struct Written {
    rgb: [bool; 6],
    all: [bool; 6],
}

impl Written {
    fn load(&mut self, n: usize, alpha: bool) {
        self.rgb[n] = true;
        self.all[n] = alpha;
    }

    /// A register whose components that `alpha` asks for are written, if there is one.
    fn pick(&self, alpha: bool, r: &mut Random) -> Option<usize> {
        let list = if alpha { &self.all } else { &self.rgb };
        let ready: Vec<usize> = (0..6).filter(|&n| list[n]).collect();
        (!ready.is_empty()).then(|| ready[r.below(ready.len())])
    }
}

fn ps_1_4(r: &mut Random, lines: &mut Vec<String>) {
    for c in 0..r.below(3) {
        lines.push(format!("def c{c}, {}", def(r, 1.0)));
    }
    let mut w = Written::default();
    let two = !r.one_in(4);
    let mut loaded = [false; 6];
    if two {
        for n in 0..6 {
            ps_1_4_read(r, lines, n, &mut w, None);
        }
        for _ in 0..r.below(6) {
            ps_1_4_arithmetic(r, lines, false, &mut w, &[]);
        }
        if r.one_in(4)
            && let (Some(a), Some(b)) = (w.pick(false, r), w.pick(false, r))
        {
            lines.push(format!("bem r{}.rg, r{a}, r{b}", r.below(6)));
        }
        lines.push("phase".to_owned());
        loaded = w.rgb;
        w.all = [false; 6];
    }
    let depth = loaded[5] && r.one_in(3);
    let before = w;
    for n in 0..if depth { 5 } else { 6 } {
        if !two || !r.one_in(3) {
            ps_1_4_read(r, lines, n, &mut w, Some(&before));
        }
    }
    if r.one_in(6) {
        lines.push(match before.pick(false, r) {
            Some(n) if r.one_in(2) => format!("texkill r{n}"),
            _ => format!("texkill t{}", r.below(6)),
        });
    }
    if depth {
        lines.push("texdepth r5".to_owned());
        w.rgb[5] = false;
        w.all[5] = false;
    }
    lines.push(match (w.pick(false, r), w.pick(false, r)) {
        (Some(a), Some(b)) if r.one_in(2) => format!("mad_d2 r0.rgb, r{a}, c{}, r{b}", r.below(3)),
        _ => format!("mov r0.rgb, {}", r.pick(&["v0", "c0", "1-v1", "v1_bx2"])),
    });
    lines.push("mov r0.a, v1".to_owned());
    w.load(0, true);
    for _ in 0..r.below(6) {
        ps_1_4_arithmetic(r, lines, true, &mut w, if depth { &[5] } else { &[] });
    }
}

fn ps_1_4_read(r: &mut Random, lines: &mut Vec<String>, n: usize, w: &mut Written, before: Option<&Written>) {
    let set = r.below(6);
    // Of one coordinate set always the same selector: even sets .xyz, odd ones .xyw.
    let selector = if set.is_multiple_of(2) { "" } else { ".xyw" };
    let register = before.and_then(|b| b.pick(false, r));
    let (line, alpha) = match (r.below(8), register) {
        (3, _) if set % 2 == 1 => (format!("texld r{n}, t{set}_dw.xyw"), true),
        (4 | 7, _) => (format!("texcrd r{n}.rgb, t{set}{selector}"), false),
        (5, Some(a)) => (format!("texld r{n}, r{a}"), true),
        (6, Some(a)) if r.one_in(2) => (format!("texld r{n}, r{a}_dz"), true),
        _ => (format!("texld r{n}, t{set}{selector}"), true),
    };
    lines.push(line);
    w.load(n, alpha);
}

fn ps_1_4_arithmetic(r: &mut Random, lines: &mut Vec<String>, second: bool, w: &mut Written, dead: &[usize]) {
    let mask = r.pick(&["", ".rgb", ".rgb", ".a", ".r", ".g", ".b", ".rg", ".ga"]);
    let before = *w;
    let line = one_ps_1_4(r, mask, (second, false), &before, w, dead);
    lines.push(line);
    if mask == ".rgb" && r.one_in(2) {
        let partner = one_ps_1_4(r, ".a", (second, true), &before, w, dead);
        lines.push(format!("+{partner}"));
    }
}

fn ps_1_4_source(r: &mut Random, second: bool, alpha: bool, w: &Written) -> String {
    let register = match (r.below(10), w.pick(alpha, r)) {
        (0..=6, Some(n)) => format!("r{n}"),
        (7 | 8, _) if second => format!("v{}", r.below(2)),
        _ => return format!("c{}{}", r.below(8), r.pick(&["", ".r", ".a"])),
    };
    let selector = match r.below(5) {
        0 if alpha => ".a",
        1 => r.pick(&[".r", ".g", ".b"]),
        _ => "",
    };
    let (before, after) = r.choose(&MODIFIERS);
    let (before, after) = if after.is_empty() && r.one_in(5) { (r.pick(&["", "-"]), "_x2") } else { (before, after) };
    format!("{before}{register}{after}{selector}")
}

fn one_ps_1_4(
    r: &mut Random,
    mask: &str,
    (second, partner): (bool, bool),
    before: &Written,
    w: &mut Written,
    dead: &[usize],
) -> String {
    let shift = r.pick(&["", "", "", "_x2", "_x4", "_x8", "_d2", "_d4", "_d8"]);
    let sat = r.pick(&["", "", "_sat"]);
    let wide = mask.is_empty() || mask.contains('a');
    let kind = r.below(12);
    let dot4 = kind == 10 && !partner && mask != ".rgb";
    let mut s = || ps_1_4_source(r, second, wide || dot4, before);
    let (a, b, c) = (s(), s(), s());
    let n = loop {
        let n = r.below(6);
        if !dead.contains(&n) {
            break n;
        }
    };
    let to = format!("r{n}");
    if mask.is_empty() {
        w.load(n, true);
    }
    match kind {
        0 | 1 => format!("mul{shift}{sat} {to}{mask}, {a}, {b}"),
        2 | 3 => format!("mad{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
        4 => format!("add{shift}{sat} {to}{mask}, {a}, {b}"),
        5 => format!("sub{shift}{sat} {to}{mask}, {a}, {b}"),
        6 => format!("lrp{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
        7 if !partner => format!("dp3{shift}{sat} {to}{mask}, {a}, {b}"),
        8 => format!("cnd{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
        9 => format!("cmp{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
        _ if dot4 => format!("dp4{shift}{sat} {to}{mask}, {a}, {b}"),
        _ => format!("mov{shift}{sat} {to}{mask}, {a}"),
    }
}

// ------------------------------------------------------------------------------------------------------------ ps_2

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

// -------------------------------------------------------------------------------------------------------------- vs

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
