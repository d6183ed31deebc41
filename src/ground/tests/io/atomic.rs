use crossbar_ground::io::{WriteError, require_writable, write_file, write_files};
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
fn missing_folders_appear_with_their_files() {
    let root = tempfile::tempdir().expect("a folder");
    let folder = root.path().join("deep/out");
    require_writable(&folder).expect("writable");
    assert!(listing(root.path()).is_empty(), "the check makes no folders");
    let files = ["a.txt", "sub/b.txt"].map(|name| (name.to_owned(), name.as_bytes().to_vec()));
    assert_eq!(write_files(&folder, &files).expect("places"), [folder.join("a.txt"), folder.join("sub/b.txt")]);
    assert_eq!(
        (listing(&folder), listing(&folder.join("sub"))),
        (vec!["a.txt".into(), "sub".into()], vec!["b.txt".into()])
    );
    assert_eq!(fs::read(folder.join("sub/b.txt")).expect("read"), b"sub/b.txt");
}

#[test]
fn names_stay_below_the_folder() {
    let root = tempfile::tempdir().expect("a folder");
    for name in ["../x", "/x", ""] {
        let files = [("a".to_owned(), Vec::new()), (name.to_owned(), Vec::new())];
        assert!(matches!(write_files(root.path(), &files), Err(WriteError::Name { .. })), "{name}");
        assert!(listing(root.path()).is_empty(), "{name}");
    }
    let file = root.path().join("file");
    fs::write(&file, b"").expect("written");
    for folder in [&file, &file.join("deeper")] {
        assert!(matches!(require_writable(folder), Err(WriteError::Folder { .. })));
    }
    assert!(matches!(write_file(&file.join("x"), |_| Ok(())), Err(WriteError::Folder { .. })));
}

#[test]
fn files_of_others_stay() {
    let root = tempfile::tempdir().expect("a folder");
    fs::write(root.path().join("a"), b"old").expect("written");
    fs::write(root.path().join("mine"), b"mine").expect("written");
    write_files(root.path(), &["a", "sub/c"].map(|name| (name.to_owned(), b"new".to_vec()))).expect("places");
    assert_eq!(listing(root.path()), ["a", "mine", "sub"]);
    assert_eq!(fs::read(root.path().join("a")).expect("read"), b"new");
}

/// A file that cannot be written leaves the others of its list as they were.
#[test]
fn all_files_are_written_or_none() {
    let root = tempfile::tempdir().expect("a folder");
    fs::write(root.path().join("a"), b"old").expect("written");
    fs::create_dir(root.path().join("c")).expect("a folder");
    let files = ["a", "b", "c"].map(|name| (name.to_owned(), b"new".to_vec()));
    assert!(matches!(write_files(root.path(), &files), Err(WriteError::File { .. })));
    assert_eq!(listing(root.path()), ["a", "c"]);
    assert_eq!(fs::read(root.path().join("a")).expect("read"), b"old");
}
