//! Compressed transfer drawn by an emulated card: how far its pictures are off, by what, and how long a frame takes.

mod picture;
mod precision;
mod tables;

use miette::Diagnostic;
use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;
use serde_json::json;
use thiserror::Error;

use super::exit_radiance::Lit;
use super::render::auto_exposure;
use crate::geom::Mesh;
use crate::picture::{Picture, PictureError};
use crate::prt::brdf::ExitBasis;
use crate::prt::cpca::Clustering;
use crate::prt::file::PrtMeaning;
use crate::prt::on_card::time::{FrameTimeError, frame_time, host_of_section_7};
use crate::prt::on_card::{CompressedTransfer, PrtCardError, PrtCardOptions};
use crate::prt::transfer::Vertices;
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, FoundTable, NamedPicture, Provenance, false_color};
use crate::scene::Camera;
use crate::sphere::{HarmonicLight, HemisphereError};
use crate::study::timeline_trace::{self, TimelineError};
use crate::study::{ProgressFn, Study};
use picture::{Difference, Way};

/// A model with compressed transfer, a light and a camera, and the card that draws it.
#[derive(Debug)]
pub struct OnCard {
    /// The model's name.
    pub model: String,
    /// Its mesh.
    pub mesh: Mesh,
    /// Its vertices, the points of the clusters.
    pub vertices: Vertices,
    /// What the numbers of a vertex mean.
    pub meaning: PrtMeaning,
    /// The clusters.
    pub clustering: Clustering,
    /// The light's name.
    pub light_name: String,
    /// The light, of the order of the transfer.
    pub light: HarmonicLight,
    /// The camera.
    pub camera: Camera,
    /// What radiance is multiplied by; `None` for auto-exposure: 18 % grey on average.
    pub exposure: Option<f64>,
    /// The card.
    pub profile: Profile,
    /// Its switches that were set.
    pub switches: Vec<(String, String)>,
    /// What runs its programs.
    pub executor: Executor,
    /// The picture's format.
    pub format: TexelFormat,
    /// Variants.
    pub options: PrtCardOptions,
    /// Whether one thing after the other is made coarse.
    pub sweep: bool,
}

/// Why there is no picture.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
pub enum CardError {
    /// A signal that is no transfer.
    #[error("expected transfer, found numbers without a meaning")]
    #[diagnostic(code(crossbar::prt::meaning), help("compress a file that `crossbar prt precompute` wrote"))]
    NoTransfer,
    /// The card refuses.
    #[error(transparent)]
    #[diagnostic(
        code(crossbar::prt::card),
        help("`crossbar prt render` draws on the host what no card takes; `crossbar devices` lists cards")
    )]
    Card(#[from] PrtCardError),
    /// The functions of exit radiance are none.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::functions))]
    Functions(#[from] HemisphereError),
    /// The frame has no time.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::time))]
    Time(#[from] FrameTimeError),
    /// The frame has no timeline.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Timeline(#[from] TimelineError),
    /// A picture that cannot be shown.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}

impl Study for OnCard {
    type Error = CardError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, CardError> {
        let steps = if self.sweep { 2 + precision::STEPS } else { 2 };
        progress("host", 0, steps);
        let basis = self.basis()?;
        let host = self.host_picture(&basis)?;
        let exposure = self.exposure.unwrap_or_else(|| auto_exposure(&host));
        let host: Vec<[f64; 3]> = host.into_iter().map(|color| color.map(|value| exposure * value)).collect();
        progress("card", 1, steps);
        let transfer = self.transfer(&basis)?;
        let way = Way { profile: &self.profile, format: self.format, options: self.options, timed: true };
        let mut drawn = way.draw(self, transfer, exposure)?;
        let difference = Difference::of(&drawn.colors, &host);
        let mut found = Findings::new("Compressed transfer on a card");
        found.taken_from(self.camera.world_to_camera());
        found.conclusion(difference.sentence(&self.profile.title));
        let log = drawn.log;
        let time = match frame_time(&self.profile, &log, &host_of_section_7().map_err(FrameTimeError::from)?) {
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
            found.explained_table(FoundTable::from(tables::times(time)).field("time"), tables::TIME);
            if let Some(bytes) = timeline_trace::file(&self.profile, &log, "a frame of compressed transfer")? {
                found.keep_file("timeline.json", bytes);
            }
        }
        drop(log);
        drawn.colors.clear();
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
    fn basis(&self) -> Result<ExitBasis, CardError> {
        let PrtMeaning::Transfer { exit_functions, .. } = &self.meaning else { return Err(CardError::NoTransfer) };
        Ok(ExitBasis::of_functions(exit_functions)?)
    }

    fn transfer<'a>(&'a self, basis: &'a ExitBasis) -> Result<CompressedTransfer<'a>, CardError> {
        let PrtMeaning::Transfer { channels, .. } = &self.meaning else { return Err(CardError::NoTransfer) };
        let vectors = self.clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0);
        let (vertices, clustering) = (&self.vertices, &self.clustering);
        Ok(CompressedTransfer { vertices, clustering, basis, channels: *channels as usize, vectors })
    }

    /// Linear radiance by the host in double precision: the same clusters, exit coefficients and view vectors
    /// interpolated, functions evaluated.
    fn host_picture(&self, basis: &ExitBasis) -> Result<Vec<[f64; 3]>, CardError> {
        let lit = Lit::new(&self.meaning, &self.light).ok_or(CardError::NoTransfer)?;
        Ok(picture::on_host(self, basis, &lit.of_clusters(&self.clustering)))
    }

    fn picture(&self, colors: &[[f64; 3]]) -> Picture {
        let single: Vec<[f32; 3]> = colors.iter().map(|color| color.map(|channel| channel as f32)).collect();
        Picture::rgb(self.camera.width(), self.camera.height(), &single)
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
            NamedPicture::new("card", self.picture(drawn).display(1.0)?, title),
            NamedPicture::new("host", self.picture(host).display(1.0)?, "the host in double precision"),
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
        found.keep_layers("card", self.picture(drawn));
        Ok(())
    }
}
