//! Tests the host side of the GPU executor: buffer transfers, shaders, errors.

#[path = "common/adapter.rs"]
mod adapter;

use refsim::exec::gpu::{Access, Gpu, GpuError};
use std::process::ExitCode;
use std::sync::Arc;

const DOUBLE: &str = "
@group(0) @binding(0) var<storage, read> given: array<u32>;
@group(0) @binding(1) var<storage, read_write> made: array<u32>;
@compute @workgroup_size(64) fn double(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&given) { made[id.x] = 2u * given[id.x]; }
}";

fn main() -> ExitCode {
    adapter::run(adapter::trials![on_adapter: words_go_there_and_back, faults_are_errors])
}

fn words_go_there_and_back(gpu: &Arc<Gpu>) {
    let given: Vec<u32> = (0..1000).collect();
    let made = gpu.compute(DOUBLE, "double", &[&given], 1000, [16, 1, 1]).unwrap_or_else(|e| panic!("{e}"));
    assert!(made.iter().zip(&given).all(|(m, g)| *m == 2 * g));
    let buffer = gpu.buffer_of(&given).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(gpu.read(&buffer, 3..6), Ok(vec![3, 4, 5]));
    assert_eq!(gpu.read(&buffer, 7..7), Ok(vec![]));
    let wider = gpu.buffer(2000).unwrap_or_else(|e| panic!("{e}"));
    gpu.copy(&buffer, &wider);
    assert_eq!(gpu.read(&wider, 998..1002), Ok(vec![998, 999, 0, 0]));
}

fn faults_are_errors(gpu: &Arc<Gpu>) {
    assert!(matches!(gpu.pipeline("fn broken(", "main", &[]), Err(GpuError::Shader { .. })));
    assert!(matches!(gpu.pipeline(DOUBLE, "main", &[Access::Read, Access::ReadWrite]), Err(GpuError::Shader { .. })));
    assert!(matches!(gpu.pipeline(DOUBLE, "double", &[Access::Read]), Err(GpuError::Shader { .. })));
    assert!(matches!(gpu.buffer(usize::MAX / 8), Err(GpuError::Memory { .. })));
    let buffer = gpu.buffer(4).unwrap_or_else(|e| panic!("{e}"));
    assert!(matches!(gpu.read(&buffer, 2..5), Err(GpuError::Device { .. })));
    assert!(matches!(gpu.upload(&buffer, 3, &[1, 2]), Err(GpuError::Device { .. })));
    let double = gpu.pipeline(DOUBLE, "double", &[Access::Read, Access::ReadWrite]).unwrap_or_else(|e| panic!("{e}"));
    assert!(matches!(gpu.dispatch(&double, &[&buffer], [1, 1, 1]), Err(GpuError::Device { .. })));
    assert!(matches!(Gpu::open(Some("no such card")), Err(GpuError::UnknownAdapter { .. } | GpuError::NoAdapter)));
}
