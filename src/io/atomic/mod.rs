//! Files that appear whole or not at all: written beside their place, then renamed into it.

mod staging;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};

use thiserror::Error;

use self::staging::Staging;
pub use self::staging::abandon;

/// Why a file was not written.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum WriteError {
    /// The folder cannot be made, or nothing can be written in it.
    #[error("cannot write into the folder {}; choose another folder, or make it writable", path.display())]
    Folder { path: PathBuf, source: io::Error },
    /// The file cannot be written.
    #[error("cannot write {}", path.display())]
    File { path: PathBuf, source: io::Error },
    /// The name is not a plain path below the folder.
    #[error("expected the name of a file below the output folder, found {}", name.display())]
    Name { name: PathBuf },
}

/// Writes one file through `fill`, and the folders that are missing on the way. On any error, whatever stood at `path`
/// before still stands, and no folder was made.
///
/// A link is followed, and stays. What is there but is no file, such as `/dev/stdout`, a pipe or a terminal, is written
/// to and never replaced; it too gets everything or, when `fill` fails, nothing.
pub fn write_file(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    match fs::metadata(path) {
        Ok(place) if place.is_dir() => {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(WriteError::File { path: path.into(), source });
        }
        Ok(place) if !place.is_file() => return fill_device(path, fill),
        Ok(_) => {}
        // Nothing is there yet, or a link to nothing, which becomes a file.
        Err(_) => return write_beside(path, path, fill),
    }
    let file = fs::canonicalize(path).map_err(|source| WriteError::File { path: path.into(), source })?;
    write_beside(&file, path, fill)
}

/// Hands over to a device or pipe at once what `fill` wrote.
fn fill_device(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    let write = || {
        let mut bytes = Vec::new();
        fill(&mut bytes)?;
        File::options().append(true).open(path)?.write_all(&bytes)
    };
    write().map_err(|source| WriteError::File { path: path.into(), source })
}

/// Writes beside `file`, and renames; errors name `path`. Folders that are missing are made.
fn write_beside(
    file: &Path,
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let (Some(folder), Some(name)) = (file.parent(), file.file_name()) else {
        return Err(WriteError::Name { name: path.into() });
    };
    let mut set = FileSet::new(folder)?;
    let staged = set.stage(name.as_ref())?;
    fill_file(&staged, path, fill)?;
    set.commit()?;
    Ok(())
}

/// Writes the file at `staged`; errors name `path`.
fn fill_file(
    staged: &Path,
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let write = || {
        let mut out = BufWriter::new(File::create(staged)?);
        fill(&mut out)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
    };
    write().map_err(|source| WriteError::File { path: path.into(), source })
}

/// Several files that appear together in one folder, when [`FileSet::commit`] is called. Dropped without it, it leaves
/// nothing behind.
///
/// A folder that was missing appears by one rename, with all its files. In a folder that exists the files are renamed
/// one after another, because the folder itself stays: programs may be at work in it, and it may hold other files. A
/// process that is killed in the midst of these renames leaves old files beside new ones, and `.crossbar-XXXXXX` with
/// the rest; the next set for the folder first finishes them. Files of other names are never touched.
#[derive(Debug)]
pub struct FileSet {
    /// The folder as it was named.
    folder: PathBuf,
    /// The innermost folder on the way that exists.
    base: PathBuf,
    /// From there to the folder: empty if it exists.
    rest: PathBuf,
    staging: Staging,
    names: Vec<PathBuf>,
}

impl FileSet {
    /// A set for `folder`. Made before long work, it finds out early that nothing can be written there.
    ///
    /// # Errors
    /// [`WriteError::Folder`].
    pub fn new(folder: &Path) -> Result<Self, WriteError> {
        let fail = |source| WriteError::Folder { path: folder.into(), source };
        let (base, rest) = split(folder);
        if let Some(first) = rest.iter().next()
            && base.join(first).is_symlink()
        {
            return Err(fail(io::Error::new(io::ErrorKind::NotFound, "a link leads nowhere")));
        }
        let staging = Staging::within(&base).map_err(fail)?;
        let set = Self { folder: folder.into(), base, rest, staging, names: Vec::new() };
        fs::create_dir_all(set.staged(Path::new(""))).map_err(fail)?;
        Ok(set)
    }

    fn staged(&self, name: &Path) -> PathBuf {
        self.staging.new_files().join(&self.rest).join(name)
    }

    /// Where the file `name` (relative, without `..`) is to be written now, for writers that want a path.
    ///
    /// # Errors
    /// [`WriteError::Name`] for a name that leaves the folder, [`WriteError::File`] when its subfolder cannot be made.
    pub fn stage(&mut self, name: &Path) -> Result<PathBuf, WriteError> {
        let plain = name.components().all(|part| matches!(part, Component::Normal(_)));
        if !plain || name.file_name().is_none() {
            return Err(WriteError::Name { name: name.into() });
        }
        let staged = self.staged(name);
        if let Some(parent) = staged.parent() {
            let path = || self.folder.join(name);
            fs::create_dir_all(parent).map_err(|source| WriteError::File { path: path(), source })?;
        }
        if !self.names.iter().any(|known| known == name) {
            self.names.push(name.into());
        }
        Ok(staged)
    }

    /// Writes the file `name` through `fill`.
    pub fn write(
        &mut self,
        name: &Path,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let staged = self.stage(name)?;
        fill_file(&staged, &self.folder.join(name), fill)
    }

    /// Puts all files in their places and returns these, in the order of staging. What can fail (a file that was staged
    /// but not written, a place taken by a folder, a subfolder that cannot be made) is looked at before the first
    /// rename.
    ///
    /// # Errors
    /// [`WriteError`]; unless a rename itself fails, nothing has then appeared.
    pub fn commit(self) -> Result<Vec<PathBuf>, WriteError> {
        self.commit_at_most(usize::MAX)?;
        Ok(self.names.iter().map(|name| self.folder.join(name)).collect())
    }

    /// Commits, but stops in the midst of the renames, after `most` of them.
    fn commit_at_most(&self, most: usize) -> Result<(), WriteError> {
        for name in &self.names {
            let fail = |source| WriteError::File { path: self.folder.join(name), source };
            fs::metadata(self.staged(name)).map_err(fail)?;
            if self.folder.join(name).is_dir() {
                return Err(fail(io::Error::from(io::ErrorKind::IsADirectory)));
            }
        }
        if let Some(first) = self.rest.iter().next() {
            let place = self.base.join(first);
            match self.staging.rename_folder(first.as_ref(), &place) {
                Ok(()) => return Ok(()),
                // Somebody else has made it meanwhile: file by file then.
                Err(_) if place.is_dir() => {}
                Err(source) => return Err(WriteError::Folder { path: self.folder.clone(), source }),
            }
        }
        let names: Vec<PathBuf> = self.names.iter().map(|name| self.rest.join(name)).collect();
        let places = names.iter().map(|name| self.base.join(name));
        let mut made = Vec::new();
        let rename = || {
            for folder in places.filter_map(|place| place.parent().map(Path::to_path_buf)) {
                made.extend(missing_folders(&folder).into_iter().rev());
                fs::create_dir_all(&folder).map_err(|source| WriteError::Folder { path: folder, source })?;
            }
            let renamed = self.staging.rename_files(&self.base, &names, most);
            renamed.map_err(|(path, source)| WriteError::File { path, source })
        };
        let renamed = { rename }();
        if renamed.is_err() {
            for folder in made.iter().rev() {
                // It fails, as it should, where something has come in.
                let _ = fs::remove_dir(folder);
            }
        }
        renamed
    }
}

/// The innermost existing folder on the way to `folder`, and plain names from there. Nothing that is missing can be a
/// link, so `..` behind it means what it seems to.
fn split(folder: &Path) -> (PathBuf, PathBuf) {
    let mut base = PathBuf::new();
    let mut rest = PathBuf::new();
    for part in folder.components() {
        match part {
            Component::Normal(name) if rest == Path::new("") && base.join(name).exists() => base.push(name),
            Component::Normal(name) => rest.push(name),
            Component::ParentDir if rest != Path::new("") => drop(rest.pop()),
            Component::CurDir => {}
            other => base.push(other),
        }
    }
    (if base == Path::new("") { ".".into() } else { base }, rest)
}

/// The folders that must be made for `folder` to exist, innermost first.
fn missing_folders(folder: &Path) -> Vec<PathBuf> {
    let missing = folder.ancestors().take_while(|path| *path != Path::new("") && !path.exists());
    missing.map(Path::to_path_buf).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listing(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_failed_write_leaves_the_old_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.txt");
        write_file(&path, |out| out.write_all(b"old")).expect("written");
        let failed = write_file(&path, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("no more"))
        });
        assert_eq!(failed.unwrap_err().to_string(), format!("cannot write {}", path.display()));
        assert_eq!(fs::read(&path).expect("read"), b"old");
        assert_eq!(listing(folder.path()), ["a.txt"]);
        write_file(&path, |out| out.write_all(b"new")).expect("written");
        assert_eq!(fs::read(&path).expect("read"), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_a_device_a_device() {
        use std::os::unix::fs::{FileTypeExt as _, symlink};
        let folder = tempfile::tempdir().expect("a folder");
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, b"old").expect("written");
        symlink(&file, &link).expect("linked");
        write_file(&link, |out| out.write_all(b"new")).expect("written");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink(), "the link still stands");
        assert_eq!(fs::read(&file).expect("read"), b"new");
        assert_eq!(listing(folder.path()), ["file", "link"]);

        // A link of our own, so that a failure here does no harm to the machine.
        let null = folder.path().join("null");
        symlink("/dev/null", &null).expect("linked");
        write_file(&null, |out| out.write_all(b"gone")).expect("written");
        assert!(fs::metadata(&null).expect("there").file_type().is_char_device(), "the device still stands");
        let full = folder.path().join("full");
        symlink("/dev/full", &full).expect("linked");
        if full.exists() {
            assert!(matches!(write_file(&full, |out| out.write_all(b"x")), Err(WriteError::File { .. })), "no room");
        }
        assert!(matches!(write_file(folder.path(), |_| Ok(())), Err(WriteError::File { .. })), "a folder");
    }

    #[test]
    fn a_set_appears_whole_or_not_at_all() {
        let root = tempfile::tempdir().expect("a folder");
        let folder = root.path().join("deep/out");
        let mut set = FileSet::new(&folder).expect("a set");
        set.write(Path::new("a.txt"), |out| out.write_all(b"a")).expect("written");
        drop(set);
        assert!(listing(root.path()).is_empty(), "dropped, it leaves nothing");

        let mut set = FileSet::new(&folder).expect("a set");
        set.write(Path::new("a.txt"), |out| out.write_all(b"a")).expect("written");
        set.write(Path::new("sub/b.txt"), |out| out.write_all(b"b")).expect("written");
        assert!(!folder.join("a.txt").exists());
        assert_eq!(set.commit().expect("places"), [folder.join("a.txt"), folder.join("sub/b.txt")]);
        assert_eq!(
            (listing(&folder), listing(&folder.join("sub"))),
            (vec!["a.txt".into(), "sub".into()], vec!["b.txt".into()])
        );
    }

    #[test]
    fn missing_folders_appear_with_their_file() {
        let root = tempfile::tempdir().expect("a folder");
        let path = root.path().join("a/b/h.csv");
        let failed = write_file(&path, |_| Err(io::Error::other("no more")));
        assert_eq!(failed.unwrap_err().to_string(), format!("cannot write {}", path.display()));
        assert!(listing(root.path()).is_empty(), "a failure makes no folders");
        write_file(&path, |out| out.write_all(b"hits")).expect("written");
        assert_eq!(fs::read(&path).expect("read"), b"hits");
        let round = root.path().join("c/../d/./e/x");
        write_file(&round, |out| out.write_all(b"x")).expect("written");
        assert_eq!(listing(root.path()), ["a", "d"]);
        assert_eq!(listing(&root.path().join("d/e")), ["x"]);
    }

    /// Old files `a` and `b`, a file of the user's own, and a set of `a`, `b` and `sub/c` that is to replace them.
    fn set_over_old_files(folder: &Path) -> FileSet {
        for name in ["a", "b", "mine"] {
            fs::write(folder.join(name), b"old").expect("written");
        }
        let mut set = FileSet::new(folder).expect("a set");
        for name in ["a", "b", "sub/c"] {
            set.write(Path::new(name), |out| out.write_all(b"new")).expect("written");
        }
        set
    }

    #[test]
    fn a_process_killed_between_renames_is_finished_by_the_next() {
        for renames in 0..=3 {
            let root = tempfile::tempdir().expect("a folder");
            let set = set_over_old_files(root.path());
            set.commit_at_most(renames).expect("renamed");
            set.staging.leave();
            assert!(listing(root.path())[0].starts_with(".crossbar-"), "the rest is there");
            drop(FileSet::new(root.path()).expect("a set"));
            assert_eq!(listing(root.path()), ["a", "b", "mine", "sub"], "after {renames} renames");
            let contents = ["a", "b", "sub/c", "mine"].map(|name| fs::read(root.path().join(name)).expect("read"));
            assert_eq!(
                contents,
                ["new", "new", "new", "old"].map(|text| text.as_bytes().to_vec()),
                "after {renames} renames"
            );
        }
    }

    #[test]
    fn a_process_killed_before_the_renames_changes_nothing() {
        let root = tempfile::tempdir().expect("a folder");
        set_over_old_files(root.path()).staging.leave();
        let missing = root.path().join("x/y");
        let mut set = FileSet::new(&missing).expect("a set");
        set.write(Path::new("a"), |out| out.write_all(b"new")).expect("written");
        set.staging.leave();
        assert!(!missing.exists());
        let living = FileSet::new(root.path()).expect("a set");
        drop(FileSet::new(root.path()).expect("a set"));
        assert_eq!(listing(root.path()).len(), 4, "the staging folder of a living process is left alone");
        drop(living);
        assert_eq!(listing(root.path()), ["a", "b", "mine"]);
        assert_eq!(fs::read(root.path().join("a")).expect("read"), b"old");
    }

    #[test]
    fn a_place_taken_by_a_folder_stops_the_whole_set() {
        let root = tempfile::tempdir().expect("a folder");
        fs::create_dir(root.path().join("b")).expect("made");
        let mut set = FileSet::new(root.path()).expect("a set");
        set.write(Path::new("a"), |out| out.write_all(b"a")).expect("written");
        set.write(Path::new("b"), |out| out.write_all(b"b")).expect("written");
        assert!(matches!(set.commit(), Err(WriteError::File { .. })));
        assert_eq!(listing(root.path()), ["b"]);
    }

    #[test]
    fn names_stay_below_the_folder() {
        let root = tempfile::tempdir().expect("a folder");
        let mut set = FileSet::new(root.path()).expect("a set");
        for name in ["../x", "/x", ""] {
            assert!(matches!(set.stage(Path::new(name)), Err(WriteError::Name { .. })), "{name}");
        }
        let file = root.path().join("file");
        fs::write(&file, b"").expect("written");
        assert!(matches!(FileSet::new(&file), Err(WriteError::Folder { .. })));
        assert!(matches!(write_file(&file.join("x"), |_| Ok(())), Err(WriteError::Folder { .. })));
    }
}
