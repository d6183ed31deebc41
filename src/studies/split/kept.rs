//! Results that are kept in a folder while long work runs, so that work that was stopped goes on from them.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::{fs, io};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::error::PartError;
use super::file::{PartHeader, SplitCommand, inputs_read};
use super::number::PartNumber;
use crate::io::WriteError;

/// A folder of results of one command, a file for each: a part of one, whose items have the result's name.
#[derive(Debug)]
pub struct KeptResults {
    folder: PathBuf,
    command: SplitCommand,
    inputs: BTreeMap<String, String>,
    clock: fn() -> SpentTime,
    taken: Cell<usize>,
    /// Reading of the clock when this run began.
    start: SpentTime,
    /// Time that the runs before this one spent until they kept their last result.
    before: Cell<SpentTime>,
}

/// Time in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpentTime {
    /// Processor time of all threads; none where the system does not say it.
    pub processor_s: Option<f64>,
    /// Time on the wall clock.
    pub wall_s: f64,
}

impl KeptResults {
    /// Results of a command in a folder, which is made when the first of them is kept. They depend on the files that
    /// were read until now. `clock` says the time since a fixed moment.
    ///
    /// # Errors
    /// [`PartError`] for files that cannot be read a second time.
    pub fn new(folder: PathBuf, command: SplitCommand, clock: fn() -> SpentTime) -> Result<Self, PartError> {
        let (inputs, taken, before) = (inputs_read()?, Cell::default(), Cell::default());
        Ok(Self { folder, command, inputs, clock, taken, start: clock(), before })
    }

    /// Refuses a folder with results of other work, which would be lost.
    ///
    /// # Errors
    /// [`PartError::OtherWork`], and [`PartError::Unreadable`] for what is no folder.
    pub fn require_no_other_work(&self) -> Result<(), PartError> {
        let unreadable = |source| PartError::Unreadable { path: self.folder.clone(), source };
        let files = match fs::read_dir(&self.folder) {
            Err(source) if source.kind() == io::ErrorKind::NotFound => return Ok(()),
            files => files.map_err(unreadable)?,
        };
        let mut paths = files.map(|file| Ok(file?.path())).collect::<Result<Vec<_>, _>>().map_err(unreadable)?;
        paths.sort();
        for path in paths {
            // What is no result is left alone, and a damaged one computed again.
            let Ok((header, _)) = PartHeader::read(&path) else { continue };
            if let Some([expected, found]) = self.difference(&header) {
                return Err(PartError::OtherWork { path, expected, found });
            }
        }
        Ok(())
    }

    /// First difference of a result's work from this: program, command, or input.
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

    /// Number of results that were taken from the folder.
    pub fn taken(&self) -> usize {
        self.taken.get()
    }

    /// Time that this run has spent so far, and runs before it on what was taken from them.
    pub fn spent(&self) -> SpentTime {
        let (now, start, before) = ((self.clock)(), self.start, self.before.get());
        let processor = now.processor_s.zip(start.processor_s).map(|(now, start)| now - start);
        SpentTime {
            processor_s: processor.map(|processor| processor + before.processor_s.unwrap_or(0.0)),
            wall_s: now.wall_s - start.wall_s + before.wall_s,
        }
    }

    /// Takes a result from the folder; computes and keeps it where there is none, or one of another command, program or
    /// input, or a damaged one. What is computed must depend on the command and the name, which is a file's, alone.
    ///
    /// # Errors
    /// Those of `compute`, and [`PartError`] if a result cannot be kept.
    pub fn get<T: Serialize + DeserializeOwned, E: From<PartError>>(
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
            // Of what is taken the last one knows the most.
            if spent.wall_s > self.before.get().wall_s {
                self.before.set(spent);
            }
            self.taken.set(self.taken.get() + 1);
            return Ok(result);
        }
        let result = compute()?;
        // Numbers, texts and lists of them are always encoded.
        let bytes = postcard::to_stdvec(&(self.spent(), &result)).expect("a result that can be encoded");
        header.write(&bytes, &path)?;
        Ok(result)
    }

    /// Removes the folder, when the work is done.
    ///
    /// # Errors
    /// [`PartError::Unwritable`].
    pub fn remove(&self) -> Result<(), PartError> {
        match fs::remove_dir_all(&self.folder) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                Err(WriteError::Folder { path: self.folder.clone(), source }.into())
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(program: &str, entry: &str) -> SplitCommand {
        SplitCommand { program: program.to_owned(), arguments: vec!["reproduce".to_owned(), entry.to_owned()] }
    }

    thread_local!(static NOW: Cell<f64> = const { Cell::new(0.0) });

    fn clock() -> SpentTime {
        SpentTime { processor_s: Some(2.0 * NOW.get()), wall_s: NOW.get() }
    }

    /// Bits of what is taken are those of what was kept; each result is computed once.
    #[test]
    fn work_that_was_stopped_goes_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let kept = |program, entry| {
            KeptResults::new(folder.path().join("kept"), command(program, entry), clock).expect("no inputs")
        };
        let computed = Cell::new(0);
        let get = |kept: &KeptResults, name: &str| {
            kept.get(name, || {
                computed.set(computed.get() + 1);
                Ok::<_, PartError>((computed.get(), [-0.0, f64::from_bits(1), 0.1_f64]))
            })
        };
        let first = get(&kept("1", "a"), "one").expect("computed");
        let again = get(&kept("1", "a"), "one").expect("kept");
        assert_eq!((first.0, again.0, again.1.map(f64::to_bits)), (1, 1, first.1.map(f64::to_bits)));
        assert_eq!(get(&kept("1", "a"), "two").expect("computed").0, 2);
        fs::write(folder.path().join("kept/other"), "a file of its own").expect("written");
        kept("1", "a").require_no_other_work().expect("work of its own");
        for (program, entry) in [("1", "b"), ("2", "a")] {
            let refused = kept(program, entry).require_no_other_work().expect_err("other work").to_string();
            assert!(refused.contains("/one.part: expected a result of\n"), "{refused}");
            let [expected, found] = match program {
                "2" => ["crossbar 2", "crossbar 1"],
                _ => ["crossbar reproduce b", "crossbar reproduce a"],
            };
            assert!(refused.ends_with(&format!("\n{expected}\nfound one of\n{found}")), "{refused}");
            let before = computed.get();
            assert_eq!(get(&kept(program, entry), "one").expect("computed").0, before + 1, "of other work");
        }
        let failed = kept("1", "a").get::<u8, _>("three", || Err(PartError::Empty));
        assert!(matches!(failed, Err(PartError::Empty)) && !folder.path().join("kept/three.part").exists());
        kept("1", "a").remove().expect("removed");
        assert!(!folder.path().join("kept").exists());
        kept("1", "a").remove().expect("nothing to remove");
    }

    /// The time of a run that goes on has that of the runs before it until their last results, each once.
    #[test]
    fn time_is_that_of_all_runs() {
        let folder = tempfile::tempdir().expect("a folder");
        let open = || KeptResults::new(folder.path().to_owned(), command("1", "a"), clock).expect("no inputs");
        let work = |kept: &KeptResults, name: &str, seconds: f64| {
            let compute = || {
                NOW.set(NOW.get() + seconds);
                Ok::<_, PartError>(0)
            };
            kept.get(name, compute).expect("a result");
        };
        NOW.set(1000.0);
        let first = open();
        work(&first, "one", 10.0);
        work(&first, "two", 5.0);
        assert_eq!(first.spent(), SpentTime { processor_s: Some(30.0), wall_s: 15.0 });
        // Stopped in the middle of the third.
        NOW.set(5000.0);
        let second = open();
        for name in ["one", "two", "three"] {
            work(&second, name, 7.0);
        }
        assert_eq!(second.spent(), SpentTime { processor_s: Some(44.0), wall_s: 22.0 });
    }

    #[test]
    fn a_damaged_result_is_computed_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let kept = KeptResults::new(folder.path().to_owned(), command("1", "a"), clock).expect("no inputs");
        let get = |result: u32| kept.get("one", || Ok::<_, PartError>(result)).expect("a result");
        assert_eq!([get(7), get(8)], [7, 7]);
        let path = folder.path().join("one.part");
        let whole = fs::read(&path).expect("a file");
        for damaged in [whole[..whole.len() - 1].to_vec(), b"nothing".to_vec(), Vec::new()] {
            fs::write(&path, damaged).expect("written");
            assert_eq!([get(9), get(8)], [9, 9]);
            fs::write(&path, &whole).expect("written");
            assert_eq!(get(8), 7);
        }
        // Of another type.
        assert_eq!(kept.get("one", || Ok::<_, PartError>(String::from("anew"))).expect("a result"), "anew");
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_said() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        let kept = KeptResults::new(file.path().join("folder"), command("1", "a"), clock).expect("no inputs");
        let error = kept.get("one", || Ok::<_, PartError>(1)).expect_err("no folder").to_string();
        assert!(error.starts_with("cannot write into the folder "), "{error}");
    }
}
