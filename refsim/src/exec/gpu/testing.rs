//! What tests do where there may be no GPU.

use super::{Gpu, GpuError};
use std::sync::{Arc, LazyLock};

static SHARED: LazyLock<Result<Arc<Gpu>, GpuError>> = LazyLock::new(|| {
    let asked = std::env::var("CROSSBAR_ADAPTER").ok();
    Gpu::open(asked.as_deref()).map(Arc::new)
});

/// The adapter that tests of one process share: the one that the environment variable `CROSSBAR_ADAPTER` names, or the
/// best there is.
///
/// `Ok(None)` without any adapter: the test is to be counted as ignored.
///
/// # Errors
/// Where the environment variable `CI` is set, no adapter is a failure too; as is one that can't be opened.
pub fn shared() -> Result<Option<Arc<Gpu>>, GpuError> {
    match &*SHARED {
        Ok(gpu) => Ok(Some(Arc::clone(gpu))),
        Err(GpuError::NoAdapter) if std::env::var_os("CI").is_none() => Ok(None),
        Err(e) => Err(e.clone()),
    }
}
