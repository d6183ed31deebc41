//! The buffers of a glTF file: the binary chunk, Base64 text in the JSON, and separate files.

use std::borrow::Cow;
use std::io;
use std::path::{Component, Path, PathBuf};

use base64::Engine as _;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::Document;
use gltf::buffer::{Source, View};
use percent_encoding::percent_decode_str;

use super::super::obj::MAX_BYTES;
use super::super::quoted;
use crate::error::{InputError, input_error};
use crate::io::error::{part_error, too_long_error};

/// Base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The bytes of all buffers.
pub(super) struct Buffers<'a>(Vec<Cow<'a, [u8]>>);

impl<'a> Buffers<'a> {
    /// Reads the buffers; `chunk` is the binary chunk of GLB.
    pub(super) fn load(
        document: &Document,
        chunk: Option<&'a [u8]>,
        name: &Path,
        beside: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<Self, InputError> {
        let (mut all, mut total) = (Vec::new(), 0_u64);
        for buffer in document.buffers() {
            let index = buffer.index();
            let wrong =
                |expected: &'static str, found: &str| part_error(name, format!("buffers[{index}]"), expected, found);
            let bytes = match (buffer.source(), chunk) {
                (Source::Bin, Some(chunk)) if index == 0 => Cow::Borrowed(chunk),
                (Source::Bin, _) => return Err(wrong("a `uri`, or the binary chunk of GLB", "none")),
                (Source::Uri(uri), _) => match uri.strip_prefix("data:") {
                    Some(data) => {
                        let text = data.split_once(',').filter(|(kind, _)| kind.ends_with(";base64"));
                        let decoded = text.and_then(|(_, text)| BASE64.decode(text).ok());
                        let expected = "bytes in base64 `data:application/octet-stream;base64,...`";
                        Cow::Owned(decoded.ok_or_else(|| wrong(expected, &quoted(uri.as_bytes())))?)
                    }
                    None => {
                        let expected = "a file in the folder of the model";
                        let file = local(uri).ok_or_else(|| wrong(expected, &quoted(uri.as_bytes())))?;
                        Cow::Owned(beside(&file).map_err(|source| {
                            let path = name.parent().unwrap_or(Path::new("")).join(&file);
                            input_error!("crossbar::model::buffer" =>
                                "buffers[{index}]: cannot read {}", path.display(); help "put it beside the model")
                            .with_source(source)
                            .at(name)
                        })?)
                    }
                },
            };
            if bytes.len() < buffer.length() {
                let found = format!("{} bytes", bytes.len());
                return Err(wrong("as many bytes as its `byteLength` says", &found));
            }
            total += bytes.len() as u64;
            if total > MAX_BYTES {
                return Err(too_long_error("model", name, MAX_BYTES));
            }
            all.push(bytes);
        }
        Ok(Self(all))
    }

    /// The bytes of a view; `None` if they lie outside its buffer.
    pub(super) fn view(&self, view: &View<'_>) -> Option<&[u8]> {
        let end = view.offset().checked_add(view.length())?;
        self.0.get(view.buffer().index())?.get(view.offset()..end)
    }
}

fn local(uri: &str) -> Option<PathBuf> {
    let path = percent_decode_str(uri).decode_utf8().ok()?;
    // Reject schemes, drives, and the separator that only some systems use.
    if path.is_empty() || path.contains([':', '\\', '\0']) {
        return None;
    }
    let path = PathBuf::from(path.as_ref());
    let inside = path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    inside.then_some(path)
}
