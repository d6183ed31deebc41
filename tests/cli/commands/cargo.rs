//! Checks cargo commands against `cargo metadata` of the workspace.

use std::path::Path;
use std::process::Output;
use std::sync::{LazyLock, Mutex};

use serde_json::Value;

use super::texts::{CargoCommand, pages};
use crate::generated::{filled, hold};

fn cargo(folder: &Path, arguments: &str) -> Output {
    let mut command = std::process::Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments.split(' ')).current_dir(folder).output().expect("cargo, which runs this test")
}

static PACKAGES: LazyLock<Vec<Value>> = LazyLock::new(|| {
    let output = cargo(Path::new(env!("CARGO_MANIFEST_DIR")), "metadata --no-deps --offline --format-version 1");
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("one JSON document");
    metadata["packages"].as_array().expect("a list").clone()
});

/// Lock of the tests that may write docs/dependency.md.
static DEPENDENCY_PAGE: Mutex<()> = Mutex::new(());

/// The packages that a command selects: the one named `asked`, or all.
fn packages(asked: Option<&str>) -> Vec<&'static Value> {
    PACKAGES.iter().filter(|package| asked.is_none_or(|asked| package["name"] == asked)).collect()
}

/// The source path of the target of this kind and name.
fn target(packages: &[&Value], kind: &str, name: &str) -> Option<String> {
    let targets = packages.iter().flat_map(|package| package["targets"].as_array().into_iter().flatten());
    let is = |target: &&Value| {
        target["name"] == name && target["kind"].as_array().is_some_and(|kinds| kinds.iter().any(|k| k == kind))
    };
    targets.into_iter().find(is)?["src_path"].as_str().map(str::to_owned)
}

/// Returns `true` if `word` occurs in a source file of the target whose root is `source`.
fn mentions(source: &Path, word: &str) -> bool {
    fn within(folder: &Path, word: &str) -> bool {
        std::fs::read_dir(folder).into_iter().flatten().flatten().any(|entry| {
            let path = entry.path();
            if path.is_dir() {
                within(&path, word)
            } else {
                std::fs::read_to_string(&path).is_ok_and(|text| text.contains(word))
            }
        })
    }
    if source.file_name().is_some_and(|name| name == "main.rs") {
        return source.parent().is_some_and(|folder| within(folder, word));
    }
    within(&source.with_extension(""), word) || std::fs::read_to_string(source).is_ok_and(|text| text.contains(word))
}

/// A message that names the package, target, feature or test in the command that does not exist; `None` if all exist.
pub(crate) fn fault(command: &CargoCommand) -> Option<String> {
    let split = command.arguments.iter().position(|word| word == "--").unwrap_or(command.arguments.len());
    let (own, handed_on) = command.arguments.split_at(split);
    let values = |names: &[&str]| -> Vec<&str> {
        let pairs = own.windows(2).filter(|pair| names.contains(&pair[0].as_str()));
        pairs.map(|pair| pair[1].as_str()).collect()
    };
    let asked = values(&["-p", "--package"]);
    let known = packages(asked.first().copied());
    let say = |what: String| Some(format!("{}: cargo {}: {what}", command.place, command.arguments.join(" ")));
    if known.is_empty() {
        return say(format!("no package {asked:?}"));
    }
    let mut sources = Vec::new();
    for kind in ["test", "bench", "example", "bin"] {
        for name in values(&[&format!("--{kind}")]) {
            match target(&known, kind, name) {
                Some(source) => sources.push(source),
                None => return say(format!("no {kind} `{name}`")),
            }
        }
    }
    for feature in values(&["--features"]).into_iter().flat_map(|list| list.split(',')) {
        if !known.iter().any(|package| package["features"].get(feature).is_some()) {
            return say(format!("no feature `{feature}`"));
        }
    }
    // Test names are words, before and after `--`, that are neither options nor values of options.
    let is_value = |index: usize| index > 0 && own[index - 1].starts_with('-') && !is_flag(&own[index - 1]);
    let before = own.iter().enumerate().skip(1).filter(|(index, _)| !is_value(*index)).map(|(_, word)| word);
    let names = before.chain(handed_on.iter().skip(1)).filter(|word| !word.starts_with('-'));
    if own.first().is_some_and(|command| command == "test") {
        for name in names {
            // A suite's name is assembled by macros, so the source is searched for the parts of the name.
            let found = sources.iter().any(|source| name.split("::").all(|part| mentions(Path::new(source), part)));
            if !found {
                return say(format!("no test `{name}`"));
            }
        }
    }
    None
}

/// Returns `true` for cargo options without a value.
fn is_flag(option: &str) -> bool {
    let flags =
        ["--release", "--workspace", "--all-features", "--no-default-features", "--all-targets", "--lib", "--doc"];
    flags.contains(&option)
}

/// The dependencies that pages show resolve in a crate next to a clone of the repository.
#[test]
fn dependencies_on_pages_resolve() {
    let (mut shown, folder) = (0, tempfile::tempdir().expect("a folder for the test"));
    std::os::unix::fs::symlink(env!("CARGO_MANIFEST_DIR"), folder.path().join("crossbar")).expect("a link");
    let own = folder.path().join("own");
    std::fs::create_dir_all(own.join("src")).expect("a folder");
    std::fs::write(own.join("src/lib.rs"), "").expect("written");
    for (name, text) in pages() {
        for block in text.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()) {
            if block.contains("dependencies]") {
                let manifest = format!("[package]\nname = \"own\"\nedition = \"2024\"\n\n[workspace]\n\n{block}");
                std::fs::write(own.join("Cargo.toml"), manifest).expect("written");
                std::fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.lock"), own.join("Cargo.lock"))
                    .expect("copied");
                let said = cargo(&own, "tree --offline");
                assert!(said.status.success(), "{name}:\n{block}{}", String::from_utf8_lossy(&said.stderr));
                shown += 1;
            }
        }
    }
    assert!(
        shown >= 5,
        "README.md, docs/dependency.md, docs/tutorial.md and the crates of refsim show one each: {shown}"
    );
}

/// All pages have the repository address of Cargo.toml. `INSTA_UPDATE=always` updates the pages.
#[test]
fn the_address_is_that_of_the_manifest() {
    let (root, address) = (Path::new(env!("CARGO_MANIFEST_DIR")), env!("CARGO_PKG_REPOSITORY"));
    let said = |name: &str| match (name, address) {
        ("git", "") => "`git = \"...\"` with its address".to_owned(),
        ("git", _) => format!("`git = \"{address}\"`"),
        ("clone", "") => "clone the repository".to_owned(),
        ("clone", _) => format!("`git clone {address}`"),
        _ => panic!("no text {name}"),
    };
    let _one = DEPENDENCY_PAGE.lock();
    for (name, text) in pages().into_iter().filter(|(_, text)| text.contains("<!-- repository: ")) {
        hold(&root.join(name), &filled(&text, "repository", said));
    }
    let path = root.join("CITATION.cff");
    let text = std::fs::read_to_string(&path).expect("the file");
    let line = text.lines().find(|line| line.contains("repository-code:")).expect("a line for the address");
    let unset = if address.is_empty() { "# " } else { "" };
    hold(&path, &text.replace(line, format!("{unset}repository-code: {address}").trim_end()));
}

/// docs/dependency.md states the number of crates per feature that cargo counts. `INSTA_UPDATE=always` updates the
/// page.
#[test]
fn crates_are_counted() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let _one = DEPENDENCY_PAGE.lock();
    let page = std::fs::read_to_string(root.join("docs/dependency.md")).expect("the page");
    let mut counted = page.clone();
    for (row, features) in [("none", ""), ("`systems`", "systems"), ("`cli`", "cli"), ("`wgpu`", "cli,wgpu")] {
        let tree = "tree --locked --offline --package crossbar-gi --edges normal,build --prefix none --no-dedupe";
        let said = cargo(root, &format!("{tree} --no-default-features --features={features}"));
        let said = String::from_utf8(said.stdout).expect("names");
        let crates: std::collections::BTreeSet<&str> = said.lines().collect();
        let line = page.lines().find(|line| line.starts_with(&format!("| {row}"))).expect("a row");
        let mut cells: Vec<&str> = line.split(" | ").collect();
        let count = crates.len().to_string();
        cells[2] = &count;
        counted = counted.replace(line, &cells.join(" | "));
    }
    hold(&root.join("docs/dependency.md"), &counted);
}
