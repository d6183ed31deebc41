//! Makes archives of arrays with changed members: hostile files with valid checksums.

use std::io::{Cursor, Read as _, Write as _};

use crossbar::io::NpzWriter;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

pub(crate) fn members(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut zip = ZipArchive::new(Cursor::new(bytes)).expect("an archive");
    let member = |index| {
        let (mut member, mut all) = (zip.by_index(index).expect("a member"), Vec::new());
        member.read_to_end(&mut all).expect("its bytes");
        (member.name().expect("UTF-8").into_owned(), all)
    };
    (0..ZipArchive::new(Cursor::new(bytes)).expect("an archive").len()).map(member).collect()
}

pub(crate) fn archive(members: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        zip.start_file(name, SimpleFileOptions::default()).expect("a member");
        zip.write_all(bytes).expect("written");
    }
    zip.finish().expect("written").into_inner()
}

/// The archive with the member of this name replaced; `change` receives the old contents.
pub(crate) fn with_member(bytes: &[u8], name: &str, change: impl FnOnce(&[u8]) -> Vec<u8>) -> Vec<u8> {
    let mut members = members(bytes);
    let member = members.iter_mut().find(|(other, _)| other == name).expect("a member of this name");
    member.1 = change(&member.1);
    archive(&members)
}

/// The archive with changed metadata.
pub(crate) fn with_metadata(bytes: &[u8], change: impl FnOnce(&str) -> String) -> Vec<u8> {
    with_member(bytes, "metadata.npy", |array| text_array(&change(text_of(array))))
}

pub(crate) fn text_of(array: &[u8]) -> &str {
    let header = usize::from(u16::from_le_bytes([array[8], array[9]]));
    std::str::from_utf8(&array[10 + header..]).expect("text")
}

pub(crate) fn text_array(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut arrays = NpzWriter::new(&mut bytes);
    arrays.bytes("metadata", text.as_bytes()).expect("written");
    arrays.finish().expect("written");
    members(&bytes).remove(0).1
}
