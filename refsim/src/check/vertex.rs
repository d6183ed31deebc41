//! V58, W02, W03, and the rules that vertex programs share with ps_2_0. `dataflow` checks V48 and V49.

use super::context::Context;
use super::{RuleId, Warning, WarningId};
use crate::isa::{Mask, RegisterFile, Span, Version};

pub(super) fn check(context: &mut Context<'_>) {
    for (_, instruction) in context.instructions() {
        super::ps_2::shared(context, instruction);
        let Some(destination) = instruction.destination else { continue };
        let x_or_all = matches!(destination.mask, Mask(1) | Mask::ALL);
        match destination.register.file {
            RegisterFile::FogOut | RegisterFile::PointSizeOut if !x_or_all => {
                let message = format!("`{}` is written with a mask other than .x", destination.register);
                context
                    .breach(RuleId::FogAndPointSizeMask, destination.span, message)
                    .help("write it without a mask, or .x");
            }
            RegisterFile::FogOut => warn(
                context,
                (WarningId::FogIsNotBlended, destination.span),
                "`oFog` does not cause fog, because fixed-function fog is not emulated",
                "blend in the pixel program; only OpenGL's pixel programs can read oFog (as FOGC and fragment.fogcoord)",
            ),
            RegisterFile::PointSizeOut => warn(
                context,
                (WarningId::PointsAreNotDrawn, destination.span),
                "`oPts` has no effect, because points are not drawn",
                "draw two triangles for each point",
            ),
            RegisterFile::Address if context.version == Version::Vs1_1 && destination.mask != Mask(1) => {
                context.breach(RuleId::UnsetAddress, destination.span, "`a0` of vs_1_1 only has the component .x");
            }
            _ => {}
        }
    }
}

/// Records a warning once per program, at its first occurrence.
fn warn(context: &mut Context<'_>, (id, span): (WarningId, Span), message: &str, help: &'static str) {
    if context.warnings.iter().all(|warning| warning.id != id) {
        context.warnings.push(Warning { id, span, message: message.to_owned(), help });
    }
}
