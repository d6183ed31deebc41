//! One way of gathering: links, the three passes, and their cost.

use refsim::event::Event;
use refsim::num::Format;
use refsim::timing::TimingError;

use super::all_pairs::GatherError;
use super::seams::Neighbours;
use super::{AngleBin, GatherWay, Lighting, MapBits, Parameters, angles, no_card};
use crate::atlas::Atlas;
use crate::card::CardError;
use crate::picture::Picture;
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::Dipole;
use crate::subsurface::kernels::{DirectLight, EyeTransmittance, ViewKernel};
use crate::subsurface::links::{EncodedLinks, IrradianceMeans, Links, LostFactors, MeanWeighting, SCALAR_CHANNEL};
use crate::subsurface::multipole::SurfaceMoments;
use crate::subsurface::on_card::{
    CardModel, FloatTexels, LightStage, LinkTextures, MapFormat, PassTime, SubsurfaceCard, SubsurfaceCardOptions, View,
    pass_times,
};

/// Diffuse reflectance for direct light.
const DIFFUSE: f64 = 0.1;
/// Kernel of pass 3.
const VIEW: ViewKernel = ViewKernel { transmittance: EyeTransmittance::Exact, direct: DirectLight::ByFragment };

/// Inputs that all ways of gathering share.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub(super) parameters: &'a Parameters,
    pub(super) atlas: &'a Atlas,
    pub(super) surface: &'a SurfaceMoments,
    pub(super) model: &'a CardModel,
    pub(super) dipoles: &'a [Dipole; 3],
    /// E per texel, computed by the host.
    pub(super) irradiance: &'a [[f64; 3]],
    pub(super) truth: Option<&'a [[f64; 3]]>,
    pub(super) neighbours: &'a Neighbours,
}

#[derive(Debug)]
pub(super) struct WayRow {
    pub(super) label: String,
    pub(super) way: GatherWay,
    /// Reads of link textures and of the map per texel: 2 L and 1.25 L in the paper (4.2.3), for scalar factors.
    pub(super) lookups: [usize; 2],
    /// Card memory in bytes: in total, and for links alone.
    pub(super) memory: [u64; 2],
    /// Numbers of instructions and samplers of each program of pass 2.
    pub(super) programs: Vec<[usize; 2]>,
    pub(super) lost: LostFactors,
    /// Number of texel channels of the map at its largest value.
    pub(super) saturated: usize,
    /// The links' own error: the host's sum over the links compared with its sum over all pairs.
    pub(super) links_error: Option<GatherError>,
    /// Roughness of the errors among neighboring texels, relative to B.
    pub(super) seams: Option<f64>,
    /// The links' own error, with texels weighted equally instead of by area.
    pub(super) plain_error: Option<GatherError>,
    /// The card's own error: compared with the host's sum over the same links.
    pub(super) card_error: GatherError,
    /// Total error: the card compared with the host's sum over all pairs.
    pub(super) error: Option<GatherError>,
    /// Errors by angle from the light; empty without all pairs, or unless the only light is a single directional one.
    pub(super) angles: Vec<AngleBin>,
    /// Modelled times of the passes; `None` for devices without timing.
    pub(super) times: Option<[PassTime; 4]>,
    pub(super) radiosity: Vec<[f64; 3]>,
    /// E of every texel, as in the card's map; only for the first way of gathering.
    pub(super) irradiance: Vec<[f64; 3]>,
    pub(super) picture: Picture,
    pub(super) scattered: Picture,
    pub(super) log: Vec<Event>,
}

pub(super) fn links(scene: &Scene<'_>, way: GatherWay, progress: &mut ProgressFn<'_>) -> Result<Links, StudyError> {
    progress(&format!("links: {}", way.label(scene.parameters.options.side)), 0, 2);
    let (dipoles, tolerance) = (link_dipoles(scene, way), scene.parameters.options.tolerance);
    Ok(Links::new(scene.surface, dipoles, way.choice, tolerance)?)
}

/// The dipoles of the link factors: for red, green and blue, or green's for all channels.
fn link_dipoles<'a>(scene: &Scene<'a>, way: GatherWay) -> &'a [Dipole] {
    if way.rgb { &scene.dipoles[..] } else { &scene.dipoles[SCALAR_CHANNEL..=SCALAR_CHANNEL] }
}

pub(super) fn run(
    scene: &Scene<'_>,
    way: GatherWay,
    (links, first): (&Links, bool),
    progress: &mut ProgressFn<'_>,
) -> Result<WayRow, StudyError> {
    let parameters = scene.parameters;
    let label = way.label(parameters.options.side);
    let host = |weighting| -> Result<Vec<[f64; 3]>, StudyError> {
        Ok(links.gather(&IrradianceMeans::new(scene.surface, scene.irradiance, weighting)?))
    };
    let (summed, plain) = (host(MeanWeighting::Area)?, host(MeanWeighting::Count)?);
    let encoded = EncodedLinks::new(links, scene.surface, MeanWeighting::Area);
    let textures = LinkTextures::new(links, scene.surface, MeanWeighting::Area);
    progress(&format!("passes: {label}"), 1, 2);
    let mut card = lit_card(scene, way, &textures).map_err(no_card)?;
    let radiosity = card.read_scattered().map_err(no_card)?.colors();
    drop(textures);
    let picture = card.view(&view(parameters, VIEW.direct)).map_err(no_card)?;
    let events = card.take_log();
    card.record(false);
    let times = match pass_times(&parameters.profile, &events) {
        Ok(times) => Some(times),
        Err(TimingError::Missing { .. }) => None,
        Err(error) => return Err(StudyError::coded("subsurface::timing", error)),
    };
    let scattered = card.view(&view(parameters, DirectLight::None)).map_err(no_card)?;
    let irradiance = if first { entered(scene, &card).map_err(no_card)? } else { Vec::new() };
    let off = |found: &[[f64; 3]], expected: &[[f64; 3]]| GatherError::between(scene.atlas, found, expected);
    let against_truth = |found: &[[f64; 3]]| scene.truth.map(|truth| off(found, truth));
    let programs = card.gather_programs();
    Ok(WayRow {
        lookups: [encoded.texture_count(), links.per_texel()],
        memory: card.memory(),
        programs: programs.iter().map(|program| [program.instructions(), program.samplers()]).collect(),
        lost: encoded.lost(if way.links == FloatTexels::Fp16 { Format::FP16 } else { Format::FP32 }),
        saturated: card.saturated().map_err(no_card)?,
        links_error: against_truth(&summed),
        seams: scene.truth.map(|truth| scene.neighbours.seams(scene.atlas, &summed, truth)),
        plain_error: against_truth(&plain),
        card_error: off(&radiosity, &summed),
        error: against_truth(&radiosity),
        angles: angles::direction(&parameters.lighting)
            .zip(scene.truth)
            .map(|(towards, truth)| angles::by_angle(scene.atlas, towards, truth, [&summed, &radiosity]))
            .unwrap_or_default(),
        times,
        irradiance,
        picture,
        scattered,
        log: events.into_iter().map(|event| event.event).collect(),
        radiosity,
        way,
        label,
    })
}

/// A card loaded with these links, whose maps are lit and gathered; it records events.
fn lit_card(scene: &Scene<'_>, way: GatherWay, textures: &LinkTextures) -> Result<SubsurfaceCard, CardError> {
    let parameters = scene.parameters;
    let options = SubsurfaceCardOptions {
        light: LightStage::default(),
        map: map_format(scene, way.map),
        links: way.links,
        scattered: way.links,
        half: false,
        tiles: None,
    };
    let (profile, executor) = (parameters.profile.clone(), parameters.executor.clone());
    let eta = parameters.material.eta;
    let mut card = SubsurfaceCard::new(profile, executor, scene.model.clone(), textures, eta, options)?;
    card.record(true);
    match &parameters.lighting {
        Lighting::Lights(lights) => card.light(lights)?,
        Lighting::Environment(_) => card.irradiate(scene.irradiance)?,
    }
    Ok(card)
}

/// The map's format; 8 bits hold the host's brightest texel as 1.
fn map_format(scene: &Scene<'_>, map: MapBits) -> MapFormat {
    match map {
        MapBits::Fp16 => MapFormat::Fp16,
        MapBits::Fp32 => MapFormat::Fp32,
        MapBits::Eight => {
            let mean = scene.atlas.mean_texel_area();
            let stored = scene.atlas.texels().iter().zip(scene.irradiance);
            let most = stored.flat_map(|(t, e)| e.map(|e| e * t.area / mean)).fold(0.0, f64::max);
            MapFormat::Unorm8 { scale: if most > 0.0 { 1.0 / most } else { 1.0 } }
        }
    }
}

fn view(parameters: &Parameters, direct: DirectLight) -> View {
    let kernel = ViewKernel { direct, ..VIEW };
    View { kernel, diffuse: [DIFFUSE; 3], ..View::scattered(parameters.camera) }
}

/// E of every texel, as in the map; 0 for a texel without area.
fn entered(scene: &Scene<'_>, card: &SubsurfaceCard) -> Result<Vec<[f64; 3]>, CardError> {
    let (map, scale) = (card.read_map()?, card.options().map.scale());
    let mean = scene.atlas.mean_texel_area();
    let texel = |(&[r, g, b, _], texel): (&[f32; 4], &crate::atlas::Texel)| {
        let factor = if texel.area > 0.0 { mean / (texel.area * scale) } else { 0.0 };
        [r, g, b].map(|value| f64::from(value) * factor)
    };
    Ok(map.texels.iter().zip(scene.atlas.texels()).map(texel).collect())
}
