//! Compares a picture with a ray-traced one, and divides its error among causes: each picture in between adds one
//! approximation of transfer.

use rayon::prelude::*;

use super::subject::{BiScaleRendering, LocalLight, SurfacePixel, no_mesh_transfer};
use crate::bi_scale::file::BiScaleMeaning;
use crate::bi_scale::paper;
use crate::bi_scale::shade::{TracedLight, TracedPoint, TracedRung, TracedScene};
use crate::geom::exact::Sides;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table};
use crate::study::prt::lit_view::{difference_of_means, signed_picture};
use crate::study::{ProgressFn, StudyError};
use crate::tracer::HostTracer;
use crate::transfer::light::CubeLight;
use crate::transfer::ray_length;
use crate::transfer::visibility::VisibilitySampling;

/// Number of pixels between progress reports.
const BLOCK: usize = 256;

/// A sequence of pictures from the ray-traced one to the picture from transfer, each of which adds one approximation.
#[derive(Clone, Debug)]
pub(in crate::study) struct CausePictures {
    /// Approximation that each picture after the first adds to the previous one: a word, and a sentence.
    pub(in crate::study) causes: Vec<(&'static str, String)>,
    /// The ray-traced picture first, the picture from transfer last.
    pub(in crate::study) pictures: Vec<Vec<[f64; 3]>>,
}

impl CausePictures {
    /// All pictures; `drawn` is the picture from transfer.
    pub(super) fn new(
        rendering: &BiScaleRendering,
        meaning: &BiScaleMeaning,
        pixels: &[Option<SurfacePixel>],
        (cube, drawn): (&CubeLight, &[[f64; 3]]),
        progress: &mut ProgressFn<'_>,
    ) -> Result<Self, StudyError> {
        let BiScaleRendering { surface, file, textures, .. } = rendering;
        let log2_samples = (file.fraction_bits().ok_or_else(no_mesh_transfer)? / 2).min(2);
        let sampling = VisibilitySampling { log2_samples, horizon: meaning.horizon };
        let (tracer, fine) = (HostTracer::new(&surface.mesh, Sides::Both), rendering.light.fine()?);
        let scene = TracedScene { tracer: &tracer, length: ray_length(&surface.vertices), sampling };
        let light = TracedLight { fine: &fine, texels: cube.texels() };
        let of_pixel = |pixel: &Option<SurfacePixel>| {
            let rungs = pixel.as_ref().and_then(|pixel| {
                let texture = &textures[pixel.texture];
                let corners = surface.mesh.corners(pixel.triangle)?;
                let point = TracedPoint::new(corners, pixel.shaded.weights, pixel.frame)?;
                Some(scene.rungs(&point, &pixel.shaded, (texture.patch.as_ref()?, &texture.samples), light))
            });
            rungs.unwrap_or_default()
        };
        let mut all = Vec::with_capacity(pixels.len());
        for block in pixels.chunks(BLOCK) {
            progress("pixels by rays", all.len() as u64, pixels.len() as u64);
            all.extend(block.par_iter().map(of_pixel).collect::<Vec<_>>());
        }
        let picture = |&rung: &TracedRung| -> Vec<[f64; 3]> { all.iter().map(|rungs| rungs[rung as usize]).collect() };
        let mut pictures: Vec<Vec<[f64; 3]>> = TracedRung::ALL.iter().map(picture).collect();
        let along = 1 << log2_samples;
        let lights = textures.first().map_or(0, |texture| texture.samples.light().directions().len());
        let mut causes = vec![
            ("light", "light of 6 x 32 x 32 texels".to_owned()),
            ("visibility", format!("visibility of {along} x {along} directions a texel")),
            ("directions", format!("{lights} local directions")),
            ("views", "views of the texture".to_owned()),
            ("texture", "texels of the texture".to_owned()),
            ("interpolation", "interpolation over vertices".to_owned()),
        ];
        // Without biclusters, `drawn` already uses the matrix in f64.
        if file.biclusters.is_some()
            && let Some(local) = LocalLight::exact(file, cube)
        {
            // Equation 3 by the plain loops of the reference.
            let color =
                |pixel: &SurfacePixel| paper::radiance(&textures[pixel.texture].samples, &local.rows, &pixel.shaded);
            pictures.push(pixels.par_iter().map(|pixel| pixel.as_ref().map_or([0.0; 3], color)).collect());
            causes.push(("precision", "biclusters in single precision".to_owned()));
        }
        pictures.push(drawn.to_vec());
        Ok(Self { causes, pictures })
    }

    /// The ray-traced picture.
    pub(in crate::study) fn exact(&self) -> &[[f64; 3]] {
        self.pictures.first().map_or(&[], Vec::as_slice)
    }

    /// The picture from transfer.
    pub(in crate::study) fn drawn(&self) -> &[[f64; 3]] {
        self.pictures.last().map_or(&[], Vec::as_slice)
    }

    /// The ray-traced picture in which textures replace patches, as in transfer.
    pub(in crate::study) fn textured(&self) -> &[[f64; 3]] {
        self.pictures.get(TracedRung::Texture as usize).map_or(&[], Vec::as_slice)
    }

    /// RMS difference of two pictures, in percent of the RMS of the ray-traced picture; 0 if that picture is black.
    pub(in crate::study) fn apart(&self, one: &[[f64; 3]], other: &[[f64; 3]]) -> f64 {
        let whole: f64 = self.exact().iter().flatten().map(|value| value * value).sum();
        if whole > 0.0 { 100.0 * (differences(one, other).squares() / whole).sqrt() } else { 0.0 }
    }

    pub(in crate::study) fn table(&self, title: &str) -> Table {
        let row = |(step, cause): (&[Vec<[f64; 3]>], &(&str, String))| {
            [
                cause.1.as_str().into(),
                Cell::measured(self.apart(&step[0], &step[1])),
                Cell::measured(self.apart(self.exact(), &step[1])),
                Cell::measured(differences(&step[0], &step[1]).largest),
            ]
        };
        let table = Table::new(title, &["cause", "step (%)", "up to here (%)", "largest (radiance)"]);
        table.with(self.pictures.windows(2).zip(&self.causes).map(row))
    }

    pub(super) fn report(
        &self,
        rendering: &BiScaleRendering,
        exposure: f64,
        found: &mut Findings,
    ) -> Result<(), StudyError> {
        let (exact, drawn, width) = (self.exact(), self.drawn(), rendering.view.camera.width());
        let (whole, largest) = difference_of_means(drawn, exact);
        let scale = largest.max(1e-30);
        let steps = self.pictures.windows(2).zip(&self.causes).map(|(step, (word, cause))| {
            let (changes, _) = difference_of_means(&step[1], &step[0]);
            signed_picture(
                format!("cause-{word}"),
                &format!("{cause}: what this cause changes;"),
                width,
                &changes,
                scale,
            )
        });
        found.heading("Compared with a ray-traced picture");
        let by_rays = rendering.view.picture(exact);
        let image = by_rays.display(exposure)?;
        found.keep_layers("reference", by_rays);
        found.pictures(vec![
            NamedPicture::new("reference", image, "ray-traced, each pixel on its own"),
            signed_picture("difference", "transfer minus ray-traced:", width, &whole, scale),
        ]);
        let table = self.table("Error by cause, relative to the root mean square of the ray-traced picture");
        found.table(FoundTable::from(table).csv("causes").field("causes"));
        found.pictures(steps.collect());
        found.conclusion(format!(
            "Compared with the ray-traced picture, the root mean square error is {} %.",
            shown(self.apart(exact, drawn), Quantity::Measured)
        ));
        Ok(())
    }
}

fn differences(one: &[[f64; 3]], other: &[[f64; 3]]) -> ErrorSums {
    let mut sums = ErrorSums::default();
    one.iter().flatten().zip(other.iter().flatten()).for_each(|(&a, &b)| sums.add(value_error(a, b), 1.0));
    sums
}
