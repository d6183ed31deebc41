//! Words of the source: no documentation begins with a question, and no type is named by a riddle.

use std::collections::BTreeSet;

use proc_macro2::{TokenStream, TokenTree};

use crate::source::{read, root, rust_files};

/// Words that no block of documentation begins with.
const BANNED_BEGINNINGS: [&str; 5] = ["What", "Whether", "Who", "Of what", "So many"];

/// Names that say nothing of a type's role.
const BANNED_NAMES: [&str; 22] = [
    "Asked", "Asks", "Hands", "Hats", "Keyed", "Kept", "Manner", "Ran", "Rivals", "Seen", "Somebody", "Stuff",
    "Subject", "Told", "Truth", "Wanted", "Way", "Ways", "Whoever", "Whole", "Wish", "Wishes",
];

/// Returns the lines, from 1, on which a block of documentation begins with banned words.
fn banned_beginnings(text: &str) -> Vec<usize> {
    let doc = |line: &str| ["///", "//!"].into_iter().find(|prefix| line.trim_start().starts_with(prefix));
    let mut found = Vec::new();
    let mut previous = None;
    for (number, line) in (1..).zip(text.lines()) {
        let current = doc(line);
        if let Some(prefix) = current.filter(|_| current != previous) {
            let words = line.trim_start().trim_start_matches(prefix).trim_start();
            let begins = |beginning: &str| {
                words.strip_prefix(beginning).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
            };
            if BANNED_BEGINNINGS.into_iter().any(begins) {
                found.push(number);
            }
        }
        previous = current;
    }
    found
}

/// Returns the lines, from 1, that define a type with a banned name.
fn banned_names(text: &str) -> Vec<usize> {
    let defines = |line: &str| {
        let code = line.split("//").next().unwrap_or_default();
        let mut words = code.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
        let is_type = words.any(|word| ["struct", "enum", "trait", "type"].contains(&word));
        is_type && words.next().is_some_and(|name| BANNED_NAMES.contains(&name))
    };
    (1..).zip(text.lines()).filter(|(_, line)| defines(line)).map(|(number, _)| number).collect()
}

#[test]
fn documentation_and_names_are_plain() {
    let mut found = Vec::new();
    for folder in ["refsim/src", "src", "tests"] {
        for file in rust_files(&root().join(folder)) {
            let below = file.strip_prefix(root()).expect("below the root");
            let text = read(&file);
            // This file has the banned names as text.
            let names = if below.ends_with("arrows/words.rs") { Vec::new() } else { banned_names(&text) };
            let lines = banned_beginnings(&text).into_iter().chain(names);
            found.extend(lines.map(|line| format!("{}:{line}", below.display())));
        }
    }
    assert!(
        found.is_empty(),
        "expected documentation that states what a thing is or does, and types named by their roles, found blocks that \
         begin with one of {BANNED_BEGINNINGS:?} or types named by one of {BANNED_NAMES:?}:\n{}",
        found.join("\n")
    );
}

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

#[test]
fn banned_words_are_seen_where_a_block_begins() {
    let text = "//! What a module is.\n\n/// Whether.\n/// What follows is no beginning.\nfn f() {}\n/// Whole numbers.\n\
                fn g() {}\n    /// Of what it is made.\n    a: u8,\n    /// So many times.\n    b: u8,\n// What a comment says.\n";
    assert_eq!(banned_beginnings(text), [1, 3, 8, 10]);
    let names = "pub struct Way;\nenum Ways { A }\npub(crate) trait Wayward {}\ntype Kept = u8;\n// struct Told\nlet way = 1;\n";
    assert_eq!(banned_names(names), [1, 2, 4]);
}

/// Digits for people are decided by `report::digits`: no format of the program's text has digits and an exponent.
#[test]
fn no_text_chooses_digits_of_an_exponent() {
    let mut found = Vec::new();
    for folder in ["src/cli", "src/studies"] {
        for file in rust_files(&root().join(folder)) {
            let text = read(&file);
            let chosen = |line: &&str| {
                line.split(":.")
                    .skip(1)
                    .any(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()).starts_with("e}"))
            };
            found.extend(text.lines().filter(chosen).map(|line| format!("{}: {}", file.display(), line.trim())));
        }
    }
    assert_eq!(found, Vec::<String>::new());
}
