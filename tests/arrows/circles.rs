//! Tests that files within a room have no circular dependencies: if two files need each other, a type is in the wrong
//! file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::source::{Crate, SOURCES};

type Graph = BTreeMap<PathBuf, BTreeMap<PathBuf, BTreeSet<String>>>;

pub(crate) fn room(file: &Path) -> String {
    file.with_extension("").iter().next().expect("a component").to_string_lossy().into_owned()
}

/// For each file, the files of its room that it needs, each with the names that it uses.
fn graph(source: &Crate) -> Graph {
    let mut graph = Graph::new();
    for (module, it) in source.modules.iter().filter(|(_, it)| !it.is_test) {
        let edges = graph.entry(it.file.clone()).or_default();
        for (file, name) in source.needs(module) {
            if room(file) == room(&it.file) {
                edges.entry(file.to_owned()).or_default().insert(name);
            }
        }
    }
    graph
}

fn reachable<'a>(graph: &'a Graph, from: &'a Path) -> BTreeSet<&'a Path> {
    let mut found = BTreeSet::new();
    let mut open = vec![from];
    while let Some(file) = open.pop() {
        for next in graph.get(file).into_iter().flat_map(BTreeMap::keys) {
            if found.insert(next.as_path()) {
                open.push(next);
            }
        }
    }
    found
}

/// The circular dependencies of a crate: the files of each, with the names that each file needs from the others.
fn circles(source: &Crate) -> Vec<String> {
    let graph = graph(source);
    let reached: BTreeMap<&Path, BTreeSet<&Path>> =
        graph.keys().map(|file| (file.as_path(), reachable(&graph, file))).collect();
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for (&file, others) in &reached {
        let circle: Vec<&Path> = others.iter().copied().filter(|other| reached[other].contains(file)).collect();
        if circle.is_empty() || !seen.insert(circle[0]) {
            continue;
        }
        let mut text = format!("a circle of {} files:\n", circle.len());
        for file in &circle {
            for (other, names) in graph[*file].iter().filter(|(other, _)| circle.contains(&other.as_path())) {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                text += &format!("  {} needs {} for {}\n", file.display(), other.display(), names.join(", "));
            }
        }
        found.push(text);
    }
    found
}

#[test]
fn files_of_a_room_need_each_other_in_one_direction() {
    let found: Vec<String> = SOURCES.iter().flat_map(|folder| circles(Crate::read(folder))).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn circles_are_seen_through_re_exports_and_without_tests() {
    let of = |files: &[(&str, &str)]| {
        circles(&Crate::of_texts(files.iter().map(|(path, text)| (PathBuf::from(path), (*text).to_owned()))))
    };
    let straight = [
        ("room/mod.rs", "pub use a::A; mod a; mod b;"),
        ("room/a.rs", "pub struct A; #[cfg(test)] mod tests { use super::super::b::b; }"),
        ("room/b.rs", "use super::A; pub fn b(a: A) {}"),
    ];
    assert_eq!(of(&straight), [""; 0], "a parent that only re-exports needs nothing");
    let mut round = straight;
    round[1].1 = "pub struct A; fn f() { super::b::b(A) }";
    assert!(of(&round)[0].contains("room/b.rs needs room/a.rs for room::A"), "{:?}", of(&round));
    round[1].1 = "pub struct A; fn f() { assert_eq!(super::b::b(A), ()) }";
    assert_eq!(of(&round).len(), 1, "macros are looked into");
    round[1].1 = "use super::{Other, b::{b}}; pub struct A; // super::b";
    assert_eq!(of(&round).len(), 1, "groups are looked into");
    round[1].1 = "pub struct A; // use super::b::b;";
    assert_eq!(of(&round), [""; 0], "comments are passed over");
    round = straight;
    round[0].1 = "pub use a::A; mod a; mod b; pub struct Own(A);";
    round[1].1 = "pub struct A(super::Own);";
    assert_eq!(of(&round).len(), 1, "a parent that uses what it re-exports needs it");
}
