//! Modelled time of pass 2 for each variant that the text leaves open.
//!
//! The time of a pass over a square is quadratic in its side: each texel costs the same, quads along the diagonal of
//! the two triangles are shaded twice, and each draw has a fixed cost. So the time for a large square is extrapolated
//! from three small squares.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::ExecutorKind;

use super::{RunResult, Shared, StudyError, no_time};
use crate::atlas::Atlas;
use crate::card::Texels;
use crate::geom::Mesh;
use crate::study::reproduce::shared::SharedResult;
use crate::subsurface::on_card::{
    CardModel, FloatTexels, Light, LightStage, LinkTextures, MapFormat, PassEvent, PassKind, SubsurfaceCard,
    SubsurfaceCardOptions, pass_times,
};

/// Links per texel in the paper's runs.
pub(super) const LINKS: usize = 16;
/// Card of Table 1: "a GeForce FX 5900".
pub(in crate::study::reproduce) const CARD: &str = "fx5900";
/// Sides of the timed squares, in texels.
const SIDES: [u32; 3] = [32, 64, 128];
/// Index of pass 2 among the times of passes.
const GATHER: usize = 2;

/// Choices for pass 2 that the text leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Variant {
    pub(super) name: &'static str,
    pub(super) fixed: bool,
    pub(super) map: MapFormat,
    pub(super) half: bool,
    /// Number of link textures per side of a texture that holds them as tiles.
    pub(super) tiles: Option<u32>,
}

impl Variant {
    const fn new(name: &'static str, fixed: bool, map: MapFormat, half: bool) -> Self {
        Self { name, fixed, map, half, tiles: None }
    }
}

/// Map format of the rows.
pub(super) const EIGHT: MapFormat = MapFormat::Unorm8 { scale: 0.25 };

/// All variants, starting with those with fixed links.
pub(super) const VARIANTS: [Variant; 9] = [
    Variant::new("fixed, 8-bit map", true, EIGHT, false),
    Variant::new("fixed, 8-bit map, half precision", true, EIGHT, true),
    Variant::new("fixed, fp16 map", true, MapFormat::Fp16, false),
    Variant::new("fixed, fp16 map, half precision", true, MapFormat::Fp16, true),
    Variant::new("fixed, fp32 map", true, MapFormat::Fp32, false),
    Variant::new("adaptive, 8-bit map", false, EIGHT, false),
    Variant::new("adaptive, fp16 map", false, MapFormat::Fp16, false),
    Variant::new("adaptive, fp32 map", false, MapFormat::Fp32, false),
    // A texture of 2048 x 2048 holds all link textures of 512 x 512; the larger atlas needs four.
    Variant { tiles: Some(4), ..Variant::new("adaptive, 8-bit map, tiled links", false, EIGHT, false) },
];

#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::study::reproduce) struct GatherCost {
    pub(super) programs: usize,
    /// Total number of instructions of all passes.
    pub(super) instructions: usize,
    /// Number of samplers of the largest program.
    pub(super) samplers: usize,
    /// Texture reads per texel.
    pub(super) lookups: f64,
    /// Seconds at each of [`SIDES`].
    seconds: [f64; 3],
}

impl GatherCost {
    /// Seconds for a square with `side` texels per side: the quadratic through the three timed squares.
    pub(super) fn seconds(&self, side: f64) -> f64 {
        let [a, b, c] = SIDES.map(f64::from);
        let term = |t: f64, at: f64, p: f64, q: f64| t * (side - p) * (side - q) / ((at - p) * (at - q));
        let [ta, tb, tc] = self.seconds;
        term(ta, a, b, c) + term(tb, b, a, c) + term(tc, c, a, b)
    }
}

/// Costs of all variants on the card of this name, in the order of [`VARIANTS`].
impl SharedResult for Vec<GatherCost> {
    type Key = &'static str;

    fn compute(&card: &&'static str, _: &Shared) -> Result<Self, StudyError> {
        VARIANTS.iter().map(|variant| cost(card, *variant)).collect()
    }
}

pub(super) fn cost(card: &'static str, variant: Variant) -> Result<GatherCost, StudyError> {
    let mut found = GatherCost { programs: 0, instructions: 0, samplers: 0, lookups: 0.0, seconds: [0.0; 3] };
    for (seconds, side) in found.seconds.iter_mut().zip(SIDES) {
        let profile = Profile::named(card)?;
        let square = square(side).on(card)?;
        let mut machine = loaded(profile.clone(), square, variant).on(card)?;
        machine.record(true);
        machine.light(&[Light::Sky { radiance: [1.0; 3] }]).on(card)?;
        let log = machine.take_log();
        *seconds = pass_times(&profile, &log).map_err(no_time)?[GATHER].time.seconds();
        found.lookups = lookups(&log);
        let programs = machine.gather_programs();
        found.programs = programs.len();
        found.instructions = programs.iter().map(|program| program.instructions()).sum();
        found.samplers = programs.iter().map(|program| program.samplers()).max().unwrap_or(0);
    }
    Ok(found)
}

/// Texture reads per fragment of pass 2, over all of its draws.
fn lookups(log: &[PassEvent]) -> f64 {
    let draws = log.iter().filter(|event| event.pass == PassKind::Gather);
    let draws = draws
        .filter_map(|event| if let Event::Draw(draw) = &event.event { Some(&draw.counts.fragments) } else { None });
    draws.map(|fragments| fragments.fetches.iter().sum::<u64>() as f64 / fragments.shaded as f64).sum()
}

/// A square made of the medium, whose atlas has `side` texels per side.
fn square(side: u32) -> Result<CardModel, Box<dyn std::error::Error + Send + Sync>> {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    Ok(CardModel::new(&Atlas::new(&Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]])?, side)?))
}

/// Loads a model whose links are all identical and lead to its middle: time does not depend on values.
pub(super) fn loaded(
    profile: Profile,
    model: CardModel,
    variant: Variant,
) -> Result<SubsurfaceCard, Box<dyn std::error::Error + Send + Sync>> {
    let side = model.side();
    let (level, textures, texel) = if variant.fixed {
        (Some(side.ilog2() - LINKS.ilog2() / 2), LINKS / 4, [1.0 / 16.0; 4])
    } else {
        (None, LINKS, [0.5, 0.5, 1.0 / 16.0, 0.0])
    };
    let textures = vec![Texels::from_fn([side as usize; 2], |_, _| texel); textures];
    let links = LinkTextures::from_textures(side, level, false, LINKS, textures)?;
    let options = SubsurfaceCardOptions {
        light: LightStage::Vertices,
        map: variant.map,
        links: FloatTexels::Fp16,
        scattered: FloatTexels::Fp16,
        half: variant.half,
        tiles: variant.tiles,
    };
    Ok(SubsurfaceCard::new(profile, ExecutorKind::Batch, model, &links, 1.3, options)?)
}
