//! `crossbar units`: matrix units of GPUs, and the evidence for each of their rules.

use refsim::num::matrix::{MatrixUnit, UNITS};
use serde_json::json;

use super::{Out, Verdict, study};
use crate::report::{Cell, Findings, FoundTable, Table};

const EXAMPLES: &str = "\
Examples:
  crossbar units
      every matrix unit: types, block, bits, result, and how certain the rule is
  crossbar units hopper-fp8
      the unit for FP8 on Hopper, with chips, instructions and sources

docs/matrix_units.md describes the rules, and shows what each rule loses in one sum.";

/// Show the matrix units of GPUs, Volta to Blackwell and CDNA1 to CDNA3: rules, sources, certainty
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A unit [default: all units]
    name: Option<String>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let units = match &args.name {
        Some(name) => vec![MatrixUnit::find(name)?],
        None => UNITS.to_vec(),
    };
    let mut table = Table::of("Matrix units", "unit types c k block bits_kept result confidence");
    for unit in &units {
        let types: Vec<&str> = unit.operands.iter().map(|element| element.name).collect();
        table.push([
            unit.name.into(),
            types.join(" ").into(),
            unit.addend.name.into(),
            unit.length.into(),
            unit.block.into(),
            unit.bits.map_or(Cell::Empty, Cell::from),
            unit.result.name.into(),
            unit.evidence.into(),
        ]);
    }
    let mut found = Findings::new("Matrix units");
    found.table(FoundTable::from(table).field("units"));
    if let [unit] = units[..] {
        let scales = unit.scaling.map(|(share, scale)| format!("one {} for {share} numbers", scale.name));
        let mut facts = Table::of(unit.name, "figure value");
        for (figure, value) in [
            ("chips", unit.chips.to_owned()),
            ("rule", format!("{:?}", unit.rule)),
            ("scales", scales.unwrap_or_else(|| "none".to_owned())),
            ("source", unit.source.to_owned()),
            ("M", "microsoft/MMA-Sim, mmasim 2.1.1 (MIT), arXiv 2511.10909".to_owned()),
            ("K", "Khattak and Mikaitis, arXiv 2512.07004; MATLAB-tensor-core b12b5a7".to_owned()),
        ] {
            facts.push([figure.into(), value.into()]);
        }
        found.table(FoundTable::from(facts).field("facts"));
        found.field("name", json!(unit.name));
    }
    study::show(&found, out)
}
