//! The two forms of a glTF file: JSON, or GLB, which holds the JSON and one buffer as chunks.

use std::path::Path;

use gltf::json::validation::{Error, Validate as _};
use gltf::{Document, json};

use super::super::lines::unmarked;
use super::super::{quoted, visible};
use crate::error::{FilePlace, InputError};
use crate::io::error::{part_error, syntax_error};

/// Largest number of characters of a part or an error in a message.
const MOST: usize = 160;
const MAGIC: &[u8] = b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");
const ATTRIBUTES: [&str; 3] = ["POSITION", "NORMAL", "TEXCOORD_0"];
/// Properties that are ignored wherever they occur, as are those whose names end in `Texture`.
const PASSED_OVER: [&str; 8] =
    ["animations", "camera", "cameras", "extras", "images", "samplers", "targets", "textures"];

/// The document with all references checked, and the binary chunk of GLB.
pub(super) fn read<'a>(bytes: &'a [u8], name: &Path) -> Result<(Document, Option<&'a [u8]>), InputError> {
    let (text, chunk) = if bytes.starts_with(MAGIC) { chunks(bytes, name)? } else { (unmarked(bytes), None) };
    let root = used_parts(text).map_err(|error| {
        // Parsing the text directly gives the error with its line.
        let error = json::deserialize::from_slice::<json::Root>(text).err().unwrap_or(error);
        syntax_error(
            FilePlace::line(name, error.line().max(1)),
            "a glTF 2.0 document",
            format!("something else: {}", visible(&error.to_string(), MOST)),
        )
    })?;
    let wrong =
        |part: &str, expected: &'static str, found: String| part_error(name, visible(part, MOST), expected, found);
    if !root.asset.version.starts_with("2.") {
        return Err(wrong("asset.version", "2.0", quoted(root.asset.version.as_bytes())));
    }
    // A file that needs features of a later version (glTF 2.0, section 3.2).
    if let Some(least) = root.asset.min_version.as_ref().filter(|least| *least != "2.0" && !least.starts_with("1.")) {
        return Err(wrong("asset.minVersion", "2.0", quoted(least.as_bytes())));
    }
    // The crate's validation assumes these properties.
    for (mesh, primitives) in root.meshes.iter().map(|mesh| &mesh.primitives).enumerate() {
        for (primitive, attributes) in primitives.iter().map(|primitive| &primitive.attributes).enumerate() {
            if let Some(index) = attributes.values().find(|index| index.value() >= root.accessors.len()) {
                let part = format!("meshes[{mesh}].primitives[{primitive}].attributes");
                return Err(wrong(&part, "an accessor of the file", format!("accessor {}", index.value())));
            }
        }
    }
    let mut errors = Vec::new();
    root.validate(&root, json::Path::new, &mut |path, error| errors.push((path().to_string(), error)));
    // The format allows a primitive without positions, which is not drawn.
    errors.retain(|(path, error)| *error != Error::Missing || !path.ends_with("[\"POSITION\"]"));
    match errors.first() {
        Some((path, error)) => Err(wrong(path, "what glTF 2.0 asks for", error.to_string().to_lowercase())),
        None => Ok((Document::from_json_without_validation(root), chunk)),
    }
}

/// Parses only the used parts of a document, because the crate rejects other parts that the format allows.
fn used_parts(text: &[u8]) -> Result<json::Root, json::Error> {
    let mut document: json::Value = json::deserialize::from_slice(text)?;
    keep_used(&mut document);
    let scenes = document.get_mut("scenes").and_then(json::Value::as_array_mut);
    for scene in scenes.into_iter().flatten().filter_map(json::Value::as_object_mut) {
        // An empty scene has no list of nodes.
        scene.entry("nodes").or_insert_with(|| Vec::<u32>::new().into());
    }
    json::deserialize::from_value(document)
}

fn keep_used(value: &mut json::Value) {
    if let Some(list) = value.as_array_mut() {
        list.iter_mut().for_each(keep_used);
    }
    let Some(object) = value.as_object_mut() else { return };
    object.retain(|key, _| !PASSED_OVER.contains(&key.as_str()) && !key.ends_with("Texture"));
    if let Some(attributes) = object.get_mut("attributes").and_then(json::Value::as_object_mut) {
        attributes.retain(|key, _| ATTRIBUTES.contains(&key.as_str()));
    }
    object.values_mut().for_each(keep_used);
}

/// The JSON of a GLB file, and its binary chunk if it has one.
fn chunks<'a>(bytes: &'a [u8], name: &Path) -> Result<(&'a [u8], Option<&'a [u8]>), InputError> {
    let wrong = |part: &str, expected: &'static str, found: String| part_error(name, part, expected, found);
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
