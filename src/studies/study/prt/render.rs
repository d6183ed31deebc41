//! Pictures of a model under distant light, from its transfer, and the exit radiance of its vertices.

use glam::DVec3;
use rayon::prelude::*;

use super::interpolate::SeenSurface;
use super::lit_view::{LitView, mean, relative_rms};
use crate::clustering::{Clustering, Signal};
use crate::geom::Mesh;
use crate::geom::random::CounterRng;
use crate::geom::vector::wide;
use crate::picture::{RgbImage, rgb8};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table, false_color};
use crate::scene::Camera;
use crate::sphere::{HarmonicLight, MAX_ORDER, harmonics};
use crate::study::{ProgressFn, Study, StudyError};
use crate::transfer::Vertices;
use crate::transfer::file::{PrtFile, PrtMeaning};

/// A model with its transfer, a light and a camera.
#[derive(Debug)]
pub struct Rendering {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's mesh.
    pub mesh: Mesh,
    /// The model's vertices, which are the points of the file.
    pub vertices: Vertices,
    /// Transfer, clusters or both; if there are clusters, they are drawn.
    pub file: PrtFile,
    /// The uncompressed transfer to compare with, if there is one.
    pub original: Option<Signal>,
    /// The light, with the same order as the transfer.
    pub light: HarmonicLight,
}

impl Study for Rendering {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("rays", 0, 2);
        let seen = SeenSurface::new(&self.mesh, &self.vertices, &self.view.camera);
        progress("radiance", 1, 2);
        let drawn = self.colors(&seen, None)?;
        let radiance = |direction| self.light.radiance(direction);
        let (mut found, exposure) =
            self.view.findings("Precomputed radiance transfer", &drawn, radiance, seen.count())?;
        let least = self.light.least();
        if least.iter().any(|&radiance| radiance < 0.0) {
            let [red, green, blue] = least.map(|radiance| shown(radiance, Quantity::Measured));
            let order = self.light.order();
            found.conclusion(format!(
                "At order {order} the light rings: its least radiance is {red}, {green}, {blue} (red, green, blue)."
            ));
        }
        if let Some(original) = &self.original {
            self.compare(&seen, original, &drawn, exposure, &mut found)?;
        }
        self.clusters(&seen, &mut found);
        Ok(found)
    }
}

impl Rendering {
    /// Linear radiance of all pixels: from `original` if given, otherwise from clusters, otherwise from transfer.
    fn colors(&self, seen: &SeenSurface, original: Option<&Signal>) -> Result<Vec<[f64; 3]>, StudyError> {
        let lit = Lit::new(&self.file.meaning, &self.light).ok_or_else(no_transfer)?;
        let exit = match (original, &self.file.clustering, &self.file.transfer) {
            (Some(signal), ..) | (None, None, Some(signal)) => lit.of_signal(signal),
            (None, Some(clustering), _) => lit.of_clusters(clustering),
            (None, None, None) => return Err(no_transfer()),
        };
        Ok(seen.colors(&lit.radiance(&exit, &self.vertices, wide(self.view.camera.eye())), [0.0; 3]))
    }

    fn compare(
        &self,
        seen: &SeenSurface,
        original: &Signal,
        drawn: &[[f64; 3]],
        exposure: f64,
        found: &mut Findings,
    ) -> Result<(), StudyError> {
        let whole = self.colors(seen, Some(original))?;
        let (mut pictures, difference, largest) =
            self.view.against_original(drawn, &whole, exposure, "compressed minus original")?;
        let apart = relative_rms(difference.iter().copied(), whole.iter().map(mean));
        let of_picture = "root mean square difference, relative to the picture's root mean square (%)";
        let mut table = Table::new("Compressed against original", &["figure", "value"]).with([
            [of_picture.into(), apart.map(Cell::measured).into()],
            ["largest difference (radiance)".into(), Cell::measured(largest)],
        ]);
        if let Some(clustering) = &self.file.clustering {
            let error = clustering.squared_error(original);
            let relative = if error > 0.0 { error / original.sum_of_squares() } else { 0.0 };
            let of_transfer = "squared error of the transfer, relative to its sum of squares (%)";
            table.push([of_transfer.into(), Cell::measured(100.0 * relative)]);
            let squared: Vec<f64> =
                (0..original.points()).map(|point| clustering.squared_error_of(point, original)).collect();
            let most = squared.iter().copied().fold(0.0, f64::max);
            if most > 0.0 {
                let of_vertex: Vec<[f64; 3]> = squared.iter().map(|squared| [(squared / most).sqrt(); 3]).collect();
                let map: Vec<f64> =
                    seen.colors(&of_vertex, [f64::NAN; 3]).into_iter().map(|[value, ..]| value).collect();
                let caption = "error of each vertex's transfer, relative to the largest; pale is large";
                let image = false_color::magnitude(self.view.camera.width(), &map);
                pictures.push(NamedPicture::new("error", image, caption));
            }
        }
        found.heading("Against the original");
        found.pictures(pictures);
        found.table(FoundTable::from(table).csv("comparison").field("comparison"));
        Ok(())
    }

    /// Adds a picture of the cluster of each pixel's nearest vertex.
    fn clusters(&self, seen: &SeenSurface, found: &mut Findings) {
        let Some(clustering) = &self.file.clustering else { return };
        let of_vertex = |vertex: u32| Some(clustering.of_point()[vertex as usize]);
        let image = cluster_picture(seen, &self.view.camera, of_vertex);
        found.heading("Clusters");
        let caption = format!("{} clusters, each in a color of its own", clustering.subspaces().len());
        found.pictures(vec![NamedPicture::new("clusters", image, caption)]);
    }
}

/// The cluster of each pixel's nearest vertex, each in a color of its own; black if there is none.
pub(super) fn cluster_picture(seen: &SeenSurface, camera: &Camera, of_vertex: impl Fn(u32) -> Option<u32>) -> RgbImage {
    let random = CounterRng::new(0);
    let color =
        |cluster: u32| [0, 1, 2].map(|channel| 64 + (random.bits(u64::from(cluster), 0, channel) >> 56) as u8 / 4 * 3);
    let colors = seen.nearest().map(|vertex| vertex.and_then(&of_vertex).map_or([0; 3], color));
    rgb8(camera.width(), camera.height(), colors)
}

/// Meaning of the numbers at a vertex, and a light with the same number of functions.
pub(in crate::study) struct Lit<'a> {
    channels: usize,
    functions: &'a [u16],
    columns: usize,
    light: &'a HarmonicLight,
}

impl<'a> Lit<'a> {
    /// Returns `None` if the numbers are not transfer.
    pub(in crate::study) fn new(meaning: &'a PrtMeaning, light: &'a HarmonicLight) -> Option<Self> {
        let PrtMeaning::Transfer { channels, exit_functions, light_order, .. } = meaning else { return None };
        let columns = (light_order * light_order) as usize;
        Some(Self { channels: *channels as usize, functions: exit_functions, columns, light })
    }

    /// Exit coefficients M l for a matrix, or for some of its rows: red, green and blue per row.
    fn product(&self, matrix: &[f64]) -> Vec<[f64; 3]> {
        let rows = self.functions.len();
        let dot = |row: usize, channel: usize| -> f64 {
            let first = (channel % self.channels * rows + row) * self.columns;
            let row = &matrix[first..first + self.columns];
            row.iter().zip(&self.light.channels()[channel]).map(|(m, l)| m * l).sum()
        };
        (0..rows).map(|row| [0, 1, 2].map(|channel| dot(row, channel))).collect()
    }

    /// The exit coefficients of every vertex, from uncompressed transfer.
    pub(in crate::study) fn of_signal(&self, signal: &Signal) -> Vec<Vec<[f64; 3]>> {
        let exit = |point: usize| {
            let matrix: Vec<f64> = signal.point(point).iter().map(|&value| f64::from(value)).collect();
            self.product(&matrix)
        };
        (0..signal.points()).into_par_iter().map(exit).collect()
    }

    /// The exit coefficients from clusters, as in section 6: products with the mean and the vectors of each cluster,
    /// then weighted sums per vertex.
    pub(in crate::study) fn of_clusters(&self, clustering: &Clustering) -> Vec<Vec<[f64; 3]>> {
        let products: Vec<Vec<Vec<[f64; 3]>>> = (clustering.subspaces().par_iter())
            .map(|subspace| {
                std::iter::once(&subspace.mean[..]).chain(subspace.vectors()).map(|part| self.product(part)).collect()
            })
            .collect();
        let exit = |point: usize| {
            let [mean, vectors @ ..] = &products[clustering.of_point()[point] as usize][..] else { return Vec::new() };
            let mut sum = mean.clone();
            for (weight, vector) in clustering.weights(point).iter().zip(vectors) {
                for (sum, part) in sum.iter_mut().zip(vector) {
                    (0..3).for_each(|channel| sum[channel] += weight * part[channel]);
                }
            }
            sum
        };
        (0..clustering.points()).into_par_iter().map(exit).collect()
    }

    /// Radiance of every vertex towards the eye.
    pub(in crate::study) fn radiance(&self, exit: &[Vec<[f64; 3]>], vertices: &Vertices, eye: DVec3) -> Vec<[f64; 3]> {
        let order = usize::from(self.functions.iter().copied().max().unwrap_or(0)).isqrt() + 1;
        let towards = |vertex: usize| {
            if self.functions == [0] {
                return exit[vertex].first().copied().unwrap_or_default();
            }
            let view = (eye - wide(vertices.positions()[vertex])).normalize_or_zero();
            let mut y = [0.0; MAX_ORDER * MAX_ORDER];
            harmonics(order, vertices.frames()[vertex].to_local(view), &mut y[..order * order]);
            let mut sum = [0.0; 3];
            for (coefficients, &function) in exit[vertex].iter().zip(self.functions) {
                (0..3).for_each(|channel| sum[channel] += y[usize::from(function)] * coefficients[channel]);
            }
            sum
        };
        (0..vertices.len()).into_par_iter().map(towards).collect()
    }
}

pub(super) fn no_transfer() -> StudyError {
    let help = "compress a file that `crossbar cpca precompute` wrote";
    StudyError::new("crossbar::prt::meaning", "expected transfer, found a signal that is not transfer").with_help(help)
}
