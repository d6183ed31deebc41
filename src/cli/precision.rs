//! `crossbar precision`: how many bits a goal needs, and which instruction decides.

use std::path::{Path, PathBuf};

use super::part::PartArgs;
use super::study::{StudyArgs, StudyFiles};
use super::uniform::{self, Uniform};
use super::{given, switch};
use crate::case::{Overrides, Setup};
use crate::options::one_of::{OneOf, one_of};
use crate::study::precision::{
    CaseSubject, FormatCosts, FormatFamily, Goal, KnownRuns, PaperSystem, Precision, PrecisionSubject,
};

const EXAMPLES: &str = "\
Examples:
  crossbar precision docs/examples/highlight.toml
      the fewest bits, of floats and of fixed point, that draw every code to within one; which squaring decides
  crossbar precision docs/examples/highlight.toml --goal \"flip<=0.01\" --family fixed --out out/flip
      a goal of your own, in fixed point alone
  crossbar precision radiosity --family float --out out/radiosity_bits
      one of the six systems, on a small input of its own and the card of its paper
  crossbar precision docs/examples/wgsl/ggx.wgsl --uniform roughness=0.3 --out out/ggx
      a fragment shader in WGSL, line by line (a build with the feature wgsl)
  crossbar precision docs/examples/highlight.toml --costs docs/examples/multiplier_area.csv --out out/area
      costs of formats of your own, for the format per instruction

Goals are `MEASURE<=NUMBER`, with <=, <, >=, > or =; the page lists the measures. Costs have the header `bits,cost`. \
Written to --out: index.html, mixed.toml (a device with a format per instruction, for --device), curve.csv and other \
tables. docs/precision.md describes what is measured.

Exit codes: 0 some format meets the goal, 1 none does, 2 the case or the goal cannot be used.";

/// Find the fewest bits that meet a goal: for all instructions of a case's or a system's pixel programs, and for each
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// The case, a TOML file; or a shader in WGSL; or ray-engine, radiosity, subsurface, cpca, all-frequency or bi-scale
    #[arg(value_name = "CASE.toml|SHADER.wgsl|SYSTEM")]
    case: PathBuf,

    /// Bound that the result must meet [default: largest_codes<=1, or mean_relative<=0.01 where no target has integer
    /// codes; of systems wrong<=0.001 for the Ray Engine, largest_relative<=0.01 for radiosity, largest_255ths<=1]
    #[arg(long, value_name = "GOAL")]
    goal: Option<Goal>,

    /// A case with the same pixel program, on which the format per instruction is tried and which no run of the search
    /// sees; systems have one of their own
    #[arg(long, value_name = "CASE.toml")]
    held_back: Option<PathBuf>,

    /// A device in place of the case's, or of the card of the system's paper
    #[arg(long, value_name = "D")]
    device: Option<String>,

    /// A switch of the device; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = switch::parse)]
    switch: Vec<(String, String)>,

    /// A value of a uniform of a shader in WGSL, up to four numbers; may be given several times
    #[arg(long, value_name = "NAME=X,Y,..", value_parser = uniform::parse)]
    uniform: Vec<Uniform>,

    /// Which formats are tried
    #[arg(long, default_value = "both", value_parser = families())]
    family: Families,

    /// Runs of the program after which the best so far is taken
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u64).range(1..))]
    budget: u64,

    /// Cost of a format by its bits, a CSV file [default: the bits]
    #[arg(long, value_name = "FILE.csv")]
    costs: Option<PathBuf>,

    #[command(flatten)]
    part: PartArgs,

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
    type Study = Precision;
    const QUICKER: &'static str = "`--family`, a smaller `--budget` or smaller targets";

    fn files(&self) -> StudyFiles<'_> {
        let case = Some(&self.case).filter(|_| self.system().is_none());
        let inputs = case.into_iter().chain(&self.held_back).chain(&self.costs).map(PathBuf::as_path).collect();
        StudyFiles::new(Some(&self.out), Some(self.part), inputs)
    }

    fn study(&self) -> miette::Result<Precision> {
        let costs = self.costs.as_deref().map(FormatCosts::load).transpose()?.unwrap_or_default();
        if let Some(system) = self.system() {
            let of_cases = [("--held-back", self.held_back.is_some()), ("--uniform", !self.uniform.is_empty())];
            given::refuse(of_cases, "cases", "leave it out: a system has inputs of its own")?;
            let profile = switch::device(self.device.as_deref().unwrap_or(system.card()), &self.switch)?;
            return Ok(self.of(system.subject(profile)?, costs));
        }
        let mut subject = self.case(&self.case)?;
        if let Some(path) = &self.held_back {
            let (other, _) = self.setup(path, &[])?;
            subject = subject.holding_back(&other, &path.display().to_string())?;
        }
        Ok(self.of(Box::new(subject), costs))
    }
}

impl Args {
    /// The system that is named in place of a case.
    fn system(&self) -> Option<PaperSystem> {
        self.case.to_str()?.parse().ok()
    }

    fn case(&self, path: &Path) -> miette::Result<CaseSubject> {
        let (setup, name) = self.setup(path, &self.uniform)?;
        Ok(CaseSubject::new(setup, &name)?)
    }

    /// A case on the device of the options, and its name.
    fn setup(&self, path: &Path, uniforms: &[Uniform]) -> miette::Result<(Setup, String)> {
        let device = self.device.as_deref().map(|name| switch::device(name, &[])).transpose()?;
        let (switches, uniforms) = (self.switch.clone(), uniforms.to_vec());
        let overrides = Overrides { device, switches, uniforms, ..Overrides::default() };
        let setup = Setup::read_with(path, &overrides)?;
        Ok((setup, path.file_stem().unwrap_or_default().to_string_lossy().into_owned()))
    }

    fn of(&self, subject: Box<dyn PrecisionSubject>, costs: FormatCosts) -> Precision {
        let known = KnownRuns::of_folder(&self.out);
        Precision {
            subject,
            goal: self.goal.clone(),
            families: self.family.0.clone(),
            budget: self.budget,
            costs,
            known,
        }
    }
}
