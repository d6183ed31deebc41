//! Shader texts from files and cases: reading, assembly, checking, and errors with name and position.

use std::{io, path::Path, sync::Arc};

use miette::{Diagnostic, SourceSpan};
use refsim::{
    asm::{self, SyntaxError},
    check::{self, Checked, SlotCount, Violation, Warning},
    device::Profile,
    front::{self, Refusal},
    isa::{Program, Span, Version},
};
use serde::Serialize;

use crate::error::{InputError, input_error};
use crate::io::read_limited;
use crate::report::{SourceText, quoted_line};

/// Maximum length of a shader file, in bytes: the limit of the assembler.
const MAX_BYTES: u64 = asm::MAX_TEXT as u64;

/// Shader text with its name in messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderText {
    source: Arc<SourceText>,
}

/// Line of a shader, for quotation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SourceLine {
    /// Name of the shader.
    pub file: String,
    /// Line number, from 1.
    pub line: usize,
    /// Column of the quoted position, from 1.
    pub column: usize,
    /// Trimmed line; a long one is truncated around the position.
    pub text: String,
}

/// Error of reading, assembling or checking a shader.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum ShaderError {
    #[error("shader `{name}` cannot be read")]
    #[diagnostic(code(crossbar::shader::unreadable), help("check the path"))]
    Unreadable { name: String, source: io::Error },
    /// The file is too long, or not text.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Input(#[from] InputError),
    #[error("`{name}` has {}", count(errors.len(), "syntax error"))]
    #[diagnostic(code("asm::syntax"))]
    Syntax {
        name: String,
        #[source_code]
        source_code: Arc<SourceText>,
        /// All errors, in the order of the text; at least one.
        #[related]
        errors: Vec<SyntaxError>,
    },
    #[error("`{name}` cannot be translated: {reason}")]
    #[diagnostic(code("front::wgsl"), help("{}", reason.help()))]
    Refused {
        name: String,
        #[source_code]
        source_code: Arc<SourceText>,
        reason: Refusal,
        #[label("here")]
        span: Option<SourceSpan>,
    },
    #[error("`{name}` is not a legal {version} program for `{device}`: {}", count(violations.len(), "violation"))]
    #[diagnostic(code("check"))]
    Illegal {
        name: String,
        version: Version,
        device: String,
        #[source_code]
        source_code: Arc<SourceText>,
        /// All violations, in the order of the text; at least one.
        #[related]
        violations: Vec<Violation>,
        /// All warnings, in the order of the text.
        warnings: Vec<Warning>,
    },
}

/// Warning of the checker with the text that it refers to.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[error("{message}")]
#[diagnostic(code("check"), severity(Warning), help("{code}: {help}"))]
pub struct ShaderWarning {
    code: &'static str,
    message: String,
    help: &'static str,
    #[source_code]
    source_code: Arc<SourceText>,
    #[label("here")]
    span: SourceSpan,
}

impl ShaderWarning {
    /// Code of the warning, `W01` for example.
    pub fn id(&self) -> &'static str {
        self.code
    }
}

/// Returns `true` if a path names a shader in WGSL.
pub fn is_wgsl(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "wgsl")
}

fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}

impl ShaderText {
    /// Creates a shader text from a source other than a separate file.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { source: Arc::new(SourceText::new(name, text)) }
    }

    /// Reads a shader file. Fails if it cannot be read, is not text or exceeds the limit of the assembler.
    pub fn read(path: &Path) -> Result<Self, ShaderError> {
        let name = path.display().to_string();
        let unreadable = |source| ShaderError::Unreadable { name: name.clone(), source };
        // Reads no more than the limit: the path may name an endless device file.
        let Some(bytes) = read_limited(path, MAX_BYTES).map_err(unreadable)? else {
            return Err(input_error!(
                "crossbar::shader::length" => "expected a shader of at most {MAX_BYTES} bytes, found more in `{name}`";
                help "check that this is the file you mean"
            )
            .into());
        };
        let text = String::from_utf8(bytes).map_err(|error| {
            let offset = error.utf8_error().valid_up_to();
            let byte = error.as_bytes().get(offset).copied().unwrap_or_default();
            input_error!(
                "crossbar::shader::text" =>
                "expected a shader in ASCII or UTF-8, found byte {byte:#04x} at offset {offset} of `{name}`";
                help "give a file with shader assembly, not a compiled shader"
            )
        })?;
        Ok(Self::new(name, text))
    }

    /// Name in messages.
    pub fn name(&self) -> &str {
        self.source.name()
    }

    /// Line on which a span of the text starts.
    pub fn line(&self, span: Span) -> SourceLine {
        let start = span.start as usize;
        let line = self.source.line_of(start);
        let range = self.source.line_range(line);
        let text = self.source.text().get(range.clone()).unwrap_or_default();
        SourceLine {
            file: self.name().to_owned(),
            line: 1 + line,
            column: 1 + self.source.column_of(start),
            text: quoted_line(text.trim_end_matches(['\n', '\r']), start - range.start),
        }
    }

    /// Line of an instruction; in WGSL, where a line may have several instructions, only its expression.
    pub fn instruction(&self, program: &Program, index: usize) -> Option<SourceLine> {
        let line = self.line(program.instructions.get(index)?.span);
        match program.instruction_text(index).filter(|_| self.is_wgsl()) {
            Some(text) => Some(SourceLine { text, ..line }),
            None => Some(line),
        }
    }

    /// Text with its name, in the form that errors need.
    pub fn named_source(&self) -> Arc<SourceText> {
        self.source.clone()
    }

    /// Returns `true` if the name has the extension of a WGSL file.
    pub fn is_wgsl(&self) -> bool {
        is_wgsl(Path::new(self.name()))
    }

    /// Assembles the text, or translates WGSL; fails with all syntax errors, or with the first untranslated construct.
    pub fn assemble(&self) -> Result<Program, ShaderError> {
        if self.is_wgsl() {
            return front::translate_wgsl(self.source.text()).map_err(|reason| ShaderError::Refused {
                name: self.name().to_owned(),
                source_code: self.named_source(),
                span: reason.place().map(SourceSpan::from),
                reason,
            });
        }
        asm::assemble(self.source.text()).map_err(|found| ShaderError::Syntax {
            name: self.name().to_owned(),
            source_code: self.named_source(),
            errors: found.errors,
        })
    }

    /// Checks the text's program against its version and a device. Fails with all violations.
    pub fn check(&self, program: Program, profile: &Profile) -> Result<Checked<Program>, ShaderError> {
        check::check(program, profile).map_err(|report| ShaderError::Illegal {
            name: self.name().to_owned(),
            version: report.version,
            device: report.device,
            source_code: self.named_source(),
            violations: report.violations,
            warnings: report.warnings,
        })
    }

    /// Warnings about the text's program, with its text.
    pub fn warnings<'a>(&'a self, program: &'a Checked<Program>) -> impl Iterator<Item = ShaderWarning> + 'a {
        program.warnings().iter().map(|warning| {
            let (start, end) = (warning.span.start as usize, warning.span.end as usize);
            ShaderWarning {
                code: warning.id.code(),
                message: warning.message.clone(),
                help: warning.help,
                source_code: self.named_source(),
                span: (start, end.saturating_sub(start)).into(),
            }
        })
    }
}

/// Counts the instruction slots of a program; a co-issued instruction takes none.
pub fn slots(program: &Program) -> SlotCount {
    let alone = program.instructions.iter().filter(|instruction| !instruction.coissue);
    alone.fold(SlotCount::default(), |sum, instruction| {
        let cost = instruction.opcode.info().slot_cost(program.version);
        SlotCount {
            texture: sum.texture + u32::from(cost.texture),
            arithmetic: sum.arithmetic + u32::from(cost.arithmetic),
        }
    })
}
