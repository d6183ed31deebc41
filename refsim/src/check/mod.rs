//! The checker: validates a program for a device, and returns a [`Checked`] program or a list of all violations.
//!
//! Executors accept only [`Checked`] programs and rely on their properties: register numbers are in range, operands are
//! present, blocks are closed, labels exist, subroutines do not recurse, and every register read is written on some
//! path.
//!
//! Where the sources leave a rule open, the checker is strict if a card could not run the program, and lenient
//! otherwise. A component counts as written if some path through branches, loops and calls may have written it.

mod allowed;
mod context;
mod dataflow;
mod declared;
mod facts;
mod flow;
mod fog;
mod fragment;
mod operands;
mod pairs;
mod ps_1;
mod ps_1_4;
mod ps_2;
mod reads;
mod report;
mod resources;
mod rule;
mod shape;
mod slots;
mod vertex;

pub use facts::{Checked, Facts};
pub use reads::{destination_reads, matrix_rows, source_lanes};
pub use report::{CheckReport, Violation, Warning};
pub use rule::{RuleId, WarningId};
pub use slots::SlotCount;

use crate::device::Profile;
use crate::isa::{Program, RegisterFile, Stage, Version};
use context::{Context, Count};

/// Number of registers of a file that programs of a Direct3D version have on a device; `None` if the version does not
/// have the file.
pub fn registers(file: RegisterFile, version: Version, profile: &Profile) -> Option<u32> {
    Count::of(file, version, profile).map(|count| count.value())
}

/// Checks a program for a device.
///
/// The [`Checked`] program carries [`Warning`]s for legal code that does not do what its text suggests. OpenGL fog
/// options are first expanded into instructions, so limits apply to them and executors need no support for them.
///
/// # Errors
/// All violations, in the order of the text.
///
/// ```
/// use refsim::{asm, check, device::Profile};
///
/// let program = asm::assemble("ps_1_4\ntexld r0, t0\nmul r0, r0, c0")?;
/// let r200 = Profile::named("r200")?;
/// let checked = check::check(program, &r200)?;
/// assert_eq!(checked.facts().samplers, 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check(program: Program, profile: &Profile) -> Result<Checked<Program>, CheckReport> {
    let fog = program.fog;
    let mut program = fog::expand(program);
    profile.instruction_formats().assign(&mut program);
    let (mut violations, mut warnings) = (Vec::new(), Vec::new());
    let facts = {
        let mut context = Context::new(&program, profile);
        run(&mut context);
        resources::check(&mut context, fog);
        violations.append(&mut context.violations);
        warnings.append(&mut context.warnings);
        violations.is_empty().then(|| facts::derive(&context))
    };
    match facts {
        Some(facts) => Ok(Checked::new(program, facts, profile.name.clone(), warnings)),
        None => {
            violations.sort_by_key(|v| (v.span.start, v.rule));
            let (version, device, text) = (program.version, profile.name.clone(), program.text);
            Err(CheckReport { version, device, violations, warnings, text })
        }
    }
}

fn run(context: &mut Context<'_>) {
    if context.version.is_fragment_program() {
        shape::version(context);
        slots::check(context);
        return fragment::check(context);
    }
    shape::check(context);
    slots::check(context);
    operands::check(context);
    pairs::check(context);
    declared::check(context);
    flow::check(context);
    dataflow::check(context);
    match context.program.version {
        Version::Ps1_4 => ps_1_4::check(context),
        v if v.is_ps_1_1_to_1_3() => ps_1::check(context),
        v if v.stage() == Stage::Pixel => ps_2::check(context),
        _ => vertex::check(context),
    }
}
