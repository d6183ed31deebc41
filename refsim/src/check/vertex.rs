//! V58, and the rules that vertex programs share with ps_2_0. `dataflow` checks V48 and V49.

use super::RuleId;
use super::context::Context;
use crate::isa::{Mask, RegisterFile, Version};

pub(super) fn check(context: &mut Context<'_>) {
    for (_, instruction) in context.instructions() {
        super::ps_2::shared(context, instruction);
        let Some(destination) = instruction.destination else { continue };
        let x_or_all = matches!(destination.mask, Mask(1) | Mask::ALL);
        match destination.register.file {
            RegisterFile::FogOut | RegisterFile::PointSizeOut if !x_or_all => {
                let message = format!("`{}` is written through other components than .x", destination.register);
                context
                    .breach(RuleId::FogAndPointSizeMask, destination.span, message)
                    .help("write it without a mask, or .x");
            }
            RegisterFile::Address if context.version == Version::Vs1_1 && destination.mask != Mask(1) => {
                context.breach(RuleId::UnsetAddress, destination.span, "`a0` of vs_1_1 has no component but .x");
            }
            _ => {}
        }
    }
}
