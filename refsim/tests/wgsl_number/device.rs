//! The shader's results compared with `refsim::num`.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use refsim::exec::gpu::Gpu;
use refsim::exec::wgsl::number::{format_words, library, source_word};
use refsim::exec::wgsl::parts::Parts;
use refsim::num::{Format, NumberOperation, ops};

use crate::environment::by_form;
use crate::operands::{cards, edges, formats, pattern};
use crate::random::Random;
use crate::reference::reference;

/// Format of the operands of step operations, whatever the format of the result.
const SINGLE: Format = Format::FP32;

/// The library, extended by the text `more`, which contains the entry point.
pub(crate) fn text(more: &str, entry: &str) -> String {
    Parts::all().of(&(library() + more), entry)
}

#[derive(Clone, Copy, Debug)]
struct Item {
    operation: NumberOperation,
    /// Indices in the list of formats: of the result, and of the source of a conversion.
    format: usize,
    source: usize,
    operands: [u32; 3],
}

impl Item {
    fn words(&self, formats: &[Format]) -> [u32; 5] {
        let [a, b, c] = self.operands;
        let (b, c) = match self.operation {
            NumberOperation::Convert => (source_word(&formats[self.source]), self.source as u32),
            _ => (b, c),
        };
        [self.operation.word(), self.format as u32, a, b, c]
    }

    fn expected(&self, formats: &[Format]) -> Option<u32> {
        let [a, b, c] = self.operands;
        let format = &formats[self.format];
        let source = &formats[self.source];
        match self.operation {
            // Programs copy these patterns.
            NumberOperation::Convert if format.takes_patterns_of(source) => None,
            NumberOperation::Convert => Some(ops::convert(source, format, a).bits),
            // Programs in units of cards do not use it.
            NumberOperation::Factor if format.unit.is_card() => None,
            operation => reference(operation, format, a, b, c),
        }
    }
}

/// Only the parts that an item needs: drivers compile units of cards and groups of operations faster separately than
/// together.
fn parts(formats: &[Format], item: &Item) -> Parts {
    let converts = item.operation == NumberOperation::Convert;
    let both = [formats[item.format], formats[if converts { item.source } else { item.format }]];
    let mut parts = Parts::default();
    if !both.iter().any(|format| format.unit.is_card()) {
        return parts.grown();
    }
    ["HAS_FORMATS", "HAS_FIXED", "HAS_NORMALIZED", "HAS_FINITE"].iter().for_each(|name| parts.add(name));
    both.iter().for_each(|format| parts.add_format(format));
    parts.add_operation(item.operation);
    parts
}

/// Runs the items and reports differences.
fn check(gpu: &Gpu, formats: &[Format], items: &[Item]) {
    let mut shaders: BTreeMap<Parts, Vec<Item>> = BTreeMap::new();
    for &item in items {
        shaders.entry(parts(formats, &item)).or_default().push(item);
    }
    shaders.iter().for_each(|(parts, items)| check_with(gpu, formats, items, parts));
}

fn check_with(gpu: &Gpu, formats: &[Format], items: &[Item], parts: &Parts) {
    let shader = parts.of(&(library() + include_str!("operations.wgsl")), "run_operations");
    let table: Vec<u32> = formats.iter().flat_map(format_words).collect();
    for part in items.chunks(1 << 18) {
        let words: Vec<u32> = part.iter().flat_map(|i| i.words(formats)).collect();
        let groups = [part.len().div_ceil(64) as u32, 1, 1];
        let found = gpu.compute(&shader, "run_operations", &[&table, &words], part.len(), groups);
        let found = found.expect("the shader runs");
        for (item, bits) in part.iter().zip(found) {
            let Some(expected) = item.expected(formats) else { continue };
            let (format, source) = (formats[item.format], formats[item.source]);
            assert_eq!(
                bits, expected,
                "{:?} in {format} of {:08x?} (from {source}): {bits:08x} for {expected:08x}",
                item.operation, item.operands
            );
        }
    }
}

/// Random operands of an operation.
fn random_item(
    words: &mut Random,
    formats: &[Format],
    all: &[Vec<u32>],
    operation: NumberOperation,
    format: usize,
) -> Item {
    let source = words.below(formats.len());
    let mut operands = [0; 3];
    for (i, operand) in operands.iter_mut().enumerate() {
        let of = if i == 0 && operation == NumberOperation::Convert { source } else { format };
        *operand = pattern(words, &formats[of], &all[of]);
    }
    match operation {
        NumberOperation::Scale => operands[1] = words.around(7).cast_unsigned(),
        NumberOperation::Steps => {
            operands[0] = pattern(words, &SINGLE, &edges(&SINGLE));
            if words.coin() {
                operands[0] = 0x3f80_0000 - (words.bits() >> words.below(32)).min(0x3f80_0000);
            }
            operands[1] = [255, 1, 3, 7, 15, 31, 63, 127, 1023, 65535][words.below(10)];
        }
        NumberOperation::Sin | NumberOperation::Cos if words.below(3) == 0 => {
            operands[0] = angle(words, &formats[format])
        }
        NumberOperation::JoinPattern
        | NumberOperation::JoinShort
        | NumberOperation::JoinByte
        | NumberOperation::JoinSignedByte => {
            if operation != NumberOperation::JoinPattern {
                operands[1] = packed_number(words);
            }
            // The bits of the word at this position must be zero.
            operands[2] = place(words, matches!(operation, NumberOperation::JoinPattern | NumberOperation::JoinShort));
            operands[0] = words.bits() & !(0xffff << operands[2]);
        }
        NumberOperation::SplitPattern
        | NumberOperation::SplitShort
        | NumberOperation::SplitByte
        | NumberOperation::SplitSignedByte => {
            operands[0] = words.bits() >> words.below(32);
            operands[1] =
                place(words, matches!(operation, NumberOperation::SplitPattern | NumberOperation::SplitShort));
        }
        _ => {}
    }
    Item { operation, format, source, operands }
}

/// Bit position of a half or a quarter of a word.
fn place(words: &mut Random, half: bool) -> u32 {
    if half { [0, 16][words.below(2)] } else { [0, 8, 16, 24][words.below(4)] }
}

/// An angle near a multiple of a quarter turn.
fn angle(words: &mut Random, format: &Format) -> u32 {
    let quarters = f64::from(words.bits() >> words.below(32));
    let near = (quarters * std::f64::consts::FRAC_PI_2) as f32;
    let near = f32::from_bits(near.to_bits().wrapping_add_signed(words.around(2)));
    let bits = ops::convert(&SINGLE, *format, near.to_bits()).bits;
    if words.coin() { bits } else { ops::neg(format, bits).bits }
}

/// A single-precision number near the steps of a packed format.
fn packed_number(words: &mut Random) -> u32 {
    if words.coin() {
        return pattern(words, &SINGLE, &edges(&SINGLE));
    }
    let steps = [127, 255, 65535][words.below(3)];
    let half_steps = words.around(2 * steps + 4);
    let near = (f64::from(half_steps) / f64::from(2 * steps)) as f32;
    near.to_bits().wrapping_add_signed(words.around(1))
}

/// Returns `true` if all operands of a small format can be tested.
fn exhausted(o: NumberOperation) -> bool {
    tried(o) && o.operands() < 3 && o != NumberOperation::Steps && !(o.has_immediate() && o != NumberOperation::Scale)
}

/// Operands of the vectors that were measured on cards: the first three cells of each row.
fn rows_of_cards() -> Vec<[u32; 3]> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("lanes/tests/vectors");
    let mut rows = Vec::new();
    for entry in fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap_or_else(|e| panic!("{e}")).path();
        if path.extension().is_some_and(|e| e == "csv") {
            let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            let words = |line: &str| {
                let mut cells = line.split(',').map(|cell| u32::from_str_radix(cell, 16).unwrap_or(0));
                [0; 3].map(|_| cells.next().unwrap_or(0))
            };
            rows.extend(text.lines().skip(1).map(words));
        }
    }
    assert!(rows.len() > 10_000, "{} rows in {}", rows.len(), folder.display());
    rows
}

pub(crate) fn operands_that_cards_were_given(gpu: &Arc<Gpu>) {
    let formats = cards();
    let step = by_form(150, 1);
    let rows = rows_of_cards();
    let mut items = Vec::new();
    // The second operand of Steps is a count, which was not measured on cards.
    let with_numbers = |o: &NumberOperation| tried(*o) && !o.has_immediate() && *o != NumberOperation::Steps;
    for operation in NumberOperation::ALL.into_iter().filter(with_numbers) {
        let item = |format, &operands: &[u32; 3]| Item { operation, format, source: format, operands };
        let of_format = |format| rows.iter().step_by(step).map(move |row| item(format, row));
        items.extend((0..formats.len()).flat_map(of_format));
    }
    check(gpu, &formats, &items);
}

fn tried(operation: NumberOperation) -> bool {
    use NumberOperation as Op;
    !matches!(operation, Op::Mad | Op::Decode | Op::Encode | Op::Select | Op::And | Op::Or | Op::AndNot)
}

pub(crate) fn every_operation_in_many_formats(gpu: &Arc<Gpu>) {
    let formats = formats();
    let all: Vec<Vec<u32>> = formats.iter().map(edges).collect();
    let count = by_form(100, 20_000);
    let mut words = Random::new(1);
    let ideal = formats.iter().filter(|format| !format.unit.is_card()).count();
    let mut by_cards = Vec::new();
    for operation in NumberOperation::ALL.into_iter().filter(|&o| tried(o)) {
        let mut items = Vec::new();
        for format in (0..ideal).filter(|_| !operation.is_of_units()) {
            items.extend((0..count).map(|_| random_item(&mut words, &formats[..ideal], &all, operation, format)));
        }
        check(gpu, &formats, &items);
        for format in ideal..formats.len() {
            by_cards.extend((0..count).map(|_| random_item(&mut words, &formats, &all, operation, format)));
        }
    }
    check(gpu, &formats, &by_cards);
}

pub(crate) fn every_pair_of_short_formats(gpu: &Arc<Gpu>) {
    let texts = "e3m2 s1.2 e2m2:rdn:nvovf:nv e3m2:rtz:ftz:sat s2.2:rdn:wrap s0.4:rna e4m1:rna n1.3:rna \
                 n0.4:rdn:wrap s2.2:rup s1.3:rod:wrap n1.3:rod n0.4:rup e3m2:rup e2m3:rod:ftz e3m2fn \
                 e2m1fn:rup:nv e3m3fn:rod:nvovf e4m2fn:sat e2m3fnuz:rup:ftz e3m2fnuz";
    let formats: Vec<Format> = texts.split(' ').map(|f| f.parse().expect("a format")).collect();
    // The short form computes with two operands in every third format only.
    let step = by_form(3, 1);
    let mut items = Vec::new();
    for (format, layout) in formats.iter().enumerate() {
        let pairs = format.is_multiple_of(step);
        for operation in NumberOperation::ALL.into_iter().filter(|&o| exhausted(o) && (pairs || o.operands() < 2)) {
            let item = |format, source, operands| Item { operation, format, source, operands };
            for a in 0..=layout.mask() {
                match operation {
                    NumberOperation::Convert => items.extend((0..formats.len()).map(|to| item(to, format, [a, 0, 0]))),
                    NumberOperation::Scale => {
                        items.extend((-8..=8i32).map(|k| item(format, format, [a, k.cast_unsigned(), 0])));
                    }
                    _ => {
                        let seconds = if operation.operands() == 2 { layout.mask() } else { 0 };
                        items.extend((0..=seconds).map(|b| item(format, format, [a, b, 0])));
                    }
                }
            }
        }
    }
    check(gpu, &formats, &items);
}
