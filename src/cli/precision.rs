//! `crossbar precision`: how many bits a goal needs, and which instruction decides.

use std::path::{Path, PathBuf};

use strum::IntoEnumIterator as _;

use super::study::{StudyArgs, StudyFiles};
use super::uniform::{self, Uniform};
use super::{given, switch};
use crate::case::{Overrides, Setup};
use crate::options::number;
use crate::options::one_of::{OneOf, one_of, variants};
use crate::study::Study;
use crate::study::precision::{
    CaseSubject, ExpressionStudy, FormatFamily, Goal, InputDraw, PaperSystem, Precision, PrecisionSubject,
};

const EXAMPLES: &str = "\
Examples:
  crossbar precision --expr 'sqrt(x*x + y*y)' --range x=-1..1 --range y=1e-3..1
      bits of error of an expression in every format, the smallest format that suffices, and the operation to blame
  crossbar precision --fpcore fixtures/fpbench/suite.fpcore --samples 100 --out out/suite      # exit code 1
      all expressions of a file in FPCore
  crossbar precision docs/examples/highlight.toml
      the fewest bits, of floats and of fixed point, with which no stored code is off by more than one, and the \
squaring that is most to blame
  crossbar precision docs/examples/highlight.toml --goal \"flip<=0.01\" --family fixed --out out/flip
      your own goal, in fixed point only
  crossbar precision radiosity --family float --out out/radiosity_bits
      one of the six systems, on a small built-in input and the card of its paper
  crossbar precision docs/examples/wgsl/ggx.wgsl --uniform roughness=0.3 --out out/ggx
      a fragment shader in WGSL, line by line (a build with the feature wgsl)

The smallest format of an expression has the fewest bits of all formats of its family that meet the goal; if \
there are several such formats, it has the smallest error of them.

Goals are `MEASURE<=NUMBER`, with <=, <, >=, > or =; the page lists the measures. Written to --out: index.html, \
mixed.toml (a device file with a number format per instruction, for --device), curve.csv and other tables. \
docs/precision.md describes what is measured.

Exit codes: 0 a format meets the goal, 1 no format does, or one of several expressions has no such format, 2 the case, \
the expressions or the goal cannot be used.";

/// Default maximum number of runs of a program.
const BUDGET: u64 = 10_000;

/// Find the fewest bits that meet a goal: for an expression, or for the pixel programs of a case or a system
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, group(clap::ArgGroup::new("subject").required(true).args(["case", "expr", "fpcore"])))]
pub(super) struct Args {
    /// The case, a TOML file; or a WGSL shader; or a system: ray-engine, radiosity, subsurface, cpca, all-frequency or
    /// bi-scale
    #[arg(value_name = "CASE.toml|SHADER.wgsl|SYSTEM")]
    case: Option<PathBuf>,

    /// An expression instead of a case, such as `sqrt(x + 1) - sqrt(x)`
    #[arg(long, value_name = "EXPRESSION", allow_hyphen_values = true)]
    expr: Option<String>,

    /// Expressions in FPCore, the language of FPBench and Herbie
    #[arg(long, value_name = "FILE.fpcore")]
    fpcore: Option<PathBuf>,

    /// Bounds of a variable, ends included; may be given once for each variable [default: all numbers]
    #[arg(long, value_name = "NAME=LOW..HIGH")]
    range: Vec<String>,

    /// Number of inputs per format, for expressions [default: 1000]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=100_000))]
    samples: Option<u32>,

    /// Random seed of the inputs of an expression [default: 0]
    #[arg(long, value_name = "N", value_parser = number::whole::<u64>(0..=u64::MAX))]
    seed: Option<u64>,

    /// Distribution of the inputs of an expression [default: floats]
    #[arg(long, value_parser = variants::<InputDraw>())]
    draw: Option<InputDraw>,

    /// Bound that the result must meet [default: largest_codes<=1, or mean_relative<=0.01 for expressions and where no
    /// target has integer codes; for systems, wrong<=0.001 for ray-engine, largest_relative<=0.01 for radiosity,
    /// otherwise largest_codes<=1]
    #[arg(long, value_name = "GOAL")]
    goal: Option<Goal>,

    /// A case with the same pixel program, not used in the search, on which the formats that were found per instruction
    /// are tested; each system has such a case built in
    #[arg(long, value_name = "CASE.toml")]
    held_back: Option<PathBuf>,

    /// The device [default: the device of the case, or the card of the system's paper]
    #[arg(long, value_name = "D")]
    device: Option<String>,

    /// A switch of the device; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = switch::parse)]
    switch: Vec<(String, String)>,

    /// The value of a uniform of a WGSL shader: up to four numbers; may be given several times
    #[arg(long, value_name = "NAME=X,Y,..", value_parser = uniform::parse)]
    uniform: Vec<Uniform>,

    /// Families of formats to try [default: both, or float for expressions]
    #[arg(long, value_parser = families())]
    family: Option<Families>,

    /// Maximum number of runs of the program; after that, the best result so far counts [default: 10000]
    #[arg(long, value_name = "N", value_parser = number::whole::<u64>(1..=u64::MAX))]
    budget: Option<u64>,

    /// Where to write the page, the tables and the device
    #[arg(long, value_name = "DIR", default_value = "out/precision")]
    out: PathBuf,
}

/// Families of formats.
#[derive(Clone, Debug)]
struct Families(Vec<FormatFamily>);

fn families() -> OneOf<Families> {
    let both = vec![FormatFamily::Float, FormatFamily::Fixed];
    one_of([
        ("float", "Floats", Families(vec![FormatFamily::Float])),
        ("fixed", "Fixed point", Families(vec![FormatFamily::Fixed])),
        ("both", "Both", Families(both)),
    ])
}

impl StudyArgs for Args {
    type Study = Box<dyn Study>;
    const QUICKER: &'static str = "`--family`, a smaller `--budget`, fewer `--samples` or smaller targets";

    fn files(&self) -> StudyFiles<'_> {
        let case = self.case.iter().filter(|_| self.system().is_none());
        let inputs = case.chain(&self.fpcore).chain(&self.held_back).map(PathBuf::as_path).collect();
        StudyFiles::new(Some(&self.out), inputs)
    }

    fn study(&self) -> miette::Result<Box<dyn Study>> {
        let Some(case) = &self.case else { return Ok(Box::new(self.expressions()?)) };
        let of_expressions = [
            ("--range", !self.range.is_empty()),
            ("--samples", self.samples.is_some()),
            ("--seed", self.seed.is_some()),
            ("--draw", self.draw.is_some()),
        ];
        given::refuse(of_expressions, "expressions", "remove the option, or give `--expr` or `--fpcore`")?;
        Ok(Box::new(self.precision(case)?))
    }
}

impl Args {
    /// The study of an expression, or of the expressions in a file.
    fn expressions(&self) -> miette::Result<ExpressionStudy> {
        let of_cases = [
            ("--held-back", self.held_back.is_some()),
            ("--device", self.device.is_some()),
            ("--switch", !self.switch.is_empty()),
            ("--uniform", !self.uniform.is_empty()),
            ("--budget", self.budget.is_some()),
        ];
        given::refuse(of_cases, "cases", "remove the option: expressions are not run on a device")?;
        let mut study = match (&self.expr, &self.fpcore) {
            (None, Some(path)) => ExpressionStudy::of_file(path, &self.range)?,
            // The command line's parser requires one of them.
            (text, _) => ExpressionStudy::of_formula(text.as_deref().unwrap_or_default(), &self.range)?,
        };
        study.goal.clone_from(&self.goal);
        if let Some(Families(families)) = &self.family {
            study.families.clone_from(families);
        }
        study.samples = self.samples.map_or(study.samples, |samples| samples as usize);
        study.seed = self.seed.unwrap_or_default();
        study.draw = self.draw.unwrap_or_default();
        Ok(study)
    }

    /// The study of a case or a system.
    fn precision(&self, case: &Path) -> miette::Result<Precision> {
        let both = vec![FormatFamily::Float, FormatFamily::Fixed];
        Ok(Precision {
            subject: self.subject(case)?,
            goal: self.goal.clone(),
            families: self.family.clone().map_or(both, |Families(families)| families),
            budget: self.budget.unwrap_or(BUDGET),
        })
    }

    fn subject(&self, case: &Path) -> miette::Result<Box<dyn PrecisionSubject>> {
        if let Some(system) = self.system() {
            let of_cases = [("--held-back", self.held_back.is_some()), ("--uniform", !self.uniform.is_empty())];
            given::refuse(of_cases, "cases", "remove the option: a system brings its own inputs")?;
            let profile = switch::device(self.device.as_deref().unwrap_or(system.card()), &self.switch)?;
            return Ok(system.subject(profile)?);
        }
        let systems: Vec<&str> = PaperSystem::iter().map(Into::into).collect();
        given::require_file(case, "system", &systems, "toml")?;
        let name = case.file_stem().unwrap_or_default().to_string_lossy();
        let mut subject = CaseSubject::new(self.setup(case, &self.uniform)?, &name)?;
        if let Some(path) = &self.held_back {
            subject = subject.holding_back(&self.setup(path, &[])?, &path.display().to_string())?;
        }
        Ok(Box::new(subject))
    }

    /// The system that is named in place of a case.
    fn system(&self) -> Option<PaperSystem> {
        self.case.as_ref()?.to_str()?.parse().ok()
    }

    /// A case on the device that the options choose.
    fn setup(&self, path: &Path, uniforms: &[Uniform]) -> miette::Result<Setup> {
        let device = self.device.as_deref().map(|name| switch::device(name, &[])).transpose()?;
        let (switches, uniforms) = (self.switch.clone(), uniforms.to_vec());
        Ok(Setup::read_with(path, &Overrides { device, switches, uniforms, ..Overrides::default() })?)
    }
}
