//! All-frequency transfer: products with view maps per pixel.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use super::run::{SystemInput, SystemRun, bunny, cameras};
use crate::all_frequency::Reflectance;
use crate::all_frequency::factor::{FactorSampling, Factorization, Lobe, Supersamples};
use crate::all_frequency::on_card::{FactoredCard, ProductOptions, ProductPlace, TransferredMesh};
use crate::all_frequency::shade::TransferredRadiance;
use crate::card::MeshView;
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::prt::no_all_frequency_card;
use crate::transfer::synthetic::signal_at;
use crate::transfer::{Tangents, Vertices};

/// Number of terms of the reflectance, as in the paper.
const TERMS: usize = 10;
/// Number of directions per side of the reflectance table.
const TABLE: usize = 16;

/// Bunny with a factored reflectance, and transferred radiance made of waves with edges.
#[derive(Debug)]
pub(super) struct FactoredBunny {
    vertices: Vertices,
    reflectance: Reflectance,
    transferred: TransferredRadiance,
    cameras: [Camera; 2],
}

impl FactoredBunny {
    pub(super) fn new() -> Result<Self, StudyError> {
        let sampling = FactorSampling { side: TABLE, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        let table = sampling.table(&Lobe::schlick(0.3, 0.5, 0.8), &mut |_, _| ())?;
        let reflectance = Reflectance::Factored(Factorization::new(&table, TERMS)?.factors(TERMS));
        let mesh = bunny();
        let vertices = Vertices::new(&mesh, Tangents::Any)?;
        let place = |at: usize| vertices.positions()[at].map(f64::from);
        let signal = signal_at(vertices.len(), 3 * reflectance.terms(), 5, place);
        let transferred = TransferredRadiance::new(reflectance.terms(), signal.values().as_chunks().0.to_vec());
        Ok(Self { vertices, reflectance, transferred, cameras: cameras(&mesh) })
    }
}

impl SystemRun for FactoredBunny {
    fn title(&self) -> &'static str {
        "All-frequency transfer: products of ten terms"
    }

    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError> {
        let Self { vertices, reflectance, transferred, .. } = self;
        let mesh = TransferredMesh { vertices, reflectance, colors: &[[0.9, 0.5, 0.7]], transferred };
        let place = ProductPlace::Pixels(ProductOptions::default());
        let card = FactoredCard::new(profile.clone(), executor.clone(), &[mesh], place);
        let view = MeshView { camera: self.cameras[input as usize], exposure: 0.8, format: TexelFormat::Rgba32f };
        Ok(card.and_then(|mut card| card.view_texels(&view)).map_err(no_all_frequency_card)?.colors())
    }
}
