//! A picture with its counts of colors out of a target's range.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;

use super::card::FactoredCard;
use super::options::ProductPlace;
use super::subject::TransferredMesh;
use crate::all_frequency::shade::Multiplies;
use crate::card::{CardError, MeshView, Texels};

/// Counts of clamped colors. Truncated factors have negative lobes, which targets and vertex colors in fractions clamp
/// to 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FactoredCounts {
    /// Pixels that show the mesh; `None` if the device has no floating-point target by which to count.
    pub covered: Option<u64>,
    /// Covered pixels with a negative channel before clamping.
    pub below_zero: Option<u64>,
    /// Vertices with a negative channel; `None` if products are computed per pixel.
    pub vertices_below_zero: Option<u64>,
    /// Vertices with a channel above 1, which bytes clamp.
    pub vertices_above_one: Option<u64>,
}

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
/// [`CardError`].
pub fn draw(
    profile: impl Into<Arc<Profile>>,
    executor: impl Into<Executor>,
    mesh: TransferredMesh<'_>,
    place: ProductPlace,
    view: &MeshView,
    host: Multiplies,
) -> Result<FactoredDrawing, CardError> {
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
