//! State of a module's translation: variables, exits, parameters.

use std::collections::{BTreeMap, BTreeSet};

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    AddressSpace, Expression, Function, GlobalVariable, Handle, LocalVariable, Module, Scalar, ScalarKind, TypeInner,
};

use super::super::{Refusal, WgslInterface, WgslOperation, WgslUniform};
use super::builder::Builder;
use super::values::{Component, MAX_SCALARS, Value, is_half, scalars};
use crate::isa::{FIRST_LITERAL, FIRST_NAMED, Parameter, ParameterSource, Register, RegisterFile, Span};

/// Maximum number of statements and expressions translated, with loops unrolled.
const MAX_WORK: usize = 1 << 17;
/// Maximum number of uniforms, counted in vectors.
const MAX_PARAMETERS: usize = (FIRST_LITERAL - FIRST_NAMED) as usize - 2;

#[derive(Clone, Debug)]
pub(super) enum Meaning {
    Value(Value),
    /// Scalars of a variable.
    Pointer {
        slot: usize,
        offset: usize,
        length: usize,
        /// The pointer parameter through which it was passed, 0 if none.
        path: usize,
    },
    /// Image unit.
    Texture(u16),
    Sampler,
}

/// State of a function that is being inlined.
pub(super) struct Frame<'a> {
    pub(super) function: &'a Function,
    pub(super) info: &'a FunctionInfo,
    pub(super) arguments: Vec<Meaning>,
    pub(super) locals: BTreeMap<Handle<LocalVariable>, usize>,
    pub(super) values: BTreeMap<Handle<Expression>, Meaning>,
}

/// The values of all variables, by slot.
pub(super) type Variables = BTreeMap<usize, Value>;

/// Fragments that have left a loop or a function: their mask, and the values of their variables.
#[derive(Clone, Debug, Default)]
pub(super) struct Exit(pub(super) Option<(Component, Variables)>);

pub(super) struct Translator<'a> {
    pub(super) text: &'a str,
    pub(super) module: &'a Module,
    pub(super) info: &'a ModuleInfo,
    /// The operations that can be rewritten in f16, by the start and the end of their spans.
    pub(super) operations: BTreeMap<[u32; 2], WgslOperation>,
    /// Variable slots that the current function has read or (`true`) written, each with the parameter used for the
    /// access.
    pub(super) accesses: BTreeSet<(usize, usize, bool)>,
    pub(super) builder: Builder,
    pub(super) parameters: Vec<Parameter>,
    pub(super) interface: WgslInterface,
    /// Binding and size of the uniform variable that is being declared.
    memory: ([u32; 2], u32),
    pub(super) variables: Variables,
    /// Mask of the fragments that execute the current statement.
    pub(super) live: Component,
    pub(super) killed: Component,
    pub(super) breaks: Vec<Exit>,
    pub(super) continues: Vec<Exit>,
    pub(super) returns: Vec<Exit>,
    pub(super) globals: BTreeMap<Handle<GlobalVariable>, Meaning>,
    pub(super) slots: usize,
    textures: u16,
    work: usize,
}

/// Span of a node in the text, if naga knows it.
pub(super) fn place(span: naga::Span) -> Option<Span> {
    span.to_range().map(|range| Span::new(range.start as u32, range.end as u32))
}

impl<'a> Translator<'a> {
    pub(super) fn new(text: &'a str, module: &'a Module, info: &'a ModuleInfo) -> Self {
        Self {
            text,
            module,
            info,
            operations: BTreeMap::new(),
            accesses: BTreeSet::new(),
            builder: Builder::default(),
            parameters: Vec::new(),
            interface: WgslInterface::default(),
            memory: ([0; 2], 0),
            variables: Variables::new(),
            live: Component::Bool(true),
            killed: Component::Bool(false),
            breaks: Vec::new(),
            continues: Vec::new(),
            returns: Vec::new(),
            globals: BTreeMap::new(),
            slots: 0,
            textures: 0,
            work: 0,
        }
    }

    /// Counts a step of the translation; returns an error if there are too many.
    pub(super) fn step(&mut self, at: Option<Span>) -> Result<(), Refusal> {
        if let Some(span) = at {
            self.builder.span = span;
        }
        self.work += 1;
        if self.work > MAX_WORK { self.builder.too_long() } else { Ok(()) }
    }

    /// Counts a copy of all variables.
    pub(super) fn charge(&mut self) -> Result<(), Refusal> {
        self.work += self.variables.values().map(Vec::len).sum::<usize>() / 64;
        self.step(None)
    }

    pub(super) fn variable(&mut self, value: Value) -> usize {
        self.slots += 1;
        self.variables.insert(self.slots, value);
        self.slots
    }

    /// Declares all global variables.
    pub(super) fn declare(&mut self) -> Result<(), Refusal> {
        let module = self.module;
        for (handle, global) in module.global_variables.iter() {
            self.step(place(module.global_variables.get_span(handle)))?;
            let inner = &module.types[global.ty].inner;
            let entry = match (global.space, inner) {
                (AddressSpace::Uniform, _) => {
                    let mut value = Value::new();
                    let binding = global.binding.map_or([0; 2], |binding| [binding.group, binding.binding]);
                    self.memory = (binding, inner.size(module.to_ctx()));
                    self.uniform(global.name.clone().unwrap_or_default(), inner, 0, &mut value)?;
                    let (length, slot) = (value.len(), self.variable(value));
                    Meaning::Pointer { slot, offset: 0, length, path: 0 }
                }
                (AddressSpace::Private, _) => {
                    let value = match global.init {
                        Some(init) => self.constant(init)?,
                        None => self.zeros(inner)?,
                    };
                    let (length, slot) = (value.len(), self.variable(value));
                    Meaning::Pointer { slot, offset: 0, length, path: 0 }
                }
                (AddressSpace::Handle, TypeInner::Sampler { comparison: false }) => Meaning::Sampler,
                (
                    AddressSpace::Handle,
                    TypeInner::Image {
                        dim: naga::ImageDimension::D2,
                        arrayed: false,
                        class: naga::ImageClass::Sampled { kind: ScalarKind::Float, multi: false },
                    },
                ) => {
                    self.textures += 1;
                    Meaning::Texture(self.textures - 1)
                }
                (AddressSpace::Handle, _) => return self.builder.refuse("only `texture_2d<f32>` is translated"),
                _ => return self.builder.refuse("variables of this address space are not translated"),
            };
            self.globals.insert(handle, entry);
        }
        Ok(())
    }

    pub(super) fn zeros(&self, inner: &TypeInner) -> Result<Value, Refusal> {
        match scalars(self.module, inner) {
            Some(list) => Ok(list.iter().map(super::values::zero).collect()),
            None => self.builder.refuse(match inner {
                TypeInner::Array { .. } | TypeInner::Struct { .. } => {
                    format!("expected a variable of at most {MAX_SCALARS} numbers, found a larger one")
                }
                _ => "values of this type are not translated".to_owned(),
            }),
        }
    }

    /// Returns the error that the text at the current span cannot be translated.
    pub(super) fn refuse_this<T>(&self) -> Result<T, Refusal> {
        let Span { start, end } = self.builder.span;
        let quoted = self.text.get(start as usize..end as usize).unwrap_or_default();
        let name: String = quoted.split(['(', '\n']).next().unwrap_or_default().chars().take(40).collect();
        self.builder.refuse(format!("`{}` is not translated", name.trim_end()))
    }

    /// Finds the first occurrence of a word after a position in the text.
    pub(super) fn word_behind(&self, start: usize, word: &str) -> Option<Span> {
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let mut found =
            self.text.get(start..)?.match_indices(word).map(|(at, _)| (start + at, start + at + word.len()));
        let is_whole = |(from, to): &(usize, usize)| {
            !self.text[..*from].ends_with(is_part) && !self.text[*to..].starts_with(is_part)
        };
        found.find(is_whole).map(|(from, to)| Span::new(from as u32, to as u32))
    }

    /// Declares the parameters of a uniform, one for each scalar, vector and column of a matrix.
    fn uniform(&mut self, name: String, inner: &TypeInner, at: u32, value: &mut Value) -> Result<(), Refusal> {
        let module = self.module;
        let of = |handle: Handle<naga::Type>| &module.types[handle].inner;
        match inner {
            TypeInner::Scalar(scalar) => self.parameter(name, 1, *scalar, at, value),
            TypeInner::Vector { size, scalar } => self.parameter(name, *size as usize, *scalar, at, value),
            TypeInner::Matrix { columns, rows, scalar } => (0..*columns as u32).try_for_each(|column| {
                let at = at + column * (naga::proc::Alignment::from(*rows) * u32::from(scalar.width));
                self.parameter(format!("{name}[{column}]"), *rows as usize, *scalar, at, value)
            }),
            TypeInner::Array { base, size: naga::ArraySize::Constant(count), stride } => (0..count.get())
                .try_for_each(|i| self.uniform(format!("{name}[{i}]"), of(*base), at + i * stride, value)),
            TypeInner::Struct { members, .. } => members.iter().try_for_each(|member| {
                let member_name = member.name.as_deref().unwrap_or_default();
                self.uniform(format!("{name}.{member_name}"), of(member.ty), at + member.offset, value)
            }),
            _ => self.builder.refuse("uniforms of this type are not translated"),
        }
    }

    fn parameter(
        &mut self,
        name: String,
        width: usize,
        scalar: Scalar,
        offset: u32,
        value: &mut Value,
    ) -> Result<(), Refusal> {
        if scalar.kind != ScalarKind::Float {
            value.extend(vec![Component::Unknown; width]);
            return Ok(());
        }
        let count = self.parameters.len();
        if count >= MAX_PARAMETERS {
            return self.builder.refuse(format!("the uniforms have more than {MAX_PARAMETERS} vectors"));
        }
        let register = Register::new(RegisterFile::Constant, FIRST_NAMED + count as u16);
        let (source, span) = (ParameterSource::Named([0; 4]), self.builder.span);
        self.parameters.push(Parameter { name, register, source, width, span });
        let ((binding, size), half) = (self.memory, is_half(Some(scalar)));
        self.interface.uniforms.push(WgslUniform { binding, size, offset, half });
        value.extend((0..width as u8).map(|lane| Component::Place(register, lane)));
        Ok(())
    }

    pub(super) fn constant(&mut self, handle: Handle<Expression>) -> Result<Value, Refusal> {
        self.step(None)?;
        match &self.module.global_expressions[handle] {
            Expression::Compose { components, .. } => {
                let parts = components.iter().map(|part| self.constant(*part)).collect::<Result<Vec<_>, _>>()?;
                Ok(parts.concat())
            }
            Expression::Splat { size, value } => {
                let value = self.constant(*value)?;
                Ok(vec![value[0]; *size as usize])
            }
            other => self.leaf(other),
        }
    }

    pub(super) fn leaf(&mut self, expression: &Expression) -> Result<Value, Refusal> {
        use naga::Literal as L;
        let module = self.module;
        let literal = match expression {
            Expression::Literal(literal) => literal,
            Expression::Constant(constant) => return self.constant(module.constants[*constant].init),
            Expression::Override(handle) => match module.overrides[*handle].init {
                Some(init) => return self.constant(init),
                None => {
                    let name = module.overrides[*handle].name.as_deref().unwrap_or_default();
                    return self.builder.refuse(format!("`override {name}` has no value in the text"));
                }
            },
            Expression::ZeroValue(ty) => return self.zeros(&module.types[*ty].inner),
            _ => return self.refuse_this(),
        };
        Ok(vec![match *literal {
            L::F32(value) => Component::Float(value.to_bits()),
            L::F16(value) => Component::Float(value.to_f32().to_bits()),
            L::AbstractFloat(value) => Component::Float((value as f32).to_bits()),
            L::U32(value) => Component::Int(value.into()),
            L::I32(value) => Component::Int(value.into()),
            L::AbstractInt(value) => Component::Int(value),
            L::Bool(value) => Component::Bool(value),
            _ => return self.builder.refuse("numbers of this type are not translated"),
        }])
    }
}
