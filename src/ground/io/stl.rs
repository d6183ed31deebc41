//! STL, binary and ASCII.
//!
//! Triangles are in the order of the file; corners with bit-identical positions become one vertex. Binary data are
//! recognised by their length, because some begin with the word `solid` of the ASCII format.

use std::path::Path;

use super::lines::{lines, not_utf_16, single, unmarked, words};
use super::model_note::ModelNote;
use super::obj::within_limit;
use super::quoted;
use crate::error::{FilePlace, InputError};
use crate::geom::mesh::{Mesh, Welder};
use crate::io::error::{element_error, mesh_error, syntax_error};

/// Bytes before the triangles of binary data: a header, and the number of triangles.
const HEAD: usize = 84;
/// Bytes per triangle: twelve numbers, and an attribute.
const TRIANGLE: usize = 50;

type Corners = [[f32; 3]; 3];

/// Reads a mesh from bytes; `name` is the file's name in messages.
pub fn parse_stl(bytes: &[u8], name: &Path) -> Result<Mesh, InputError> {
    read_stl(bytes, name, true).map(|(mesh, _)| mesh)
}

/// Like [`parse_stl`]; unless `strict`, bytes after the last triangle are ignored with a note.
pub(super) fn read_stl(bytes: &[u8], name: &Path, strict: bool) -> Result<(Mesh, Vec<ModelNote>), InputError> {
    within_limit(bytes, name)?;
    let syntax = |expected: &'static str, found: String| Err(syntax_error(name, expected, found));
    let (length, mut notes) = (bytes.len() as u64, Vec::new());
    let claimed = claimed_length(bytes);
    if claimed != Some(length) {
        not_utf_16(bytes, name)?;
    }
    let soup = match claimed {
        Some(claimed) if claimed == length => binary(bytes, name)?,
        _ if is_text(bytes) => ascii(bytes, name)?,
        // In a text file these bytes are not a count of triangles.
        Some(claimed) if bytes[..HEAD].contains(&0) => {
            if strict || claimed > length {
                return syntax("as many bytes as its number of triangles takes", format!("{length} of {claimed}"));
            }
            notes.push(ModelNote::Trailing { bytes: (length - claimed) as usize, last: "triangle" });
            binary(&bytes[..claimed as usize], name)?
        }
        _ => {
            return syntax(
                "an STL file, which begins with `solid` or is binary",
                quoted(&bytes[..bytes.len().min(80)]),
            );
        }
    };
    if soup.is_empty() {
        return syntax("at least one triangle", "none".to_owned());
    }
    let mut welder = Welder::default();
    let triangles = soup.into_iter().map(|corners| corners.map(|corner| welder.vertex(corner))).collect();
    let mesh = Mesh::new(welder.into_positions(), triangles);
    mesh.map(|mesh| (mesh, notes)).map_err(|reason| mesh_error(name, reason))
}

/// True for the contents of an STL file: binary data with the length that their header states, or text that begins as
/// ASCII STL.
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    claimed_length(bytes) == Some(bytes.len() as u64) || is_text(bytes)
}

fn claimed_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEAD - 4..HEAD)?.try_into().ok()?;
    Some(HEAD as u64 + TRIANGLE as u64 * u64::from(u32::from_le_bytes(count)))
}

/// True for text whose first word is `solid`. Binary data have a zero byte in their header, unless they have more
/// triangles than the size limit allows.
fn is_text(bytes: &[u8]) -> bool {
    let text = unmarked(bytes).trim_ascii_start();
    let word = text.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    word.eq_ignore_ascii_case(b"solid") && !bytes[..bytes.len().min(HEAD)].contains(&0)
}

fn binary(bytes: &[u8], name: &Path) -> Result<Vec<Corners>, InputError> {
    let triangles = bytes[HEAD..].as_chunks::<TRIANGLE>().0;
    let read = triangles.iter().enumerate().map(|(index, bytes)| {
        let number = |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        // The normal's three numbers come first.
        let corners: Corners = [12, 24, 36].map(|at| [number(at), number(at + 4), number(at + 8)]);
        match corners.as_flattened().iter().find(|coordinate| !coordinate.is_finite()) {
            None => Ok(corners),
            Some(odd) => Err(element_error(name, "triangle", index, "finite coordinates", odd)),
        }
    });
    read.collect()
}

fn ascii(bytes: &[u8], name: &Path) -> Result<Vec<Corners>, InputError> {
    let mut text = Text { name, line: 1, words: Box::new(text_words(unmarked(bytes))) };
    let mut soup = Vec::new();
    while let Some(word) = text.word() {
        text.known(Some(word), &["solid"])?;
        while text.keyword(&["facet", "endsolid"])? == 0 {
            text.keyword(&["normal"])?;
            for _ in 0..3 {
                // Any word but the next keyword is accepted: a triangle without area has no normal, and writers spell
                // NaN in many ways.
                let word = text.word();
                if word.is_none_or(|word| word.eq_ignore_ascii_case(b"outer")) {
                    return Err(text.wrong("three numbers of a normal", word));
                }
            }
            text.keyword(&["outer"])?;
            text.keyword(&["loop"])?;
            let mut corners = Corners::default();
            for corner in &mut corners {
                text.keyword(&["vertex"])?;
                for coordinate in corner {
                    let word = text.word();
                    let number = single(word.unwrap_or_default());
                    *coordinate = number.map_err(|fault| text.wrong(fault.expected(), word))?;
                }
            }
            text.keyword(&["endloop"])?;
            text.keyword(&["endfacet"])?;
            soup.push(corners);
        }
    }
    Ok(soup)
}

/// The words of a text with their line numbers, without the names of solids.
fn text_words(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    lines(bytes).flat_map(|(line, text)| without_names(&words(text)).into_iter().map(move |word| (line, word)))
}

/// The words of a line without the names of solids. A name extends to the end of its line, or to a `facet normal` in
/// the same line, because a whole file may be one line.
fn without_names<'a>(mut words: &[&'a [u8]]) -> Vec<&'a [u8]> {
    let mut kept = Vec::new();
    while let Some((&word, after)) = words.split_first() {
        kept.push(word);
        words = after;
        let ends = word.eq_ignore_ascii_case(b"endsolid");
        if ends || word.eq_ignore_ascii_case(b"solid") {
            let facet =
                |pair: &[&[u8]]| pair[0].eq_ignore_ascii_case(b"facet") && pair[1].eq_ignore_ascii_case(b"normal");
            let Some(facet) = after.windows(2).position(facet) else { break };
            // Another solid may begin between the end of a solid and the facet.
            let solid = |word: &&[u8]| ends && word.eq_ignore_ascii_case(b"solid");
            words = &after[after[..facet].iter().rposition(solid).unwrap_or(facet)..];
        }
    }
    kept
}

struct Text<'a> {
    name: &'a Path,
    /// The line of the last word.
    line: usize,
    words: Box<dyn Iterator<Item = (usize, &'a [u8])> + 'a>,
}

impl<'a> Text<'a> {
    fn word(&mut self) -> Option<&'a [u8]> {
        let (line, word) = self.words.next()?;
        self.line = line;
        Some(word)
    }

    /// The index of the next word among the expected words.
    fn keyword(&mut self, expected: &[&str]) -> Result<usize, InputError> {
        let word = self.word();
        self.known(word, expected)
    }

    fn known(&self, word: Option<&[u8]>, expected: &[&str]) -> Result<usize, InputError> {
        let is_word = |known: &&str| word.is_some_and(|word| word.eq_ignore_ascii_case(known.as_bytes()));
        let wrong = || self.wrong(&format!("`{}`", expected.join("` or `")), word);
        expected.iter().position(is_word).ok_or_else(wrong)
    }

    fn wrong(&self, expected: &str, found: Option<&[u8]>) -> InputError {
        let found = found.map_or("the end of the file".to_owned(), quoted);
        syntax_error(FilePlace::line(self.name, self.line), expected, found)
    }
}
