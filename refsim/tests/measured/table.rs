//! Tables of measured values: CSV without quotes, with the names of the columns in the first line.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::str::FromStr;

pub(crate) struct Row {
    columns: BTreeMap<String, String>,
    place: String,
}

impl Row {
    pub(crate) fn text(&self, column: &str) -> &str {
        self.columns.get(column).unwrap_or_else(|| panic!("{}: no column `{column}`", self.place))
    }

    pub(crate) fn number<T: FromStr>(&self, column: &str) -> T {
        let text = self.text(column);
        text.parse().unwrap_or_else(|_| panic!("{}, {column}: `{text}`", self.place))
    }

    /// A field of hexadecimal digits.
    pub(crate) fn hex(&self, column: &str) -> u32 {
        let text = self.text(column);
        u32::from_str_radix(text, 16).unwrap_or_else(|_| panic!("{}, {column}: `{text}`", self.place))
    }
}

/// All rows of a file of `fixtures/measured`.
pub(crate) fn table(file: &str) -> Vec<Row> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../fixtures/measured").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut lines = text.lines().enumerate();
    let names: Vec<&str> = lines.next().expect("the line with the names").1.split(',').collect();
    let row = |(number, line): (usize, &str)| {
        let place = format!("{file}:{}", number + 1);
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), names.len(), "{place}");
        let columns = names.iter().zip(fields).map(|(name, field)| ((*name).to_owned(), field.to_owned())).collect();
        Row { columns, place }
    };
    lines.map(row).collect()
}
