//! A comparison as sentences, and as a JSON document.

use std::path::Path;

use serde_json::{Value, json};

use super::{Comparison, First, Setup, Side, fate, letters, run::switches_json};
use crate::compare::{FragmentPass, TraceDifference, TraceStage};

/// A comparison with its sides.
#[derive(Clone, Copy, Debug)]
pub struct ComparedSides<'a> {
    /// Path or name of the case.
    pub case: &'a str,
    /// Left and right side.
    pub sides: &'a [Side<'a>; 2],
    /// Result of the comparison.
    pub comparison: &'a Comparison,
}

/// Instance, triangle and part of a pass, as text.
pub fn pass_text(pass: &FragmentPass) -> String {
    let part = if pass.part > 0 { format!(", part {}", pass.part) } else { String::new() };
    format!("instance {}, triangle {}{part}", pass.instance, pass.triangle)
}

fn pass_json(pass: &FragmentPass) -> Value {
    json!({ "index": pass.index, "instance": pass.instance, "triangle": pass.triangle, "part": pass.part })
}

impl ComparedSides<'_> {
    /// The case on the left side.
    pub fn setup(&self) -> &Setup {
        self.sides[0].setup
    }

    /// Title of the case, or the stem of its path.
    pub fn draw_name(&self) -> String {
        let stem =
            || Path::new(self.case).file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        self.setup().title.clone().unwrap_or_else(stem)
    }

    /// The stage as text, and the index of its instruction, if it has one.
    pub fn stage(&self, difference: &TraceDifference) -> (String, Option<usize>) {
        let name = difference.values.first().map_or("nothing", |v| v.name.as_str());
        let sides = |left: &str, right: &str| format!("{left} on the left, {right} on the right");
        match &difference.stage {
            TraceStage::Vertex { corner } => {
                (format!("stage: vertices: {name} of corner {corner} of the triangle, before set-up"), None)
            }
            TraceStage::Coverage { left, right } => {
                let side = |pass: &Option<FragmentPass>| pass.as_ref().map_or("none".to_owned(), pass_text);
                let sides = sides(&side(left), &side(right));
                (format!("stage: coverage, from the set-up of triangles: {sides}"), None)
            }
            TraceStage::Input => (format!("stage: interpolation of {name}, before the program"), None),
            TraceStage::Delivered => {
                (format!("stage: input register {name}, the interpolated value in the register format"), None)
            }
            TraceStage::Instruction { index } => {
                (format!("instruction {index} writes different values of {name}"), Some(*index))
            }
            TraceStage::Mask { index, left, right } => {
                let [left, right] = [left, right].map(|mask| format!("`{}`", letters(*mask)));
                let sides = sides(&left, &right);
                (
                    format!("instruction {index} writes different components, because of its predicate: {sides}"),
                    Some(*index),
                )
            }
            TraceStage::Flow { left, right } => {
                let side = |next: &Option<usize>| next.map_or("the end".to_owned(), |i| format!("instruction {i}"));
                let sides = sides(&side(left), &side(right));
                (format!("stage: flow control: the next instruction is {sides}"), left.or(*right))
            }
            TraceStage::Output { instruction } => (format!("stage: results of the program: {name}"), *instruction),
            TraceStage::Test { left, right } => {
                let sides = format!("the fragment {} on the left and {} on the right", fate(*left), fate(*right));
                (format!("stage: output tests (the program's results are equal): {sides}"), None)
            }
            TraceStage::Merge => {
                let text = "stage: output merge (quantising, blending, masking); the program's results are equal";
                (format!("{text}: {name}"), None)
            }
        }
    }

    /// Document for programs.
    pub fn document(&self) -> Value {
        let comparison = self.comparison;
        json!({
            "case": self.case,
            "title": self.setup().title,
            "version": env!("CARGO_PKG_VERSION"),
            "left": side_json(&self.sides[0]),
            "right": side_json(&self.sides[1]),
            "equal": comparison.equal(),
            "pixels": comparison.pixels,
            "different": comparison.different,
            "surfaces": comparison.surfaces,
            "counts": comparison.counts,
            "followed": { "pixels": comparison.followed[0], "different": comparison.followed[1] },
            "first": comparison.first.as_ref().map(|first| self.first_json(first)),
        })
    }

    fn first_json(&self, first: &First) -> Value {
        json!({
            "draw": { "index": 0, "name": self.draw_name() },
            "pixel": first.pixel,
            "difference": first.difference.as_ref().map(|difference| self.difference_json(difference)),
        })
    }

    fn difference_json(&self, difference: &TraceDifference) -> Value {
        let (text, instruction) = self.stage(difference);
        let mut value = json!({
            "pass": pass_json(&difference.pass),
            "passes": difference.passes,
            "stage": stage_name(&difference.stage),
            "text": text,
            "instruction": instruction.map(|index| self.instruction_json(index)),
            "values": difference.values,
            "operands": difference.operands.iter().map(|operand| {
                json!({ "differs": operand.differs, "values": operand.values })
            }).collect::<Vec<_>>(),
        });
        match &difference.stage {
            TraceStage::Vertex { corner } => value["corner"] = (*corner).into(),
            TraceStage::Coverage { left, right } => {
                value["left"] = json!(left.as_ref().map(pass_json));
                value["right"] = json!(right.as_ref().map(pass_json));
            }
            TraceStage::Mask { left, right, .. } => {
                (value["left"], value["right"]) = (letters(*left).into(), letters(*right).into());
            }
            TraceStage::Flow { left, right } => {
                value["left"] = json!(left.map(|index| self.instruction_json(index)));
                value["right"] = json!(right.map(|index| self.instruction_json(index)));
            }
            TraceStage::Test { left, right } => {
                (value["left"], value["right"]) = (fate(*left).into(), fate(*right).into());
            }
            _ => {}
        }
        if let Some(later) = &difference.instruction {
            value["later"] = self.difference_json(later);
        }
        value
    }

    fn instruction_json(&self, index: usize) -> Value {
        let setup = self.setup();
        let line = setup.pixel_text.instruction(&setup.pixel, index);
        json!({ "index": index, "source": line })
    }
}

const fn stage_name(stage: &TraceStage) -> &'static str {
    match stage {
        TraceStage::Vertex { .. } => "vertices",
        TraceStage::Coverage { .. } => "coverage",
        TraceStage::Input => "interpolation",
        TraceStage::Delivered => "input",
        TraceStage::Instruction { .. } => "instruction",
        TraceStage::Mask { .. } => "predicate",
        TraceStage::Flow { .. } => "flow",
        TraceStage::Output { .. } => "output",
        TraceStage::Test { .. } => "test",
        TraceStage::Merge => "merge",
    }
}

fn side_json(side: &Side<'_>) -> Value {
    let profile = &side.setup.profile;
    json!({
        "executor": side.executor.kind().name(),
        "device": profile.name,
        "format": profile.rules.format.to_string(),
        "switches": switches_json(profile),
        "left_out": side.setup.left_out,
    })
}
