//! Figure 6: flicker of light truncated to a number of coefficients.

use glam::{DMat3, DVec3};

use super::rates::{buddha_without_drawing, seconds_of};
use super::scene::FigureScene;
use super::{EntryFindings, HOST, ModelSize, RunResult, StudyError, models, paragraph, solved};
use crate::all_frequency::Reflectance;
use crate::all_frequency::transfer::{TransferSegment, transfer_of};
use crate::elementary::on_circle;
use crate::geom::random::CounterRng;
use crate::report::{Cell, Table};
use crate::sphere::turn_around_z;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};
use crate::transfer::light::{CubeLight, DiskSource, HaarLight, TruncationPriority};

const SOURCES: u64 = 40;
/// Angular radius of sources in degrees.
const RADIUS: f64 = 3.0;
/// Numbers of coefficients kept.
const KEPT: [usize; 5] = [50, 100, 200, 400, 800];
/// Number of steps of half a degree around z.
const FRAMES: u32 = 6;
/// Threshold of visible flicker, one percent of the picture; we chose it before we computed any flicker.
const SEEN: f64 = 0.01;

const HOW: &str = "Figure 6 shows a diffuse Buddha of {} vertices under {} evenly spread disks with radii of {} degrees and random colors; the light \
    turns by half a degree, {} times. Flicker is the RMS frame-to-frame change of the radiance that truncation removes at vertices, over the RMS of \
    their radiance. Frame rates are modelled for the printed Buddha with its ground, without drawing.";

/// Returns disks on a spiral over the sphere.
fn sources() -> Vec<DiskSource> {
    let random = CounterRng::new(6);
    let source = |at: u64| {
        let z = 1.0 - (2 * at + 1) as f64 / SOURCES as f64;
        // Rotation by multiples of the golden angle.
        let [x, y] = on_circle((at as f64 * 0.381_966_011_250_105).fract());
        let radius = (1.0 - z * z).sqrt();
        let radiance = [0, 1, 2].map(|channel| 1.0 + 9.0 * random.unit(at, 0, channel));
        DiskSource { towards: DVec3::new(radius * x, radius * y, z), radius: RADIUS.to_radians(), radiance }
    };
    (0..SOURCES).map(source).collect()
}

/// Projects the light of the sources to coefficients on six faces.
fn on_faces(turn: &DMat3) -> Result<HaarLight, StudyError> {
    let cube = CubeLight::from_disks(&sources(), turn).on(HOST)?;
    Ok(HaarLight::new(&cube, Segmentation::Faces))
}

fn cut(light: &HaarLight, keep: usize) -> Result<HaarLight, StudyError> {
    let cut = light.truncated(keep, TruncationPriority::Area);
    Ok(cut.light.reprojected(Segmentation::Quarters))
}

/// Radiance of diffuse vertices under a light, over all segments.
fn radiance(segments: &[TransferSegment], vertices: usize, light: &HaarLight) -> Vec<[f64; 3]> {
    let mut all = vec![[0.0; 3]; vertices];
    for part in segments {
        let light = [0, 1, 2].map(|channel| light.segment(channel, part.segment));
        for (point, &vertex) in part.vertices.iter().enumerate() {
            for (sum, light) in all[vertex as usize].iter_mut().zip(light) {
                *sum += part.signal.point(point).iter().zip(light).map(|(&m, l)| f64::from(m) * l).sum::<f64>();
            }
        }
    }
    all
}

/// Sum of squared differences.
fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// Flicker by number of coefficients: the RMS change, between frames, of the radiance that truncation removes at
/// vertices, relative to the RMS of their radiance.
fn flicker(segments: &[TransferSegment], vertices: usize) -> Result<Vec<f64>, StudyError> {
    let mut lost: Vec<Vec<Vec<[f64; 3]>>> = vec![Vec::new(); KEPT.len()];
    let mut squares = 0.0;
    for frame in 0..FRAMES {
        let faces = on_faces(&turn_around_z(f64::from(frame) / 720.0))?;
        let whole = radiance(segments, vertices, &faces.reprojected(Segmentation::Quarters));
        for (keep, lost) in KEPT.into_iter().zip(&mut lost) {
            let few = radiance(segments, vertices, &cut(&faces, keep)?);
            let pairs = whole.iter().zip(&few);
            lost.push(pairs.map(|(whole, few)| [0, 1, 2].map(|c| whole[c] - few[c])).collect());
        }
        if frame > 0 {
            squares += apart(&whole, &vec![[0.0; 3]; vertices]);
        }
    }
    let changes = |lost: &Vec<Vec<[f64; 3]>>| lost.windows(2).map(|two| apart(&two[0], &two[1])).sum::<f64>();
    Ok(lost.iter().map(|lost| (changes(lost) / squares).sqrt()).collect())
}

pub(super) fn figure(size: ModelSize) -> Result<EntryFindings, StudyError> {
    let scene = FigureScene::new(&models::buddha(size), 2, DVec3::new(1.0, -2.0, 0.6))?;
    let transfer = transfer_of(&scene.vertices, &scene.of_model, &scene.hats, &Reflectance::Diffuse);
    let segments: Vec<TransferSegment> = transfer.segments().collect::<Result<_, _>>().on(HOST)?;
    let flicker = flicker(&segments, scene.vertices.len())?;
    let faces = on_faces(&DMat3::IDENTITY)?;
    let (nonzero, energy) = (faces.nonzero(), faces.energy());
    let mut table = Table::of("Figure 6: light coefficients", "kept of_nonzero_% energy_% flicker_% modelled_fps");
    for (at, keep) in KEPT.into_iter().enumerate() {
        let few = cut(&faces, keep)?;
        let steps = buddha_without_drawing(keep.min(nonzero) as f64 / LIGHT_TEXELS as f64);
        table.push([
            keep.into(),
            Cell::percent(100.0 * keep.min(nonzero) as f64 / nonzero as f64),
            Cell::percent(100.0 * few.energy() / energy),
            Cell::measured(100.0 * flicker[at]),
            Cell::measured(1.0 / seconds_of(steps)?),
        ]);
    }
    let needed = KEPT.iter().zip(&flicker).find(|(_, flicker)| **flicker < SEEN);
    let needed = needed.map_or(f64::NAN, |(&keep, _)| keep as f64);
    let share = 100.0 * needed.min(nonzero as f64) / nonzero as f64;
    let rows = [solved("coefficients-of-faces", nonzero as f64)?, solved("without-flicker", share)?];
    let text = paragraph(HOW, &[&scene.of_model.len(), &SOURCES, &RADIUS, &(FRAMES - 1)]);
    Ok(EntryFindings::new([text], rows, [], [table]))
}
