//! Findings of clustered principal components on a card.

use super::picture::{CardDrawing, on_host};
use super::subject::OnCard;
use super::{precision, tables};
use crate::card::seen_pixels;
use crate::cpca::on_card::time::host_of_section_7;
use crate::report::{Findings, Provenance};
use crate::study::prt::card::difference::ComparedPicture;
use crate::study::prt::card::frame;
use crate::study::prt::card::setting::{PictureStudy, report_sizes};
use crate::study::prt::card::sweep::report_sweep;
use crate::study::prt::exit_radiance::Lit;
use crate::study::prt::exit_radiance::no_transfer;
use crate::study::prt::no_cpca_card;
use crate::study::{ProgressFn, Study, StudyError};

impl Study for OnCard {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let (basis, card) = (self.basis()?, &self.card);
        let transfer = self.transfer(&basis)?;
        let steps = 2 + if card.sweep { precision::pictures(&transfer) } else { 0 };
        progress("host", 0, steps);
        let seen = seen_pixels(&card.profile, self.vertices.geometry(), &self.view.camera)?;
        let lit = Lit::new(&self.meaning, &self.light).ok_or_else(no_transfer)?;
        let exit = lit.of_clusters(&self.clustering);
        let study = PictureStudy { card, view: &self.view, from: "the same clusters" };
        let (exposure, host) = study.exposed(on_host(self, &seen, &basis, &exit));
        progress("card", 1, steps);
        let way = CardDrawing { profile: &card.profile, format: card.format, options: self.options, timed: true };
        let drawn = way.draw(self, transfer, exposure).map_err(no_cpca_card)?;
        let compared = ComparedPicture::new(&seen, &drawn.colors, &host, card.is_clamped());
        let mut found = study.findings("Compressed transfer on a card", &compared, exposure)?;
        let radiance = |direction| self.light.radiance(direction);
        found.pictures(vec![self.view.light_picture(radiance)?]);
        report_sizes(tables::sizes(&drawn.size, &drawn.draws), &mut found);
        if let Some(time) = frame::modelled(&card.profile, &drawn.log, host_of_section_7())? {
            found.conclusion(tables::time_sentence(&time, &card.profile.title));
            let what = "a frame of compressed transfer";
            study.report_time(frame::times(&time), tables::TIME, &drawn.log, what, &mut found)?;
        }
        if card.sweep {
            let mut done = |done| progress("sweep", 2 + done, steps);
            let variants = precision::variants(self, transfer, exposure, &seen, &mut done)?;
            report_sweep(&variants, precision::EXPLAINED, &mut found);
        }
        Ok(found)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        self.card.provenance(provenance)
    }
}
