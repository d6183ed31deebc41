//! Expressions of a function.

use naga::diagnostic_filter::{FilterableTriggeringRule, Severity, StandardFilterableTriggeringRule};
use naga::{
    BinaryOperator as B, DerivativeAxis, Expression, Function, Handle, MathFunction, RelationalFunction, SampleLevel,
    Scalar, ScalarKind, TypeInner, UnaryOperator, VectorSize,
};

use super::super::Refusal;
use super::super::half::{OperationForm, WgslOperation};
use super::translator::{Frame, Meaning, Translator, place};
use super::values::{Component, Value, is_half, part, scalar};
use super::with_arguments;
use crate::isa::{Modifier, Opcode, RegisterFile, Span};

type Result<T = Value> = std::result::Result<T, Refusal>;

impl<'a> Translator<'a> {
    pub(super) fn type_of(&self, frame: &Frame<'a>, handle: Handle<Expression>) -> &'a TypeInner {
        frame.info[handle].ty.inner_with(&self.module.types)
    }

    pub(super) fn value(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result {
        match self.entry(frame, handle)? {
            Meaning::Value(value) if !value.is_empty() => Ok(value),
            _ => self.builder.refuse("this expression has no value that is translated"),
        }
    }

    /// Value of an expression, evaluated on first use.
    pub(super) fn entry(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Meaning> {
        match frame.values.get(&handle) {
            Some(entry) => Ok(entry.clone()),
            None => self.evaluate(frame, handle),
        }
    }

    /// Evaluates an expression, and keeps its value.
    pub(super) fn evaluate(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Meaning> {
        let span = place(frame.function.expressions.get_span(handle));
        self.step(span)?;
        let entry = self.computed(frame, handle, span)?;
        self.note(frame, handle, span);
        frame.values.insert(handle, entry.clone());
        Ok(entry)
    }

    fn computed(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>, span: Option<Span>) -> Result<Meaning> {
        let function = frame.function;
        let expression = &function.expressions[handle];
        let kind = scalar(self.type_of(frame, handle));
        let mut operand = |this: &mut Self, handle: Handle<Expression>| {
            let value = this.value(frame, handle);
            // Operands have places of their own.
            this.builder.span = span.unwrap_or(this.builder.span);
            this.builder.half = is_half(kind);
            value
        };
        let value = match expression {
            Expression::Compose { components, .. } => {
                let parts = components.iter().map(|part| operand(self, *part)).collect::<Result<Vec<_>>>()?;
                parts.concat()
            }
            Expression::Splat { size, value } => vec![operand(self, *value)?[0]; *size as usize],
            Expression::Swizzle { size, vector, pattern } => {
                let vector = operand(self, *vector)?;
                pattern[..*size as usize].iter().map(|component| vector[*component as usize]).collect()
            }
            Expression::AccessIndex { base, index } => return self.access(frame, *base, (*index).into()),
            Expression::Access { base, index } => match operand(self, *index)?[..] {
                [Component::Int(index)] => return self.access(frame, *base, index),
                _ => {
                    let message = "expected an index that is known when the shader is translated";
                    return Err(Refusal::new(message, self.builder.span)
                        .with_help("index with constants or with the counters of loops, or select"));
                }
            },
            Expression::FunctionArgument(index) => match frame.arguments.get(*index as usize) {
                Some(entry) => return Ok(entry.clone()),
                None => return self.builder.refuse("an argument is missing"),
            },
            Expression::GlobalVariable(handle) => return Ok(self.globals[handle].clone()),
            Expression::LocalVariable(local) => {
                let slot = frame.locals[local];
                let length = self.variables.get(&slot).map_or(0, Vec::len);
                return Ok(Meaning::Pointer { slot, offset: 0, length, path: 0 });
            }
            Expression::Load { pointer } => {
                let pointer = self.entry(frame, *pointer)?;
                let loaded = self.load(&pointer)?;
                self.builder.half = is_half(kind);
                let rounded = |c: &Component| matches!(c, Component::Place(r, _) if r.file == RegisterFile::Constant);
                match self.builder.half && loaded.iter().any(rounded) {
                    true => self.builder.op(Opcode::Mov, &[&loaded])?,
                    false => loaded,
                }
            }
            Expression::ImageSample { .. } => self.sample(frame, handle)?,
            Expression::Unary { op, expr } => {
                let value = operand(self, *expr)?;
                self.unary(*op, &value)?
            }
            Expression::Binary { op, left, right } => {
                let (a, b) = (operand(self, *left)?, operand(self, *right)?);
                let types = [self.type_of(frame, *left), self.type_of(frame, *right)];
                self.builder.half = is_half(scalar(types[0]));
                self.binary(*op, &a, &b, types)?
            }
            Expression::Select { condition, accept, reject } => {
                let [condition, accept, reject] = [*condition, *accept, *reject].map(|part| operand(self, part));
                self.builder.select(&condition?, &accept?, &reject?)?
            }
            Expression::Derivative { axis, expr, .. } => {
                let value = operand(self, *expr)?;
                self.in_whole_quads(function)?;
                self.derivative(*axis, &value)?
            }
            Expression::Relational { fun, argument } => {
                let value = operand(self, *argument)?;
                self.builder.half = false;
                self.relation(*fun, &value)?
            }
            Expression::Math { fun: MathFunction::Transpose, arg, .. } => {
                let value = operand(self, *arg)?;
                let TypeInner::Matrix { columns, rows, .. } = self.type_of(frame, *arg) else {
                    return self.builder.refuse("only matrices are transposed");
                };
                let (columns, rows) = (*columns as usize, *rows as usize);
                (0..columns * rows).map(|at| value[at % columns * rows + at / columns]).collect()
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let handles = [Some(*arg), *arg1, *arg2, *arg3];
                let arguments =
                    handles.iter().flatten().map(|part| operand(self, *part)).collect::<Result<Vec<_>>>()?;
                self.builder.math(*fun, &arguments)?
            }
            Expression::As { expr, kind: to, convert } => {
                let value = operand(self, *expr)?;
                let from = scalar(self.type_of(frame, *expr));
                self.convert(&value, from, Scalar { kind: *to, width: convert.unwrap_or(0) })?
            }
            other => self.leaf(other)?,
        };
        Ok(Meaning::Value(value))
    }

    /// Refuses what differences of neighbors need where some of them may be elsewhere.
    fn in_whole_quads(&self, function: &Function) -> Result<()> {
        let filters = &self.module.diagnostic_filters;
        let first = function.diagnostic_filter_leaf.map(|leaf| &filters[leaf]);
        let mut nodes = std::iter::successors(first, |node| node.parent.map(|parent| &filters[parent]));
        let rule = FilterableTriggeringRule::Standard(StandardFilterableTriggeringRule::DerivativeUniformity);
        let of_rule = nodes.find(|node| node.inner.triggering_rule == rule);
        if !self.builder.varies(self.live) || of_rule.is_some_and(|node| node.inner.new_severity != Severity::Error) {
            return Ok(());
        }
        let message = "expected uniform control flow, found a condition that differs between fragments: neighbors of this \
                       fragment may not get here";
        Err(Refusal::new(message, self.builder.span).with_help(
            "call it in front of the condition, or use textureSampleGrad or textureSampleLevel; the directive \
             `diagnostic(off, derivative_uniformity);` lets it pass",
        ))
    }

    /// Notes an operation on f32 that can be rewritten.
    fn note(&mut self, frame: &Frame<'a>, handle: Handle<Expression>, span: Option<Span>) {
        let expressions = &frame.function.expressions;
        let (form, operands) = match &expressions[handle] {
            Expression::Binary { op, left, right } => (OperationForm::Operator(symbol(*op)), vec![*left, *right]),
            Expression::Math { fun: MathFunction::QuantizeToF16 | MathFunction::Transpose, .. } => return,
            Expression::Math { arg, arg1, arg2, arg3, .. } => {
                (OperationForm::Call, [Some(*arg), *arg1, *arg2, *arg3].into_iter().flatten().collect())
            }
            Expression::Derivative { expr, .. } => (OperationForm::CallOfF32, vec![*expr]),
            Expression::ImageSample { .. } => (OperationForm::CallOfF32, Vec::new()),
            _ => return,
        };
        let Some(span) = span.map(|span| with_arguments(self.text, span)) else { return };
        let key = [span.start, span.end];
        if self.operations.contains_key(&key) {
            return;
        }
        let types = operands.iter().map(|operand| {
            // Of a scalar beside a vector the text has the scalar.
            let whole = match &expressions[*operand] {
                Expression::Splat { value, .. } => {
                    let spans = [*operand, *value].map(|part| expressions.get_span(part).to_range());
                    if spans[0] == spans[1] { *value } else { *operand }
                }
                _ => *operand,
            };
            self.type_of(frame, whole)
        });
        let types: Vec<&TypeInner> = types.collect();
        let result = name(self.type_of(frame, handle));
        let on_f32 = types.iter().any(|inner| name(inner).is_some()) || (types.is_empty() && result.is_some());
        if !on_f32 || types.iter().any(|inner| is_half(scalar(inner))) {
            return;
        }
        let names: Vec<Option<String>> = types.iter().map(|inner| name(inner)).collect();
        let operation = WgslOperation::new(self.text, span, form, &names, result.as_deref());
        self.operations.extend(operation.map(|operation| (key, operation)));
    }

    fn access(&mut self, frame: &mut Frame<'a>, base: Handle<Expression>, index: i64) -> Result<Meaning> {
        let inner = match self.type_of(frame, base) {
            TypeInner::Pointer { base, .. } => &self.module.types[*base].inner,
            other => other,
        };
        let whole = self.entry(frame, base)?;
        let found = usize::try_from(index).ok().and_then(|index| part(self.module, inner, index));
        let Some((start, count)) = found else {
            return self.builder.refuse(format!("index {index} lies outside"));
        };
        match whole {
            Meaning::Value(value) if start + count <= value.len() => {
                Ok(Meaning::Value(value[start..start + count].to_vec()))
            }
            Meaning::Pointer { slot, offset, length, path } if start + count <= length => {
                Ok(Meaning::Pointer { slot, offset: offset + start, length: count, path })
            }
            _ => self.builder.refuse("this part of a value is not translated"),
        }
    }

    fn load(&mut self, pointer: &Meaning) -> Result {
        let Meaning::Pointer { slot, offset, length, path } = pointer else {
            return self.builder.refuse("only variables are read");
        };
        self.accesses.insert((*slot, *path, false));
        match self.variables.get(slot).and_then(|value| value.get(*offset..*offset + *length)) {
            Some(value) => Ok(value.to_vec()),
            None => self.builder.refuse("this variable is not translated"),
        }
    }

    fn sample(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result {
        let (function, span) = (frame.function, self.builder.span);
        let Expression::ImageSample {
            image,
            coordinate,
            gather: None,
            array_index: None,
            offset: None,
            level,
            depth_ref: None,
            clamp_to_edge: false,
            ..
        } = &function.expressions[handle]
        else {
            return self.builder.refuse("only textureSample, textureSampleGrad and textureSampleLevel of level 0");
        };
        let Meaning::Texture(unit) = self.entry(frame, *image)? else {
            return self.builder.refuse("only textures that are variables of the module are read");
        };
        let at = self.value(frame, *coordinate)?;
        let gradient = match level {
            SampleLevel::Auto => {
                self.in_whole_quads(function)?;
                None
            }
            SampleLevel::Zero => Some([(); 2].map(|()| vec![Component::Float(0); 2])),
            SampleLevel::Exact(level) => match self.value(frame, *level)?[..] {
                [Component::Float(0)] => Some([(); 2].map(|()| vec![Component::Float(0); 2])),
                _ => return self.builder.refuse("textureSampleLevel is translated for level 0.0 alone"),
            },
            SampleLevel::Gradient { x, y } => Some([self.value(frame, *x)?, self.value(frame, *y)?]),
            SampleLevel::Bias(_) => return self.builder.refuse("textureSampleBias is not translated"),
        };
        self.builder.span = span;
        match gradient {
            None => self.builder.texel(Opcode::TexLd, unit, &[&at]),
            Some([x, y]) => self.builder.texel(Opcode::TexLdD, unit, &[&at, &x, &y]),
        }
    }

    fn unary(&mut self, operator: UnaryOperator, value: &[Component]) -> Result {
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

    fn derivative(&mut self, axis: DerivativeAxis, value: &[Component]) -> Result {
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

    fn relation(&mut self, function: RelationalFunction, value: &[Component]) -> Result {
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

    /// A conversion of each component, or of a matrix.
    fn convert(&mut self, value: &[Component], from: Option<Scalar>, to: Scalar) -> Result {
        let (Some(from), 1..) = (from, to.width) else {
            return self.builder.refuse("bitcast is not translated");
        };
        let to_float = to.kind == ScalarKind::Float;
        if from.kind == ScalarKind::Float && to_float {
            // Narrowing rounds; widening does where a uniform or an interpolated value was not rounded yet.
            let half = is_half(Some(from)) || is_half(Some(to));
            self.builder.half = half;
            return match half {
                true => Ok(self.each_column(value, |this, column| this.builder.op(Opcode::Mov, &[column]))?),
                false => Ok(value.to_vec()),
            };
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

    /// Applies a function to a value of any length, four scalars at a time.
    fn each_column(&mut self, value: &[Component], mut of: impl FnMut(&mut Self, &[Component]) -> Result) -> Result {
        let columns = value.chunks(4).map(|column| of(self, column)).collect::<Result<Vec<_>>>()?;
        Ok(columns.concat())
    }

    fn binary(&mut self, operator: B, a: &[Component], b: &[Component], types: [&TypeInner; 2]) -> Result {
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
            (_, _, [TypeInner::Matrix { rows, .. }, other]) => {
                let rows = *rows as usize;
                let matrix = matches!(other, TypeInner::Matrix { .. });
                let of = |at: usize| if matrix { &b[at * rows..(at + 1) * rows] } else { b };
                let columns = a.chunks(rows).enumerate().map(|(at, column)| self.float(operator, column, of(at)));
                Ok(columns.collect::<Result<Vec<_>>>()?.concat())
            }
            (_, _, [_, TypeInner::Matrix { rows, .. }]) => {
                let columns = b.chunks(*rows as usize).map(|column| self.float(operator, a, column));
                Ok(columns.collect::<Result<Vec<_>>>()?.concat())
            }
            _ => self.float(operator, a, b),
        }
    }

    /// The columns of a matrix times the components of a vector, summed from the first.
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
        let opcode = match operator {
            B::Add => Opcode::Add,
            B::Subtract => Opcode::Sub,
            B::Multiply => Opcode::Mul,
            B::Equal => Opcode::Seq,
            B::NotEqual => Opcode::Sne,
            B::Less => Opcode::Slt,
            B::LessEqual => Opcode::Sle,
            B::Greater => Opcode::Sgt,
            B::GreaterEqual => Opcode::Sge,
            B::Divide => return self.builder.divide(a, b),
            B::Modulo => return self.builder.function("remainder", &[a.to_vec(), b.to_vec()]),
            _ => return self.builder.refuse("bit operations are not translated"),
        };
        self.builder.op(opcode, &[a, b])
    }

    fn condition(&mut self, operator: B, a: Component, b: Component) -> Result<Component> {
        let builder = &mut self.builder;
        builder.half = false;
        match operator {
            B::LogicalAnd | B::And => builder.and(a, b),
            B::LogicalOr | B::InclusiveOr => builder.or(a, b),
            B::Equal | B::NotEqual => {
                let same = Component::Bool(operator == B::Equal);
                let (if_true, not) = (b, builder.not(b)?);
                let (then, otherwise) = if same == Component::Bool(true) { (if_true, not) } else { (not, if_true) };
                Ok(builder.select(&[a], &[then], &[otherwise])?[0])
            }
            _ => builder.refuse("this operation on conditions is not translated"),
        }
    }

    /// Arithmetic of whole numbers that are known.
    fn whole(&mut self, operator: B, a: &[Component], b: &[Component], kind: ScalarKind) -> Result {
        let width = a.len().max(b.len());
        let one = |lane: usize| {
            let at = |value: &[Component]| value[lane.min(value.len() - 1)];
            let (Component::Int(a), Component::Int(b)) = (at(a), at(b)) else { return self.builder.unknown() };
            let value = match operator {
                B::Add => a.checked_add(b),
                B::Subtract => a.checked_sub(b),
                B::Multiply => a.checked_mul(b),
                B::Divide => a.checked_div(b),
                B::Modulo => a.checked_rem(b),
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
                None => self.builder.refuse("this operation on whole numbers has no result"),
            }
        };
        (0..width).map(one).collect()
    }

    /// The zero of a type that variables start with.
    pub(super) fn zero_of(&self, ty: Handle<naga::Type>) -> Result {
        self.zeros(&self.module.types[ty].inner)
    }
}

/// A whole number of 32 bits.
fn wrapped(value: i64, kind: ScalarKind) -> i64 {
    match kind {
        ScalarKind::Uint => (value as u32).into(),
        _ => (value as i32).into(),
    }
}

/// The operator in texts.
fn symbol(operator: B) -> &'static str {
    match operator {
        B::Add => "+",
        B::Subtract => "-",
        B::Multiply => "*",
        B::Divide => "/",
        B::Modulo => "%",
        B::Equal => "==",
        B::NotEqual => "!=",
        B::Less => "<",
        B::LessEqual => "<=",
        B::Greater => ">",
        B::GreaterEqual => ">=",
        // Of no numbers.
        _ => "",
    }
}

/// The name of a type of f32.
fn name(inner: &TypeInner) -> Option<String> {
    scalar(inner).filter(|scalar| *scalar == Scalar::F32)?;
    Some(match inner {
        TypeInner::Vector { size, .. } => format!("vec{}f", *size as u8),
        TypeInner::Matrix { columns, rows, .. } => format!("mat{}x{}f", *columns as u8, *rows as u8),
        _ => "f32".to_owned(),
    })
}
