//! Findings of bi-scale transfer on a card.

use super::picture::{CardLight, Drawn, doubles};
use super::precision::{count, variants};
use super::subject::BiScaleOnCard;
use crate::all_frequency::on_card::time::host_of_table_1;
use crate::card::frame_time::{FrameTime, FrameTimeError};
use crate::card::seen_pixels;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, Provenance, Table};
use crate::study::prt::card::blame::{Blame, report_blame};
use crate::study::prt::card::difference::ComparedPicture;
use crate::study::prt::card::setting::{PictureStudy, report_sizes};
use crate::study::prt::card::sweep::report_sweep;
use crate::study::prt::card::{PixelErrors, frame};
use crate::study::prt::of_texels;
use crate::study::{ProgressFn, Study, StudyError};

const SWEEP: &str = "Each row uses one number format of fewer bits, and single precision elsewhere. Errors are in 255ths of white, against equation \
    3 and light multiplied in double precision. 8-bit fractions are relative to the largest number.";
const TIME: &str = "Modelled, not measured, by the pipeline model of the card, in which texture reads run at the full \
    rate of the units. Local light stays on the card, as in the paper; if only the view changes, it is reused.";

/// Times of a frame: with a new view only, and with a new light too; `None` if the card has no timing.
type Times = Option<(FrameTime, FrameTime)>;

impl Study for BiScaleOnCard {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("transfer", 0, 3);
        self.check()?;
        let (light, card) = (self.light_texels()?, &self.card);
        let exact = self.exact_local(&light);
        let local = self.local(&light, self.light_format)?;
        progress("host", 1, 3);
        let seen = seen_pixels(&card.profile, self.vertices.geometry(), &self.view.camera)?;
        let study = PictureStudy { card, view: &self.view, from: "the same local light" };
        let (exposure, host) = study.exposed(self.exact(&doubles(&local.local), &seen, 1.0));
        progress("card", 2, 3);
        let drawn = self.draw(&local.local, self.options, card.format, exposure)?;
        let compared = ComparedPicture::new(&seen, &drawn.pixels, &host, card.is_clamped());
        let mut found = study.findings("Bi-scale transfer on a card", &compared, exposure)?;
        let cube = self.light.cube()?;
        found.pictures(vec![self.view.light_picture(of_texels(cube.texels()))?]);
        let whole = self.exact(&exact, &seen, exposure);
        let blames = [
            Blame { step: "the card: storage, filters, arithmetic, target", errors: compared.errors },
            Blame { step: "light times biclusters by the card", errors: PixelErrors::of(&seen, &host, &whole) },
        ];
        report_blame(&blames, &mut found);
        report_sizes(self.sizes(&local, &drawn), &mut found);
        if let Some(times) = self.times(&local, &drawn)? {
            let [view, both] = [&times.0, &times.1].map(|time| shown(time.per_second(), Quantity::Measured));
            found.conclusion(format!(
                "{}: modelled {view} frames per second when only the view changes, {both} when light changes too.",
                card.profile.title
            ));
            let log: Vec<_> = local.log.iter().chain(&drawn.log).cloned().collect();
            study.report_time(table_of(&times), TIME, &log, "a frame of bi-scale transfer", &mut found)?;
        }
        if card.sweep {
            let mut done = |done| progress("sweep", done, count());
            let variants = variants(self, &light, &exact, &seen, exposure, &mut done)?;
            report_sweep(&variants, SWEEP, &mut found);
        }
        Ok(found)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        self.card.provenance(provenance)
    }
}

impl BiScaleOnCard {
    fn times(&self, local: &CardLight, drawn: &Drawn) -> Result<Times, FrameTimeError> {
        let both: Vec<_> = local.log.iter().chain(&drawn.log).cloned().collect();
        let view = frame::modelled(&self.card.profile, &drawn.log, host_of_table_1())?;
        Ok(view.zip(frame::modelled(&self.card.profile, &both, host_of_table_1())?))
    }

    fn sizes(&self, local: &CardLight, drawn: &Drawn) -> [(&'static str, Cell); 17] {
        let (gather, display) = (local.counts, drawn.counts);
        [
            ("vertices", self.vertices.len() as u64),
            ("vertices of the card", display.vertices as u64),
            ("triangles", display.triangles as u64),
            ("directions of light", self.directions() as u64),
            ("textures", self.textures.len() as u64),
            ("biclusters", self.biclusters.len() as u64),
            ("passes for the bicluster buffer", gather.passes[0] as u64),
            ("passes for rows", gather.passes[1] as u64),
            ("places read for the buffer", gather.places[0]),
            ("places read for rows", gather.places[1]),
            ("bytes of lists", gather.list_bytes.iter().sum()),
            ("bytes of volumes", display.volume_bytes),
            ("passes of the display for a texture", display.passes as u64),
            ("draws of the display", display.draws as u64),
            ("directions per pass", display.directions_per_pass as u64),
            ("texture reads per pixel of a pass", u64::from(display.pixel_slots[0])),
            ("arithmetic slots per pixel of a pass", u64::from(display.pixel_slots[1])),
        ]
        .map(|(what, number)| (what, number.into()))
    }
}

fn table_of((view, both): &(FrameTime, FrameTime)) -> Table {
    let mut table = Table::new("A frame", &["part", "ms"]);
    for (part, time) in [
        ("frame to frame, only the view changed", view.frame),
        ("frame to frame, view and light changed", both.frame),
        ("draws of the display", view.draws),
        ("upload of light", both.uploads),
        ("state and constants", both.state),
    ] {
        table.push([part.into(), Cell::measured(1e3 * time.seconds())]);
    }
    table
}
