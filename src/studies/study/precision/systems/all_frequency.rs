//! All-frequency transfer: products with view maps per pixel.

use refsim::texture::TexelFormat;

use super::subject::{System, bunny, cameras};
use crate::all_frequency::Reflectance;
use crate::all_frequency::factor::{FactorSampling, Factorization, Lobe, Supersamples};
use crate::all_frequency::on_card::{FactoredCard, ProductOptions, ProductPlace, TransferredMesh};
use crate::all_frequency::shade::TransferredRadiance;
use crate::card::MeshView;
use crate::study::StudyError;
use crate::study::prt::no_all_frequency_card;
use crate::transfer::synthetic::signal_at;
use crate::transfer::{Tangents, Vertices};

/// Number of terms of the reflectance, as in the paper.
const TERMS: usize = 10;
/// Number of directions per side of the reflectance table.
const TABLE: usize = 16;

/// Bunny with a factored reflectance, and transferred radiance made of waves with edges.
pub(super) fn factored_bunny() -> Result<System, StudyError> {
    let sampling = FactorSampling { side: TABLE, supersamples: Supersamples::NONE, ..FactorSampling::default() };
    let table = sampling.table(&Lobe::schlick(0.3, 0.5, 0.8), &mut |_, _| ())?;
    let reflectance = Reflectance::Factored(Factorization::new(&table, TERMS)?.factors(TERMS));
    let mesh = bunny();
    let (vertices, cameras) = (Vertices::new(&mesh, Tangents::Any)?, cameras(&mesh));
    let place = |at: usize| vertices.positions()[at].map(f64::from);
    let signal = signal_at(vertices.len(), 3 * reflectance.terms(), 5, place);
    let transferred = TransferredRadiance::new(reflectance.terms(), signal.values().as_chunks().0.to_vec());
    Ok(System::picture("All-frequency transfer: products of ten terms", move |input, profile, executor| {
        let mesh = TransferredMesh {
            vertices: &vertices,
            reflectance: &reflectance,
            colors: &[[0.9, 0.5, 0.7]],
            transferred: &transferred,
        };
        let place = ProductPlace::Pixels(ProductOptions::default());
        let card = FactoredCard::new(profile.clone(), executor.clone(), &[mesh], place);
        let view = MeshView { camera: cameras[input], exposure: 0.8, format: TexelFormat::Rgba32f };
        Ok(card.and_then(|mut card| card.view_texels(&view)).map_err(no_all_frequency_card)?.colors())
    }))
}
