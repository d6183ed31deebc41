//! Pictures of a model with glossy reflection of the light of its vertices' local directions, by each method.

use glam::DVec3;

use super::chair::ChairModel;
use super::{HOST, StudyError, failed};
use crate::bi_scale::product::by_rows;
use crate::geom::vector::{unit, wide};
use crate::picture::metrics::{ScreenPicture, flip};
use crate::report::{Cell, NamedPicture, PictureGrid, Table};
use crate::scene::Camera;
use crate::study::prt::{FineView, LightChannels, SeenSurface, auto_exposure, linear_picture};
use crate::transfer::brdf::Brdf;
use crate::transfer::grid::texel_center;

/// Side of the pictures whose differences are measured, in pixels.
const SIDE: u32 = 160;
/// Pictures of the figure by its captions, with their names here.
const PRINTED: [(&str, &str); 4] = [
    ("(a) ours", "biclusters"),
    ("(b) reference", "the matrix"),
    ("(c) CPCA", "32 clusters of rows, 8 vectors each"),
    ("(d) Haar", "12 wavelets a row by area"),
];
/// Pixels per degree of the observer, FLIP's usual value.
const PIXELS_PER_DEGREE: f64 = 67.0;
/// Glossy plastic, with a lobe broad enough to be resolved by 8 x 8 directions.
const SURFACE: Brdf = Brdf::Phong { albedo: 0.4, specular: 0.3, exponent: 12.0 };
/// Position of the eye, in units of the model's size, relative to its center.
const EYE: DVec3 = DVec3::new(1.6, -2.4, 1.2);

/// Named radiance of vertices.
type NamedRadiance = (String, Vec<[f64; 3]>);

/// Builder of the pictures.
pub(super) struct VertexPictures<'a> {
    scene: &'a ChairModel,
    light: &'a LightChannels,
    camera: Camera,
    seen: SeenSurface,
    /// View of the pictures that are shown.
    fine: FineView,
    /// Local direction of the eye at each vertex.
    views: Vec<DVec3>,
    /// Results for rows of the matrix, each texel from its own direction; for the matrix; then for the methods.
    found: Vec<NamedRadiance>,
}

impl<'a> VertexPictures<'a> {
    /// Creates the builder of pictures of `side` x `side` pixels.
    pub(super) fn new(scene: &'a ChairModel, light: &'a LightChannels, side: u32) -> Result<Self, StudyError> {
        let [low, high] = scene.seen.mesh.bounds().unwrap_or_default().map(wide);
        let (middle, size) = ((low + high) / 2.0, (high - low).max_element());
        let eye = (middle + size * EYE).as_vec3().to_array();
        let camera = Camera::new(eye, middle.as_vec3().to_array(), [0.0, 0.0, 1.0], 0.22, SIDE, SIDE)
            .map_err(|error| failed(HOST)(&error))?;
        let seen = SeenSurface::new(&scene.seen.mesh, &scene.seen.vertices, &camera);
        let all: Vec<u32> = (0..scene.seen.vertices.len() as u32).collect();
        let fine = FineView::new((&scene.seen.mesh, &scene.seen.vertices), eye, (side, &all));
        let fine = fine.map_err(|error| failed(HOST)(&error))?;
        let places = scene.seen.vertices.positions().iter().zip(scene.seen.vertices.frames());
        let views = places.map(|(&at, frame)| frame.to_local(unit(wide(eye) - wide(at)).unwrap_or(frame.normal())));
        let views = views.collect();
        let mut pictures = Self { scene, light, camera, seen, fine, views, found: Vec::new() };
        let exact = pictures.of_texels();
        pictures.found.push(("every texel from its own direction".to_owned(), exact));
        pictures.add("the matrix", |light| by_rows(&scene.matrix, light));
        Ok(pictures)
    }

    /// Adds the light of local directions by a method, channel by channel.
    pub(super) fn add(&mut self, name: &str, product: impl Fn(&[f64]) -> Vec<f64>) {
        let directions = self.scene.directions.directions();
        let local: Vec<Vec<f64>> = self.light.iter().map(|channel| product(channel)).collect();
        let of_vertex = |(vertex, view): (usize, &DVec3)| {
            let mut sum = [0.0; 3];
            for (at, &direction) in directions.iter().enumerate() {
                let response = SURFACE.value(*view, direction) * direction.z;
                (0..3).for_each(|channel| sum[channel] += response * local[channel][vertex * directions.len() + at]);
            }
            sum
        };
        let colors: Vec<[f64; 3]> = self.views.iter().enumerate().map(of_vertex).collect();
        self.found.push((name.to_owned(), colors));
    }

    /// Radiance without local directions: the light of each visible texel from its own direction.
    fn of_texels(&self) -> Vec<[f64; 3]> {
        let local = self.scene.directions.directions().len();
        let matrix = &self.scene.matrix;
        let of_vertex = |(vertex, view): (usize, &DVec3)| {
            let (mut sum, frame) = ([0.0; 3], &self.scene.seen.vertices.frames()[vertex]);
            for entry in (vertex * local..(vertex + 1) * local).flat_map(|row| matrix.row(row)) {
                let texel = entry.index as usize;
                let direction = frame.to_local(texel_center(texel));
                let share = matrix.value(entry.value);
                let response = share * SURFACE.value(*view, direction) * direction.z.max(0.0);
                (0..3).for_each(|channel| sum[channel] += response * self.light[channel][texel]);
            }
            sum
        };
        self.views.iter().enumerate().map(of_vertex).collect()
    }

    /// Returns all pictures with the same exposure, and a table of their differences from that of the matrix.
    pub(super) fn finish(self) -> Result<(PictureGrid, Table), StudyError> {
        let pixels = |of_vertex: &[[f64; 3]]| self.seen.colors(of_vertex, [0.0; 3]);
        let exact = pixels(&self.found[1].1);
        let exposure = auto_exposure(&exact);
        let whole: f64 = exact.iter().flatten().map(|value| value * value).sum();
        let screen = |colors: &[[f64; 3]]| {
            let picture = linear_picture(&self.camera, colors);
            ScreenPicture::new(&picture, exposure).map_err(|error| failed(HOST)(&error))
        };
        let expected = screen(&exact)?;
        let mut table = Table::of("Pictures: off that of the matrix", "way rms_% flip");
        let mut pictures = Vec::new();
        for (at, (name, of_vertex)) in self.found.iter().enumerate() {
            let colors = pixels(of_vertex);
            let apart: f64 = colors.iter().flatten().zip(exact.iter().flatten()).map(|(a, b)| (a - b) * (a - b)).sum();
            let seen = flip(&screen(&colors)?, &expected, PIXELS_PER_DEGREE).map_or(0.0, |seen| seen.mean);
            table.push([name.as_str().into(), Cell::measured(100.0 * (apart / whole).sqrt()), Cell::measured(seen)]);
            let image = self.fine.picture(of_vertex).display(exposure).map_err(|e| failed(HOST)(&e))?;
            pictures.push(NamedPicture::new(format!("bi-scale-figure-6-{at}"), image, name.clone()));
        }
        let printed = PRINTED.map(|(_, name)| pictures.iter().position(|picture| picture.caption == name));
        let first = printed.map(|at| at.map(|at| pictures[at].clone()));
        let others = pictures.iter().enumerate().filter(|(at, _)| !printed.contains(&Some(*at)));
        let others: Vec<NamedPicture> = others.map(|(_, picture)| picture.clone()).collect();
        let mut grid = PictureGrid::new("Figure 6", PRINTED.map(|(label, _)| label)).sparse_row("", first);
        for (at, row) in others.chunks(PRINTED.len()).enumerate() {
            grid = grid.row(if at == 0 { "other ways" } else { "" }, row.to_vec());
        }
        Ok((grid, table))
    }
}
