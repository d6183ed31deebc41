//! Compares passes 1 and 2 on a card with the formulas of section 4, in f64.

use crate::support::profile;
use crossbar::atlas::Atlas;
use crossbar::card::Texels;
use crossbar::geom::Mesh;
use crossbar::subsurface::fresnel::mean_transmittance;
use crossbar::subsurface::links::{IrradianceMeans, LinkChoice, Links, MeanWeighting};
use crossbar::subsurface::multipole::SurfaceMoments;
use crossbar::subsurface::on_card::{
    CardModel, Light, LightStage, LinkTextures, MapFormat, PassEvent, PassKind, SubsurfaceCard, SubsurfaceCardOptions,
    pass_times,
};
use crossbar::subsurface::{Coefficients, Dipole, fresnel_transmittance};
use glam::DVec3;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::timing::Picoseconds;
use std::f64::consts::PI;

pub(super) const SIDE: u32 = 16;
pub(super) const ETA: f64 = 1.3;

pub(super) fn nv35() -> Profile {
    profile("nv35")
}

/// A cube around 0 with edges of `size`: 12 faces with flat normals.
pub(super) fn cube(size: f32) -> Mesh {
    let (mut positions, mut normals, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    for axis in 0..3 {
        for sign in [-1.0_f32, 1.0] {
            let first = positions.len() as u32;
            for [u, v] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
                let mut position = [0.0; 3];
                position[axis] = sign * size / 2.0;
                position[(axis + 1) % 3] = sign * u * size / 2.0;
                position[(axis + 2) % 3] = v * size / 2.0;
                let mut normal = [0.0; 3];
                normal[axis] = sign;
                positions.push(position);
                normals.push(normal);
            }
            faces.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    Mesh::new(positions, faces).and_then(|mesh| mesh.with_normals(normals)).expect("a cube")
}

pub(super) fn atlas(size: f32) -> Atlas {
    Atlas::new(&cube(size), SIDE).expect("an atlas")
}

/// A link of every texel to itself, with the factor 1: pass 2 writes the map.
pub(super) fn to_itself() -> LinkTextures {
    let place = |at: usize| (at as f32 + 0.5) / SIDE as f32;
    let link = Texels::from_fn([SIDE as usize; 2], |x, y| [place(x), place(y), 1.0, 0.0]);
    LinkTextures::from_textures(SIDE, None, false, 1, vec![link]).expect("links")
}

pub(super) fn card(atlas: &Atlas, links: &LinkTextures, options: SubsurfaceCardOptions) -> SubsurfaceCard {
    SubsurfaceCard::new(nv35(), ExecutorKind::Batch, CardModel::new(atlas), links, ETA, options).expect("a card")
}

pub(super) fn lights() -> [Light; 3] {
    [
        Light::Sky { radiance: [0.05, 0.06, 0.07] },
        Light::Directional { towards: [1.0, 2.0, 3.0], irradiance: [0.5, 0.4, 0.3] },
        Light::Point { position: [-2.0, 1.5, 0.5], intensity: [0.6, 0.7, 0.8], attenuation: [0.1, 0.2, 0.3] },
    ]
}

/// Color, direction and attenuation of the light that reaches a point; `None` for a sky.
pub(super) fn arriving(light: &Light, point: DVec3) -> Option<([f64; 3], DVec3, f64)> {
    match *light {
        Light::Sky { .. } => None,
        Light::Directional { towards, irradiance } => Some((irradiance, DVec3::from(towards).normalize(), 1.0)),
        Light::Point { position, intensity, attenuation: [k0, k1, k2] } => {
            let to = DVec3::from(position) - point;
            let d = to.length();
            Some((intensity, to / d, 1.0 / (k0 + k1 * d + k2 * d * d)))
        }
    }
}

/// Irradiance at a point by equation 8.
fn irradiance(lights: &[Light], point: DVec3, normal: DVec3) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for light in lights {
        let (color, factor) = match (light, arriving(light, point)) {
            (Light::Sky { radiance }, _) => (*radiance, PI * mean_transmittance(ETA)),
            (_, found) => {
                let (color, to, attenuation) = found.expect("a direction");
                let cosine = to.dot(normal).max(0.0);
                (color, cosine * fresnel_transmittance(ETA, cosine) * attenuation)
            }
        };
        sum.iter_mut().zip(color).for_each(|(sum, color)| *sum += color * factor);
    }
    sum
}

/// Reads the map of a card and removes area factors and scale.
fn irradiances(card: &SubsurfaceCard, atlas: &Atlas) -> Vec<[f64; 3]> {
    let map = card.read_levels().expect("levels").swap_remove(0);
    let texel = |(texel, part): (&[f32; 4], &crossbar::atlas::Texel)| {
        let factor = part.area / atlas.mean_texel_area() * card.options().map.scale();
        [0, 1, 2].map(|channel| f64::from(texel[channel]) / factor)
    };
    map.texels.iter().zip(atlas.texels()).map(texel).collect()
}

fn largest(values: &[[f64; 3]]) -> f64 {
    values.iter().flatten().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// The largest difference, relative to the largest value.
fn difference(found: &[[f64; 3]], wanted: &[[f64; 3]]) -> f64 {
    let differences: Vec<[f64; 3]> =
        found.iter().zip(wanted).map(|(found, wanted)| [0, 1, 2].map(|c| found[c] - wanted[c])).collect();
    largest(&differences) / largest(wanted)
}

/// Error bound for some 30 roundings to fp32 per light.
const ROUNDINGS: f64 = 64.0 / (1 << 24) as f64;

fn options(light: LightStage) -> SubsurfaceCardOptions {
    SubsurfaceCardOptions { light, ..SubsurfaceCardOptions::default() }
}

#[test]
fn irradiance_by_texel_is_equation_8() {
    let atlas = atlas(2.0);
    let mut card = card(&atlas, &to_itself(), options(LightStage::Texels));
    let mut many = lights().to_vec();
    for n in 0..40 {
        many.push(Light::Directional {
            towards: [f64::from(n % 7) - 3.0, f64::from(n % 5) - 2.0, 1.0],
            irradiance: [0.01; 3],
        });
    }
    for lights in [&lights()[..], &lights()[..1], &[], &many] {
        card.light(lights).expect("light");
        let wanted: Vec<[f64; 3]> =
            atlas.texels().iter().map(|texel| irradiance(lights, texel.point, texel.normal)).collect();
        let found = irradiances(&card, &atlas);
        if lights.is_empty() {
            assert_eq!(largest(&found), 0.0);
        } else {
            let difference = difference(&found, &wanted);
            assert!(difference <= ROUNDINGS, "{} lights: {difference}", lights.len());
        }
    }
}

/// Parallel light is constant over a flat face. Light from a point at distance D varies by some (h / D)^2 over a face
/// of extent h: the second derivative of c T(c) / d^2 is below 12 / D^2, and linear interpolation has an error of at
/// most h^2 / 8 times it along each of two directions.
#[test]
fn by_vertex_is_by_texel_on_flat_faces() {
    let atlas = atlas(2.0);
    let [mut vertices, mut texels] =
        [LightStage::Vertices, LightStage::Texels].map(|light| card(&atlas, &to_itself(), options(light)));
    let (far, extent) = (100.0, 8.0_f64.sqrt());
    let parallel = lights()[..2].to_vec();
    let point =
        vec![Light::Point { position: [far, 0.6 * far, 0.3 * far], intensity: [1e4; 3], attenuation: [0.0, 0.0, 1.0] }];
    for (lights, bound) in [(parallel, ROUNDINGS), (point, ROUNDINGS + 3.0 * (extent / far) * (extent / far))] {
        vertices.light(&lights).expect("light");
        texels.light(&lights).expect("light");
        let [by_vertex, by_texel] = [&vertices, &texels].map(|card| irradiances(card, &atlas));
        let difference = difference(&by_vertex, &by_texel);
        assert!(difference <= bound, "{difference} above {bound}");
    }
}

#[test]
fn a_table_of_irradiances_reaches_each_texel() {
    let atlas = atlas(2.0);
    let table: Vec<[f64; 3]> = (0..SIDE * SIDE).map(|k| [0.5 + f64::from(k), 1.0, 0.25 * f64::from(k)]).collect();
    let mut card = card(&atlas, &to_itself(), options(LightStage::Vertices));
    card.irradiate(&table).expect("irradiances");
    assert!(difference(&irradiances(&card, &atlas), &table) <= 2.0 / (1 << 24) as f64);
    assert!(card.irradiate(&table[1..]).is_err() && card.irradiate(&[[f64::NAN; 3]; 256]).is_err());
}

/// Compares passes 1 and 2 with real links with the gather in f64 from the card's irradiances.
#[test]
fn the_card_gathers_as_the_host_does() {
    let atlas = atlas(2.0);
    let surface = SurfaceMoments::new(&atlas, 10.0).expect("moments");
    let dipole = |sigma_s_prime| Dipole::new(Coefficients { sigma_s_prime, sigma_a: 0.0012 }, ETA).expect("a dipole");
    for (dipoles, choice) in [
        (vec![dipole(2.21)], LinkChoice::Fixed { level: 2 }),
        (vec![dipole(1.0), dipole(2.0), dipole(3.0)], LinkChoice::Fixed { level: 2 }),
        (vec![dipole(2.21)], LinkChoice::Adaptive { count: 16 }),
        (vec![dipole(1.0), dipole(2.0), dipole(3.0)], LinkChoice::Adaptive { count: 16 }),
    ] {
        let links = Links::new(&surface, &dipoles, choice, 1e-3).expect("links");
        let textures = LinkTextures::new(&links, &surface, MeanWeighting::Area);
        for map in [MapFormat::Fp32, MapFormat::Fp16, MapFormat::Unorm8 { scale: 1.0 }] {
            let mut card = card(&atlas, &textures, SubsurfaceCardOptions { map, ..options(LightStage::Vertices) });
            card.light(&lights()).expect("light");
            let means =
                IrradianceMeans::new(&surface, &irradiances(&card, &atlas), MeanWeighting::Area).expect("means");
            let wanted = links.gather(&means);
            let found: Vec<[f64; 3]> = card
                .read_scattered()
                .expect("a map")
                .texels
                .iter()
                .map(|texel| [0, 1, 2].map(|channel| f64::from(texel[channel])))
                .collect();
            // Each of four levels rounds, and so does every link of the gather in fp32.
            let bound = match map {
                MapFormat::Fp32 => ROUNDINGS,
                MapFormat::Fp16 => 4.0 / 2048.0 + ROUNDINGS,
                MapFormat::Unorm8 { .. } => {
                    let ones = vec![[1.0; 3]; atlas.texels().len()];
                    let means = IrradianceMeans::new(&surface, &ones, MeanWeighting::Area).expect("means");
                    4.0 * 0.5 / 255.0 * largest(&links.gather(&means)) / largest(&wanted)
                }
            };
            let difference = difference(&found, &wanted);
            assert!(difference <= bound, "{choice:?}, {map:?}: {difference} above {bound}");
            assert_eq!(card.saturated().expect("a count"), 0, "{map:?}");
        }
    }
}

#[test]
fn what_does_not_fit_8_bits_is_cut_off_and_counted() {
    let atlas = atlas(2.0);
    let options = SubsurfaceCardOptions { map: MapFormat::Unorm8 { scale: 4.0 }, ..options(LightStage::Texels) };
    let mut card = card(&atlas, &to_itself(), options);
    card.light(&[Light::Directional { towards: [0.0, 0.0, 1.0], irradiance: [1.0, 0.1, 0.0] }]).expect("light");
    let lit = atlas.texels().iter().filter(|texel| texel.normal.z > 0.5).count();
    assert_eq!(card.saturated().expect("a count"), lit);
    let scattered = card.read_scattered().expect("a map");
    assert!(scattered.texels.iter().all(|texel| texel[0] == 0.0 || texel[0] == 0.25), "1 of the map is 1/4");
}

/// Results do not depend on the unit of length: identical bits for a model and its lights scaled by 2^60 or 2^-60.
#[test]
fn the_unit_of_length_does_not_matter() {
    let maps = |size: f64| {
        let lights = lights().map(|light| match light {
            Light::Point { position, intensity, attenuation: [k0, k1, k2] } => {
                let attenuation = [k0, k1 / size, k2 / size / size];
                Light::Point { position: position.map(|x| x * size), intensity, attenuation }
            }
            other => other,
        });
        [LightStage::Vertices, LightStage::Texels].map(|light| {
            let mut card = card(&atlas(2.0 * size as f32), &to_itself(), options(light));
            card.light(&lights).expect("light");
            card.read_scattered().expect("a map")
        })
    };
    let (wanted, large) = (maps(1.0), (1_u64 << 60) as f64);
    assert!(maps(large) == wanted && maps(1.0 / large) == wanted);
}

#[test]
fn a_light_on_the_surface_makes_no_infinity() {
    let atlas = atlas(2.0);
    let points = atlas.texels().iter().step_by(37).map(|texel| texel.point).chain([DVec3::ONE, DVec3::ZERO]);
    for light in [LightStage::Vertices, LightStage::Texels] {
        let mut card = card(&atlas, &to_itself(), options(light));
        for point in points.clone() {
            let attenuation = [0.0, 0.0, 1.0];
            card.light(&[Light::Point { position: point.into(), intensity: [1.0; 3], attenuation }]).expect("light");
            let map = card.read_scattered().expect("a map");
            assert!(map.texels.iter().flatten().all(|value| value.is_finite() && *value >= 0.0), "{point}");
        }
    }
}

fn draws(log: &[PassEvent], pass: PassKind) -> usize {
    log.iter().filter(|event| event.pass == pass && matches!(event.event, Event::Draw(_))).count()
}

#[test]
fn a_new_light_redoes_two_passes_and_uploads_no_link() {
    let atlas = atlas(2.0);
    let zero = Texels::from_fn([SIDE as usize; 2], |_, _| [0.0; 4]);
    let links = LinkTextures::from_textures(SIDE, Some(2), false, 16, vec![zero; 4]).expect("links");
    for (map, level_draws) in [(MapFormat::Unorm8 { scale: 1.0 }, 0), (MapFormat::Fp16, 4)] {
        let mut card = card(&atlas, &links, SubsurfaceCardOptions { map, ..options(LightStage::Texels) });
        card.light(&lights()).expect("light");
        card.record(true);
        card.light(&lights()[1..]).expect("light");
        let log = card.take_log();
        let counted = PassKind::ALL.map(|pass| draws(&log, pass));
        assert_eq!(counted, [1, level_draws, 1, 0], "{map:?}");
        assert!(!log.iter().any(|event| matches!(event.event, Event::Upload { .. })));
        let times = pass_times(&nv35(), &log).expect("times");
        assert!(times[..3].iter().all(|time| time.time > Picoseconds::ZERO));
        assert_eq!(times[3].time, Picoseconds::ZERO);
        let [program] = card.gather_programs() else { panic!("one pass") };
        assert_eq!((program.instructions(), program.samplers()), (37, 5));
    }
}

#[test]
fn what_does_not_fit_the_card_is_refused() {
    let (atlas, links) = (atlas(2.0), to_itself());
    let new = |profile: Profile, links: &LinkTextures, eta, options| {
        SubsurfaceCard::new(profile, ExecutorKind::Batch, CardModel::new(&atlas), links, eta, options)
    };
    let usual = SubsurfaceCardOptions::default();
    assert!(new(profile("r300"), &links, ETA, usual).is_err(), "it runs no `!!FP1.0`");
    let [mut small, mut starved] = [nv35(), nv35()];
    small.limits.max_texture_size = Some(24);
    starved.limits.samplers = Some(1);
    assert!(new(small.clone(), &links, ETA, usual).is_err(), "the row of levels needs 32x16");
    assert!(new(starved, &links, ETA, usual).is_err(), "no room for a link in a program");
    let leveled = SubsurfaceCardOptions { map: MapFormat::Unorm8 { scale: 1.0 }, ..usual };
    assert!(new(small, &links, ETA, leveled).is_ok(), "the atlas alone fits");
    // Bytes of links, radiosity map, levels, levels side by side, and scattered irradiance.
    let bytes = 4096 + 4096 + 1360 + 8192 + 4096;
    assert_eq!(new(nv35(), &links, ETA, usual).expect("a card").memory()[0], bytes);
    // The range of `crossbar::subsurface::MAX_ETA`, where the polynomial for the internal reflection holds.
    assert!([0.9, 3.5, 1e5].into_iter().all(|eta| new(nv35(), &links, eta, usual).is_err()));
    let unlit = SubsurfaceCardOptions { map: MapFormat::Unorm8 { scale: 0.0 }, ..usual };
    assert!(new(nv35(), &links, ETA, unlit).is_err());
    let other = Texels::from_fn([8; 2], |_, _| [0.0; 4]);
    assert!(LinkTextures::from_textures(8, Some(0), false, 16, vec![other.clone(); 4]).is_err(), "64 links to a level");
    let other = LinkTextures::from_textures(8, Some(1), false, 16, vec![other; 4]).expect("links");
    assert!(new(nv35(), &other, ETA, usual).is_err(), "8 texels along a side");
    let mut card = card(&atlas, &links, options(LightStage::Texels));
    let point = |position, attenuation| Light::Point { position, intensity: [1.0; 3], attenuation };
    for light in [
        Light::Sky { radiance: [1.0, -1.0, 1.0] },
        Light::Directional { towards: [0.0; 3], irradiance: [1.0; 3] },
        Light::Directional { towards: [f64::NAN, 0.0, 1.0], irradiance: [1.0; 3] },
        point([0.0; 3], [0.0; 3]),
        point([0.0; 3], [0.0, -1.0, 2.0]),
        point([1e17, 0.0, 0.0], [1.0; 3]),
        point([f64::NAN; 3], [1.0; 3]),
    ] {
        assert!(card.light(&[lights()[0], light]).is_err(), "{light:?}");
    }
}
