//! A picture held against one by rays, and its error told apart by causes: the pictures between, each with one thing
//! more done as transfer does it.

use glam::DMat3;
use rayon::prelude::*;

use super::error::BiScaleError;
use super::light::LocalLight;
use super::subject::BiScaleRendering;
use super::surface::SurfacePixel;
use crate::geom::exact::Sides;
use crate::prt::all_frequency::light::CubeLight;
use crate::prt::all_frequency::visibility::VisibilitySampling;
use crate::prt::bi_scale::shade::{TracedLight, TracedPoint, TracedRung, TracedScene, reference};
use crate::prt::file::BiScaleMeaning;
use crate::prt::transfer::ray_length;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table, false_color};
use crate::study::ProgressFn;
use crate::study::prt::linear_picture;
use crate::tracer::HostTracer;

/// Pixels between two signs of progress.
const BLOCK: usize = 256;

/// The pictures of all rungs, of which the last is that of transfer.
type Pictures = Vec<Vec<[f64; 3]>>;

/// What tells the errors of a rendering apart.
pub(super) struct Causes<'a> {
    rendering: &'a BiScaleRendering,
    tracer: HostTracer,
    sampling: VisibilitySampling,
    fine: Vec<[f64; 3]>,
}

impl<'a> Causes<'a> {
    pub(super) fn new(rendering: &'a BiScaleRendering, meaning: &BiScaleMeaning) -> Result<Self, BiScaleError> {
        let bits = match (&rendering.file.matrix, &rendering.file.biclusters) {
            (Some(matrix), _) => matrix.fraction_bits(),
            (None, Some(biclusters)) => biclusters.fraction_bits(),
            (None, None) => return Err(BiScaleError::NoTransfer),
        };
        let sampling = VisibilitySampling { log2_samples: (bits / 2).min(2), horizon: meaning.horizon };
        let tracer = HostTracer::new(&rendering.surface.mesh, Sides::Both);
        Ok(Self { rendering, tracer, sampling, fine: rendering.light.fine(&DMat3::IDENTITY)? })
    }

    /// Adds what is found; `drawn` is the picture of transfer.
    pub(super) fn find(
        &self,
        pixels: &[Option<SurfacePixel>],
        (cube, drawn): (&CubeLight, &[[f64; 3]]),
        exposure: f64,
        found: &mut Findings,
        progress: &mut ProgressFn<'_>,
    ) -> Result<(), BiScaleError> {
        let mut pictures = self.rungs(pixels, cube, progress);
        let mut names = self.names();
        // A matrix alone is drawn in f64 as it is.
        if self.rendering.file.biclusters.is_some()
            && let Some(local) = LocalLight::exact(&self.rendering.file, cube)
        {
            pictures.push(self.by_reference(pixels, &local));
            names.push(("precision", "biclusters in single precision".to_owned()));
        }
        pictures.push(drawn.to_vec());
        report(self.rendering, &pictures, &names, exposure, found)
    }

    fn names(&self) -> Vec<(&'static str, String)> {
        let along = 1 << self.sampling.log2_samples;
        let lights = self.rendering.textures.first().map_or(0, |texture| texture.samples.light().directions().len());
        vec![
            ("light", "light of 6 x 32 x 32 texels".to_owned()),
            ("visibility", format!("visibility of {along} x {along} directions a texel")),
            ("directions", format!("{lights} local directions")),
            ("texture", "texels and views of the texture".to_owned()),
            ("interpolation", "interpolation over vertices".to_owned()),
        ]
    }

    fn rungs(&self, pixels: &[Option<SurfacePixel>], cube: &CubeLight, progress: &mut ProgressFn<'_>) -> Pictures {
        let surface = &self.rendering.surface;
        let scene =
            TracedScene { tracer: &self.tracer, length: ray_length(&surface.vertices), sampling: self.sampling };
        let light = TracedLight { fine: &self.fine, texels: cube.texels() };
        let of_pixel = |pixel: &Option<SurfacePixel>| {
            let rungs = pixel.as_ref().and_then(|pixel| {
                let texture = &self.rendering.textures[pixel.texture];
                let corners = surface.mesh.corners(pixel.triangle)?;
                let point = TracedPoint::new(corners, pixel.shaded.weights, pixel.frame)?;
                let patch = texture.patch.as_ref()?;
                Some(scene.rungs(&point, &pixel.shaded, (patch, &texture.samples), light))
            });
            rungs.unwrap_or_default()
        };
        let mut all = Vec::with_capacity(pixels.len());
        for block in pixels.chunks(BLOCK) {
            progress("pixels by rays", all.len() as u64, pixels.len() as u64);
            all.extend(block.par_iter().map(of_pixel).collect::<Vec<_>>());
        }
        TracedRung::ALL.iter().map(|&rung| all.iter().map(|rungs| rungs[rung as usize]).collect()).collect()
    }

    /// Equation 3 by plain loops.
    fn by_reference(&self, pixels: &[Option<SurfacePixel>], local: &LocalLight) -> Vec<[f64; 3]> {
        let color = |pixel: &Option<SurfacePixel>| {
            pixel.as_ref().map_or([0.0; 3], |pixel| {
                reference::radiance(&self.rendering.textures[pixel.texture].samples, &local.rows, &pixel.shaded)
            })
        };
        pixels.par_iter().map(color).collect()
    }
}

/// The squares of all channels' differences, and the largest.
fn apart(one: &[[f64; 3]], other: &[[f64; 3]]) -> (f64, f64) {
    one.iter()
        .flatten()
        .zip(other.iter().flatten())
        .fold((0.0, 0.0_f64), |(sum, most), (a, b)| (sum + (a - b) * (a - b), most.max((a - b).abs())))
}

fn report(
    rendering: &BiScaleRendering,
    pictures: &Pictures,
    names: &[(&'static str, String)],
    exposure: f64,
    found: &mut Findings,
) -> Result<(), BiScaleError> {
    let (exact, drawn) = (&pictures[0], &pictures[pictures.len() - 1]);
    let squares = apart(exact, &vec![[0.0; 3]; exact.len()]).0;
    let share = |sum: f64| if squares > 0.0 { 100.0 * (sum / squares).sqrt() } else { 0.0 };
    let mut table = Table::new(
        "Error by cause, of the root mean square of the picture by rays",
        &["cause", "alone (%)", "up to here (%)", "largest (radiance)"],
    );
    let width = rendering.camera.width();
    let mean = |color: &[f64; 3]| color.iter().sum::<f64>() / 3.0;
    let signed = |before: &[[f64; 3]], after: &[[f64; 3]]| -> Vec<f64> {
        after.iter().zip(before).map(|(a, b)| mean(a) - mean(b)).collect()
    };
    let scale = signed(exact, drawn).iter().fold(0.0_f64, |most, value| most.max(value.abs())).max(1e-30);
    let shown_scale = shown(scale, Quantity::Measured);
    let mut differences = Vec::new();
    for ((step, after), name) in pictures.windows(2).zip(&pictures[1..]).zip(names) {
        let (alone, largest) = apart(&step[0], after);
        let (so_far, _) = apart(exact, after);
        table.push([
            name.1.as_str().into(),
            Cell::measured(share(alone)),
            Cell::measured(share(so_far)),
            Cell::measured(largest),
        ]);
        let caption = format!("{}: what it changes; blue -{shown_scale}, white 0, red +{shown_scale}", name.1);
        let image = false_color::signed(width, &signed(&step[0], after), scale);
        differences.push(NamedPicture::new(format!("cause-{}", name.0), image, caption));
    }
    found.heading("Against a picture by rays");
    let by_rays = linear_picture(&rendering.camera, exact);
    let image = by_rays.display(exposure)?;
    found.keep_layers("reference", by_rays);
    let caption = format!("transfer less rays: blue -{shown_scale}, white 0, red +{shown_scale}");
    let whole = false_color::signed(width, &signed(exact, drawn), scale);
    found.pictures(vec![
        NamedPicture::new("reference", image, "by rays, every pixel for itself"),
        NamedPicture::new("difference", whole, caption),
    ]);
    found.table(FoundTable::from(table).csv("causes").field("causes"));
    found.pictures(differences);
    found.conclusion(format!(
        "Against a picture by rays the root mean square error is {} %.",
        shown(share(apart(exact, drawn).0), Quantity::Measured)
    ));
    Ok(())
}
