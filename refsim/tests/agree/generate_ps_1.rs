//! Random programs of ps_1_1 to ps_1_4.

use crate::generate::def;
use crate::random::Random;
use refsim::isa::Version;

pub(crate) fn ps_1(version: Version, r: &mut Random, lines: &mut Vec<String>) {
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

pub(crate) fn ps_1_4(r: &mut Random, lines: &mut Vec<String>) {
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
