//! Number formats varied one after the other, compared with the same picture in f64.

use refsim::texture::TexelFormat;
use strum::IntoEnumIterator;

use super::subject::BiScaleOnCard;
use crate::bi_scale::kernels::BlockEdges;
use crate::bi_scale::on_card::{DisplayOptions, LightFormat};
use crate::card::SeenPixel;
use crate::study::StudyError;
use crate::study::prt::card::PictureVariant;
use crate::study::prt::card::difference::{PixelErrors, held};

const FLOATS: TexelFormat = TexelFormat::Rgba32f;
const TEXELS: [TexelFormat; 3] = [TexelFormat::Rgba8, TexelFormat::Rgba16f, TexelFormat::Rgba32f];

/// Number formats of one frame: light, display options, target.
#[derive(Clone, Copy, Debug)]
struct CardDrawing {
    light: LightFormat,
    options: DisplayOptions,
    target: TexelFormat,
}

/// Single precision throughout.
const FINE: CardDrawing = CardDrawing {
    light: LightFormat::Fp32,
    options: DisplayOptions { edges: BlockEdges::Wrapped, texture: FLOATS, local: LightFormat::Fp32 },
    target: FLOATS,
};

fn ways() -> Vec<(&'static str, String, CardDrawing)> {
    let mut all = vec![("none", "fp32".to_owned(), FINE)];
    for light in LightFormat::iter().filter(|light| *light != FINE.light) {
        all.push(("light L", light.to_string(), CardDrawing { light, ..FINE }));
    }
    for local in LightFormat::iter().filter(|local| *local != FINE.options.local) {
        let options = DisplayOptions { local, ..FINE.options };
        all.push(("interpolated L~", local.to_string(), CardDrawing { options, ..FINE }));
    }
    for texture in TEXELS.into_iter().filter(|texture| *texture != FLOATS) {
        let options = DisplayOptions { texture, ..FINE.options };
        all.push(("bidirectional texture", texture.to_string(), CardDrawing { options, ..FINE }));
    }
    for target in TEXELS.into_iter().filter(|target| *target != FLOATS) {
        all.push(("target", target.to_string(), CardDrawing { target, ..FINE }));
    }
    let options = DisplayOptions { edges: BlockEdges::Touching, ..FINE.options };
    all.push(("blocks", "touching, with seams".to_owned(), CardDrawing { options, ..FINE }));
    all
}

/// Number of pictures of [`variants`].
pub(super) fn count() -> u64 {
    ways().len() as u64
}

/// Draws each variant on the study's card. Pixels are compared with equation 3 in f64 from L~ in f64.
pub(super) fn variants(
    study: &BiScaleOnCard,
    light: &[[f64; 3]],
    exact: &[[f64; 3]],
    seen: &[Option<SeenPixel>],
    exposure: f64,
    done: &mut dyn FnMut(u64),
) -> Result<Vec<PictureVariant>, StudyError> {
    let expected = study.exact(exact, seen, exposure);
    let mut variants = Vec::new();
    let mut local = study.local(light, FINE.light)?.local;
    let mut light_format = FINE.light;
    for (axis, choice, way) in ways() {
        if way.light != light_format {
            (light_format, local) = (way.light, study.local(light, way.light)?.local);
        }
        let drawn = study.draw(&local, way.options, way.target, exposure)?;
        let expected = held(&expected, !way.target.record().is_float());
        let errors = PixelErrors::of(seen, &drawn.pixels, &expected);
        variants.push(PictureVariant { axis, choice, errors, below_zero: None });
        done(variants.len() as u64);
    }
    Ok(variants)
}
