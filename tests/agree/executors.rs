//! The only list of executors that must agree; add new executors here.

use refsim::device::Profile;
use refsim::event::{SAMPLERS, SamplerTraffic, TexelObserver, TexelTouch};
use refsim::exec::batch::SimdLevel;
#[cfg(feature = "wgpu")]
use refsim::exec::gpu::testing;
use refsim::machine::{ExecutorKind, Machine, MachineError};
use std::sync::LazyLock;

#[derive(Clone, Debug)]
pub(crate) struct Executor {
    /// Its name in messages and counts.
    pub(crate) name: String,
    kind: ExecutorKind,
    threads: usize,
    simd: Option<SimdLevel>,
    /// True if a texel observer is attached, which forces draws in hardware order.
    watched: bool,
    /// Draws one case in this many: slow executors may skip cases.
    pub(crate) every: u64,
}

impl Executor {
    /// A new machine for this executor.
    pub(crate) fn machine(&self, profile: &Profile) -> Result<Machine, MachineError> {
        #[cfg(feature = "wgpu")]
        if self.kind == ExecutorKind::Wgpu
            && let Some(gpu) = testing::shared().map_err(MachineError::from)?
        {
            return Machine::with_gpu(profile.clone(), gpu);
        }
        let mut machine = Machine::with_threads(profile.clone(), self.kind, self.threads)?;
        machine.set_simd_level(self.simd);
        if self.watched {
            machine.observe_textures(Some(Box::new(Watcher(0))));
        }
        Ok(machine)
    }

    /// Returns `true` if the executor draws a case with this `turn` ([`crate::suite::Suite::turn`]); all executors draw
    /// a case with turn 0.
    pub(crate) fn draws(&self, turn: u64) -> bool {
        turn.is_multiple_of(self.every)
    }
}

/// Counts the texels reported to it.
#[derive(Debug)]
struct Watcher(u64);

impl TexelObserver for Watcher {
    fn begin(&mut self) {}

    fn touch(&mut self, texel: &TexelTouch) {
        assert!(texel.address.is_multiple_of(texel.bytes.into()), "{texel:?}");
        self.0 += 1;
    }

    fn end(&mut self) -> [SamplerTraffic; SAMPLERS] {
        [SamplerTraffic { accesses: self.0, ..SamplerTraffic::default() }; SAMPLERS]
    }
}

/// The reference, which is correct by definition.
pub(crate) static REFERENCE: LazyLock<Executor> = LazyLock::new(|| Executor {
    name: "scalar".to_owned(),
    kind: ExecutorKind::Scalar,
    threads: 1,
    simd: None,
    watched: false,
    every: 1,
});

/// All executors that are compared with the reference.
pub(crate) static EXECUTORS: LazyLock<Vec<Executor>> = LazyLock::new(|| {
    let mut all = Vec::new();
    for level in SimdLevel::available() {
        // By default the widest level draws every case. The other levels, which are the same source compiled for other
        // instructions, and more threads draw one case in three.
        let some = crate::environment::by_form(3, 1);
        let is_widest = level == SimdLevel::widest();
        for (threads, every) in [(1, if is_widest { 1 } else { some }), (3, some)] {
            if threads == 1 || is_widest || crate::environment::is_full() {
                let (name, kind) = (format!("batch/{}/{threads}", level.name()), ExecutorKind::Batch);
                all.push(Executor { name, kind, threads, simd: Some(level), every, ..REFERENCE.clone() });
            }
        }
    }
    all.push(Executor { name: "watched".to_owned(), watched: true, every: 4, ..REFERENCE.clone() });
    #[cfg(feature = "wgpu")]
    all.extend(on_gpu());
    all
});

/// The adapter, if there is one; without one, tests/gpu counts an ignored test for these suites.
#[cfg(feature = "wgpu")]
fn on_gpu() -> Option<Executor> {
    testing::shared().unwrap_or_else(|e| panic!("{e}"))?;
    Some(Executor { name: "wgpu".to_owned(), kind: ExecutorKind::Wgpu, every: every_gpu(), ..REFERENCE.clone() })
}

/// The GPU draws one case in this many: software drivers take milliseconds, the batch executor microseconds.
#[cfg(feature = "wgpu")]
fn every_gpu() -> u64 {
    crate::environment::by_form(8, 4)
}
