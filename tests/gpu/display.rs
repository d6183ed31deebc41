//! Pictures of radiosity.

use std::sync::Arc;

use refsim::exec::gpu::Gpu;
use refsim::machine::{Executor, ExecutorKind};

use crate::all_pictures::all_pictures;

pub(crate) fn the_same_pictures(gpu: &Arc<Gpu>) {
    let batch = all_pictures("nv35", &ExecutorKind::Batch.into());
    let found = all_pictures("nv35", &Executor::Gpu { gpu: Arc::clone(gpu) });
    assert!(found == batch);
}
