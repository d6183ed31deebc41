//! A picture with its counts.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;

use super::card::FactoredCard;
use super::counts::FactoredCounts;
use super::error::FactoredCardError;
use super::options::ProductPlace;
use super::subject::TransferredMesh;
use crate::all_frequency::shade::Multiplies;
use crate::card::{MeshView, Texels};

/// A picture, its counts and its log.
#[derive(Clone, Debug)]
pub struct FactoredDrawing {
    /// The texels of the target.
    pub texels: Texels,
    /// The same in floating point, which shows negative pixels; `None` if the device has no such target.
    pub signed: Option<Texels>,
    /// Counts of clamped colors.
    pub counts: FactoredCounts,
    /// Texture reads and arithmetic slots of the pixel program.
    pub pixel_slots: [u32; 2],
    /// The log of host and card, for [`frame_time`](crate::card::frame_time::frame_time).
    pub log: Vec<Event>,
}

/// Draws a mesh on a device. `host` are the multiplications of steps 2 and 3.
///
/// # Errors
/// [`FactoredCardError`].
pub fn draw(
    mesh: TransferredMesh<'_>,
    (profile, executor): (impl Into<Arc<Profile>>, impl Into<Executor>),
    place: ProductPlace,
    view: &MeshView,
    host: Multiplies,
) -> Result<FactoredDrawing, FactoredCardError> {
    let mut card = FactoredCard::new(profile, executor, mesh, place)?;
    let (texels, mut counts, log) = card.logged_view(view, host)?;
    let signed = match card.float_target() {
        Some(format) if format == view.format => Some(texels.clone()),
        Some(format) => Some(card.view_texels(&MeshView { format, ..*view })?),
        None => None,
    };
    if let Some(signed) = &signed {
        let covered = || signed.texels.iter().filter(|texel| texel[3] != 0.0);
        counts.covered = Some(covered().count() as u64);
        let is_negative = |texel: &&[f32; 4]| texel[..3].iter().any(|&value| value < 0.0);
        counts.below_zero = Some(covered().filter(is_negative).count() as u64);
    }
    Ok(FactoredDrawing { texels, signed, counts, pixel_slots: card.pixel_slots(), log })
}
