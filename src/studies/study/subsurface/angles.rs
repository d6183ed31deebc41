//! Errors by the angle between surface and light: the lit side of a model dominates an RMS over all of it.

use glam::DVec3;

use super::Lighting;
use crate::atlas::Atlas;
use crate::elementary::acos;
use crate::picture::metrics::value_error;
use crate::subsurface::on_card::Light;

/// Number of bins of the angle, from 0 to 180 degrees.
const BINS: usize = 12;
const WIDTH: f64 = 180.0 / BINS as f64;

/// Error of radiosities in a bin, relative to the all-pairs sums in the bin; over all channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct BinError {
    /// Area-weighted mean radiosity relative to the mean over all pairs, minus 1.
    pub(super) mean: f64,
    /// RMS difference relative to the RMS radiosity over all pairs, weighted by area.
    pub(super) rms: f64,
}

/// Texels whose normals form an angle of `degrees[0]` to `degrees[1]` with the direction towards the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AngleBin {
    pub(super) degrees: [f64; 2],
    pub(super) area: f64,
    pub(super) radiosity: f64,
    /// The links' own error: the error of the host's sum over them.
    pub(super) links: BinError,
    pub(super) all: BinError,
}

/// The direction towards the light, if the only light is a single directional one.
pub(super) fn direction(lighting: &Lighting) -> Option<DVec3> {
    match lighting {
        Lighting::Lights(lights) => match lights[..] {
            [Light::Directional { towards, .. }] => DVec3::from(towards).try_normalize(),
            _ => None,
        },
        _ => None,
    }
}

/// Errors of two sets of radiosities per texel, the host's sum over links and the card's, compared with those over all
/// pairs. Bins without surface are omitted; texels without a normal belong to none.
pub(super) fn by_angle(
    atlas: &Atlas,
    towards: DVec3,
    truth: &[[f64; 3]],
    [links, card]: [&[[f64; 3]]; 2],
) -> Vec<AngleBin> {
    let mut sums = [Sums::default(); BINS];
    let mut surface = 0.0;
    for (at, texel) in atlas.texels().iter().enumerate() {
        surface += texel.area;
        if texel.area > 0.0 && texel.normal != DVec3::ZERO {
            let degrees = acos(texel.normal.dot(towards).clamp(-1.0, 1.0)).to_degrees();
            sums[((degrees / WIDTH) as usize).min(BINS - 1)].add(texel.area, truth[at], [links[at], card[at]]);
        }
    }
    let bin = |(at, sums): (usize, &Sums)| {
        let [links, all] = [0, 1].map(|of| sums.error(of));
        let degrees = [at, at + 1].map(|end| end as f64 * WIDTH);
        AngleBin { degrees, area: sums.area / surface, radiosity: sums.truth / (3.0 * sums.area), links, all }
    };
    sums.iter().enumerate().filter(|(_, sums)| sums.area > 0.0).map(bin).collect()
}

#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    area: f64,
    truth: f64,
    truth_squares: f64,
    differences: [f64; 2],
    squares: [f64; 2],
}

impl Sums {
    fn add(&mut self, area: f64, truth: [f64; 3], found: [[f64; 3]; 2]) {
        self.area += area;
        for (channel, truth) in truth.into_iter().enumerate() {
            self.truth += area * truth;
            self.truth_squares += area * truth * truth;
            for (of, found) in found.iter().enumerate() {
                let difference = value_error(found[channel], truth);
                self.differences[of] += area * difference;
                self.squares[of] += area * difference * difference;
            }
        }
    }

    fn error(&self, of: usize) -> BinError {
        let over = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        let squares = over(self.squares[of], self.truth_squares);
        BinError { mean: over(self.differences[of], self.truth), rms: squares.sqrt() }
    }
}
