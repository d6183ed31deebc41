//! What was decoded stays decoded: programs as plans, textures as tables, kept over draws, and over the machines that
//! share an executor, for as long as they are among the last few in use. A key is compared in full, so a hit is what
//! decoding would give again. Rows that a worker has done with are kept for the next.

use std::sync::{Arc, Mutex, PoisonError};

/// Entries kept.
const MAX_KEPT: usize = 16;

/// The last few values, by key.
#[derive(Debug)]
pub(crate) struct Cache<K, V> {
    /// Latest use last.
    entries: Mutex<Vec<(K, Arc<V>)>>,
}

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self { entries: Mutex::default() }
    }
}

impl<K, V> Cache<K, V> {
    /// The value whose key `matches`, or a new one.
    pub(crate) fn get(&self, matches: impl Fn(&K) -> bool, make: impl FnOnce() -> (K, V)) -> Arc<V> {
        if let Some(value) = self.find(matches) {
            return value;
        }
        // Made without the lock: another thread may make the same meanwhile, which is a waste and no more.
        let (key, value) = make();
        let value = Arc::new(value);
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        if entries.len() >= MAX_KEPT {
            entries.remove(0);
        }
        entries.push((key, Arc::clone(&value)));
        value
    }

    /// The value whose key `matches`, if there is one.
    pub(crate) fn find(&self, matches: impl Fn(&K) -> bool) -> Option<Arc<V>> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let found = entries.iter().rposition(|(key, _)| matches(key))?;
        let entry = entries.remove(found);
        let value = Arc::clone(&entry.1);
        entries.push(entry);
        Some(value)
    }
}

/// Things kept for later use.
#[derive(Debug)]
pub(crate) struct Pool<T> {
    idle: Mutex<Vec<T>>,
}

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self { idle: Mutex::default() }
    }
}

impl<T> Pool<T> {
    /// One that is `fit`, if there is one.
    pub(crate) fn take(&self, fit: impl Fn(&T) -> bool) -> Option<T> {
        let mut idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let found = idle.iter().rposition(fit)?;
        Some(idle.swap_remove(found))
    }

    /// Keeps one, unless there are enough.
    pub(crate) fn keep(&self, item: T) {
        let mut idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        if idle.len() < MAX_KEPT {
            idle.push(item);
        }
    }
}
