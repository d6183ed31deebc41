//! Models of the figures, at the printed or a reduced size.

use super::ModelSize;
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::factor::Lobe;
use crate::geom::Mesh;
use crate::scene::built::transfer_models::TransferModel;
pub(super) use crate::study::reproduce::all_frequency::forms::factorization;
use crate::study::reproduce::all_frequency::forms::{bare, quarter_of_half_vector};
use crate::study::reproduce::all_frequency::models::REDUCED_ITERATIONS;
pub(super) use crate::study::reproduce::all_frequency::models::ground_side as ground;

pub(super) fn tweety(models: ModelSize) -> Mesh {
    TransferModel::Tweety.mesh(models.pick(1, 9))
}

pub(super) fn buddha(models: ModelSize) -> Mesh {
    TransferModel::Buddha.mesh(models.pick(1, 12))
}

/// Compression options with `vectors` representatives per cluster. Clusters have fewer points in models with few
/// vertices, so that there are several.
pub(super) fn options(models: ModelSize, vectors: usize) -> SegmentOptions {
    let default = SegmentOptions::default();
    let iterations = models.pick(default.iterations, REDUCED_ITERATIONS);
    SegmentOptions { points_per_cluster: models.pick(200, 60), vectors, iterations, ..default }
}

/// Reflectance of a figure: the name of its form, and the lobe.
pub(super) type NamedLobe = (&'static str, Lobe);

/// Anisotropic reflectance of Figures 1 and 7: the textbook form, and the form nearest to the printed errors.
pub(super) fn schlick() -> [NamedLobe; 2] {
    let lobe = Lobe::schlick(0.2, 0.2, 0.8);
    [("textbook", lobe), ("quarter of half vector", quarter_of_half_vector(lobe))]
}

/// Reflectance of Figure 2 and of the glossy Buddha, in the same forms.
pub(super) fn cook_torrance() -> [NamedLobe; 2] {
    let lobe = Lobe::cook_torrance(0.4, 0.5);
    [("textbook", lobe), ("distribution alone", bare(lobe))]
}
