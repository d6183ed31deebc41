//! PLY, the format of scanned models: ASCII and both binary encodings, read with ply-rs-bw.
//!
//! docs/scenes.md lists the elements that are read; others are ignored. Vertices keep the file's order, and degenerate
//! triangles are kept, as in OBJ files. The file is read element by element, so that an error names the line or the
//! element, and a count in the header alone allocates no memory.

use std::borrow::Cow;
use std::fmt::Display;
use std::path::Path;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult};

use super::faces::Faces;
use super::lines::{not_utf_16, unmarked};
use super::model_note::ModelNote;
use super::obj::within_limit;
use super::{quoted, visible};
use crate::error::{FilePlace, InputError};
use crate::geom::Mesh;
use crate::io::error::{element_error, mesh_error, syntax_error};

const NUMBERS: [&[&str]; 8] =
    [&["x"], &["y"], &["z"], &["nx"], &["ny"], &["nz"], &["s", "u", "texture_u"], &["t", "v", "texture_v"]];
/// Largest number of characters of a name in a message.
const LONGEST: usize = 80;
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Reads a mesh from bytes; `name` is the file's name in messages.
pub fn parse_ply(bytes: &[u8], name: &Path) -> Result<Mesh, InputError> {
    read_ply(bytes, name, true).map(|(mesh, _)| mesh)
}

/// Like [`parse_ply`]; unless `strict`, faulty faces are accepted and data after the last element are ignored, with
/// notes.
pub(super) fn read_ply(bytes: &[u8], name: &Path, strict: bool) -> Result<(Mesh, Vec<ModelNote>), InputError> {
    within_limit(bytes, name)?;
    not_utf_16(bytes, name)?;
    let bytes = unmarked(bytes);
    // The format's description ends lines with CR; modern writers do not.
    let line_end = if bytes.starts_with(b"ply\r") && bytes.get(4) != Some(&b'\n') { b'\r' } else { b'\n' };
    let (header, lines, data) = header(bytes, line_end, name)?;
    let has = |element: &str, property: &[&str]| {
        header.elements.get(element).is_some_and(|e| property.iter().any(|&name| e.properties.contains_key(name)))
    };
    if !NUMBERS[..3].iter().all(|names| has("vertex", names)) {
        return Err(missing(name, "an element `vertex` with the properties `x`, `y` and `z`"));
    }
    if !has("face", &INDICES) {
        return Err(missing(name, "an element `face` with a list `vertex_indices` or `vertex_index`"));
    }
    let vertices = header.elements.get("vertex").map_or(0, |element| element.count);
    let mut mesh = MeshReader::default();
    let mut data = Data { name, encoding: header.encoding, line: lines, line_end, rest: data };
    for element in header.elements.values() {
        for index in 0..element.count {
            let (record, at) = data.next(element, index)?;
            match element.name.as_str() {
                "vertex" => match record.numbers[..3].iter().find(|coordinate| !coordinate.is_finite()) {
                    Some(odd) => return Err(at.error("finite coordinates", odd.to_string())),
                    None => mesh.vertices.push(record.numbers),
                },
                "face" => {
                    if let Some(beyond) = record.indices.iter().find(|index| **index as usize >= vertices) {
                        let expected = format!("corners below {vertices}, the number of vertices");
                        return Err(at.error(expected, beyond.to_string()));
                    }
                    if record.indices.len() < 3 {
                        return Err(at.error("three corners or more", "fewer"));
                    }
                    mesh.faces.begin(at.line.map_or(index, |(line, _)| line));
                    record.indices.into_iter().for_each(|corner| mesh.faces.push(corner));
                }
                _ => {}
            }
        }
    }
    let attributes = [&NUMBERS[3..6], &NUMBERS[6..8]].map(|names| names.iter().all(|names| has("vertex", names)));
    let named = |place: usize| match header.encoding {
        Encoding::Ascii => FilePlace::line(name, place).to_string(),
        _ => format!("{}: face {place} (counted from 0)", name.display()),
    };
    let position = |corner: u32| positions_of(&mesh.vertices[corner as usize]);
    let (triangles, mut notes) = mesh.faces.triangles(position, named, strict)?;
    let bytes = data.rest.trim_ascii().len();
    if bytes > 0 {
        if strict {
            let expected = "the end of the file after the last element";
            return Err(syntax_error(name, expected, format!("{bytes} bytes more")));
        }
        notes.push(ModelNote::Trailing { bytes, last: "element" });
    }
    Ok((mesh.finish(triangles, attributes, name)?, notes))
}

fn missing(name: &Path, expected: &'static str) -> InputError {
    syntax_error(name, expected, "none")
}

fn header<'a>(bytes: &'a [u8], line_end: u8, name: &Path) -> Result<(Header, usize, &'a [u8]), InputError> {
    let syntax =
        |line: usize, expected: &str, found: String| syntax_error(FilePlace::line(name, line), expected, found);
    let (mut lines, mut length, mut text) = (0, 0, "");
    for line in bytes.split_inclusive(|&byte| byte == line_end) {
        (lines, length) = (lines + 1, length + line.len());
        let line = line.trim_ascii();
        if lines == 1 && line != b"ply" {
            return Err(syntax(1, "the word `ply`", quoted(line)));
        }
        // Comments may be in any encoding; all used lines are ASCII.
        text = std::str::from_utf8(line).unwrap_or("comment");
        if text == "end_header" {
            break;
        }
    }
    if text != "end_header" {
        return Err(syntax(lines.max(1), "`end_header` at the end of the header", "the end of the file".to_owned()));
    }
    let (head, data) = bytes.split_at(length);
    let mut head = String::from_utf8_lossy(head);
    if line_end == b'\r' {
        head = head.replace('\r', "\n").into();
    }
    let header = Parser::<Record>::new().read_header(&mut Reader::new(head.as_bytes())).map_err(|error| {
        let Some(line) = error.line() else {
            let expected = "`format ascii 1.0`, `format binary_little_endian 1.0` or `format binary_big_endian 1.0`";
            return syntax(2, expected, "no such line".to_owned());
        };
        let text = head.lines().nth(line - 1).unwrap_or_default();
        syntax(line, "`format`, `element NAME COUNT`, `property TYPE NAME` or `comment`", quoted(text.as_bytes()))
    })?;
    if let Some(empty) = header.elements.values().find(|element| element.properties.is_empty() && element.count > 0) {
        let expected = format!("properties of the element `{}`", empty.name.escape_debug());
        return Err(syntax(lines, &expected, "none".to_owned()));
    }
    Ok((header, lines, data))
}

struct Data<'a> {
    name: &'a Path,
    encoding: Encoding,
    line: usize,
    line_end: u8,
    rest: &'a [u8],
}

struct ElementPlace<'a> {
    name: &'a Path,
    element: &'a str,
    index: usize,
    /// In ASCII data the line's number and text.
    line: Option<(usize, String)>,
}

impl ElementPlace<'_> {
    fn error(self, expected: impl Display, found: impl Display) -> InputError {
        match self.line {
            Some((line, found)) => syntax_error(FilePlace::line(self.name, line), expected, found),
            None => element_error(self.name, &visible(self.element, LONGEST), self.index, expected, found),
        }
    }
}

impl<'a> Data<'a> {
    /// The next element; `index` is its index among elements of its type.
    fn next<'b>(&mut self, element: &'b ElementDef, index: usize) -> Result<(Record, ElementPlace<'b>), InputError>
    where
        'a: 'b,
    {
        let parser = Parser::<Record>::new();
        let mut at = ElementPlace { name: self.name, element: &element.name, index, line: None };
        let read = match self.encoding {
            Encoding::Ascii => {
                let Some(line) = self.next_line() else {
                    at.line = Some((self.line, "the end of the file".to_owned()));
                    return Err(at.error(expected(element), ""));
                };
                at.line = Some((self.line, quoted(line)));
                let line = std::str::from_utf8(line).ok();
                line.and_then(|line| parser.read_ascii_element(&with_digits(line), element).ok())
            }
            Encoding::BinaryLittleEndian => parser.read_little_endian_element(&mut self.rest, element).ok(),
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut self.rest, element).ok(),
        };
        match read {
            Some(record) => Ok((record, at)),
            None => {
                let found = if self.rest.is_empty() { "the end of the file" } else { "other values" };
                Err(at.error(expected(element), found))
            }
        }
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|&byte| byte == self.line_end).unwrap_or(self.rest.len());
            let line = self.rest[..end].trim_ascii();
            self.rest = self.rest.get(end + 1..).unwrap_or_default();
            self.line += 1;
            if !line.is_empty() {
                return Some(line);
            }
        }
        None
    }
}

/// Completes numbers to digits on both sides of the point, which ply-rs-bw expects: `1.` becomes `1.0`.
fn with_digits(line: &str) -> Cow<'_, str> {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let mut plain = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once('.') {
        let [left, right] = [digit(before.chars().next_back()), digit(after.chars().next())];
        plain += before;
        plain += if !left && right {
            "0."
        } else if left && !right {
            ".0"
        } else {
            "."
        };
        rest = after;
    }
    if plain.is_empty() { line.into() } else { (plain + rest).into() }
}

fn expected(element: &ElementDef) -> String {
    let names: Vec<&str> = element.properties.keys().map(String::as_str).take(12).collect();
    let (more, names) = (element.properties.len() > names.len(), names.join(" "));
    let more = if more && names.chars().count() <= LONGEST { " ..." } else { "" };
    format!("a `{}` of `{}{more}`", visible(&element.name, LONGEST), visible(&names, LONGEST))
}

#[derive(Default)]
struct Record {
    numbers: [f32; NUMBERS.len()],
    indices: Vec<u32>,
}

impl PropertyAccess for Record {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if let Some(place) = NUMBERS.iter().position(|names| names.contains(&name)) {
            // In elements other than vertices a property of this name may have any type.
            property.to_f32_lossy().inspect(|&number| self.numbers[place] = number);
        } else if INDICES.contains(&name) {
            let Some(indices) = property.to_u32_list() else { return PropertyAccessResult::UnsupportedType };
            self.indices = indices;
        } else {
            return PropertyAccessResult::Ignored;
        }
        PropertyAccessResult::Set
    }
}

#[derive(Default)]
struct MeshReader {
    vertices: Vec<[f32; NUMBERS.len()]>,
    faces: Faces<u32>,
}

fn positions_of(vertex: &[f32; NUMBERS.len()]) -> [f32; 3] {
    [vertex[0], vertex[1], vertex[2]]
}

impl MeshReader {
    fn finish(
        self,
        triangles: Vec<[u32; 3]>,
        [normals, texcoords]: [bool; 2],
        name: &Path,
    ) -> Result<Mesh, InputError> {
        if triangles.is_empty() {
            return Err(missing(name, "at least one face"));
        }
        let normals = normals.then(|| self.vertices.iter().map(|v| [v[3], v[4], v[5]]).collect());
        let texcoords = texcoords.then(|| self.vertices.iter().map(|v| [v[6], v[7]]).collect());
        let mesh = Mesh::new(self.vertices.iter().map(positions_of).collect(), triangles);
        mesh.and_then(|mesh| mesh.with_attributes(normals, texcoords)).map_err(|reason| mesh_error(name, reason))
    }
}
