//! What every step from the words of a case to the emulator's state needs.

use std::path::{Path, PathBuf};

use refsim::{device::Profile, num::Format};
use toml::Spanned;

use super::{CaseError, error::CaseText, value::Number};

/// What to put in place of what a case says about its device: to run one case on two cards, in two formats, or with two
/// answers to an open question.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Instead of `device`, or of `shader_model` and `format`. Switches of the case that this device does not have are
    /// left out.
    pub device: Option<Profile>,
    /// Instead of the format of the pixel registers.
    pub format: Option<Format>,
    /// Switches on top of those of the case, set last.
    pub switches: Vec<(String, String)>,
    /// Instructions that a program may execute per pixel or vertex, in place of what case and device say.
    pub step_budget: Option<u32>,
}

impl Overrides {
    /// Applies format and switches.
    pub(super) fn apply(&self, profile: &mut Profile) -> Result<(), CaseError> {
        if let Some(format) = self.format {
            profile.set_format(format);
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

/// What every step needs: where to report, where files are.
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

    /// Exactly four numbers, as IEEE singles.
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

/// The number of a register such as `c17`, below `count`; no sign, no leading zeros.
pub(super) fn register(name: &str, count: usize) -> Option<usize> {
    let digits = name.get(1..)?;
    let plain = digits.bytes().all(|byte| byte.is_ascii_digit()) && (digits == "0" || !digits.starts_with('0'));
    digits.parse().ok().filter(|number| plain && *number < count)
}
