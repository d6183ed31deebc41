//! The two forms of a glTF file: JSON, or GLB, which holds the JSON and one buffer as chunks.

use std::path::Path;

use gltf::{Document, Error, json};

use super::super::error::{FilePlace, ModelError};
use super::super::quoted;

/// First bytes of GLB.
const MAGIC: &[u8] = b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// The document, all its references checked, and the binary chunk of GLB.
pub(super) fn read<'a>(bytes: &'a [u8], name: &Path) -> Result<(Document, Option<&'a [u8]>), ModelError> {
    let (text, chunk) = if bytes.starts_with(MAGIC) { chunks(bytes, name)? } else { (bytes, None) };
    let root: json::Root = json::deserialize::from_slice(text).map_err(|error| ModelError::Syntax {
        place: FilePlace::line(name, error.line().max(1)),
        expected: "a glTF 2.0 document".into(),
        found: format!("something else: {}", shortened(&error.to_string())),
    })?;
    let wrong = |part: &str, expected: &'static str, found: String| ModelError::Part {
        place: name.into(),
        part: shortened(part),
        expected: expected.into(),
        found,
    };
    if !root.asset.version.starts_with("2.") {
        return Err(wrong("asset.version", "2.0", quoted(root.asset.version.as_bytes())));
    }
    // The checks of the crate take these for granted.
    for (mesh, primitives) in root.meshes.iter().map(|mesh| &mesh.primitives).enumerate() {
        for (primitive, attributes) in primitives.iter().map(|primitive| &primitive.attributes).enumerate() {
            if let Some(index) = attributes.values().find(|index| index.value() >= root.accessors.len()) {
                let part = format!("meshes[{mesh}].primitives[{primitive}].attributes");
                return Err(wrong(&part, "an accessor of the file", format!("accessor {}", index.value())));
            }
        }
    }
    let document = Document::from_json(root).map_err(|error| match &error {
        Error::Validation(list) if !list.is_empty() => {
            wrong(&list[0].0.to_string(), "what glTF 2.0 asks for", list[0].1.to_string().to_lowercase())
        }
        _ => wrong("the document", "what glTF 2.0 asks for", shortened(&error.to_string())),
    })?;
    Ok((document, chunk))
}

/// The JSON of a GLB file, and its binary chunk if it has one.
fn chunks<'a>(bytes: &'a [u8], name: &Path) -> Result<(&'a [u8], Option<&'a [u8]>), ModelError> {
    let wrong = |part: &str, expected: &'static str, found: String| ModelError::Part {
        place: name.into(),
        part: part.to_owned(),
        expected: expected.into(),
        found,
    };
    let word = |at: usize| Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?));
    if word(4) != Some(2) {
        return Err(wrong("the GLB header", "version 2", word(4).map_or("no more bytes".into(), |v| v.to_string())));
    }
    let length = word(8).map_or(usize::MAX, |length| length as usize);
    if length > bytes.len() {
        return Err(wrong("the GLB header", "the length of the file", "a longer one".to_owned()));
    }
    let (mut at, mut found) = (12, [None; 2]);
    while at < length {
        let (Some(size), Some(kind)) = (word(at), word(at + 4)) else { break };
        let Some(chunk) = bytes[..length].get(at + 8..).and_then(|rest| rest.get(..size as usize)) else {
            return Err(wrong("a GLB chunk", "its bytes", "the end of the file".to_owned()));
        };
        match kind {
            JSON => found[0] = found[0].or(Some(chunk)),
            BIN => found[1] = found[1].or(Some(chunk)),
            _ => {}
        }
        at += 8 + size as usize;
    }
    match found {
        [Some(text), chunk] => Ok((text, chunk)),
        [None, _] => Err(wrong("the GLB file", "a chunk of JSON", "none".to_owned())),
    }
}

/// Text from the file as a message shows it.
fn shortened(text: &str) -> String {
    const MOST: usize = 160;
    let more = if text.chars().count() > MOST { "..." } else { "" };
    let cut: String = text.chars().take(MOST).collect();
    format!("{}{more}", cut.escape_debug())
}
