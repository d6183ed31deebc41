//! Parameters of the study.

use refsim::device::Profile;

use super::file::MeasuredCase;

/// Columns of codes.
pub(super) const CODES: [&str; 5] = ["red", "green", "blue", "alpha", "depth"];

/// Measured pixels, compared with a device.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Name of the table.
    pub name: String,
    /// Cases with their measured pixels.
    pub cases: Vec<MeasuredCase>,
    /// Device, with the known switches set.
    pub profile: Profile,
    /// Switches that are known, by name, with their values in `profile`.
    pub known: Vec<(String, String)>,
}
