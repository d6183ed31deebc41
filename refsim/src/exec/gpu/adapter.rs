//! Enumeration and selection of GPU adapters.

use super::GpuError;
use serde::Serialize;
use std::fmt;

/// Kind of an adapter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum AdapterKind {
    /// A separate card.
    Discrete,
    /// Integrated into the processor or the board.
    Integrated,
    /// Virtualised GPU.
    Virtual,
    /// Software driver on the processor.
    Software,
    /// Not reported by the driver.
    Other,
}

impl fmt::Display for AdapterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Software => "software",
            Self::Other => "other",
        })
    }
}

/// A GPU adapter of the host.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Adapter {
    /// Name reported by the driver.
    pub name: String,
    /// Kind of the adapter.
    pub kind: AdapterKind,
    /// Graphics API: `vulkan`, `metal`, `dx12`.
    pub backend: String,
    /// Name and version of the driver.
    pub driver: String,
    /// Maximum size of a buffer that a shader can use, in bytes.
    pub largest_buffer: u64,
}

/// All adapters, in the driver's order.
pub fn adapters() -> Vec<Adapter> {
    raw_adapters().iter().map(describe).collect()
}

fn raw_adapters() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()))
}

pub(super) fn describe(adapter: &wgpu::Adapter) -> Adapter {
    let info = adapter.get_info();
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => AdapterKind::Discrete,
        wgpu::DeviceType::IntegratedGpu => AdapterKind::Integrated,
        wgpu::DeviceType::VirtualGpu => AdapterKind::Virtual,
        wgpu::DeviceType::Cpu => AdapterKind::Software,
        wgpu::DeviceType::Other => AdapterKind::Other,
    };
    Adapter {
        name: info.name,
        kind,
        backend: info.backend.to_str().to_owned(),
        driver: [info.driver, info.driver_info].join(" ").trim().to_owned(),
        largest_buffer: adapter.limits().max_storage_buffer_binding_size,
    }
}

/// Selects the adapter by its full name, or by a part of the name that no other adapter has, ignoring case. Without a
/// name, prefers a discrete adapter, then an integrated or virtual adapter, then any.
pub(super) fn pick(asked: Option<&str>) -> Result<wgpu::Adapter, GpuError> {
    let all = raw_adapters();
    let known: Vec<Adapter> = all.iter().map(describe).collect();
    let chosen = choose(&known, asked)?;
    all.into_iter().nth(chosen).ok_or(GpuError::NoAdapter)
}

/// Index of the adapter that [`Gpu::open`](super::Gpu::open) would choose among these adapters.
#[doc(hidden)] // Public for its test: no host has these adapters.
pub fn choose(known: &[Adapter], asked: Option<&str>) -> Result<usize, GpuError> {
    let rank = |kind| match kind {
        AdapterKind::Discrete => 0,
        AdapterKind::Integrated | AdapterKind::Virtual => 1,
        AdapterKind::Software | AdapterKind::Other => 2,
    };
    let Some(asked) = asked else {
        let best = known.iter().enumerate().min_by_key(|(_, adapter)| rank(adapter.kind));
        return best.map(|(i, _)| i).ok_or(GpuError::NoAdapter);
    };
    let wanted = asked.to_lowercase();
    let positions = |fits: &dyn Fn(&str) -> bool| -> Vec<usize> {
        (0..known.len()).filter(|&i| fits(&known[i].name.to_lowercase())).collect()
    };
    let whole = positions(&|name| name == wanted);
    let fitting = if whole.is_empty() { positions(&|name| name.contains(&wanted)) } else { whole };
    let names = |of: &[usize]| of.iter().map(|&i| known[i].name.clone()).collect();
    match fitting[..] {
        [one] => Ok(one),
        [] if known.is_empty() => Err(GpuError::NoAdapter),
        [] => {
            let everybody: Vec<usize> = (0..known.len()).collect();
            Err(GpuError::UnknownAdapter { asked: asked.to_owned(), found: names(&everybody) })
        }
        _ => Err(GpuError::AmbiguousAdapter { asked: asked.to_owned(), found: names(&fitting) }),
    }
}
