//! A model with bi-scale transfer and textures, with a light and a camera.

use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::on_card::{DisplayOptions, LightFormat, TexturedMesh};
use crate::bi_scale::paper;
use crate::bi_scale::texture::BidirectionalTexture;
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::error::InputError;
use crate::study::StudyError;
use crate::study::prt::LitView;
use crate::study::prt::card::CardSetting;
use crate::transfer::Vertices;
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::light::DistantLight;

/// A model with biclusters of its transfer, bidirectional textures, a light and a camera, and the card.
#[derive(Debug)]
pub struct BiScaleOnCard {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's vertices.
    pub vertices: Vertices,
    /// Texture coordinates of each corner, triangle by triangle; one unit is one patch.
    pub coordinates: Vec<[[f32; 2]; 3]>,
    /// Transfer from the light to the textures' directions of light.
    pub biclusters: Biclustering,
    /// The textures.
    pub textures: Vec<BidirectionalTexture>,
    /// Texture index per triangle.
    pub texture_of: Vec<u32>,
    /// The light.
    pub light: DistantLight,
    /// The card that draws.
    pub card: CardSetting,
    /// Format of light on the card.
    pub light_format: LightFormat,
    /// Options of the display.
    pub options: DisplayOptions,
}

impl BiScaleOnCard {
    pub(super) fn mesh(&self) -> TexturedMesh<'_> {
        let Self { vertices, coordinates, textures, texture_of, .. } = self;
        TexturedMesh { vertices, coordinates, textures, texture_of }
    }

    /// The directions of light of a texture.
    pub(super) fn directions(&self) -> usize {
        self.textures.first().map_or(0, |texture| texture.light().directions().len())
    }

    /// Rejects biclusters of other vertices, directions or light.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        let [rows, columns] = self.biclusters.matrix_size();
        let expected = self.vertices.len() * self.directions();
        for (what, expected, found) in [
            ("vertices times the texture's directions of light", expected, rows),
            ("light texels", LIGHT_TEXELS, columns),
        ] {
            if expected != found {
                let what = format!("expected transfer of {expected} {what}, found {found}");
                let help = "precompute transfer with as many `--directions` as the texture has for light";
                return Err(StudyError::new("crossbar::prt::bi_scale", what).with_help(help));
            }
        }
        Ok(())
    }

    /// L: red, green and blue of each light texel, multiplied by its solid angle.
    pub(super) fn light_texels(&self) -> Result<Vec<[f64; 3]>, InputError> {
        let cube = self.light.cube()?;
        Ok(side_by_side(light_vectors(&cube)))
    }

    /// L~ in f64.
    pub(super) fn exact_local(&self, light: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let channel = |channel: usize| {
            paper::multiply(&self.biclusters, &light.iter().map(|texel| texel[channel]).collect::<Vec<f64>>())
        };
        side_by_side([0, 1, 2].map(channel))
    }
}
