//! Results of every instruction at one pixel, as text and as JSON.

use refsim::{
    exec::{FragmentFormats, Step, inputs_read},
    isa::{Program, Register, RegisterFile},
    machine::FragmentTrace,
    num::{Flags, Format},
    raster::{COLOR_COMPONENT, FOG_COMPONENT, POSITION_COMPONENT, TEXCOORD_COMPONENT},
    texture::ChannelClass,
};
use serde_json::{Map, Value, json};

use super::super::{
    Out,
    words::{fate, letters},
};
use crate::{
    case::{PixelTrace, Setup},
    compare::Number,
    report::{Cell, Table},
};

/// A trace with the case that it is of.
pub(super) struct Traced<'a> {
    pub(super) setup: &'a Setup,
    pub(super) trace: &'a PixelTrace,
    /// True if the executor reports exceptions of instructions.
    pub(super) knows_flags: bool,
}

/// A named value.
struct TraceRow {
    name: String,
    number: Number,
}

impl TraceRow {
    fn new(program: &Program, register: &Register, component: usize, format: Format, bits: u32) -> Self {
        Self { name: crate::compare::component(program, register, component), number: Number { format, bits } }
    }

    fn json(&self) -> Value {
        json!({ "name": self.name, "value": self.number.decimal(), "bits": self.number.hex() })
    }
}

fn flag_names(flags: Flags) -> Vec<String> {
    flags.iter_names().map(|(name, _)| name.to_lowercase().replace('_', " ")).collect()
}

impl Traced<'_> {
    fn format(&self) -> Format {
        self.setup.profile.rules.format
    }

    /// The program's inputs from the rasteriser, as far as they can be read, and the depth.
    fn interpolated(&self, fragment: &FragmentTrace) -> Vec<TraceRow> {
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

    fn delivered(&self, fragment: &FragmentTrace) -> Vec<TraceRow> {
        let registers = fragment.shading.delivered.iter();
        registers
            .flat_map(|(r, value)| (0..4).map(|c| TraceRow::new(&self.setup.pixel, r, c, self.format(), value[c])))
            .collect()
    }

    /// Results of a step, component by component; truth values of predicates are 0 and 1.
    fn written(&self, step: &Step) -> Vec<TraceRow> {
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

    /// The fragment's depth, if the program decides one, and the targets before and after.
    fn stored(&self, fragment: &FragmentTrace) -> Table {
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

    /// Says that nothing covers the pixel, and what to do.
    fn nothing(&self) -> String {
        let [x, y] = self.trace.pixel;
        let text = format!("no triangle of the draw covers pixel {x}, {y}");
        match self.trace.nearest {
            Some([x, y]) => format!("{text}; the nearest that one covers is {x}, {y}"),
            None => format!(
                "{text}, nor any within 16 columns and rows of it; look at the counts of triangles and fragments, \
                 and at `cull` and `convention` of the case"
            ),
        }
    }

    pub(super) fn print(&self, out: &mut Out) -> miette::Result<()> {
        let [x, y] = self.trace.pixel;
        let count = self.trace.fragments.len();
        if count == 0 {
            out.line(self.nothing())?;
            return Ok(());
        }
        for (index, fragment) in self.trace.fragments.iter().enumerate() {
            if index > 0 {
                out.line("")?;
            }
            let (instance, triangle) = (fragment.instance, fragment.triangle);
            out.line(format_args!(
                "pixel {x}, {y} of draw 0, pass {} of {count}: instance {instance}, triangle {triangle}",
                index + 1
            ))?;
            out.line("")?;
            out.table(&self.inputs(fragment))?;
            out.line("")?;
            out.table(&self.steps(fragment))?;
            out.line("")?;
            out.line(self.result(fragment))?;
            out.line("")?;
            out.table(&self.stored(fragment))?;
        }
        Ok(())
    }

    fn inputs(&self, fragment: &FragmentTrace) -> Table {
        let mut table = Table::new("Inputs", &["input", "interpolated", "bits", "as read", "bits "]);
        let delivered = self.delivered(fragment);
        for row in self.interpolated(fragment) {
            let read = delivered.iter().find(|read| read.name == row.name);
            table.push([
                row.name.into(),
                row.number.decimal().into(),
                row.number.hex().into(),
                read.map(|read| read.number.decimal()).into(),
                read.map(|read| read.number.hex()).into(),
            ]);
        }
        table
    }

    fn steps(&self, fragment: &FragmentTrace) -> Table {
        let headings = ["instruction", "line", "text", "register", "value", "bits", "flags"];
        let all = if self.knows_flags { 7 } else { 6 };
        let mut table = Table::new("Steps", &headings[..all]);
        for step in &fragment.shading.steps {
            let Some(instruction) = self.setup.pixel.instructions.get(step.instruction) else { continue };
            let line = self.setup.pixel_text.line(instruction.span);
            let flags = flag_names(step.flags).join(", ");
            let mut first: Vec<Cell> = vec![step.instruction.into(), line.line.into(), line.text.into()];
            let rows = self.written(step);
            if rows.is_empty() {
                table.push(first.into_iter().chain([Cell::Empty, Cell::Empty, Cell::Empty, flags.into()]).take(all));
                continue;
            }
            for (i, row) in rows.into_iter().enumerate() {
                let flags = if i == 0 { Cell::from(flags.as_str()) } else { Cell::Empty };
                let place = if i == 0 { std::mem::take(&mut first) } else { vec![Cell::Empty; 3] };
                let written = [row.name.into(), row.number.decimal().into(), row.number.hex().into(), flags];
                table.push(place.into_iter().chain(written).take(all));
            }
        }
        table
    }

    /// The fragment's result, in a line.
    fn result(&self, fragment: &FragmentTrace) -> String {
        let own = fragment.shading.output.depth.map(|depth| {
            let number = Number { format: depth.format, bits: depth.bits };
            format!("the program decides depth {} ({}); ", number.decimal(), number.hex())
        });
        format!("{}the fragment {}", own.unwrap_or_default(), fate(fragment.shading.fate))
    }

    pub(super) fn document(&self) -> Value {
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
            out.insert("source".to_owned(), json!(self.setup.pixel_text.line(instruction.span)));
            out.insert("register".to_owned(), instruction.destination.map(|d| d.register.to_string()).into());
        }
        out.insert("mask".to_owned(), letters(step.mask).into());
        out.insert("written".to_owned(), self.written(step).iter().map(TraceRow::json).collect());
        let flags = self.knows_flags.then(|| flag_names(step.flags));
        out.insert("flags".to_owned(), flags.map_or(Value::Null, |flags| json!(flags)));
        Value::Object(out)
    }
}
