//! `crossbar check`: is this shader legal on that card?

use std::path::PathBuf;

use refsim::{check::Violation, device::Profile};
use serde_json::{Value, json};

use super::{Out, Verdict};
use crate::shader::{ShaderError, ShaderText, slots};

const EXAMPLES: &str = "\
Examples:
  crossbar check intersect.psa --device r200
      every rule and limit of the Radeon 8500 that the program breaks, each with its place
  crossbar check intersect.psa --device r200 --switch ray-textures=wide --json
      the same with an open question of the card answered otherwise, for machines

Exit codes: 0 the program is legal, 1 it breaks a rule or limit, 2 it is no program (or there is no such file or device).";

/// Assemble a shader and report every rule and device limit that it breaks
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The shader, a text file that starts with a version such as ps_1_4
    shader: PathBuf,

    /// The device whose limits hold; `crossbar devices` lists them
    #[arg(long, value_name = "D")]
    device: String,

    /// A switch of the device; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = super::switch::parse)]
    switch: Vec<(String, String)>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let mut profile = Profile::named(&args.device)?;
    for (name, value) in &args.switch {
        profile.set_switch(name, value)?;
    }
    let text = ShaderText::read(&args.shader)?;
    let program = text.assemble()?;
    let (version, size) = (program.version, slots(&program));
    out.outlive_reader();
    match text.check(program, &profile) {
        Ok(_) if out.json() => {
            out.document(&json!({
                "shader": text.name(),
                "device": profile.name,
                "version": version.token(),
                "legal": true,
                "texture_slots": size.texture,
                "arithmetic_slots": size.arithmetic,
                "violations": [],
            }))?;
            Ok(Verdict::Done)
        }
        Ok(_) => {
            let (texture, arithmetic) = (size.texture, size.arithmetic);
            out.line(format_args!(
                "`{}` is a legal {version} program for `{}`: {texture} texture and {arithmetic} arithmetic slots",
                text.name(),
                profile.name
            ))?;
            Ok(Verdict::Done)
        }
        Err(ShaderError::Illegal { violations, .. }) if out.json() => {
            out.document(&json!({
                "shader": text.name(),
                "device": profile.name,
                "version": version.token(),
                "legal": false,
                "violations": violations.iter().map(violation_json).collect::<Vec<_>>(),
            }))?;
            Ok(Verdict::Failed)
        }
        Err(illegal @ ShaderError::Illegal { .. }) => {
            out.finding(&illegal)?;
            Ok(Verdict::Failed)
        }
        Err(other) => Err(other.into()),
    }
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
