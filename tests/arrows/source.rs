//! A crate's source as these tests see it: its modules, the items of each, and the paths that each names.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Item, UseTree};

/// Segments of a path, which `::` joins: a module's path from the crate's root, or a path as written in code.
pub(crate) type Names = Vec<String>;

/// A path that a module names: a leaf of a `use`, or one inside code.
struct Named {
    path: Names,
    /// The name that a `use` gives it; `*` for all names of a module.
    alias: Option<String>,
    /// True if the `use` is a re-export.
    exported: bool,
}

/// A module: a file's own, or one inside a file.
#[derive(Default)]
pub(crate) struct Module {
    pub(crate) file: PathBuf,
    /// True if the module is compiled only for tests.
    pub(crate) is_test: bool,
    named: Vec<Named>,
    /// Names of all items.
    items: BTreeSet<String>,
    /// Names of structures, enumerations, traits and aliases.
    pub(crate) types: BTreeSet<String>,
    /// First segments of all paths in code.
    words: BTreeSet<String>,
}

/// A crate as the set of its modules.
pub(crate) struct Crate {
    pub(crate) modules: BTreeMap<Names, Module>,
}

/// The members of the workspace below `src`, from the lowest: each is a folder of rooms and a crate. Their sources
/// count as one crate.
const MEMBERS: [&str; 4] = ["base", "ground", "systems", "studies"];

/// The folders of the crates: the lower part of the emulator, the emulator, and the members' sources as one crate.
pub(crate) const SOURCES: [&str; 3] = ["refsim/lanes/src", "refsim/src", "src"];

pub(crate) fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The Rust files below a folder of the workspace.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("the source folders can be read") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("a source file")
}

impl Crate {
    /// The crate whose source is in one of the [`SOURCES`], read once.
    pub(crate) fn read(folder: &str) -> &'static Self {
        static CRATES: LazyLock<[Crate; 3]> = LazyLock::new(|| SOURCES.map(Crate::of_folder));
        let known = SOURCES.iter().position(|source| *source == folder).expect("one of the folders");
        &CRATES[known]
    }

    fn of_folder(folder: &str) -> Self {
        let folder = root().join(folder);
        let texts = rust_files(&folder).into_iter().filter_map(|file| {
            let below = file.strip_prefix(&folder).expect("below the folder");
            let member = MEMBERS.iter().find_map(|member| below.strip_prefix(member).ok());
            // The root of a member re-imports rooms of other members, which does not count as a use; its tests are not
            // a room.
            let is_no_room = member.is_some_and(|below| below == Path::new("lib.rs") || below.starts_with("tests"));
            (!is_no_room).then(|| (member.unwrap_or(below).to_owned(), read(&file)))
        });
        Self::of_texts(texts)
    }

    /// The crate made of source texts, each with its path below the source folder.
    pub(crate) fn of_texts(texts: impl IntoIterator<Item = (PathBuf, String)>) -> Self {
        let mut modules = BTreeMap::new();
        for (file, text) in texts {
            let mut path: Names =
                file.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
            if path.last().is_some_and(|last| last == "mod" || last == "lib") {
                path.pop();
            }
            let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
            let module = Module { file, ..Module::default() };
            Reader { modules: &mut modules, path, module }.items(parsed.items);
        }
        Self { modules }
    }

    /// The absolute form of a path in `module`; `None` for a path into another crate, or to no module.
    fn absolute(&self, module: &[String], path: &[String], depth: usize) -> Option<Names> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => Some(rest.to_owned()),
            "self" => self.absolute(module, rest, depth).or_else(|| Some([module, rest].concat())),
            "super" => {
                let (_, parent) = module.split_last()?;
                let again = rest.first().is_some_and(|next| next == "super");
                if again { self.absolute(parent, rest, depth) } else { Some([parent, rest].concat()) }
            }
            _ if self.modules.contains_key(&[module, std::slice::from_ref(first)].concat()) => {
                Some([module, path].concat())
            }
            _ => {
                let named = self.modules.get(module)?.named.iter().find(|named| named.alias.as_ref() == Some(first))?;
                let start = self.absolute(module, &named.path, depth.checked_sub(1)?)?;
                Some([&start, rest].concat())
            }
        }
    }

    /// The file that defines the item of an absolute path, looking through re-exports.
    fn defining_file(&self, path: &[String], depth: usize) -> Option<&Path> {
        let known = (0..=path.len()).rev().find(|&n| self.modules.contains_key(&path[..n]))?;
        let (module, rest) = path.split_at(known);
        let it = &self.modules[module];
        let Some(name) = rest.first().filter(|name| !it.items.contains(*name)) else { return Some(&it.file) };
        let depth = depth.checked_sub(1)?;
        if let Some(named) = it.named.iter().find(|named| named.alias.as_ref() == Some(name)) {
            return self.defining_file(&self.absolute(module, &named.path, depth)?, depth);
        }
        let globs = it.named.iter().filter(|named| named.alias.as_deref() == Some("*"));
        let mut sources = globs.filter_map(|glob| self.absolute(module, &glob.path, depth));
        let inside = sources.find(|glob| self.modules.get(glob).is_some_and(|glob| glob.items.contains(name)));
        inside.map_or(Some(&it.file), |glob| self.defining_file(&[&glob[..], rest].concat(), depth))
    }

    /// The names that follow a prefix in a module's paths: after `crate`, the rooms that it uses.
    pub(crate) fn after<'a>(&'a self, module: &[String], prefix: &'a str) -> impl Iterator<Item = &'a str> {
        let named = self.modules[module].named.iter();
        named.filter(move |named| named.path[0] == prefix).filter_map(|named| named.path.get(1).map(String::as_str))
    }

    pub(crate) fn paths<'a>(&'a self, module: &'a [String]) -> impl Iterator<Item = Names> {
        self.modules[module].named.iter().filter_map(move |named| self.absolute(module, &named.path, 9))
    }

    /// The other files whose items a module names, each with the name. A re-export counts only where its name is used.
    pub(crate) fn needs<'a>(&'a self, module: &'a [String]) -> impl Iterator<Item = (&'a Path, String)> {
        let it = &self.modules[module];
        it.named.iter().filter_map(move |named| {
            if named.exported && !named.alias.as_ref().is_some_and(|alias| it.words.contains(alias)) {
                return None;
            }
            let path = self.absolute(module, &named.path, 9)?;
            let file = self.defining_file(&path, 9)?;
            (file != it.file).then(|| (file, path.join("::")))
        })
    }
}

/// Reads one module and the modules inside it.
struct Reader<'a> {
    modules: &'a mut BTreeMap<Names, Module>,
    path: Names,
    module: Module,
}

impl Reader<'_> {
    fn items(mut self, items: Vec<Item>) {
        for item in items {
            match item {
                Item::Use(import) => {
                    let exported = !matches!(import.vis, syn::Visibility::Inherited);
                    self.leaves(import.tree, Vec::new(), exported);
                }
                Item::Mod(inner) => {
                    let test: syn::Attribute = syn::parse_quote!(#[cfg(test)]);
                    let is_test = self.module.is_test || inner.attrs.contains(&test);
                    let path = [&self.path[..], &[inner.ident.to_string()]].concat();
                    let module = Module { file: self.module.file.clone(), is_test, ..Module::default() };
                    if let Some((_, items)) = inner.content {
                        Reader { modules: self.modules, path, module }.items(items);
                    }
                }
                item => {
                    let is_macro = matches!(item, Item::Macro(_));
                    self.tokens(item.into_token_stream(), true, is_macro);
                }
            }
        }
        self.modules.insert(self.path, self.module);
    }

    fn leaves(&mut self, tree: UseTree, mut path: Names, exported: bool) {
        let alias = match tree {
            UseTree::Path(next) => {
                path.push(next.ident.to_string());
                return self.leaves(*next.tree, path, exported);
            }
            UseTree::Group(group) => {
                return group.items.into_iter().for_each(|tree| self.leaves(tree, path.clone(), exported));
            }
            UseTree::Name(name) if name.ident == "self" => path.last().cloned().unwrap_or_default(),
            UseTree::Name(name) => {
                path.push(name.ident.to_string());
                name.ident.to_string()
            }
            UseTree::Rename(renamed) => {
                path.push(renamed.ident.to_string());
                renamed.rename.to_string()
            }
            UseTree::Glob(_) => "*".to_owned(),
        };
        self.module.named.push(Named { path, alias: Some(alias), exported });
    }

    /// Collects the paths in an item's tokens, and the names that it defines: before its braces, or anywhere in a
    /// macro.
    fn tokens(&mut self, tokens: TokenStream, defines: bool, is_macro: bool) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let word = |at: usize| match tokens.get(at) {
            Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
            _ => None,
        };
        let colon = |at: usize| matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.as_char() == ':');
        let mut at = 0;
        while at < tokens.len() {
            if let TokenTree::Group(group) = &tokens[at] {
                // The path in `pub(in path)` does not count as a use.
                if at == 0 || word(at - 1).is_none_or(|word| word != "pub") {
                    self.tokens(group.stream(), is_macro, is_macro);
                }
            } else if let Some(first) = word(at) {
                if let Some(name) = word(at + 1).filter(|_| defines) {
                    if TYPES.contains(&first.as_str()) {
                        self.module.types.insert(name.clone());
                    }
                    if TYPES.contains(&first.as_str()) || VALUES.contains(&first.as_str()) {
                        self.module.items.insert(name);
                    }
                }
                let mut path = vec![first];
                while let Some(next) = word(at + 3).filter(|_| colon(at + 1) && colon(at + 2)) {
                    path.push(next);
                    at += 3;
                }
                self.module.words.insert(path[0].clone());
                if path.len() > 1 {
                    self.module.named.push(Named { path, alias: None, exported: false });
                }
            }
            at += 1;
        }
    }
}

const TYPES: [&str; 4] = ["struct", "enum", "trait", "type"];
const VALUES: [&str; 3] = ["fn", "const", "static"];
