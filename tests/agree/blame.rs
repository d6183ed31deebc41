//! Finds the first differing instruction: both sides are traced through the first pixel that differs.

use crate::executors::Executor;
use crate::scene::{Case, Programs, Scene};
use crossbar::compare::{TargetFormats, TraceDifference, TraceSide, TraceStage, first_difference};
use refsim::exec::ResolvedConstants;
use refsim::isa::Program;
use refsim::machine::FragmentTrace;
use std::fmt::Write as _;

/// A case and its executors.
#[derive(Clone, Copy)]
pub(crate) struct Side<'a> {
    pub(crate) case: &'a Case,
    pub(crate) executor: &'a Executor,
}

/// The programs and traces of one side.
struct Followed {
    programs: Programs,
    constants: ResolvedConstants,
    traces: Vec<Vec<FragmentTrace>>,
}

impl Side<'_> {
    fn follow(&self) -> Result<Followed, String> {
        let scene = &self.case.scene;
        let programs = self.case.build()?;
        let constants = ResolvedConstants::pixel(&programs.pixel, &scene.profile.rules, &scene.pixel_constants);
        let traces = scene.traces(self.executor, &programs).map_err(|e| e.to_string())?;
        Ok(Followed { programs, constants, traces })
    }
}

impl Followed {
    fn side<'a>(&'a self, scene: &Scene, pixel: usize) -> TraceSide<'a> {
        TraceSide {
            program: &self.programs.pixel,
            format: scene.profile.rules.format,
            constants: &self.constants,
            fragments: &self.traces[pixel],
        }
    }
}

/// Describes the first difference of two sides at the first pixel that differs.
pub(crate) fn blame(left: Side<'_>, right: Side<'_>) -> String {
    let (a, b) = match (left.follow(), right.follow()) {
        (Ok(a), Ok(b)) => (a, b),
        (Err(e), _) | (_, Err(e)) => return format!("cannot be followed: {e}"),
    };
    let (scene, other) = (&left.case.scene, &right.case.scene);
    let shape = TargetFormats { targets: &scene.targets, depth: scene.depth.map(|(format, _)| format) };
    for pixel in 0..a.traces.len().min(b.traces.len()) {
        let found = first_difference(&a.side(scene, pixel), &b.side(other, pixel), &shape);
        if let Some(difference) = found {
            let (x, y) = (pixel % scene.size[0] as usize, pixel / scene.size[0] as usize);
            return format!("followed at ({x}, {y}), {}", words(&difference, &left.case.pixel, &a.programs.pixel));
        }
    }
    "followed pixel by pixel the sides are equal: the draw differs from its own trace".to_owned()
}

/// Describes a difference, with its line of the program.
fn words(difference: &TraceDifference, lines: &[String], program: &Program) -> String {
    let at = difference.pass;
    let mut text = format!("pass {} (instance {}, triangle {}): ", at.index, at.instance, at.triangle);
    let line = |index: usize| {
        let text = lines.join("\n");
        let span = program.instructions.get(index).map_or(0..0, |i| i.span.start as usize..i.span.end as usize);
        text.get(span).unwrap_or_default().to_owned()
    };
    let _ = match &difference.stage {
        TraceStage::Instruction { index } => write!(text, "`{}`", line(*index)),
        TraceStage::Mask { index, left, right } => {
            write!(text, "mask {:04b} or {:04b} of `{}`", left.0, right.0, line(*index))
        }
        other => write!(text, "{other:?}"),
    };
    for value in &difference.values {
        let (name, a, b) = (&value.name, &value.left, &value.right);
        let _ = write!(text, "\n  {name}: {a} ({}), {b} ({})", value.left_bits, value.right_bits);
    }
    for operand in &difference.operands {
        for value in &operand.values {
            let _ = write!(text, "\n  from {} = {} ({})", value.name, value.left, value.left_bits);
        }
    }
    if let Some(later) = &difference.instruction {
        let _ = write!(text, "\n  then {}", words(later, lines, program));
    }
    text
}
