//! Tests that no type name is defined in more than two rooms.

use std::collections::{BTreeMap, BTreeSet};

use crate::circles::room;
use crate::source::{Crate, SOURCES};

/// Maximum number of rooms that define a type name.
const MAX_ROOMS: usize = 2;

#[test]
fn a_type_name_tells_its_room() {
    let mut rooms: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for folder in SOURCES {
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
