//! The card that draws a picture, and the findings that the studies of all systems share.

use glam::DVec3;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;
use refsim::timing::host::{HostError, HostModel};
use serde_json::json;

use super::errors::{PixelErrors, STEPS, held};
use crate::card::SeenPixel;
use crate::card::frame_time::{FrameTime, FrameTimeError, frame_time};
use crate::error::InputError;
use crate::picture::metrics::value_error;
use crate::report::digits::{Quantity, shown};
use crate::report::words::counted;
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Provenance, Table, false_color};
use crate::study::StudyError;
use crate::study::prt::{LitView, light_picture};
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

    /// The time of a frame; `None` on a device with unknown rates.
    pub(super) fn modelled(
        &self,
        log: &[Event],
        host: Result<HostModel, HostError>,
    ) -> Result<Option<FrameTime>, FrameTimeError> {
        match frame_time(&self.profile, log, &host?) {
            Ok(time) => Ok(Some(time)),
            Err(FrameTimeError::Timing(_)) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Adds the time of a frame, with its log as a timeline.
    pub(super) fn report_time(
        &self,
        times: Table,
        explained: &str,
        (log, frame): (&[Event], &str),
        found: &mut Findings,
    ) -> Result<(), StudyError> {
        found.heading("Modelled time");
        found.explained_table(FoundTable::from(times).field("time"), explained);
        if let Some(bytes) = timeline_trace::file(&self.profile, log, frame)? {
            found.keep_file("timeline.json", bytes);
        }
        Ok(())
    }

    /// Adds the frame rate, its bottleneck and the parts of a frame, if the device's rates are known.
    pub(super) fn report_frame(
        &self,
        host: Result<HostModel, HostError>,
        explained: &str,
        (log, frame): (&[Event], &str),
        found: &mut Findings,
    ) -> Result<(), StudyError> {
        let Some(time) = self.modelled(log, host)? else { return Ok(()) };
        let rate = shown(time.per_second(), Quantity::Measured);
        let waits = time.bottleneck.map_or_else(String::new, |what| format!("; draws wait for {what}"));
        found.conclusion(format!(
            "{}: {rate} frames per second (modelled){waits}; {} vertices are run and {} triangles set up in {}.",
            self.profile.title,
            time.vertices_run,
            time.triangles,
            counted(time.calls as u64, "draw", "draws")
        ));
        let times = [
            ("frame to frame", time.frame),
            ("host at work", time.host),
            ("products on the host", time.products),
            ("upload of vertices", time.uploads),
            ("state and constants", time.state),
            ("draws", time.draws),
        ];
        let times = times.map(|(part, time)| [part.into(), Cell::measured(1e3 * time.seconds())]);
        self.report_time(Table::new("A frame", &["part", "ms"]).with(times), explained, (log, frame), found)
    }
}

/// The host's picture of what a card draws.
pub(super) struct HostPicture<'a> {
    card: &'a CardSetting,
    view: &'a LitView,
    /// Input that card and host share.
    from: &'static str,
    /// The surface in each pixel of the card's raster.
    pub(super) seen: Vec<Option<SeenPixel>>,
    /// Factor on radiance.
    pub(super) exposure: f64,
    /// Exposed pixels in double precision, neither clamped nor quantised.
    pub(super) pixels: Vec<[f64; 3]>,
}

impl<'a> HostPicture<'a> {
    /// Exposes linear radiance of pixels.
    pub(super) fn new(
        (card, view): (&'a CardSetting, &'a LitView),
        from: &'static str,
        seen: Vec<Option<SeenPixel>>,
        linear: Vec<[f64; 3]>,
    ) -> Self {
        let exposure = view.exposure_of(&linear);
        let pixels = linear.into_iter().map(|color| color.map(|value| exposure * value)).collect();
        Self { card, view, from, seen, exposure, pixels }
    }

    /// Findings with the card's picture, the host's, their difference and the sentence about it, and a picture of the
    /// light. If the target or the vertices hold fixed-point fractions, the host's pixels are clamped for the
    /// comparison.
    pub(super) fn findings(
        &self,
        title: &str,
        drawn: &[[f64; 3]],
        is_clamped: bool,
        light: impl Fn(DVec3) -> [f64; 3] + Sync,
    ) -> Result<(Findings, PixelErrors), InputError> {
        let (card, camera, from) = (&self.card.profile.title, &self.view.camera, self.from);
        let expected = held(&self.pixels, is_clamped);
        let errors = PixelErrors::of(&self.seen, drawn, &expected);
        let mut found = Findings::new(title);
        found.taken_from(camera.world_to_camera());
        found.conclusion(errors.sentence(card, from));
        let worst = |(found, expected): (&[f64; 3], &[f64; 3])| {
            let channels = found.iter().zip(expected).map(|(&found, &expected)| value_error(found, expected));
            channels.fold(0.0, |worst: f64, value| if value.abs() > worst.abs() { value } else { worst })
        };
        let difference: Vec<f64> = drawn.iter().zip(&expected).map(worst).collect();
        let range = (4.0 * errors.finite_rms / STEPS).max(1.0 / STEPS);
        let scale = shown(STEPS * range, Quantity::Measured);
        let caption = format!(
            "card minus host, for the channel that differs most, in steps of 1/255: blue -{scale} or less, white 0, \
             red +{scale} or more{}",
            false_color::not_finite(&difference)
        );
        let picture = self.view.picture(drawn);
        let [title, host] =
            [format!("{} on the {card}", self.view.caption()), format!("the host in double precision, from {from}")];
        found.pictures(vec![
            NamedPicture::new("card", picture.display(1.0)?, title),
            NamedPicture::new("host", self.view.picture(&self.pixels).display(1.0)?, host),
            NamedPicture::new("difference", false_color::signed(camera.width(), &difference, range), caption),
        ]);
        found.keep_layers("card", picture);
        let [rms, largest] = errors.off_255ths.map(|steps| Cell::measured(steps).json());
        found.fields(json!({
            "difference": { "rms_255ths": rms, "largest_255ths": largest, "visible_share": errors.visible,
                            "not_finite": errors.not_finite },
            "exposure": self.exposure,
        }));
        found.pictures(vec![light_picture("light", &self.view.light, light)?]);
        Ok((found, errors))
    }
}

pub(super) fn report_sizes(sizes: impl IntoIterator<Item = (&'static str, Cell)>, found: &mut Findings) {
    let rows = sizes.into_iter().map(|(what, number)| [what.into(), number]);
    found.heading("What is drawn");
    found.table(FoundTable::from(Table::new("Sizes and counts", &["what", "number"]).with(rows)).field("sizes"));
}
