//! A bidirectional texture as a volume texture (Figure 4).

use refsim::device::Profile;
use refsim::machine::{Machine, TextureId};
use refsim::num::Format;
use refsim::texture::{Image, TargetRounding, TexelFormat, TextureKind, encode};

use crate::bi_scale::kernels::{BlockEdges, BlockGrid};
use crate::bi_scale::texture::BidirectionalTexture;
use crate::card::CardError;

/// The largest number of half precision.
const HALF_MOST: f32 = 65_504.0;

/// The image of a volume, and the factor that scales its texels to samples. Fails with [`CardError`] for a format other
/// than `rgba8`, `rgba16f` and `rgba32f`, a device that does not filter the format or support the volume's size, and
/// samples outside the format's range.
pub fn volume_image(
    profile: &Profile,
    texture: &BidirectionalTexture,
    edges: BlockEdges,
    format: TexelFormat,
) -> Result<(Image, BlockGrid, f64), CardError> {
    let (lights, views) = (texture.light().side(), texture.view().side());
    let grid = BlockGrid { size: texture.size(), lights, views, edges };
    check(profile, &grid, format)?;
    let extents = grid.extents();
    let mut image = Image::new(format, TextureKind::Volume, extents.map(|side| side as u32), 1)?;
    let largest = texture.samples().as_flattened().iter().fold(0.0_f32, |most, &value| most.max(value));
    if format == TexelFormat::Rgba16f && largest > HALF_MOST {
        let what = "samples of at most 65504, which half precision holds";
        return Err(CardError::figure(what, f64::from(largest)));
    }
    let scale = if format == TexelFormat::Rgba8 && largest > 0.0 { f64::from(largest) } else { 1.0 };
    let [width, height, layers] = extents;
    let bytes = format.bytes();
    let mut into = image.bytes_mut().chunks_exact_mut(bytes);
    for view in 0..layers {
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
            let (light, [y, x]) = grid.shown(column, row);
            let [red, green, blue] = texture.patch(view, light)[y * grid.size + x];
            let texel = [red, green, blue, 0.0].map(|value| ((f64::from(value) / scale) as f32).to_bits());
            let raw = encode(format, Format::FP32, texel, TargetRounding::Nearest).to_le_bytes();
            into.next().expect("a texel").copy_from_slice(&raw[..bytes]);
        }
    }
    Ok((image, grid, scale))
}

/// Rejects a volume that the device cannot store or filter.
fn check(profile: &Profile, grid: &BlockGrid, format: TexelFormat) -> Result<(), CardError> {
    if ![TexelFormat::Rgba8, TexelFormat::Rgba16f, TexelFormat::Rgba32f].contains(&format) {
        let sentence = format!("expected a bidirectional texture in rgba8, rgba16f or rgba32f, found {format}");
        return Err(CardError::Input(sentence));
    }
    let device = &profile.name;
    if format.record().is_float() && !profile.limits.float_filtering {
        return Err(CardError::input(format!(
            "`{device}` does not filter {format} textures (limits.float_filtering); store samples in 8 bits"
        )));
    }
    let [width, height, layers] = grid.extents();
    match profile.limits.max_volume_size.map(|limit| limit as usize) {
        Some(found) if width.max(height).max(layers) > found => {
            let (lights, pitch) = (grid.lights, grid.pitch());
            Err(CardError::input(format!(
                "{lights} x {lights} blocks of {pitch} x {pitch} texels in {layers} layers need a volume of {width} x \
                 {height} x {layers}; `{device}` has volumes of {found} per side (limits.max_volume_size); use a \
                 smaller patch, or fewer directions"
            )))
        }
        _ => Ok(()),
    }
}

/// A bidirectional texture on a card.
#[derive(Clone, Copy, Debug)]
pub struct VolumeTexture {
    /// The volume texture on the card.
    pub id: TextureId,
    /// The layout of its blocks.
    pub grid: BlockGrid,
    /// The factor that scales its texels to samples.
    pub scale: f64,
}

impl VolumeTexture {
    /// Uploads a texture. Fails as [`volume_image`] does, and if the card rejects the texture.
    pub fn new(
        machine: &mut Machine,
        texture: &BidirectionalTexture,
        edges: BlockEdges,
        format: TexelFormat,
    ) -> Result<Self, CardError> {
        let (image, grid, scale) = volume_image(machine.profile(), texture, edges, format)?;
        Ok(Self { id: machine.create_texture(image)?, grid, scale })
    }
}
