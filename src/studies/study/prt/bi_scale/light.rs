//! Product of light and transfer: by biclusters in f32 if the file has any, otherwise by rows in f64.

use std::time::Instant;

use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::paper;
use crate::bi_scale::product::{Gather, by_rows};
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::transfer::light::CubeLight;

/// L~ of all vertices.
#[derive(Clone, Debug)]
pub(in crate::study) struct LocalLight {
    /// `biclusters` or `rows`.
    pub(super) way: &'static str,
    /// Red, green and blue of each row of the transfer.
    pub(in crate::study) rows: Vec<[f64; 3]>,
    /// Time of the multiplication.
    pub(super) seconds: f64,
}

impl LocalLight {
    /// The light times a file's transfer, by its biclusters if it has any, otherwise by its matrix; `None` without
    /// both. Panics if the transfer does not have one column per light texel.
    pub(super) fn new(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let Some(biclusters) = &file.biclusters else { return Self::exact(file, light) };
        let gather = Gather::new(biclusters);
        let channels = light_vectors(light);
        let single: Vec<[f32; 3]> = (0..channels[0].len())
            .map(|texel| [0, 1, 2].map(|channel: usize| channels[channel][texel] as f32))
            .collect();
        let start = Instant::now();
        let rows = gather.multiply(&single);
        let seconds = start.elapsed().as_secs_f64();
        Some(Self { way: "biclusters", rows: rows.into_iter().map(|row| row.map(f64::from)).collect(), seconds })
    }

    /// Local light in f64, by the file's matrix if it has one, else by its biclusters. Panics as [`Self::new`] does.
    pub(super) fn exact(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let channels = light_vectors(light);
        let start = Instant::now();
        let (way, channels) = match (&file.matrix, &file.biclusters) {
            (Some(matrix), _) => ("rows", channels.map(|channel| by_rows(matrix, &channel))),
            (None, Some(biclusters)) => ("biclusters", channels.map(|channel| paper::multiply(biclusters, &channel))),
            (None, None) => return None,
        };
        let seconds = start.elapsed().as_secs_f64();
        Some(Self { way, rows: side_by_side(channels), seconds })
    }
}
