//! Words of the program: its sentences name no type.

use std::collections::BTreeSet;

use proc_macro2::{TokenStream, TokenTree};

use crate::source::{read, root, rust_files};

/// The types that a file defines, of those whose names have several words.
fn types_of_several_words(text: &str) -> Vec<String> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n");
    let words: Vec<&str> = code.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty()).collect();
    let defined = words.windows(2).filter(|pair| ["struct", "enum", "trait", "type"].contains(&pair[0]));
    let is_several = |name: &&str| name.chars().filter(|c| c.is_uppercase()).count() > 1;
    defined.map(|pair| pair[1]).filter(is_several).map(str::to_owned).collect()
}

/// Adds the texts in code that are sentences: all of several words but documentation.
fn sentences(code: TokenStream, found: &mut Vec<String>) {
    for tree in code {
        match tree {
            TokenTree::Group(group) => {
                let first = group.stream().into_iter().next();
                if !matches!(first, Some(TokenTree::Ident(word)) if word == "doc") {
                    sentences(group.stream(), found);
                }
            }
            TokenTree::Literal(text) => found.extend(Some(text.to_string()).filter(|text| text.contains(' '))),
            TokenTree::Ident(_) | TokenTree::Punct(_) => {}
        }
    }
}

/// Sentences of the program name no type, which is what a renaming leaves that went too far. `GeForce4` is a card, too.
#[test]
fn sentences_name_no_type() {
    let files = ["refsim/src", "src"].map(|folder| rust_files(&root().join(folder))).concat();
    let mut types: BTreeSet<String> = files.iter().flat_map(|file| types_of_several_words(&read(file))).collect();
    assert!(types.remove("GeForce4") && types.len() > 500, "{types:?}");
    let mut found = Vec::new();
    for file in ["src/cli", "src/studies"].map(|folder| rust_files(&root().join(folder))).concat() {
        let mut texts = Vec::new();
        let text = read(&file);
        let program = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        sentences(program.parse().expect("Rust"), &mut texts);
        for text in texts {
            // What stands in quotes or in a place for a value is no sentence.
            let bare: String = text.split('`').step_by(2).flat_map(|part| part.split('{').map(after_value)).collect();
            let mut words = bare.split(|c: char| !c.is_alphanumeric());
            found.extend(words.find(|word| types.contains(*word)).map(|word| format!("{}: {word}", file.display())));
        }
    }
    assert_eq!(found, Vec::<String>::new());
}

/// The part of a text behind the place for a value that it begins in, if it does.
fn after_value(part: &str) -> &str {
    part.split_once('}').map_or(part, |(_, rest)| rest)
}
