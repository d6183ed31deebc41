//! Pictures are bit-identical for every number of threads, bundle size and caster.

use crate::support::{in_threads, profile};
use crossbar::geom::exact::Sides;
use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
use crossbar::renderer::photon::Photons;
use crossbar::renderer::{Lens, RenderedPicture, Settings, distributed, eye, path, photon, whitted};
use crossbar::scene::{Camera, PointLight, Scene, Surface};
use crossbar::tracer::Caster;
use refsim::machine::ExecutorKind;

use super::{host, of, room, room_camera, settings};

type Render = fn(&Scene, &Camera, &Settings, &mut dyn Caster) -> RenderedPicture;

const RENDERERS: [(&str, Render); 5] = [
    ("eye", |scene, camera, settings, caster| {
        eye::render(scene, camera, settings, caster, &mut |_| {}).expect("a picture")
    }),
    ("whitted", |scene, camera, settings, caster| {
        whitted::render(scene, camera, settings, caster, &mut |_| {}).expect("a picture")
    }),
    ("distributed", |scene, camera, settings, caster| {
        distributed::render(scene, camera, settings, caster, &mut |_| {}).expect("a picture")
    }),
    ("path", |scene, camera, settings, caster| {
        path::render(scene, camera, settings, path::Direct::Both, caster, &mut |_| {}).expect("a picture")
    }),
    ("photon", |scene, camera, settings, caster| {
        let photons = Photons { global: 500, caustic: 500, nearest: 10, radius: 0.4, gather: 3 };
        photon::render(scene, camera, settings, &photons, caster, &mut |_| {}).expect("a picture")
    }),
];

fn scene() -> Scene {
    let mut scene = room(0.5, &of(Surface::Glass { index: 1.5, transmittance: [0.9, 1.0, 0.9] }));
    scene.point_lights.push(PointLight { position: [0.3, -0.2, 1.8], intensity: [1.0; 3] });
    scene
}

fn usual() -> Settings {
    Settings { samples: 3, lens: Some(Lens { radius: 0.02, focus: 1.2 }), ..settings() }
}

/// The parts of a picture that must not change; the number of bundles may change.
fn essence(mut picture: RenderedPicture) -> RenderedPicture {
    picture.counts.bundles = 0;
    picture
}

#[test]
fn bundles_threads_and_casters_do_not_show() {
    let (scene, camera) = (scene(), room_camera(9, 7));
    for (name, render) in RENDERERS {
        let expected = essence(render(&scene, &camera, &usual(), &mut host(&scene)));
        assert!(expected.color.iter().any(|color| color[0] > 0.0), "{name} sees something");
        for bundle in [1, 13, 200] {
            let settings = Settings { bundle, ..usual() };
            let found = essence(render(&scene, &camera, &settings, &mut host(&scene)));
            assert!(found == expected, "{name}, bundles of {bundle}");
        }
        for threads in [1, 3] {
            let found = in_threads(threads, || essence(render(&scene, &camera, &usual(), &mut host(&scene))));
            assert!(found == expected, "{name}, {threads} threads");
        }
        let parameters = EngineParameters { sides: Sides::Both, rays: 16, ..EngineParameters::default() };
        let mut engine =
            RayEngine::new(scene.mesh(), profile("ideal-fp32"), ExecutorKind::Batch, parameters).expect("an engine");
        let found = essence(render(&scene, &camera, &usual(), &mut engine));
        assert!(found == expected, "{name} by the engine");
        assert_eq!(engine.counts().rays, found.counts.rays());
        assert!(engine.counts().rays_on_card > 0, "{name}: {:?}", engine.counts());
    }
}
