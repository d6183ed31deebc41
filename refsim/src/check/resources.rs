//! V67: the resources of an `!!ARBfp1.0` program, counted by section 3.11.3.6 of GL_ARB_fragment_program.

use super::RuleId;
use super::allowed::Limit;
use super::context::{Context, ordinal};
use crate::isa::{FogOption, ProgramResource, RegisterFile, Span};

/// Checks the three counts. A fog option takes one temporary, one attribute and two parameters away from the program
/// (section 3.11.4.5.1).
pub(super) fn check(context: &mut Context<'_>, fog: Option<FogOption>) {
    let option = u32::from(fog.is_some());
    let counts = [
        ("temporaries", "temporary", Limit::Temporaries, option),
        ("parameters", "parameter", Limit::BoundParameters, 2 * option),
        ("attributes", "attribute", Limit::Attributes, option),
    ];
    for (kinds, kind, limit, reserved) in counts {
        let of_kind = |resource: &ProgramResource| match resource {
            ProgramResource::Register(r) if r.file == RegisterFile::Temp => limit == Limit::Temporaries,
            ProgramResource::Register(r) if r.file != RegisterFile::Constant => limit == Limit::Attributes,
            _ => limit == Limit::BoundParameters,
        };
        let resources = context.program.resources.iter().filter(|(resource, _)| of_kind(resource));
        let mut places: Vec<Span> = resources.map(|(_, span)| *span).collect();
        places.sort_by_key(|span| span.start);
        let Some(allowed) = context.limit(limit) else { continue };
        let free = allowed.value.saturating_sub(reserved);
        let Some(&place) = places.get(free as usize) else { continue };
        let found = places.len() as u32;
        let taken = if reserved > 0 { format!(" and its fog option uses {reserved}") } else { String::new() };
        let message = format!("program has {found} {kinds}{taken}, {} allows {}", allowed.owner, allowed.value);
        let label = format!("the {} {kind}", ordinal(free + 1));
        let advice = match limit {
            Limit::Temporaries => "declare fewer temporaries: reuse those whose values are no longer needed",
            Limit::BoundParameters => "bind fewer parameters: equal constants, and numbers in one vector, count once",
            _ => "pass several numbers in one attribute",
        };
        context.breach(RuleId::TooManyResources, place, message).label(label).exceeds(
            found + reserved,
            &allowed,
            advice,
        );
    }
}
