//! Operators, conversions and derivatives of values.

use naga::{
    BinaryOperator as B, DerivativeAxis, RelationalFunction, Scalar, ScalarKind, TypeInner, UnaryOperator, VectorSize,
};

use super::super::Refusal;
use super::translator::Translator;
use super::values::{Component, Value, is_half, scalar};
use crate::isa::{Modifier, Opcode};

type Result<T = Value> = std::result::Result<T, Refusal>;

/// Operators on numbers, their spelling in texts, and the opcode of each that is a single instruction.
const OPERATORS: [(B, &str, Option<Opcode>); 11] = [
    (B::Add, "+", Some(Opcode::Add)),
    (B::Subtract, "-", Some(Opcode::Sub)),
    (B::Multiply, "*", Some(Opcode::Mul)),
    (B::Divide, "/", None),
    (B::Modulo, "%", None),
    (B::Equal, "==", Some(Opcode::Seq)),
    (B::NotEqual, "!=", Some(Opcode::Sne)),
    (B::Less, "<", Some(Opcode::Slt)),
    (B::LessEqual, "<=", Some(Opcode::Sle)),
    (B::Greater, ">", Some(Opcode::Sgt)),
    (B::GreaterEqual, ">=", Some(Opcode::Sge)),
];

/// Spelling of an operator in texts; empty for operators on conditions and bits.
pub(super) fn symbol(operator: B) -> &'static str {
    OPERATORS.iter().find(|(known, ..)| *known == operator).map_or("", |(_, symbol, _)| symbol)
}

impl Translator<'_> {
    pub(super) fn unary(&mut self, operator: UnaryOperator, value: &[Component]) -> Result {
        match (operator, value) {
            (UnaryOperator::LogicalNot, _) => value.iter().map(|c| self.builder.not(*c)).collect(),
            (UnaryOperator::Negate, [Component::Int(_), ..]) => {
                let zeros = vec![Component::Int(0); value.len()];
                self.whole(B::Subtract, &zeros, value, ScalarKind::Sint)
            }
            (UnaryOperator::Negate, [Component::Unknown, ..]) => self.builder.unknown(),
            (UnaryOperator::Negate, _) => self.builder.negate(value),
            _ => self.builder.refuse("bit operations are not translated"),
        }
    }

    pub(super) fn derivative(&mut self, axis: DerivativeAxis, value: &[Component]) -> Result {
        match axis {
            DerivativeAxis::X => self.builder.op(Opcode::Dsx, &[value]),
            DerivativeAxis::Y => self.builder.op(Opcode::Dsy, &[value]),
            DerivativeAxis::Width => {
                let (x, y) = (self.builder.op(Opcode::Dsx, &[value])?, self.builder.op(Opcode::Dsy, &[value])?);
                let magnitudes = [(&x[..], Modifier::Absolute), (&y[..], Modifier::Absolute)];
                self.builder.modified(Opcode::Add, &magnitudes, value.len())
            }
        }
    }

    pub(super) fn relation(&mut self, function: RelationalFunction, value: &[Component]) -> Result {
        let (mut all, mut any) = (Component::Bool(true), Component::Bool(false));
        for &component in value {
            match function {
                RelationalFunction::All => all = self.builder.and(all, component)?,
                RelationalFunction::Any => any = self.builder.or(any, component)?,
                _ => return self.builder.refuse("WGSL has no such test"),
            }
        }
        Ok(vec![if function == RelationalFunction::All { all } else { any }])
    }

    /// Converts each component of a scalar, vector or matrix.
    pub(super) fn convert(&mut self, value: &[Component], from: Option<Scalar>, to: Scalar) -> Result {
        let (Some(from), 1..) = (from, to.width) else {
            return self.builder.refuse("bitcast is not translated");
        };
        let to_float = to.kind == ScalarKind::Float;
        if from.kind == ScalarKind::Float && to_float {
            // Narrowing rounds. Widening rounds too, because a uniform or an interpolated value may not have been
            // rounded yet.
            let half = is_half(Some(from)) || is_half(Some(to));
            self.builder.half = half;
            let columns = value.chunks(4).map(|column| match half {
                true => self.builder.op(Opcode::Mov, &[column]),
                false => Ok(column.to_vec()),
            });
            return Ok(columns.collect::<Result<Vec<_>>>()?.concat());
        }
        let one = |this: &mut Self, component: &Component| {
            Ok(match (*component, to.kind) {
                (Component::Bool(known), _) if to_float => Component::Float(f32::from(u8::from(known)).to_bits()),
                (Component::Bool(known), ScalarKind::Sint | ScalarKind::Uint) => Component::Int(known.into()),
                (Component::Int(known), ScalarKind::Float) => Component::Float((known as f32).to_bits()),
                (Component::Int(known), ScalarKind::Bool) => Component::Bool(known != 0),
                (Component::Int(known), kind) => Component::Int(wrapped(known, kind)),
                (Component::Float(bits), ScalarKind::Sint) => Component::Int((f32::from_bits(bits) as i32).into()),
                (Component::Float(bits), ScalarKind::Uint) => Component::Int((f32::from_bits(bits) as u32).into()),
                (component, ScalarKind::Bool) if from.kind == ScalarKind::Float => {
                    this.builder.op(Opcode::Sne, &[&[component], &[Component::Float(0)]])?[0]
                }
                // Conditions are stored as 0 and 1.
                (component, kind) if from.kind == ScalarKind::Bool && kind != ScalarKind::Sint => match kind {
                    ScalarKind::Uint => Component::Unknown,
                    _ => component,
                },
                (Component::Unknown, ScalarKind::Float) => return this.builder.unknown(),
                _ => Component::Unknown,
            })
        };
        value.iter().map(|component| one(self, component)).collect()
    }

    pub(super) fn binary(&mut self, operator: B, a: &[Component], b: &[Component], types: [&TypeInner; 2]) -> Result {
        let kind = scalar(types[0]).map(|scalar| scalar.kind);
        match (operator, kind, types) {
            (_, Some(ScalarKind::Sint | ScalarKind::Uint), _) => {
                self.whole(operator, a, b, kind.unwrap_or(ScalarKind::Sint))
            }
            (_, Some(ScalarKind::Bool), _) => {
                let pairs = a.iter().zip(b);
                pairs.map(|(a, b)| self.condition(operator, *a, *b)).collect()
            }
            (B::Multiply, _, [TypeInner::Matrix { rows, .. }, TypeInner::Vector { .. }]) => {
                self.columns_by(a, b, *rows)
            }
            (B::Multiply, _, [TypeInner::Vector { size, .. }, TypeInner::Matrix { .. }]) => {
                let rows = *size as usize;
                let each = b.chunks(rows).map(|column| Ok(self.builder.dot(a, column)?[0]));
                each.collect()
            }
            (B::Multiply, _, [TypeInner::Matrix { rows, .. }, TypeInner::Matrix { rows: inner, .. }]) => {
                let columns = b.chunks(*inner as usize).map(|column| self.columns_by(a, column, *rows));
                Ok(columns.collect::<Result<Vec<_>>>()?.concat())
            }
            (_, _, [TypeInner::Matrix { rows, .. }, _] | [_, TypeInner::Matrix { rows, .. }]) => {
                let rows = *rows as usize;
                let columns = (0..a.len().max(b.len()) / rows).map(|at| {
                    let [a, b] = [(a, types[0]), (b, types[1])].map(|(value, inner)| match inner {
                        TypeInner::Matrix { .. } => &value[at * rows..(at + 1) * rows],
                        _ => value,
                    });
                    self.float(operator, a, b)
                });
                Ok(columns.collect::<Result<Vec<_>>>()?.concat())
            }
            _ => self.float(operator, a, b),
        }
    }

    /// Multiplies the columns of a matrix by the components of a vector, and sums the products in order.
    fn columns_by(&mut self, matrix: &[Component], vector: &[Component], rows: VectorSize) -> Result {
        let mut sum: Option<Value> = None;
        for (column, factor) in matrix.chunks(rows as usize).zip(vector) {
            let product = self.builder.mul(column, &[*factor])?;
            sum = Some(match sum {
                None => product,
                Some(sum) => self.builder.op(Opcode::Add, &[&sum, &product])?,
            });
        }
        Ok(sum.unwrap_or_default())
    }

    fn float(&mut self, operator: B, a: &[Component], b: &[Component]) -> Result {
        let known = OPERATORS.iter().find(|(known, ..)| *known == operator);
        match (operator, known.and_then(|(.., opcode)| *opcode)) {
            (_, Some(opcode)) => self.builder.op(opcode, &[a, b]),
            (B::Divide, _) => self.builder.divide(a, b),
            (B::Modulo, _) => self.builder.function("remainder", &[a.to_vec(), b.to_vec()]),
            _ => self.builder.refuse("bit operations are not translated"),
        }
    }

    fn condition(&mut self, operator: B, a: Component, b: Component) -> Result<Component> {
        let builder = &mut self.builder;
        builder.half = false;
        match operator {
            B::LogicalAnd | B::And => builder.and(a, b),
            B::LogicalOr | B::InclusiveOr => builder.or(a, b),
            B::Equal | B::NotEqual => {
                let not = builder.not(b)?;
                let (then, otherwise) = if operator == B::Equal { (b, not) } else { (not, b) };
                Ok(builder.select(&[a], &[then], &[otherwise])?[0])
            }
            _ => builder.refuse("this operation on conditions is not translated"),
        }
    }

    /// Evaluates an operator on whole numbers that are known at translation.
    fn whole(&mut self, operator: B, a: &[Component], b: &[Component], kind: ScalarKind) -> Result {
        let width = a.len().max(b.len());
        let one = |lane: usize| {
            let at = |value: &[Component]| value[lane.min(value.len() - 1)];
            let (Component::Int(a), Component::Int(b)) = (at(a), at(b)) else { return self.builder.unknown() };
            let value = match operator {
                B::Add => a.checked_add(b),
                B::Subtract => a.checked_sub(b),
                B::Multiply => Some(a.wrapping_mul(b)),
                // In a division by zero at run time, the quotient is the dividend and the remainder is 0 (WGSL, 8.7).
                B::Divide => Some(a.checked_div(b).unwrap_or(a)),
                B::Modulo => Some(a.checked_rem(b).unwrap_or(0)),
                B::And => Some(a & b),
                B::ExclusiveOr => Some(a ^ b),
                B::InclusiveOr => Some(a | b),
                B::ShiftLeft => u32::try_from(b).ok().filter(|b| *b < 32).map(|b| a << b),
                B::ShiftRight => u32::try_from(b).ok().filter(|b| *b < 32).map(|b| a >> b),
                B::Equal => return Ok(Component::Bool(a == b)),
                B::NotEqual => return Ok(Component::Bool(a != b)),
                B::Less => return Ok(Component::Bool(a < b)),
                B::LessEqual => return Ok(Component::Bool(a <= b)),
                B::Greater => return Ok(Component::Bool(a > b)),
                B::GreaterEqual => return Ok(Component::Bool(a >= b)),
                B::LogicalAnd | B::LogicalOr => None,
            };
            match value {
                Some(value) => Ok(Component::Int(wrapped(value, kind))),
                None => self.builder.refuse("this operation on integers overflows or is not defined"),
            }
        };
        (0..width).map(one).collect()
    }
}

/// Wraps a whole number to 32 bits.
fn wrapped(value: i64, kind: ScalarKind) -> i64 {
    match kind {
        ScalarKind::Uint => (value as u32).into(),
        _ => (value as i32).into(),
    }
}
