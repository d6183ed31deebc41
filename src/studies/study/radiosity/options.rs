//! Parameters of the study; its options are options of the program.

use std::str::FromStr;

use refsim::device::Profile;
use refsim::machine::Executor;

use super::method::{CardMethod, SolveMethod};
use crate::error::InputError;
use crate::options::one_of::variants;
use crate::options::{number, or};
use crate::radiosity::Subdivision;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::on_card::Storage;
use crate::radiosity::packing::Packing;
use crate::radiosity::solve::{Options, Solver};
use crate::scene::{Camera, Scene};
use crate::study::StudyError;
use crate::study::caster::CasterChoice;

/// Parameters of the study: scene, methods and output.
#[derive(Debug)]
pub struct Parameters {
    /// Scene.
    pub scene: Scene,
    /// Methods; each has a row in the table.
    pub methods: Vec<SolveMethod>,
    /// The card of the methods that run on a card.
    pub profile: Profile,
    /// Switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// Executor of the card.
    pub executor: Executor,
    /// Camera of the pictures.
    pub camera: Camera,
    /// Casters of the rays for form factors, at least one; the room of the first is solved.
    pub casters: Vec<CasterChoice>,
    /// Options.
    pub options: RadiosityOptions,
}

impl Parameters {
    pub(super) fn caster(&self) -> &CasterChoice {
        self.casters.first().unwrap_or(&CasterChoice::Host)
    }
}

/// Options of the study.
#[derive(Clone, Debug, clap::Args)]
pub struct RadiosityOptions {
    /// Cut faces into at most this many patches in total; a face is at least one patch.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = number::whole::<u32>(1..=16384))]
    pub patches: u32,

    /// How form factors are computed: unoccluded (all patches see each other), or rays or rays:N (closed forms and
    /// contour integrals, times the fraction that N x N sample rays per pair find visible, 3 x 3 by default).
    #[arg(long, value_name = "HOW", default_value = "rays")]
    pub factors: Factors,

    /// Scale the form factors of each patch to sum to 1, as in a closed room.
    #[arg(long)]
    pub enforce_closure: bool,

    /// card, jacobi, gauss-seidel, sor:FACTOR, shooting or direct; may be repeated [default: card, gauss-seidel and
    /// direct]
    #[arg(long = "solver", value_name = "S")]
    solvers: Vec<SolverChoice>,

    /// For the card: one element per texel and all channels at once, or four elements per texel and one channel at a
    /// time; may be repeated [default: rgb]
    #[arg(long = "packing", value_name = "P", value_parser = variants::<Packing>())]
    packings: Vec<Packing>,

    /// For the card: the number format of registers, textures and targets; may be repeated [default: fp32]
    #[arg(long = "storage", value_name = "F", value_parser = variants::<Storage>())]
    storages: Vec<Storage>,

    /// Stop when the norm of the residual is at most this fraction of the emittance's norm [default: 1e-4; 0 with
    /// --iterations]
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    tolerance: Option<f64>,

    /// Maximum number of iterations [default: 1000]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=100_000))]
    iterations: Option<u32>,

    /// Pictures of the first method on the card after these numbers of iterations.
    #[arg(long = "picture-after", value_name = "N,N", value_delimiter = ',', allow_hyphen_values = true,
          value_parser = number::whole::<u32>(1..=100_000))]
    pub frames: Vec<u32>,

    /// Also solve the room with these numbers of patches, on the card as it is and with each open switch changed.
    #[arg(long = "sweep-patches", value_name = "N,N", value_delimiter = ',',
          value_parser = number::whole::<u32>(1..=16384))]
    pub sweep: Vec<u32>,
}

/// Source of form factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factors {
    /// Without occlusion.
    Unoccluded,
    /// Closed forms and contour integrals, times the visible fraction by rays.
    Rays(VisibilityParameters),
}

impl FromStr for Factors {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("expected unoccluded, or rays[:N] with N from 1 to 64, found `{text}`");
        let (name, number) = text.split_once(':').map_or((text, None), |(name, number)| (name, Some(number)));
        let number = number.map(|number| number.parse::<u32>().map_err(|_| wrong())).transpose()?;
        match (name, number) {
            ("unoccluded", None) => Ok(Self::Unoccluded),
            ("rays", None | Some(1..=64)) => {
                let usual = VisibilityParameters::default();
                Ok(Self::Rays(VisibilityParameters { side: number.unwrap_or(usual.side), ..usual }))
            }
            _ => Err(wrong()),
        }
    }
}

impl std::fmt::Display for Factors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unoccluded => f.write_str("unoccluded"),
            Self::Rays(VisibilityParameters { side, .. }) => write!(f, "{} rays a pair", side * side),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum SolverChoice {
    Card,
    Host(Solver),
}

impl FromStr for SolverChoice {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        if name == "card" {
            return Ok(Self::Card);
        }
        name.parse()
            .map(Self::Host)
            .map_err(|e: InputError| e.to_string().replacen("expected ", "expected `card`, ", 1))
    }
}

impl RadiosityOptions {
    /// Fineness of the subdivision into patches.
    pub fn subdivision(&self) -> Subdivision {
        Subdivision::AtMost(self.patches as usize)
    }

    /// Stopping criteria.
    pub fn stopping(&self) -> Options {
        Options {
            tolerance: self.tolerance.unwrap_or(if self.iterations.is_some() { 0.0 } else { 1e-4 }),
            most_iterations: self.iterations.unwrap_or(1000),
        }
    }

    /// Every solver, on the card in every packing and storage; fails for options without effect.
    pub fn methods(&self) -> Result<Vec<SolveMethod>, StudyError> {
        let usual = [SolverChoice::Card, SolverChoice::Host(Solver::GaussSeidel), SolverChoice::Host(Solver::Direct)];
        let solvers = or(&self.solvers, &usual);
        let of_the_card = !self.packings.is_empty() || !self.storages.is_empty();
        let stops = self.tolerance.is_some() || self.iterations.is_some();
        let on_card = solvers.contains(&SolverChoice::Card);
        let iterates = solvers.iter().any(|solver| *solver != SolverChoice::Host(Solver::Direct));
        let idle = [
            (of_the_card && !on_card, "`--packing` and `--storage` are for the card", "these options"),
            (!self.frames.is_empty() && !on_card, "`--picture-after` shows the iterations of the card", "the option"),
            (!self.sweep.is_empty() && !on_card, "`--sweep-patches` changes the switches of the card", "the option"),
            (stops && !iterates, "`--tolerance` and `--iterations` are for solvers that iterate", "these options"),
        ];
        if let Some((_, what, options)) = idle.into_iter().find(|(idle, ..)| *idle) {
            return Err(StudyError::usage(what, format!("remove {options}, or add `--solver card`")));
        }
        let (packings, storages) = (or(&self.packings, &[Packing::Rgb]), or(&self.storages, &[Storage::Fp32]));
        let pairs = packings.iter().flat_map(|&packing| storages.iter().map(move |&storage| (packing, storage)));
        let cards: Vec<_> =
            pairs.map(|(packing, storage)| SolveMethod::Card(CardMethod { packing, storage })).collect();
        let methods = solvers.iter().flat_map(|solver| match solver {
            SolverChoice::Host(solver) => vec![SolveMethod::Host(*solver)],
            SolverChoice::Card => cards.clone(),
        });
        Ok(methods.collect())
    }
}
