//! Results of every instruction at one pixel, as tables.

use refsim::machine::FragmentTrace;

use super::super::Out;
use crate::{
    case::{Traced, fate, flag_names},
    compare::Number,
    report::{Cell, Table},
};

pub(super) struct ShownTrace<'a>(pub(super) Traced<'a>);

impl ShownTrace<'_> {
    fn nothing(&self) -> String {
        let [x, y] = self.0.trace.pixel;
        let text = format!("no triangle of the draw covers pixel {x}, {y}");
        match self.0.trace.nearest {
            Some([x, y]) => format!("{text}; the nearest covered pixel is {x}, {y}"),
            None => format!(
                "{text} or any pixel within 16 columns and rows of it; look at the counts of triangles and fragments, \
                 and at `cull` and `convention` of the case"
            ),
        }
    }

    pub(super) fn print(&self, out: &mut Out) -> miette::Result<()> {
        let [x, y] = self.0.trace.pixel;
        let count = self.0.trace.fragments.len();
        if count == 0 {
            out.line(self.nothing())?;
            return Ok(());
        }
        for (index, fragment) in self.0.trace.fragments.iter().enumerate() {
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
            out.table(&self.0.stored(fragment))?;
        }
        Ok(())
    }

    fn inputs(&self, fragment: &FragmentTrace) -> Table {
        let mut table = Table::new("Inputs", &["input", "interpolated", "bits", "as read", "bits "]);
        let delivered = self.0.delivered(fragment);
        for row in self.0.interpolated(fragment) {
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
        // Expressions of WGSL are longer than instructions.
        let is_wgsl = self.0.setup.pixel_text.is_wgsl();
        let places = if is_wgsl { "step line,_expression" } else { "instruction line text" };
        let mut table = Table::of("Steps", &format!("{places} register value bits flags"));
        for step in &fragment.shading.steps {
            let setup = self.0.setup;
            let Some(line) = setup.pixel_text.instruction(&setup.pixel, step.instruction) else { continue };
            let place: Vec<Cell> = match is_wgsl {
                true => vec![step.instruction.into(), format!("{}: {}", line.line, line.text).into()],
                false => vec![step.instruction.into(), line.line.into(), line.text.into()],
            };
            let blank = vec![Cell::Empty; place.len()];
            let flags: Cell = flag_names(step.flags).join(", ").into();
            let rows = self.0.written(step);
            if rows.is_empty() {
                table.push(place.into_iter().chain([Cell::Empty, Cell::Empty, Cell::Empty, flags]));
                continue;
            }
            for (i, row) in rows.into_iter().enumerate() {
                let (place, flags) = if i == 0 { (&place, flags.clone()) } else { (&blank, Cell::Empty) };
                let written = [row.name.into(), row.number.decimal().into(), row.number.hex().into(), flags];
                table.push(place.iter().cloned().chain(written));
            }
        }
        table
    }

    fn result(&self, fragment: &FragmentTrace) -> String {
        let own = fragment.shading.output.depth.map(|depth| {
            let number = Number { format: depth.format, bits: depth.bits };
            format!("the program sets depth to {} ({}); ", number.decimal(), number.hex())
        });
        format!("{}the fragment {}", own.unwrap_or_default(), fate(fragment.shading.fate))
    }
}
