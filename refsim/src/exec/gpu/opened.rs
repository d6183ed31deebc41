//! An opened adapter: buffers of 32-bit words, compute pipelines, dispatches, read-back.

use super::adapter::{Adapter, describe, pick};
use super::error::GpuError;
use crate::exec::wgsl::parts::Parts;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Access of a shader to a storage buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Access {
    /// `var<storage, read>`
    Read,
    /// `var<storage, read_write>`
    ReadWrite,
}

/// A buffer of 32-bit words on the adapter.
#[derive(Clone, Debug)]
pub struct Buffer {
    inner: wgpu::Buffer,
    words: usize,
}

impl Buffer {
    /// Size in 32-bit words.
    pub fn words(&self) -> usize {
        self.words
    }
}

/// A compiled compute shader; bindings 0, 1, ... of group 0 are storage buffers.
#[derive(Clone, Debug)]
pub struct Pipeline {
    inner: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    bindings: usize,
}

/// Key of a pipeline: shader text, entry point, bindings.
type PipelineKey = (String, String, Vec<Access>);

/// A kernel that is compiled with a subset of its parts.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// Entry point; identifies the kernel.
    pub entry: &'static str,
    /// Complete text with all parts.
    pub text: fn() -> String,
    /// Bindings.
    pub bindings: &'static [Access],
}

/// Compilation policy of a kernel's texts: the first `MAX_EXACT` contain only what their draw needs, those up to
/// `MAX_GROWING` everything used so far, and the next one everything. Otherwise every random program would need its own
/// text.
const MAX_EXACT: usize = 6;
const MAX_GROWING: usize = 9;

/// Called before a pipeline is compiled, which takes seconds; the returned value is dropped afterwards.
pub type CompileObserver = Box<dyn Fn() -> Box<dyn std::any::Any> + Send + Sync>;

/// An opened adapter.
pub struct Gpu {
    adapter: Adapter,
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: Mutex<BTreeMap<PipelineKey, Pipeline>>,
    kernels: Mutex<BTreeMap<&'static str, Vec<(Parts, Pipeline)>>>,
    observer: Option<CompileObserver>,
}

impl fmt::Debug for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Gpu").field("adapter", &self.adapter).finish_non_exhaustive()
    }
}

impl Gpu {
    /// Opens the adapter with this name (or part of a name), or the best adapter.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::UnknownAdapter`], [`GpuError::AmbiguousAdapter`], [`GpuError::Open`].
    pub fn open(name: Option<&str>) -> Result<Self, GpuError> {
        let raw = pick(name)?;
        let adapter = describe(&raw);
        // Requests large buffers; all other limits stay at the minimum of WebGPU.
        let given = raw.limits();
        let required_limits = wgpu::Limits {
            max_buffer_size: given.max_buffer_size,
            max_storage_buffer_binding_size: given.max_storage_buffer_binding_size,
            ..wgpu::Limits::default()
        };
        let wanted = wgpu::DeviceDescriptor { label: Some("refsim"), required_limits, ..Default::default() };
        let (device, queue) = pollster::block_on(raw.request_device(&wanted))
            .map_err(|e| GpuError::Open { adapter: adapter.name.clone(), reason: e.to_string() })?;
        let (pipelines, kernels) = (Mutex::default(), Mutex::default());
        Ok(Self { adapter, device, queue, pipelines, kernels, observer: None })
    }

    /// Description of the adapter.
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// Sets an observer of pipeline compilations.
    #[must_use]
    pub fn observed(mut self, observer: CompileObserver) -> Self {
        self.observer = Some(observer);
        self
    }

    /// Maximum size of a buffer that a shader can use, in words.
    pub fn most_words(&self) -> usize {
        usize::try_from(self.adapter.largest_buffer / 4).unwrap_or(usize::MAX)
    }

    /// Runs `work`; returns the driver's error message if it fails.
    fn guarded<T>(&self, filter: wgpu::ErrorFilter, work: impl FnOnce() -> T) -> Result<T, String> {
        let scope = self.device.push_error_scope(filter);
        let done = work();
        match pollster::block_on(scope.pop()) {
            None => Ok(done),
            Some(error) => Err(error.to_string()),
        }
    }

    fn failed(&self, reason: impl ToString) -> GpuError {
        GpuError::Device { adapter: self.adapter.name.clone(), reason: reason.to_string() }
    }

    /// Returns the pipeline of a WGSL text, compiled on first use.
    ///
    /// # Errors
    /// [`GpuError::Shader`] if the text, or its use of the bindings, is invalid.
    pub fn pipeline(&self, text: &str, entry: &str, bindings: &[Access]) -> Result<Pipeline, GpuError> {
        let key = (text.to_owned(), entry.to_owned(), bindings.to_vec());
        // Holds the lock while compiling, so that a pipeline is compiled only once.
        let mut known = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pipeline) = known.get(&key) {
            return Ok(pipeline.clone());
        }
        let refused = |reason| GpuError::Shader { entry: entry.to_owned(), reason };
        let made = self.guarded(wgpu::ErrorFilter::Validation, || self.make_pipeline(text, entry, bindings));
        let pipeline = made.map_err(refused)?;
        known.insert(key, pipeline.clone());
        Ok(pipeline)
    }

    /// Returns a pipeline of a kernel with at least these parts, if possible one that is already compiled.
    ///
    /// # Errors
    /// As [`Self::pipeline`].
    pub fn kernel(&self, kernel: &Kernel, parts: &Parts) -> Result<Pipeline, GpuError> {
        let mut known = self.kernels.lock().unwrap_or_else(PoisonError::into_inner);
        let made = known.entry(kernel.entry).or_default();
        let fitting = made.iter().filter(|(there, _)| there.covers(parts)).min_by_key(|(there, _)| there.count());
        if let Some((_, pipeline)) = fitting {
            return Ok(pipeline.clone());
        }
        let mut parts = if made.len() < MAX_GROWING { parts.clone() } else { parts.grown() };
        if made.len() >= MAX_EXACT {
            made.iter().for_each(|(there, _)| parts.extend(there));
        }
        let told = self.observer.as_ref().map(|observer| observer());
        let text = parts.of(&(kernel.text)(), kernel.entry);
        let pipeline = self.pipeline(&text, kernel.entry, kernel.bindings)?;
        drop(told);
        made.push((parts, pipeline.clone()));
        Ok(pipeline)
    }

    fn make_pipeline(&self, text: &str, entry: &str, bindings: &[Access]) -> Pipeline {
        let source = wgpu::ShaderSource::Wgsl(text.into());
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(entry), source });
        let entries: Vec<_> = (0..).zip(bindings).map(|(i, &access)| storage_entry(i, access)).collect();
        let layout = self
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(entry), entries: &entries });
        let whole = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(entry),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let inner = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: Some(&whole),
            module: &module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Pipeline { inner, layout, bindings: bindings.len() }
    }

    /// Creates a buffer of `words` zeros; at least one word.
    ///
    /// # Errors
    /// [`GpuError::Memory`] if the buffer exceeds the limit of the adapter or its memory.
    pub fn buffer(&self, words: usize) -> Result<Buffer, GpuError> {
        let words = words.max(1);
        let asked = 4 * words as u64;
        let too_large =
            || GpuError::Memory { adapter: self.adapter.name.clone(), asked, most: self.adapter.largest_buffer };
        if asked > self.adapter.largest_buffer {
            return Err(too_large());
        }
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let wanted = wgpu::BufferDescriptor { label: None, size: asked, usage, mapped_at_creation: false };
        let made = self.guarded(wgpu::ErrorFilter::OutOfMemory, || self.device.create_buffer(&wanted));
        Ok(Buffer { inner: made.map_err(|_| too_large())?, words })
    }

    /// Creates a buffer with the contents `words`.
    ///
    /// # Errors
    /// As [`Self::buffer`].
    pub fn buffer_of(&self, words: &[u32]) -> Result<Buffer, GpuError> {
        let buffer = self.buffer(words.len())?;
        self.upload(&buffer, 0, words)?;
        Ok(buffer)
    }

    /// Writes words into a buffer, starting at word `at`.
    ///
    /// # Errors
    /// [`GpuError::Device`] if the words exceed the buffer.
    pub fn upload(&self, buffer: &Buffer, at: usize, words: &[u32]) -> Result<(), GpuError> {
        if at + words.len() > buffer.words {
            let end = at + words.len();
            return Err(self.failed(format!("upload ends at word {end} of a buffer of {}", buffer.words)));
        }
        self.queue.write_buffer(&buffer.inner, 4 * at as u64, bytemuck::cast_slice(words));
        Ok(())
    }

    /// Copies the first words of one buffer to another, up to the smaller size.
    pub fn copy(&self, from: &Buffer, to: &Buffer) {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&from.inner, 0, &to.inner, 0, 4 * from.words.min(to.words) as u64);
        self.queue.submit([encoder.finish()]);
    }

    /// Dispatches `groups` workgroups with the buffers as bindings 0, 1, ...; later commands see the writes.
    ///
    /// # Errors
    /// [`GpuError::Device`] if the buffers don't match the pipeline or the device fails.
    pub fn dispatch(&self, pipeline: &Pipeline, buffers: &[&Buffer], groups: [u32; 3]) -> Result<(), GpuError> {
        if buffers.len() != pipeline.bindings {
            let (wanted, found) = (pipeline.bindings, buffers.len());
            return Err(self.failed(format!("the shader has {wanted} bindings, found {found} buffers")));
        }
        let work = || {
            let entries: Vec<_> = (0..)
                .zip(buffers)
                .map(|(binding, b)| wgpu::BindGroupEntry { binding, resource: b.inner.as_entire_binding() })
                .collect();
            let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.layout,
                entries: &entries,
            });
            let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_pipeline(&pipeline.inner);
                pass.set_bind_group(0, &group, &[]);
                pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
            }
            self.queue.submit([encoder.finish()]);
        };
        self.guarded(wgpu::ErrorFilter::Validation, work).map_err(|reason| self.failed(reason))
    }

    /// Waits for submitted work and reads a range of words.
    ///
    /// # Errors
    /// [`GpuError::Device`] if the range exceeds the buffer, or the device was lost.
    pub fn read(&self, buffer: &Buffer, range: Range<usize>) -> Result<Vec<u32>, GpuError> {
        if range.start > range.end || range.end > buffer.words {
            return Err(self.failed(format!("read of words {range:?} of a buffer of {}", buffer.words)));
        }
        if range.is_empty() {
            return Ok(Vec::new());
        }
        let size = 4 * range.len() as u64;
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&buffer.inner, 4 * range.start as u64, &staging, 0, size);
        self.queue.submit([encoder.finish()]);
        let (send, receive) = std::sync::mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            // Fails only if the receiver below was dropped.
            let _ = send.send(result);
        });
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| self.failed(e))?;
        receive.recv().map_err(|e| self.failed(e))?.map_err(|e| self.failed(e))?;
        let view = staging.get_mapped_range(..).map_err(|e| self.failed(e))?;
        Ok(bytemuck::pod_collect_to_vec(&view))
    }

    /// Runs a single dispatch: the inputs are bindings 0, 1, ... (read only), the result is the last binding (read and
    /// write), `out_words` words initialised to zero.
    ///
    /// # Errors
    /// As [`Self::pipeline`], [`Self::buffer`], [`Self::dispatch`] and [`Self::read`].
    pub fn compute(
        &self,
        text: &str,
        entry: &str,
        inputs: &[&[u32]],
        out_words: usize,
        groups: [u32; 3],
    ) -> Result<Vec<u32>, GpuError> {
        let mut access = vec![Access::Read; inputs.len()];
        access.push(Access::ReadWrite);
        let pipeline = self.pipeline(text, entry, &access)?;
        let mut buffers = Vec::with_capacity(access.len());
        for words in inputs {
            buffers.push(self.buffer_of(words)?);
        }
        buffers.push(self.buffer(out_words)?);
        let all: Vec<&Buffer> = buffers.iter().collect();
        self.dispatch(&pipeline, &all, groups)?;
        self.read(&buffers[inputs.len()], 0..out_words)
    }
}

fn storage_entry(binding: u32, access: Access) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: access == Access::Read },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}
