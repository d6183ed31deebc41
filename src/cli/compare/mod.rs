//! `crossbar compare`: one case on two sides, and the first difference.

mod show;

use std::path::PathBuf;

use miette::WrapErr as _;
use refsim::{machine::Executor, num::Format};

use super::{Out, Problem, Verdict, executor::DeviceExecutor, pixel, view::bad_format};
use crate::case::{self, ComparedSides, Overrides, Scope, Setup, Side, device_named};

const EXAMPLES: &str = "\
Examples:
  crossbar compare fixtures/cases/transform.toml
      the reference against the batch executor: the bits must be the same
  crossbar compare fixtures/cases/transform.toml --right-format fp32    # exit code 1
      the device's own number format against single precision
  crossbar compare fixtures/cases/transform.toml --right-switch rounding=rtz --pixel 2,2
      two settings of an open switch, compared step by step at one pixel even if its stored values are equal

Sides are compared by the results of the draw: every stored bit of targets and depth buffer, and the counts. If \
they differ, the first differing pixel is traced on both sides, down to the first pass, stage, instruction and \
component that differ. docs/compare.md describes the comparison, and ULPs between two formats.

Exit codes: 0 the sides are equal, 1 they differ, 2 the case cannot be run.";

/// Run a case on two executors, formats or devices and report the first difference, down to the instruction
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// The case, a TOML file: see `crossbar run`
    case: PathBuf,

    /// Executor on the left [default: scalar]
    #[arg(long, value_enum, value_name = "EXECUTOR")]
    left: Option<DeviceExecutor>,

    /// Executor on the right [default: batch, or the left side's if the sides differ in another setting]
    #[arg(long, value_enum, value_name = "EXECUTOR")]
    right: Option<DeviceExecutor>,

    /// Device on the left [default: the case's device]
    #[arg(long, value_name = "D")]
    left_device: Option<String>,

    /// Device on the right [default: the case's device]
    #[arg(long, value_name = "D")]
    right_device: Option<String>,

    /// Format of the pixel registers on the left [default: the device's format]
    #[arg(long, value_name = "F")]
    left_format: Option<String>,

    /// Format of the pixel registers on the right [default: the device's format]
    #[arg(long, value_name = "F")]
    right_format: Option<String>,

    /// A switch of the device on the left; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = super::switch::parse)]
    left_switch: Vec<(String, String)>,

    /// A switch of the device on the right; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = super::switch::parse)]
    right_switch: Vec<(String, String)>,

    /// Compare what every instruction writes at one pixel, whether or not the targets differ there
    #[arg(long, value_name = "X,Y", value_parser = pixel::parse, allow_hyphen_values = true, conflicts_with = "registers")]
    pixel: Option<[u32; 2]>,

    /// Compare what every instruction writes at every pixel
    #[arg(long)]
    registers: bool,
}

impl Args {
    /// The case with its executor on both sides; fails if they do not differ in any setting.
    fn sides(&self) -> miette::Result<[(Setup, Executor); 2]> {
        let left = (self.left_device.as_deref(), self.left_format.as_deref(), self.left_switch.as_slice());
        let right = (self.right_device.as_deref(), self.right_format.as_deref(), self.right_switch.as_slice());
        let left_executor = self.left.unwrap_or(DeviceExecutor::Scalar);
        let other = if left == right { DeviceExecutor::Batch } else { left_executor };
        let right_executor = self.right.unwrap_or(other);
        if left == right && left_executor == right_executor {
            let help = "make the sides different, for example with `--right batch`, `--right-format fp32`, \
                        `--right-device r300` or `--right-switch rounding=rtz`";
            return Err(Problem::usage("both sides are the same", help).into());
        }
        let overrides = [overrides("left", left)?, overrides("right", right)?];
        let executors = [left_executor.open()?, right_executor.open()?];
        let read = |overrides: &Overrides, name: &str| {
            Setup::read_with(&self.case, overrides)
                .map_err(miette::Report::from)
                .wrap_err_with(|| format!("the case cannot be set up on the {name} side"))
        };
        let setups = [read(&overrides[0], "left")?, read(&overrides[1], "right")?];
        let ([left, right], [left_executor, right_executor]) = (setups, executors);
        Ok([(left, left_executor), (right, right_executor)])
    }

    fn scope(&self, size: [u32; 2]) -> miette::Result<Scope> {
        Ok(match self.pixel {
            Some(pixel) => Scope::Pixel(pixel::within(pixel, size)?),
            None if self.registers => Scope::Registers,
            None => Scope::Results,
        })
    }
}

/// Device, format and switches in place of the case's.
fn overrides(
    name: &str,
    (device, format, switches): (Option<&str>, Option<&str>, &[(String, String)]),
) -> miette::Result<Overrides> {
    let checked =
        |text: &str| text.parse().and_then(Format::for_registers).map(|_| text.to_owned()).map_err(bad_format);
    let (device, format) = (device.map(device_named).transpose(), format.map(checked).transpose());
    let made = device.map_err(miette::Report::from).and_then(|device| {
        Ok(Overrides { device, format: format?, switches: switches.to_vec(), ..Overrides::default() })
    });
    made.wrap_err_with(|| format!("the {name} side cannot be set up"))
}

pub(in crate::cli) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let sides = args.sides()?;
    let sides = sides.each_ref().map(|(setup, executor)| Side { setup, executor: executor.clone() });
    let comparison = case::compare(&sides[0], &sides[1], args.scope(sides[0].setup.size)?)?;
    out.outlive_reader();
    let case = args.case.display().to_string();
    let compared = ComparedSides { case: &case, sides: &sides, comparison: &comparison };
    if out.json() {
        out.document(&compared.document())?;
    } else {
        show::ShownComparison(compared).print(out)?;
    }
    Ok(Verdict::held(comparison.equal()))
}
