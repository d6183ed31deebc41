//! Programs instruction by instruction: the results of the scalar executor at every pixel, and the buffers of the same
//! trace for the visitor's GPU, which repeats it with the number library and in its own floats.

use std::collections::BTreeMap;
use std::path::Path;

use refsim::exec::FragmentFormats;
use refsim::exec::wgsl::number::format_words;
use refsim::exec::wgsl::parts::Parts;
use refsim::exec::wgsl::{follow, kernel, program, texture};
use refsim::machine::{ExecutorKind, FragmentTrace, TraceBuffers};
use refsim::num::Format;
use refsim::output::FragmentFate;
use serde_json::{Value, json};

use super::encode::{base64, base64_words};
use super::program_cases::{self, ProgramCase, SIDE};
use crate::case::{Loaded, Setup};
use crate::study::StudyError;

/// Flag in the word `special` of a format: operations run in the adapter's own floats.
const NATIVE: u32 = 2;
/// Index of the word `special` in the parameters of a draw, which begin with the register format.
const SPECIAL_WORD: usize = 6;
const SINGLE: &str = "e8m23";

#[derive(Default)]
struct Buffers {
    all: Vec<String>,
    known: BTreeMap<Vec<u32>, usize>,
}

/// The programs with their traces. `shaders` run programs with the number library, and in the adapter's own floats;
/// `record` has the sizes of a record's header and of a step, in words, and the first words of a record with a fragment
/// and of a record to be continued; `resumes` is the word of a draw that marks a continuation. A program's `case` is
/// the case file before and after the line of its format, and `native` the program in single precision for the
/// adapter's floats.
pub(super) fn programs() -> Result<Value, StudyError> {
    let mut buffers = Buffers::default();
    let mut parts = [Parts::default(), Parts::default()];
    // A format's words hold the flag of the adapter's own floats.
    parts[1].add("HAS_FORMATS");
    let mut programs = Vec::new();
    for case in program_cases::all() {
        let formats = [None].into_iter().chain(case.formats.map(Some));
        let variants =
            formats.map(|format| variant(&case, format, &mut buffers, &mut parts[0])).collect::<Result<Vec<_>, _>>()?;
        let setup = setup(&case, Some(SINGLE))?;
        let mut native = loaded(&setup)?.trace_buffers(&pixels())?;
        native.draw[SPECIAL_WORD] += NATIVE;
        parts[1].extend(&native.parts);
        let native = buffers.job(native);
        let source: Vec<String> = setup.pixel_text.named_source().text().lines().map(str::to_owned).collect();
        let (ProgramCase { name, title, about, .. }, texts) = (&case, case.parts());
        programs.push(json!({
            "name": name, "title": title, "about": about, "source": source, "case": texts, "variants": variants,
            "native": native,
        }));
    }
    let [exact, native] = parts;
    Ok(json!({
        "side": SIDE,
        "shaders": [exact.of(&follow::module(), follow::ENTRY), native.of(&native_module(), follow::ENTRY)],
        "entry": follow::ENTRY,
        "record": [follow::HEAD as u32, follow::STEP_WORDS as u32, follow::FRAGMENT, follow::UNFINISHED],
        "resumes": kernel::RESUMES,
        "buffers": buffers.all,
        "programs": programs,
    }))
}

/// The module of traces with the machine's arithmetic in the adapter's own floats.
fn native_module() -> String {
    let machine = ["short", "long", "dot"]
        .into_iter()
        .fold(program::machine(), |text, name| text.replace(&format!("n_{name}("), &format!("native_{name}(")));
    let own = concat!(include_str!("assets/native_operation.wgsl"), include_str!("assets/native_program.wgsl"));
    format!("{}{machine}{}const NATIVE: u32 = {NATIVE}u;\n{own}", follow::text(), texture::library())
}

fn pixels() -> Vec<(u32, u32)> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))).collect()
}

fn setup(case: &ProgramCase, format: Option<&str>) -> Result<Setup, StudyError> {
    let text = case.text(format);
    Ok(Setup::from_bytes(&format!("{}.toml", case.name), text.as_bytes(), Path::new(""))?)
}

fn loaded(setup: &Setup) -> Result<Loaded<'_>, StudyError> {
    Ok(Loaded::new(setup, ExecutorKind::Scalar)?)
}

/// A program in a format: its trace, and the results at every pixel. `named` is the format that the case names, if it
/// is not the device's own. `entries` are a pixel's input registers, then its instructions; `values` are the written
/// values by pixel, entry and component, little-endian patterns of the fewest bytes that hold the format; `fates` are
/// the outcomes of the pixels' fragments, as in records.
fn variant(
    case: &ProgramCase,
    format: Option<&'static str>,
    buffers: &mut Buffers,
    parts: &mut Parts,
) -> Result<Value, StudyError> {
    let setup = setup(case, format)?;
    let mut loaded = loaded(&setup)?;
    let pixels = pixels();
    let traced = loaded.trace(&pixels)?;
    let made = loaded.trace_buffers(&pixels)?;
    loaded.draw()?;
    let mut reader = TraceReader { setup: &setup, formats: Vec::new() };
    let (mut entries, mut values, mut fates) = (Vec::new(), Vec::new(), Vec::new());
    for (&(x, y), fragments) in pixels.iter().zip(&traced) {
        let other = |what: &str| StudyError::new("page::trace", format!("{} at pixel {x}, {y}: {what}", case.name));
        let [fragment] = fragments.as_slice() else { return Err(other("expected one fragment")) };
        let (found, written) = reader.read(fragment);
        if entries.is_empty() {
            entries = found;
        } else if entries != found {
            return Err(other("expected the same steps at every pixel"));
        }
        values.extend(written);
        fates.push(fate(fragment.shading.fate));
    }
    parts.extend(&made.parts);
    let picture: Vec<u8> = loaded.targets()?.first().map_or_else(Vec::new, |image| {
        pixels.iter().flat_map(|&(x, y)| [16, 8, 0].map(|shift| (image.raw(0, 0, y, x) >> shift) as u8)).collect()
    });
    Ok(json!({
        "device": case.device,
        "format": setup.profile.rules.format.to_string(),
        "named": format,
        "job": buffers.job(made),
        "formats": reader.formats,
        "entries": entries,
        "values": base64(values),
        "fates": base64(fates),
        "picture": base64(picture),
    }))
}

struct TraceReader<'s> {
    setup: &'s Setup,
    /// Formats of values, by the entries' `format`.
    formats: Vec<Value>,
}

impl TraceReader<'_> {
    /// The entries: input registers, and instructions that write. `instruction` is the number in records, where the
    /// input registers follow the instructions; `line` counts from 0; `names` are the written components in the
    /// language.
    fn read(&mut self, fragment: &FragmentTrace) -> (Vec<Value>, Vec<u8>) {
        let program = &self.setup.pixel;
        let formats = FragmentFormats::new(&self.setup.profile.rules);
        let mut bytes = Vec::new();
        let first = program.instructions.len();
        let inputs = fragment
            .shading
            .delivered
            .iter()
            .zip(first..)
            .map(|((register, value), number)| (number, None, *register, 15, *value, formats.full));
        let steps = fragment.shading.steps.iter().filter_map(|step| {
            let instruction = program.instructions.get(step.instruction)?;
            let register = instruction.destination?.register;
            let line = self.setup.pixel_text.line(instruction.span).line - 1;
            Some((step.instruction, Some(line), register, step.mask.0, step.value, formats.of_file(register.file)))
        });
        let all: Vec<_> = inputs.chain(steps).collect();
        let entries = all
            .into_iter()
            .map(|(instruction, line, register, mask, value, format)| {
                let written: Vec<usize> = (0..4).filter(|c| (mask >> c) & 1 == 1).collect();
                let size = format.width().div_ceil(8) as usize;
                bytes.extend(written.iter().flat_map(|&c| value[c].to_le_bytes().into_iter().take(size)));
                let names: Vec<String> = written.iter().map(|&c| self.setup.component(&register, c)).collect();
                let format = self.index(&format);
                json!({ "instruction": instruction, "line": line, "mask": mask, "names": names, "format": format })
            })
            .collect();
        (entries, bytes)
    }

    fn index(&mut self, format: &Format) -> usize {
        let found = json!({ "name": format.to_string(), "words": format_words(format), "width": format.width() });
        self.formats.iter().position(|known| *known == found).unwrap_or_else(|| {
            self.formats.push(found);
            self.formats.len() - 1
        })
    }
}

const fn fate(fate: FragmentFate) -> u8 {
    match fate {
        FragmentFate::KilledByShader => 1,
        FragmentFate::AlphaFailed => 2,
        FragmentFate::DepthFailed => 3,
        FragmentFate::Passed => 4,
        FragmentFate::OutsideTile => 0,
    }
}

impl Buffers {
    fn keep(&mut self, words: Vec<u32>) -> usize {
        let all = &mut self.all;
        *self.known.entry(words).or_insert_with_key(|words| {
            all.push(base64_words(words.iter().copied()));
            all.len() - 1
        })
    }

    /// The indices of a trace's buffers, and their sizes in words where they are larger than their contents.
    fn job(&mut self, made: TraceBuffers) -> Value {
        json!({
            "draw": self.keep(made.draw),
            "setups": self.keep(made.setups),
            "tiles": self.keep(made.tiles),
            "samplers": self.keep(made.samplers),
            "video": self.keep(made.video),
            "code": self.keep(made.code),
            "record_words": made.record_words,
            "scratch_words": made.scratch_words,
            "count_words": made.count_words,
        })
    }
}
