//! Numbers as text for the page.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// Encodes bytes.
pub(super) fn base64(bytes: impl AsRef<[u8]>) -> String {
    STANDARD.encode(bytes)
}

/// Encodes words, little-endian.
pub(super) fn base64_words(words: impl IntoIterator<Item = u32>) -> String {
    base64(words.into_iter().flat_map(u32::to_le_bytes).collect::<Vec<_>>())
}
