//! Order in which entries are computed: those of different papers at the same time.

use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;

use super::shared::Shared;
use super::{EntryFindings, ModelSize, ReproduceEntry, Reproduced, StudyError, record};
use crate::study::ProgressFn;

/// Stack of a worker thread, in bytes: that of a main thread.
const STACK_BYTES: usize = 8 << 20;

/// Entries that share results, by their places among all.
type EntryGroup = Vec<(usize, ReproduceEntry)>;

/// Message of a worker thread.
enum EntryEvent {
    Begun(&'static str),
    Ended(usize, Box<Result<EntryFindings, StudyError>>),
}

/// Computes entries, with models of the given size where they have a choice. Renderings and runs needed by several
/// entries of a paper are made once. With reduced models, rows that depend on the size are those of the record
/// ([`recorded`](super::recorded)), if there is one. `progress` is called with the name of each.
///
/// Reduced, entries of different papers run at the same time, because much of an entry runs on one thread. At full size
/// they run one after the other: together they would need several times the memory.
///
/// # Errors
/// Those of the entries, and of a record that is malformed or was changed by hand; of several, that of the first entry.
pub fn reproduce(
    entries: &[ReproduceEntry],
    models: ModelSize,
    progress: &mut ProgressFn<'_>,
) -> Result<Reproduced, StudyError> {
    // A thread of a pool must not wait for work that needs its own pool.
    let is_alone = models == ModelSize::Printed || rayon::current_thread_index().is_some();
    let threads = if is_alone { 1 } else { rayon::current_num_threads() };
    let groups = Mutex::new(groups(entries, threads));
    let (sender, receiver) = mpsc::channel();
    let work = |sender: mpsc::Sender<EntryEvent>| {
        let next = || groups.lock().unwrap_or_else(PoisonError::into_inner).pop();
        while let Some(group) = next() {
            let shared = Shared::new(models);
            for (at, entry) in group {
                // Nobody listens any more only if `progress` has unwound: nothing more is computed.
                if sender.send(EntryEvent::Begun(entry.id)).is_err() {
                    return;
                }
                let found = record::findings(&entry, &shared);
                let failed = found.is_err();
                if sender.send(EntryEvent::Ended(at, Box::new(found))).is_err() {
                    return;
                }
                if failed {
                    break;
                }
            }
        }
    };
    let mut found: Vec<Option<Result<EntryFindings, StudyError>>> = entries.iter().map(|_| None).collect();
    thread::scope(|scope| {
        for number in 0..threads {
            let sender = sender.clone();
            let worker = thread::Builder::new().stack_size(STACK_BYTES);
            // A thread that cannot be started leaves its work to the others; the first one must.
            let started = worker.spawn_scoped(scope, || work(sender));
            assert!(number > 0 || started.is_ok(), "expected a thread for the entries: {:?}", started.err());
        }
        drop(sender);
        let mut done = 0;
        for event in receiver {
            match event {
                EntryEvent::Begun(id) => progress(id, done, entries.len() as u64),
                EntryEvent::Ended(at, result) => {
                    done += 1;
                    found[at] = Some(*result);
                }
            }
        }
    });
    // An entry without result is behind one that failed, of its paper.
    let error = found.iter().position(|found| matches!(found, Some(Err(_))));
    if let Some(Some(Err(error))) = error.map(|at| found.swap_remove(at)) {
        return Err(error);
    }
    Ok(entries.iter().copied().zip(found.into_iter().flatten().flatten()).collect())
}

/// Entries by paper, those of the first paper last; all in one group for one thread.
fn groups(entries: &[ReproduceEntry], threads: usize) -> Vec<EntryGroup> {
    let mut groups: Vec<EntryGroup> = Vec::new();
    for (at, entry) in entries.iter().enumerate() {
        let belongs = |group: &&mut EntryGroup| threads == 1 || group[0].1.paper == entry.paper;
        match groups.iter_mut().find(belongs) {
            Some(group) => group.push((at, *entry)),
            None => groups.push(vec![(at, *entry)]),
        }
    }
    groups
}
