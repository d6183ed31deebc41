//! Builder of a program: instructions, literals, parameters.

use std::collections::BTreeMap;

use super::super::error::{ErrorKind, Parsed, SyntaxError, quote};
use crate::asm::lexer::Token;
use crate::isa::{
    ConstantDef, ConstantValue, FIRST_LITERAL, FIRST_NAMED, FogOption, Instruction, Parameter, ParameterSource,
    Program, ProgramResource, ProgramText, Register, RegisterFile, Span, StateBinding, Version,
};

/// Maximum numbers of literals and of parameters. The last two parameters are reserved for fog options.
const MAX_LITERALS: usize = 4096;
const MAX_NAMED: usize = (FIRST_LITERAL - FIRST_NAMED) as usize - 2;

/// The parts of a program under construction.
#[derive(Default)]
pub(super) struct Build {
    pub(super) instructions: Vec<Instruction>,
    constants: Vec<ConstantDef>,
    literals: BTreeMap<[u32; 4], u16>,
    parameters: Vec<Parameter>,
    pub(super) resources: BTreeMap<ProgramResource, Span>,
    pub(super) fog: Option<FogOption>,
}

impl Build {
    /// Records the program's declarations and bindings.
    pub(super) fn bind(&mut self, resource: ProgramResource, span: Span) {
        self.resources.entry(resource).or_insert(span);
    }

    /// Register of a literal; equal literals share one register.
    pub(super) fn literal(&mut self, value: [u32; 4], span: Span) -> Parsed<Register> {
        let count = self.constants.len();
        if let Some(&index) = self.literals.get(&value) {
            return Ok(Register::new(RegisterFile::Constant, index));
        }
        if count >= MAX_LITERALS {
            return Err(SyntaxError::new(
                ErrorKind::ValueCount,
                span,
                format!("at most {MAX_LITERALS} different constants in the text"),
                "one more",
                "let the host set constants, as `p[0]` or `program.local[0]`",
            ));
        }
        let register = Register::new(RegisterFile::Constant, FIRST_LITERAL + count as u16);
        self.literals.insert(value, register.index);
        let value = ConstantValue::Float(value);
        self.constants.push(ConstantDef { register, value, position: 0, span });
        Ok(register)
    }

    /// Register of a constant that the host sets by name.
    pub(super) fn parameter(&mut self, name: Token<'_>, default: [u32; 4]) -> Parsed<Register> {
        self.set_by_host(name.text.to_owned(), ParameterSource::Named(default), name.span)
    }

    /// Register of an item of OpenGL state; equal items share one register.
    pub(super) fn state(&mut self, binding: StateBinding, span: Span) -> Parsed<Register> {
        let source = ParameterSource::State(binding);
        match self.parameters.iter().find(|p| p.source == source) {
            Some(known) => Ok(known.register),
            None => self.set_by_host(binding.to_string(), source, span),
        }
    }

    fn set_by_host(&mut self, name: String, source: ParameterSource, span: Span) -> Parsed<Register> {
        let count = self.parameters.len();
        if count >= MAX_NAMED {
            return Err(SyntaxError::new(
                ErrorKind::ValueCount,
                span,
                format!("at most {MAX_NAMED} names that the host can set"),
                quote(&name),
                "use numbered parameters",
            ));
        }
        let register = Register::new(RegisterFile::Constant, FIRST_NAMED + count as u16);
        self.parameters.push(Parameter { name, register, source, width: 4, span });
        Ok(register)
    }

    /// Returns the program.
    pub(super) fn finish(self, version: Version, version_span: Span) -> Program {
        Program {
            version,
            version_span,
            constants: self.constants,
            declarations: Vec::new(),
            instructions: self.instructions,
            parameters: self.parameters,
            resources: self.resources,
            fog: self.fog,
            text: ProgramText::default(),
        }
    }
}
