//! What the laws know of a crate's source: its modules, the items of each, and the paths that each names.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};

/// Names joined by `::`: a module from the crate's root, or a path as the code writes it.
pub(crate) type Names = Vec<String>;

/// A path that a module names: a leaf of a `use`, or one inside code.
struct Named {
    path: Names,
    /// The name that a `use` gives it; `*` for all names of a module.
    alias: Option<String>,
    /// Whether the `use` is a re-export.
    exported: bool,
}

/// A module: a file's own, or one inside a file.
#[derive(Default)]
pub(crate) struct Module {
    pub(crate) file: PathBuf,
    /// Whether it is for tests only.
    pub(crate) is_test: bool,
    named: Vec<Named>,
    /// Names of all items.
    items: BTreeSet<String>,
    /// Names of structures, enumerations, traits and aliases.
    pub(crate) types: BTreeSet<String>,
    /// Every first name of a path in code.
    words: BTreeSet<String>,
}

/// A crate by its modules.
pub(crate) struct Crate {
    pub(crate) modules: BTreeMap<Names, Module>,
}

pub(crate) fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The Rust files below a folder of the workspace.
pub(crate) fn rust_files(folder: &Path) -> Vec<PathBuf> {
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

pub(crate) fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("a source file")
}

impl Crate {
    /// The crate whose source is in a folder of the workspace.
    pub(crate) fn read(folder: &str) -> Self {
        let folder = root().join(folder);
        let texts = rust_files(&folder).into_iter().map(|file| {
            let below = file.strip_prefix(&folder).expect("below the folder").to_owned();
            (below, read(&file))
        });
        Self::of_texts(texts)
    }

    /// The crate of files with their paths below the source folder.
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
            let mut reader = Reader { modules: &mut modules, path, module };
            reader.visit_file(&parsed);
            reader.end();
        }
        Self { modules }
    }

    /// A path that stands in `module`, from the crate's root. `None`: of another crate, or no path of modules.
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

    /// The file where the first item of a path from the root is written, through re-exports.
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

    /// What a module names right after a prefix: after `crate`, the rooms that it uses.
    pub(crate) fn after<'a>(&'a self, module: &[String], prefix: &'a str) -> impl Iterator<Item = &'a str> {
        let named = self.modules[module].named.iter();
        named.filter(move |named| named.path[0] == prefix).filter_map(|named| named.path.get(1).map(String::as_str))
    }

    /// The other files whose items a module names, with the names. A re-export counts only where its name is used.
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

/// Reads one module, and those inside it.
struct Reader<'a> {
    modules: &'a mut BTreeMap<Names, Module>,
    path: Names,
    module: Module,
}

impl Reader<'_> {
    fn end(self) {
        self.modules.insert(self.path, self.module);
    }

    fn leaves(&mut self, tree: &syn::UseTree, mut path: Names, exported: bool) {
        let mut leaf = |path: Names, alias: String| {
            self.module.named.push(Named { path, alias: Some(alias), exported });
        };
        match tree {
            syn::UseTree::Path(next) => {
                path.push(next.ident.to_string());
                self.leaves(&next.tree, path, exported);
            }
            syn::UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.leaves(tree, path.clone(), exported));
            }
            syn::UseTree::Name(name) if name.ident == "self" => {
                let alias = path.last().cloned().unwrap_or_default();
                leaf(path, alias);
            }
            syn::UseTree::Name(name) => {
                path.push(name.ident.to_string());
                leaf(path, name.ident.to_string());
            }
            syn::UseTree::Rename(renamed) => {
                path.push(renamed.ident.to_string());
                leaf(path, renamed.rename.to_string());
            }
            syn::UseTree::Glob(_) => leaf(path, "*".to_owned()),
        }
    }

    fn path(&mut self, path: Names) {
        self.module.words.extend(path.first().cloned());
        if path.len() > 1 {
            self.module.named.push(Named { path, alias: None, exported: false });
        }
    }

    /// Paths and types in a macro's tokens.
    fn tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let word = |at: usize| match tokens.get(at) {
            Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
            _ => None,
        };
        let colon = |at: usize| matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.as_char() == ':');
        let mut at = 0;
        while at < tokens.len() {
            if let TokenTree::Group(group) = &tokens[at] {
                self.tokens(group.stream());
            } else if let Some(first) = word(at) {
                if let Some(name) = word(at + 1).filter(|_| ["struct", "enum", "trait"].contains(&first.as_str())) {
                    self.module.types.insert(name.clone());
                    self.module.items.insert(name);
                }
                let mut path = vec![first];
                while let Some(next) = word(at + 3).filter(|_| colon(at + 1) && colon(at + 2)) {
                    path.push(next);
                    at += 3;
                }
                self.path(path);
            }
            at += 1;
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let (name, is_type) = match item {
            syn::Item::Struct(it) => (&it.ident, true),
            syn::Item::Enum(it) => (&it.ident, true),
            syn::Item::Trait(it) => (&it.ident, true),
            syn::Item::Type(it) => (&it.ident, true),
            syn::Item::Fn(it) => (&it.sig.ident, false),
            syn::Item::Const(it) => (&it.ident, false),
            syn::Item::Static(it) => (&it.ident, false),
            _ => return visit::visit_item(self, item),
        };
        self.module.items.insert(name.to_string());
        if is_type {
            self.module.types.insert(name.to_string());
        }
        visit::visit_item(self, item);
    }

    fn visit_item_mod(&mut self, inner: &'ast syn::ItemMod) {
        let is_test = inner.attrs.iter().any(|attribute| {
            attribute.path().is_ident("cfg")
                && attribute.parse_args::<syn::Path>().is_ok_and(|only| only.is_ident("test"))
        });
        if inner.content.is_none() {
            return;
        }
        let path = [&self.path[..], &[inner.ident.to_string()]].concat();
        let is_test = is_test || self.module.is_test;
        let module = Module { file: self.module.file.clone(), is_test, ..Module::default() };
        let mut reader = Reader { modules: self.modules, path, module };
        visit::visit_item_mod(&mut reader, inner);
        reader.end();
    }

    fn visit_item_use(&mut self, import: &'ast syn::ItemUse) {
        self.leaves(&import.tree, Vec::new(), !matches!(import.vis, syn::Visibility::Inherited));
    }

    fn visit_vis_restricted(&mut self, _: &'ast syn::VisRestricted) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.path(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.path(call.path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        self.tokens(call.tokens.clone());
    }
}
