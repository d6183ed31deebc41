//! The page `docs/measured.md`: generates its table and its pictures.

use super::pictures;
use super::rule::Measured;
use super::values::Values;
use crate::environment::writes_files;
use std::fmt::Write;
use std::path::PathBuf;

const TABLE: [&str; 2] = ["<!-- measured -->\n", "<!-- end -->"];
const PICTURES: [&str; 2] = ["<!-- pictures -->\n", "<!-- end of pictures -->"];

/// Every rule is drawn on every executor and its counts compared ([`Measured::of`]), and the page states these counts.
pub(crate) fn the_page_has_the_counts() {
    let measured: Vec<Measured> = super::topics().into_iter().map(Measured::of).collect();
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/measured.md");
    let text = std::fs::read_to_string(&path).expect("the page").replace('\r', "");
    let made = replaced(&text, TABLE, &table(&measured));
    let made = replaced(&made, PICTURES, &pictures::section(&measured));
    let write = writes_files();
    pictures::hold(&measured, write);
    if write {
        return std::fs::write(path, made).expect("written");
    }
    measured.iter().for_each(Measured::stands_in_the_profiles);
    assert!(made == text, "INSTA_UPDATE=always cargo test -p refsim --test measured writes the page; expected\n{made}");
}

/// Replaces the text between two marks of the page.
fn replaced(page: &str, marks: [&str; 2], text: &str) -> String {
    let (head, rest) = page.split_once(marks[0]).expect("the mark where it begins");
    let (_, tail) = rest.split_once(marks[1]).expect("the mark where it ends");
    [head, marks[0], text, marks[1], tail].concat()
}

fn table(measured: &[Measured]) -> String {
    let mut out = String::from(
        "| rule | hypotheses: values predicted | of | verdict | open | data |\n|---|---|---|---|---|---|\n",
    );
    for one in measured {
        let (rule, (own, all)) = (&one.rule, one.own());
        let shown = |(name, values): &(String, Values)| match name == own {
            true => format!("**{name}: {}**", thousands(values.right())),
            false => format!("{name}: {}", thousands(values.right())),
        };
        let hypotheses: Vec<String> = one.values.iter().map(shown).collect();
        let verdict = if rule.settled { format!("settled: {own}") } else { "open".to_owned() };
        let (open, plural) = (if rule.open.is_empty() { "nothing" } else { rule.open }, plural(rule.unit));
        let _ = writeln!(
            out,
            "| {} | {} | {} {plural} | {verdict} | {open} | `{}` |",
            rule.name,
            hypotheses.join("<br>"),
            thousands(all),
            rule.data
        );
    }
    out
}

fn plural(unit: &str) -> String {
    if unit.ends_with("ch") { format!("{unit}es") } else { format!("{unit}s") }
}

/// A count with commas.
fn thousands(n: usize) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().map(|g| std::str::from_utf8(g).expect("digits")).collect();
    groups.join(",")
}
