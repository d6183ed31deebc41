//! The arithmetic of a device's stage: its format, its measured unit, and its rules.

use refsim::device::SumRules;
use refsim::num::{Format, NumberOperation as Op, Unit};

use super::operation::AluOperation;
use crate::cli::{Problem, switch};

/// Value of `--state`: a card's unit in each of its states, then in the chosen state.
pub(super) type State = ([Unit; 2], Unit);

/// A number format, and a device's rules for products and sums; by default, the format's rules apply.
pub(super) type AluArithmetic = (Format, Option<SumRules>);

/// The arithmetic of a device's stage: by default the stage with a measured unit, otherwise the pixel stage.
pub(super) fn arithmetic(name: &str, is_vertex: Option<bool>, state: Option<State>) -> miette::Result<AluArithmetic> {
    let rules = switch::device(name, &[])?.rules;
    let is_measured = |format: Format| format.unit.is_card();
    let is_vertex = is_vertex.unwrap_or(is_measured(rules.vertex_format) && !is_measured(rules.format));
    let mut format = if is_vertex { rules.vertex_format } else { rules.format };
    if let Some((units, unit)) = state {
        if !units.contains(&format.unit) {
            return Err(no_state(name, is_vertex).into());
        }
        format.unit = unit;
    }
    // Measured units have their own rules, in every state.
    let sums = match is_vertex {
        _ if is_measured(format) => SumRules::plain(format),
        true => rules.vertex_sums(),
        false => rules.sums_in(format),
    };
    Ok((format, Some(sums)))
}

fn no_state(name: &str, is_vertex: bool) -> Problem {
    let stage = if is_vertex { "vertex" } else { "pixel" };
    Problem::usage(
        format!("the {stage} arithmetic of `{name}` has no such state"),
        "remove `--state`, or use `legacy` or `modern` for vertices of nv30 and nv35, `zero-wins` or `ieee` for gt200",
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
        AluOperation::Table(Op::Sign) | AluOperation::Rcc | AluOperation::Expp | AluOperation::Logp | AluOperation::Lit
    );
    let card = format.unit.is_card() && operation == AluOperation::Dst;
    if !vertex && (theirs || card) {
        return Err(Problem::usage(
            format!(
                "`{}` is an instruction of the vertex units of nv20 to nv35; {format} does not have it",
                operation.name()
            ),
            "use `--device nv20`, `nv25`, `nv30` or `nv35`, with `--stage vertex`",
        ));
    }
    Ok(())
}
