//! Light times transfer: by biclusters in f32 where there are any, else by rows in f64.

use std::time::Instant;

use crate::prt::all_frequency::light::CubeLight;
use crate::prt::bi_scale::product::{Gather, by_rows};
use crate::prt::bi_scale::transfer::light_vector;
use crate::prt::file::BiScaleFile;

/// L~ of all vertices.
#[derive(Clone, Debug)]
pub struct LocalLight {
    /// `biclusters` or `rows`.
    pub way: &'static str,
    /// Red, green and blue of each row of the transfer.
    pub rows: Vec<[f64; 3]>,
    /// What the multiplication took.
    pub seconds: f64,
}

impl LocalLight {
    /// The light times a file's transfer, by its biclusters if it has any; `None` if it has neither these nor a matrix.
    ///
    /// # Panics
    /// If the transfer has not a column per light texel.
    pub fn new(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let Some(biclusters) = &file.biclusters else { return Self::by_rows(file, light) };
        let gather = Gather::new(biclusters);
        let channels = channels(light);
        let single: Vec<[f32; 3]> = (0..channels[0].len())
            .map(|texel| [0, 1, 2].map(|channel: usize| channels[channel][texel] as f32))
            .collect();
        let start = Instant::now();
        let rows = gather.multiply(&single);
        let seconds = start.elapsed().as_secs_f64();
        Some(Self { way: "biclusters", rows: rows.into_iter().map(|row| row.map(f64::from)).collect(), seconds })
    }

    /// The light times a file's matrix; `None` if it has none.
    ///
    /// # Panics
    /// As [`Self::new`].
    pub fn by_rows(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let matrix = file.matrix.as_ref()?;
        let channels = channels(light);
        let start = Instant::now();
        let [red, green, blue] = [0, 1, 2].map(|channel: usize| by_rows(matrix, &channels[channel]));
        let seconds = start.elapsed().as_secs_f64();
        let rows = red.into_iter().zip(green).zip(blue).map(|((red, green), blue)| [red, green, blue]).collect();
        Some(Self { way: "rows", rows, seconds })
    }
}

/// Radiance times solid angle, channel by channel.
fn channels(light: &CubeLight) -> [Vec<f64>; 3] {
    [0, 1, 2]
        .map(|channel: usize| light_vector(&light.texels().iter().map(|texel| texel[channel]).collect::<Vec<f64>>()))
}
