//! Second-order Taylor expansion of the light of far clusters in the receiver's position.

use glam::DVec3;

use super::moments::{Covariance, Moments};

/// N channels of light by the offset of a receiver from a center: value, gradient and second derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expansion<const N: usize> {
    pub(super) channels: [Taylor; N],
}

/// The terms of one channel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taylor {
    pub(super) value: f64,
    pub(super) gradient: DVec3,
    /// The matrix of second derivatives.
    pub(super) second: Covariance,
}

impl<const N: usize> Default for Expansion<N> {
    fn default() -> Self {
        Self { channels: [Taylor::default(); N] }
    }
}

impl<const N: usize> Expansion<N> {
    pub(super) fn add(&mut self, other: &Self) {
        for (sum, term) in self.channels.iter_mut().zip(&other.channels) {
            sum.value += term.value;
            sum.gradient += term.gradient;
            sum.second = sum.second.plus(&term.second);
        }
    }

    pub(super) fn mean_over(&self, receiver: &Moments, center: DVec3) -> [f64; N] {
        let offset = receiver.point - center;
        let spread = receiver.covariance.plus(&Covariance::of([(1.0, offset)]));
        self.channels.map(|Taylor { value, gradient, second }| {
            value + gradient.dot(offset) + 0.5 * second.product_trace(&spread)
        })
    }
}
