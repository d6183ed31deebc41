//! Context for binding the text of a case to the emulator's state.

use std::path::{Path, PathBuf};

use refsim::device::Profile;
use toml::Spanned;

use super::{CaseError, error::CaseText, value::Number};

/// Replacements for a case's device settings, to run one case in several ways.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Replaces `device`, or `shader_model` and `format`. Switches of the case that this device lacks are ignored.
    pub device: Option<Profile>,
    /// Replaces the format of the pixel registers ([`Profile::replace_format`]).
    pub format: Option<String>,
    /// Switches that are set after the case's.
    pub switches: Vec<(String, String)>,
    /// Maximum number of instructions of a program per pixel or vertex, in place of the case's and the device's.
    pub step_budget: Option<u32>,
    /// Values of uniforms of the pixel program, as IEEE singles, in place of the case's: one per component of the type.
    pub uniforms: Vec<(String, Vec<u32>)>,
}

impl Overrides {
    pub(super) fn apply(&self, profile: &mut Profile) -> Result<(), CaseError> {
        if let Some(format) = &self.format {
            profile.replace_format(format).map_err(CaseError::from)?;
        }
        for (name, value) in &self.switches {
            profile.set_switch(name, value).map_err(CaseError::from)?;
        }
        if let Some(steps) = self.step_budget {
            profile.limits.set_step_budget(steps);
        }
        Ok(())
    }
}

/// Context of binding: the text for error messages, and the folder of files.
pub(super) struct Binder<'a> {
    pub(super) place: CaseText,
    pub(super) name: &'a str,
    pub(super) folder: &'a Path,
    pub(super) overrides: &'a Overrides,
}

impl Binder<'_> {
    pub(super) fn path(&self, file: &Path) -> PathBuf {
        self.folder.join(file)
    }

    /// Converts exactly four numbers to IEEE singles.
    pub(super) fn four(&self, numbers: &[Number], span: std::ops::Range<usize>) -> Result<[u32; 4], CaseError> {
        <[Number; 4]>::try_from(numbers).map(|four| four.map(Number::single)).map_err(|_| {
            let message = format!("expected 4 numbers, found {}", numbers.len());
            self.place.wrong(span, message, "write all four: x, y, z, w, or red, green, blue, alpha")
        })
    }

    pub(super) fn optional_vector(
        &self,
        vector: Option<&Spanned<Vec<Number>>>,
        default: [u32; 4],
    ) -> Result<[u32; 4], CaseError> {
        vector.map_or(Ok(default), |vector| self.four(vector.get_ref(), vector.span()))
    }
}

/// Parses the number of a register such as `c17`, below `count`; rejects signs and leading zeros.
pub(super) fn register(name: &str, count: usize) -> Option<usize> {
    let digits = name.get(1..)?;
    let plain = digits.bytes().all(|byte| byte.is_ascii_digit()) && (digits == "0" || !digits.starts_with('0'));
    digits.parse().ok().filter(|number| plain && *number < count)
}
