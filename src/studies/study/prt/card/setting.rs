//! The card that draws a picture, and the code that the studies of all systems share.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;
use serde_json::json;

use super::difference::ComparedPicture;
use crate::error::InputError;
use crate::report::{Cell, Findings, FoundTable, Provenance, Table};
use crate::study::StudyError;
use crate::study::prt::LitView;
use crate::study::timeline_trace;

/// The card that draws.
#[derive(Debug)]
pub struct CardSetting {
    /// The card.
    pub profile: Profile,
    /// Switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// Executor of its programs.
    pub executor: Executor,
    /// The picture's format.
    pub format: TexelFormat,
    /// `true` to vary number formats, maps and targets one after the other.
    pub sweep: bool,
}

impl CardSetting {
    /// Returns `true` if the target holds fixed-point fractions, which clamp.
    pub(super) fn is_clamped(&self) -> bool {
        !self.format.record().is_float()
    }

    pub(super) fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.clone_from(&self.switches);
        provenance
    }
}

/// Inputs for the findings of a study of a card's picture.
pub(super) struct PictureStudy<'a> {
    pub(super) card: &'a CardSetting,
    pub(super) view: &'a LitView,
    /// Input that card and host share.
    pub(super) from: &'static str,
}

impl PictureStudy<'_> {
    /// Exposes linear radiance of pixels; returns the exposure and the pixels.
    pub(super) fn exposed(&self, linear: Vec<[f64; 3]>) -> (f64, Vec<[f64; 3]>) {
        let exposure = self.view.exposure_of(&linear);
        (exposure, linear.into_iter().map(|color| color.map(|value| exposure * value)).collect())
    }

    /// Findings with both pictures, their difference and the sentence about it.
    pub(super) fn findings(
        &self,
        title: &str,
        compared: &ComparedPicture<'_>,
        exposure: f64,
    ) -> Result<Findings, InputError> {
        let card = &self.card.profile.title;
        let mut found = Findings::new(title);
        found.taken_from(self.view.camera.world_to_camera());
        found.conclusion(compared.sentence(card, self.from));
        let caption = format!("{} on the {card}", self.view.caption());
        compared.report(&self.view.camera, caption, self.from, &mut found)?;
        found.field("exposure", json!(exposure));
        Ok(found)
    }

    /// Adds the time of a frame, with its log as a timeline.
    pub(super) fn report_time(
        &self,
        times: Table,
        explained: &'static str,
        log: &[Event],
        frame: &str,
        found: &mut Findings,
    ) -> Result<(), StudyError> {
        found.heading("Modelled time");
        found.explained_table(FoundTable::from(times).field("time"), explained);
        if let Some(bytes) = timeline_trace::file(&self.card.profile, log, frame)? {
            found.keep_file("timeline.json", bytes);
        }
        Ok(())
    }
}

/// Adds a table of sizes and counts.
pub(super) fn report_sizes(sizes: impl IntoIterator<Item = (&'static str, Cell)>, found: &mut Findings) {
    let mut table = Table::new("Sizes and counts", &["what", "number"]);
    sizes.into_iter().for_each(|(what, number)| table.push([what.into(), number]));
    found.heading("What is drawn");
    found.table(FoundTable::from(table).field("sizes"));
}
