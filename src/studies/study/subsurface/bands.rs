//! Items that a divided run computes in parts: sums over all pairs and over links, by bands of rows of texels.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::way;
use super::{GatherWay, Parameters};
use crate::split::Concatenate;
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::links::LinkBands;

/// Results of consecutive bands of rows of texels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct GatheredBands {
    bands: usize,
    /// Radiosities over all pairs, by channel; empty if they are not requested.
    pub(super) all_pairs: [Vec<f64>; 3],
    /// Links per way, unless an earlier way has the same links.
    links: Vec<LinkBands>,
}

impl GatheredBands {
    /// Computes a range of bands.
    pub(super) fn new(
        scene: &way::Scene<'_>,
        range: Range<usize>,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Self, StudyError> {
        let mut found = Self { bands: range.len(), ..Self::default() };
        let rows = LinkBands::rows(scene.parameters.options.side);
        if scene.parameters.options.gathers_all_pairs() {
            found.all_pairs = scene.all_pairs().rows(&(range.start * rows..range.end * rows), progress)?;
        }
        for way in scene.parameters.ways_with_links() {
            found.links.push(way::link_bands(scene, way, range.clone(), progress)?);
        }
        Ok(found)
    }

    /// The bands of a way's links; `None` if there are none.
    pub(super) fn links(&self, parameters: &Parameters, way: GatherWay) -> Option<&LinkBands> {
        let mut all = parameters.ways_with_links().zip(&self.links);
        all.find(|(other, _)| other.has_links_of(&way)).map(|(_, links)| links)
    }
}

impl Concatenate for GatheredBands {
    /// Lengths depend on the model; a merge rejects parts that do not fit it.
    fn are_of(&self, range: &Range<usize>) -> bool {
        self.bands == range.len()
    }

    fn append(&mut self, next: Self) {
        self.bands += next.bands;
        self.all_pairs.iter_mut().zip(next.all_pairs).for_each(|(all, next)| all.extend(next));
        self.links.iter_mut().zip(next.links).for_each(|(all, next)| all.append(next));
    }
}
