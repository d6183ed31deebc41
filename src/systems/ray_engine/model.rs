//! Cost equations of the paper (section 6.1): throughput for R rays and T triangles from a card's fill and read-back
//! rates.
//!
//! These are plain f64 estimates; the emulator's timing model counts in whole picoseconds.

/// The two rates of equation 11.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostRates {
    /// Pixels per second, including the pixel program; above 0.
    pub fill_pixels_per_s: f64,
    /// Bytes per second from the card to the host; above 0, and infinite for a card whose results are not read back.
    pub readback_bytes_per_s: f64,
}

impl CostRates {
    /// Equation 11: seconds to test `triangles` against `rays`, with `gamma` bytes read back per ray. Section 6.1
    /// prints 4 for "a single 64-bit triangle ID", which has 8 bytes; its rates follow from 4.
    pub fn seconds(&self, rays: f64, triangles: f64, gamma: f64) -> f64 {
        triangles * rays / self.fill_pixels_per_s + rays * gamma / self.readback_bytes_per_s
    }

    /// Equation 11 solved for tests per second, which does not depend on the number of rays.
    pub fn tests_per_s(&self, triangles: f64, gamma: f64) -> f64 {
        triangles / self.seconds(1.0, triangles, gamma)
    }

    /// Results per second if read-back were the only cost.
    pub fn results_per_s(&self, gamma: f64) -> f64 {
        self.readback_bytes_per_s / gamma
    }

    /// Number of triangles at which half the fill rate is reached, because drawing takes as long as read-back.
    pub fn half_rate_triangles(&self, gamma: f64) -> f64 {
        self.fill_pixels_per_s * gamma / self.readback_bytes_per_s
    }

    /// `T_min`: smallest number of triangles at which the card is at least as fast as a host of `host_tests_per_s`;
    /// `None` if the host is at least as fast as the card for any number.
    pub fn least_triangles(&self, host_tests_per_s: f64, gamma: f64) -> Option<u32> {
        let gained = host_tests_per_s.recip() - self.fill_pixels_per_s.recip();
        (gained > 0.0).then(|| (gamma / self.readback_bytes_per_s / gained).ceil().max(1.0) as u32)
    }
}
