//! The page `docs/measured.md`: its table is made here.

use super::rule::Measured;
use std::fmt::Write;
use std::path::PathBuf;

const MARKS: [&str; 2] = ["<!-- measured -->\n", "<!-- end -->"];

/// Every rule is counted and compared on every executor ([`Measured::of`]), and the page has the counts.
pub(crate) fn the_page_has_the_counts() {
    let measured: Vec<Measured> = super::topics().into_iter().map(Measured::of).collect();
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/measured.md");
    let text = std::fs::read_to_string(&path).expect("the page").replace('\r', "");
    let (head, rest) = text.split_once(MARKS[0]).expect("the mark where the table begins");
    let (_, tail) = rest.split_once(MARKS[1]).expect("the mark where it ends");
    let made = format!("{head}{}{}{}{tail}", MARKS[0], table(&measured), MARKS[1]);
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        return std::fs::write(path, made).expect("written");
    }
    measured.iter().for_each(Measured::stands_in_the_profiles);
    assert!(made == text, "INSTA_UPDATE=always cargo test -p refsim --test measured writes the page; expected\n{made}");
}

fn table(measured: &[Measured]) -> String {
    let mut out = String::from(
        "| rule | hypotheses: values predicted | of | verdict | open | data |\n|---|---|---|---|---|---|\n",
    );
    for Measured { rule, own, right, all } in measured {
        let shown = |(name, right): &(String, usize)| match name == own {
            true => format!("**{name}: {}**", thousands(*right)),
            false => format!("{name}: {}", thousands(*right)),
        };
        let hypotheses: Vec<String> = right.iter().map(shown).collect();
        let verdict = if rule.settled { format!("settled: {own}") } else { "open".to_owned() };
        let (open, plural) = (if rule.open.is_empty() { "nothing" } else { rule.open }, plural(rule.unit));
        let _ = writeln!(
            out,
            "| {} | {} | {} {plural} | {verdict} | {open} | `{}` |",
            rule.name,
            hypotheses.join("<br>"),
            thousands(*all),
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
