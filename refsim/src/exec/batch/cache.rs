//! Caches of decoded programs and textures, shared by draws and by the machines that use an executor. The least
//! recently used entry is evicted. Keys are compared in full, so a hit equals a fresh decoding. A pool keeps buffers of
//! workers for reuse.

use std::sync::{Arc, Mutex, PoisonError};

/// Maximum number of entries.
const MAX_KEPT: usize = 16;

/// A cache of the most recently used values, by key.
#[derive(Debug)]
pub(crate) struct Cache<K, V> {
    /// Entries in order of use, most recent last.
    entries: Mutex<Vec<(K, Arc<V>)>>,
}

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self { entries: Mutex::default() }
    }
}

impl<K, V> Cache<K, V> {
    /// Returns the value whose key `matches`, or creates it.
    pub(crate) fn get(&self, matches: impl Fn(&K) -> bool, make: impl FnOnce() -> (K, V)) -> Arc<V> {
        if let Some(value) = self.find(matches) {
            return value;
        }
        // Created without the lock: another thread may create the same value at the same time, which only wastes work.
        let (key, value) = make();
        let value = Arc::new(value);
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        if entries.len() >= MAX_KEPT {
            entries.remove(0);
        }
        entries.push((key, Arc::clone(&value)));
        value
    }

    /// Returns the value whose key `matches`, if it is cached.
    pub(crate) fn find(&self, matches: impl Fn(&K) -> bool) -> Option<Arc<V>> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let found = entries.iter().rposition(|(key, _)| matches(key))?;
        let entry = entries.remove(found);
        let value = Arc::clone(&entry.1);
        entries.push(entry);
        Some(value)
    }
}

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
    /// Takes an object that satisfies `fit`, if there is one.
    pub(crate) fn take(&self, fit: impl Fn(&T) -> bool) -> Option<T> {
        let mut idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let found = idle.iter().rposition(fit)?;
        Some(idle.swap_remove(found))
    }

    /// Returns an object to the pool, unless the pool is full.
    pub(crate) fn keep(&self, item: T) {
        let mut idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        if idle.len() < MAX_KEPT {
            idle.push(item);
        }
    }
}
