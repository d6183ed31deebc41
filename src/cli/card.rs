//! `--device`, `--switch`, `--executor`, `--adapter`: the card of a study, and who draws for it.

use refsim::device::{DeviceError, Profile};
use refsim::machine::Executor;

use super::executor::{DeviceExecutor, GpuArgs};
use super::switch;

/// The card of a study.
#[derive(Debug, clap::Args)]
pub(super) struct CardArgs {
    /// The card
    #[arg(long, value_name = "D", default_value = "nv35")]
    device: String,

    /// A switch of the device; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = switch::parse)]
    switch: Vec<(String, String)>,

    /// Which executor computes; the bits are the same
    #[arg(long, value_enum, default_value = "batch")]
    executor: DeviceExecutor,

    #[command(flatten)]
    gpu: GpuArgs,
}

impl CardArgs {
    /// The device with its switches set.
    pub(super) fn profile(&self) -> Result<Profile, DeviceError> {
        switch::device(&self.device, &self.switch)
    }

    /// The switches that were given.
    pub(super) fn switches(&self) -> Vec<(String, String)> {
        self.switch.clone()
    }

    /// The executor, ready to work.
    pub(super) fn executor(&self) -> miette::Result<Executor> {
        self.executor.open(&self.gpu)
    }
}
