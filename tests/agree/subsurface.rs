//! The three passes of system 3: identical bits on every executor.

use crate::environment::is_full;
use crossbar::atlas::Atlas;
use crossbar::card::{MeshView, Texels};
use crossbar::geom::Mesh;
use crossbar::scene::Camera;
use crossbar::subsurface::kernels::ViewKernel;
use crossbar::subsurface::on_card::{
    CardModel, FloatTexels, Light, LightStage, LinkTextures, MapFormat, SubsurfaceCard, SubsurfaceCardOptions, View,
};
use refsim::texture::TexelFormat;

use crate::random::Random;
use crate::system::{bits, executors, nv35};

const SIDE: u32 = 16;

/// An irregular octahedron.
fn model() -> CardModel {
    let corners =
        vec![[1.0, 0.0, 0.0], [-1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.2, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -0.8]];
    let faces = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let mesh = Mesh::new(corners, faces).expect("a mesh");
    CardModel::new(&Atlas::new(&mesh, SIDE).expect("an atlas"))
}

fn random_texels(random: &mut Random, texel: impl Fn(&mut Random) -> [f32; 4]) -> Texels {
    let side = SIDE as usize;
    Texels { width: side, height: side, texels: (0..side * side).map(|_| texel(random)).collect() }
}

/// Random factor: 0 with a probability of 1/16, otherwise a number in [0, 1/8).
fn factor(random: &mut Random) -> f32 {
    if random.below(16) == 0 { 0.0 } else { random.below(1 << 16) as f32 / (1 << 19) as f32 }
}

/// Links with random factors, and random clusters if `level` is `None`.
fn links(level: Option<u32>, rgb: bool, count: usize) -> LinkTextures {
    let mut random = Random::named("subsurface", count as u64);
    let four = |r: &mut Random| [factor(r), factor(r), factor(r), factor(r)];
    let textures = match (level, rgb) {
        (Some(_), rgb) => {
            (0..count.div_ceil(4) * if rgb { 3 } else { 1 }).map(|_| random_texels(&mut random, four)).collect()
        }
        (None, rgb) => (0..count)
            .flat_map(|_| {
                let link = random_texels(&mut random, |r| {
                    let level = r.below(5) as u32;
                    let width = SIDE >> level;
                    let place = |r: &mut Random| (r.below(width as usize) as f32 + 0.5) / width as f32;
                    [place(r), place(r), factor(r), level as f32]
                });
                [Some(link), rgb.then(|| random_texels(&mut random, four))].into_iter().flatten()
            })
            .collect(),
    };
    LinkTextures::from_textures(SIDE, level, rgb, count, textures).expect("links")
}

fn lights() -> Vec<Light> {
    vec![
        Light::Sky { radiance: [0.05, 0.06, 0.07] },
        Light::Directional { towards: [1.0, 2.0, 3.0], irradiance: [0.5, 0.4, 0.3] },
        Light::Point { position: [-2.0, 1.0, 0.5], intensity: [0.6, 0.7, 0.8], attenuation: [0.1, 0.2, 0.3] },
    ]
}

fn view(kernel: ViewKernel, format: TexelFormat) -> View {
    let camera = Camera::new([2.5, -3.0, 1.5], [0.0; 3], [0.0, 0.0, 1.0], 0.4, 33, 27).expect("a camera");
    let scattered = View::scattered(MeshView { camera, exposure: 1.5, format });
    View { kernel, diffuse: [0.5, 0.4, 0.3], specular: [0.2; 3], shininess: 12.0, ..scattered }
}

/// Compares maps and pictures of every executor with the scalar executor's. By default a GPU draws one case in five;
/// these cases cover every option that the tests vary.
fn agrees(
    case: usize,
    name: &str,
    links: &LinkTextures,
    options: SubsurfaceCardOptions,
    views: &[View],
    lights: &[Light],
) {
    let model = model();
    let mut reference: Option<Vec<Vec<[u32; 4]>>> = None;
    let on_gpu = case.is_multiple_of(5) || is_full();
    for (executor, how) in executors().into_iter().filter(|(executor, _)| on_gpu || *executor != "wgpu") {
        let what = format!("{name}, {executor}");
        let mut card = SubsurfaceCard::new(nv35(), how, model.clone(), links, 1.3, options)
            .unwrap_or_else(|e| panic!("{what}: {e}"));
        card.light(lights).unwrap_or_else(|e| panic!("{what}: {e}"));
        let levels = card.read_levels().unwrap_or_else(|e| panic!("{what}: {e}"));
        let scattered = card.read_scattered().unwrap_or_else(|e| panic!("{what}: {e}"));
        assert!(scattered.texels.iter().any(|texel| texel[0] > 0.0), "{name}: dark");
        let mut seen: Vec<Vec<[u32; 4]>> = levels.iter().chain([&scattered]).map(bits).collect();
        for view in views {
            let picture = card.view_texels(view).unwrap_or_else(|e| panic!("{what}: {e}"));
            assert!(picture.texels.iter().any(|texel| texel[..3] != [0.0; 3]), "{name}: a black picture");
            seen.push(bits(&picture));
        }
        assert!(reference.get_or_insert_with(|| seen.clone()) == &seen, "{name}: {executor} differs");
    }
}

const MAPS: [MapFormat; 3] = [MapFormat::Unorm8 { scale: 0.75 }, MapFormat::Fp16, MapFormat::Fp32];

#[test]
fn fixed_links_are_the_same_everywhere() {
    let mut case = 0;
    for (level, count) in [(2, 16), (1, 64), (4, 1)] {
        for rgb in [false, true] {
            let links = links(Some(level), rgb, count);
            for map in MAPS {
                for half in [false, true] {
                    let scattered = if half { FloatTexels::Fp16 } else { FloatTexels::Fp32 };
                    let options = SubsurfaceCardOptions { map, half, scattered, ..SubsurfaceCardOptions::default() };
                    let name = format!("{count} fixed links, rgb {rgb}, {map:?}, half {half}");
                    agrees(case, &name, &links, options, &[], &lights());
                    case += 1;
                }
            }
        }
    }
}

#[test]
fn adaptive_links_are_the_same_everywhere() {
    let mut case = 0;
    for count in [1, 16, 31] {
        for rgb in [false, true] {
            let links = links(None, rgb, count);
            for map in MAPS {
                for half in [false, true] {
                    let format = if half { FloatTexels::Fp16 } else { FloatTexels::Fp32 };
                    let options = SubsurfaceCardOptions {
                        map,
                        half,
                        links: format,
                        scattered: FloatTexels::Fp16,
                        ..SubsurfaceCardOptions::default()
                    };
                    let name = format!("{count} adaptive links, rgb {rgb}, {map:?}, half {half}");
                    agrees(case, &name, &links, options, &[], &lights());
                    case += 1;
                    if count == 16 && !half {
                        let tiled = SubsurfaceCardOptions { tiles: Some(4), ..options };
                        agrees(case, &format!("{name}, as tiles"), &links, tiled, &[], &lights());
                    }
                }
            }
        }
    }
}

/// More lights than a pass accepts: per vertex and per texel, in every map.
#[test]
fn many_lights_are_the_same_everywhere() {
    let links = links(Some(2), false, 16);
    let mut many = lights();
    for n in 0..29 {
        let towards = [(n % 3) as f64 - 1.0, (n % 5) as f64 - 2.0, 1.0];
        many.push(Light::Directional { towards, irradiance: [0.01, 0.02, 0.005 * n as f64] });
    }
    for (stage, light) in [LightStage::Vertices, LightStage::Texels].into_iter().enumerate() {
        for (at, map) in MAPS.into_iter().enumerate() {
            let options = SubsurfaceCardOptions { light, map, ..SubsurfaceCardOptions::default() };
            agrees(3 * stage + at, &format!("30 lights, {light:?}, {map:?}"), &links, options, &[], &many);
        }
    }
}

#[test]
fn every_view_is_the_same_everywhere() {
    let links = links(Some(2), true, 16);
    let views: Vec<View> = ViewKernel::all()
        .into_iter()
        .zip([TexelFormat::Rgba32f, TexelFormat::Rgba16f, TexelFormat::Bgra8].into_iter().cycle())
        .map(|(kernel, format)| view(kernel, format))
        .collect();
    assert_eq!(views.len(), 9);
    for light in [LightStage::Vertices, LightStage::Texels] {
        let options = SubsurfaceCardOptions { light, scattered: FloatTexels::Fp16, ..SubsurfaceCardOptions::default() };
        agrees(0, &format!("views, {light:?}"), &links, options, &views, &lights());
    }
}
