//! Tables as text: no line exceeds the width, no word or number is broken, nothing is lost; and rows with the same
//! results are folded.

use crossbar::report::digits::{Quantity, shown};
use crossbar::report::layout::MIN_WIDTH;
use crossbar::report::{Cell, Findings, FoundTable, Provenance, Table};
use proptest::prelude::*;
use unicode_width::UnicodeWidthStr as _;

/// Words of tables: names, switches, programs, slashes; none longer than the narrowest table.
fn words() -> impl Strategy<Value = String> {
    proptest::collection::vec("[a-zA-Z_=.%()-]{1,18}|[a-z]{2,12}/[a-z]{2,12}/[a-z]{2,9}|größe|漢字", 0..8)
        .prop_map(|words| words.join(" "))
}

/// 10 to the power of `power`.
fn power_of_ten(power: i32) -> f64 {
    format!("1e{power}").parse().expect("a number")
}

fn cell() -> impl Strategy<Value = Cell> {
    let quantity = prop_oneof![
        Just(Quantity::Exact),
        (0_u8..7).prop_map(Quantity::Decimals),
        Just(Quantity::Measured),
        Just(Quantity::Ratio),
        Just(Quantity::Percent),
        Just(Quantity::Error),
    ];
    // Numbers as they occur in tables, not arbitrary doubles: seven decimal places of 1e300 make no sense.
    let real = (-1e9..1e9_f64, -12_i32..3).prop_map(|(x, power)| x * power_of_ten(power));
    prop_oneof![
        words().prop_map(Cell::Text),
        any::<u64>().prop_map(Cell::Count),
        (0_u64..2000).prop_map(Cell::Count),
        any::<i32>().prop_map(Cell::from),
        (real, quantity, any::<bool>()).prop_map(|(x, quantity, mark)| Cell::real(x, quantity).marked(if mark {
            "*"
        } else {
            ""
        })),
        Just(Cell::Empty),
    ]
}

fn table() -> impl Strategy<Value = Table> {
    (1_usize..13, 1_usize..6).prop_flat_map(|(columns, rows)| {
        let heading = "[a-z]{1,12}(_[a-z%]{1,8}){0,3}";
        let headings = proptest::collection::vec(heading, columns);
        let rows = proptest::collection::vec(proptest::collection::vec(cell(), columns), rows);
        (headings, rows).prop_map(|(headings, rows)| {
            let mut table = Table::new("t", &headings);
            rows.into_iter().for_each(|row| table.push(row));
            table
        })
    })
}

/// The unbreakable pieces of a text: words, or the parts between slashes of long words.
fn pieces(text: &str) -> Vec<String> {
    let of = |word: &str| -> Vec<String> {
        if word.len() > 24 { word.split_inclusive('/').map(str::to_owned).collect() } else { vec![word.to_owned()] }
    };
    text.split_whitespace().flat_map(of).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn lines_fit_and_nothing_is_broken(table in table(), width in MIN_WIDTH..160) {
        let text = table.text_within(width);
        for line in text.lines() {
            prop_assert!(line.width() <= width, "{} columns of {width}: {line:?}\n{text}", line.width());
        }
        for cell in table.rows().iter().flatten() {
            for piece in pieces(&cell.text()) {
                let of_path = |word: &str| word.contains('/') && word.contains(&piece);
                let whole = text.split([' ', '\n']).any(|word| word == piece || of_path(word));
                prop_assert!(whole, "{piece:?} is not whole in\n{text}");
            }
        }
    }

    #[test]
    fn points_are_below_each_other(numbers in proptest::collection::vec(-1e6..1e6_f64, 1..8)) {
        let mut table = Table::of("t", "what value");
        numbers.iter().for_each(|number| table.push(["a".into(), Cell::decimals(*number, 2).marked("*")]));
        let text = table.text_within(80);
        let places: Vec<usize> = text.lines().skip(2).filter_map(|line| line.find('.')).collect();
        prop_assert_eq!(places.len(), numbers.len());
        prop_assert!(places.windows(2).all(|two| two[0] == two[1]), "{}", text);
    }

    #[test]
    fn digits_are_those_of_the_number(x in -1e9..1e9_f64, power in -20_i32..3) {
        let x = x * power_of_ten(power);
        for (quantity, off) in [(Quantity::Exact, 0.0), (Quantity::Measured, 6e-4), (Quantity::Ratio, 6e-3)] {
            let back: f64 = shown(x, quantity).replace(',', "").parse().expect("a number");
            prop_assert!((back - x).abs() <= off * x.abs(), "{x:e} is shown as {back:e}");
        }
    }

    /// The folded table has the first row of each group, and one row for the remaining rows of a large group; the
    /// document has every row.
    #[test]
    fn folds_lose_nothing(kinds in proptest::collection::vec(0_usize..4, 1..30)) {
        let first: Vec<usize> = kinds.iter().map(|kind| kinds.iter().position(|k| k == kind).unwrap_or(0)).collect();
        let mut table = Table::of("t", "row kind");
        kinds.iter().enumerate().for_each(|(i, kind)| table.push([format!("r{i}").into(), (*kind).into()]));
        let others = |row: usize| first.iter().filter(|f| **f == row).count() - usize::from(first[row] == row);
        let folded = table.folded(&first, |row| format!("r{row}"), (["row", "rows"], "the same bits"));
        for (row, cells) in folded.rows().iter().enumerate() {
            if let Cell::Folded(fold) = &cells[0] {
                let above = folded.rows()[row - 1][0].text();
                prop_assert!(fold.names.len() >= 2 && fold.first == above && others(above[1..].parse().expect("a row")) == fold.names.len());
            }
        }
        let shown = folded.rows().iter().flatten().map(Cell::text).chain(folded.notes()).collect::<Vec<_>>().join("\n");
        for row in 0..kinds.len() {
            prop_assert!(shown.split(['\n', ' ', ',']).any(|word| word == format!("r{row}")), "r{} in {}", row, shown);
        }
        let whole = table.csv().expect("text");
        let mut found = Findings::new("t");
        let of_table = FoundTable::from(table).field("rows").csv("rows");
        found.table(of_table.folded(&first, |row| format!("r{row}"), (["row", "rows"], "the same")));
        let document = found.document(&Provenance::new("t"));
        prop_assert_eq!(document["rows"].as_array().map(Vec::len), Some(kinds.len()));
        let files = found.take_files(&Provenance::new("t")).expect("files");
        let csv = files.iter().find(|(name, _)| name == "rows.csv").map(|(_, bytes)| bytes.as_slice());
        prop_assert_eq!(csv, Some(whole.as_bytes()));
    }
}

#[test]
fn a_table_that_does_not_fit_is_cut_and_then_listed() {
    let mut table = Table::of("t", "row largest_t_error hits leaks source");
    for (row, hits) in [("r200", 63_166_u32), ("fp16", 66_275)] {
        let source = format!("{}/{}", "a_very_long_name_of_a_folder".repeat(2), row);
        table.push([row.into(), Cell::error(0.001_234), hits.into(), 12_u8.into(), source.into()]);
    }
    insta::assert_snapshot!(
        [100, 70, 60, 40].map(|width| format!("{width}\n{}", table.text_within(width))).join("\n\n")
    );
}
