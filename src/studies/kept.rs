//! Results stored in a folder during long work, so that interrupted work can continue from them.

use std::cell::Cell;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use crate::error::{InputError, input_error};
use crate::io::{WriteError, write_file};
use crate::report::sha256;

/// Bytes of the digest at the end of a result's file.
const DIGEST: usize = 32;

/// The work that a result belongs to, as lines of text: the program, the command, and every input with its digest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeptWork(Vec<String>);

impl KeptWork {
    /// The work of a program (version, and commit or digest) and a command, as a line without options that change no
    /// result, on files. Fails if a file cannot be read; a pipe can be read only once.
    pub fn new(program: &str, command: String, inputs: &[&Path]) -> Result<Self, InputError> {
        let digest = |path: &&Path| match File::open(path).and_then(sha256) {
            Ok(digest) if path.is_file() => Ok(format!("`{}` with SHA-256 {digest}", path.display())),
            Ok(_) => Err(input_error!("crossbar::kept::input" => "{}: expected a file, found a pipe", path.display();
                help "save the input to a file: kept results belong to the contents of their input")),
            Err(source) => Err(unreadable(path, source)),
        };
        let own = [format!("crossbar {program}"), command].map(Ok);
        own.into_iter().chain(inputs.iter().map(digest)).collect::<Result<_, _>>().map(Self)
    }
}

/// Folder of results of one command: a file per result, named after it.
#[derive(Debug)]
pub struct KeptResults {
    folder: PathBuf,
    work: KeptWork,
    clock: fn() -> SpentTime,
    taken: Cell<usize>,
    /// Reading of the clock when this run began.
    start: SpentTime,
    /// Time that earlier runs spent until they stored their last result.
    before: Cell<SpentTime>,
}

/// Time in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpentTime {
    /// Processor time of all threads, in seconds; `None` if the system does not report it.
    pub processor_s: Option<f64>,
    /// Wall-clock time, in seconds.
    pub wall_s: f64,
}

impl KeptResults {
    /// Results in a folder, created with the first one; `clock` returns the time since a fixed moment.
    pub fn new(folder: PathBuf, work: KeptWork, clock: fn() -> SpentTime) -> Self {
        Self { folder, work, clock, taken: Cell::default(), start: clock(), before: Cell::default() }
    }

    /// Rejects a path that is not a folder, and a folder with results of other work, because these would be lost.
    pub fn require_no_other_work(&self) -> Result<(), InputError> {
        let unreadable = |source| unreadable(&self.folder, source);
        let files = match fs::read_dir(&self.folder) {
            Err(source) if source.kind() == io::ErrorKind::NotFound => return Ok(()),
            files => files.map_err(unreadable)?,
        };
        let mut paths = files.map(|file| Ok(file?.path())).collect::<Result<Vec<_>, _>>().map_err(unreadable)?;
        paths.sort();
        for path in paths {
            // Other files are left alone, and damaged results are computed again.
            if let Some((work, _)) = read(&path)
                && let Some((expected, found)) = self.work.0.iter().zip(&work.0).find(|(own, other)| own != other)
            {
                let other = input_error!(
                    "crossbar::kept::other" => "expected a result of\n{expected}\nfound a result of\n{found}";
                    help "continue with the command, inputs and program of the first run, or choose another folder"
                );
                return Err(other.at(path.as_path()));
            }
        }
        Ok(())
    }

    /// Number of results that were taken from the folder.
    pub fn taken(&self) -> usize {
        self.taken.get()
    }

    /// Time of this run so far, plus the time that earlier runs spent on reused results.
    pub fn spent(&self) -> SpentTime {
        let (now, start, before) = ((self.clock)(), self.start, self.before.get());
        let processor = now.processor_s.zip(start.processor_s).map(|(now, start)| now - start);
        SpentTime {
            processor_s: processor.map(|processor| processor + before.processor_s.unwrap_or(0.0)),
            wall_s: now.wall_s - start.wall_s + before.wall_s,
        }
    }

    /// Takes a result from the folder; computes and stores it if it is missing, damaged, or of other work. The result
    /// must depend only on the work and the name, which is a file name. Fails if `compute` fails, or if a result cannot
    /// be stored.
    pub fn get<T: Serialize + DeserializeOwned, E: From<InputError>>(
        &self,
        name: &str,
        compute: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        let path = self.folder.join(format!("{name}.kept"));
        if let Some((work, bytes)) = read(&path)
            && work == self.work
            && let Ok(((spent, result), [])) = postcard::take_from_bytes::<(SpentTime, T)>(&bytes)
        {
            // The last file read has the largest time.
            if spent.wall_s > self.before.get().wall_s {
                self.before.set(spent);
            }
            self.taken.set(self.taken.get() + 1);
            return Ok(result);
        }
        let result = compute()?;
        // Numbers, texts and lists of them always encode.
        let mut bytes =
            postcard::to_stdvec(&(&self.work, self.spent(), &result)).expect("a result that can be encoded");
        bytes.extend_from_slice(&Sha256::digest(&bytes));
        write_file(&path, |file| file.write_all(&bytes)).map_err(unwritable)?;
        Ok(result)
    }

    /// Removes the folder when the work is done. Fails if it cannot be removed.
    pub fn remove(&self) -> Result<(), InputError> {
        match fs::remove_dir_all(&self.folder) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                Err(unwritable(WriteError::Folder { path: self.folder.clone(), source }))
            }
            _ => Ok(()),
        }
    }
}

/// The work and the encoded result in a file; `None` if the file is incomplete or damaged.
fn read(path: &Path) -> Option<(KeptWork, Vec<u8>)> {
    let bytes = fs::read(path).ok()?;
    let (contents, digest) = bytes.split_at_checked(bytes.len().checked_sub(DIGEST)?)?;
    let (work, result) = postcard::take_from_bytes(contents).ok()?;
    (Sha256::digest(contents).as_slice() == digest).then(|| (work, result.to_vec()))
}

/// Error for a file that cannot be read.
pub fn unreadable(path: &Path, source: io::Error) -> InputError {
    input_error!("crossbar::kept::unreadable" => "cannot read {}", path.display()).with_source(source)
}

/// Error for a result's file that cannot be written; no incomplete file remains.
fn unwritable(error: WriteError) -> InputError {
    InputError::of("crossbar::kept::unwritable", error)
}
