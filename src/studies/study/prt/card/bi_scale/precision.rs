//! One thing after the other held in fewer bits, against the same picture in f64.

use refsim::texture::TexelFormat;
use strum::IntoEnumIterator;

use super::subject::{BiScaleCardStudyError, BiScaleOnCard};
use crate::bi_scale::kernels::BlockEdges;
use crate::bi_scale::on_card::{DisplayOptions, LightFormat, LocalFormat};
use crate::card::SeenPixel;
use crate::report::Table;
use crate::study::prt::card::difference::{PixelErrors, held};

const FLOATS: TexelFormat = TexelFormat::Rgba32f;
const TEXELS: [TexelFormat; 3] = [TexelFormat::Rgba8, TexelFormat::Rgba16f, TexelFormat::Rgba32f];

/// A way to hold the numbers of a frame.
#[derive(Clone, Copy, Debug)]
struct Way {
    light: LightFormat,
    options: DisplayOptions,
    target: TexelFormat,
}

/// All in single precision.
const FINE: Way = Way {
    light: LightFormat::Fp32,
    options: DisplayOptions { edges: BlockEdges::Wrapped, texture: FLOATS, local: LocalFormat::Fp32 },
    target: FLOATS,
};

fn ways() -> Vec<(&'static str, String, Way)> {
    let mut all = vec![("none", "fp32".to_owned(), FINE)];
    for light in LightFormat::iter().filter(|light| *light != FINE.light) {
        all.push(("light L", light.to_string(), Way { light, ..FINE }));
    }
    for local in LocalFormat::iter().filter(|local| *local != FINE.options.local) {
        let options = DisplayOptions { local, ..FINE.options };
        all.push(("interpolated L~", local.to_string(), Way { options, ..FINE }));
    }
    for texture in TEXELS.into_iter().filter(|texture| *texture != FLOATS) {
        let options = DisplayOptions { texture, ..FINE.options };
        all.push(("bidirectional texture", texture.to_string(), Way { options, ..FINE }));
    }
    for target in TEXELS.into_iter().filter(|target| *target != FLOATS) {
        all.push(("target", target.to_string(), Way { target, ..FINE }));
    }
    let options = DisplayOptions { edges: BlockEdges::Touching, ..FINE.options };
    all.push(("blocks", "touching, with seams".to_owned(), Way { options, ..FINE }));
    all
}

/// How many pictures [`precision`] draws.
pub(super) fn count() -> u64 {
    ways().len() as u64
}

/// What was found: how far each way is off, root mean square in 255ths, and its name.
pub(super) struct Precision {
    pub(super) table: Table,
    pub(super) worst: (String, f64),
}

/// Draws each way on the study's card. Pixels are compared with equation 3 in f64 from L~ in f64.
pub(super) fn precision(
    study: &BiScaleOnCard,
    (light, exact): (&[[f64; 3]], &[[f64; 3]]),
    (seen, exposure): (&[Option<SeenPixel>], f64),
    done: &mut dyn FnMut(u64),
) -> Result<Precision, BiScaleCardStudyError> {
    let expected = study.exact(exact, (seen, exposure), BlockEdges::Wrapped);
    let mut table = Table::of("What shows", "what choice rms_255ths largest_255ths visible_%");
    let mut worst = (String::new(), 0.0);
    let mut local = study.local(light, FINE.light)?.local;
    let mut light_format = FINE.light;
    for (number, (axis, choice, way)) in ways().into_iter().enumerate() {
        if way.light != light_format {
            (light_format, local) = (way.light, study.local(light, way.light)?.local);
        }
        let drawn = study.draw(&local, (way.options, way.target), exposure)?;
        let expected = held(&expected, !way.target.record().is_float());
        let errors = PixelErrors::of(seen, &drawn.pixels, &expected);
        if errors.off_255ths[0] > worst.1 {
            worst = (format!("{axis}: {choice}"), errors.off_255ths[0]);
        }
        let [rms, largest, visible] = errors.cells();
        table.push([axis.into(), choice.into(), rms, largest, visible]);
        done(number as u64 + 1);
    }
    Ok(Precision { table, worst })
}
