//! Layout of tables as text within a width: words and numbers are not broken.
//!
//! Columns share the width. If it is too narrow for all of them, the table is split into several tables, each with the
//! key columns, or only with the first column if the key columns leave no room. If no column fits next to the first,
//! every row becomes a list of its cells. Only lists break a word longer than a line; numbers are never broken if there
//! are at least [`MIN_WIDTH`] columns.

use comfy_table::{CellAlignment, ContentArrangement, presets};
use textwrap::core::{Word, display_width};
use textwrap::{Options, WordSeparator, WordSplitter, WrapAlgorithm};

/// Minimum width; narrower terminals are treated as this wide.
pub const MIN_WIDTH: usize = 40;
/// Minimum width of a text column whose text is at least this long.
const MIN_TEXT_WIDTH: usize = 12;
/// Length from which words, for example web addresses, may be broken after a slash.
const LONG_WORD: usize = 24;
/// Width between two columns: a rule and a blank on each side.
const RULE: usize = 3;

pub(super) struct Column {
    heading: String,
    /// Cells, each with `true` if it is a number: numbers are right-aligned at their decimal points.
    cells: Vec<(String, bool)>,
    /// Length of the longest unbreakable piece, minimum width, and useful width.
    widths: [usize; 3],
}

impl Column {
    /// Creates a column of cells; `true` marks a number.
    pub(super) fn new(heading: String, cells: Vec<(String, bool)>) -> Self {
        let cells = aligned(cells);
        // Blanks that align a decimal point belong to the number.
        let piece = |(text, number): &(String, bool)| if *number { display_width(text) } else { longest_piece(text) };
        let longest = cells.iter().map(piece).fold(longest_piece(&heading), usize::max);
        let most = cells.iter().map(|(text, _)| display_width(text)).fold(display_width(&heading), usize::max);
        let words = cells.iter().filter(|(_, number)| !number).map(|(text, _)| display_width(text)).max().unwrap_or(0);
        Self { heading, cells, widths: [longest, longest.max(words.min(MIN_TEXT_WIDTH)), most] }
    }

    /// Returns `true` if most cells are numbers, so that the heading is right-aligned too.
    fn is_of_numbers(&self) -> bool {
        let numbers = self.cells.iter().filter(|(_, number)| *number).count();
        2 * numbers > self.cells.iter().filter(|(text, _)| !text.is_empty()).count()
    }
}

/// Pads numbers to one length, so that their decimal points are aligned.
fn aligned(cells: Vec<(String, bool)>) -> Vec<(String, bool)> {
    let numbers = || cells.iter().filter(|(_, number)| *number).map(|(text, _)| halves(text));
    let left = numbers().map(|(whole, _)| display_width(whole)).max().unwrap_or(0);
    let right = numbers().map(|(_, rest)| display_width(rest)).max().unwrap_or(0);
    let align = |(text, number): (String, bool)| {
        let (whole, rest) = halves(&text);
        (if number { format!("{whole:>left$}{rest:<right$}") } else { text }, number)
    };
    cells.into_iter().map(align).collect()
}

/// Splits a number before its decimal point or exponent.
fn halves(number: &str) -> (&str, &str) {
    number.split_at(number.find(['.', 'e', ' ']).unwrap_or(number.len()))
}

/// Splits a line into words, and long words after slashes.
fn pieces(line: &str) -> Box<dyn Iterator<Item = Word<'_>> + '_> {
    Box::new(WordSeparator::AsciiSpace.find_words(line).flat_map(|word| {
        if word.word.len() <= LONG_WORD || !word.word.contains('/') {
            return vec![word];
        }
        let mut parts: Vec<Word<'_>> = word.word.split_inclusive('/').map(Word::from).collect();
        if let Some(last) = parts.last_mut() {
            last.whitespace = word.whitespace;
        }
        parts
    }))
}

fn longest_piece(text: &str) -> usize {
    pieces(text).map(|word| display_width(word.word)).max().unwrap_or(0)
}

/// Wraps text to lines of at most `width` columns between words; breaks a word only if it is longer than a line.
pub fn wrapped(text: &str, width: usize, indent: &str) -> Vec<String> {
    let options = Options::new(width)
        .subsequent_indent(indent)
        .word_separator(WordSeparator::Custom(pieces))
        .word_splitter(WordSplitter::NoHyphenation)
        .wrap_algorithm(WrapAlgorithm::FirstFit);
    textwrap::wrap(text, options).into_iter().map(std::borrow::Cow::into_owned).collect()
}

/// Lays out columns side by side within a width; the first `keys` of them are the key columns.
pub(super) fn within(columns: &[Column], keys: usize, width: usize) -> String {
    let width = width.max(MIN_WIDTH);
    let parts = |keys: usize| cut(columns, keys, width).map(|parts| (keys, parts));
    match parts(keys).or_else(|| parts(1)) {
        Some((keys, parts)) => {
            // The smallest width with the same number of parts balances the parts.
            let narrower = (MIN_WIDTH..width).filter_map(|less| cut(columns, keys, less));
            let even = { narrower }.find(|even| even.len() == parts.len());
            let parts: Vec<String> = even.unwrap_or(parts).iter().map(|part| side_by_side(part, width)).collect();
            parts.join("\n\n")
        }
        None => lists(columns, width),
    }
}

/// Splits the columns into the fewest groups that fit, each with the first `keys` columns; `None` if some column does
/// not fit next to them.
fn cut(columns: &[Column], keys: usize, width: usize) -> Option<Vec<Vec<&Column>>> {
    let fits = |group: &[&Column], least: usize| taken(group.iter().map(|column| column.widths[least])) <= width;
    let (keys, others) = columns.split_at_checked(keys.min(columns.len()))?;
    let keys: Vec<&Column> = keys.iter().collect();
    let with_keys = |column| keys.iter().copied().chain([column]).collect();
    let (mut groups, mut group) = (Vec::new(), keys.clone());
    for column in others {
        group.push(column);
        if !fits(&group, 1) && group.len() > keys.len() + 1 {
            group.pop();
            groups.push(std::mem::replace(&mut group, with_keys(column)));
        }
    }
    groups.push(group);
    groups.iter().all(|group| fits(group, 0)).then_some(groups)
}

/// Total width of columns with the rules between and around them.
fn taken(widths: impl Iterator<Item = usize>) -> usize {
    widths.map(|width| width + RULE).sum::<usize>() + 1
}

/// Distributes the width: every column gets its useful width, except for the widest columns, which get equal shares.
fn shares(columns: &[&Column], width: usize) -> Vec<usize> {
    let at = |level: usize| -> Vec<usize> {
        columns.iter().map(|column| level.clamp(column.widths[0], column.widths[2])).collect()
    };
    let level = (1..=width).take_while(|level| taken(at(*level).into_iter()) <= width).last().unwrap_or(0);
    let mut widths = at(level);
    let mut left = width.saturating_sub(taken(widths.iter().copied()));
    for (share, column) in widths.iter_mut().zip(columns) {
        if left > 0 && *share < column.widths[2] {
            *share += 1;
            left -= 1;
        }
    }
    widths
}

fn side_by_side(columns: &[&Column], width: usize) -> String {
    let widths = shares(columns, width);
    let lines = |text: &str, width: usize| wrapped(text, width, "").join("\n");
    let entry = |text: String, number: bool| {
        let alignment = if number { CellAlignment::Right } else { CellAlignment::Left };
        comfy_table::Cell::new(text).set_alignment(alignment)
    };
    let mut table = comfy_table::Table::new();
    table.set_content_arrangement(ContentArrangement::Disabled).load_style(presets::ASCII_MARKDOWN);
    let heading = |(column, width): (&&Column, &usize)| entry(lines(&column.heading, *width), column.is_of_numbers());
    table.set_header(columns.iter().zip(&widths).map(heading));
    for row in 0..columns.first().map_or(0, |column| column.cells.len()) {
        table.add_row(columns.iter().zip(&widths).map(|(column, width)| {
            // Blanks around a number align its decimal point.
            let (text, number) = &column.cells[row];
            entry(if *number { text.clone() } else { lines(text, *width) }, *number)
        }));
    }
    table.trim_fmt()
}

/// Formats each row as a list: its first cell, and below it the other cells with their headings.
fn lists(columns: &[Column], width: usize) -> String {
    let Some((first, others)) = columns.split_first() else { return String::new() };
    let list = |row: usize| {
        let mut list = wrapped(&format!("{}: {}", first.heading, first.cells[row].0.trim()), width, "    ");
        for column in others.iter().filter(|column| !column.cells[row].0.is_empty()) {
            let text = format!("  {}: {}", column.heading, column.cells[row].0.trim());
            list.extend(wrapped(&text, width, "    "));
        }
        list.join("\n")
    };
    (0..first.cells.len()).map(list).collect::<Vec<_>>().join("\n\n")
}
