//! The `.prt` file: transfer of a mesh, its clusters, or both, with all conventions in its header. docs/prt-format.md
//! specifies it.
//!
//! Checksums cover every byte; a file is read completely or refused. Equal contents have equal bytes.

mod digest;
mod error;
mod kind;
pub(crate) mod read;
pub(crate) mod write;

pub use digest::MeshDigest;
pub use error::other_mesh_error;
pub use kind::PrtKind;
pub use read::{load_prt, parse_prt};
pub use write::{save_prt, write_prt};

use super::Signal;
use super::clustering::Clustering;

/// The first bytes of a file: they are no valid text, and are changed by programs that convert line ends.
pub const MAGIC: &[u8; 8] = b"\x89PRT\r\n\x1a\n";
/// The version of all files but those of bi-scale transfer with tables of values.
pub const VERSION: u32 = 1;
/// Largest size of a file that is read, in bytes (4 GiB).
pub const MAX_BYTES: u64 = 1 << 32;

/// Codes of [`Tangents`](crate::transfer::Tangents); 0 without a mesh.
const ANY_TANGENTS: u32 = 1;
const TEXTURE_TANGENTS: u32 = 2;
const AXIS_TANGENTS: u32 = 3;

const TRANSFER: &[u8; 4] = b"TRAN";
const CLUSTERING: &[u8; 4] = b"CLUS";
const SUPERCLUSTERS: &[u8; 4] = b"SUPR";
const PROVENANCE: &[u8; 4] = b"MADE";

/// Sections in their order.
const SECTIONS: [&[u8; 4]; 4] = [TRANSFER, CLUSTERING, SUPERCLUSTERS, PROVENANCE];

/// Longest line that says how a file was made, in bytes.
const MAX_PROVENANCE: usize = 4096;

/// The contents of a `.prt` file.
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
    /// Per cluster the supercluster that it is drawn in, if that was decided beforehand: numbered from 0 in the order
    /// of their lowest clusters.
    pub superclusters: Option<Vec<u32>>,
    /// How the numbers were made: one line of at most 4,096 bytes without control characters.
    pub provenance: Option<String>,
}

/// The meaning of the numbers of a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PrtMeaning {
    /// Numbers without a meaning.
    Numbers {
        /// How many per point.
        dimension: u32,
    },
    /// One transfer matrix per channel: channel by channel, row by row.
    Transfer {
        /// 1 or 3 (red, green, blue).
        channels: u32,
        /// Per row the index l(l+1)+m of the function of exit radiance, increasing; `[0]` for diffuse transfer.
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

    /// The first invalid value: the field, the expected and the found value.
    fn fault(&self) -> Option<(&'static str, &'static str, String)> {
        let Self::Transfer { channels, exit_functions, light_order, .. } = self else {
            return None;
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

/// The largest order of harmonics.
const MAX_ORDER: u32 = 10;

impl PrtFile {
    /// Number of points, of the transfer or the clustering.
    pub fn points(&self) -> usize {
        let transfer = self.transfer.as_ref().map(Signal::points);
        transfer.or(self.clustering.as_ref().map(Clustering::points)).unwrap_or(0)
    }

    /// The first contradiction between the parts: the field, the expected and the found value.
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
        self.superclusters_fault().or_else(|| self.provenance_fault())
    }

    fn superclusters_fault(&self) -> Option<(&'static str, String, String)> {
        let superclusters = self.superclusters.as_ref()?;
        let clusters = self.clustering.as_ref().map_or(0, |clustering| clustering.subspaces().len());
        if superclusters.len() != clusters {
            return Some((
                "superclusters",
                format!("a number for {clusters} clusters"),
                superclusters.len().to_string(),
            ));
        }
        let mut next = 0;
        for &found in superclusters {
            if found > next {
                return Some(("superclusters", format!("0 to {next}, in the order of clusters"), found.to_string()));
            }
            next += u32::from(found == next);
        }
        None
    }

    fn provenance_fault(&self) -> Option<(&'static str, String, String)> {
        let line = self.provenance.as_ref()?;
        let is_line = (1..=MAX_PROVENANCE).contains(&line.len()) && !line.chars().any(char::is_control);
        let expected = || format!("a line of 1 to {MAX_PROVENANCE} bytes without control characters");
        (!is_line).then(|| ("provenance", expected(), format!("{} bytes", line.len())))
    }
}
