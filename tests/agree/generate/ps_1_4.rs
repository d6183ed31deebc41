//! Random programs of ps_1_4.

use super::ps_1::MODIFIERS;
use super::{Layout, values};
use crate::random::Random;

/// For each register, whether red, green and blue are written, and whether all four components are.
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

    /// A random register that is written, with its alpha if `alpha`; `None` if there is none.
    fn pick(&self, alpha: bool, r: &mut Random) -> Option<usize> {
        let list = if alpha { &self.all } else { &self.rgb };
        let ready: Vec<usize> = (0..6).filter(|&n| list[n]).collect();
        (!ready.is_empty()).then(|| ready[r.below(ready.len())])
    }
}

/// Position of an instruction in the program.
#[derive(Clone, Copy)]
struct Place {
    /// After `phase`, or in a program without one.
    second: bool,
    /// The second instruction of a pair.
    partner: bool,
}

pub(super) fn program(layout: &Layout, size: usize, r: &mut Random, lines: &mut Vec<String>) {
    for c in 0..r.below(3) {
        lines.push(format!("def c{c}, {}", values(r, 1.0)));
    }
    let most = [2, 4, 6, 8][size.min(3)];
    let mut w = Written::default();
    let two = !r.one_in(4);
    let mut projections = 2;
    if two {
        for n in 0..6 {
            read(layout, r, lines, n, &mut w, None, &mut projections);
        }
        for _ in 0..r.below(most) {
            arithmetic(r, lines, false, &mut w, &[]);
        }
        if r.one_in(4)
            && let (Some(a), Some(b)) = (w.pick(false, r), w.pick(false, r))
        {
            let to = r.below(6);
            lines.push(format!("bem r{to}.rg, r{a}, r{b}"));
        }
        lines.push("phase".to_owned());
        w.all = [false; 6];
    }
    second_phase(layout, r, lines, &mut w, (two, most), &mut projections);
}

fn second_phase(
    layout: &Layout,
    r: &mut Random,
    lines: &mut Vec<String>,
    w: &mut Written,
    (two, most): (bool, usize),
    projections: &mut usize,
) {
    let depth = two && w.rgb[5] && r.one_in(3);
    let before = *w;
    let mut addresses = before;
    for n in 0..if depth { 5 } else { 6 } {
        if !two || !r.one_in(3) {
            read(layout, r, lines, n, w, Some(&addresses), projections);
            // A register loaded in this phase cannot be an address within it.
            addresses.rgb[n] = false;
        }
    }
    if r.one_in(6) {
        lines.push(match w.pick(false, r) {
            Some(n) if two && r.one_in(2) => format!("texkill r{n}"),
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
        (Some(a), _) if r.one_in(2) => format!("mov r0.rgb, r{a}"),
        _ => format!("mov r0.rgb, {}", r.of(&["v0", "c0", "1-v1", "v1_bx2"])),
    });
    if r.one_in(10) {
        lines.push("nop".to_owned());
    }
    lines.push("mov r0.a, v1".to_owned());
    w.load(0, true);
    for _ in 0..r.below(most) {
        arithmetic(r, lines, true, w, if depth { &[5] } else { &[] });
    }
}

fn read(
    layout: &Layout,
    r: &mut Random,
    lines: &mut Vec<String>,
    n: usize,
    w: &mut Written,
    before: Option<&Written>,
    projections: &mut usize,
) {
    let set: usize = r.below(6);
    // A coordinate set must always have the same selector: even sets have .xyz, odd ones .xyw.
    let selector = if set.is_multiple_of(2) { "" } else { ".xyw" };
    let register = before.and_then(|b| b.pick(false, r));
    let kind = if layout.sampling { 3 + r.below(4) } else { r.below(9) };
    let (line, alpha) = match (kind, register) {
        (3, _) if set % 2 == 1 => (format!("texld r{n}, t{set}_dw.xyw"), true),
        (7, _) => (format!("texcrd r{n}.rgb, t{set}{selector}"), false),
        // Only .rg is written, so the whole register is no longer readable.
        (8, _) if set % 2 == 1 && !w.rgb[n] => {
            lines.push(format!("texcrd r{n}.rg, t{set}_dw.xyw"));
            return;
        }
        (2, Some(a)) => {
            let w_all = w.rgb[a];
            if !w_all {
                return;
            }
            (format!("texcrd r{n}.rgb, r{a}"), false)
        }
        (5, Some(a)) => (format!("texld r{n}, r{a}"), true),
        (6, Some(a)) if *projections > 0 => {
            *projections -= 1;
            (format!("texld r{n}, r{a}_dz"), true)
        }
        _ => (format!("texld r{n}, t{set}{selector}"), true),
    };
    lines.push(line);
    w.load(n, alpha);
}

fn arithmetic(r: &mut Random, lines: &mut Vec<String>, second: bool, w: &mut Written, dead: &[usize]) {
    let mask = r.of(&["", ".rgb", ".rgb", ".a", ".r", ".g", ".b", ".rg", ".ga", ".rb", ".gb", ".rga", ".gba"]);
    let before = *w;
    let line = one(r, mask, Place { second, partner: false }, &before, w, dead);
    let lone = line.starts_with("dp4");
    lines.push(line);
    if !mask.is_empty() && !mask.contains('a') && !lone && r.one_in(2) {
        let partner = one(r, ".a", Place { second, partner: true }, &before, w, dead);
        lines.push(format!("+{partner}"));
    }
}

fn source(r: &mut Random, second: bool, alpha: bool, w: &Written) -> String {
    let register = match (r.below(10), w.pick(alpha, r)) {
        (0..=6, Some(n)) => format!("r{n}"),
        (7 | 8, _) if second => format!("v{}", r.below(2)),
        _ => return format!("c{}{}", r.below(8), r.of(&["", "", ".r", ".g", ".b", ".a"])),
    };
    let selector = match r.below(5) {
        0 if alpha => ".a",
        1 => r.of(&[".r", ".g", ".b"]),
        _ => "",
    };
    let (before, after) = r.of(&MODIFIERS);
    let (before, after) = if after.is_empty() && r.one_in(5) { (r.of(&["", "-"]), "_x2") } else { (before, after) };
    format!("{before}{register}{after}{selector}")
}

fn one(r: &mut Random, mask: &str, place: Place, before: &Written, w: &mut Written, dead: &[usize]) -> String {
    let Place { second, partner } = place;
    let shift = r.of(&["", "", "", "_x2", "_x4", "_x8", "_d2", "_d4", "_d8"]);
    let sat = r.of(&["", "", "_sat"]);
    let wide = mask.is_empty() || mask.contains('a');
    let kind = r.below(12);
    let dot4 = kind == 10 && !partner;
    let mut s = || source(r, second, wide || dot4, before);
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
