//! Results stored in a folder during long work, so that interrupted work can continue from them.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::{fs, io};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::file::{PartHeader, SplitCommand, inputs_read, unreadable, unwritable};
use super::number::PartNumber;
use crate::error::{InputError, input_error};
use crate::io::WriteError;

/// Folder with the results of one command: one part file per result; the name of its items is the result's name.
#[derive(Debug)]
pub struct KeptResults {
    folder: PathBuf,
    command: SplitCommand,
    inputs: BTreeMap<String, String>,
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
    /// Results of a command in a folder, which is created with the first result. They depend on the files read so far.
    /// `clock` returns the time since a fixed moment. Fails if a file cannot be read a second time.
    pub fn new(folder: PathBuf, command: SplitCommand, clock: fn() -> SpentTime) -> Result<Self, InputError> {
        let (inputs, taken, before) = (inputs_read()?, Cell::default(), Cell::default());
        Ok(Self { folder, command, inputs, clock, taken, start: clock(), before })
    }

    /// Rejects a folder with results of other work, which would be lost. The error names the first such result. Also
    /// fails for a path that is not a folder.
    pub fn require_no_other_work(&self) -> Result<(), InputError> {
        let unreadable = |source| unreadable(&self.folder, source);
        let files = match fs::read_dir(&self.folder) {
            Err(source) if source.kind() == io::ErrorKind::NotFound => return Ok(()),
            files => files.map_err(unreadable)?,
        };
        let mut paths = files.map(|file| Ok(file?.path())).collect::<Result<Vec<_>, _>>().map_err(unreadable)?;
        paths.sort();
        for path in paths {
            // Other files are ignored, and damaged results are computed again.
            let Ok((header, _)) = PartHeader::read(&path) else { continue };
            if let Some([expected, found]) = self.difference(&header) {
                let other = input_error!(
                    "crossbar::part::other" => "expected a result of\n{expected}\nfound one of\n{found}";
                    help "continue with the command, the inputs and the program of the first run, or name another folder"
                );
                return Err(other.at(path.as_path()));
            }
        }
        Ok(())
    }

    /// First difference between the work of a stored result and this work: program, command, or input.
    fn difference(&self, found: &PartHeader) -> Option<[String; 2]> {
        let commands = [&self.command, &found.command];
        if commands[0].program != commands[1].program {
            return Some(commands.map(|command| format!("crossbar {}", command.program)));
        }
        if commands[0] != commands[1] {
            return Some(commands.map(SplitCommand::line));
        }
        let inputs = [&self.inputs, &found.inputs];
        let of = |name: &String| {
            inputs.map(|inputs| match inputs.get(name) {
                Some(digest) => format!("`{name}` with SHA-256 {digest}"),
                None => format!("another file than `{name}`"),
            })
        };
        let differs = |name: &&String| inputs[0].get(*name) != inputs[1].get(*name);
        inputs.iter().flat_map(|inputs| inputs.keys()).find(differs).map(of)
    }

    /// Number of results that were read from the folder.
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

    /// Reads a result from the folder; computes and stores it if it is missing, damaged, or of another command, program
    /// or input. The result must depend only on the command and the name, which is a file name. Fails if `compute`
    /// does, or a result cannot be stored.
    pub fn get<T: Serialize + DeserializeOwned, E: From<InputError>>(
        &self,
        name: &str,
        compute: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        let path = self.folder.join(format!("{name}.part"));
        let header = PartHeader::new(self.command.clone(), PartNumber::ONLY, self.inputs.clone(), (name, 1));
        if let Ok((found, bytes)) = PartHeader::read(&path)
            && found.is_of(&header)
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
        // Numbers, strings and lists of them always encode.
        let bytes = postcard::to_stdvec(&(self.spent(), &result)).expect("a result that can be encoded");
        header.write(&bytes, &path)?;
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
