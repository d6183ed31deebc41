//! `crossbar alu`: one operation of a number format on bit patterns.

mod device;
mod line;
mod matrix;
mod operation;
mod stream;

use refsim::num::matrix::MatrixUnit;
use refsim::num::{DotOrder, Format, Rounding, Tininess, Unit, block::BlockFormat};

use self::device::{AluArithmetic, State, refuse_foreign, refuse_lacking};
use self::line::Asked;
use self::operation::{AluOperation, AluUnit};
use super::{Out, Problem, Verdict, given};
use crate::options::number;
use crate::options::one_of::{OneOf, one_of};

const EXAMPLES: &str = "\
Examples:
  echo 3C00 4000 | crossbar alu add --format fp16
      one plus two: prints 4200, which is three
  echo 5000 5000 | crossbar alu mul --format s3.12:rtz --flags
      five times five, which saturates: prints 7FFF and the flags 05
  testfloat_gen f32_mulAdd | crossbar alu mulAdd --format fp32 --verify --flags
      checks this arithmetic against the test vectors of Berkeley TestFloat
  echo 3F800000 42C00000 | crossbar alu quantize --format fp32 --block mxfp4
      1 and 96 with a shared scale: prints 83 0 7, which are 2^4, 0 and 6
  echo 6800 3C00 3C00 3C00 3C00 3C00 | crossbar alu dot --format fp16 --accumulator fp32
      2048 * 1 + 1 * 1 + 1 * 1, summed in single precision: prints 6801, which is 2050; \
without `--accumulator` the sum is 2048
  echo 3F800000 B3800000 | crossbar alu add --device nv20
      1 - 2^-24 by the vertex unit of a GeForce3: prints 3F7FFFFF, a truncated sum
  echo 3C008C00 3C000C00 00000000 | crossbar alu dot --unit hopper-f16
      1 * 1 - 2^-12 * 2^-12 on a tensor core of Hopper: prints 3f7fffff; on Volta 3f800000

Lines: hexadecimal operands separated by blanks or commas, as TestFloat writes them; blank lines are skipped. A result has as many \
digits as its format needs; a comparison gives 0 or 1. Flags are two digits: 01 inexact, 02 underflow, 04 overflow, \
08 division by zero, 10 invalid.

Formats: sI.F (fixed point), nI.F (normalized integers: n3.8 counts in steps of 1/255), eXmY (float), eXmYfn and \
eXmYfnuz (floats without infinity, as e4m3fn and e2m1fn), e8m0 (powers of two), or ps14 fx12 fp16 bf16 fp24 fp32; \
then, optionally, rounding :rne :rna :rtz :rdn :rup :rod :rst, overflow :sat :wrap :inf :nvovf, subnormals :keep :ftz, \
special values :ieee :nv. e8m23 with :nv2x, :nv3x-legacy, :nv3x, :gt200 or :gt200-zero-wins is the measured unit of a \
card.

With :rst (stochastic rounding), each line uses one random word: line i, counted from 0, uses the upper half of output \
i of SplitMix64, seeded with --seed.";

/// Apply an operation to bit patterns from standard input, or check given results
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The operation
    #[arg(ignore_case = true, value_parser = AluOperation::parser())]
    op: AluOperation,

    /// The number format of operands and result
    #[arg(long, value_name = "F", required_unless_present_any = ["device", "unit"])]
    format: Option<Format>,

    /// A device instead of a format: computes the device's instruction of this name, with its measured unit or its
    /// rules
    #[arg(long, value_name = "D", conflicts_with = "format")]
    device: Option<String>,

    /// The stage of the device [default: the stage with a measured unit, otherwise pixel]
    #[arg(long, requires = "device", value_parser = stages())]
    stage: Option<bool>,

    /// The state of the device's unit [default: modern or ieee]
    #[arg(long, requires = "device", value_parser = states())]
    state: Option<State>,

    /// The matrix unit of a GPU in which `dot` sums, instead of --format; `crossbar units` lists the units
    ///
    /// A line is `a b c`, each with its numbers one after the other; `ta tb a b c` if the unit supports several
    /// types, and `a b c sa sb` if it has scales.
    #[arg(long, value_name = "UNIT", value_parser = MatrixUnit::find,
          conflicts_with_all = ["format", "device", "to", "block", "accumulator", "summation", "flags", "seed"])]
    unit: Option<MatrixUnit>,

    /// The result format of `convert`
    #[arg(long, value_name = "F2")]
    to: Option<Format>,

    /// The block format of `quantize` and `dequantize`, which use --format for the plain numbers
    #[arg(long, value_name = "B", value_parser = blocks())]
    block: Option<BlockFormat>,

    /// The format in which `dot` rounds products and sums; by default the operands' format
    #[arg(long, value_name = "A")]
    accumulator: Option<Format>,

    /// The order in which `dot` sums: `sequential`, `tree`, `exact` or `aligned:F`; by default sequential
    ///
    /// sequential: ((x + y) + z) + w, each step rounded. tree: (x + y) + (z + w), each step rounded. exact: the exact
    /// sum, rounded once into the accumulator. aligned:F, for floats: one adder for all rounded products
    /// drops bits that are more than F places (0 to 28) below the largest exponent, and rounds the sum once.
    #[arg(long, value_name = "ORDER", value_parser = summation)]
    summation: Option<DotOrder>,

    /// Lines also have expected results, as testfloat_gen writes them: print every mismatch, then the counts
    ///
    /// A line is operands, result and flags; the flags may be missing unless --flags asks for their comparison. Any NaN
    /// matches any other; with --unit, `nan` matches any NaN.
    #[arg(long)]
    verify: bool,

    /// Write the exception flags after each result, or compare them
    #[arg(long)]
    flags: bool,

    /// The seed of stochastic rounding, `:rst` [default: 0]
    #[arg(long, value_name = "N", value_parser = number::whole::<u64>(0..=u64::MAX))]
    seed: Option<u64>,
}

fn summation(text: &str) -> Result<DotOrder, String> {
    DotOrder::named(text).ok_or_else(|| "expected sequential, tree, exact, or aligned:F with F from 0 to 28".to_owned())
}

/// Values of `--stage`: is it the vertex stage?
fn stages() -> OneOf<bool> {
    one_of([("vertex", "vertex programs", true), ("pixel", "pixel programs", false)])
}

/// Values of `--state`: the states of units.
fn states() -> OneOf<State> {
    let (nv3x, gt200) = ([Unit::Nv3x, Unit::Nv3xLegacy], [Unit::Gt200, Unit::Gt200ZeroWins]);
    one_of([
        ("legacy", "nv30, nv35: as GL_NV_vertex_program", (nv3x, Unit::Nv3xLegacy)),
        ("modern", "nv30, nv35: as GL_NV_vertex_program2", (nv3x, Unit::Nv3x)),
        ("zero-wins", "gt200: 0 times anything is 0", (gt200, Unit::Gt200ZeroWins)),
        ("ieee", "gt200: 0 times infinity is NaN", (gt200, Unit::Gt200)),
    ])
}

fn blocks() -> OneOf<BlockFormat> {
    one_of(BlockFormat::ALL.map(|block| (block.name(), "OCP Microscaling: 32 elements and a scale", block)))
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let asked = Asked { verify: args.verify, flags: args.flags, json: out.json() };
    if let Some(unit) = &args.unit {
        let others = [("--unit", args.op != AluOperation::Dot)];
        given::refuse(
            others,
            "`dot`",
            "remove `--unit`: only `dot` runs in a matrix unit; the other operations need `--format`",
        )?;
        // The parser accepts these options with a unit, although it excludes --device.
        let of_device = [("--stage", args.stage.is_some()), ("--state", args.state.is_some())];
        given::refuse(of_device, "`--device`", "remove the option: a matrix unit has no stages and no states")?;
        return stream::run(asked, out, |text, number| matrix::answer(unit, text, number, asked));
    }
    let arithmetic = arithmetic(args)?;
    let seed =
        [("--seed", args.seed.is_some() && !by_chance(&arithmetic.0) && !args.to.as_ref().is_some_and(by_chance))];
    given::refuse(seed, "stochastic rounding", "remove `--seed`, or add `:rst` to the format")?;
    let unit = unit(args, arithmetic)?;
    stream::run(asked, out, |text, number| unit.answer(text, number, asked))
}

/// The arithmetic of a format, or of a device's stage.
fn arithmetic(args: &Args) -> miette::Result<AluArithmetic> {
    let arithmetic = match (&args.device, args.format) {
        (Some(device), _) => {
            let arithmetic = device::arithmetic(device, args.stage, args.state)?;
            refuse_lacking(args.op, arithmetic.0)?;
            arithmetic
        }
        // The parser requires a format or a device, but accepts these options with a format.
        (None, _) if args.stage.is_some() || args.state.is_some() => {
            return Err(Problem::usage(
                "`--stage` and `--state` are for `--device` only",
                "remove `--stage` and `--state`: the suffix of a format names the unit, as in `e8m23:nv3x-legacy`",
            )
            .into());
        }
        (None, format) => (format.unwrap_or(Format::FP32), None),
    };
    refuse_foreign(args.op, arithmetic.0)?;
    Ok(arithmetic)
}

/// Returns `true` if results depend on random words.
fn by_chance(format: &Format) -> bool {
    matches!(format.rounding, Rounding::Stochastic(_))
}

/// Checks that the options go together, and returns the unit that they describe.
fn unit(args: &Args, (format, sums): AluArithmetic) -> Result<AluUnit, Problem> {
    let usage = |what: &str, help: &str| Err(Problem::usage(what, help));
    let op = args.op;
    let accumulator = args.accumulator.unwrap_or(format);
    let is_block = matches!(op, AluOperation::Quantize | AluOperation::Dequantize);
    if op != AluOperation::Dot && (args.accumulator.is_some() || args.summation.is_some()) {
        let help = "remove `--accumulator` and `--summation`: they only apply to sums of products";
        return usage("`--accumulator` and `--summation` are for `dot` only", help);
    }
    if is_block && args.block.is_none() {
        return usage("blocks need a block format", "add a block format, for example `--block mxfp4`");
    }
    if !is_block && args.block.is_some() {
        let help = "remove `--block`, or quantize first and compute with the elements";
        return usage("`--block` is for `quantize` and `dequantize` only", help);
    }
    if op.takes_many() && (args.verify || args.to.is_some()) {
        let help = "remove the option; `--format` is the format of the plain numbers";
        return usage("operations on lines of many numbers support neither `--verify` nor `--to`", help);
    }
    if op.takes_many() && (by_chance(&format) || by_chance(&accumulator)) {
        let help = "use another rounding, or round each number on its own line";
        return usage(
            "operations on lines of many numbers round more than once, and `:rst` has one random word per line",
            help,
        );
    }
    if matches!(args.summation, Some(DotOrder::Aligned(_))) && accumulator.is_fixed() {
        return Err(Problem::usage(
            format!("`--summation aligned` compares exponents: expected sums in a float format, found `{accumulator}`"),
            "remove `--summation aligned`, because fixed-point sums are exact, or add a float `--accumulator`",
        ));
    }
    match (op == AluOperation::Convert, args.to) {
        (true, None) => {
            let help = "add a result format, for example `--to fp16`; `--format` is the source format";
            usage("`convert` needs a result format", help)
        }
        (false, Some(_)) => {
            let help = "remove `--to`, or convert the result in a second run";
            usage("`--to` is for `convert` only: every other operation stays in its format", help)
        }
        (_, to) => Ok(AluUnit {
            op,
            env: format.tininess(Tininess::After),
            to: to.unwrap_or(format),
            seed: args.seed.unwrap_or_default(),
            sums,
            block: args.block,
            dot: (args.summation.unwrap_or(DotOrder::Sequential), accumulator),
        }),
    }
}
