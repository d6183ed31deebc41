//! The host that section 7 times frames with.

use refsim::timing::host::{HostCounts, HostError, HostModel, HostOperation};

use super::model::TransferSize;

/// The uncompressed head of section 7, whose matrices the host of 2.2 GHz multiplies by the light, every one of them.
const HEAD: TransferSize = TransferSize { vertices: 50_060, rows: 25, columns: 25, clusters: 0, vectors: 0 };
/// Its frames in a number of seconds: 2.9 frames per second is the one figure by which the host is calibrated.
const HEAD_FRAMES: u64 = 29;
const HEAD_SECONDS: u64 = 10;

/// The host of section 7, with the speed at which the uncompressed head gets its 2.9 frames per second.
///
/// # Errors
/// None for the printed figures.
pub fn host_of_section_7() -> Result<HostModel, HostError> {
    let work = HEAD_FRAMES * HEAD.uncompressed_multiply_adds() as u64;
    HostModel::calibrate(&HostCounts::default().with(HostOperation::MultiplyAdd, work), HEAD_SECONDS, 1)
}
