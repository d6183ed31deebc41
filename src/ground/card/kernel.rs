//! Programs as text, checked for a device.

use std::fmt::Write as _;

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;

/// Comment lines before and after the repeated part of a kernel.
const MARKS: [&str; 2] = ["# a texel\n", "# end of a texel\n"];

/// A program's text with its name for messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelText {
    /// The file's name.
    pub name: &'static str,
    /// Text of the file.
    pub text: &'static str,
}

/// Error: a device cannot run a kernel.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("device `{device}` refuses {kernel}: {problem}")]
#[diagnostic(code(card::refused))]
pub struct KernelError {
    /// The kernel's file.
    pub kernel: String,
    /// The device.
    pub device: String,
    /// The first violated rule.
    pub problem: String,
}

/// Embeds the kernels of a folder as constants, and lists them.
#[macro_export]
macro_rules! kernels {
    ($(#[$doc:meta])* $list:ident: $($constant:ident $file:literal)*) => {
        $(
            #[doc = concat!("`", $file, "`; its head says what goes in and out.")]
            pub const $constant: $crate::card::KernelText =
                $crate::card::KernelText { name: $file, text: include_str!($file) };
        )*
        $(#[$doc])*
        pub const $list: &[$crate::card::KernelText] = &[$($constant),*];
    };
}
pub use crate::kernels;

impl KernelText {
    /// The program, checked for a device.
    pub fn checked(&self, profile: &Profile) -> Result<CheckedProgram, KernelError> {
        checked(profile, format!("`{}`", self.name), self.text)
    }

    /// The text with its repeated part written out `texels` times, and the checked program.
    pub fn unrolled_and_checked(
        &self,
        profile: &Profile,
        texels: usize,
    ) -> Result<(String, CheckedProgram), KernelError> {
        let text = self.unrolled(texels);
        let program = checked(profile, format!("`{}`, written out for {texels} texels", self.name), &text)?;
        Ok((text, program))
    }

    fn parts(&self) -> [&'static str; 3] {
        let [begin, end] = MARKS;
        let (head, rest) = self.text.split_once(begin).unwrap_or((self.text, ""));
        let (body, tail) = rest.split_once(end).unwrap_or((rest, ""));
        [head, body, tail]
    }

    /// The program's text for a block of `texels` texels, unrolled because the languages lack loops.
    pub fn unrolled(&self, texels: usize) -> String {
        let [head, body, tail] = self.parts();
        let mut text = String::with_capacity(head.len() + texels * body.len() + tail.len() + 40);
        // Notes before a program are `//` lines; the language's own comments may only follow its first word.
        text.push_str(head);
        let _ = writeln!(text, "# {texels} texels");
        text.extend(std::iter::repeat_n(body, texels));
        text.push_str(tail);
        text
    }

    /// Number of instructions outside the repeated part.
    pub fn overhead(&self) -> usize {
        let [head, _, tail] = self.parts();
        instructions(head) + instructions(tail)
    }

    /// Number of instructions per texel, in the repeated part.
    pub fn per_texel(&self) -> usize {
        instructions(self.parts()[1])
    }

    /// The largest number of texels per block within a limit of instructions.
    pub fn block(&self, max_instructions: usize) -> usize {
        max_instructions.saturating_sub(self.overhead()) / self.per_texel().max(1)
    }
}

/// Rejects a device that does not support all `versions`; `what` names the programs that need them.
pub fn require_versions(profile: &Profile, versions: &[Version], what: &str) -> Result<(), KernelError> {
    let runs = |profile: &Profile| versions.iter().all(|version| profile.limits.versions.contains(version));
    if runs(profile) {
        return Ok(());
    }
    let runs_it = |name: &&str| Profile::named(name).is_ok_and(|profile| runs(&profile));
    let have: Vec<&str> = Profile::card_names().into_iter().filter(runs_it).collect();
    let needed: Vec<String> = versions.iter().map(|version| format!("`{version}`")).collect();
    let problem = format!("it runs no {} programs; expected one of {}", needed.join(" and "), have.join(", "));
    Err(KernelError { kernel: what.to_owned(), device: profile.name.clone(), problem })
}

/// The version of vertex programs: vs_2_0 where the device has it, else vs_1_1.
pub fn vertex_version(profile: &Profile) -> Result<Version, KernelError> {
    let has_vs_2_0 = profile.limits.versions.contains(&Version::Vs2_0);
    let version = if has_vs_2_0 { Version::Vs2_0 } else { Version::Vs1_1 };
    require_versions(profile, &[version], "the vertex stage")?;
    Ok(version)
}

/// Numbers of texture slots and of arithmetic slots of a program.
pub fn slots(program: &CheckedProgram) -> [u32; 2] {
    let slots = &program.facts().slots;
    [slots.iter().map(|phase| phase.texture).sum(), slots.iter().map(|phase| phase.arithmetic).sum()]
}

/// Number of instructions in a text: lines that end in `;`.
pub fn instructions(text: &str) -> usize {
    text.lines().filter(|line| !line.starts_with("//") && line.trim_end().ends_with(';')).count()
}

/// Instructions of a vertex program that project the position by the matrix rows in c0 to c3.
pub const TO_CLIP: &str = "dp4 oPos.x, v0, c0\ndp4 oPos.y, v0, c1\ndp4 oPos.z, v0, c2\ndp4 oPos.w, v0, c3\n";

/// Instructions of a vertex program that compute the view vector in r0, the tangent in r1 and the bitangent in r2. The
/// eye is in c4; `tangent` and `normal` are attribute registers.
pub fn local_view(tangent: usize, normal: usize) -> String {
    format!(
        "; the view vector along tangent, bitangent and normal\nadd r0.xyz, c4, -v0\nmov r1.xyz, v{tangent}\n\
         mul r2.xyz, r1.zxyw, v{normal}.yzxw\nmad r2.xyz, -r1.yzxw, v{normal}.zxyw, r2\n"
    )
}

/// Instructions of a pixel program that compute in r0 the parabolic map coordinates of the vector `view`. c0 is
/// [`PARABOLIC`].
pub fn parabolic(view: &str) -> String {
    format!(
        "; x and y over |v| + z, from [-1, 1] to [0, 1]\ndp3 r0.w, {view}, {view}\nrsq r0.x, r0.w\n\
         mad r0.x, r0.w, r0.x, {view}.z\nmax r0.x, r0.x, c0.z\nrcp r0.x, r0.x\nmul r0.x, r0.x, c0.y\n\
         mad r0.xy, {view}, r0.x, c0.y\n"
    )
}

/// The constants of [`parabolic`]: 1, 1/2, and the least denominator.
pub const PARABOLIC: &str = "def c0, 1, 0.5, 0.00000095367431640625, 0\n";

/// A program whose text is generated from sizes.
pub trait WrittenKernel {
    /// The name used in messages.
    fn name(&self) -> String;

    /// The program's assembly text.
    fn text(&self) -> String;

    /// The program, checked for a device. Fails with [`KernelError`] if it breaks a rule of the device.
    fn checked(&self, profile: &Profile) -> Result<CheckedProgram, KernelError> {
        checked(profile, format!("`{}`", self.name()), &self.text())
    }

    /// Returns the program's name and its text.
    fn listed(&self) -> (String, String) {
        (self.name(), self.text())
    }
}

/// A program text, checked for a device. `kernel` is its name in messages.
pub fn checked(profile: &Profile, kernel: String, text: &str) -> Result<CheckedProgram, KernelError> {
    let refused = |problem| KernelError { kernel, device: profile.name.clone(), problem };
    let program = match assemble(text) {
        Ok(program) => program,
        Err(errors) => return Err(refused(errors.to_string())),
    };
    check(program, profile).map_err(|report| {
        refused(report.violations.first().map_or_else(|| report.to_string(), |first| first.message.clone()))
    })
}
