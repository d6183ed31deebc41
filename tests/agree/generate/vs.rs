//! Random programs of vs_1_1 and vs_2_0.

use super::{Layout, component, mask, swizzle, values};
use crate::random::Random;
use refsim::isa::Version;

/// State of a program while it is written.
struct Writer<'a> {
    two: bool,
    limited: bool,
    temps: usize,
    /// Number of attributes declared.
    inputs: usize,
    /// Number of flow control instructions still allowed.
    flow: usize,
    called: bool,
    r: &'a mut Random,
    lines: &'a mut Vec<String>,
}

pub(super) fn program(version: Version, layout: &Layout, size: usize, r: &mut Random, lines: &mut Vec<String>) {
    let temps = 3 + r.below(if size > 1 { 9 } else { 4 });
    let inputs = 4 + r.below(4);
    let two = version == Version::Vs2_0;
    let mut w = Writer { two, limited: layout.limited, temps, inputs, flow: 12, called: false, r, lines };
    w.declare();
    for n in 0..temps {
        let v = 1 + w.r.below(inputs - 1);
        w.lines.push(format!("mov r{n}, v{v}"));
    }
    w.address();
    let count = [2, 6, 12, 20][size.min(3)];
    for _ in 0..1 + w.r.below(count) {
        if two && w.flow > 3 && w.r.one_in(8) {
            w.flow_control(0);
        } else {
            w.instruction(false);
        }
    }
    w.outputs();
    if w.called {
        w.lines.extend(["ret", "label l0"].map(str::to_owned));
        for _ in 0..1 + w.r.below(3) {
            w.instruction(false);
        }
        w.lines.push("ret".to_owned());
    }
}

impl Writer<'_> {
    fn declare(&mut self) {
        let usages = ["position", "texcoord0", "texcoord1", "color0", "normal", "tangent", "blendweight", "binormal"];
        for (n, usage) in usages.iter().take(self.inputs).enumerate() {
            self.lines.push(format!("dcl_{usage} v{n}"));
        }
        let first = values(self.r, 2.0);
        self.lines.push(format!("def c0, {first}"));
        if self.two {
            self.lines.push("def c6, -1.5500992e-6, -2.1701389e-5, 0.0026041667, 0.00026041668".to_owned());
            self.lines.push("def c7, -0.020833334, -0.125, 1.0, 0.5".to_owned());
            let count = self.r.below(4);
            let (start, step) = (self.r.below(4), self.r.below(3));
            self.lines.push(format!("defi i0, {count}, {start}, {step}, 0"));
            if self.r.one_in(2) {
                let value = self.r.of(&["true", "false"]);
                self.lines.push(format!("defb b0, {value}"));
            }
        }
    }

    fn address(&mut self) {
        let temp = self.temp();
        self.lines.push(match self.two {
            true => format!("mova a0, {temp}{}", swizzle(self.r, true)),
            false => format!("mov a0.x, {temp}.{}", component(self.r)),
        });
    }

    fn temp(&mut self) -> String {
        format!("r{}", self.r.below(self.temps))
    }

    fn scalar(&mut self) -> String {
        let (sign, temp) = (self.r.of(&["", "", "-"]), self.temp());
        format!("{sign}{temp}.{}", component(self.r))
    }

    fn relative(&mut self, in_loop: bool) -> String {
        let offset = self.r.below(6);
        match self.r.below(3) {
            0 if in_loop => format!("c[aL + {offset}]"),
            1 if self.two => format!("c[a0.{} + {offset}]", component(self.r)),
            _ => format!("c[a0.x + {offset}]"),
        }
    }

    fn source(&mut self, others: &mut usize, in_loop: bool) -> String {
        let negate = if self.r.one_in(4) { "-" } else { "" };
        let register = match self.r.below(12) {
            0 | 1 if *others == 0 || !self.limited => {
                *others += 1;
                format!("c{}", self.r.below(10))
            }
            2 | 3 if *others == 0 || !self.limited => {
                *others += 1;
                self.relative(in_loop)
            }
            4 if *others == 0 => {
                *others += 1;
                format!("v{}", self.r.below(self.inputs))
            }
            _ => self.temp(),
        };
        format!("{negate}{register}{}", swizzle(self.r, true))
    }

    fn other(&mut self, not: &[&str]) -> String {
        for _ in 0..20 {
            let temp = self.temp();
            if !not.contains(&temp.as_str()) {
                return temp;
            }
        }
        (0..self.temps).map(|n| format!("r{n}")).find(|t| !not.contains(&t.as_str())).unwrap_or_default()
    }

    /// A destination: a temporary, or sometimes an output other than the position.
    fn destination(&mut self) -> String {
        match self.r.below(12) {
            0 => format!("oT{}{}", self.r.below(8), mask(self.r)),
            1 => format!("oD{}{}", self.r.below(2), mask(self.r)),
            2 if self.r.one_in(4) => format!("{}{}", self.r.of(&["oFog", "oPts"]), self.r.of(&["", ".x"])),
            _ => format!("{}{}", self.temp(), mask(self.r)),
        }
    }

    fn flow_control(&mut self, depth: usize) {
        self.flow -= 2;
        let kind = if depth == 0 { self.r.below(5) } else { self.r.below(2) };
        let close = match kind {
            0 | 1 => {
                let line = format!("if {}b{}", self.r.of(&["", "!"]), self.r.below(2));
                self.lines.push(line);
                self.instruction(depth > 0);
                if self.r.one_in(2) {
                    self.lines.push("else".to_owned());
                    self.instruction(depth > 0);
                }
                "endif"
            }
            2 => {
                self.lines.push("rep i0".to_owned());
                "endrep"
            }
            3 => {
                let count = self.r.below(2);
                self.lines.push(format!("loop aL, i{count}"));
                self.instruction(true);
                if self.r.one_in(3) && self.flow > 3 {
                    self.flow_control(1);
                }
                "endloop"
            }
            _ => {
                self.called = true;
                let line = match self.r.below(2) {
                    0 => "call l0".to_owned(),
                    _ => format!("callnz l0, {}b{}", self.r.of(&["", "!"]), self.r.below(2)),
                };
                self.lines.push(line);
                return;
            }
        };
        self.instruction(close == "endloop");
        self.lines.push(close.to_owned());
    }

    fn instruction(&mut self, in_loop: bool) {
        let line = match self.r.below(10) {
            0..=4 => self.vector(in_loop),
            5 | 6 => self.one_component(),
            7 | 8 => self.several_steps(in_loop),
            _ if self.r.one_in(2) => {
                self.address();
                return;
            }
            _ => "nop".to_owned(),
        };
        self.lines.push(line);
    }

    fn vector(&mut self, in_loop: bool) -> String {
        let to = self.destination();
        let others = &mut 0;
        let mut s = || self.source(others, in_loop);
        let (x, y, z) = (s(), s(), s());
        match self.r.below(19) {
            0 | 1 => format!("mul {to}, {x}, {y}"),
            2..=4 => format!("mad {to}, {x}, {y}, {z}"),
            5 => format!("add {to}, {x}, {y}"),
            6 => format!("sub {to}, {x}, {y}"),
            7 => format!("dp3 {to}, {x}, {y}"),
            8 => format!("dp4 {to}, {x}, {y}"),
            9 => format!("{} {to}, {x}, {y}", self.r.of(&["sge", "slt"])),
            10 => format!("{} {to}, {x}, {y}", self.r.of(&["min", "max"])),
            11 => format!("lit {to}, {x}"),
            12 => format!("dst {to}, {x}, {y}"),
            13 if self.two => format!("frc {to}, {x}"),
            13 => {
                let temp = self.temp();
                format!("frc {temp}{}, {x}", self.r.of(&[".xy", ".y"]))
            }
            14 if self.two => format!("lrp {to}, {x}, {y}, {z}"),
            15 if self.two => format!("abs {to}, {x}"),
            _ => format!("mov {to}, {x}"),
        }
    }

    fn one_component(&mut self) -> String {
        let to = self.destination();
        let scalar = self.scalar();
        let op = self.r.of(&["rcp", "rsq", "exp", "log", "expp", "logp", "pow"]);
        match op {
            "pow" if self.two => {
                let power = self.scalar();
                format!("pow {to}, {scalar}, {power}")
            }
            "pow" => format!("rcp {to}, {scalar}"),
            _ => format!("{op} {to}, {scalar}"),
        }
    }

    fn several_steps(&mut self, in_loop: bool) -> String {
        let from = self.temp();
        let to = self.other(&[&from]);
        let sign = self.r.of(&["", "-"]);
        match self.r.below(9) {
            0 if self.two => format!("nrm {to}{}, {sign}{from}{}", self.r.of(&["", ".xyz"]), swizzle(self.r, true)),
            1 if self.two => {
                let second = self.other(&[&to]);
                format!("crs {to}{}, {sign}{from}, {second}", self.r.of(&[".xyz", ".x", ".y", ".z", ".xz"]))
            }
            2 if self.two => {
                let scratch = self.other(&[&to, &from]);
                format!("sgn {to}{}, {sign}{from}, {scratch}, {}", mask(self.r), self.other(&[&to, &from, &scratch]))
            }
            3 if self.two => {
                let m = self.r.of(&[".xy", ".x", ".y"]);
                format!("sincos {to}{m}, {sign}{from}.{}, c6, c7", component(self.r))
            }
            k => {
                let (op, mask) =
                    [("m3x2", ".xy"), ("m3x3", ".xyz"), ("m3x4", ""), ("m4x3", ".xyz"), ("m4x4", "")][k % 5];
                let rows = if self.r.one_in(4) { self.relative(in_loop) } else { format!("c{}", self.r.below(6)) };
                format!("{op} {to}{mask}, {sign}{from}, {rows}")
            }
        }
    }

    fn outputs(&mut self) {
        // The position stays near the attribute, so that triangles stay in view.
        let position = self.r.of(&["mov oPos, v0", "m4x4 oPos, v0, c8", "mad oPos, r0, c5, v0"]);
        self.lines.push(position.to_owned());
        for t in 0..8 {
            if !self.r.one_in(4) {
                let temp = self.temp();
                self.lines.push(format!("mov oT{t}{}, {temp}", mask(self.r)));
            }
        }
        let (a, b) = (self.temp(), self.temp());
        self.lines.push(format!("mov oD0, {a}"));
        self.lines.push(format!("mov oD1, {b}"));
    }
}
