//! `crossbar check`: checks whether a shader is legal on a card.

use std::path::PathBuf;

use refsim::check::{Violation, Warning};
use serde_json::{Value, json};

use super::{Out, Verdict};
use crate::shader::{ShaderError, ShaderText, slots};

const EXAMPLES: &str = "\
Examples:
  crossbar check docs/examples/intersect.psa --device r200
      every rule and limit of the Radeon 8500 that the program breaks, each with its place
  crossbar check docs/examples/intersect.psa --device r200 --switch ray-textures=wide --json
      the same with another setting of an open switch of the card, as JSON

Exit codes: 0 the program is legal (warnings list what may run differently), 1 it breaks a rule or limit, 2 the \
file is not a program, or there is no such file or device.";

/// Assemble a shader and report every rule and device limit that it breaks
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The shader, a text file that starts with a version such as ps_1_4; or a WGSL shader
    shader: PathBuf,

    /// The device whose rules and limits apply; `crossbar devices` lists the devices
    #[arg(long, value_name = "D")]
    device: String,

    /// A switch of the device; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = super::switch::parse)]
    switch: Vec<(String, String)>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let profile = super::switch::device(&args.device, &args.switch)?;
    let text = ShaderText::read(&args.shader)?;
    let program = text.assemble()?;
    let (version, size) = (program.version, slots(&program));
    out.outlive_reader();
    let checked = text.check(program, &profile);
    let (violations, warnings): (&[Violation], &[Warning]) = match &checked {
        Ok(program) => (&[], program.warnings()),
        Err(ShaderError::Illegal { violations, warnings, .. }) => (violations, warnings),
        Err(_) => (&[], &[]),
    };
    let mut document = json!({
        "shader": text.name(),
        "device": profile.name,
        "version": version.token(),
        "legal": checked.is_ok(),
        "violations": violations.iter().map(violation_json).collect::<Vec<_>>(),
        "warnings": warnings.iter().map(warning_json).collect::<Vec<_>>(),
    });
    match checked {
        Ok(_) if out.json() => {
            document["texture_slots"] = size.texture.into();
            document["arithmetic_slots"] = size.arithmetic.into();
            out.document(&document)?;
            Ok(Verdict::Done)
        }
        Ok(program) => {
            let (texture, arithmetic) = (size.texture, size.arithmetic);
            out.line(format_args!(
                "`{}` is a legal {version} program for `{}`: {texture} texture and {arithmetic} arithmetic slots",
                text.name(),
                profile.name
            ))?;
            for warning in text.warnings(&program) {
                out.finding(&warning)?;
            }
            Ok(Verdict::Done)
        }
        Err(illegal @ ShaderError::Illegal { .. }) => {
            if out.json() {
                out.document(&document)?
            } else {
                out.finding(&illegal)?
            }
            Ok(Verdict::Failed)
        }
        Err(other) => Err(other.into()),
    }
}

fn warning_json(warning: &Warning) -> Value {
    json!({
        "code": warning.id.code(),
        "start": warning.span.start,
        "end": warning.span.end,
        "message": warning.message,
        "help": warning.help,
    })
}

fn violation_json(violation: &Violation) -> Value {
    json!({
        "rule": violation.rule.code(),
        "start": violation.span.start,
        "end": violation.span.end,
        "message": violation.message,
        "help": violation.help,
        "key": violation.key,
        "limit": violation.limit,
        "found": violation.found,
    })
}
