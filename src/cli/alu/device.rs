//! The arithmetic of a device's stage: its format, its measured unit, and its rules.

use refsim::device::SumRules;
use refsim::num::{Format, NumberOperation as Op, Unit};

use super::operation::{AluOperation, VectorOperation};
use crate::cli::{Problem, switch};

/// A programmable stage, for `--stage`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AluStage {
    Vertex,
    Pixel,
}

/// A state that a card's unit can be in, for `--state`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Legacy,
    Modern,
    ZeroWins,
    Ieee,
}

impl State {
    /// The unit in this state, and its name; `None` if the unit has no such state.
    const fn of(self, unit: Unit) -> Option<Unit> {
        match (unit, self) {
            (Unit::Nv3x | Unit::Nv3xLegacy, Self::Legacy) => Some(Unit::Nv3xLegacy),
            (Unit::Nv3x | Unit::Nv3xLegacy, Self::Modern) => Some(Unit::Nv3x),
            (Unit::Gt200 | Unit::Gt200ZeroWins, Self::ZeroWins) => Some(Unit::Gt200ZeroWins),
            (Unit::Gt200 | Unit::Gt200ZeroWins, Self::Ieee) => Some(Unit::Gt200),
            _ => None,
        }
    }
}

/// The arithmetic of one stage.
#[derive(Clone, Copy, Debug)]
pub(super) struct AluArithmetic {
    pub(super) format: Format,
    /// Rules of products and sums: the device's, otherwise the format's.
    pub(super) sums: Option<SumRules>,
}

impl AluArithmetic {
    pub(super) fn of_format(format: Format) -> Self {
        Self { format, sums: None }
    }

    /// The arithmetic of a device's stage: by default the stage with a measured unit, otherwise the pixel stage.
    pub(super) fn of_device(name: &str, stage: Option<AluStage>, state: Option<State>) -> miette::Result<Self> {
        let rules = switch::device(name, &[])?.rules;
        let measured = |format: Format| format.unit.is_card();
        let stage = stage.unwrap_or(match (measured(rules.vertex_format), measured(rules.format)) {
            (true, false) => AluStage::Vertex,
            _ => AluStage::Pixel,
        });
        let mut format = if stage == AluStage::Vertex { rules.vertex_format } else { rules.format };
        if let Some(state) = state {
            format.unit = state.of(format.unit).ok_or_else(|| no_state(name, stage))?;
        }
        // Measured units have their own rules, in every state.
        let sums = match stage {
            _ if format.unit.is_card() => SumRules::plain(format),
            AluStage::Vertex => rules.vertex_sums(),
            AluStage::Pixel => rules.sums_in(format),
        };
        Ok(Self { format, sums: Some(sums) })
    }
}

fn no_state(name: &str, stage: AluStage) -> Problem {
    let stage = if stage == AluStage::Vertex { "vertex" } else { "pixel" };
    Problem::usage(
        format!("the {stage} arithmetic of `{name}` has no such state"),
        "leave `--state` out, or use `legacy` or `modern` for vertices of nv30 and nv35, `zero-wins` or `ieee` for gt200",
    )
}

/// Rejects operations that a device's instructions or its unit lack.
pub(super) fn refuse_lacking(operation: AluOperation, format: Format) -> Result<(), Problem> {
    use AluOperation as Alu;
    let name = operation.name();
    if matches!(
        operation,
        Alu::Table(Op::Div | Op::Sqrt | Op::FusedMad | Op::Equal | Op::LessEqual | Op::Less)
            | Alu::RoundToInt
            | Alu::Convert
            | Alu::Dot
            | Alu::Quantize
            | Alu::Dequantize
    ) {
        return Err(Problem::usage(
            format!("`{name}` is not an instruction of any device"),
            "use `--format` with one of the formats that `crossbar alu --help` lists",
        ));
    }
    let newer = matches!(
        operation,
        Alu::Table(Op::Exp2 | Op::Log2 | Op::Sin | Op::Cos | Op::Frc | Op::Floor | Op::Sign)
            | Alu::Set(Op::SetEqual | Op::SetNotEqual, _)
    ) || matches!(name, "sgt" | "sle");
    if format.unit == Unit::Nv2x && newer {
        return Err(Problem::usage(
            format!("the vertex unit of NV20 and NV25 has no `{name}`"),
            "use `--device nv30`, whose vertex unit has it, or `--format fp32`",
        ));
    }
    Ok(())
}

/// Rejects operations of vertex units if the format belongs to another unit.
pub(super) fn refuse_foreign(operation: AluOperation, format: Format) -> Result<(), Problem> {
    let vertex = format.unit.is_vertex_unit();
    let theirs = matches!(
        operation,
        AluOperation::Table(Op::Sign)
            | AluOperation::Rcc
            | AluOperation::Vector(VectorOperation::Expp | VectorOperation::Logp | VectorOperation::Lit)
    );
    let card = format.unit.is_card() && matches!(operation, AluOperation::Vector(VectorOperation::Dst));
    if !vertex && (theirs || card) {
        return Err(Problem::usage(
            format!("`{}` is an instruction of the vertex units of nv20 to nv35; {format} has none", operation.name()),
            "use `--device nv20`, `nv25`, `nv30` or `nv35`, with `--stage vertex`",
        ));
    }
    Ok(())
}
