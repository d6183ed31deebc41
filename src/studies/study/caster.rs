//! `--caster`: the ray caster of a command, the host's octree or the Ray Engine on a card.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;
use refsim::num::Format;
use refsim::timing::replay::{Options, ReplayError, replay};
use refsim::timing::{Level, Model, Picoseconds};
use serde_json::json;

use crate::geom::exact::{NearestHit, Sides, Tracer};
use crate::geom::{Hit, Mesh, Ray};
use crate::options::number;
use crate::options::one_of::{OneOf, one_of};
use crate::ray_engine::EngineError;
use crate::ray_engine::engine::{EngineCounts, EngineParameters, RayEngine, Readback};
use crate::report::Findings;
use crate::report::digits::{Quantity, count, shown};
use crate::study::StudyError;
use crate::study::configuration::Configuration;
use crate::tracer::octree::OctreeParameters;
use crate::tracer::{CastError, Caster, HostTracer, is_occluder};

/// Number of rays whose exact hits are in memory at the same time.
const JUDGED_AT_ONCE: usize = 1 << 16;

/// Options of a command's ray caster; all but `--caster` are for the Ray Engine (its sections 5.2, 6.2 and 6.3).
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Ray caster")]
pub struct CasterOptions {
    /// The ray caster [default: host; for `intersect`: exact arithmetic, or the card of --device]
    #[arg(long, value_name = "C", value_parser = casters())]
    caster: Option<bool>,

    /// Card of the Ray Engine [default: ideal-fp32]
    #[arg(long, value_name = "D")]
    caster_device: Option<String>,

    /// Number format of that card's programs, instead of the card's own; `radiosity` compares several formats
    #[arg(long, value_name = "F")]
    caster_format: Vec<String>,

    /// Octree of the engine: cells with more than TRIANGLES triangles are divided, down to level DEPTH, at most 20
    /// [default: 8,10]
    #[arg(long, value_name = "TRIANGLES,DEPTH", value_parser = pair)]
    octree: Option<[u32; 2]>,

    /// Minimum and maximum number of triangles of a cell that the card tests [default: 5,15]
    #[arg(long, value_name = "LEAST,MOST", value_parser = pair)]
    pass_triangles: Option<[u32; 2]>,

    /// Rays per pass on the card; if fewer rays meet a cell, the host tests them [default: 64]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=65536))]
    pass_rays: Option<u32>,

    /// When the host reads the results of a pass: sync (the host waits), async:N (N passes in flight), free (passes
    /// take no time) [default: sync]
    #[arg(long, value_name = "MODE", value_parser = readback)]
    readback: Option<Readback>,
}

/// Values of `--caster`; `true` is the engine.
fn casters() -> OneOf<bool> {
    let host = ("host", "The host's octree, in single precision", false);
    one_of([host, ("engine", "The Ray Engine, host and card together", true)])
}

fn readback(text: &str) -> Result<Readback, String> {
    let flying = text.strip_prefix("async:").and_then(|passes| passes.parse().ok()).filter(|passes| *passes > 0);
    match (text, flying) {
        ("sync", _) => Ok(Readback::Synchronous),
        ("free", _) => Ok(Readback::InfinitelyFast),
        (_, Some(passes)) => Ok(Readback::Asynchronous { passes }),
        _ => Err(format!("expected sync, async:N with N of at least 1, or free; found `{text}`")),
    }
}

/// Two numbers, the first at least 1.
fn pair(text: &str) -> Result<[u32; 2], String> {
    let pair = text.split_once(',').and_then(|(a, b)| Some([a.trim().parse().ok()?, b.trim().parse().ok()?]));
    pair.filter(|pair| pair[0] > 0).ok_or_else(|| format!("expected two numbers as in 8,10; found `{text}`"))
}

impl CasterOptions {
    /// Returns `true` if a caster is given.
    pub fn is_named(&self) -> bool {
        self.caster.is_some()
    }

    /// Returns `true` for `--caster engine`.
    pub fn is_engine(&self) -> bool {
        self.caster == Some(true)
    }

    /// Returns the caster; `executor` runs the engine's programs. Fails as [`Self::choose_each`] does, and for several
    /// formats.
    pub fn choose(&self, executor: Executor) -> Result<CasterChoice, StudyError> {
        match &mut self.choose_each(executor)?[..] {
            [one] => Ok(std::mem::take(one)),
            _ => Err(StudyError::usage("expected one `--caster-format` here, found several", "give only one")),
        }
    }

    /// Returns a caster for each `--caster-format`. Fails if engine options are given without the engine, a device or
    /// format is unknown, or a number is out of range.
    pub fn choose_each(&self, executor: Executor) -> Result<Vec<CasterChoice>, StudyError> {
        let Self { caster_device, caster_format, octree, pass_triangles, pass_rays, readback, .. } = self;
        if !self.is_engine() {
            let given = [
                ("--caster-device", caster_device.is_some()),
                ("--caster-format", !caster_format.is_empty()),
                ("--octree", octree.is_some()),
                ("--pass-triangles", pass_triangles.is_some()),
                ("--pass-rays", pass_rays.is_some()),
                ("--readback", readback.is_some()),
            ];
            return match given.into_iter().find(|(_, given)| *given) {
                Some((option, _)) => {
                    let help = "remove the option, or add `--caster engine`";
                    Err(StudyError::usage(format!("`{option}` is for the Ray Engine"), help))
                }
                None => Ok(vec![CasterChoice::Host]),
            };
        }
        let mut parameters = EngineParameters::default();
        if let &Some([most_triangles, most_depth]) = octree {
            parameters.octree = OctreeParameters { most_triangles: most_triangles as usize, most_depth };
        }
        if let &Some([least, most]) = pass_triangles {
            parameters.triangles = least as usize..=most as usize;
        }
        if parameters.octree.most_depth > 20 || parameters.triangles.is_empty() {
            let what = "expected a depth of at most 20 in `--octree`, and LEAST not above MOST in `--pass-triangles`";
            return Err(StudyError::usage(what, "write for example `--octree 8,10 --pass-triangles 5,15`"));
        }
        parameters.rays = pass_rays.map_or(parameters.rays, |rays| rays as usize);
        parameters.readback = readback.unwrap_or_default();
        let engine = |card: Configuration| {
            let (executor, parameters) = (executor.clone(), parameters.clone());
            CasterChoice::Engine(Box::new(EngineChoice { card, executor, parameters }))
        };
        let cards = match (caster_device, &caster_format[..]) {
            (None, []) => vec![Configuration::device("ideal-fp32")?],
            (device, formats) => Configuration::each(device.as_slice(), formats)?,
        };
        Ok(cards.into_iter().map(engine).collect())
    }
}

/// A ray caster, to be built over a mesh.
#[derive(Clone, Debug, Default)]
pub enum CasterChoice {
    /// The host's octree, in single precision.
    #[default]
    Host,
    /// The Ray Engine.
    Engine(Box<EngineChoice>),
}

/// A Ray Engine, to be built over a mesh.
#[derive(Clone, Debug)]
pub struct EngineChoice {
    /// Card of the engine.
    pub card: Configuration,
    /// Executor of the card's programs.
    pub executor: Executor,
    /// Scheduling; the culling mode is the one given to [`CasterChoice::open`].
    pub parameters: EngineParameters,
}

impl CasterChoice {
    /// The Ray Engine with default scheduling on a card.
    pub fn engine(card: Configuration, executor: Executor) -> Self {
        Self::Engine(Box::new(EngineChoice { card, executor, parameters: EngineParameters::default() }))
    }

    /// Profile of the engine's card; `None` for the host.
    pub fn profile(&self) -> Option<&Profile> {
        match self {
            Self::Host => None,
            Self::Engine(choice) => Some(&choice.card.profile),
        }
    }

    /// Name: `host`, or the name of the engine's card and format.
    pub fn label(&self) -> &str {
        match self {
            Self::Host => "host",
            Self::Engine(choice) => &choice.card.label,
        }
    }

    /// Number format in which hits are computed.
    pub fn format(&self) -> Format {
        self.profile().map_or(Format::FP32, |profile| profile.rules.format)
    }

    /// Builds the structures over a mesh: the octree, and for the engine its GPU cells and the card. Fails if the card
    /// cannot run an intersection program.
    pub fn open<'a>(&self, mesh: &'a Mesh, sides: Sides) -> Result<OpenCaster<'a>, EngineError> {
        Ok(OpenCaster(match self {
            Self::Host => OpenKind::Host(Box::new(HostTracer::new(mesh, sides))),
            Self::Engine(choice) => {
                let EngineChoice { card, executor, parameters } = &**choice;
                let (rates, label) = (Model::new(Level::Pipeline, &card.profile).ok(), card.label.clone());
                let parameters = EngineParameters { sides, record: rates.is_some(), ..parameters.clone() };
                let engine = RayEngine::new(mesh, card.profile.clone(), executor.clone(), parameters)?;
                let card = rates.is_some().then_some(Picoseconds::ZERO);
                let record = CastRecord { label, counts: EngineCounts::default(), card, differing: None };
                OpenKind::Engine(Box::new(OpenEngine { engine, rates, sides, exact: None, record }))
            }
        }))
    }

    /// As [`Self::open`], but compares the engine's answers with exact arithmetic: see [`CastRecord::differing`].
    pub fn open_judged<'a>(&self, mesh: &'a Mesh, sides: Sides) -> Result<OpenCaster<'a>, EngineError> {
        let mut open = self.open(mesh, sides)?;
        if let OpenKind::Engine(engine) = &mut open.0 {
            engine.exact = Some(Tracer::new(mesh));
            engine.record.differing = Some(0);
        }
        Ok(open)
    }
}

/// A caster with its acceleration structures, built over a mesh.
pub struct OpenCaster<'a>(OpenKind<'a>);

enum OpenKind<'a> {
    Host(Box<HostTracer>),
    Engine(Box<OpenEngine<'a>>),
}

struct OpenEngine<'a> {
    engine: RayEngine<'a>,
    rates: Option<Model>,
    sides: Sides,
    exact: Option<Tracer<'a>>,
    record: CastRecord,
}

/// Statistics of the Ray Engine.
#[derive(Clone, Debug)]
pub struct CastRecord {
    /// Name of the card and its format.
    pub label: String,
    /// Numbers of rays, passes and tests.
    pub counts: EngineCounts,
    /// Modelled time of the passes, without the tests on the host; `None` for cards without rates.
    pub card: Option<Picoseconds>,
    /// Number of answers that differ from exact arithmetic: for shadow rays, in whether light arrives; for others, in
    /// the triangle or in whether there is one.
    /// `None` if the answers were not compared.
    pub differing: Option<u64>,
}

impl OpenCaster<'_> {
    /// Statistics of the engine so far; `None` for the host.
    pub fn record(&self) -> Option<CastRecord> {
        match &self.0 {
            OpenKind::Host(_) => None,
            OpenKind::Engine(open) => Some(CastRecord { counts: open.engine.counts(), ..open.record.clone() }),
        }
    }
}

/// Modelled time of a log.
pub(super) fn makespan(log: &[Event], rates: &Model) -> Result<Picoseconds, ReplayError> {
    Ok(replay(log, rates, &Options::of(Level::Pipeline))?.timeline.makespan())
}

impl OpenEngine<'_> {
    fn cast(
        &mut self,
        rays: &[Ray],
        differs: impl Fn(Option<Hit>, Option<NearestHit>) -> bool,
    ) -> Result<Vec<Option<Hit>>, CastError> {
        let hits = self.engine.trace(rays).map_err(|error| CastError(error.into()))?;
        let log = self.engine.take_log();
        if let (Some(rates), Some(card)) = (&self.rates, &mut self.record.card) {
            *card += makespan(&log, rates).map_err(|error| CastError(error.into()))?;
        }
        if let (Some(exact), Some(differing)) = (&self.exact, &mut self.record.differing) {
            for (rays, hits) in rays.chunks(JUDGED_AT_ONCE).zip(hits.chunks(JUDGED_AT_ONCE)) {
                let truth = exact.nearest_all(rays, self.sides);
                *differing +=
                    hits.iter().zip(truth).filter(|(hit, truth)| differs(**hit, truth.clone())).count() as u64;
            }
        }
        Ok(hits)
    }
}

impl Caster for OpenCaster<'_> {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        match &mut self.0 {
            OpenKind::Host(host) => host.cast(rays),
            OpenKind::Engine(open) => open.cast(rays, |hit, truth| match (hit, truth) {
                (Some(hit), Some(truth)) => !truth.ties.contains(&hit.triangle),
                (hit, truth) => hit.is_some() != truth.is_some(),
            }),
        }
    }

    fn occluded(&mut self, rays: &[Ray]) -> Result<Vec<bool>, CastError> {
        match &mut self.0 {
            OpenKind::Host(host) => host.occluded(rays),
            OpenKind::Engine(open) => {
                let blocked = |truth: Option<NearestHit>| truth.is_some_and(|truth| truth.t.to_f64() < 1.0);
                let hits = open.cast(rays, |hit, truth| is_occluder(hit) != blocked(truth))?;
                Ok(hits.into_iter().map(is_occluder).collect())
            }
        }
    }
}

impl CastRecord {
    /// Adds the record to findings.
    pub fn report(&self, found: &mut Findings) {
        let Self { counts, card, differing, .. } = self;
        let card = card.map(Picoseconds::seconds);
        found.field(
            "engine",
            json!({ "rays": counts.rays, "rays_on_card": counts.rays_on_card, "passes": counts.passes,
                    "pass_rays": counts.pass_rays, "pass_tests": counts.pass_tests, "host_tests": counts.host_tests,
                    "rays_differing": differing, "card_s": card }),
        );
        found.print(format!(
            "engine: {} % of the rays were tested on the card, in {} passes with {} tests; {} tests on the host",
            shown(100.0 * counts.share_on_card(), Quantity::Percent),
            count(counts.passes),
            count(counts.pass_tests),
            count(counts.host_tests)
        ));
        if let Some(differing) = differing {
            let [differing, rays] = [*differing, counts.rays].map(count);
            found.print(format!("engine: {differing} of {rays} rays differ from exact arithmetic"));
        }
        if let Some(card) = card {
            found.print(format!("engine: the passes take {} s (modelled)", shown(card, Quantity::Measured)));
        }
    }
}
