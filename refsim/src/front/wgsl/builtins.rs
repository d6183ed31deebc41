//! Arithmetic and builtin functions, each computed by its formula in the WGSL specification, with one rounding per
//! step; docs/wgsl.md has the table.

use naga::MathFunction as F;

use super::super::Refusal;
use super::builder::Builder;
use super::values::{Component, Value};
use crate::isa::{Modifier, Opcode};

type Result<T = Value> = std::result::Result<T, Refusal>;

/// Functions that map to a single instruction.
const OPERATIONS: [(&str, Opcode); 15] = [
    ("min", Opcode::Min),
    ("max", Opcode::Max),
    ("floor", Opcode::Flr),
    ("fract", Opcode::Frc),
    ("sin", Opcode::Sin),
    ("cos", Opcode::Cos),
    ("exp2", Opcode::Exp),
    ("log2", Opcode::Log),
    ("inverseSqrt", Opcode::Rsq),
    ("fma", Opcode::Mad),
    ("less", Opcode::Slt),
    ("greater", Opcode::Sgt),
    ("equal", Opcode::Seq),
    // `step(edge, x)` is 1 for `x >= edge`.
    ("step", Opcode::Sle),
    ("rcp", Opcode::Rcp),
];

/// Functions defined by formulas. A formula uses the arguments `a`, `b`, `c`, names defined before an `=`, and other
/// functions.
const FORMULAS: [(&str, &str); 23] = [
    ("remainder", "a - b * trunc(a / b)"),
    ("clamp", "min(max(a, b), c)"),
    ("saturate", "min(max(a, 0), 1)"),
    ("ceil", "-floor(-a)"),
    ("trunc", "m = floor(abs(a)); select(less(a, 0), -m, m)"),
    // Ties round to the even integer.
    ("round", "n = floor(a); f = fract(a); select(max(greater(f, 0.5), min(equal(f, 0.5), fract(n * 0.5))), n + 1, n)"),
    ("sign", "greater(a, 0) - less(a, 0)"),
    ("mix", "a * (1 - c) + b * c"),
    ("smoothStep", "t = clamp((c - a) / (b - a), 0, 1); t * t * (3 - t * 2)"),
    ("sqrt", "rcp(inverseSqrt(a))"),
    ("exp", "exp2(a * 1.442695040888963407)"),
    ("log", "log2(a) * 0.693147180559945309"),
    ("pow", "exp2(b * log2(a))"),
    ("tan", "sin(a) / cos(a)"),
    ("radians", "a * 0.017453292519943295474"),
    ("degrees", "a * 57.295779513082322865"),
    ("cross", "turn(a) * turn(turn(b)) - turn(turn(a)) * turn(b)"),
    ("length", "sqrt(dot(a, a))"),
    ("distance", "length(a - b)"),
    ("normalize", "a * inverseSqrt(dot(a, a))"),
    ("faceForward", "select(less(dot(c, b), 0), a, -a)"),
    ("reflect", "a - dot(b, a) * 2 * b"),
    ("refract", "d = dot(b, a); k = 1 - c * c * (1 - d * d); select(step(0, k), c * a - (c * d + sqrt(k)) * b, 0)"),
];

/// A formula that is being translated into instructions; `rest` is the part not yet parsed.
struct Formula<'a> {
    builder: &'a mut Builder,
    rest: &'static str,
    names: Vec<(&'static str, Value)>,
}

impl Formula<'_> {
    /// Consumes a mark if it comes next.
    fn accepts(&mut self, mark: char) -> bool {
        let rest = self.rest.trim_start().strip_prefix(mark);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self) -> Result {
        let mut value = self.product()?;
        loop {
            let opcode = if self.accepts('+') {
                Opcode::Add
            } else if self.accepts('-') {
                Opcode::Sub
            } else {
                return Ok(value);
            };
            let right = self.product()?;
            value = self.builder.op(opcode, &[&value, &right])?;
        }
    }

    fn product(&mut self) -> Result {
        let mut value = self.factor()?;
        loop {
            value = if self.accepts('*') {
                let right = self.factor()?;
                self.builder.mul(&value, &right)?
            } else if self.accepts('/') {
                let right = self.factor()?;
                self.builder.divide(&value, &right)?
            } else {
                return Ok(value);
            };
        }
    }

    fn factor(&mut self) -> Result {
        if self.accepts('-') {
            let value = self.factor()?;
            return self.builder.negate(&value);
        }
        if self.accepts('(') {
            let value = self.sum()?;
            self.accepts(')');
            return Ok(value);
        }
        let rest = self.rest.trim_start();
        let (word, rest) = rest.split_at(rest.find(|c: char| !(c.is_alphanumeric() || c == '.')).unwrap_or(rest.len()));
        self.rest = rest;
        if let Ok(number) = word.parse::<f32>() {
            return Ok(vec![Component::Float(number.to_bits())]);
        }
        if !self.accepts('(') {
            let known = self.names.iter().find(|(name, _)| *name == word);
            return Ok(known.map(|(_, value)| value.clone()).unwrap_or_default());
        }
        let mut arguments = vec![self.sum()?];
        while self.accepts(',') {
            arguments.push(self.sum()?);
        }
        self.accepts(')');
        self.builder.function(word, &arguments)
    }
}

impl Builder {
    pub(super) fn mul(&mut self, a: &[Component], b: &[Component]) -> Result {
        self.op(Opcode::Mul, &[a, b])
    }

    /// Multiplies `a` by the reciprocal of `b`.
    pub(super) fn divide(&mut self, a: &[Component], b: &[Component]) -> Result {
        let reciprocal = self.op(Opcode::Rcp, &[b])?;
        match a {
            [Component::Float(bits)] if f32::from_bits(*bits) == 1.0 => Ok(reciprocal),
            _ => self.mul(a, &reciprocal),
        }
    }

    pub(super) fn dot(&mut self, a: &[Component], b: &[Component]) -> Result {
        match a.len() {
            3 => self.wide(Opcode::Dp3, &[a, b], 1),
            4 => self.wide(Opcode::Dp4, &[a, b], 1),
            _ => {
                let products = self.mul(a, b)?;
                self.op(Opcode::Add, &[&products[..1], &products[products.len() - 1..]])
            }
        }
    }

    /// Emits a function of numbers, given by its name.
    pub(super) fn function(&mut self, name: &str, arguments: &[Value]) -> Result {
        if let Some((_, opcode)) = OPERATIONS.iter().find(|(known, _)| *known == name) {
            let operands: Vec<&[Component]> = arguments.iter().map(Vec::as_slice).collect();
            return self.op(*opcode, &operands);
        }
        match (name, arguments) {
            ("dot", [a, b]) => self.dot(a, b),
            ("turn", [a]) => Ok([1, 2, 0].map(|lane: usize| a[lane]).to_vec()),
            ("select", [condition, accept, reject]) => {
                let reject: Value = (0..accept.len()).map(|lane| reject[lane.min(reject.len() - 1)]).collect();
                self.select(condition, accept, &reject)
            }
            ("length", [a]) | ("abs", [a]) if name == "abs" || a.len() == 1 => {
                self.modified(Opcode::Mov, &[(a, Modifier::Absolute)], a.len())
            }
            ("quantizeToF16", [a]) => {
                let half = std::mem::replace(&mut self.half, true);
                let rounded = self.op(Opcode::Mov, &[a]);
                self.half = half;
                rounded
            }
            _ => {
                let Some((_, text)) = FORMULAS.iter().find(|(known, _)| *known == name) else {
                    return self.refuse(format!("`{name}` is not translated"));
                };
                let names = ["a", "b", "c"].into_iter().zip(arguments.iter().cloned()).collect();
                let mut formula = Formula { builder: self, rest: "", names };
                let mut value = Value::new();
                for part in text.split("; ") {
                    let (name, part) = part.split_once(" = ").unwrap_or(("", part));
                    formula.rest = part;
                    value = formula.sum()?;
                    formula.names.push((name, value.clone()));
                }
                Ok(value)
            }
        }
    }

    pub(super) fn math(&mut self, function: F, arguments: &[Value]) -> Result {
        if let Some(known) = whole(function, arguments) {
            return Ok(known);
        }
        // The function's name in the text; it differs from naga's name in the first letter (accurate enough for
        // messages).
        let mut name = format!("{function:?}");
        name[..1].make_ascii_lowercase();
        if arguments.iter().flatten().any(|c| matches!(c, Component::Int(_) | Component::Unknown)) {
            return self.refuse(format!("`{name}` of whole numbers is not translated"));
        }
        self.function(&name, arguments)
    }
}

/// Evaluates a function of whole numbers that are known at translation.
fn whole(function: F, arguments: &[Value]) -> Option<Value> {
    let column = |lane: usize| {
        let at = |argument: &Value| match argument.get(lane) {
            Some(Component::Int(value)) => Some(*value),
            _ => None,
        };
        let all: Option<Vec<i64>> = arguments.iter().map(at).collect();
        let all = all?;
        let value = match (function, &all[..]) {
            (F::Min, [a, b]) => *a.min(b),
            (F::Max, [a, b]) => *a.max(b),
            (F::Clamp, [a, low, high]) => *a.max(low).min(high),
            // The smallest i32 is unchanged, because its magnitude exceeds every i32 (WGSL, `abs`).
            (F::Abs, [a]) if *a == i32::MIN.into() => *a,
            (F::Abs, [a]) => a.abs(),
            (F::Sign, [a]) => a.signum(),
            _ => return None,
        };
        Some(Component::Int(value))
    };
    (0..arguments.first()?.len()).map(column).collect()
}
