//! What was found, as a page.

use serde_json::json;

use super::picture::{Difference, Way, on_host};
use super::subject::{CardError, OnCard};
use super::{frame, precision, tables};
use crate::cpca::on_card::time::{FrameTimeError, frame_time, host_of_section_7};
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, FoundTable, NamedPicture, Provenance, false_color};
use crate::study::prt::exit_radiance::Lit;
use crate::study::prt::interpolate::linear_picture;
use crate::study::prt::render::auto_exposure;
use crate::study::{ProgressFn, Study, timeline_trace};
use crate::transfer::brdf::ExitBasis;

impl Study for OnCard {
    type Error = CardError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, CardError> {
        let basis = self.basis()?;
        let transfer = self.transfer(&basis)?;
        let steps = 2 + if self.sweep { precision::pictures(&transfer) } else { 0 };
        progress("host", 0, steps);
        let host = self.host_picture(&basis)?;
        let exposure = self.exposure.unwrap_or_else(|| auto_exposure(&host));
        let host: Vec<[f64; 3]> = host.into_iter().map(|color| color.map(|value| exposure * value)).collect();
        progress("card", 1, steps);
        let way = Way { profile: &self.profile, format: self.format, options: self.options, timed: true };
        let drawn = way.draw(self, transfer, exposure)?;
        let difference = Difference::of(&drawn.colors, &host);
        let mut found = Findings::new("Compressed transfer on a card");
        found.taken_from(self.camera.world_to_camera());
        found.conclusion(difference.sentence(&self.profile.title));
        let time = match frame_time(&self.profile, &drawn.log, &host_of_section_7().map_err(FrameTimeError::from)?) {
            Ok(time) => Some(time),
            Err(FrameTimeError::Timing(_)) => None,
            Err(error) => return Err(error.into()),
        };
        if let Some(time) = &time {
            found.conclusion(tables::time_sentence(time, &self.profile.title));
        }
        self.pictures(&mut found, &drawn.colors, &host, &difference)?;
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
        found.field("difference", difference.json());
        Ok(found)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.clone_from(&self.switches);
        provenance
    }
}

impl OnCard {
    /// Linear radiance by the host in double precision: the same clusters, exit coefficients and view vectors
    /// interpolated, functions evaluated.
    fn host_picture(&self, basis: &ExitBasis) -> Result<Vec<[f64; 3]>, CardError> {
        let lit = Lit::new(&self.meaning, &self.light).ok_or(CardError::NoTransfer)?;
        Ok(on_host(self, basis, &lit.of_clusters(&self.clustering)))
    }

    fn pictures(
        &self,
        found: &mut Findings,
        drawn: &[[f64; 3]],
        host: &[[f64; 3]],
        difference: &Difference,
    ) -> Result<(), CardError> {
        let width = self.camera.width();
        let title = format!("{} under {} on the {}", self.model, self.light_name, self.profile.title);
        let mut pictures = vec![
            NamedPicture::new("card", linear_picture(&self.camera, drawn).display(1.0)?, title),
            NamedPicture::new("host", linear_picture(&self.camera, host).display(1.0)?, "the host in double precision"),
        ];
        // A few pixels at edges, where the card's raster decides otherwise than a ray, would hide the rest.
        let range = (4.0 * difference.rms).max(1.0 / 255.0);
        let scale = shown(255.0 * range, Quantity::Measured);
        pictures.push(NamedPicture::new(
            "difference",
            false_color::signed(width, &difference.of_pixel, range),
            format!("card less host, the channel that differs most: blue -{scale} or less, white 0, red +{scale} 255ths or more"),
        ));
        found.pictures(pictures);
        found.keep_layers("card", linear_picture(&self.camera, drawn));
        Ok(())
    }
}
