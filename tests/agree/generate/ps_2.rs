//! Random programs of ps_2_0, ps_2_a and ps_2_b.

use super::{Layout, comparison, component, mask, swizzle, values};
use crate::random::Random;
use refsim::isa::Version;
use refsim::texture::TextureKind;

/// State of a program while it is written.
pub(super) struct Writer<'a> {
    pub(super) version: Version,
    pub(super) layout: &'a Layout,
    pub(super) r: &'a mut Random,
    pub(super) lines: &'a mut Vec<String>,
    /// Number of temporaries in use.
    pub(super) temps: usize,
    /// Number of coordinate sets declared.
    sets: usize,
    /// Number of subroutines that are called.
    pub(super) called: usize,
}

/// Restrictions by position in the program.
#[derive(Clone, Copy, Default)]
pub(super) struct Place {
    /// Inside flow control that may diverge: no gradients.
    pub(super) parted: bool,
}

pub(super) fn program(version: Version, layout: &Layout, size: usize, r: &mut Random, lines: &mut Vec<String>) {
    let temps = if size > 0 && r.one_in(4) { 4 + r.below(9) } else { 3 + r.below(4) };
    let sets = 4 + r.below(5);
    let mut w = Writer { version, layout, r, lines, temps, sets, called: 0 };
    w.declare();
    w.begin();
    if version == Version::Ps2A {
        let (a, b) = (w.r.below(temps), w.r.below(temps));
        let comparison = comparison(w.r);
        w.lines.push(format!("setp_{comparison} p0, r{a}, r{b}"));
        w.block(size, 0, Place::default());
    } else {
        let count = [2, 6, 14, 24][size.min(3)];
        for _ in 0..1 + w.r.below(count) {
            w.instruction(Place::default());
        }
    }
    w.outputs();
    w.subroutines();
}

impl Writer<'_> {
    fn declare(&mut self) {
        for t in 0..self.sets {
            let hint = self.r.of(&["", "", "", "_pp", "_centroid"]);
            self.lines.push(format!("dcl{hint} t{t}"));
        }
        for v in 0..2 {
            let hint = self.r.of(&["", "", "_pp"]);
            self.lines.push(format!("dcl{hint} v{v}"));
        }
        for &(slot, kind) in &self.layout.samplers {
            let right = match kind {
                TextureKind::Cube => "cube",
                TextureKind::Volume => "volume",
                _ => "2d",
            };
            let usage = if self.r.one_in(12) { self.r.of(&["2d", "cube", "volume"]) } else { right };
            self.lines.push(format!("dcl_{usage} s{slot}"));
        }
        let first = values(self.r, 2.0);
        self.lines.push(format!("def c0, {first}"));
        self.lines.push("def c6, -1.5500992e-6, -2.1701389e-5, 0.0026041667, 0.00026041668".to_owned());
        self.lines.push("def c7, -0.020833334, -0.125, 1.0, 0.5".to_owned());
        if self.version == Version::Ps2A {
            let (a, b) = (self.r.below(4), self.r.below(3));
            self.lines.push(format!("defi i0, {a}, 0, 1, 0"));
            if self.r.one_in(2) {
                self.lines.push(format!("defi i1, {b}, 0, 1, 0"));
            }
            if self.r.one_in(2) {
                let value = self.r.of(&["true", "false"]);
                self.lines.push(format!("defb b0, {value}"));
            }
        }
    }

    /// Gives every temporary a value.
    fn begin(&mut self) {
        for n in 0..self.temps {
            let from = match self.r.below(5) {
                0 => format!("v{}", self.r.below(2)),
                1 => format!("c{}", self.r.below(6)),
                2 if !self.layout.samplers.is_empty() => {
                    let line = format!("texld r{n}, t{}, s{}", self.r.below(self.sets), self.sampler());
                    self.lines.push(line);
                    continue;
                }
                _ => format!("t{}", self.r.below(self.sets)),
            };
            let pp = self.partial();
            self.lines.push(format!("mov{pp} r{n}, {from}"));
        }
    }

    fn outputs(&mut self) {
        let first = self.r.below(self.temps);
        for i in 0..self.layout.targets {
            self.lines.push(format!("mov oC{i}, r{}", (first + i) % self.temps));
        }
        if self.r.one_in(3) {
            let (n, c) = (self.r.below(self.temps), component(self.r));
            self.lines.push(format!("mov oDepth, r{n}.{c}"));
        }
    }

    pub(super) fn temp(&mut self) -> String {
        format!("r{}", self.r.below(self.temps))
    }

    pub(super) fn scalar(&mut self) -> String {
        let sign = self.r.of(&["", "", "-"]);
        let temp = self.temp();
        format!("{sign}{temp}.{}", component(self.r))
    }

    fn sampler(&mut self) -> usize {
        match self.layout.samplers.len() {
            0 => 0,
            n => self.layout.samplers[self.r.below(n)].0,
        }
    }

    fn partial(&mut self) -> &'static str {
        self.r.of(&["", "", "_pp"])
    }

    /// Text of a random source operand. An instruction may read one constant and one input only.
    fn source(&mut self, others: &mut usize) -> String {
        let negate = if self.r.one_in(4) { "-" } else { "" };
        let register = match self.r.below(14) {
            0..=2 if *others == 0 || !self.layout.limited => {
                *others += 1;
                let beyond = self.r.one_in(8);
                format!("c{}", self.r.below(if beyond { 12 } else { 8 }))
            }
            3 if *others == 0 => {
                *others += 1;
                format!("v{}", self.r.below(2))
            }
            4 if *others == 0 => {
                *others += 1;
                format!("t{}", self.r.below(self.sets))
            }
            _ => self.temp(),
        };
        let any = self.version == Version::Ps2A;
        format!("{negate}{register}{}", swizzle(self.r, any))
    }

    /// A temporary that is not in `not`.
    fn other(&mut self, not: &[&str]) -> String {
        for _ in 0..20 {
            let temp = self.temp();
            if !not.contains(&temp.as_str()) {
                return temp;
            }
        }
        (0..self.temps).map(|n| format!("r{n}")).find(|t| !not.contains(&t.as_str())).unwrap_or_default()
    }

    pub(super) fn instruction(&mut self, place: Place) {
        let predicate = match self.version == Version::Ps2A && self.r.one_in(6) {
            true => {
                let c = self.r.of(&["", ".x", ".y", ".z", ".w"]);
                format!("({}p0{c}) ", self.r.of(&["", "!"]))
            }
            false => String::new(),
        };
        let reading = self.layout.sampling && self.r.one_in(2);
        let line = match self.r.below(20) {
            _ if reading => self.texture(place),
            0..=10 => self.vector(),
            11 | 12 => self.one_component(),
            13..=15 => self.several_steps(),
            16 if self.version == Version::Ps2A && !place.parted => {
                let (to, mask) = (self.temp(), mask(self.r));
                let source = self.source(&mut 0);
                format!("{} {to}{mask}, {source}", self.r.of(&["dsx", "dsy"]))
            }
            17 if predicate.is_empty() && self.r.one_in(3) => {
                let from = if self.r.one_in(2) { "t3".to_owned() } else { self.temp() };
                format!("texkill {from}")
            }
            18 if predicate.is_empty() && self.r.one_in(4) => "nop".to_owned(),
            19 if self.version == Version::Ps2A && predicate.is_empty() => {
                let mask = mask(self.r);
                let (a, b) = (self.source(&mut 0), self.source(&mut 2));
                format!("setp_{} p0{mask}, {a}, {b}", comparison(self.r))
            }
            _ => self.texture(place),
        };
        self.lines.push(format!("{predicate}{line}"));
    }

    fn vector(&mut self) -> String {
        let (pp, sat) = (self.partial(), self.r.of(&["", "", "", "_sat"]));
        let (to, mask) = (self.temp(), mask(self.r));
        let others = &mut 0;
        let (x, y, z) = (self.source(others), self.source(others), self.source(others));
        match self.r.below(20) {
            0..=2 => format!("mul{pp}{sat} {to}{mask}, {x}, {y}"),
            3..=6 => format!("mad{pp}{sat} {to}{mask}, {x}, {y}, {z}"),
            7 | 8 => format!("add{pp}{sat} {to}{mask}, {x}, {y}"),
            9 => format!("sub{pp}{sat} {to}{mask}, {x}, {y}"),
            10 => format!("lrp{pp}{sat} {to}{mask}, {x}, {y}, {z}"),
            11 => format!("dp3{pp}{sat} {to}{mask}, {x}, {y}"),
            12 => format!("dp4{pp}{sat} {to}{mask}, {x}, {y}"),
            13 => {
                let scalar = self.scalar();
                format!("dp2add{pp}{sat} {to}{mask}, {x}, {y}, {scalar}")
            }
            14 => format!("cmp{pp}{sat} {to}{mask}, {x}, {y}, {z}"),
            15 => format!("min{pp}{sat} {to}{mask}, {x}, {y}"),
            16 => format!("max{pp}{sat} {to}{mask}, {x}, {y}"),
            17 => format!("abs{pp}{sat} {to}{mask}, {x}"),
            18 => format!("frc{pp} {to}{mask}, {x}"),
            _ => format!("mov{pp}{sat} {to}{mask}, {x}"),
        }
    }

    fn one_component(&mut self) -> String {
        let (pp, sat) = (self.partial(), self.r.of(&["", "", "_sat"]));
        let (to, mask) = (self.temp(), mask(self.r));
        let scalar = self.scalar();
        match self.r.below(5) {
            0 => {
                let power = self.scalar();
                format!("pow{pp}{sat} {to}{mask}, {scalar}, {power}")
            }
            k => format!("{}{pp}{sat} {to}{mask}, {scalar}", ["rcp", "rsq", "exp", "log"][k - 1]),
        }
    }

    /// An instruction that expands to several steps, whose destination may not be one of its sources.
    fn several_steps(&mut self) -> String {
        let (pp, sat) = (self.partial(), self.r.of(&["", "", "_sat"]));
        let from = self.temp();
        let to = self.other(&[&from]);
        match self.r.below(8) {
            0 | 1 => {
                let mask = self.r.of(&["", ".xyz"]);
                format!("nrm{pp}{sat} {to}{mask}, {}{from}{}", self.r.of(&["", "-"]), swizzle(self.r, false))
            }
            2 => {
                let second = if self.r.one_in(2) { format!("c{}", self.r.below(8)) } else { self.other(&[&to]) };
                let mask = self.r.of(&[".xyz", ".xyz", ".x", ".y", ".z", ".xy", ".xz", ".yz"]);
                format!("crs{pp}{sat} {to}{mask}, {from}, {second}")
            }
            3 => {
                let (a, b) = if self.r.one_in(4) { ("c1", "c2") } else { ("c6", "c7") };
                let mask = self.r.of(&[".xy", ".xy", ".x", ".y"]);
                format!("sincos{pp} {to}{mask}, {}{from}.{}, {a}, {b}", self.r.of(&["", "-"]), component(self.r))
            }
            k => {
                let (op, mask) = [("m3x2", ".xy"), ("m3x3", ".xyz"), ("m3x4", ""), ("m4x3", ".xyz"), ("m4x4", "")]
                    [if k == 7 { self.r.below(5) } else { k - 4 }];
                let rows = format!("c{}", self.r.below(5));
                format!("{op}{pp}{sat} {to}{mask}, {}{from}, {rows}", self.r.of(&["", "-"]))
            }
        }
    }

    fn texture(&mut self, place: Place) -> String {
        let pp = self.partial();
        let (to, slot) = (self.temp(), self.sampler());
        let set = format!("t{}", self.r.below(self.sets));
        if self.layout.samplers.is_empty() {
            return format!("mov{pp} {to}, {set}");
        }
        let any = self.version == Version::Ps2A;
        let temp = self.temp();
        let computed = if any && self.r.one_in(4) { format!("{temp}{}", swizzle(self.r, true)) } else { temp };
        let from = if place.parted || self.r.one_in(2) { set } else { computed };
        match self.r.below(6) {
            0..=2 => format!("texld{pp} {to}, {from}, s{slot}"),
            3 => format!("texldb{pp} {to}, {from}, s{slot}"),
            4 => format!("texldp{pp} {to}, {from}, s{slot}"),
            _ if any => {
                let (address, x, y) = (self.temp(), self.temp(), self.temp());
                let x = if self.r.one_in(3) { "c1".to_owned() } else { x };
                format!("texldd{pp} {to}, {address}, s{slot}, {x}, {y}")
            }
            _ => format!("texld{pp} {to}, {from}, s{slot}"),
        }
    }
}
