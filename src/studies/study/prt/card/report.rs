//! What was found, as a page.

use serde_json::json;

use super::difference::ComparedPicture;
use super::picture::{Way, on_host};
use super::subject::{CardError, OnCard};
use super::{frame, precision, tables};
use crate::card::seen_pixels;
use crate::cpca::on_card::time::host_of_section_7;
use crate::report::{Findings, FoundTable, Provenance};
use crate::study::prt::exit_radiance::Lit;
use crate::study::prt::light_picture;
use crate::study::prt::render::auto_exposure;
use crate::study::{ProgressFn, Study, timeline_trace};

/// What card and host compute from.
const FROM: &str = "the same clusters";

impl Study for OnCard {
    type Error = CardError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, CardError> {
        let basis = self.basis()?;
        let transfer = self.transfer(&basis)?;
        let steps = 2 + if self.sweep { precision::pictures(&transfer) } else { 0 };
        progress("host", 0, steps);
        let seen = seen_pixels(&self.profile, self.vertices.geometry(), &self.camera)?;
        let lit = Lit::new(&self.meaning, &self.light).ok_or(CardError::NoTransfer)?;
        let host = on_host(self, &seen, &basis, &lit.of_clusters(&self.clustering));
        let exposure = self.exposure.unwrap_or_else(|| auto_exposure(&host));
        let host: Vec<[f64; 3]> = host.into_iter().map(|color| color.map(|value| exposure * value)).collect();
        progress("card", 1, steps);
        let way = Way { profile: &self.profile, format: self.format, options: self.options, timed: true };
        let drawn = way.draw(self, transfer, exposure)?;
        let compared = ComparedPicture::new(&seen, &drawn.colors, (&host, !self.format.record().is_float()));
        let mut found = Findings::new("Compressed transfer on a card");
        found.taken_from(self.camera.world_to_camera());
        found.conclusion(compared.sentence(&self.profile.title, FROM));
        let time = frame::modelled(&self.profile, &drawn.log, host_of_section_7())?;
        if let Some(time) = &time {
            found.conclusion(tables::time_sentence(time, &self.profile.title));
        }
        let title = format!("{} under {} on the {}", self.model, self.light_name, self.profile.title);
        compared.report(&self.camera, (title, FROM), &mut found)?;
        let radiance = |direction| self.light.radiance(direction);
        found.pictures(vec![light_picture("light", &self.light_name, radiance)?]);
        found.heading("What is drawn");
        found.table(FoundTable::from(tables::sizes(&drawn.size, &drawn.draws)).field("sizes"));
        if let Some(time) = &time {
            found.heading("Modelled time");
            found.explained_table(FoundTable::from(frame::times(time)).field("time"), tables::TIME);
            if let Some(bytes) = timeline_trace::file(&self.profile, &drawn.log, "a frame of compressed transfer")? {
                found.keep_file("timeline.json", bytes);
            }
        }
        if self.sweep {
            precision::report(self, (transfer, exposure), &mut found, &mut |done| progress("sweep", 2 + done, steps))?;
        }
        found.field("exposure", json!(exposure));
        Ok(found)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.clone_from(&self.switches);
        provenance
    }
}
