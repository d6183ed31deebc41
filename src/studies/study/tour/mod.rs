//! One room through four systems: rays of the Ray Engine give form factors, and matrix radiosity lights the room.
//! Probes in the room light a glossy bunny by clustered principal components, and a marble suit of armor by subsurface
//! scattering.

mod clock;
mod formats;
mod light;
mod scene;

use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};
use refsim::texture::TexelFormat;

use crate::atlas::Atlas;
use crate::card::{MeshView, seen_pixels};
use crate::cpca::on_card::PrtCardOptions;
use crate::error::InputError;
use crate::geom::Sides;
use crate::options::{Size, number};
use crate::radiosity::{Patches, Subdivision, System};
use crate::report::{Findings, NamedPicture, Provenance};
use crate::study::caster::CasterChoice;
use crate::study::configuration::Configuration;
use crate::study::marble_model::MarbleModel;
use crate::study::prt::{light_picture, linear_picture, of_texels};
use crate::study::subsurface::{environment, no_atlas};
use crate::study::{ProgressFn, Study, StudyError, radiosity};
use crate::subsurface::distant_irradiance;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::FloatTexels;
use crate::transfer::light::CubeLight;
use crate::transfer::{Tangents, Vertices};
use clock::Clock;
use formats::FormatSubject;
use scene::{BUNNY, TourScene, middle};

/// Maximum number of patches of the room.
const PATCHES: usize = 800;
/// Number of faces of the room and of the bodies in it.
const LEAST_PATCHES: usize = 200;
/// The card that draws the bunny; the other one traces rays, solves radiosity and draws marble. Rays start so near to a
/// surface that they leave it only in single precision.
const RADEON: &str = "r300";
const GEFORCE: &str = "nv35";

/// Texels per side of the statue's atlas, with 16 links each, and millimeters per unit of the room.
const SIDE: u32 = 128;
const MM_PER_UNIT: f64 = 40.0;
/// Side, in texels of the light, of the square that one shadow ray on the statue represents.
const SHADOW_GROUP: usize = 8;

/// Parameters of the tour.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct Parameters {
    /// Size of the picture, in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    /// Make the edges of patches and of the models' triangles longer by this factor, for a quick look
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = number::whole::<u32>(1..=8))]
    coarser: u32,
}

impl Study for Parameters {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let executor = Executor::from(ExecutorKind::Batch);
        let [radeon, geforce] = [Profile::named(RADEON)?, Profile::named(GEFORCE)?];
        let engine = CasterChoice::engine(Configuration::of(&geforce), executor.clone());
        let scene = TourScene::new(self.size, self.coarser)?;
        let (camera, mut clock) = (scene.camera, Clock::default());

        let patches =
            Patches::new(&scene.room, Subdivision::AtMost((PATCHES / self.coarser as usize).max(LEAST_PATCHES)))?;
        let (factors, cast) = light::factors(&patches, &engine, progress)?;
        clock.rays("rays of form factors", &geforce, cast);
        let system = System::new(factors, patches.reflectances(), patches.emittances())?;
        progress("radiosity", 0, 1);
        let (radiosity, iterations, time) = light::radiosity(&system, &geforce, &executor)?;
        clock.step("radiosity", &geforce, format!("{iterations} iterations"), time);
        let exposure = radiosity::exposure(&patches, system.emittance(), &radiosity);
        let probe = |model| light::probe(&patches, &radiosity, &scene.walls, middle(model), &engine);
        let (by_bunny, cast) = probe(&scene.bunny)?;
        clock.rays("rays of the bunny's probe", &geforce, cast);
        let (by_statue, cast) = probe(&scene.statue)?;
        clock.rays("rays of the statue's probe", &geforce, cast);
        let vertices = Vertices::new(&scene.bunny, Tangents::Any)?;
        let (computed, cast) = BUNNY.precompute((&scene.bunny, &vertices), &engine, progress)?;
        clock.rays("rays of the bunny's transfer", &geforce, cast);
        progress("clusters of the bunny", 0, 1);
        let (bunny, bunny_light) = (BUNNY.model(vertices, computed), by_bunny.harmonics(BUNNY.order)?);
        progress("links of the statue", 0, 1);
        let atlas = Atlas::new(&scene.statue, SIDE).map_err(no_atlas)?;
        let links = LinkChoice::Fixed { level: SIDE.ilog2() - 2 };
        let statue = MarbleModel::new(&atlas, MM_PER_UNIT, links, true)?;
        progress("shadows of the statue", 0, 1);
        let mut caster = engine.open_judged(&scene.statue, Sides::Both)?;
        let beams = environment::sources(&by_statue, SHADOW_GROUP);
        let irradiance = distant_irradiance(&atlas, &beams, statue.eta, &mut caster).map_err(InputError::from)?;
        clock.rays("shadow rays of the statue", &geforce, caster.record());

        progress("pictures", 0, 1);
        let view = MeshView { camera, exposure, format: TexelFormat::Bgra8 };
        let maps = PrtCardOptions { map_format: TexelFormat::Rgba16Snorm, ..PrtCardOptions::default() };
        let (glossy, time) = bunny.draw(&bunny_light, (&radeon, &executor), &view, &maps)?;
        clock.step("the bunny", &radeon, "a frame".to_owned(), time);
        let floats = MeshView { format: TexelFormat::Rgba32f, ..view };
        let (marble, time) =
            statue.draw(|card| card.irradiate(&irradiance), (&geforce, &executor), floats, FloatTexels::Fp16)?;
        clock.step("the statue", &geforce, "light and a frame".to_owned(), time);
        let mut colors = light::picture(&patches, &radiosity, (&geforce, &executor), &camera, exposure)?;
        for (mesh, drawn) in [(&scene.bunny, glossy), (&scene.statue, marble)] {
            let seen = seen_pixels(&geforce, (mesh.positions(), mesh.triangles()), &camera)?;
            let shown = colors.iter_mut().zip(drawn).zip(&seen).filter(|(_, seen)| seen.is_some());
            shown.for_each(|((color, drawn), _)| *color = drawn);
        }

        let subject = FormatSubject {
            scene: &scene,
            patches: &patches,
            bunny: (&bunny, &bunny_light),
            statue: (&statue, &irradiance),
            view: floats,
        };
        let rows = subject.rows(&executor, progress)?;
        let mut found = Findings::new("One room through four systems");
        clock.conclude(&mut found);
        formats::conclude(&rows, &mut found);
        let room = linear_picture(&camera, &colors).display(1.0)?;
        found.pictures(vec![NamedPicture::new("room", room, ROOM)]);
        ABOUT.into_iter().for_each(|step| found.paragraph(step));
        found.heading("Light at the models");
        let probe = |name: &str, what: &str, light: &CubeLight| light_picture(name, what, of_texels(light.texels()));
        found.pictures(vec![
            probe("bunny-light", "at the bunny", &by_bunny)?,
            probe("statue-light", "at the statue", &by_statue)?,
        ]);
        clock.report(&mut found)?;
        formats::report(&rows, &mut found);
        Ok(found)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.extend([RADEON, GEFORCE].map(str::to_owned));
        provenance
    }
}

const ROOM: &str = "Matrix radiosity lights the room, clustered principal components light the bunny, and subsurface \
    scattering lights the statue. A Radeon 9700 draws the bunny; a GeForce FX 5900 Ultra draws the room and the \
    statue.";

const ABOUT: [&str; 4] = [
    "1. The Ray Engine on a GeForce FX 5900 Ultra casts the rays between the room's patches, and the card solves for radiosity. \
    Coarse bodies replace the models in the room: they reflect light and cast shadows.",
    "2. At each model, a probe casts rays to find the visible patch in each direction.",
    "3. The bunny's transfer, computed with rays too, turns the light of its probe into a picture of a glossy surface, on a Radeon 9700.",
    "4. The statue, a marble suit of armor, scatters its probe's light below the surface.",
];
