//! Tests the host side of the GPU executor: buffer transfers, shaders, errors.

#[path = "common/adapter.rs"]
mod adapter;
#[path = "../src/exec/gpu/arena.rs"]
mod arena;

use arena::Arena;
use refsim::exec::gpu::{Access, Adapter, AdapterKind, Gpu, GpuError, choose};
use std::process::ExitCode;
use std::sync::Arc;

const DOUBLE: &str = "
@group(0) @binding(0) var<storage, read> given: array<u32>;
@group(0) @binding(1) var<storage, read_write> made: array<u32>;
@compute @workgroup_size(64) fn double(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&given) { made[id.x] = 2u * given[id.x]; }
}";

fn main() -> ExitCode {
    let mut trials = adapter::trials![on_host: room_is_used_again, adapters_are_picked_by_name_and_kind];
    trials.extend(adapter::trials![on_adapter: words_go_there_and_back, faults_are_errors]);
    adapter::run(trials)
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

fn room_is_used_again() {
    let mut arena = Arena::default();
    let places = [10, 20, 30, 40].map(|words| arena.take(words));
    assert_eq!(places, [0, 10, 30, 60]);
    arena.give(10, 20);
    arena.give(0, 10);
    assert_eq!(arena.take(25), 0, "holes beside each other are one");
    assert_eq!(arena.take(6), 100);
    arena.give(100, 6);
    arena.give(60, 40);
    assert_eq!(arena.end, 60);
    assert_eq!(arena.take(5), 25);
}

fn known_adapter(name: &str, kind: AdapterKind) -> Adapter {
    Adapter { name: name.to_owned(), kind, backend: String::new(), driver: String::new(), largest_buffer: 0 }
}

fn adapters_are_picked_by_name_and_kind() {
    let known = [
        known_adapter("llvmpipe (LLVM 15)", AdapterKind::Software),
        known_adapter("Radeon 8500", AdapterKind::Discrete),
        known_adapter("Radeon 9700", AdapterKind::Discrete),
        known_adapter("Radeon", AdapterKind::Integrated),
    ];
    assert_eq!(choose(&known, None), Ok(1));
    assert_eq!(choose(&known[..1], None), Ok(0));
    assert_eq!(choose(&known, Some("LLVMpipe")), Ok(0));
    assert_eq!(choose(&known, Some("9700")), Ok(2));
    // An exact name takes precedence over names that contain it.
    assert_eq!(choose(&known, Some("radeon")), Ok(3));
    assert_eq!(choose(&[], None), Err(GpuError::NoAdapter));
    assert_eq!(choose(&[], Some("x")), Err(GpuError::NoAdapter));
    assert!(
        matches!(choose(&known[1..3], Some("radeon")), Err(GpuError::AmbiguousAdapter { found, .. }) if found.len() == 2)
    );
    let unknown = choose(&known[..2], Some("voodoo")).err().map(|e| e.to_string());
    assert_eq!(
        unknown.as_deref(),
        Some("no GPU adapter is called `voodoo`; there are: llvmpipe (LLVM 15), Radeon 8500")
    );
}
