//! Material libraries (MTL).
//!
//! docs/scenes.md lists the statements that are read and the rules that reflectances obey; other statements (ambient
//! colors, textures) are ignored. Names of materials, in UTF-8 or Latin-1, extend to the end of their line. When a scene
//! is read with notes, a material that breaks a rule is changed, with a note.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::super::lines::{decoded, logical_lines, not_utf_16, single, statement};
use super::super::model_note::ModelNote;
use super::super::{NumberError, quoted};
use crate::error::{FilePlace, InputError, input_error};
use crate::io::error::{material_error, syntax_error};
use crate::scene::{Color, Material, Surface};

/// Exponent of a glossy material without `Ns`.
const EXPONENT: f32 = 10.0;
/// The exponent that replaces `Ns 0`.
const LEAST_EXPONENT: f32 = 1.0;
/// Index of refraction of glass without `Ni`.
const INDEX: f32 = 1.5;
/// Tolerance of `Kd` + `Ks` above 1, for the rounding of numbers that sum to 1.
const ROUNDING: f32 = 1e-6;

/// Reads the materials of a library, in order; `name` is the file's name in messages.
pub fn parse_mtl(bytes: &[u8], name: &Path) -> Result<Vec<Material>, InputError> {
    read_mtl(bytes, name, None)
}

/// Like [`parse_mtl`]; with a list for notes, unsupported materials are changed into supported ones, each with a note.
pub(super) fn read_mtl(
    bytes: &[u8],
    name: &Path,
    mut notes: Option<&mut Vec<ModelNote>>,
) -> Result<Vec<Material>, InputError> {
    not_utf_16(bytes, name)?;
    let mut reader = MtlReader { name, lenient: notes.is_some(), materials: Vec::new(), seen: BTreeSet::new() };
    for (line, text) in logical_lines(bytes) {
        reader.line(line, &text)?;
    }
    reader.materials.iter().map(|read| assemble(read, name, notes.as_deref_mut())).collect()
}

struct MtlReader<'a> {
    name: &'a Path,
    /// True if reflectances above 1 are accepted, to be scaled later.
    lenient: bool,
    materials: Vec<MaterialText>,
    seen: BTreeSet<String>,
}

struct MaterialText {
    line: usize,
    name: String,
    /// The numbers of each statement by key; the last statement of a key counts.
    values: BTreeMap<Vec<u8>, Vec<f32>>,
}

impl MaterialText {
    fn number(&self, key: &str) -> Option<f32> {
        self.values.get(key.as_bytes())?.first().copied()
    }

    fn color(&self, key: &str) -> Option<Color> {
        self.values.get(key.as_bytes())?.as_slice().try_into().ok()
    }
}

impl MtlReader<'_> {
    fn line(&mut self, line: usize, text: &[u8]) -> Result<(), InputError> {
        let words = statement(text);
        let Some((&key, values)) = words.split_first() else { return Ok(()) };
        // What is expected, whether it is a color, and the allowed numbers, all at least 0.
        let (expected, is_color, allowed): (_, _, fn(f32) -> bool) = match key {
            b"newmtl" => return self.material(line, text[6..].trim_ascii()),
            b"Kd" | b"Ks" if self.lenient => ("three numbers of at least 0", true, |_| true),
            b"Kd" | b"Ks" | b"Tf" => ("three numbers from 0 to 1", true, |v| v <= 1.0),
            b"Ke" => ("three numbers of at least 0", true, |_| true),
            b"Ns" => ("`Ns` with a number of at least 0", false, |_| true),
            b"Ni" => ("`Ni` with a number above 0", false, |v| v > 0.0),
            b"d" => ("`d` with a number from 0 to 1", false, |v| v <= 1.0),
            b"Tr" => ("`Tr` with a number from 0 to 1", false, |v| v <= 1.0),
            b"illum" => ("`illum` with a whole number from 0 to 10", false, |v| v <= 10.0 && v.fract() == 0.0),
            _ => return Ok(()),
        };
        // A number that overflows single precision is named before the key's own range.
        if let Some(word) = values.iter().find(|word| single(word) == Err(NumberError::TooLarge)) {
            return Err(self.syntax(line, NumberError::TooLarge.expected(), word));
        }
        let number = |word: &&[u8]| single(word).ok().filter(|&value| value >= 0.0 && allowed(value));
        let numbers: Option<Vec<f32>> = values.iter().map(number).collect();
        let numbers = match (is_color, numbers.as_deref()) {
            (true, Some(&[r, g, b])) => vec![r, g, b],
            // A single number is the value of all three channels.
            (true, Some(&[grey])) => vec![grey; 3],
            (false, Some(&[number])) => vec![number],
            _ => return Err(self.syntax(line, expected, text)),
        };
        let Some(material) = self.materials.last_mut() else {
            return Err(self.syntax(line, "`newmtl name` before the first figure of a material", text));
        };
        material.values.insert(key.to_vec(), numbers);
        Ok(())
    }

    fn material(&mut self, line: usize, name: &[u8]) -> Result<(), InputError> {
        if name.is_empty() {
            return Err(self.syntax(line, "the name of a material `newmtl name`", name));
        }
        let name = decoded(name);
        if !self.seen.insert(name.clone()) {
            return Err(input_error!("crossbar::model::second_material" =>
                "expected each material once, found a second `newmtl {name}`"; help "rename one of the two")
            .at(FilePlace::line(self.name, line)));
        }
        self.materials.push(MaterialText { line, name, values: BTreeMap::new() });
        Ok(())
    }

    fn syntax(&self, line: usize, expected: &'static str, found: &[u8]) -> InputError {
        let place = FilePlace::line(self.name, line);
        syntax_error(place, expected, quoted(found))
    }
}

fn assemble(read: &MaterialText, path: &Path, mut notes: Option<&mut Vec<ModelNote>>) -> Result<Material, InputError> {
    let MaterialText { line, name, .. } = read;
    let (line, name) = (*line, name.as_str());
    let mut note = |of: &dyn Fn(FilePlace, String) -> ModelNote| {
        let notes = notes.as_deref_mut();
        notes.map(|notes| notes.push(of(FilePlace::line(path, line), name.into()))).is_some()
    };
    let wrong = |expected, found: String| material_error(FilePlace::line(path, line), name, expected, found);
    let model = read.number("illum").map_or(2, |model| model as u8);
    let (mut diffuse, mut specular) = (read.color("Kd"), read.color("Ks"));
    let sum = largest_reflectance(model, diffuse, specular);
    if sum > 1.0 + ROUNDING && note(&|place, material| ModelNote::Scaled { place, material, sum }) {
        for channel in diffuse.iter_mut().chain(&mut specular).flatten() {
            // Rounding up must not give a reflectance above 1.
            *channel = (*channel / sum).min(1.0);
        }
    }
    let albedo = diffuse.unwrap_or([0.0; 3]);
    let passes = read.number("d").map(|opaque| 1.0 - opaque).or(read.number("Tr"));
    let surface = match model {
        4 | 6 | 7 | 9 => {
            let transmittance = read.color("Tf").unwrap_or([passes.unwrap_or(1.0); 3]);
            Surface::Glass { index: read.number("Ni").unwrap_or(INDEX), transmittance }
        }
        _ if passes.is_some_and(|passes| {
            passes > 0.0 && !note(&|place, material| ModelNote::Opaque { place, material, passes })
        }) =>
        {
            let expected = "`illum 6` where `d` is below 1 or `Tr` above 0: only glass lets light pass";
            return Err(wrong(expected, format!("illum {model}")));
        }
        3 | 5 | 8 => Surface::Mirror { reflectance: specular.unwrap_or([1.0; 3]) },
        _ => match specular.filter(|specular| specular.iter().any(|&channel| channel > 0.0)) {
            None => Surface::Diffuse { albedo },
            Some(specular) => {
                let mut exponent = read.number("Ns").unwrap_or(EXPONENT);
                let widest = |place, material| ModelNote::Exponent { place, material, exponent: LEAST_EXPONENT };
                if exponent <= 0.0 && note(&widest) {
                    exponent = LEAST_EXPONENT;
                }
                if exponent <= 0.0 {
                    return Err(wrong("`Ns` above 0 where `Ks` is", exponent.to_string()));
                }
                if let Some(channel) = (0..3).find(|&c| albedo[c] + specular[c] > 1.0 + ROUNDING) {
                    let sum = albedo[channel] + specular[channel];
                    return Err(wrong("`Kd` + `Ks` of at most 1 per channel: lower one of the two", sum.to_string()));
                }
                Surface::Glossy { albedo, specular, exponent }
            }
        },
    };
    let emission = read.color("Ke").unwrap_or([0.0; 3]);
    Ok(Material { name: name.into(), surface, emission })
}

fn largest_reflectance(model: u8, diffuse: Option<Color>, specular: Option<Color>) -> f32 {
    let (diffuse, specular) = (diffuse.unwrap_or_default(), specular.unwrap_or_default());
    let of = |channel: usize| match model {
        4 | 6 | 7 | 9 => 0.0,
        3 | 5 | 8 => specular[channel],
        _ => diffuse[channel] + specular[channel],
    };
    [0, 1, 2].map(of).into_iter().fold(0.0, f32::max)
}
