//! Random programs of ps_1_1 to ps_1_3.

use super::{Layout, values};
use crate::random::Random;
use refsim::isa::Version;

/// State of a program while it is written.
struct Writer<'a> {
    version: Version,
    r: &'a mut Random,
    lines: &'a mut Vec<String>,
    /// Texture registers that arithmetic can read.
    loaded: Vec<usize>,
    /// Number of `cmp` and `dp4` instructions still allowed.
    cmps: usize,
    dp4s: usize,
}

pub(super) fn program(version: Version, layout: &Layout, size: usize, r: &mut Random, lines: &mut Vec<String>) {
    for c in 0..r.below(3) {
        lines.push(format!("def c{c}, {}", values(r, 1.0)));
    }
    let mut w = Writer { version, r, lines, loaded: Vec::new(), cmps: 3, dp4s: 4 };
    w.textures(layout);
    w.start();
    let most = [2, 4, 6, 7][size.min(3)];
    for _ in 0..w.r.below(most) {
        w.arithmetic();
    }
}

impl Writer<'_> {
    fn textures(&mut self, layout: &Layout) {
        let later = self.version != Version::Ps1_1;
        let mut stage = 0;
        // A register from which a bump map was read may not be read again.
        let mut spent = Vec::new();
        while stage < 4 {
            let n = stage;
            let before: Vec<usize> = self.loaded.iter().copied().filter(|b| !spent.contains(b)).collect();
            let b = if before.is_empty() { 0 } else { before[self.r.below(before.len())] };
            let depends = !before.is_empty();
            let scaled = if self.r.one_in(3) { "_bx2" } else { "" };
            let late_scaled = if later { scaled } else { "" };
            let kinds = if layout.sampling { 9 } else { 15 };
            let line = match self.r.below(kinds) {
                0 | 1 => format!("tex t{n}"),
                2 if depends => format!("{} t{n}, t{b}", self.r.of(&["texreg2ar", "texreg2gb"])),
                3 if depends && later => {
                    format!("{} t{n}, t{b}{late_scaled}", self.r.of(&["texreg2rgb", "texdp3", "texdp3tex"]))
                }
                4 if depends => {
                    spent.push(b);
                    format!("{} t{n}, t{b}", self.r.of(&["texbem", "texbeml"]))
                }
                5 | 6 if depends && n < 3 => {
                    let depth = self.version == Version::Ps1_3 && self.r.one_in(2);
                    let last = if depth { "texm3x2depth" } else { "texm3x2tex" };
                    let scaled = if depth { late_scaled } else { scaled };
                    self.lines.push(format!("texm3x2pad t{n}, t{b}{scaled}"));
                    self.lines.push(format!("{last} t{}, t{b}{scaled}", n + 1));
                    if !depth {
                        self.loaded.push(n + 1);
                    }
                    stage += 2;
                    continue;
                }
                7 | 8 if depends && n == 1 => {
                    self.lines.push(format!("texm3x3pad t1, t{b}{scaled}"));
                    self.lines.push(format!("texm3x3pad t2, t{b}{scaled}"));
                    let last = match self.r.below(4) {
                        0 => format!("texm3x3spec t3, t{b}{scaled}, c{}", self.r.below(8)),
                        1 => format!("texm3x3vspec t3, t{b}{scaled}"),
                        2 if later => format!("texm3x3 t3, t{b}{scaled}"),
                        _ => format!("texm3x3tex t3, t{b}{scaled}"),
                    };
                    self.lines.push(last);
                    self.loaded.push(3);
                    return;
                }
                9 => {
                    self.lines.push(format!("texkill t{n}"));
                    stage += 1;
                    continue;
                }
                10 => format!("texcoord t{n}"),
                11 => {
                    stage += 1;
                    continue;
                }
                _ => format!("tex t{n}"),
            };
            self.lines.push(line);
            self.loaded.push(n);
            stage += 1;
        }
    }

    /// Gives both temporaries a value.
    fn start(&mut self) {
        let first = match self.loaded.last() {
            Some(t) if self.r.one_in(2) => format!("t{t}"),
            _ => self.r.of(&["v0", "c0", "1-v1", "v1_bx2"]).to_owned(),
        };
        self.lines.push(format!("mov r0, {first}"));
        let second = match self.loaded.first() {
            Some(t) if self.r.one_in(2) => format!("t{t}_bx2"),
            _ => self.r.of(&["v0", "c1", "v0_bias", "v1"]).to_owned(),
        };
        self.lines.push(format!("mov r1, {second}"));
        if self.r.one_in(10) {
            self.lines.push("nop".to_owned());
        }
    }

    fn source(&mut self, alpha: bool) -> String {
        let register = match self.r.below(10) {
            0..=3 => format!("r{}", self.r.below(2)),
            4 | 5 => format!("c{}", self.r.below(8)),
            6 | 7 if !self.loaded.is_empty() => format!("t{}", self.loaded[self.r.below(self.loaded.len())]),
            _ => format!("v{}", self.r.below(2)),
        };
        let selector = match self.r.below(5) {
            0 => ".a",
            1 if alpha => ".b",
            _ => "",
        };
        let (before, after) = self.r.of(&MODIFIERS);
        format!("{before}{register}{after}{selector}")
    }

    fn arithmetic(&mut self) {
        let mask = self.r.of(&["", "", ".rgb", ".a"]);
        let line = self.one(mask, false);
        self.lines.push(line);
        let paired = self.lines.last().is_some_and(|l| !l.starts_with("dp4"));
        if mask == ".rgb" && paired && self.r.one_in(2) {
            let partner = self.one(".a", true);
            self.lines.push(format!("+{partner}"));
        }
    }

    fn one(&mut self, mask: &str, partner: bool) -> String {
        let later = self.version != Version::Ps1_1;
        let shift = self.r.of(&["", "", "", "_x2", "_x4", "_d2"]);
        let sat = self.r.of(&["", "", "_sat"]);
        let alpha = mask == ".a";
        let (a, b, c) = (self.source(alpha), self.source(alpha), self.source(alpha));
        let to = match self.loaded.last() {
            Some(t) if self.r.one_in(6) => format!("t{t}"),
            _ => format!("r{}", self.r.below(2)),
        };
        match self.r.below(13) {
            0 | 1 => format!("mul{shift}{sat} {to}{mask}, {a}, {b}"),
            2 | 3 => format!("mad{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
            4 => format!("add{shift}{sat} {to}{mask}, {a}, {b}"),
            5 => format!("sub{shift}{sat} {to}{mask}, {a}, {b}"),
            6 => format!("lrp{shift}{sat} {to}{mask}, {a}, {b}, {c}"),
            7 | 8 if !alpha => format!("dp3{shift}{sat} {to}{mask}, {a}, {b}"),
            9 => format!("cnd{shift}{sat} {to}{mask}, r0.a, {a}, {b}"),
            10 if later && self.cmps > 0 => {
                self.cmps -= 1;
                // The destination must not be a source, so a source that names it is replaced by v0.
                let free = |s: &str| !s.contains(&to);
                let or = |s: String| if free(&s) { s } else { "v0".to_owned() };
                format!("cmp{shift}{sat} {to}{mask}, {}, {}, {}", or(a), or(b), or(c))
            }
            11 if later && !partner && self.dp4s > 0 => {
                self.dp4s -= 1;
                format!("dp4{shift}{sat} {to}{mask}, {a}, {b}")
            }
            _ => format!("mov{shift}{sat} {to}{mask}, {a}"),
        }
    }
}

/// Source modifiers of every ps_1 version, as text before and after the register; unmodified four times in ten.
pub(super) const MODIFIERS: [(&str, &str); 10] = [
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
