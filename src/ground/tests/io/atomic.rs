use crossbar_ground::io::{FileSet, WriteError, write_file};
use std::fs::File;
use std::path::Path;
use std::{fs, io};

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

    // The test writes through its own link to the null device, so that a failing test cannot replace the device.
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
        assert!(matches!(set.write(Path::new(name), |_| Ok(())), Err(WriteError::Name { .. })), "{name}");
    }
    let file = root.path().join("file");
    fs::write(&file, b"").expect("written");
    assert!(matches!(FileSet::new(&file), Err(WriteError::Folder { .. })));
    assert!(matches!(write_file(&file.join("x"), |_| Ok(())), Err(WriteError::Folder { .. })));
}

#[test]
fn files_of_others_stay() {
    let root = tempfile::tempdir().expect("a folder");
    fs::write(root.path().join("a"), b"old").expect("written");
    fs::write(root.path().join("mine"), b"mine").expect("written");
    let mut set = FileSet::new(root.path()).expect("a set");
    for name in ["a", "sub/c"] {
        set.write(Path::new(name), |out| out.write_all(b"new")).expect("written");
    }
    set.commit().expect("places");
    assert_eq!(listing(root.path()), ["a", "mine", "sub"]);
    assert_eq!(fs::read(root.path().join("a")).expect("read"), b"new");
}

/// No files are moved while another process holds the folder's lock; the end of a process releases its lock.
#[cfg(unix)]
#[test]
fn a_set_waits_for_the_lock_of_its_folder() {
    let root = tempfile::tempdir().expect("a folder");
    fs::write(root.path().join("a"), b"old").expect("written");
    let mut set = FileSet::new(root.path()).expect("a set");
    set.write(Path::new("a"), |out| out.write_all(b"mine")).expect("written");
    let other = File::open(root.path()).expect("opened");
    other.lock().expect("locked");
    let waiting = std::thread::spawn(move || set.commit());
    std::thread::sleep(std::time::Duration::from_millis(200));
    assert_eq!(fs::read(root.path().join("a")).expect("read"), b"old", "it waits");
    drop(other);
    waiting.join().expect("no panic").expect("places");
    assert_eq!(fs::read(root.path().join("a")).expect("read"), b"mine");
    assert_eq!(listing(root.path()), ["a"], "no lock is left");
}
