//! Names and lines: no type name in more than two rooms, no line of documentation beyond 120 characters.

use std::collections::{BTreeMap, BTreeSet};

use crate::circles::room;
use crate::source::{Crate, read, root, rust_files};

/// In how many rooms a type name may be defined.
const MAX_ROOMS: usize = 2;

/// The longest line of documentation, in characters.
const MAX_LINE: usize = 120;

#[test]
fn a_type_name_tells_its_room() {
    let mut rooms: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for folder in ["refsim/src", "src"] {
        for module in Crate::read(folder).modules.values().filter(|module| !module.is_test) {
            for name in &module.types {
                rooms.entry(name.clone()).or_default().insert(format!("{folder}/{}", room(&module.file)));
            }
        }
    }
    rooms.retain(|_, rooms| rooms.len() > MAX_ROOMS);
    let found: Vec<String> = rooms.into_iter().map(|(name, rooms)| format!("{name}: {rooms:?}")).collect();
    assert!(found.is_empty(), "these names are defined in more than {MAX_ROOMS} rooms:\n{}", found.join("\n"));
}

#[test]
fn documentation_keeps_to_its_width() {
    let mut found = Vec::new();
    for folder in ["refsim", "src", "tests", "benches", "docs/examples"] {
        for file in rust_files(&root().join(folder)) {
            let path = file.strip_prefix(root()).expect("below the root").to_string_lossy().replace('\\', "/");
            for (number, line) in (1..).zip(read(&file).lines()) {
                let text = line.trim_start();
                if (text.starts_with("///") || text.starts_with("//!")) && line.chars().count() > MAX_LINE {
                    found.push(format!("{path}:{number}"));
                }
            }
        }
    }
    assert!(found.is_empty(), "lines of documentation beyond {MAX_LINE} characters:\n{}", found.join("\n"));
}
