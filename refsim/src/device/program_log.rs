//! List of the programs that are checked for a device.

use std::sync::{Arc, Mutex, PoisonError};

use crate::isa::Program;

/// The programs that were checked for a device or a copy of it, each once, with fog options expanded.
///
/// For studies of systems that choose and write their programs themselves. All logs compare equal, because they do not
/// belong to the card.
#[derive(Clone, Debug, Default)]
pub struct ProgramLog(Arc<Mutex<Vec<Program>>>);

impl PartialEq for ProgramLog {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
impl Eq for ProgramLog {}

impl ProgramLog {
    /// The programs so far, in the order in which they were checked first.
    pub fn programs(&self) -> Vec<Program> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Adds a program, if it is not there yet.
    pub(crate) fn add(&self, program: &Program) {
        let mut programs = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !programs.contains(program) {
            programs.push(program.clone());
        }
    }
}
