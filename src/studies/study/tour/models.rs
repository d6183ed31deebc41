//! The models in the room: a glossy bunny by clustered principal components, and a statue of marble.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;
use refsim::timing::Picoseconds;

use crate::atlas::Atlas;
use crate::card::MeshView;
use crate::card::frame_time::frame_time;
use crate::clustering::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, StartPoints, compress};
use crate::cpca::on_card::time::host_of_section_7;
use crate::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crate::cpca::transfer::{Bounces, Incident};
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::sphere::HarmonicLight;
use crate::split::SplitRun;
use crate::study::caster::{CastRecord, CasterChoice};
use crate::study::prt::{ExitRadiance, Precomputation, Precomputed, no_cpca_card};
use crate::study::subsurface::{environment, no_atlas, no_card};
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::links::{LinkChoice, Links, MeanWeighting};
use crate::subsurface::multipole::SurfaceMoments;
use crate::subsurface::on_card::{
    CardModel, FloatTexels, LinkTextures, MapFormat, SubsurfaceCard, SubsurfaceCardOptions, View, pass_times,
};
use crate::subsurface::{Dipole, distant_irradiance, materials};
use crate::transfer::brdf::{Brdf, ExitBasis};
use crate::transfer::light::CubeLight;
use crate::transfer::{Tangents, Vertices};

/// Order of the bunny's light.
pub(super) const ORDER: usize = 5;
/// Its gloss.
const BRDF: Brdf = Brdf::Phong { albedo: 0.25, specular: 0.7, exponent: 20.0 };
/// Clusters of its transfer, and their vectors besides the mean.
const CLUSTERS: usize = 32;
const VECTORS: usize = 6;
/// Texels along a side of the statue's atlas, and the size of the room's unit.
const SIDE: u32 = 128;
const MM_PER_UNIT: f64 = 10.0;
/// Texels of the light along a side of the square that a shadow ray on the statue represents.
const SHADOW_GROUP: usize = 8;

/// Exposed linear colors of pixels, with the modelled time of the frame; `None` for cards without rates.
pub(super) type Drawn = (Vec<[f64; 3]>, Option<Picoseconds>);

/// Transfer of the bunny by rays of a caster.
pub(super) fn transfer(
    mesh: &Mesh,
    vertices: &Vertices,
    caster: &CasterChoice,
    progress: &mut ProgressFn<'_>,
) -> Result<(Precomputed, Option<CastRecord>), StudyError> {
    let (basis, incident) = (ExitBasis::of_order(ORDER), Incident::Directions);
    let precomputation = Precomputation {
        mesh,
        vertices,
        channels: vec![(1, vec![BRDF])],
        exit: ExitRadiance::Glossy { basis, least_squares: true, incident },
        order: ORDER,
        degree: 24,
        bounces: Bounces::Count(0),
        scatterer: None,
    };
    let mut open = caster.open_judged(mesh, Sides::Both)?;
    let label = caster.label().to_owned();
    let mut progress = |what: &str, done, of| progress(&format!("transfer by {label}: {what}"), done, of);
    let found = precomputation.run_split(&mut open, &SplitRun::Whole, &mut progress)?.whole();
    Ok((found, open.record()))
}

/// The bunny, ready to be drawn.
pub(super) struct GlossyBunny {
    vertices: Vertices,
    clustering: Clustering,
    basis: ExitBasis,
    light: HarmonicLight,
}

impl GlossyBunny {
    pub(super) fn new(vertices: Vertices, transfer: Precomputed, light: HarmonicLight) -> Self {
        let signal = transfer.file.transfer.expect("transfer that was computed");
        let options = CpcaOptions {
            clusters: CLUSTERS,
            vectors: VECTORS,
            vq_iterations: 5,
            iterations: 5,
            method: CpcaMethod::Iterative,
            form: CpcaForm::Affine,
            start: StartPoints::Seed(1),
        };
        let clustering = compress(&signal, &options, |_| ()).expect("fewer clusters than vertices").clustering;
        Self { vertices, clustering, basis: ExitBasis::of_order(ORDER), light }
    }

    pub(super) fn draw(
        &self,
        profile: &Profile,
        executor: &Executor,
        view: &MeshView,
        options: &PrtCardOptions,
    ) -> Result<Drawn, StudyError> {
        let Self { vertices, clustering, basis, light } = self;
        let transfer =
            CompressedTransfer { vertices, clustering, basis, channels: 1, vectors: VECTORS, superclusters: None };
        let card = PrtCard::new(profile.clone(), executor.clone(), transfer, options);
        let (texels, log) = card.and_then(|mut card| card.logged_view(light, view)).map_err(no_cpca_card)?;
        Ok((texels.colors(), frame_time(profile, &log, &host_of_section_7()?).ok().map(|time| time.frame)))
    }
}

/// The statue, ready to be drawn.
pub(super) struct MarbleStatue {
    model: CardModel,
    textures: LinkTextures,
    irradiance: Vec<[f64; 3]>,
    eta: f64,
}

impl MarbleStatue {
    /// The statue under the light of its probe, with shadows by rays of a caster.
    pub(super) fn new(
        mesh: &Mesh,
        light: &CubeLight,
        caster: &CasterChoice,
        progress: &mut ProgressFn<'_>,
    ) -> Result<(Self, Option<CastRecord>), StudyError> {
        let material = materials::named("marble").expect("a published medium").material();
        let [red, green, blue] = material.channels;
        let eta = material.eta;
        let dipoles = [Dipole::new(red, eta)?, Dipole::new(green, eta)?, Dipole::new(blue, eta)?];
        let atlas = Atlas::new(mesh, SIDE).map_err(no_atlas)?;
        progress("light on the marble", 0, 2);
        let mut open = caster.open_judged(mesh, Sides::Both)?;
        let irradiance = distant_irradiance(&atlas, &environment::sources(light, SHADOW_GROUP), eta, &mut open);
        let irradiance = irradiance.map_err(crate::error::InputError::from)?;
        progress("links of the marble", 1, 2);
        let surface = SurfaceMoments::new(&atlas, MM_PER_UNIT)?;
        let links = Links::new(&surface, &dipoles, LinkChoice::Fixed { level: SIDE.ilog2() - 2 }, 0.05, &|_, _| {})?;
        let textures = LinkTextures::new(&links, &surface, MeanWeighting::Area);
        Ok((Self { model: CardModel::new(&atlas), textures, irradiance, eta }, open.record()))
    }

    pub(super) fn draw(
        &self,
        profile: &Profile,
        executor: &Executor,
        view: MeshView,
        texels: FloatTexels,
    ) -> Result<Drawn, StudyError> {
        let map = if texels == FloatTexels::Fp32 { MapFormat::Fp32 } else { MapFormat::Fp16 };
        let options =
            SubsurfaceCardOptions { map, links: texels, scattered: texels, ..SubsurfaceCardOptions::default() };
        let (model, executor) = (self.model.clone(), executor.clone());
        let card = SubsurfaceCard::new(profile.clone(), executor, model, &self.textures, self.eta, options);
        let mut card = card.map_err(no_card)?;
        card.record(true);
        card.irradiate(&self.irradiance).map_err(no_card)?;
        let colors = card.view_texels(&View::scattered(view)).map_err(no_card)?.colors();
        let times = pass_times(profile, &card.take_log()).ok();
        Ok((colors, times.map(|times| times.iter().map(|pass| pass.time).sum())))
    }
}
