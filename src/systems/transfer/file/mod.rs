//! Files of transfer: NumPy's archives of arrays (`.npz`), with metadata as JSON. docs/npz.md describes the contents.
//!
//! [`PrtFile`] is the low-frequency kind: transfer of a mesh, its clusters, or both.

mod arrays;
mod digest;
pub(crate) mod kind;

use serde::{Deserialize, Serialize};

pub use arrays::{load_prt, parse_prt, save_prt, write_prt};
pub use digest::{MeshDigest, require_mesh};
pub use kind::PrtKind;

use crate::clustering::Clustering;
use crate::clustering::Signal;

/// Largest size of a file that is read, in bytes (4 GiB).
pub const MAX_BYTES: u64 = 1 << 32;

/// Maximum length of a line of text in a file, in bytes.
const MAX_LINE: usize = 4096;

/// The contents of a file of low-frequency transfer.
#[derive(Clone, Debug, PartialEq)]
pub struct PrtFile {
    /// The meaning of the numbers of a point.
    pub meaning: PrtMeaning,
    /// The mesh whose vertices are the points, if there is one; it has one vertex per point.
    pub mesh: Option<MeshDigest>,
    /// The uncompressed numbers.
    pub transfer: Option<Signal>,
    /// The compressed numbers.
    pub clustering: Option<Clustering>,
    /// Provenance of the numbers: one line of at most 4,096 bytes without control characters.
    pub provenance: Option<String>,
}

/// The meaning of the numbers of a point.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PrtMeaning {
    /// Numbers of unknown meaning.
    Numbers {
        /// Numbers per point.
        dimension: u32,
    },
    /// One transfer matrix per channel: channel by channel, row by row.
    Transfer {
        /// Number of channels: 1, or 3 for red, green and blue.
        channels: u32,
        /// For each row, the index l(l+1)+m of the function of exit radiance, increasing; `[0]` for diffuse transfer.
        exit_functions: Vec<u16>,
        /// The order n of the light: n^2 columns.
        light_order: u32,
        /// True if the numbers include the surface's albedo; otherwise they must be multiplied by it.
        includes_albedo: bool,
    },
}

impl PrtMeaning {
    /// Numbers per point; `None` if they overflow.
    pub fn dimension(&self) -> Option<usize> {
        match self {
            Self::Numbers { dimension } => usize::try_from(*dimension).ok(),
            Self::Transfer { channels, exit_functions, light_order, .. } => {
                let columns = usize::try_from(*light_order).ok()?.checked_pow(2)?;
                usize::try_from(*channels).ok()?.checked_mul(exit_functions.len())?.checked_mul(columns)
            }
        }
    }

    fn shape(&self, points: usize) -> Vec<usize> {
        match self {
            Self::Numbers { dimension } => vec![points, *dimension as usize],
            Self::Transfer { channels, exit_functions, light_order, .. } => {
                let columns = (*light_order as usize).pow(2);
                vec![points, *channels as usize, exit_functions.len(), columns]
            }
        }
    }

    /// The first invalid value: the field, the expected and the found value.
    fn fault(&self) -> Option<(&'static str, &'static str, String)> {
        let Self::Transfer { channels, exit_functions, light_order, .. } = self else {
            return (*self == Self::Numbers { dimension: 0 }).then(|| ("numbers per point", "some", "none".to_owned()));
        };
        if ![1, 3].contains(channels) {
            return Some(("channels", "1 or 3", channels.to_string()));
        }
        if !(1..=MAX_ORDER).contains(light_order) {
            return Some(("light order", "1 to 10", light_order.to_string()));
        }
        let increasing = exit_functions.windows(2).all(|pair| pair[0] < pair[1]);
        let last = exit_functions.last().map(|&last| u32::from(last));
        if !increasing || last.is_none_or(|last| last >= MAX_ORDER * MAX_ORDER) {
            let found = format!("{} functions", exit_functions.len());
            return Some(("exit functions", "at least one of 0 to 99, in increasing order", found));
        }
        None
    }
}

/// Removes `count` values from the front. Panics if there are fewer.
pub(crate) fn front<T: Clone>(values: &mut &[T], count: usize) -> Vec<T> {
    let (front, rest) = values.split_at(count);
    *values = rest;
    front.to_vec()
}

/// The largest order of harmonics.
const MAX_ORDER: u32 = 10;

impl PrtFile {
    /// Number of points of the transfer, or else of the clustering.
    pub fn points(&self) -> usize {
        let transfer = self.transfer.as_ref().map(Signal::points);
        transfer.or(self.clustering.as_ref().map(Clustering::points)).unwrap_or(0)
    }

    /// The first inconsistency between the parts: the field, the expected and the found value.
    fn fault(&self) -> Option<(&'static str, String, String)> {
        if let Some((field, expected, found)) = self.meaning.fault() {
            return Some((field, expected.to_owned(), found));
        }
        let transfer = self.transfer.as_ref().map(|t| (t.points(), t.dimension()));
        let clustering = self.clustering.as_ref().map(|c| (c.points(), c.dimension()));
        let shape = |(points, dimension): (usize, usize)| format!("{points} points of {dimension} numbers");
        let Some(first) = transfer.or(clustering) else {
            return Some(("contents", "transfer or clusters".to_owned(), "neither".to_owned()));
        };
        if let Some(second) = clustering.filter(|&second| second != first) {
            return Some(("clusters", shape(first), shape(second)));
        }
        if let Some(mesh) = self.mesh.filter(|mesh| mesh.vertices as usize != first.0) {
            return Some(("vertices of the mesh", first.0.to_string(), mesh.vertices.to_string()));
        }
        let expected = self.meaning.dimension().map_or(usize::MAX, |dimension| dimension);
        if first.1 != expected {
            return Some(("numbers per point", expected.to_string(), first.1.to_string()));
        }
        line_fault("provenance", self.provenance.as_deref())
    }
}

/// The fault of a field that is not one line of text.
pub(crate) fn line_fault(field: &'static str, line: Option<&str>) -> Option<(&'static str, String, String)> {
    let line = line?;
    let is_line = (1..=MAX_LINE).contains(&line.len()) && !line.chars().any(char::is_control);
    let expected = || format!("a line of 1 to {MAX_LINE} bytes without control characters");
    (!is_line).then(|| (field, expected(), format!("{} bytes", line.len())))
}
