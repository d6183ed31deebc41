//! Biclusters compared with other ways to store transfer: bytes, and errors of the local light.

use std::time::Instant;

use crate::bi_scale::baselines::columns_error;
use crate::bi_scale::baselines::{
    CoefficientPriority, CompressedRows, HaarRowOptions, HaarRows, HarmonicRows, LocalLightError, LocalTransfer,
    ReshuffledVisibility, RowClusterOptions, RowClusters, StoredSize, StoredTransfer,
};
use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::product::by_rows;
use crate::error::InputError;
use crate::report::words::counted;
use crate::report::{Cell, Table};
use crate::study::ProgressFn;
use crate::transfer::grid::LIGHT_TEXELS;

/// Edges of the cubes of the rejected form, in texels: a coarse cube with about as many texels per hemisphere as 8 x 8
/// local directions, and the light's own cube.
const COARSE_SIDES: [usize; 2] = [4, 32];

/// A transfer matrix, to be stored in several ways.
#[derive(Clone, Copy, Debug)]
pub struct StoredComparison<'a> {
    /// T.
    pub matrix: &'a SparseMatrix,
    /// Biclusters of T.
    pub biclusters: &'a Biclustering,
    /// Frames at T's vertices; if there are none, rotated forms are not compared.
    pub transfer: Option<LocalTransfer<'a>>,
    /// Clusters of rows.
    pub clusters: RowClusterOptions,
    /// Wavelets of rows.
    pub wavelets: HaarRowOptions,
    /// The order of harmonics.
    pub order: usize,
}

/// A way to store transfer, with its size and error.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredWay {
    /// Name of the way, with its settings.
    pub name: String,
    /// Bytes per layout; the errors belong to the first layout.
    pub sizes: Vec<StoredSize>,
    /// Error over all channels, per light.
    pub errors: Vec<LocalLightError>,
    /// Seconds of its computation.
    pub seconds: f64,
}

/// A light: numbers per light texel, multiplied by solid angles, channel by channel.
pub type LightChannels = Vec<Vec<f64>>;

impl StoredComparison<'_> {
    /// Stores the matrix in all ways and measures errors under some lights, biclusters first. `visit` is called with
    /// each way. Fails with an [`InputError`]; omits layouts of narrow numbers that cannot hold the values.
    pub fn ways(
        &self,
        lights: &[LightChannels],
        progress: &mut ProgressFn<'_>,
        visit: &mut dyn FnMut(&str, &dyn StoredTransfer),
    ) -> Result<Vec<StoredWay>, InputError> {
        if self.matrix.columns() != LIGHT_TEXELS {
            return Err(columns_error(self.matrix.columns()));
        }
        let exact: Vec<Vec<f64>> =
            lights.iter().map(|light| joined(light, |light| by_rows(self.matrix, light))).collect();
        let mut ways = StorageMethods { lights, exact, found: Vec::new(), visit };
        let (rows, budget) = (self.matrix.rows(), self.biclusters.sizes()[0].bytes);
        ways.push("biclusters", self.biclusters, 0.0);
        let start = Instant::now();
        if let Ok(narrow) = CompressedRows::narrow(self.matrix) {
            ways.push("rows of 3 bytes an entry", &narrow, start.elapsed().as_secs_f64());
        }
        ways.make("rows of 8 bytes an entry", || CompressedRows::wide(self.matrix))?;
        for (clusters, what) in self.cluster_settings(budget) {
            let steps = clusters.rounds as u64 + 1;
            let name = format!(
                "{} of rows, {} each{what}",
                counted(clusters.clusters as u64, "cluster", "clusters"),
                counted(clusters.vectors as u64, "vector", "vectors")
            );
            let mut observe = |round: usize| progress("rounds of clusters", round as u64 + 1, steps);
            ways.make(name, || RowClusters::new(self.matrix, &clusters, &mut observe))?;
        }
        progress("wavelets", 0, 1);
        let equal = self.wavelets.within(budget, rows);
        let other = match self.wavelets.priority {
            CoefficientPriority::Area => CoefficientPriority::Magnitude,
            CoefficientPriority::Magnitude => CoefficientPriority::Area,
        };
        for (wavelets, what) in [
            (self.wavelets, ""),
            (HaarRowOptions { priority: other, ..self.wavelets }, ""),
            (equal, EQUAL),
            (HaarRowOptions { priority: other, ..equal }, EQUAL),
        ] {
            let name = format!("{} wavelets a row by {}{what}", wavelets.keep, wavelets.priority);
            ways.make(name, || HaarRows::new(self.matrix, wavelets))?;
        }
        progress("harmonics", 0, 1);
        let order = self.order;
        ways.make(format!("light of order {order}"), || HarmonicRows::of_light(self.matrix, order))?;
        if let Some(transfer) = &self.transfer {
            ways.make(format!("harmonics of order {order} on both sides"), || HarmonicRows::of_both(transfer, order))?;
            for side in COARSE_SIDES {
                let name = format!("visibility of 6 x {side} x {side} texels, reshuffled");
                ways.make(name, || ReshuffledVisibility::new(transfer, side))?;
            }
        }
        Ok(ways.found)
    }

    /// Clusters as requested, and, if that differs, with as many vectors as fit into `budget` bytes.
    fn cluster_settings(&self, budget: u64) -> Vec<(RowClusterOptions, &'static str)> {
        let equal = self.clusters.within(budget, [self.matrix.rows(), self.matrix.columns()]);
        let mut settings = vec![(self.clusters, "")];
        if equal.vectors != self.clusters.vectors {
            settings.push((equal, EQUAL));
        }
        settings
    }
}

/// Suffix for methods that take about as many bytes as biclusters.
const EQUAL: &str = ", in the bytes of biclusters";

struct StorageMethods<'a> {
    lights: &'a [LightChannels],
    /// T L for each light, channel by channel.
    exact: Vec<Vec<f64>>,
    found: Vec<StoredWay>,
    visit: &'a mut dyn FnMut(&str, &dyn StoredTransfer),
}

impl StorageMethods<'_> {
    fn make<S: StoredTransfer>(
        &mut self,
        name: impl Into<String>,
        make: impl FnOnce() -> Result<S, InputError>,
    ) -> Result<(), InputError> {
        let start = Instant::now();
        let stored = make()?;
        let seconds = start.elapsed().as_secs_f64();
        self.push(name, &stored, seconds);
        Ok(())
    }

    fn push(&mut self, name: impl Into<String>, stored: &dyn StoredTransfer, seconds: f64) {
        let lights = self.lights.iter().zip(&self.exact);
        let error = |(light, exact): (&LightChannels, &Vec<f64>)| {
            LocalLightError::new(&joined(light, |l| stored.multiply(l)), exact)
        };
        let errors = lights.map(error).collect();
        let name = name.into();
        (self.visit)(&name, stored);
        self.found.push(StoredWay { name, sizes: stored.sizes(), errors, seconds });
    }
}

fn joined(light: &LightChannels, product: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    light.iter().flat_map(|channel| product(channel)).collect()
}

/// Table with a row per way: megabytes, percent of the first way's bytes, and for each light the relative error in
/// percent and the largest.
pub fn stored_ways_table(title: &str, ways: &[StoredWay], lights: &[&str]) -> Table {
    let errors = lights.iter().flat_map(|light| [format!("{light}_error_%"), format!("{light}_largest")]);
    let headings: Vec<String> = ["way", "MB", "of_biclusters_%"].map(str::to_owned).into_iter().chain(errors).collect();
    let mut table = Table::new(title, &headings);
    let whole = ways.first().map_or(1, |first| first.sizes[0].bytes).max(1) as f64;
    for way in ways {
        let bytes = way.sizes[0].bytes as f64;
        let head = [way.name.as_str().into(), Cell::measured(1e-6 * bytes), Cell::decimals(100.0 * bytes / whole, 1)];
        let errors =
            way.errors.iter().flat_map(|error| [Cell::measured(100.0 * error.relative), Cell::measured(error.largest)]);
        table.push(head.into_iter().chain(errors));
    }
    table
}
