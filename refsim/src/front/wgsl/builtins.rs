//! Arithmetic and builtin functions, each by its formula of the WGSL specification, one rounding a step; docs/wgsl.md
//! has the table.

use naga::MathFunction as F;

use super::super::Refusal;
use super::builder::Builder;
use super::values::{Component, Value};
use crate::isa::{Modifier, Opcode};

type Result<T = Value> = std::result::Result<T, Refusal>;

fn number(value: f32) -> Value {
    vec![Component::Float(value.to_bits())]
}

impl Builder {
    fn add(&mut self, a: &[Component], b: &[Component]) -> Result {
        self.op(Opcode::Add, &[a, b])
    }

    pub(super) fn sub(&mut self, a: &[Component], b: &[Component]) -> Result {
        self.op(Opcode::Sub, &[a, b])
    }

    pub(super) fn mul(&mut self, a: &[Component], b: &[Component]) -> Result {
        self.op(Opcode::Mul, &[a, b])
    }

    fn min(&mut self, a: &[Component], b: &[Component]) -> Result {
        self.op(Opcode::Min, &[a, b])
    }

    fn max(&mut self, a: &[Component], b: &[Component]) -> Result {
        self.op(Opcode::Max, &[a, b])
    }

    /// `a` times the reciprocal of `b`.
    pub(super) fn divide(&mut self, a: &[Component], b: &[Component]) -> Result {
        let reciprocal = self.op(Opcode::Rcp, &[b])?;
        match *a == *number(1.0) {
            true => Ok(reciprocal),
            false => self.mul(a, &reciprocal),
        }
    }

    /// `a - b trunc(a / b)`
    pub(super) fn remainder(&mut self, a: &[Component], b: &[Component]) -> Result {
        let quotient = self.divide(a, b)?;
        let whole = self.trunc(&quotient)?;
        let product = self.mul(b, &whole)?;
        self.sub(a, &product)
    }

    fn absolute(&mut self, a: &[Component]) -> Result {
        self.modified(Opcode::Mov, &[(a, Modifier::Absolute)], a.len())
    }

    fn trunc(&mut self, a: &[Component]) -> Result {
        let magnitude = self.modified(Opcode::Flr, &[(a, Modifier::Absolute)], a.len())?;
        let negative = self.op(Opcode::Slt, &[a, &number(0.0)])?;
        let below = self.negate(&magnitude)?;
        self.select(&negative, &below, &magnitude)
    }

    fn ceil(&mut self, a: &[Component]) -> Result {
        let below = self.modified(Opcode::Flr, &[(a, Modifier::Negate)], a.len())?;
        self.negate(&below)
    }

    /// The nearest whole number, of two the even one.
    fn round(&mut self, a: &[Component]) -> Result {
        let (below, fraction) = (self.op(Opcode::Flr, &[a])?, self.op(Opcode::Frc, &[a])?);
        let above = self.add(&below, &number(1.0))?;
        let half_of = self.mul(&below, &number(0.5))?;
        let odd = self.op(Opcode::Frc, &[&half_of])?;
        let (more, tie) =
            (self.op(Opcode::Sgt, &[&fraction, &number(0.5)])?, self.op(Opcode::Seq, &[&fraction, &number(0.5)])?);
        let tie_up = self.op(Opcode::Min, &[&tie, &odd])?;
        let up = self.max(&more, &tie_up)?;
        self.select(&up, &above, &below)
    }

    pub(super) fn dot(&mut self, a: &[Component], b: &[Component]) -> Result {
        match a.len() {
            3 => self.wide(Opcode::Dp3, &[a, b], 1),
            4 => self.wide(Opcode::Dp4, &[a, b], 1),
            _ => {
                let products = self.mul(a, b)?;
                self.add(&products[..1], &products[products.len() - 1..])
            }
        }
    }

    fn sqrt(&mut self, a: &[Component]) -> Result {
        let inverse = self.op(Opcode::Rsq, &[a])?;
        self.op(Opcode::Rcp, &[&inverse])
    }

    fn length(&mut self, a: &[Component]) -> Result {
        if a.len() == 1 {
            return self.absolute(a);
        }
        let squared = self.dot(a, a)?;
        self.sqrt(&squared)
    }

    fn cross(&mut self, a: &[Component], b: &[Component]) -> Result {
        let turned = |v: &[Component], order: [usize; 3]| -> Value { order.map(|i| v[i]).to_vec() };
        let (next, last) = ([1, 2, 0], [2, 0, 1]);
        let plus = self.mul(&turned(a, next), &turned(b, last))?;
        let minus = self.mul(&turned(a, last), &turned(b, next))?;
        self.sub(&plus, &minus)
    }

    fn clamp(&mut self, a: &[Component], low: &[Component], high: &[Component]) -> Result {
        let raised = self.max(a, low)?;
        self.min(&raised, high)
    }

    fn mix(&mut self, a: &[Component], b: &[Component], t: &[Component]) -> Result {
        let rest = self.sub(&number(1.0), t)?;
        let (first, second) = (self.mul(a, &rest)?, self.mul(b, t)?);
        self.add(&first, &second)
    }

    fn smoothstep(&mut self, low: &[Component], high: &[Component], x: &[Component]) -> Result {
        let (above, range) = (self.sub(x, low)?, self.sub(high, low)?);
        let ratio = self.divide(&above, &range)?;
        let t = self.clamp(&ratio, &number(0.0), &number(1.0))?;
        let twice = self.mul(&t, &number(2.0))?;
        let rest = self.sub(&number(3.0), &twice)?;
        let square = self.mul(&t, &t)?;
        self.mul(&square, &rest)
    }

    fn pow(&mut self, x: &[Component], y: &[Component]) -> Result {
        let log = self.op(Opcode::Log, &[x])?;
        let product = self.mul(y, &log)?;
        self.op(Opcode::Exp, &[&product])
    }

    fn sign(&mut self, a: &[Component]) -> Result {
        let above = self.op(Opcode::Sgt, &[a, &number(0.0)])?;
        let below = self.op(Opcode::Slt, &[a, &number(0.0)])?;
        self.sub(&above, &below)
    }

    /// `a - 2 dot(n, a) n`
    fn reflect(&mut self, a: &[Component], n: &[Component]) -> Result {
        let projection = self.dot(n, a)?;
        let twice = self.mul(&projection, &number(2.0))?;
        let away = self.mul(&twice, n)?;
        self.sub(a, &away)
    }

    /// `k = 1 - r r (1 - d d)` with `d = dot(n, a)`; where `k >= 0`, `r a - (r d + sqrt(k)) n`, elsewhere 0.
    fn refract(&mut self, a: &[Component], n: &[Component], ratio: &[Component]) -> Result {
        let d = self.dot(n, a)?;
        let square = self.mul(&d, &d)?;
        let sine = self.sub(&number(1.0), &square)?;
        let ratio_square = self.mul(ratio, ratio)?;
        let bent = self.mul(&ratio_square, &sine)?;
        let k = self.sub(&number(1.0), &bent)?;
        let root = self.sqrt(&k)?;
        let along = self.mul(ratio, &d)?;
        let sum = self.add(&along, &root)?;
        let (first, second) = (self.mul(ratio, a)?, self.mul(&sum, n)?);
        let bent = self.sub(&first, &second)?;
        let passes = self.op(Opcode::Sge, &[&k, &number(0.0)])?;
        self.select(&passes, &bent, &vec![Component::Float(0); a.len()])
    }

    /// A builtin function.
    pub(super) fn math(&mut self, function: F, arguments: &[Value]) -> Result {
        if let Some(known) = whole(function, arguments) {
            return Ok(known);
        }
        if arguments.iter().flatten().any(|c| matches!(c, Component::Int(_) | Component::Unknown)) {
            return self.refuse(format!("`{}` of whole numbers is not translated", name(function)));
        }
        let scaled = |this: &mut Self, a: &Value, factor: f32| this.mul(a, &number(factor));
        match (function, arguments) {
            (F::Abs, [a]) => self.absolute(a),
            (F::Min, [a, b]) => self.min(a, b),
            (F::Max, [a, b]) => self.max(a, b),
            (F::Clamp, [a, low, high]) => self.clamp(a, low, high),
            (F::Saturate, [a]) => self.clamp(a, &number(0.0), &number(1.0)),
            (F::Cos, [a]) => self.op(Opcode::Cos, &[a]),
            (F::Sin, [a]) => self.op(Opcode::Sin, &[a]),
            (F::Tan, [a]) => {
                let (sine, cosine) = (self.op(Opcode::Sin, &[a])?, self.op(Opcode::Cos, &[a])?);
                self.divide(&sine, &cosine)
            }
            (F::Radians, [a]) => scaled(self, a, std::f32::consts::PI / 180.0),
            (F::Degrees, [a]) => scaled(self, a, 180.0 / std::f32::consts::PI),
            (F::Ceil, [a]) => self.ceil(a),
            (F::Floor, [a]) => self.op(Opcode::Flr, &[a]),
            (F::Round, [a]) => self.round(a),
            (F::Fract, [a]) => self.op(Opcode::Frc, &[a]),
            (F::Trunc, [a]) => self.trunc(a),
            (F::Exp, [a]) => {
                let power = scaled(self, a, std::f32::consts::LOG2_E)?;
                self.op(Opcode::Exp, &[&power])
            }
            (F::Exp2, [a]) => self.op(Opcode::Exp, &[a]),
            (F::Log, [a]) => {
                let log = self.op(Opcode::Log, &[a])?;
                scaled(self, &log, std::f32::consts::LN_2)
            }
            (F::Log2, [a]) => self.op(Opcode::Log, &[a]),
            (F::Pow, [x, y]) => self.pow(x, y),
            (F::Dot, [a, b]) => self.dot(a, b),
            (F::Cross, [a, b]) => self.cross(a, b),
            (F::Distance, [a, b]) => {
                let between = self.sub(a, b)?;
                self.length(&between)
            }
            (F::Length, [a]) => self.length(a),
            (F::Normalize, [a]) => {
                let squared = self.dot(a, a)?;
                let inverse = self.op(Opcode::Rsq, &[&squared])?;
                self.mul(a, &inverse)
            }
            (F::FaceForward, [n, i, reference]) => {
                let projection = self.dot(reference, i)?;
                let against = self.op(Opcode::Slt, &[&projection, &number(0.0)])?;
                let turned = self.negate(n)?;
                self.select(&against, n, &turned)
            }
            (F::Reflect, [a, n]) => self.reflect(a, n),
            (F::Refract, [a, n, ratio]) => self.refract(a, n, ratio),
            (F::Sign, [a]) => self.sign(a),
            (F::Fma, [a, b, c]) => self.op(Opcode::Mad, &[a, b, c]),
            (F::Mix, [a, b, t]) => self.mix(a, b, t),
            (F::Step, [edge, x]) => self.op(Opcode::Sge, &[x, edge]),
            (F::SmoothStep, [low, high, x]) => self.smoothstep(low, high, x),
            (F::Sqrt, [a]) => self.sqrt(a),
            (F::InverseSqrt, [a]) => self.op(Opcode::Rsq, &[a]),
            (F::QuantizeToF16, [a]) => {
                let half = std::mem::replace(&mut self.half, true);
                let rounded = self.op(Opcode::Mov, &[a]);
                self.half = half;
                rounded
            }
            _ => self.refuse(format!("`{}` is not translated", name(function))),
        }
    }
}

/// A function of whole numbers that are known.
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
            (F::Abs, [a]) => a.abs(),
            (F::Sign, [a]) => a.signum(),
            _ => return None,
        };
        Some(Component::Int(value))
    };
    (0..arguments.first()?.len()).map(column).collect()
}

/// The name in the text, which differs from naga's in its first letter, as far as messages need it.
fn name(function: F) -> String {
    let mut name = format!("{function:?}");
    name[..1].make_ascii_lowercase();
    name
}
