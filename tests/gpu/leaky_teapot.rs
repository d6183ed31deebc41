//! The leaky teapot.

use crate::environment::is_full;
use std::sync::Arc;

use crossbar::study::configuration::Configuration;
use refsim::exec::gpu::Gpu;
use refsim::machine::Executor;

use crate::teapot_study::{assert_same, formats, parameters, small_study, study};

pub(crate) fn the_same_study(gpu: &Arc<Gpu>) {
    // A software driver takes minutes for the whole small study.
    let mut small = parameters(16, 1, formats(&["fp16", "fp24", "fp32"]));
    small.configurations.push(Configuration::device("r200").expect("a card"));
    small.options.rays_per_edge = 0;
    if is_full() {
        small = small_study().0;
    }
    let batch = study(&small);
    small.executor = Executor::Gpu { gpu: Arc::clone(gpu) };
    assert_same(&batch, &study(&small), "wgpu");
}
