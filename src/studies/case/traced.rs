//! Trace of one pixel of a case, as rows of named values and as a JSON document.

use refsim::{
    exec::{FragmentFormats, Step, inputs_read},
    isa::{Mask, Program, Register, RegisterFile},
    machine::{Executor, FragmentTrace},
    num::{Flags, Format},
    output::FragmentFate,
    raster::{COLOR_COMPONENT, FOG_COMPONENT, POSITION_COMPONENT, TEXCOORD_COMPONENT},
    texture::ChannelClass,
};
use serde_json::{Map, Value, json};

use super::{CaseError, Loaded, Setup};
use crate::{compare::Number, report::Table};

/// Radius of the search for a covered pixel around an uncovered one, in pixels.
const AROUND: u32 = 16;

/// Trace of a pixel.
#[derive(Clone, Debug)]
pub struct PixelTrace {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Fragments of all triangles that cover the pixel, in order.
    pub fragments: Vec<FragmentTrace>,
    /// Nearest covered pixel within 16 columns and rows, if there are no fragments.
    pub nearest: Option<[u32; 2]>,
}

/// Traces a pixel; fails if the device cannot execute the case, or the pixel lies outside the targets.
pub fn trace(setup: &Setup, executor: impl Into<Executor>, pixel: [u32; 2]) -> Result<PixelTrace, CaseError> {
    let loaded = Loaded::new(setup, executor)?;
    let [x, y] = pixel;
    let fragments: Vec<FragmentTrace> = loaded.trace(&[(x, y)])?.into_iter().flatten().collect();
    let nearest = if fragments.is_empty() { nearest(&loaded, setup.size, pixel)? } else { None };
    Ok(PixelTrace { pixel, fragments, nearest })
}

fn nearest(loaded: &Loaded<'_>, size: [u32; 2], pixel: [u32; 2]) -> Result<Option<[u32; 2]>, CaseError> {
    let range = |axis: usize| pixel[axis].saturating_sub(AROUND)..(pixel[axis] + AROUND + 1).min(size[axis]);
    let mut around: Vec<(u32, u32)> = range(1).flat_map(|y| range(0).map(move |x| (x, y))).collect();
    let square = |a: u32, b: u32| a.abs_diff(b).pow(2);
    around.sort_by_key(|&(x, y)| (square(x, pixel[0]) + square(y, pixel[1]), y, x));
    let traces = loaded.trace(&around)?;
    let covered = around.iter().zip(&traces).find(|(_, fragments)| !fragments.is_empty());
    Ok(covered.map(|(&(x, y), _)| [x, y]))
}

/// A trace with its case.
#[derive(Clone, Copy, Debug)]
pub struct Traced<'a> {
    /// Case.
    pub setup: &'a Setup,
    /// Trace of the pixel.
    pub trace: &'a PixelTrace,
}

/// A named value.
#[derive(Clone, Debug)]
pub struct TraceRow {
    /// Name of the register's component, in program syntax.
    pub name: String,
    /// Value.
    pub number: Number,
}

impl TraceRow {
    fn new(program: &Program, register: &Register, component: usize, format: Format, bits: u32) -> Self {
        Self { name: crate::compare::component(program, register, component), number: Number { format, bits } }
    }

    fn json(&self) -> Value {
        json!({ "name": self.name, "value": self.number.decimal(), "bits": self.number.hex() })
    }
}

/// Names of exceptions: `divide by zero`.
pub fn flag_names(flags: Flags) -> Vec<String> {
    flags.iter_names().map(|(name, _)| name.to_lowercase().replace('_', " ")).collect()
}

impl Traced<'_> {
    fn format(&self) -> Format {
        self.setup.profile.rules.format
    }

    /// The program's inputs from the rasterizer that the program may read, and the depth.
    pub fn interpolated(&self, fragment: &FragmentTrace) -> Vec<TraceRow> {
        let reads = inputs_read(&self.setup.pixel);
        let input = &fragment.shading.input;
        let sets = input.t.iter().enumerate().map(|(n, t)| (RegisterFile::Texture, n, TEXCOORD_COMPONENT, t));
        let position = [(RegisterFile::WindowPosition, 0, POSITION_COMPONENT, &input.position)];
        let colors = input.v.iter().enumerate().map(|(n, v)| (RegisterFile::Input, n, COLOR_COMPONENT, v));
        let mut rows: Vec<TraceRow> = colors
            .chain(sets)
            .chain(position)
            .filter(|(_, n, first, _)| reads.has(first + 4 * n))
            .flat_map(|(file, n, _, value)| {
                let register = Register::new(file, n as u16);
                (0..4).map(move |c| TraceRow::new(&self.setup.pixel, &register, c, Format::FP32, value[c]))
            })
            .collect();
        if reads.has(FOG_COMPONENT) {
            let number = Number { format: Format::FP32, bits: input.fog };
            rows.push(TraceRow { name: "fog".to_owned(), number });
        }
        rows.push(TraceRow { name: "depth".to_owned(), number: Number { format: Format::FP32, bits: input.depth } });
        rows
    }

    /// The inputs as the program reads them.
    pub fn delivered(&self, fragment: &FragmentTrace) -> Vec<TraceRow> {
        let registers = fragment.shading.delivered.iter();
        registers
            .flat_map(|(r, value)| (0..4).map(|c| TraceRow::new(&self.setup.pixel, r, c, self.format(), value[c])))
            .collect()
    }

    /// Results of a step, component by component; truth values of predicates are 0 and 1.
    pub fn written(&self, step: &Step) -> Vec<TraceRow> {
        let instruction = self.setup.pixel.instructions.get(step.instruction);
        let Some(destination) = instruction.and_then(|i| i.destination) else { return Vec::new() };
        let file = destination.register.file;
        let truth = file == RegisterFile::Predicate;
        let format = FragmentFormats::new(&self.setup.profile.rules).of_file(file);
        let shown = |c: usize| {
            let one = if step.value[c] != 0 { self.format().one() } else { 0 };
            TraceRow::new(&self.setup.pixel, &destination.register, c, format, if truth { one } else { step.value[c] })
        };
        step.mask.components().map(shown).collect()
    }

    /// The fragment's depth, if the program writes one, and the targets before and after the fragment.
    pub fn stored(&self, fragment: &FragmentTrace) -> Table {
        let mut table = Table::new("Targets", &["surface", "before", "after"]);
        let (before, after) = (&fragment.before, &fragment.after);
        for (n, format) in self.setup.targets.iter().enumerate() {
            let digits = 2 * format.bytes();
            let shown = |raw: Option<u128>| {
                let raw = raw.unwrap_or_default();
                let channels = format.record().stored().iter().map(|channel| {
                    let bits = channel.code(raw);
                    match channel.class {
                        ChannelClass::Float(format) => Number { format, bits }.decimal(),
                        _ => bits.to_string(),
                    }
                });
                format!("{} (0x{raw:0digits$x})", channels.collect::<Vec<_>>().join(", "))
            };
            table.push([
                format!("target {n} {format}").into(),
                shown(before.colors[n]).into(),
                shown(after.colors[n]).into(),
            ]);
        }
        if let Some((format, ..)) = self.setup.depth {
            let shown = |stored: Option<u32>| {
                let stored = stored.unwrap_or_default();
                let single = Number { format: Format::FP32, bits: format.to_format(stored, Format::FP32) };
                format!("{} (0x{stored:x})", single.decimal())
            };
            table.push([format!("depth {format}").into(), shown(before.depth).into(), shown(after.depth).into()]);
        }
        table
    }

    /// Document for programs.
    pub fn document(&self) -> Value {
        let mut document = json!({
            "draw": 0,
            "pixel": self.trace.pixel,
            "passes": self.trace.fragments.iter().map(|fragment| self.pass_json(fragment)).collect::<Vec<_>>(),
        });
        if self.trace.fragments.is_empty() {
            document["nearest"] = json!(self.trace.nearest);
        }
        document
    }

    fn pass_json(&self, fragment: &FragmentTrace) -> Value {
        let rows = |rows: Vec<TraceRow>| rows.iter().map(TraceRow::json).collect::<Vec<_>>();
        let shading = &fragment.shading;
        json!({
            "instance": fragment.instance,
            "triangle": fragment.triangle,
            "part": fragment.part,
            "interpolated": rows(self.interpolated(fragment)),
            "inputs": rows(self.delivered(fragment)),
            "steps": shading.steps.iter().map(|step| self.step_json(step)).collect::<Vec<_>>(),
            "killed": shading.output.killed,
            "depth": shading.output.depth.map(|depth| {
                let number = Number { format: depth.format, bits: depth.bits };
                json!({ "value": number.decimal(), "bits": number.hex(), "format": depth.format.to_string() })
            }),
            "fate": fate(shading.fate),
            "surfaces": self.stored(fragment).json(),
        })
    }

    fn step_json(&self, step: &Step) -> Value {
        let mut out = Map::new();
        out.insert("instruction".to_owned(), step.instruction.into());
        if let Some(instruction) = self.setup.pixel.instructions.get(step.instruction) {
            let line = self.setup.pixel_text.instruction(&self.setup.pixel, step.instruction);
            out.insert("source".to_owned(), json!(line));
            out.insert("register".to_owned(), instruction.destination.map(|d| d.register.to_string()).into());
        }
        out.insert("mask".to_owned(), letters(step.mask).into());
        out.insert("written".to_owned(), self.written(step).iter().map(TraceRow::json).collect());
        out.insert("flags".to_owned(), flag_names(step.flags).into());
        Value::Object(out)
    }
}

/// The stage at which a fragment ended, as text.
pub const fn fate(fate: FragmentFate) -> &'static str {
    match fate {
        FragmentFate::KilledByShader => "is killed by the program",
        FragmentFate::AlphaFailed => "fails the alpha test",
        FragmentFate::DepthFailed => "fails the depth test",
        FragmentFate::Passed => "passes",
        FragmentFate::OutsideTile => "lies outside",
    }
}

/// The components of a mask: `xz`.
pub fn letters(mask: Mask) -> String {
    mask.components().map(|c| ['x', 'y', 'z', 'w'][c]).collect()
}
