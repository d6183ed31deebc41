//! Material libraries (MTL).
//!
//! A first pass checks every used statement; tobj then reads the checked lines. Used are
//! `newmtl Kd Ks Ke Ns Ni Tf d Tr illum`; all others (ambient colours, textures) are ignored.
//!
//! | `illum` | surface |
//! |---|---|
//! | 0, 1, 2, 10, none | diffuse `Kd`; glossy with `Ks` and `Ns` where `Ks` is not zero |
//! | 3, 5, 8 | mirror `Ks` (1 where there is none) |
//! | 4, 6, 7, 9 | glass of index `Ni` (1.5) that lets `Tf` pass (else 1 - `d`, else 1) |
//!
//! `Ke` is emission. A reflectance lies in [0, 1], and so does `Kd` + `Ks` of a glossy surface. Transparency (`d` below
//! 1, `Tr` above 0) needs glass, and gloss needs an `Ns` above 0. Files of modelling tools often violate these rules:
//! when a scene is read with notes, `Kd` and `Ks` are scaled together, materials that are no glass become opaque, and
//! both are noted.

use std::collections::BTreeSet;
use std::path::Path;

use super::super::error::{FilePlace, ModelError};
use super::super::lines::{logical_lines, single, words};
use super::super::model_note::ModelNote;
use super::super::{NumberError, quoted};
use crate::scene::{Color, Material, Surface};

/// Exponent of a glossy material without one.
const EXPONENT: f32 = 10.0;
/// The exponent that replaces `Ns 0`.
const LEAST_EXPONENT: f32 = 1.0;
/// Index of refraction of glass without one.
const INDEX: f32 = 1.5;
/// Tolerance of `Kd` + `Ks` above 1, for the rounding of numbers that sum to 1.
const ROUNDING: f32 = 1e-6;

/// Reads the materials of a library, in order; `name` is the file's name in messages. Never panics.
///
/// # Errors
/// [`ModelError`], with the line where there is one.
pub fn parse_mtl(bytes: &[u8], name: &Path) -> Result<Vec<Material>, ModelError> {
    read_mtl(bytes, name, None)
}

/// [`parse_mtl`]; with a list of notes, unsupported materials are changed into supported ones and noted.
pub(super) fn read_mtl(
    bytes: &[u8],
    name: &Path,
    mut notes: Option<&mut Vec<ModelNote>>,
) -> Result<Vec<Material>, ModelError> {
    let (clean, lenient) = (String::new(), notes.is_some());
    let mut reader = MtlReader { name, clean, lenient, materials: Vec::new(), seen: BTreeSet::new() };
    for (line, text) in logical_lines(bytes) {
        reader.line(line, &text)?;
    }
    let (read, _) =
        tobj::load_mtl_buf(&mut reader.clean.as_bytes()).map_err(|reason| ModelError::Loader(name.into(), reason))?;
    let pairs = reader.materials.iter().zip(read);
    pairs.map(|((line, material), read)| assemble(&read, name, *line, material, notes.as_deref_mut())).collect()
}

/// The first pass: the checked lines for tobj, and each material's line and name.
struct MtlReader<'a> {
    name: &'a Path,
    clean: String,
    /// True if reflectances above 1 are accepted, to be scaled later.
    lenient: bool,
    materials: Vec<(usize, String)>,
    seen: BTreeSet<String>,
}

/// A line of a library, split into words.
struct Statement<'a> {
    line: usize,
    text: &'a [u8],
    key: &'a [u8],
    values: &'a [&'a [u8]],
}

impl MtlReader<'_> {
    fn line(&mut self, line: usize, text: &[u8]) -> Result<(), ModelError> {
        let words = words(text);
        let Some((&key, values)) = words.split_first() else { return Ok(()) };
        let here = &Statement { line, text, key, values };
        match key {
            b"newmtl" => self.material(line, text[6..].trim_ascii()),
            b"Kd" | b"Ks" if self.lenient => self.color(here, "three numbers of at least 0", |_| true),
            b"Kd" | b"Ks" | b"Tf" => self.color(here, "three numbers from 0 to 1", |v| v <= 1.0),
            b"Ke" => self.color(here, "three numbers of at least 0", |_| true),
            b"Ns" => self.number(here, "`Ns` with a number of at least 0", |_| true),
            b"Ni" => self.number(here, "`Ni` with a number above 0", |v| v > 0.0),
            b"d" => self.number(here, "`d` with a number from 0 to 1", |v| v <= 1.0),
            b"Tr" => self.number(here, "`Tr` with a number from 0 to 1", |v| v <= 1.0),
            b"illum" => {
                let model = |v: f32| v <= 10.0 && v.fract() == 0.0;
                self.number(here, "`illum` with a whole number from 0 to 10", model)
            }
            _ => Ok(()),
        }
    }

    fn material(&mut self, line: usize, name: &[u8]) -> Result<(), ModelError> {
        let text = std::str::from_utf8(name).ok().filter(|name| !name.is_empty());
        let Some(text) = text else {
            return Err(self.syntax(line, "the name of a material `newmtl name`", name));
        };
        if !self.seen.insert(text.into()) {
            return Err(ModelError::SecondMaterial(FilePlace::line(self.name, line), text.into()));
        }
        // tobj gets a number in place of the name, because names may hold characters that it cannot parse.
        self.clean.push_str(&format!("newmtl {}\n", self.materials.len()));
        self.materials.push((line, text.into()));
        Ok(())
    }

    fn color(
        &mut self,
        here: &Statement<'_>,
        expected: &'static str,
        allowed: impl Fn(f32) -> bool,
    ) -> Result<(), ModelError> {
        self.not_too_large(here)?;
        let channels: Vec<f32> = here.values.iter().filter_map(|word| number(word)).filter(|&v| allowed(v)).collect();
        // A single number stands for all three channels.
        let channels = match (here.values.len(), channels[..].len()) {
            (3, 3) => [channels[0], channels[1], channels[2]],
            (1, 1) => [channels[0]; 3],
            _ => return Err(self.syntax(here.line, expected, here.text)),
        };
        self.keep(here, &channels)
    }

    fn number(
        &mut self,
        here: &Statement<'_>,
        expected: &'static str,
        allowed: impl Fn(f32) -> bool,
    ) -> Result<(), ModelError> {
        self.not_too_large(here)?;
        let value = if let &[word] = here.values { number(word).filter(|&v| allowed(v)) } else { None };
        match value {
            Some(value) => self.keep(here, &[value]),
            None => Err(self.syntax(here.line, expected, here.text)),
        }
    }

    /// Refuses a number that overflows single precision, before the key's own range is checked.
    fn not_too_large(&self, here: &Statement<'_>) -> Result<(), ModelError> {
        let large = here.values.iter().find(|word| single(word) == Err(NumberError::TooLarge));
        large.map_or(Ok(()), |word| Err(self.syntax(here.line, NumberError::TooLarge.expected(), word)))
    }

    fn keep(&mut self, here: &Statement<'_>, values: &[f32]) -> Result<(), ModelError> {
        if self.materials.is_empty() {
            return Err(self.syntax(here.line, "`newmtl name` before the first figure of a material", here.text));
        }
        self.clean.push_str(&String::from_utf8_lossy(here.key));
        for value in values {
            self.clean.push_str(&format!(" {value}"));
        }
        self.clean.push('\n');
        Ok(())
    }

    fn syntax(&self, line: usize, expected: &'static str, found: &[u8]) -> ModelError {
        let place = FilePlace::line(self.name, line);
        ModelError::Syntax { place, expected: expected.into(), found: quoted(found) }
    }
}

/// A finite number of at least 0.
fn number(word: &[u8]) -> Option<f32> {
    single(word).ok().filter(|&value| value >= 0.0)
}

/// A material from the values that tobj has read.
fn assemble(
    read: &tobj::Material,
    path: &Path,
    line: usize,
    name: &str,
    mut notes: Option<&mut Vec<ModelNote>>,
) -> Result<Material, ModelError> {
    let mut note = |of: &dyn Fn(FilePlace, String) -> ModelNote| {
        let notes = notes.as_deref_mut();
        notes.map(|notes| notes.push(of(FilePlace::line(path, line), name.into()))).is_some()
    };
    let wrong = |expected, found: String| ModelError::Material {
        place: FilePlace::line(path, line),
        name: name.into(),
        expected,
        found,
    };
    let unknown = |key: &str| -> Option<Vec<f32>> {
        let text = read.unknown_param.get(key)?;
        text.split_whitespace().map(|word| word.parse().ok()).collect()
    };
    let model = read.illumination_model.unwrap_or(2);
    let (mut diffuse, mut specular) = (read.diffuse, read.specular);
    let sum = largest_reflectance(model, diffuse, specular);
    if sum > 1.0 + ROUNDING && note(&|place, material| ModelNote::Scaled { place, material, sum }) {
        for channel in diffuse.iter_mut().chain(&mut specular).flatten() {
            // Rounded up, the surface would reflect more than all light.
            *channel = (*channel / sum).min(1.0);
        }
    }
    let albedo = diffuse.unwrap_or([0.0; 3]);
    let passes = match (read.dissolve, unknown("Tr").as_deref()) {
        (Some(opaque), _) => Some(1.0 - opaque),
        (None, Some(&[clear])) => Some(clear),
        _ => None,
    };
    let surface = match model {
        4 | 6 | 7 | 9 => {
            let filter = unknown("Tf").and_then(|channels| Color::try_from(channels).ok());
            let transmittance = filter.unwrap_or([passes.unwrap_or(1.0); 3]);
            Surface::Glass { index: read.optical_density.unwrap_or(INDEX), transmittance }
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
                let mut exponent = read.shininess.unwrap_or(EXPONENT);
                let widest = |place, material| ModelNote::Exponent { place, material, exponent: LEAST_EXPONENT };
                if exponent <= 0.0 && note(&widest) {
                    exponent = LEAST_EXPONENT;
                }
                if exponent <= 0.0 {
                    return Err(wrong("`Ns` above 0 where `Ks` is", exponent.to_string()));
                }
                if let Some(channel) = (0..3).find(|&c| albedo[c] + specular[c] > 1.0 + ROUNDING) {
                    let sum = albedo[channel] + specular[channel];
                    return Err(wrong("`Kd` + `Ks` of at most 1 a channel: lower one of the two", sum.to_string()));
                }
                Surface::Glossy { albedo, specular, exponent }
            }
        },
    };
    let emission = read.emissive.unwrap_or([0.0; 3]);
    Ok(Material { name: name.into(), surface, emission })
}

/// The largest reflectance in any channel of a material with these colors.
fn largest_reflectance(model: u8, diffuse: Option<Color>, specular: Option<Color>) -> f32 {
    let (diffuse, specular) = (diffuse.unwrap_or_default(), specular.unwrap_or_default());
    let of = |channel: usize| match model {
        4 | 6 | 7 | 9 => 0.0,
        3 | 5 | 8 => specular[channel],
        _ => diffuse[channel] + specular[channel],
    };
    [0, 1, 2].map(of).into_iter().fold(0.0, f32::max)
}
