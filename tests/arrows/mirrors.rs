//! Enumerations of the command line: none repeats the variants of one that the library has.

use std::collections::{BTreeMap, BTreeSet};

use syn::{Fields, Item, Variant};

use crate::source::{read, root, rust_files};

/// The names of variants, and the enumerations without data that have them.
type Enumerations = BTreeMap<BTreeSet<String>, Vec<String>>;

/// Returns the enumerations of files whose variants hold no data. Those with variants of a feature are left out: the
/// command line names what a build lacks, to say so.
fn enumerations(texts: impl IntoIterator<Item = String>) -> Enumerations {
    let mut found = Enumerations::new();
    for text in texts {
        for item in syn::parse_file(&text).expect("a source file").items {
            let Item::Enum(item) = item else { continue };
            let is_plain = |variant: &Variant| {
                matches!(variant.fields, Fields::Unit) && !variant.attrs.iter().any(|one| one.path().is_ident("cfg"))
            };
            if item.variants.iter().all(is_plain) {
                let names = item.variants.iter().map(|variant| variant.ident.to_string()).collect();
                found.entry(names).or_default().push(item.ident.to_string());
            }
        }
    }
    found
}

/// Returns the enumerations of the command line that repeat one of the library.
fn mirrors(command_line: &Enumerations, library: &Enumerations) -> Vec<String> {
    let both = command_line.iter().filter_map(|(names, mirrors)| Some((mirrors, library.get(names)?)));
    both.map(|(mirrors, originals)| format!("{mirrors:?} of {originals:?}")).collect()
}

#[test]
fn no_enum_of_the_command_line_repeats_one_of_the_library() {
    let texts = |folder: &str| rust_files(&root().join(folder)).into_iter().map(|file| read(&file));
    let library = ["refsim/src", "src/base", "src/ground", "src/systems", "src/studies"];
    let found = mirrors(&enumerations(texts("src/cli")), &enumerations(library.into_iter().flat_map(texts)));
    assert!(
        found.is_empty(),
        "expected options whose values are those of the library, parsed by `one_of::variants` or `one_of::one_of`, \
         found mirrors:\n{}",
        found.join("\n")
    );
}

#[test]
fn mirrors_are_seen_in_any_order_and_those_with_data_are_not() {
    let of = |text: &str| enumerations([text.to_owned()]);
    let library = of("pub enum Sides { Front, Both } enum Light { Sky, Disk(f64) } enum Kind { A, #[cfg(b)] B }");
    assert_eq!(mirrors(&of("enum SidesArg { Both, Front }"), &library).len(), 1);
    assert!(mirrors(&of("enum A { Front } enum LightArg { Sky, Disk } enum KindArg { A, B }"), &library).is_empty());
}
