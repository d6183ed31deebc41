//! A fragment program that draws, as a device takes it.

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;

use crate::radiosity::draw::DrawError;
use crate::radiosity::kernels::KernelText;

/// A program, judged by the device's own rules.
pub(in crate::radiosity) fn checked(profile: &Profile, kernel: KernelText) -> Result<CheckedProgram, DrawError> {
    let refused = |problem: String| DrawError::Refused { kernel: kernel.name, device: profile.name.clone(), problem };
    let program = assemble(kernel.text).map_err(|e| refused(e.to_string()))?;
    check(program, profile).map_err(|e| refused(e.to_string()))
}
