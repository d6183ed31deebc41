//! Access to an adapter for tests, on hosts with or without a GPU.

use super::{Gpu, GpuError};
use std::sync::{Arc, LazyLock};

static SHARED: LazyLock<Result<Arc<Gpu>, GpuError>> = LazyLock::new(|| {
    let asked = std::env::var("CROSSBAR_ADAPTER").ok();
    Gpu::open(asked.as_deref()).map(Arc::new)
});

/// The adapter shared by the tests of one process: named by the environment variable `CROSSBAR_ADAPTER`, or else the
/// best adapter.
///
/// `Ok(None)` if there is no adapter: the test should count as ignored.
///
/// # Errors
/// If an adapter cannot be opened, or if there is no adapter and the environment variable `CI` is set.
pub fn shared() -> Result<Option<Arc<Gpu>>, GpuError> {
    match &*SHARED {
        Ok(gpu) => Ok(Some(Arc::clone(gpu))),
        Err(GpuError::NoAdapter) if std::env::var_os("CI").is_none() => Ok(None),
        Err(e) => Err(e.clone()),
    }
}
