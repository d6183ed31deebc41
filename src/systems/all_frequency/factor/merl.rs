//! Measured reflectance in the files of Matusik, Pfister, Brand and McMillan 2003 (MERL): `.binary`.
//!
//! Three 32-bit integers, 90, 90 and 180, then three channels of 90 x 90 x 180 64-bit floats, all little-endian. The
//! dimensions are the angle of the half vector from the normal (denser near it), that of the light from the half
//! vector, and the azimuth around the half vector over 180 degrees.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use glam::DVec3;

use super::motion::ProductSymmetry;
use super::product::ProductFunction;
use crate::elementary::{acos, atan2};
use crate::error::{InputError, input_error};
use crate::io::read_file;

/// Number of cells by half angle, difference angle and azimuth.
pub const MERL_CELLS: [usize; 3] = [90, 90, 180];

/// Number of cells of a channel.
const CELLS: usize = MERL_CELLS[0] * MERL_CELLS[1] * MERL_CELLS[2];
/// Bytes of the three integers.
const HEADER: usize = 12;
/// Bytes of a file.
const BYTES: usize = HEADER + 3 * CELLS * 8;
/// Factors of the stored numbers of red, green and blue.
const SCALES: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

/// A channel of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum MerlChannel {
    /// The first in the file.
    Red,
    /// The second in the file.
    Green,
    /// The third in the file.
    Blue,
}

/// Measured isotropic reflectance.
#[derive(Clone, Debug, PartialEq)]
pub struct MerlBrdf {
    cells: Vec<f64>,
    /// Number of negative cells over all channels, which were not measured. They count as 0.
    pub invalid: usize,
}

fn short_error(path: &Path, expected: usize, found: usize) -> InputError {
    input_error!("crossbar::merl::short" =>
        "expected {expected} bytes of a MERL measurement, found {found}"; help "the file is cut; fetch it again")
    .at(path)
}

/// Reads a measurement from bytes; `name` is the file's name in messages.
///
/// # Errors
/// [`InputError`].
pub fn parse_merl(bytes: &[u8], name: &Path) -> Result<MerlBrdf, InputError> {
    let (expected, found) = (BYTES, bytes.len());
    let Some((header, data)) = bytes.split_at_checked(HEADER) else {
        return Err(short_error(name, expected, found));
    };
    let mut sizes = [0; 3];
    sizes.iter_mut().zip(header.as_chunks().0).for_each(|(size, bytes)| *size = i32::from_le_bytes(*bytes));
    if sizes.map(|size| usize::try_from(size).unwrap_or(0)) != MERL_CELLS {
        return Err(input_error!("crossbar::merl::cells" =>
            "expected 90 x 90 x 180 cells, found {} x {} x {}", sizes[0], sizes[1], sizes[2];
            help "only isotropic measurements of this size are read")
        .at(name));
    }
    if found < expected {
        return Err(short_error(name, expected, found));
    }
    if found > expected {
        return Err(input_error!("crossbar::merl::long" =>
            "expected {expected} bytes of a MERL measurement, found {found}";
            help "is it a measurement of another kind?")
        .at(name));
    }
    let mut cells: Vec<f64> = data.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    if let Some(at) = cells.iter().position(|value| !value.is_finite()) {
        let (channel, cell, found) = (at / CELLS, at % CELLS, cells[at]);
        return Err(input_error!("crossbar::merl::number" =>
            "expected finite numbers, found {found} in cell {cell} of channel {channel} (both from 0)";
            help "cells that were not measured are below 0")
        .at(name));
    }
    let mut invalid = 0;
    for (cells, scale) in cells.chunks_exact_mut(CELLS).zip(SCALES) {
        for value in cells {
            invalid += usize::from(*value < 0.0);
            *value = value.max(0.0) * scale;
        }
    }
    Ok(MerlBrdf { cells, invalid })
}

/// Reads a measurement from a file.
///
/// # Errors
/// [`InputError`].
pub fn load_merl(path: &Path) -> Result<MerlBrdf, InputError> {
    parse_merl(&read_file(path, "MERL measurement", BYTES as u64)?, path)
}

impl MerlBrdf {
    /// One channel, as a product function.
    pub const fn channel(&self, channel: MerlChannel) -> MerlProduct<'_> {
        MerlProduct { brdf: self, channel }
    }

    /// The reflectance of a channel, in 1/sr: that of the nearest cell, not interpolated, as in the reader published
    /// with the measurements. Both directions have length 1 and lie above the horizon.
    pub fn value(&self, channel: MerlChannel, view: DVec3, light: DVec3) -> f64 {
        let half = (view + light).normalize_or(DVec3::Z);
        let radius = (half.x * half.x + half.y * half.y).sqrt();
        let [cosine, sine] = if radius > 0.0 { [half.x / radius, half.y / radius] } else { [1.0, 0.0] };
        // Rotate the light so that the half vector coincides with the normal.
        let around = DVec3::new(-sine, cosine, 0.0);
        let along = DVec3::new(half.z * cosine, half.z * sine, -radius);
        let [x, y, z] = [along.dot(light), around.dot(light), half.dot(light)];
        let azimuth = atan2(y, x);
        // By reciprocity light and view may be exchanged, which rotates the azimuth by half a turn.
        let azimuth = if azimuth < 0.0 { azimuth + PI } else { azimuth };
        let share = |angle: f64| acos(angle.clamp(-1.0, 1.0)) / FRAC_PI_2;
        let at = [share(half.z).sqrt(), share(z), azimuth / PI];
        let [half, difference, azimuth] =
            [0, 1, 2].map(|i| ((at[i] * MERL_CELLS[i] as f64) as usize).min(MERL_CELLS[i] - 1));
        let cell = (half * MERL_CELLS[1] + difference) * MERL_CELLS[2] + azimuth;
        self.cells[channel as usize * CELLS + cell]
    }
}

/// A channel of a measurement as a product function.
#[derive(Clone, Copy, Debug)]
pub struct MerlProduct<'a> {
    brdf: &'a MerlBrdf,
    channel: MerlChannel,
}

impl ProductFunction for MerlProduct<'_> {
    fn value(&self, view: DVec3, light: DVec3) -> f64 {
        self.brdf.value(self.channel, view, light) * light.z
    }

    fn continues(&self) -> bool {
        false
    }

    fn symmetry(&self) -> ProductSymmetry {
        ProductSymmetry::Turns
    }

    fn name(&self) -> &'static str {
        "a measurement"
    }
}
