//! Errors of pictures, with the formats and limits that they name.

/// Maximum side of a picture that is read, in pixels.
pub const MAX_SIDE: u32 = 16384;
/// Maximum memory of a decoded picture, in bytes (1 GiB).
pub const MAX_DECODED_BYTES: u64 = 1 << 30;

/// File format of pictures.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
pub enum PictureFormat {
    /// Portable Network Graphics: sRGB values of 8 or 16 bits.
    #[strum(to_string = "PNG")]
    Png,
    /// Radiance's RGBE: linear light with a shared exponent.
    #[strum(to_string = "Radiance HDR")]
    Hdr,
    /// OpenEXR: named channels of half floats, single floats and integers.
    #[strum(to_string = "EXR")]
    Exr,
}

/// Error of creating, writing or reading a picture.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PictureError {
    /// The number of samples does not match the picture's size.
    #[error("expected {expected} samples for a picture of {width}x{height}, found {found}")]
    #[diagnostic(code(crossbar::picture::samples))]
    Samples { width: u32, height: u32, expected: u64, found: u64 },
    /// The encoder failed.
    #[error("the {format} file cannot be encoded: {reason}")]
    #[diagnostic(code(crossbar::picture::encode))]
    Encode { format: PictureFormat, reason: String },
    /// The first bytes, given in hexadecimal, belong to no supported format.
    #[error("expected a PNG, Radiance HDR or OpenEXR picture, found a file that begins with {found}")]
    #[diagnostic(code(crossbar::picture::format))]
    Unrecognized { found: String },
    /// The picture is too large to be read.
    #[error(
        "expected a picture of at most {MAX_SIDE} pixels a side and {MAX_DECODED_BYTES} bytes decoded, found {width}x{height} with {channels} channels"
    )]
    #[diagnostic(code(crossbar::picture::size))]
    TooLarge { width: u64, height: u64, channels: usize },
    /// The header claims more pixels than the file's bytes can hold.
    #[error(
        "expected at least {least} bytes of a {format} file for the {width}x{height} pixels that its header says, found \
         {found}: is it cut?"
    )]
    #[diagnostic(code(crossbar::picture::claim))]
    Claim { format: PictureFormat, width: u64, height: u64, least: u64, found: u64 },
    /// The file is damaged, or a variant of its format that is not supported.
    #[error("the {format} data cannot be read: {reason}")]
    #[diagnostic(code(crossbar::picture::decode))]
    Decode { format: PictureFormat, reason: String },
    /// The picture has no color channels.
    #[error("expected channels R, G and B, or Y; found {}", if found.is_empty() { "none" } else { found })]
    #[diagnostic(code(crossbar::picture::color))]
    NoColor { found: String },
}
