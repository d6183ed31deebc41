//! Distant light as coefficients of harmonics, one set per color channel.

use std::f64::consts::PI;

use glam::DVec3;

use super::extremes::least;
use super::harmonics::{MAX_ORDER, function_count, harmonics, order_of};
use crate::elementary::sin_cos;
use crate::error::{InputError, ensure, input_error};
use crate::quadrature::legendre_polynomials;

/// Distant radiance as coefficients, with the same order for red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicLight {
    channels: [Vec<f64>; 3],
}

impl HarmonicLight {
    /// Directions and radiances of the disks of [`Self::red_and_blue`].
    pub const RED_AND_BLUE_DISKS: [(DVec3, [f64; 3]); 2] =
        [(DVec3::new(0.8, 0.6, 0.0), [6.0, 0.3, 0.3]), (DVec3::new(-0.8, 0.6, 0.0), [0.3, 0.3, 6.0])];
    /// Angular radius of these disks, in radians.
    pub const RED_AND_BLUE_RADIUS: f64 = PI / 6.0;
    /// Radiance around these disks.
    pub const RED_AND_BLUE_SURROUNDING: [f64; 3] = [0.15; 3];

    /// Creates a light from coefficients by channel.
    pub fn new(channels: [Vec<f64>; 3]) -> Result<Self, InputError> {
        let found = channels.each_ref().map(Vec::len);
        let fits = (1..=MAX_ORDER).any(|order| found == [order * order; 3]);
        ensure!(fits, "expected n^2 coefficients in each of three channels, n from 1 to {MAX_ORDER}, found {found:?}");
        Ok(Self { channels })
    }

    pub(super) const fn projected(channels: [Vec<f64>; 3]) -> Self {
        Self { channels }
    }

    /// Creates a light from a function times a color.
    pub(super) fn colored(function: &[f64], color: [f64; 3]) -> Result<Self, InputError> {
        let found = color;
        ensure!(
            color.iter().all(|channel| channel.is_finite()),
            "expected finite red, green and blue, found {found:?}"
        );
        Ok(Self { channels: color.map(|channel| function.iter().map(|value| channel * value).collect()) })
    }

    /// Creates a light with constant radiance.
    pub fn constant(order: usize, radiance: [f64; 3]) -> Result<Self, InputError> {
        let mut function = vec![0.0; function_count(order)];
        function[0] = (4.0 * PI).sqrt();
        Self::colored(&function, radiance)
    }

    /// Creates a light with constant radiance from a disk around a direction of any length, with an angular radius of
    /// `radius` radians; black elsewhere. The coefficients are computed in closed form.
    pub fn disk(order: usize, direction: DVec3, radius: f64, radiance: [f64; 3]) -> Result<Self, InputError> {
        if !(radius > 0.0 && radius <= PI) {
            return Err(input_error!("expected an angular radius above 0 and up to pi radians, found {radius}"));
        }
        let mut function = vec![0.0; function_count(order)];
        harmonics(order, unit(direction)?, &mut function);
        for (l, integral) in cap_integrals(order, radius).into_iter().enumerate() {
            function[l * l..(l + 1) * (l + 1)].iter_mut().for_each(|y| *y *= 2.0 * PI * integral);
        }
        Self::colored(&function, radiance)
    }

    /// Creates a light from a red disk at +x and a blue disk at -x, both somewhat behind an object seen along +y, in
    /// dim white surroundings: similar to the light of Figure 7, which was not published.
    pub fn red_and_blue(order: usize) -> Self {
        let [red, blue] = Self::RED_AND_BLUE_DISKS
            .map(|(towards, color)| Self::disk(order, towards, Self::RED_AND_BLUE_RADIUS, color));
        let parts = [red, blue, Self::constant(order, Self::RED_AND_BLUE_SURROUNDING)];
        parts.into_iter().flatten().reduce(|sum, part| sum.plus(&part)).expect("three lights with finite figures")
    }

    /// Order n of the harmonics.
    pub fn order(&self) -> usize {
        order_of(&self.channels[0])
    }

    /// Coefficients of red, green and blue.
    pub const fn channels(&self) -> &[Vec<f64>; 3] {
        &self.channels
    }

    /// Radiance from a unit direction, evaluated from the coefficients, including ringing.
    pub fn radiance(&self, direction: DVec3) -> [f64; 3] {
        let mut y = [0.0; MAX_ORDER * MAX_ORDER];
        let y = &mut y[..self.channels[0].len()];
        harmonics(self.order(), direction, y);
        self.channels.each_ref().map(|channel| channel.iter().zip(y.iter()).map(|(c, y)| c * y).sum())
    }

    /// Sum of two lights, truncated to the lower order.
    pub fn plus(&self, other: &Self) -> Self {
        let sum = |channel: usize| {
            let both = self.channels[channel].iter().zip(&other.channels[channel]);
            both.map(|(a, b)| a + b).collect()
        };
        Self { channels: [0, 1, 2].map(sum) }
    }

    /// Minimum radiance of each channel; negative if the light rings.
    pub fn least(&self) -> [f64; 3] {
        self.channels.each_ref().map(|channel| least(channel).0)
    }
}

/// Normalises a direction.
pub(super) fn unit(direction: DVec3) -> Result<DVec3, InputError> {
    let length = direction.length();
    ensure!(length > 0.0 && length.is_finite(), "expected a direction of finite length above 0, found {direction}");
    Ok(direction / length)
}

/// Integrals of P_0 to P_(n-1) from cos(radius) to 1.
///
/// For l > 0 the integral is (1 - x^2) P_l'(x) / (l (l + 1)) at x = cos(radius), without cancellation even for small
/// disks.
fn cap_integrals(order: usize, radius: f64) -> Vec<f64> {
    let (sin, x) = sin_cos(radius);
    let (half, _) = sin_cos(radius / 2.0);
    let of_band = |(l, [_, slope]): (f64, [f64; 2])| sin * sin * slope / (l * (l + 1.0));
    let others = (1_u8..).map(f64::from).zip(legendre_polynomials(x).skip(1)).map(of_band);
    std::iter::once(2.0 * half * half).chain(others).take(order).collect()
}
