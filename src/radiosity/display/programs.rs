//! The fragment programs that draw, as period assembly, embedded.

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;

use crate::radiosity::draw::DrawError;

/// A program text with the name under which messages speak of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelText {
    /// The file's name.
    pub name: &'static str,
    /// Its contents.
    pub text: &'static str,
}

macro_rules! kernels {
    ($($constant:ident $file:literal)*) => {
        $(
            #[doc = concat!("`", $file, "`; its head says what goes in and out.")]
            pub const $constant: KernelText = KernelText { name: $file, text: include_str!(concat!("../kernels/", $file)) };
        )*
        /// Every program that draws.
        pub const ALL: &[KernelText] = &[$($constant),*];
    };
}

kernels! {
    FLAT "flat.fp"
    ID "id.fp"
    RESAMPLE "resample.fp"
    SMOOTH_QUAD "smooth_quad.fp"
    SMOOTH_TRIANGLE "smooth_triangle.fp"
}

/// A program, judged by the device's own rules.
pub(in crate::radiosity) fn checked(profile: &Profile, kernel: KernelText) -> Result<CheckedProgram, DrawError> {
    let refused = |problem: String| DrawError::Refused { kernel: kernel.name, device: profile.name.clone(), problem };
    let program = assemble(kernel.text).map_err(|e| refused(e.to_string()))?;
    check(program, profile).map_err(|e| refused(e.to_string()))
}
