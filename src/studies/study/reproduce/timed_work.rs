//! Work of a system with its modelled time.

use refsim::timing::Picoseconds;

use super::{StudyError, printed};

/// Work of a system with its modelled time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedWork {
    /// Name of the printed figure, as in `radiosity/jacobi-rate`.
    pub figure: &'static str,
    /// Printed value, with its unit and its section of the paper.
    pub printed: String,
    /// Card.
    pub device: &'static str,
    /// Number of items, such as ray-triangle tests; 1 for a frame or a pass.
    pub items: u64,
    /// Modelled time of all items.
    pub time: Picoseconds,
}

impl TimedWork {
    pub(super) fn new(figure: &'static str, device: &'static str, time: Picoseconds) -> Result<Self, StudyError> {
        let found = printed(figure)?;
        let printed = format!("{} {} ({})", found.text(), found.unit, found.place);
        Ok(Self { figure, printed, device, items: 1, time })
    }
}
