//! Results that several entries share, computed on first use.

use std::any::Any;
use std::cell::RefCell;
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
    /// A key with a pointer to its [`SharedResult`] in each box.
    results: RefCell<Vec<Box<dyn Any>>>,
    /// Folder in which long work stores its pieces, so that it can continue after an interruption.
    kept: Option<Rc<KeptResults>>,
}

impl Shared {
    pub(super) fn new(models: ModelSize) -> Self {
        Self { models, ..Self::default() }
    }

    /// Stores pieces of the run in a folder, and reuses existing pieces.
    pub(super) fn keeping(self, kept: Option<Rc<KeptResults>>) -> Self {
        Self { kept, ..self }
    }

    /// Folder of stored pieces; `None` if they are not stored.
    pub(super) fn kept(&self) -> Option<&KeptResults> {
        self.kept.as_deref()
    }

    /// Returns the piece of an entry's work with this name: read from the folder if it is stored there, otherwise
    /// computed. The name must determine the result.
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
    pub(super) fn get<T: SharedResult>(&self, key: T::Key) -> Result<Rc<T>, StudyError> {
        let of_key = |result: &Box<dyn Any>| {
            let (known, result) = result.downcast_ref::<(T::Key, Rc<T>)>()?;
            (*known == key).then(|| Rc::clone(result))
        };
        let known = self.results.borrow().iter().find_map(of_key);
        if let Some(found) = known {
            return Ok(found);
        }
        let found = Rc::new(T::compute(&key, self)?);
        self.results.borrow_mut().push(Box::new((key, Rc::clone(&found))));
        Ok(found)
    }
}
