//! Results that several entries share, computed on first use; stand-ins for the papers' models and light.

use std::any::Any;
use std::cell::RefCell;
use std::rc::Rc;

use glam::DVec3;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::StudyError;
use crate::kept::KeptResults;
use crate::sphere::ClearSky;

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

/// Size of the stand-ins for a paper's models, for entries that have a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum ModelSize {
    /// Small models: seconds per entry, for tests.
    Reduced,
    /// As printed: half a minute to three hours of processor time per entry.
    #[default]
    Printed,
}

impl ModelSize {
    /// One of two values: for models as printed, or for reduced models.
    pub(super) fn pick<T>(self, printed: T, reduced: T) -> T {
        match self {
            Self::Printed => printed,
            Self::Reduced => reduced,
        }
    }
}

/// Clear sky with a sun half a degree wide, which casts hard shadows.
pub(super) const HARD_SUN: ClearSky = ClearSky {
    sun: DVec3::new(1.0, -0.6, 1.1),
    sun_radiance: [4e4, 3.7e4, 3.2e4],
    zenith: [0.25, 0.4, 0.7],
    ground: [0.1; 3],
};
