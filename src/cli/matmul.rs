//! `crossbar matmul`: a matrix product in the matrix units of GPUs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use refsim::num::matrix::{Element, MatrixUnit, UNITS};

use super::Problem;
use super::study::{StudyArgs, StudyFiles};
use crate::options::number;
use crate::study::matrix_product::{MatrixInput, MatrixProduct};
use crate::study::precision::Goal;

const EXAMPLES: &str = "\
Examples:
  crossbar matmul docs/examples/matmul_a.npy docs/examples/matmul_b.npy --unit hopper-fp8,blackwell-f8f6f4 --promote 64
      the errors of FP8 sums on Hopper, with one accumulator and with promotion, and on Blackwell
  crossbar matmul docs/examples/matmul_a.npy docs/examples/matmul_b.npy --unit hopper-f16 --against ampere-f16 --blame 2,4
      elements that differ between two generations; for one element, the block and the addend that cause the difference
  crossbar matmul docs/examples/matmul_a.npy docs/examples/matmul_b.npy --unit hopper-fp8 --goal \"worst<=1e-2\"
      the fewest bits, or the rarest promotion, that keep the error below a hundredth

A is M x K and B is K x N. Arrays of f2, f4 or f8 are rounded to nearest even (types of up to 8 bits saturate; units \
with scales get block scales by OCP's rule); arrays of u1, u2 or u4 hold bit patterns. K need not be a multiple of the \
block: zeros do not affect sums, so padding is exact. Measures of goals: worst, mean, bits, of_addends, differing. \
Written to --out: index.html, D of every unit as .npy, errors.csv, curve.csv, addends.csv.

Exit codes: 0 done, 1 no number of bits and no promotion meets the goal, 2 the input cannot be used.";

/// Multiply matrices as the matrix units of GPUs do, and show the errors
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// A, a NumPy array
    #[arg(value_name = "A.npy")]
    a: PathBuf,

    /// B, a NumPy array
    #[arg(value_name = "B.npy")]
    b: PathBuf,

    /// C, a NumPy array of f4 that is added to the product
    #[arg(long, value_name = "C.npy")]
    c: Option<PathBuf>,

    /// The units; `crossbar units` lists them
    #[arg(long, value_name = "UNIT,...", required = true, value_delimiter = ',', value_parser = MatrixUnit::find)]
    unit: Vec<MatrixUnit>,

    /// Types of A and B, or one type for both [default: the first that a unit supports]
    #[arg(long = "type", value_name = "TYPE,...", value_delimiter = ',', value_parser = element)]
    types: Vec<Element>,

    /// Also compute with promotion: every N products, the partial sum is added to a single-precision sum
    #[arg(long, value_name = "N,...", value_delimiter = ',', value_parser = number::whole::<u32>(1..=u32::MAX))]
    promote: Vec<u32>,

    /// Reference for errors: exact, or a unit
    #[arg(long, value_name = "exact|UNIT", default_value = "exact", value_parser = reference)]
    against: MatmulReference,

    /// Follow the sum of one element of D; its row and column count from 0
    #[arg(long, value_name = "ROW,COLUMN", value_parser = place)]
    blame: Option<[usize; 2]>,

    /// For the first unit, find the fewest bits below the largest exponent and the rarest promotion that meet a bound
    #[arg(long, value_name = "GOAL")]
    goal: Option<Goal>,

    /// Where to write the page, the tables and the products
    #[arg(long, value_name = "DIR", default_value = "out/matmul")]
    out: PathBuf,
}

/// The reference for errors: a unit, or `None` for the exact product.
#[derive(Clone, Debug)]
struct MatmulReference(Option<MatrixUnit>);

fn reference(text: &str) -> Result<MatmulReference, String> {
    if text == "exact" {
        return Ok(MatmulReference(None));
    }
    MatrixUnit::find(text).map(|unit| MatmulReference(Some(unit))).map_err(|error| error.to_string())
}

fn element(text: &str) -> Result<Element, String> {
    let all: BTreeMap<&str, Element> =
        UNITS.iter().flat_map(|unit| unit.operands).map(|element| (element.name, *element)).collect();
    let expected = || format!("expected one of {}, found `{text}`", all.keys().copied().collect::<Vec<_>>().join(", "));
    all.get(text).copied().ok_or_else(expected)
}

fn place(text: &str) -> Result<[usize; 2], String> {
    let parts: Option<Vec<usize>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    let place = parts.and_then(|parts| <[usize; 2]>::try_from(parts).ok());
    place.ok_or_else(|| format!("expected ROW,COLUMN, found `{text}`"))
}

impl StudyArgs for Args {
    type Study = MatrixProduct;
    const QUICKER: &'static str = "fewer units, or smaller matrices";

    fn files(&self) -> StudyFiles<'_> {
        let inputs = [&self.a, &self.b].into_iter().chain(&self.c).map(PathBuf::as_path).collect();
        StudyFiles::new(Some(&self.out), inputs)
    }

    fn study(&self) -> miette::Result<MatrixProduct> {
        if self.types.len() > 2 {
            let help = "write one type for both, or two types for A and B: `--type e4m3,e5m2`";
            return Err(Problem::usage("expected at most two types in `--type`", help).into());
        }
        let load = |path: &Path| MatrixInput::load(path);
        let promotions = self.promote.iter().map(|&step| Some(step as usize));
        Ok(MatrixProduct {
            factors: [load(&self.a)?, load(&self.b)?],
            addend: self.c.as_deref().map(load).transpose()?,
            units: self.unit.clone(),
            elements: [self.types.first().copied(), self.types.last().copied()],
            promotions: std::iter::once(None).chain(promotions).collect(),
            against: self.against.0,
            blame: self.blame,
            goal: self.goal.clone(),
        })
    }
}
