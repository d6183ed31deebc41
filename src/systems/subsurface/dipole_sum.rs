//! R_d for many distances at once, with vector instructions.

use std::f64::consts::PI;

use refsim::exec::batch::SimdLevel;

use super::Dipole;

/// Partial sums of a sum over distances.
const LANES: usize = 8;

/// R_d of the dipole, for many distances at once: `alpha' / (4 pi) sum over z of z (sigma_tr + 1/d) e^(-sigma_tr d) /
/// d^2`, where d^2 = r^2 + z^2.
#[derive(Clone, Copy, Debug)]
pub(super) struct DipoleSum {
    scale: f64,
    sigma_tr: f64,
    depths: [f64; 2],
}

impl DipoleSum {
    pub(super) fn new(dipole: &Dipole) -> Self {
        let scale = dipole.alpha_prime() / (4.0 * PI);
        Self { scale, sigma_tr: dipole.sigma_tr(), depths: [dipole.z_r(), dipole.z_v()] }
    }

    /// R_d at a squared distance.
    #[inline(always)]
    pub(super) fn at(&self, squared: f64) -> f64 {
        let mut sum = 0.0;
        for z in self.depths {
            let d = (squared + z * z).sqrt();
            let inverse = 1.0 / d;
            sum += z * inverse * ((self.sigma_tr + inverse) * inverse) * exp_of_negative(self.sigma_tr * d);
        }
        self.scale * sum
    }

    /// The sum of weight times R_d, in an order that does not depend on the width of the host's vectors.
    pub(super) fn sum(&self, squared: &[f64], weights: &[f64]) -> f64 {
        let sums = SimdLevel::widest().run(
            #[inline(always)]
            || {
                let mut sums = [0.0; LANES];
                let (mut distances, mut factors) = (squared.chunks_exact(LANES), weights.chunks_exact(LANES));
                for (squared, weights) in (&mut distances).zip(&mut factors) {
                    for lane in 0..LANES {
                        sums[lane] += weights[lane] * self.at(squared[lane]);
                    }
                }
                for (&squared, &weight) in distances.remainder().iter().zip(factors.remainder()) {
                    sums[0] += weight * self.at(squared);
                }
                sums
            },
        );
        let [a, b, c, d, e, f, g, h] = sums;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}

/// e^-x for x >= 0, within 4 units in the last place; e^-700 (1e-304) beyond. Compilers can vectorise this function.
#[inline(always)]
pub fn exp_of_negative(x: f64) -> f64 {
    const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
    const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
    // Adding 1.5 x 2^52 rounds to an integer, which is then in the last bits.
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    let x = if x < 700.0 { x } else { 700.0 };
    let shifted = x * std::f64::consts::LOG2_E + SHIFT;
    let halvings = shifted - SHIFT;
    let r = (halvings * LN_2_HIGH - x) + halvings * LN_2_LOW;
    let mut series = 1.0;
    for n in [13.0, 12.0, 11.0, 10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0] {
        series = 1.0 + series * (r * (1.0 / n));
    }
    let power = f64::from_bits((1023_u64.wrapping_sub(shifted.to_bits() & 0x7ff)) << 52);
    series * power
}
