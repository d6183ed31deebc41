//! Shaders in WGSL: the case of one without a case file, and the values of uniforms.

use std::path::Path;

use refsim::exec::{CheckedProgram, Constants};
use refsim::isa::{Parameter, ParameterSource};

use super::{CaseError, binder::Binder};
use crate::error::input_error;
use crate::names::did_you_mean;
use crate::shader::ShaderText;

/// The text of the case of a shader alone: in single precision over 64 x 64 pixels of 8 bits a channel, its
/// `@location(0)` going from (0, 0) in row 0 to (1, 1).
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
    /// Adds uniforms of the command line to a program's constants, and holds that a shader in WGSL has all it reads.
    pub(super) fn uniforms(
        &self,
        mut constants: Constants,
        program: &CheckedProgram,
        text: &ShaderText,
    ) -> Result<Constants, CaseError> {
        let declared = || program.parameters.iter().filter(|p| matches!(p.source, ParameterSource::Named(_)));
        for (name, value) in &self.overrides.uniforms {
            if !declared().any(|parameter| parameter.name == *name) {
                let names: Vec<String> = declared().map(|p| format!("`{}`", p.name)).collect();
                let meant = did_you_mean(name, declared().map(|p| p.name.as_str()));
                let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
                return Err(input_error!("crossbar::case::uniform" =>
                    "`{}` has no uniform `{name}`", text.name(); help "{meant}it has {known}")
                .into());
            }
            constants.named.insert(name.clone(), *value);
        }
        let is_read = |parameter: &Parameter| {
            let mut sources = program.instructions.iter().flat_map(|instruction| &instruction.sources);
            sources.any(|source| source.register == parameter.register)
        };
        let without = declared().find(|p| text.is_wgsl() && !constants.named.contains_key(&p.name) && is_read(p));
        match without {
            Some(Parameter { name, .. }) => Err(input_error!("crossbar::case::uniform" =>
                "`{}` reads the uniform `{name}`, which has no value", text.name();
                help "give it one: `--uniform {name}=0.5` (up to four numbers, as 1,0,0), or `\"{name}\" = [0.5]` in \
                      [constants] of a case")
            .into()),
            None => Ok(constants),
        }
    }
}
