//! Figure 6: biclusters compared with clusters of rows, with wavelets, and with the other methods of sections II and
//! IV-A.

mod sizes;

use glam::DMat3;

use super::models::ModelVisibility;
use super::scenes::SCENES;
use super::{
    EntryFindings, HOST, ModelSize, PaperRow, RunResult, Shared, StudyError, number, paragraph, printed_value, solved,
};
use crate::bi_scale::baselines::{HaarRowOptions, LocalTransfer, RowClusterOptions};
use crate::bi_scale::bicluster::{BiclusterOptions, Biclustering, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::transfer::light_vectors;
use crate::scene::built::flat_models::FlatModel;
use crate::study::prt::{LightChannels, StoredComparison, stored_ways_table};
use crate::study::reproduce::sky::HARD_SUN;
use crate::transfer::light::{CubeLight, Decimation, DistantLight};
use crate::transfer::visibility::Horizon;
use sizes::chair_sizes;

/// Order of the harmonics in low-frequency bi-scale transfer.
const ORDER: usize = 5;

const HOW: &str = "Figure 6 has a chair with {} vertices that is not at hand; ours is made by code and has {}. Each way to store its transfer \
    is held against rows of the matrix under two lights, a clear sky with a sun, and two disks: {} clusters of rows of {} vectors, found from {} rows and \
    then made better with all rows in {} rounds; {} wavelets a row, by magnitude times area, in bytes; light of order {}, on one side and on both; and the form \
    that section IV-A rejects. Ways that the paper compares at about equal bytes stand here also with as many numbers as go into the bytes of biclusters.";
const CAPTIONS: &str = "The text calls (c) the picture of biclusters and (d) the reference. By the captions these are clusters of rows and wavelets, biclusters \
    and the reference are (a) and (b), and only so what the text says of them makes sense.";
const QUESTION: &str = "the chair, its light and camera; whether clusters had means, from how many rows they were found, and their size, which the scan has lost; \
    what area a wavelet is weighed by.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let (mesh, sample) = match shared.models {
        ModelSize::Reduced => (FlatModel::Chair.model(4).mesh, 1024),
        ModelSize::Printed => (FlatModel::Chair.model(1).mesh, 8192),
    };
    let (seen, directions) = (ModelVisibility::new(&mesh, Horizon::Normal)?, LocalDirections::new(SCENES[2].side));
    let (matrix, directions) = (seen.matrix(SCENES[2].side)?, directions.on(HOST)?);
    let biclusters = bicluster(&matrix, BiclusterOptions::default(), &mut |_| ()).on(HOST)?;
    let transfer = LocalTransfer::new(&matrix, seen.vertices.frames(), &directions);
    let comparison = StoredComparison {
        matrix: &matrix,
        biclusters: &biclusters,
        transfer: Some(transfer.on(HOST)?),
        clusters: RowClusterOptions { sample, ..RowClusterOptions::default() },
        wavelets: HaarRowOptions::default(),
        order: ORDER,
    };
    let lights = lights()?;
    let ways = comparison.ways(&lights, &mut |_, _, _| (), &mut |_, _| ()).on(HOST)?;
    let RowClusterOptions { clusters, vectors, sample, rounds, .. } = comparison.clusters;
    let sizes = [SCENES[2].vertices()?, seen.vertices.len(), clusters, vectors, sample, rounds]
        .into_iter()
        .chain([comparison.wavelets.keep, ORDER])
        .map(|size| number(size as f64, 0));
    Ok(EntryFindings::new(
        [paragraph(HOW, sizes), CAPTIONS.into()],
        rows(&matrix, &biclusters)?,
        [QUESTION],
        [stored_ways_table("Ways to store transfer", &ways, &["sky", "disks"]), chair_sizes()?],
    ))
}

/// Two lights: a clear sky with a small sun, and two disks in dim light.
fn lights() -> Result<[LightChannels; 2], StudyError> {
    let of = |light: DistantLight| -> Result<LightChannels, StudyError> {
        let cube: CubeLight = light.cube(&DMat3::IDENTITY, Decimation::SolidAngle).on(HOST)?;
        Ok(light_vectors(&cube).to_vec())
    };
    Ok([of(DistantLight::Sky(HARD_SUN))?, of(DistantLight::RedAndBlue)?])
}

/// Rows for sizes and losses. "Severe" artifacts of other storages are not a printed number: the table shows their
/// errors.
fn rows(matrix: &SparseMatrix, biclusters: &Biclustering) -> Result<Vec<PaperRow>, StudyError> {
    let sum = biclusters.sum().on(HOST)?;
    let given_back = (0..matrix.rows()).filter(|&row| matrix.row(row) == sum.row(row)).count();
    let share = 100.0 * given_back as f64 / matrix.rows() as f64;
    let lossless = solved("lossless", share)?.confined([100.0; 2], "Algorithm 1 moves values, and rounds none");
    Ok(vec![lossless])
}
