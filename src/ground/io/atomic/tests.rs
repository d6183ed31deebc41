//! Contents of a folder after failures, kills and commits.

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

    // A link of its own to the null device, so that a failure of the test cannot harm the machine.
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

/// Old files `a` and `b`, a file of the user, and a set of `a`, `b` and `sub/c` that is to replace them.
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
        let mut set = set_over_old_files(root.path());
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

/// Commits files with these names and contents as `writer`.
fn write_by(writer: &str, folder: &Path, files: &[(&str, &str)]) {
    staged_by(writer, folder, files).commit().expect("places");
}

fn staged_by(writer: &str, folder: &Path, files: &[(&str, &str)]) -> FileSet {
    let mut set = FileSet::by(writer, folder).expect("a set");
    for (name, text) in files {
        set.write(Path::new(name), |out| out.write_all(text.as_bytes())).expect("written");
    }
    set
}

#[test]
fn what_is_written_no_more_goes_and_nothing_else() {
    let root = tempfile::tempdir().expect("a folder");
    let folder = root.path().join("out");
    write_by("study", &folder, &[("a", "a"), ("b", "b"), ("sub/c", "c"), ("changed", "ours"), ("replaced", "ours")]);
    write_by("other", &folder, &[("d", "d")]);
    for (name, text) in [("mine", "mine"), ("changed", "mine"), ("replaced", "mine, and longer")] {
        fs::write(folder.join(name), text).expect("written");
    }
    write_by("study", &folder, &[("a", "new")]);
    assert_eq!(listing(&folder), [".crossbar_files", "a", "changed", "d", "mine", "replaced", "sub"]);
    assert!(listing(&folder.join("sub")).is_empty());
    assert_eq!(fs::read(folder.join("a")).expect("read"), b"new");
    // A file that another writer has replaced belongs to that writer from then on.
    write_by("other", &folder, &[("a", "new"), ("d", "d")]);
    write_by("study", &folder, &[("e", "e")]);
    assert_eq!(listing(&folder), [".crossbar_files", "a", "changed", "d", "e", "mine", "replaced", "sub"]);
    write_by("other", &folder, &[]);
    write_by("study", &folder, &[]);
    assert_eq!(listing(&folder), [".crossbar_files", "changed", "mine", "replaced", "sub"]);
    let list = fs::read_to_string(folder.join(".crossbar_files")).expect("read");
    assert_eq!(list.lines().count(), 1, "a heading alone: {list}");
}

#[cfg(unix)]
#[test]
fn a_list_that_somebody_has_written_harms_nothing() {
    let root = tempfile::tempdir().expect("a folder");
    let (folder, outside) = (root.path().join("out"), root.path().join("x"));
    fs::create_dir_all(folder.join("old")).expect("made");
    fs::write(&outside, b"x").expect("written");
    fs::write(folder.join("old/x"), b"x").expect("written");
    fs::write(folder.join("y"), b"x").expect("written");
    std::os::unix::fs::symlink(root.path(), folder.join("up")).expect("linked");
    std::os::unix::fs::symlink(&outside, folder.join("link")).expect("linked");
    let crc = crc32fast::hash(b"x");
    let names = ["../x", "/x", "up/x", "link", "old", "", ".", "y\ty"];
    let mut list: String = names.iter().map(|name| format!("1\t{crc:08x}\tstudy\t{name}\n")).collect();
    list.push_str("1\tno number\tstudy\ty\nbut\0noise\n\n-1\t0\tstudy\ty\n");
    fs::write(folder.join(".crossbar_files"), list).expect("written");
    write_by("study", &folder, &[("a", "a")]);
    assert_eq!(listing(&folder), [".crossbar_files", "a", "link", "old", "up", "y"]);
    assert!(outside.exists() && folder.join("old/x").exists());
    // The same line does remove a file at the path that it names.
    fs::write(folder.join(".crossbar_files"), format!("1\t{crc:08x}\tstudy\told/x\n")).expect("written");
    write_by("study", &folder, &[("a", "a")]);
    assert!(!folder.join("old/x").exists());
}

#[test]
fn a_kill_amid_the_renames_leaves_the_removal_to_the_next() {
    for renames in 0..=2 {
        let root = tempfile::tempdir().expect("a folder");
        write_by("study", root.path(), &[("a", "old"), ("stale", "old")]);
        let mut set = staged_by("study", root.path(), &[("a", "new")]);
        set.commit_at_most(renames).expect("renamed");
        set.staging.leave();
        assert!(root.path().join("stale").exists(), "after {renames} renames");
        drop(FileSet::new(root.path()).expect("a set"));
        assert_eq!(listing(root.path()), [".crossbar_files", "a"], "after {renames} renames");
    }
    // A process killed before that point has changed nothing.
    let root = tempfile::tempdir().expect("a folder");
    write_by("study", root.path(), &[("a", "old"), ("stale", "old")]);
    staged_by("study", root.path(), &[("a", "new")]).staging.leave();
    drop(FileSet::new(root.path()).expect("a set"));
    assert_eq!(listing(root.path()), [".crossbar_files", "a", "stale"]);
}

/// While another process holds the folder's lock no files are moved; the lock of an ended process is free.
#[test]
fn a_set_waits_for_the_lock_of_its_folder() {
    let root = tempfile::tempdir().expect("a folder");
    let mut set = set_over_old_files(root.path());
    set.write(Path::new("a"), |out| out.write_all(b"mine")).expect("written");
    let path = root.path().join(".crossbar_lock");
    let other = File::create(&path).expect("made");
    other.lock().expect("locked");
    let waiting = std::thread::spawn(move || set.commit());
    std::thread::sleep(std::time::Duration::from_millis(200));
    assert_eq!(fs::read(root.path().join("a")).expect("read"), b"old", "it waits");
    drop(other);
    waiting.join().expect("no panic").expect("places");
    assert_eq!(fs::read(root.path().join("a")).expect("read"), b"mine");
    assert_eq!(listing(root.path()), ["a", "b", "mine", "sub"], "no lock is left");
}

/// A set left half-moved is completed before the files of a later set are moved, not after.
#[test]
fn what_was_left_is_older_than_what_comes() {
    let root = tempfile::tempdir().expect("a folder");
    let mut left = set_over_old_files(root.path());
    let mut next = FileSet::new(root.path()).expect("a set");
    for name in ["a", "b"] {
        next.write(Path::new(name), |out| out.write_all(b"newest")).expect("written");
    }
    left.commit_at_most(1).expect("renamed");
    left.staging.leave();
    next.commit().expect("places");
    drop(FileSet::new(root.path()).expect("a set"));
    let contents = ["a", "b", "sub/c"].map(|name| fs::read(root.path().join(name)).expect("read"));
    assert_eq!(contents, ["newest", "newest", "new"].map(|text| text.as_bytes().to_vec()));
}
