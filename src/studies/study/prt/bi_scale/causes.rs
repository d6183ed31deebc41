//! Compares a picture with a ray-traced one, and divides its error among causes: each picture in between adds one
//! approximation of transfer.

use rayon::prelude::*;

use super::cause_pictures::CausePictures;
use super::light::LocalLight;
use super::subject::BiScaleRendering;
use super::subject::no_mesh_transfer;
use super::surface::SurfacePixel;
use crate::bi_scale::file::BiScaleMeaning;
use crate::bi_scale::paper;
use crate::bi_scale::shade::{TracedLight, TracedPoint, TracedRung, TracedScene};
use crate::geom::exact::Sides;
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, FoundTable, NamedPicture, false_color};
use crate::study::{ProgressFn, StudyError};
use crate::tracer::HostTracer;
use crate::transfer::light::CubeLight;
use crate::transfer::ray_length;
use crate::transfer::visibility::VisibilitySampling;

/// Number of pixels between progress reports.
const BLOCK: usize = 256;

/// The pictures of all steps; the last is the picture from transfer.
type Pictures = Vec<Vec<[f64; 3]>>;

/// Pictures that separate the errors of a rendering by cause.
pub(super) struct Causes<'a> {
    rendering: &'a BiScaleRendering,
    tracer: HostTracer,
    sampling: VisibilitySampling,
    fine: Vec<[f64; 3]>,
}

impl<'a> Causes<'a> {
    pub(super) fn new(rendering: &'a BiScaleRendering, meaning: &BiScaleMeaning) -> Result<Self, StudyError> {
        let log2_samples = (rendering.file.fraction_bits().ok_or_else(no_mesh_transfer)? / 2).min(2);
        let sampling = VisibilitySampling { log2_samples, horizon: meaning.horizon };
        let tracer = HostTracer::new(&rendering.surface.mesh, Sides::Both);
        Ok(Self { rendering, tracer, sampling, fine: rendering.light.fine()? })
    }

    /// All pictures; `drawn` is the picture from transfer.
    pub(super) fn pictures(
        &self,
        pixels: &[Option<SurfacePixel>],
        (cube, drawn): (&CubeLight, &[[f64; 3]]),
        progress: &mut ProgressFn<'_>,
    ) -> CausePictures {
        let mut pictures = self.rungs(pixels, cube, progress);
        let mut causes = self.names();
        // Without biclusters, `drawn` already uses the matrix in f64.
        if self.rendering.file.biclusters.is_some()
            && let Some(local) = LocalLight::exact(&self.rendering.file, cube)
        {
            pictures.push(self.by_reference(pixels, &local));
            causes.push(("precision", "biclusters in single precision".to_owned()));
        }
        pictures.push(drawn.to_vec());
        CausePictures { causes, pictures }
    }

    fn names(&self) -> Vec<(&'static str, String)> {
        let along = 1 << self.sampling.log2_samples;
        let lights = self.rendering.textures.first().map_or(0, |texture| texture.samples.light().directions().len());
        vec![
            ("light", "light of 6 x 32 x 32 texels".to_owned()),
            ("visibility", format!("visibility of {along} x {along} directions a texel")),
            ("directions", format!("{lights} local directions")),
            ("views", "views of the texture".to_owned()),
            ("texture", "texels of the texture".to_owned()),
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

    /// Equation 3 by the plain loops of the reference.
    fn by_reference(&self, pixels: &[Option<SurfacePixel>], local: &LocalLight) -> Vec<[f64; 3]> {
        let color = |pixel: &Option<SurfacePixel>| {
            pixel.as_ref().map_or([0.0; 3], |pixel| {
                paper::radiance(&self.rendering.textures[pixel.texture].samples, &local.rows, &pixel.shaded)
            })
        };
        pixels.par_iter().map(color).collect()
    }
}

/// Reports the pictures, with the ray-traced picture.
pub(super) fn report(
    rendering: &BiScaleRendering,
    found_pictures: &CausePictures,
    exposure: f64,
    found: &mut Findings,
) -> Result<(), StudyError> {
    let CausePictures { causes, pictures } = found_pictures;
    let (exact, drawn) = (found_pictures.exact(), found_pictures.drawn());
    let width = rendering.view.camera.width();
    let mean = |color: &[f64; 3]| color.iter().sum::<f64>() / 3.0;
    let signed = |before: &[[f64; 3]], after: &[[f64; 3]]| -> Vec<f64> {
        after.iter().zip(before).map(|(a, b)| mean(a) - mean(b)).collect()
    };
    let scale = signed(exact, drawn).iter().fold(0.0_f64, |most, value| most.max(value.abs())).max(1e-30);
    let shown_scale = shown(scale, Quantity::Measured);
    let mut differences = Vec::new();
    for (step, name) in pictures.windows(2).zip(causes) {
        let caption = format!("{}: what it changes; blue -{shown_scale}, white 0, red +{shown_scale}", name.1);
        let image = false_color::signed(width, &signed(&step[0], &step[1]), scale);
        differences.push(NamedPicture::new(format!("cause-{}", name.0), image, caption));
    }
    found.heading("Compared with a ray-traced picture");
    let by_rays = rendering.view.picture(exact);
    let image = by_rays.display(exposure)?;
    found.keep_layers("reference", by_rays);
    let caption = format!("transfer minus ray-traced: blue -{shown_scale}, white 0, red +{shown_scale}");
    let whole = false_color::signed(width, &signed(exact, drawn), scale);
    found.pictures(vec![
        NamedPicture::new("reference", image, "ray-traced, each pixel on its own"),
        NamedPicture::new("difference", whole, caption),
    ]);
    let table = found_pictures.table("Error by cause, relative to the root mean square of the ray-traced picture");
    found.table(FoundTable::from(table).csv("causes").field("causes"));
    found.pictures(differences);
    found.conclusion(format!(
        "Compared with the ray-traced picture, the root mean square error is {} %.",
        shown(found_pictures.apart(exact, drawn), Quantity::Measured)
    ));
    Ok(())
}
