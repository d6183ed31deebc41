//! Textures of a case: inline texels or PNG files, with their sampler state.

use refsim::{
    event::SAMPLERS,
    num::{self, Format},
    texture::{AddressMode, ChannelClass, Image, SamplerState, TargetRounding, TexelFormat, TextureError, TextureKind},
};
use toml::Spanned;

use super::{
    CaseError,
    binder::Binder,
    schema,
    state::texel_format,
    value::{Mipmaps, Number, vector, whole},
};

use crate::io::{picture::MAX_BYTES, read_limited};
use crate::names::did_you_mean;
use crate::picture::png_codes;

/// Texture of a case.
#[derive(Clone, Debug)]
pub struct CaseTexture {
    /// Texels.
    pub image: Image,
    /// Sampler state.
    pub sampler: SamplerState,
    /// `true` if the card generates levels 1 and up, which the image does not contain yet.
    pub generate_mipmaps: bool,
}

/// Binds a texture; returns its sampler's index.
pub(super) fn bind(binder: &Binder<'_>, texture: &Spanned<schema::Texture>) -> Result<(usize, CaseTexture), CaseError> {
    let written = texture.get_ref();
    let slot = *written.slot.get_ref() as usize;
    if slot >= SAMPLERS {
        let message = format!("expected a slot from 0 to {}, found {slot}", SAMPLERS - 1);
        return Err(binder.place.wrong(written.slot.span(), message, "the slot is the number of the sampler or stage"));
    }
    let format = texel_format(binder, written.format.get_ref(), written.format.span())?;
    let wrong = |message: &str, help: &str| Err(binder.place.wrong(texture.span(), message, help));
    let image = match (&written.file, &written.texels) {
        (Some(file), None) => from_file(binder, written, format, file)?,
        (None, Some(texels)) => from_texels(binder, texture, format, texels)?,
        (Some(_), Some(_)) => return wrong("the texture has both `file` and `texels`", "keep one of the two"),
        (None, None) => return wrong("the texture has no texels", "give a PNG `file`, or list `texels`"),
    };
    let generate_mipmaps = matches!(mipmaps(written), Some(Mipmaps::Automatic));
    let image = if generate_mipmaps {
        let levels = Image::most_levels(image.kind(), [image.width(), image.height(), image.slices()]);
        let too_large =
            |error: TextureError| binder.place.wrong(texture.span(), error.to_string(), "make the texture smaller");
        image.with_levels(levels).map_err(too_large)?
    } else {
        image
    };
    let sampler = sampler(binder, written, &image)?;
    Ok((slot, CaseTexture { image, sampler, generate_mipmaps }))
}

fn mipmaps(written: &schema::Texture) -> Option<&Mipmaps> {
    written.mipmaps.as_ref().map(Spanned::get_ref)
}

/// Texels that the case lists for levels 1 and up.
fn listed_levels(written: &schema::Texture) -> &[Spanned<Vec<Vec<Number>>>] {
    match mipmaps(written) {
        Some(Mipmaps::Texels(levels)) => levels,
        Some(Mipmaps::Automatic) | None => &[],
    }
}

/// Width, height and depth from as many numbers as the kind has axes.
fn extents(kind: TextureKind, size: &[u32]) -> Option<[u32; 3]> {
    match (kind, size) {
        (TextureKind::D1, &[width]) => Some([width, 1, 1]),
        (TextureKind::D2 | TextureKind::Rectangle, &[width, height]) => Some([width, height, 1]),
        (TextureKind::Cube, &[side]) => Some([side, side, 1]),
        (TextureKind::Volume, &[width, height, depth]) => Some([width, height, depth]),
        _ => None,
    }
}

fn from_texels(
    binder: &Binder<'_>,
    texture: &Spanned<schema::Texture>,
    format: TexelFormat,
    texels: &Spanned<Vec<Vec<Number>>>,
) -> Result<Image, CaseError> {
    let written = texture.get_ref();
    let Some(size) = &written.size else {
        let help = "add `size = [width, height]`";
        return Err(binder.place.wrong(texture.span(), "the texture has `texels` but no `size`", help));
    };
    let Some(extents) = extents(written.kind, size.get_ref()) else {
        let message = format!("a `size` of {} numbers does not fit this kind of texture", size.get_ref().len());
        let help = "1d and cube have one number, 2d and rectangle two, volume three";
        return Err(binder.place.wrong(size.span(), message, help));
    };
    // The number of listed texels is checked before the image is allocated.
    let faces = if written.kind == TextureKind::Cube { 6 } else { 1 };
    let expected = extents.iter().try_fold(faces, |product: usize, &side| product.checked_mul(side as usize));
    if expected != Some(texels.get_ref().len()) {
        let expected = expected.map_or_else(|| "far more".to_owned(), |number| number.to_string());
        let message = format!("expected {expected} texels for the size, found {}", texels.get_ref().len());
        return Err(binder.place.wrong(
            texels.span(),
            message,
            "list the rows from the top, then the next face or slice",
        ));
    }
    let wrong = |error: TextureError| binder.place.wrong(size.span(), error.to_string(), "change `size` or `mipmaps`");
    let listed = listed_levels(written);
    let levels = u32::try_from(listed.len()).unwrap_or(u32::MAX).saturating_add(1);
    let mut image = Image::new(format, written.kind, extents, levels).map_err(wrong)?;
    fill(binder, &mut image, 0, written.raw, texels)?;
    for (level, texels) in (1..).zip(listed) {
        fill(binder, &mut image, level, written.raw, texels)?;
    }
    Ok(image)
}

/// Encodes a texel from a list of codes, one per channel in the order red, green, blue, alpha (luminance first). Signed
/// channels use two's complement for negative codes. The error describes the expected list.
fn stored(format: TexelFormat, codes: &[Number]) -> Result<u128, String> {
    let channels = format.record().stored();
    if codes.len() != channels.len() {
        return Err(format!("{} codes, one for each channel that `{format}` stores", channels.len()));
    }
    let mut raw = 0;
    for (channel, code) in channels.iter().zip(codes) {
        let bits = u32::from(channel.bits);
        let lowest = if matches!(channel.class, ChannelClass::Snorm | ChannelClass::SplitSnorm) {
            -(1_i64 << (bits - 1))
        } else {
            0
        };
        let highest = (1_i64 << bits) - 1;
        match whole(code).filter(|code| (lowest..=highest).contains(code)) {
            Some(code) => raw |= u128::from(code as u64 & highest as u64) << channel.shift,
            None => return Err(format!("whole numbers from {lowest} to {highest} as codes of {bits} bits")),
        }
    }
    Ok(raw)
}

fn fill(
    binder: &Binder<'_>,
    image: &mut Image,
    level: u32,
    raw: bool,
    texels: &Spanned<Vec<Vec<Number>>>,
) -> Result<(), CaseError> {
    let Some(&extent) = image.levels().get(level as usize) else { return Ok(()) };
    let expected = extent.width as usize * extent.height as usize * extent.slices as usize;
    let found = texels.get_ref().len();
    if found != expected {
        let message = format!("expected {expected} texels in level {level}, found {found}");
        return Err(binder.place.wrong(
            texels.span(),
            message,
            "each level has half the side lengths of the previous level",
        ));
    }
    let mut values = texels.get_ref().iter();
    for slice in 0..extent.slices {
        for y in 0..extent.height {
            for (x, texel) in (0..extent.width).zip(&mut values) {
                if raw {
                    let code = stored(image.format(), texel).map_err(|expected| {
                        let message = format!("expected {expected} in texel ({x}, {y}), found {}", list(texel));
                        binder.place.wrong(texels.span(), message, "or remove `raw` and write numbers")
                    })?;
                    image.set_raw(level, slice, y, x, code);
                    continue;
                }
                let Some(bits) = vector(texel) else {
                    let message = format!("expected 1 to 4 numbers in texel ({x}, {y}), found {}", texel.len());
                    return Err(binder.place.wrong(texels.span(), message, "red, green, blue, alpha"));
                };
                let stored = image.store([level, slice, y, x], Format::FP32, bits, TargetRounding::Nearest);
                stored.map_err(|error| binder.place.wrong(texels.span(), error.to_string(), "change `size`"))?;
            }
        }
    }
    Ok(())
}

fn list(numbers: &[Number]) -> String {
    let texts: Vec<String> = numbers.iter().map(|number| number.double().to_string()).collect();
    format!("[{}]", texts.join(", "))
}

fn from_file(
    binder: &Binder<'_>,
    written: &schema::Texture,
    format: TexelFormat,
    file: &Spanned<std::path::PathBuf>,
) -> Result<Image, CaseError> {
    let path = binder.path(file.get_ref());
    if written.raw {
        let help = "remove `raw`, or list `texels`";
        return Err(binder.place.wrong(file.span(), "`raw` is for `texels`, but the texture has a `file`", help));
    }
    let wrong = |message: String, help: &str| binder.place.wrong(file.span(), message, help);
    if matches!(written.kind, TextureKind::Cube | TextureKind::Volume) || !listed_levels(written).is_empty() {
        let help = "list `texels` for cubes, volumes and mip maps";
        return Err(wrong("a picture makes a 1d, 2d or rectangle texture with one level".to_owned(), help));
    }
    let bytes = read_limited(&path, MAX_BYTES)
        .map_err(|source| binder.place.unreadable(file.span(), path.clone(), source))?
        .ok_or_else(|| {
            wrong(format!("expected a picture file of at most {MAX_BYTES} bytes"), "use a smaller picture")
        })?;
    let picture = png_codes(&bytes).map_err(|error| {
        let help = "save the picture as PNG with 8 or 16 bits per channel, or make it smaller";
        wrong(format!("`{}`: {error}", path.display()), help)
    })?;
    if let Some(size) = &written.size {
        let found = [picture.width(), picture.height()];
        if extents(written.kind, size.get_ref()) != Some([found[0], found[1], 1]) {
            let message = format!("the picture is {}x{}, not what `size` says", found[0], found[1]);
            return Err(binder.place.wrong(size.span(), message, "remove `size`: a picture has its own size"));
        }
    }
    // A channel of n bits is k / (2^n - 1), rounded once to single precision; the texel format then quantises it.
    let single = |k: u16| num::from_ratio(Format::FP32, false, k.into(), 65535).bits;
    let values: Vec<[u32; 4]> = picture.pixels().map(|pixel| pixel.0.map(single)).collect();
    let extents = [picture.width(), picture.height(), 1];
    Image::from_values(format, written.kind, extents, Format::FP32, &values, TargetRounding::Nearest)
        .map_err(|error| wrong(error.to_string(), "use another picture, or another `kind`"))
}

fn sampler(binder: &Binder<'_>, written: &schema::Texture, image: &Image) -> Result<SamplerState, CaseError> {
    let unused = |span: Option<std::ops::Range<usize>>, message: &str, help: &str| match span {
        Some(span) => Err(binder.place.wrong(span, message, help)),
        None => Ok(()),
    };
    if written.min.is_some() && written.mag.is_some() {
        unused(
            written.filter.as_ref().map(Spanned::span),
            "`filter` in addition to `min` and `mag`",
            "remove `filter`: it has no effect",
        )?;
    }
    let border = written.border.as_ref().map(Spanned::span);
    let bordered = written.address.as_ref().is_some_and(|address| address.get_ref().0.iter().any(|a| a == "border"));
    unused(border.filter(|_| !bordered), "`border` without `address = \"border\"`", "no read reaches the border")?;
    let levels = image.levels().len() as u32;
    let beyond = written.max_mip_level.as_ref().filter(|level| *level.get_ref() >= levels).map(Spanned::span);
    unused(beyond, "the texture has no such level", "`mipmaps` lists the levels from 1 on")?;
    let both = written.filter.as_ref().map(|filter| *filter.get_ref()).unwrap_or_default();
    let [address_u, address_v, address_w] = address(binder, written)?;
    Ok(SamplerState {
        min: written.min.unwrap_or(both),
        mag: written.mag.unwrap_or(both),
        mip: written.mip,
        address_u,
        address_v,
        address_w,
        border: binder.optional_vector(written.border.as_ref(), [0; 4])?,
        lod_bias: written.lod_bias.map_or(0, Number::single),
        max_mip_level: written
            .max_mip_level
            .as_ref()
            .map_or(0, |level| u8::try_from(*level.get_ref()).unwrap_or(u8::MAX)),
    })
}

/// Binds the address modes: one for all axes, or one per axis; defaults to clamp.
fn address(binder: &Binder<'_>, written: &schema::Texture) -> Result<[AddressMode; 3], CaseError> {
    let Some(address) = &written.address else { return Ok([AddressMode::Clamp; 3]) };
    let mode = |name: &String| {
        name.parse().map_err(|_| {
            let message = format!("expected wrap, mirror, clamp or border, found `{name}`");
            let meant = did_you_mean(name, ["wrap", "mirror", "clamp", "border"]);
            binder.place.wrong(
                address.span(),
                message,
                format!("{meant}write one mode for all axes, or a list with one per axis"),
            )
        })
    };
    let modes = address.get_ref().0.iter().map(mode).collect::<Result<Vec<AddressMode>, _>>()?;
    let axes = match written.kind {
        TextureKind::D1 => 1,
        TextureKind::D2 | TextureKind::Rectangle | TextureKind::Cube => 2,
        TextureKind::Volume => 3,
    };
    match modes[..] {
        [all] => Ok([all; 3]),
        [u, v] if axes == 2 => Ok([u, v, AddressMode::Clamp]),
        [u, v, w] if axes == 3 => Ok([u, v, w]),
        _ => {
            let message = format!("expected 1 address mode or {axes}, one per axis, found {}", modes.len());
            Err(binder.place.wrong(address.span(), message, "write one mode for all axes, or one per axis"))
        }
    }
}
