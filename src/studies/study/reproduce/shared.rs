//! Results that several entries share, computed on first use.

use std::any::Any;
use std::cell::OnceCell;
use std::rc::Rc;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{ModelSize, StudyError};
use crate::kept::KeptResults;

/// Result that entries share: one per type and key.
pub(super) trait SharedResult: Sized + 'static {
    /// Key of the result within its type.
    type Key: PartialEq + 'static;

    /// Computes the result, if necessary from other shared results.
    fn compute(key: &Self::Key, shared: &Shared) -> Result<Self, StudyError>;
}

/// The size of models, and the results so far.
#[derive(Default)]
pub(super) struct Shared {
    pub(super) models: ModelSize,
    results: Link,
    /// Folder in which long work stores its pieces, so that it can continue after an interruption.
    kept: Option<Rc<KeptResults>>,
}

/// List of results. It only grows, so that results can be borrowed while others are added.
type Link = OnceCell<Box<Node>>;

struct Node {
    /// A [`SharedResult`] with its key.
    result: Box<dyn Any>,
    next: Link,
}

impl Shared {
    pub(super) fn new(models: ModelSize) -> Self {
        Self { models, ..Self::default() }
    }

    /// Stores pieces of the run in a folder, and reuses existing ones.
    pub(super) fn keeping(self, kept: Option<Rc<KeptResults>>) -> Self {
        Self { kept, ..self }
    }

    /// Folder of stored pieces; `None` if they are not stored.
    pub(super) fn kept(&self) -> Option<&KeptResults> {
        self.kept.as_deref()
    }

    /// Returns a piece of an entry's work, which its name determines: read from the folder if it is stored there,
    /// otherwise computed.
    pub(super) fn piece<T: Serialize + DeserializeOwned>(
        &self,
        name: &str,
        compute: impl FnOnce() -> Result<T, StudyError>,
    ) -> Result<T, StudyError> {
        match &self.kept {
            Some(kept) => kept.get(name, compute),
            None => compute(),
        }
    }

    /// Returns a result; computes it on first use, and again if that failed.
    pub(super) fn get<T: SharedResult>(&self, key: T::Key) -> Result<&T, StudyError> {
        if let Some(found) = self.nodes().find_map(|node| node.get::<T>(&key)) {
            return Ok(found);
        }
        let found = T::compute(&key, self)?;
        // Appends it after the results that it needed.
        let end = self.nodes().last().map_or(&self.results, |node| &node.next);
        let node = end.get_or_init(|| Box::new(Node { result: Box::new((key, found)), next: Link::new() }));
        Ok(&node.result.downcast_ref::<(T::Key, T)>().expect("the type that was boxed").1)
    }

    fn nodes(&self) -> impl Iterator<Item = &Node> {
        std::iter::successors(self.results.get(), |node| node.next.get()).map(|node| &**node)
    }
}

impl Node {
    fn get<T: SharedResult>(&self, key: &T::Key) -> Option<&T> {
        let (known, result) = self.result.downcast_ref::<(T::Key, T)>()?;
        (known == key).then_some(result)
    }
}
