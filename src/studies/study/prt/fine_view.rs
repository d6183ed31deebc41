//! Pictures of vertex colors to look at: framed by the model, and filtered by several samples per pixel.

use glam::DVec3;
use rayon::prelude::*;

use super::interpolate::SeenSurface;
use crate::error::InputError;
use crate::geom::Mesh;
use crate::geom::vector::wide;
use crate::picture::Picture;
use crate::study::framing::framed;
use crate::transfer::Vertices;

/// Samples along an edge of the whole picture, about: 16 per pixel of a picture of 320 x 320.
const SAMPLED_SIDE: u32 = 1280;

/// A square picture of a mesh from an eye.
pub(in crate::study) struct FineView {
    side: u32,
    /// Samples along an edge of a pixel.
    samples: u32,
    seen: SeenSurface,
}

impl FineView {
    /// Creates a view of `side` x `side` pixels that the first `framing` vertices fill.
    ///
    /// # Errors
    /// [`InputError`] for a mesh without extent.
    pub(in crate::study) fn new(
        (mesh, vertices): (&Mesh, &Vertices),
        eye: [f32; 3],
        (side, framing): (u32, &[u32]),
    ) -> Result<Self, InputError> {
        let samples = (SAMPLED_SIDE / side.max(1)).max(1);
        let points: Vec<DVec3> = framing.iter().map(|&vertex| wide(vertices.positions()[vertex as usize])).collect();
        let camera = framed(wide(eye), &points, 1.0).camera(side * samples, side * samples)?;
        Ok(Self { side, samples, seen: SeenSurface::new(mesh, vertices, &camera) })
    }

    /// Picture of colors of vertices, black where nothing is: the mean of each pixel's samples.
    pub(in crate::study) fn picture(&self, of_vertex: &[[f64; 3]]) -> Picture {
        let colors = self.colors(&self.seen.colors(of_vertex, [0.0; 3]));
        let single: Vec<[f32; 3]> = colors.iter().map(|color| color.map(|channel| channel as f32)).collect();
        Picture::rgb(self.side, self.side, &single)
    }

    /// Mean color of each pixel's samples, whose vertex of largest weight has a color; black elsewhere.
    pub(in crate::study) fn nearest(&self, color: impl Fn(u32) -> [u8; 3]) -> Vec<[u8; 3]> {
        let sample = |vertex: Option<u32>| vertex.map_or([0.0; 3], |vertex| color(vertex).map(f64::from));
        let samples: Vec<[f64; 3]> = self.seen.nearest().map(sample).collect();
        self.colors(&samples).into_iter().map(|color| color.map(|channel| channel.round() as u8)).collect()
    }

    /// Mean value of each pixel's samples that show something; NaN where fewer than half do.
    pub(in crate::study) fn values(&self, of_vertex: &[f64]) -> Vec<f64> {
        let of_vertex: Vec<[f64; 3]> = of_vertex.iter().map(|&value| [value, 1.0, 0.0]).collect();
        let value = |[sum, share, _]: [f64; 3]| if share >= 0.5 { sum / share } else { f64::NAN };
        self.colors(&self.seen.colors(&of_vertex, [0.0; 3])).into_iter().map(value).collect()
    }

    /// Pixels along an edge.
    pub(in crate::study) const fn side(&self) -> u32 {
        self.side
    }

    fn colors(&self, samples: &[[f64; 3]]) -> Vec<[f64; 3]> {
        filtered(samples, [self.side; 2], self.samples)
    }
}

/// Mean of each pixel's samples, `per_edge` along an edge of it, in a fixed order; `samples` are those of a picture of
/// as many times the width and height.
pub(in crate::study) fn filtered(samples: &[[f64; 3]], [width, height]: [u32; 2], per_edge: u32) -> Vec<[f64; 3]> {
    let pixel = |at: u32| {
        let [left, top] = [at % width, at / width].map(|place| place * per_edge);
        let mut sum = [0.0; 3];
        for y in top..top + per_edge {
            for x in left..left + per_edge {
                let sample = samples[(y * width * per_edge + x) as usize];
                (0..3).for_each(|channel| sum[channel] += sample[channel]);
            }
        }
        sum.map(|channel| channel / f64::from(per_edge * per_edge))
    };
    (0..width * height).into_par_iter().map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::teapot::teapot;
    use crate::transfer::Tangents;

    /// White vertices give white inside, black outside, and greys at the silhouette alone; values have no edge.
    #[test]
    fn edges_are_filtered_and_values_are_not_mixed_with_the_background() {
        let mesh = teapot(3).expect("a teapot");
        let vertices = Vertices::new(&mesh, Tangents::Along(DVec3::Z)).expect("vertices");
        let all: Vec<u32> = (0..vertices.len() as u32).collect();
        let view = FineView::new((&mesh, &vertices), [4.0, -9.0, 3.0], (64, &all)).expect("a view");
        assert_eq!((view.side(), view.samples), (64, 20));
        let white = view.nearest(|_| [255; 3]);
        let grey = white.iter().filter(|pixel| !matches!(pixel[0], 0 | 255)).count();
        let inside = white.iter().filter(|pixel| pixel[0] == 255).count();
        assert!(inside > 900 && grey > 50 && grey < inside / 4, "{inside} {grey}");
        let values = view.values(&vec![3.0; vertices.len()]);
        assert!(values.iter().all(|value| value.is_nan() || (value - 3.0).abs() < 1e-9));
    }
}
