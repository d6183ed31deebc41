//! Errors by the angle between surface and light: a root mean square over the model is made by its lit side.

use glam::DVec3;

use super::Lighting;
use crate::atlas::Atlas;
use crate::elementary::acos;
use crate::picture::metrics::value_error;
use crate::subsurface::on_card::Light;

/// Bins of the angle from 0 to 180 degrees.
const BINS: usize = 12;
/// Degrees of a bin.
const WIDTH: f64 = 180.0 / BINS as f64;

/// Error of radiosities in a bin, relative to those over all pairs there; over all channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BinError {
    /// The mean radiosity by area over that of all pairs, less 1.
    pub mean: f64,
    /// Root of the mean squared difference by area over that of the squared radiosity of all pairs.
    pub rms: f64,
}

/// Texels whose normals are at an angle of `degrees[0]` to `degrees[1]` from the direction towards the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngleBin {
    /// The bin's ends, in degrees.
    pub degrees: [f64; 2],
    /// Share of the model's area, above 0.
    pub area: f64,
    /// Mean of B by area and channel, over all pairs.
    pub radiosity: f64,
    /// The links' own error: the host's sum over them.
    pub links: BinError,
    /// Links and card together.
    pub all: BinError,
}

/// The direction towards the light, if there is a single directional one and nothing else.
pub(super) fn direction(lighting: &Lighting) -> Option<DVec3> {
    match lighting {
        Lighting::Lights(lights) => match lights[..] {
            [Light::Directional { towards, .. }] => DVec3::from(towards).try_normalize(),
            _ => None,
        },
        _ => None,
    }
}

/// Errors of two sets of radiosities per texel, the host's sum over links and the card's, against those over all pairs.
/// Bins without surface are left out; texels without a normal belong to none.
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

/// Sums over the texels of a bin, by area, over all channels.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Mesh;

    /// A cube's sides lie at 0, 90 and 180 degrees; an error on one of them is an error of its bin alone.
    #[test]
    fn errors_are_told_by_angle() {
        let corners: Vec<[f32; 3]> = (0..8_u8).map(|i| [0, 1, 2].map(|axis| f32::from(i >> axis & 1))).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let outwards =
            [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
        // A vertex with the side's normal per corner of a side keeps the sides flat.
        let flat = quads.iter().flatten().map(|&corner: &usize| corners[corner]).collect();
        let normals: Vec<[f32; 3]> = outwards.iter().flat_map(|&normal| [normal; 4]).collect();
        let faces = (0..6_u32)
            .flat_map(|side| [[4 * side, 4 * side + 1, 4 * side + 2], [4 * side, 4 * side + 2, 4 * side + 3]]);
        let cube = Mesh::new(flat, faces.collect()).and_then(|cube| cube.with_normals(normals)).expect("a cube");
        let atlas = Atlas::new(&cube, 8).expect("an atlas");
        let is_dark = |texel: &crate::atlas::Texel| texel.normal.z < -0.5;
        let truth: Vec<[f64; 3]> = atlas.texels().iter().map(|_| [1.0, 2.0, 1.0]).collect();
        let links: Vec<[f64; 3]> =
            atlas.texels().iter().map(|t| if is_dark(t) { [1.5, 3.0, 1.5] } else { [1.0, 2.0, 1.0] }).collect();
        let bins = by_angle(&atlas, DVec3::Z, &truth, [&links, &truth]);
        let ends: Vec<[f64; 2]> = bins.iter().map(|bin| bin.degrees).collect();
        assert_eq!(ends, [[0.0, 15.0], [90.0, 105.0], [165.0, 180.0]]);
        let areas: Vec<f64> = bins.iter().map(|bin| (bin.area * 6.0).round()).collect();
        assert_eq!(areas, [1.0, 4.0, 1.0]);
        assert!((bins[2].links.mean - 0.5).abs() < 1e-12 && (bins[2].links.rms - 0.5).abs() < 1e-12, "{bins:?}");
        assert_eq!([bins[0].links, bins[1].links, bins[2].all], [BinError::default(); 3]);
        assert!(bins.iter().all(|bin| (bin.radiosity - 4.0 / 3.0).abs() < 1e-12));
        let lights = |lights: &[Light]| direction(&Lighting::Lights(lights.to_vec()));
        let sun = Light::Directional { towards: [0.0, 0.0, 2.0], irradiance: [1.0; 3] };
        assert_eq!(lights(&[sun]), Some(DVec3::Z));
        assert_eq!(lights(&[sun, Light::Sky { radiance: [1.0; 3] }]), None, "a sky shines from everywhere");
    }
}
