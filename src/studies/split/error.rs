//! Errors of parts.

use std::io;
use std::path::PathBuf;

use miette::Diagnostic;
use thiserror::Error;

use super::number::PartNumber;
use crate::io::WriteError;

/// A part that cannot be written, or parts that do not make one run.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PartError {
    /// The part's file cannot be written; nothing of it was left behind.
    #[error(transparent)]
    #[diagnostic(code(crossbar::part::unwritable))]
    Unwritable(#[from] WriteError),
    /// A file cannot be read.
    #[error("cannot read {}", path.display())]
    #[diagnostic(code(crossbar::part::unreadable))]
    Unreadable { path: PathBuf, source: io::Error },
    /// An input that cannot be read again, such as a pipe.
    #[error("expected input from files, found {}, which cannot be read a second time", path.display())]
    #[diagnostic(code(crossbar::part::input), help("save it to a file: a part holds the digests of its input"))]
    NotAFile { path: PathBuf },
    /// A name that a part cannot hold.
    #[error("expected names and values in UTF-8, found {found}")]
    #[diagnostic(code(crossbar::part::input), help("give the file another name"))]
    Name { found: String },
    /// Another file.
    #[error("{}: expected a part that `--part` wrote, found another file", path.display())]
    #[diagnostic(code(crossbar::part::file), help("name the files that `--part K/N --out FILE` wrote"))]
    NotAPart { path: PathBuf },
    /// A layout of another version.
    #[error("{}: expected a part file of version {expected}, found version {found}", path.display())]
    #[diagnostic(code(crossbar::part::file), help("compute the part again with this program"))]
    Layout { path: PathBuf, expected: u32, found: String },
    /// A file that is not as long as it says.
    #[error("{}: expected {expected} bytes, found {found}", path.display())]
    #[diagnostic(
        code(crossbar::part::file),
        help("the file is truncated, or something was appended: copy it again, or compute the part again")
    )]
    Length { path: PathBuf, expected: u64, found: u64 },
    /// A file whose contents do not have its digest.
    #[error("{}: the contents do not have the SHA-256 at the end of the file", path.display())]
    #[diagnostic(
        code(crossbar::part::file),
        help("the file was damaged or edited: copy it again, or compute the part again")
    )]
    Digest { path: PathBuf },
    /// Contents with a right digest that are not what the command computes.
    #[error("{}: expected the results of {count} {items}, found something else", path.display())]
    #[diagnostic(code(crossbar::part::file), help("compute the part again"))]
    Contents { path: PathBuf, items: &'static str, count: usize },
    /// A part of another program.
    #[error("{}: expected a part of this program, crossbar {expected}, found one of crossbar {found}", path.display())]
    #[diagnostic(
        code(crossbar::part::program),
        help("compute the part again with this program, or merge with that one")
    )]
    Program { path: PathBuf, expected: String, found: String },
    /// Parts of two commands.
    #[error("{} and {} are parts of two commands:\n{}\n{}", paths[0].display(), paths[1].display(), commands[0], commands[1])]
    #[diagnostic(code(crossbar::part::command), help("name parts of one command, with one path per input"))]
    Command { paths: [PathBuf; 2], commands: [String; 2] },
    /// A command that cannot have been split.
    #[error("{}: expected a part of a command with `--part`, found one of `{command}`", path.display())]
    #[diagnostic(code(crossbar::part::command))]
    Indivisible { path: PathBuf, command: String },
    /// Parts of two numbers of parts.
    #[error("{} is part {}, and {} is part {}", paths[0].display(), numbers[0], paths[1].display(), numbers[1])]
    #[diagnostic(code(crossbar::part::number), help("name parts of one division: all of them with one N"))]
    Divisions { paths: [PathBuf; 2], numbers: [PartNumber; 2] },
    /// A part that was named twice.
    #[error("{} and {} both are part {number}", paths[0].display(), paths[1].display())]
    #[diagnostic(code(crossbar::part::number), help("leave one of them out"))]
    Twice { paths: [PathBuf; 2], number: PartNumber },
    /// No part at all.
    #[error("expected the parts of a run, found none")]
    #[diagnostic(code(crossbar::part::number))]
    Empty,
    /// Parts that are missing.
    #[error("expected {of} parts, found {}; missing: {missing}", of - count)]
    #[diagnostic(
        code(crossbar::part::number),
        help("compute these with `--part`: the command of the others is\n{command}")
    )]
    Missing { of: u32, count: u32, missing: String, command: String },
    /// Results that were kept by other work.
    #[error("{}: expected a result of\n{expected}\nfound one of\n{found}", path.display())]
    #[diagnostic(
        code(crossbar::part::other),
        help("go on with the command, the inputs and the program of the first run, or name another folder")
    )]
    OtherWork { path: PathBuf, expected: String, found: String },
    /// An input that has changed.
    #[error("{}: computed from another `{input}` than there is now: expected SHA-256 {expected}, found {found}", path.display())]
    #[diagnostic(
        code(crossbar::part::input),
        help("bring back the file that the part was computed from, or compute all parts anew")
    )]
    Input { path: PathBuf, input: String, expected: String, found: String },
}
