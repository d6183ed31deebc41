//! Numbers as text for the page.

use std::io::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;

pub(super) fn base64(bytes: impl AsRef<[u8]>) -> String {
    STANDARD.encode(bytes)
}

pub(super) fn packed(bytes: &[u8]) -> std::io::Result<String> {
    let mut file = GzEncoder::new(Vec::new(), Compression::best());
    file.write_all(bytes)?;
    Ok(base64(file.finish()?))
}

pub(super) fn base64_words(words: impl IntoIterator<Item = u32>) -> String {
    base64(words.into_iter().flat_map(u32::to_le_bytes).collect::<Vec<_>>())
}
