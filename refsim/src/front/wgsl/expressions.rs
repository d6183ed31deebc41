//! Expressions of a function.

use naga::diagnostic_filter::{FilterableTriggeringRule, Severity, StandardFilterableTriggeringRule};
use naga::{Expression, Function, Handle, MathFunction, SampleLevel, Scalar, TypeInner};

use super::super::Refusal;
use super::super::half::{OperationForm, WgslOperation};
use super::operators::symbol;
use super::translator::{Frame, Meaning, Translator, place};
use super::values::{Component, Value, is_half, part, scalar};
use super::with_arguments;
use crate::isa::{Opcode, RegisterFile, Span};

/// Maximum length in bytes of an operation that is rewritten; nested operations each read their own text.
const LONGEST: u32 = 4096;

/// The largest number of f16.
const LARGEST_HALF: f32 = 65504.0;

type Result<T = Value> = std::result::Result<T, Refusal>;

impl<'a> Translator<'a> {
    pub(super) fn type_of(&self, frame: &Frame<'a>, handle: Handle<Expression>) -> &'a TypeInner {
        frame.info[handle].ty.inner_with(&self.module.types)
    }

    pub(super) fn value(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result {
        match self.entry(frame, handle)? {
            Meaning::Value(value) if !value.is_empty() => Ok(value),
            _ => self.builder.refuse("the value of this expression is not translated"),
        }
    }

    /// The value of an expression, which is evaluated on first use.
    pub(super) fn entry(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Meaning> {
        match frame.values.get(&handle) {
            Some(entry) => Ok(entry.clone()),
            None => self.evaluate(frame, handle),
        }
    }

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
            // Evaluating an operand has changed the current span.
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
                    return self.builder.refuse("only matrices can be transposed");
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

    /// Returns an error if the derivative at this point could need a neighboring fragment that does not execute it.
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
                       fragment may not execute this";
        Err(Refusal::new(message, self.builder.span).with_help(
            "call it before the condition, or use textureSampleGrad or textureSampleLevel; the directive \
             `diagnostic(off, derivative_uniformity);` allows it",
        ))
    }

    /// Records an operation on f32 that can be rewritten in f16.
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
        let span = span.map(|span| with_arguments(self.text, span));
        let Some(span) = span.filter(|span| span.end - span.start <= LONGEST) else { return };
        let key = [span.start, span.end];
        if self.operations.contains_key(&key) {
            return;
        }
        let types = operands.iter().map(|operand| {
            // For a scalar that is combined with a vector, the text contains the scalar.
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
        // Constants that f16 does not represent can't be converted in the text.
        let beyond = |component: &Component| matches!(component, Component::Float(bits) if f32::from_bits(*bits).abs() > LARGEST_HALF);
        let values = operands.iter().filter_map(|operand| frame.values.get(operand));
        if values.into_iter().any(|entry| matches!(entry, Meaning::Value(value) if value.iter().any(beyond))) {
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
            return self.builder.refuse(format!("index {index} is out of range"));
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
            return self.builder.refuse("only variables can be read");
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
            return self.builder.refuse("only textureSample and its forms Grad and Level (level 0) are translated");
        };
        let Meaning::Texture(unit) = self.entry(frame, *image)? else {
            return self.builder.refuse("a texture must be a variable of the module");
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
                _ => return self.builder.refuse("textureSampleLevel is only translated for level 0.0"),
            },
            SampleLevel::Gradient { x, y } => Some([self.value(frame, *x)?, self.value(frame, *y)?]),
            SampleLevel::Bias(_) => {
                self.builder.span = span;
                return self.builder.refuse("textureSampleBias is not translated");
            }
        };
        self.builder.span = span;
        match gradient {
            None => self.builder.texel(Opcode::TexLd, unit, &[&at]),
            Some([x, y]) => self.builder.texel(Opcode::TexLdD, unit, &[&at, &x, &y]),
        }
    }

    /// The zero value of a type, with which variables are initialized.
    pub(super) fn zero_of(&self, ty: Handle<naga::Type>) -> Result {
        self.zeros(&self.module.types[ty].inner)
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
