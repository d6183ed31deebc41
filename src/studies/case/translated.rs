//! Shaders in WGSL: the case for a shader without a case file, and the values of uniforms.

use std::collections::BTreeMap;
use std::path::Path;

use refsim::exec::{CheckedProgram, Constants};
use refsim::isa::{Instruction, Parameter, ParameterSource, RegisterFile};

use super::{CaseError, binder::Binder, constants::of_width, error::CaseText, texels::CaseTexture};
use crate::error::input_error;
use crate::names::did_you_mean;
use crate::shader::ShaderText;

/// Example values, by number of components.
const NUMBERS: [&str; 4] = ["0.5", "1,0.5", "1,0.5,0", "1,0.5,0,1"];

/// The text of a case for a lone shader: in single precision over 64 x 64 pixels with 8 bits per channel;
/// `@location(0)` runs from (0, 0) in row 0 to (1, 1).
pub(super) fn lone_shader(path: &Path) -> String {
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let file = toml::Value::String(file.into_owned());
    format!(
        "device = \"ideal-fp32\"\npixel = {{ file = {file} }}\n\
         geometry = {{ full_screen = true, convention = \"opengl\" }}\n\
         target = {{ size = [64, 64], format = \"rgba8\" }}\n"
    )
}

impl Binder<'_> {
    /// Adds uniforms from the command line to a program's constants, and checks that a shader in WGSL has all that it
    /// reads.
    pub(super) fn uniforms(
        &self,
        mut constants: Constants,
        program: &CheckedProgram,
        text: &ShaderText,
    ) -> Result<Constants, CaseError> {
        let declared = || program.parameters.iter().filter(|p| matches!(p.source, ParameterSource::Named(_)));
        for (name, value) in &self.overrides.uniforms {
            let Some(parameter) = declared().find(|parameter| parameter.name == *name) else {
                let names: Vec<String> = declared().map(|p| format!("`{}`", p.name)).collect();
                let meant = did_you_mean(name, declared().map(|p| p.name.as_str()));
                let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
                return Err(input_error!("crossbar::case::uniform" =>
                    "`{}` has no uniform `{name}`", text.name(); help "{meant}the shader has {known}")
                .into());
            };
            let value = of_width(name, parameter.width, value).map_err(|message| {
                input_error!("crossbar::case::uniform" => "`{}`: {message}", text.name();
                    help "write all components, as `--uniform {name}={}`", NUMBERS[parameter.width - 1])
            })?;
            constants.named.insert(name.clone(), value);
        }
        let is_read = |parameter: &Parameter| {
            let mut sources = program.instructions.iter().flat_map(|instruction| &instruction.sources);
            sources.any(|source| source.register == parameter.register)
        };
        let without = declared().find(|p| text.is_wgsl() && !constants.named.contains_key(&p.name) && is_read(p));
        match without {
            Some(Parameter { name, width, .. }) => {
                let numbers = NUMBERS[width - 1];
                Err(input_error!("crossbar::case::uniform" =>
                    "`{}` reads the uniform `{name}`, which has no value", text.name();
                    help "give the uniform a value: `\"{name}\" = [{numbers}]` in [constants] of a case, or, with \
                          `crossbar run` and `precision`, `--uniform {name}={numbers}`")
                .into())
            }
            None => Ok(constants),
        }
    }

    /// Checks that the case has all textures that a shader in WGSL reads; cards read black from a missing texture.
    pub(super) fn has_textures(
        &self,
        program: &CheckedProgram,
        text: &ShaderText,
        textures: &BTreeMap<usize, CaseTexture>,
    ) -> Result<(), CaseError> {
        let reads = |instruction: &Instruction| {
            let mut sources = instruction.sources.iter().map(|source| source.register);
            sources.find(|register| register.file == RegisterFile::Sampler).map(|register| usize::from(register.index))
        };
        let read = program.instructions.iter().filter_map(|instruction| Some((reads(instruction)?, instruction.span)));
        let Some((slot, span)) = read.into_iter().find(|(slot, _)| text.is_wgsl() && !textures.contains_key(slot))
        else {
            return Ok(());
        };
        let of = if self.name == text.name() {
            "a shader file alone has no textures: write a case with"
        } else {
            "add to the case"
        };
        let help = format!(
            "{of} `[[texture]]`, `slot = {slot}`, `format = \"rgba8\"` and `file = \"picture.png\"` (docs/cases.md); \
             slots count the textures of the text from 0"
        );
        let message = format!("this expression reads the texture of slot {slot}, which the case does not have");
        Err(CaseText(text.named_source()).wrong(span.start as usize..span.end as usize, message, help))
    }
}
