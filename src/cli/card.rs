//! `--device`, `--switch`, `--executor`: the card of a study, and its executor.

use refsim::device::{DeviceError, Profile};
use refsim::machine::Executor;

use super::executor::DeviceExecutor;
use super::{Problem, switch};

#[derive(Debug, clap::Args)]
pub(super) struct CardArgs {
    /// The card [default: the card of the paper]
    #[arg(long, value_name = "D")]
    device: Option<String>,

    /// A switch of the device; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = switch::parse)]
    switch: Vec<(String, String)>,

    /// Executor; all executors give the same bits [default: batch]
    #[arg(long, value_enum)]
    executor: Option<DeviceExecutor>,
}

impl CardArgs {
    /// The device with its switches set; `of_paper` if none was named.
    pub(super) fn profile(&self, of_paper: &str) -> Result<Profile, DeviceError> {
        switch::device(self.device.as_deref().unwrap_or(of_paper), &self.switch)
    }

    /// The options that choose the card, each with `true` if it was given.
    pub(super) fn given(&self) -> [(&'static str, bool); 2] {
        [("--device", self.device.is_some()), ("--switch", !self.switch.is_empty())]
    }

    pub(super) fn names_executor(&self) -> bool {
        self.executor.is_some()
    }

    pub(super) fn switches(&self) -> Vec<(String, String)> {
        self.switch.clone()
    }

    pub(super) fn executor(&self) -> Result<Executor, Problem> {
        self.executor.unwrap_or(DeviceExecutor::Batch).open()
    }
}
