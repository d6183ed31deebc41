//! WGSL front end: translates a fragment entry point into straight-line code.

mod builder;
mod builtins;
mod expressions;
mod finish;
mod operators;
mod statements;
mod translator;
mod values;

use std::collections::BTreeMap;
#[cfg(not(target_family = "wasm"))]
use std::{panic::resume_unwind, thread};

use naga::front::wgsl::{Frontend, Options};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Binding, BuiltIn, EntryPoint, Interpolation, Module, ShaderStage, Type};

use super::half::{comment, redefines_half};
use super::interface::{Translation, WgslInput};
use super::refusal::Refusal;
use crate::isa::{
    ConstantDef, ConstantValue, FIRST_LITERAL, Program, ProgramText, Register, RegisterFile, Span, Version,
};
use translator::{Meaning, Translator, place};
use values::{Component, Value, is_half, scalars};

/// Maximum length of a text, in bytes.
const MAX_TEXT: usize = 1 << 18;

/// WGSL extensions that a text may use: f16 and `quantizeToF16`.
const CAPABILITIES: Capabilities = Capabilities::SHADER_FLOAT16.union(Capabilities::SHADER_FLOAT16_IN_FLOAT32);

/// Stack of the front end, in bytes: it calls itself for each term of an expression.
#[cfg(not(target_family = "wasm"))]
const STACK: usize = 1 << 28;

/// WebAssembly has no threads. It uses the browser's stack, and the browser aborts the module if that overflows.
#[cfg(target_family = "wasm")]
pub(super) fn translate(text: &str) -> Result<Translation, Refusal> {
    translated(text)
}

#[cfg(not(target_family = "wasm"))]
pub(super) fn translate(text: &str) -> Result<Translation, Refusal> {
    thread::scope(|scope| {
        let work = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || translated(text));
        match work.map(thread::ScopedJoinHandle::join) {
            Ok(Ok(program)) => program,
            Ok(Err(panic)) => resume_unwind(panic),
            Err(_) => Err(Refusal::new("the operating system could not start a thread", Span::default())),
        }
    })
}

fn translated(text: &str) -> Result<Translation, Refusal> {
    if text.len() > MAX_TEXT {
        return Err(Refusal::new(format!("the shader is longer than {MAX_TEXT} bytes"), Span::default()));
    }
    let module = parsed(text)?;
    let info = Validator::new(ValidationFlags::all(), CAPABILITIES).validate(&module);
    let info = info.map_err(|error| {
        let span = error.spans().next().and_then(|(span, _)| place(*span)).unwrap_or_default();
        Refusal::new(first_cause(error.as_inner()), span).with_help("the text is not valid WGSL")
    })?;
    let fragments: Vec<usize> =
        (0..module.entry_points.len()).filter(|i| module.entry_points[*i].stage == ShaderStage::Fragment).collect();
    let mut translator = Translator::new(text, &module, &info);
    let head = |index: usize| translator.word_behind(0, &module.entry_points[index].name).unwrap_or_default();
    let [index] = fragments[..] else {
        let message = format!("expected one function with @fragment, found {}", fragments.len());
        let place = fragments.get(1).map(|second| head(*second)).unwrap_or_default();
        return Err(Refusal::new(message, place).with_help("keep one fragment entry point in the text"));
    };
    let (entry, head) = (&module.entry_points[index], head(index));
    translator.declare()?;
    let mut arguments = Vec::new();
    for argument in &entry.function.arguments {
        let name = argument.name.as_deref().unwrap_or_default();
        translator.builder.span = translator.word_behind(head.end as usize, name).unwrap_or(head);
        arguments.push(Meaning::Value(translator.input(argument.ty, argument.binding.as_ref())?));
    }
    let value = translator.call(&entry.function, info.get_entry_point(index), arguments, 0)?;
    let operations = match redefines_half(text) {
        true => Vec::new(),
        false => std::mem::take(&mut translator.operations).into_values().collect(),
    };
    let mut interface = std::mem::take(&mut translator.interface);
    interface.entry.clone_from(&entry.name);
    Ok(Translation { program: translator.finish(entry, head, &value)?, operations, interface })
}

fn parsed(text: &str) -> Result<Module, Refusal> {
    let options = Options { parse_doc_comments: false, capabilities: CAPABILITIES };
    Frontend::new_with_options(options).parse(text).map_err(|error| {
        let (span, label) = error.labels().next().map(|(span, label)| (place(span), label)).unwrap_or_default();
        let is_news = |note: &&str| !note.is_empty() && *note != "see msg" && !error.message().contains(note);
        let notes: Vec<&str> = std::iter::once(label).chain(error.notes()).filter(is_news).collect();
        let help = if notes.is_empty() { "the text is not valid WGSL".to_owned() } else { notes.join("; ") };
        Refusal::new(error.message(), span.unwrap_or_default()).with_help(help)
    })
}

/// Extends the span of a function's name, which is all that naga keeps, to the whole call.
fn with_arguments(text: &str, span: Span) -> Span {
    let rest = text.get(span.end as usize..).filter(|rest| rest.starts_with('(')).unwrap_or_default();
    let (mut open, mut at) = (0, 0);
    while let Some(byte) = rest.as_bytes().get(at) {
        open += i32::from(*byte == b'(') - i32::from(*byte == b')');
        at += 1;
        if open == 0 {
            return Span::new(span.start, span.end + at as u32);
        }
        at += rest.get(at..).map_or(0, comment);
    }
    span
}

/// The root cause of an error, which describes the problem; outer errors only name naga's internal handles.
fn first_cause(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes.last().map(ToString::to_string).unwrap_or_default()
}

impl Translator<'_> {
    fn input(&mut self, ty: naga::Handle<Type>, binding: Option<&Binding>) -> Result<Value, Refusal> {
        let inner = &self.module.types[ty].inner;
        let Some(binding) = binding else {
            let naga::TypeInner::Struct { members, .. } = inner else {
                return self.builder.refuse("an input has no @location");
            };
            let start = place(self.module.types.get_span(ty)).unwrap_or_default().start as usize;
            let parts = members.iter().map(|member| {
                let name = member.name.as_deref().unwrap_or_default();
                self.builder.span = self.word_behind(start, name).unwrap_or(self.builder.span);
                self.input(member.ty, member.binding.as_ref())
            });
            return Ok(parts.collect::<Result<Vec<_>, _>>()?.concat());
        };
        let register = match binding {
            Binding::Location { interpolation: Some(Interpolation::Flat | Interpolation::Linear), .. } => {
                return self.builder.refuse("only perspective interpolation is translated");
            }
            Binding::Location { location: location @ 0..8, .. } => {
                Register::new(RegisterFile::Texture, *location as u16)
            }
            Binding::BuiltIn(BuiltIn::Position { .. }) => Register::new(RegisterFile::WindowPosition, 0),
            Binding::Location { .. } => return self.builder.refuse("inputs must be @location(0) to @location(7)"),
            Binding::BuiltIn(_) => return self.builder.refuse("position is the only builtin input that is translated"),
        };
        let list = scalars(self.module, inner).unwrap_or_default();
        if list.is_empty() || list.len() > 4 || list.iter().any(|scalar| scalar.kind != naga::ScalarKind::Float) {
            return self.builder.refuse("inputs must be f32, f16 or vectors of these");
        }
        if let Binding::Location { location, .. } = binding {
            let (width, half) = (list.len(), is_half(list.first().copied()));
            self.interface.inputs.push(WgslInput { location: *location, width, half });
        }
        Ok((0..list.len() as u8).map(|lane| Component::Place(register, lane)).collect())
    }

    /// Writes the outputs and assembles the program from the instructions.
    fn finish(mut self, entry: &EntryPoint, head: Span, value: &[Component]) -> Result<Program, Refusal> {
        let text = self.text;
        let refused = |message: &str| Err(Refusal::new(message, head));
        if self.killed != Component::Bool(false) {
            let killed = self.killed;
            self.builder.kill(killed)?;
        }
        let Some(result) = &entry.function.result else {
            return refused("the entry point returns no color");
        };
        let mut outputs = Vec::new();
        match (&result.binding, &self.module.types[result.ty].inner) {
            (Some(binding), _) => outputs.push((binding.clone(), value.len())),
            (None, naga::TypeInner::Struct { members, .. }) => {
                for member in members {
                    let length = scalars(self.module, &self.module.types[member.ty].inner).unwrap_or_default().len();
                    outputs.extend(member.binding.clone().map(|binding| (binding, length)));
                }
            }
            _ => {}
        }
        let mut rest = value;
        for (binding, length) in outputs {
            let Some((part, after)) = rest.split_at_checked(length).filter(|(part, _)| !part.is_empty()) else {
                return refused("a path through the entry point returns no color");
            };
            rest = after;
            match binding {
                Binding::Location { location: 0, blend_src: None, .. } if part.len() <= 4 => {
                    let mut color = part.to_vec();
                    // Components missing from a color are filled from (0, 0, 0, 1).
                    color.extend((part.len()..4).map(|lane| Component::Float(if lane == 3 { 0x3f80_0000 } else { 0 })));
                    self.builder.output(Register::new(RegisterFile::ColorOut, 0), 0b1111, &color)?;
                }
                Binding::BuiltIn(BuiltIn::FragDepth) => {
                    self.builder.output(Register::new(RegisterFile::DepthOut, 0), 0b0100, &part[..1])?;
                }
                _ => return refused("only the outputs @location(0) and frag_depth are translated"),
            }
        }
        let mut instructions = finish::without_unused(self.builder.instructions);
        instructions.iter_mut().for_each(|instruction| instruction.span = with_arguments(text, instruction.span));
        finish::numbered(&mut instructions)?;
        let literal = |(index, numbers): (usize, &[Option<u32>; 4])| ConstantDef {
            register: Register::new(RegisterFile::Constant, FIRST_LITERAL + index as u16),
            value: ConstantValue::Float(numbers.map(Option::unwrap_or_default)),
            position: 0,
            span: Span::default(),
        };
        Ok(Program {
            version: Version::Fp1_0,
            version_span: Span::default(),
            constants: self.builder.literals.iter().enumerate().map(literal).collect(),
            declarations: Vec::new(),
            instructions,
            parameters: self.parameters,
            resources: BTreeMap::new(),
            fog: None,
            text: ProgramText::new(text),
        })
    }
}
