//! Generates programs that the checker accepts for an ideal device, from a list of choices.
//!
//! A list of numbers determines every choice, so that proptest can shrink it: fewer or smaller numbers give a simpler
//! program. Registers are written before they are read, and operands follow the rules of each version.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use refsim::isa::Version;
use std::fmt::Write;

/// A list of choices; zeros once it is used up.
pub(crate) struct Choices<'a> {
    list: &'a [u32],
    at: usize,
}

impl<'a> Choices<'a> {
    pub(crate) fn new(list: &'a [u32]) -> Self {
        Self { list, at: 0 }
    }

    /// A number below `limit`.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        let value = self.list.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        value as usize % limit.max(1)
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    fn chance(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 1
    }
}

/// The text of a program of `version`.
pub(crate) fn program(version: Version, choices: &[u32]) -> String {
    let mut c = Choices::new(choices);
    match version {
        Version::Ps1_4 => ps_1_4(&mut c),
        v if v.is_ps_1_x() => ps_1_1(v, &mut c),
        v if v.is_ps_2() => ps_2(v, &mut c),
        v => vs(v, &mut c),
    }
}

const DECIMALS: [&str; 8] = ["0.5", "-0.25", "1.0", "-1.0", "0.7071", "0.001", "-0.333", "0.0"];

fn defs(text: &mut String, c: &mut Choices<'_>, count: usize) {
    for i in 0..count {
        let values: Vec<&str> = (0..4).map(|_| c.pick(&DECIMALS)).collect();
        writeln!(text, "def c{i}, {}", values.join(", ")).unwrap();
    }
}

/// Arithmetic operations with component-wise results, valid with any mask, and their number of operands.
const WISE_1: [(&str, usize); 8] =
    [("mov", 1), ("add", 2), ("sub", 2), ("mul", 2), ("mad", 3), ("lrp", 3), ("cnd", 3), ("cmp", 3)];

fn ps_1_4(c: &mut Choices<'_>) -> String {
    let mut text = "ps_1_4\n".to_owned();
    defs(&mut text, c, 2);
    let two = c.chance(2);
    for phase in 0..=usize::from(two) {
        if phase == 1 {
            text += "phase\n";
        }
        let last = phase == usize::from(two);
        // Three registers, each loaded at the start of the phase or kept with a new alpha.
        let mut alphas = Vec::new();
        for r in 0..3 {
            match c.below(4) {
                0 if phase == 0 || r > 0 => writeln!(text, "texld r{r}, t{r}").unwrap(),
                1 => {
                    writeln!(text, "texcrd r{r}.rgb, t{r}").unwrap();
                    alphas.push(r);
                }
                2 if phase == 1 => {
                    writeln!(text, "texld r{r}, r{r}{}", c.pick(&["", "_dz", ""])).unwrap();
                }
                _ if phase == 1 => alphas.push(r),
                _ => writeln!(text, "texld r{r}, t{r}").unwrap(),
            }
        }
        if last && c.chance(4) {
            text += "texkill t4\n";
        }
        for r in alphas {
            writeln!(text, "mov r{r}.a, c{r}.a", r = r).unwrap();
        }
        for _ in 0..c.below(6) {
            arithmetic_1_4(&mut text, c, last);
        }
    }
    // c2 provides the alphas used above.
    text.replacen("def c1", "def c2, 0.25, 0.5, 0.75, 1.0\ndef c1", 1)
}

fn arithmetic_1_4(text: &mut String, c: &mut Choices<'_>, last: bool) {
    let shift = c.pick(&["", "", "", "_x2", "_x4", "_x8", "_d2", "_d4", "_d8"]);
    let sat = c.pick(&["", "", "_sat"]);
    let d = c.below(3);
    if c.chance(5) {
        let op = c.pick(&["dp3", "dp4"]);
        let (a, b) = (operand_1_4(c, last), operand_1_4(c, last));
        writeln!(text, "{op}{shift}{sat} r{d}, {a}, {b}").unwrap();
        return;
    }
    let pair = c.chance(4);
    let (op, count) = c.pick(&WISE_1);
    let mask = if pair { ".rgb" } else { c.pick(&["", ".rgb", ".a", ".rg", ".ba", ".g"]) };
    let list: Vec<String> = (0..count).map(|_| operand_1_4(c, last)).collect();
    writeln!(text, "{op}{shift}{sat} r{d}{mask}, {}", list.join(", ")).unwrap();
    if pair {
        let (op, count) = c.pick(&WISE_1[..4]);
        let list: Vec<String> = (0..count).map(|_| format!("r{}{}", c.below(3), c.pick(&["", ".r", ".b"]))).collect();
        writeln!(text, "+{op}{sat} r{}.a, {}", c.below(3), list.join(", ")).unwrap();
    }
}

fn operand_1_4(c: &mut Choices<'_>, last: bool) -> String {
    let selector = c.pick(&["", "", ".r", ".g", ".b", ".a"]);
    match c.below(6) {
        0 => format!("c0{selector}"),
        1 if last => format!("v{}{selector}", c.below(2)),
        _ => {
            let (before, after) = c.pick(&[
                ("", ""),
                ("", ""),
                ("-", ""),
                ("1-", ""),
                ("", "_bias"),
                ("-", "_bx2"),
                ("", "_bx2"),
                ("", "_x2"),
                ("-", "_x2"),
            ]);
            let r = c.below(3);
            format!("{before}r{r}{after}{selector}")
        }
    }
}

fn ps_1_1(version: Version, c: &mut Choices<'_>) -> String {
    let mut text = format!("{version}\n");
    defs(&mut text, c, 2);
    let later = version != Version::Ps1_1;
    text += c.pick(&["tex t0\n", "texcoord t0\n"]);
    match c.below(if later { 12 } else { 9 }) {
        0 => text += "tex t1\n",
        1 => text += "texcoord t1\n",
        2 => text += "texbem t1, t0\n",
        3 => text += "texbeml t1, t0\n",
        4 => text += "texreg2ar t1, t0\n",
        5 => text += "texreg2gb t1, t0\n",
        6 => text += "texm3x2pad t1, t0\ntexm3x2tex t2, t0\ntex t3\n",
        7 => text += "texm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3tex t3, t0\n",
        8 => text += "texm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3spec t3, t0, c0\n",
        9 => text += "texdp3 t1, t0\n",
        10 => text += "texdp3tex t1, t0\n",
        _ => text += "texreg2rgb t1, t0\n",
    }
    // Registers that are certainly written.
    text += "mov r0, c0\nmov r1, v0\n";
    for _ in 0..c.below(5) {
        let (op, count) = c.pick(&WISE_1[..6]);
        let shift = c.pick(&["", "", "_x2", "_x4", "_d2"]);
        let mask = c.pick(&["", ".rgb", ".a"]);
        let list: Vec<String> = (0..count)
            .map(|_| match c.below(4) {
                0 => "c1".to_owned(),
                1 => "v1".to_owned(),
                _ => format!("{}r{}", c.pick(&["", "-", "1-"]), c.below(2)),
            })
            .collect();
        writeln!(text, "{op}{shift} r{}{mask}, {}", c.below(2), list.join(", ")).unwrap();
    }
    text
}

const SWIZZLES: [&str; 8] = ["", "", ".x", ".y", ".w", ".yzxw", ".zxyw", ".wzyx"];
const MASKS: [&str; 6] = ["", "", ".xyz", ".w", ".xz", ".y"];

fn ps_2(version: Version, c: &mut Choices<'_>) -> String {
    let mut text = format!("{version}\n");
    defs(&mut text, c, 4);
    text += "def c6, -1.5500992e-6, -2.1701389e-5, 0.0026041667, 0.00026041668\n";
    text += "def c7, -0.020833334, -0.125, 1.0, 0.5\n";
    if version == Version::Ps2A {
        text += "defi i0, 3, 0, 0, 0\ndefb b0, true\n";
    }
    text += "dcl t0\ndcl t1\ndcl v0\ndcl_2d s0\n";
    text += "mov r0, t0\nmov r1, v0\nmov r2, c0\ntexld r3, t1, s0\n";
    for _ in 0..c.below(12) {
        if version == Version::Ps2A && c.chance(3) {
            flow(&mut text, c);
        } else {
            arithmetic_2(&mut text, c, version);
        }
    }
    if c.chance(5) {
        text += "texkill r1\n";
    }
    if c.chance(5) {
        text += "mov oDepth, r2.x\n";
    }
    text + "mov oC0, r0\n"
}

fn arithmetic_2(text: &mut String, c: &mut Choices<'_>, version: Version) {
    let hint = c.pick(&["", "", "_pp"]);
    let sat = c.pick(&["", "", "_sat"]);
    let d = c.below(4);
    let mask = c.pick(&MASKS);
    let source = |c: &mut Choices<'_>| {
        let register = if c.chance(5) { "c1".to_owned() } else { format!("r{}", c.below(4)) };
        format!("{}{register}{}", c.pick(&["", "", "-"]), c.pick(&SWIZZLES))
    };
    let scalar = |c: &mut Choices<'_>| format!("r{}.{}", c.below(4), c.pick(&["x", "y", "z", "w"]));
    match c.below(12) {
        0 => writeln!(text, "rcp{hint}{sat} r{d}{mask}, {}", scalar(c)),
        1 => writeln!(text, "{}{hint}{sat} r{d}{mask}, {}", c.pick(&["rsq", "exp", "log"]), scalar(c)),
        2 => writeln!(text, "frc{hint} r{d}{}, r{}", c.pick(&["", ".xyz", ".y"]), c.below(4)),
        3 => writeln!(text, "{}{hint}{sat} r{d}{mask}, {}, {}", c.pick(&["dp3", "dp4"]), source(c), source(c)),
        4 => writeln!(text, "nrm{hint}{sat} r{d}, r{}", (d + 1) % 4),
        5 => writeln!(text, "crs{hint}{sat} r{d}.xyz, r{}, r{}", (d + 1) % 4, (d + 2) % 4),
        6 => writeln!(text, "dp2add{hint}{sat} r{d}{mask}, {}, {}, r{}.x", source(c), source(c), c.below(4)),
        7 => writeln!(text, "pow{hint}{sat} r{d}{mask}, {}, {}", scalar(c), scalar(c)),
        8 => writeln!(text, "sincos{hint} r{d}.xy, r{}.x, c6, c7", (d + 1) % 4),
        9 if version == Version::Ps2A => {
            writeln!(text, "{}{hint}{sat} r{d}{mask}, r{}", c.pick(&["dsx", "dsy"]), c.below(4))
        }
        10 => writeln!(text, "texld{} r{d}, {}, s0", hint, c.pick(&["t0", "t1", "r0"])),
        _ => {
            let table = [
                ("mov", 1),
                ("abs", 1),
                ("add", 2),
                ("sub", 2),
                ("mul", 2),
                ("min", 2),
                ("max", 2),
                ("mad", 3),
                ("cmp", 3),
                ("lrp", 3),
            ];
            let (op, count) = c.pick(&table);
            let list: Vec<String> = (0..count).map(|_| source(c)).collect();
            let d = if op == "lrp" { 3 } else { d };
            let list = if op == "lrp" { "r0, r1, r2".to_owned() } else { list.join(", ") };
            writeln!(text, "{op}{hint}{sat} r{d}{mask}, {list}")
        }
    }
    .unwrap();
}

/// A block of ps_2_a flow control.
fn flow(text: &mut String, c: &mut Choices<'_>) {
    let comparison = c.pick(&["gt", "lt", "ge", "le", "eq", "ne"]);
    let (a, b) = (c.below(3), c.below(3));
    let body = |text: &mut String, c: &mut Choices<'_>| {
        for _ in 0..1 + c.below(3) {
            // Reads with derivatives are not allowed in branches.
            let mut line = String::new();
            arithmetic_2(&mut line, c, Version::Ps2B);
            *text += if line.starts_with("texld") { "add r1, r1, c2\n" } else { &line };
        }
    };
    match c.below(5) {
        0 => {
            writeln!(text, "if_{comparison} r{a}.x, r{b}.y").unwrap();
            body(text, c);
            if c.chance(2) {
                text.push_str("else\n");
                body(text, c);
            }
            text.push_str("endif\n");
        }
        1 => {
            text.push_str("rep i0\n");
            body(text, c);
            if c.chance(2) {
                writeln!(text, "break_{comparison} r{a}.z, r{b}.w").unwrap();
                text.push_str("add r0, r0, c3\n");
            }
            text.push_str("endrep\n");
        }
        2 => {
            text.push_str(c.pick(&["if b0\n", "if !b0\n"]));
            body(text, c);
            text.push_str("endif\n");
        }
        _ => {
            writeln!(text, "setp_{comparison} p0, r{a}, r{b}").unwrap();
            let swizzle = c.pick(&["", ".x", ".y", ".z", ".w"]);
            writeln!(text, "({}p0{swizzle}) mul r{}, r{a}, r{b}", c.pick(&["", "!"]), c.below(4)).unwrap();
            if c.chance(3) {
                text.push_str("if p0.y\n");
                body(text, c);
                text.push_str("endif\n");
            }
        }
    }
}

fn vs(version: Version, c: &mut Choices<'_>) -> String {
    let mut text = format!("{version}\n");
    defs(&mut text, c, 4);
    let two = version == Version::Vs2_0;
    if two {
        text += "defi i0, 2, 1, 1, 0\ndefb b0, true\n";
    }
    text += "dcl_position v0\ndcl_normal v1\nmov r0, v0\nmov r1, v1\nmov r2, c0\n";
    text += if two { "mova a0.x, r0.x\n" } else { "mov a0.x, r0.x\n" };
    for _ in 0..c.below(10) {
        let d = c.below(3);
        let mask = c.pick(&MASKS);
        let sources: Vec<String> =
            (0..3).map(|_| format!("{}r{}{}", c.pick(&["", "", "-"]), c.below(3), c.pick(&SWIZZLES))).collect();
        match c.below(8) {
            0 => writeln!(
                text,
                "{} r{d}{mask}, r{}.{}",
                c.pick(&["rcp", "rsq", "exp", "log"]),
                c.below(3),
                c.pick(&["x", "w"])
            ),
            1 => writeln!(text, "add r{d}{mask}, r0, c[a0.x + {}]", c.below(4)),
            2 => writeln!(
                text,
                "{} r{d}, r{}, r{}",
                c.pick(&["dst", "sge", "slt", "dp3", "dp4"]),
                c.below(3),
                c.below(3)
            ),
            3 => writeln!(text, "lit r{d}, r{}", (d + 1) % 3),
            4 => writeln!(text, "m4x4 r{d}, r{}, c0", (d + 1) % 3),
            5 if two => writeln!(text, "loop aL, i0\nadd r{d}, r{d}, c[aL]\nendloop"),
            6 if two => writeln!(text, "if b0\nmul r{d}, r0, r1\nelse\nmov r{d}, c1\nendif"),
            5 => writeln!(text, "{} r{d}, r{}.w", c.pick(&["expp", "logp"]), c.below(3)),
            6 => writeln!(text, "mad r{d}{mask}, {}, {}, {}", sources[0], sources[1], sources[2]),
            _ => writeln!(
                text,
                "{} r{d}{mask}, {}, {}",
                c.pick(&["add", "sub", "mul", "min", "max"]),
                sources[0],
                sources[1]
            ),
        }
        .unwrap();
    }
    text + "mov oPos, v0\nmov oT0, r0\nmov oD0, r1\nmov oT1, r2\n"
}
