//! Selection of a case's device: the one it names, or a replacement.

use refsim::{
    device::{DeviceError, Profile},
    isa::{Stage, Version},
    num::Format,
};
use toml::Spanned;

use std::path::Path;

use super::{CaseError, binder::Binder, schema::Case};
use crate::io::read_limited;
use crate::names::did_you_mean;

impl Binder<'_> {
    /// Returns the device, the required version of the pixel program, and the switches that were ignored.
    pub(super) fn profile(&self, case: &Case) -> Result<(Profile, Option<Version>, Vec<String>), CaseError> {
        let (mut profile, model) = match &self.overrides.device {
            Some(profile) => (profile.clone(), None),
            None => self.named_by(case)?,
        };
        let mut left_out = Vec::new();
        for (name, value) in &case.switches {
            if self.overrides.device.is_some() && !profile.switches().iter().any(|switch| switch.name == *name) {
                left_out.push(name.clone());
                continue;
            }
            profile.set_switch(name, value.get_ref()).map_err(|error| {
                let help = format!("{}`crossbar devices {}` lists the switches", meant(&error), profile.name);
                self.place.wrong(value.span(), error.to_string(), help)
            })?;
        }
        if let (Some(_), Some(format), None) = (&case.device, &case.format, &self.overrides.device) {
            self.format(format)?;
            profile.replace_format(format.get_ref()).map_err(CaseError::from)?;
        }
        if let Some(steps) = &case.step_budget {
            if *steps.get_ref() == 0 {
                let help = "a program needs one step for every instruction that it executes";
                return Err(self.place.wrong(steps.span(), "expected a step budget of 1 or more, found 0", help));
            }
            profile.limits.set_step_budget(*steps.get_ref());
        }
        self.overrides.apply(&mut profile)?;
        Ok((profile, model, left_out))
    }

    fn named_by(&self, case: &Case) -> Result<(Profile, Option<Version>), CaseError> {
        match (&case.device, &case.shader_model) {
            (Some(device), None) => Ok((self.named(device)?, None)),
            (None, Some(model)) => {
                let Some(format) = &case.format else {
                    let help = "add for example `format = \"s3.12\"`: the format of the pixel registers";
                    return Err(self.place.wrong(model.span(), "`shader_model` without `format`", help));
                };
                let version = model.get_ref().parse::<Version>().map_err(|error| {
                    self.place.wrong(
                        model.span(),
                        error.to_string(),
                        "give a pixel shader version, `ps_1_4` for example",
                    )
                })?;
                if version.stage() != Stage::Pixel {
                    let message = format!("expected a pixel shader version, found `{version}`");
                    return Err(self.place.wrong(model.span(), message, "`ps_1_4` for example"));
                }
                let name = format!("ideal-{}", self.format(format)?);
                Ok((self.named(&Spanned::new(format.span(), name))?, Some(version)))
            }
            (Some(_), Some(model)) => {
                let help = "keep `device`, or `shader_model` and `format`: a device has its own shader versions";
                Err(self.place.wrong(model.span(), "both `device` and `shader_model`", help))
            }
            (None, None) => {
                let help = "add `device = \"r200\"`, or `shader_model = \"ps_1_4\"` and `format = \"s3.12\"`";
                Err(self.place.wrong(0..0, "the case has no device", help))
            }
        }
    }

    fn named(&self, device: &Spanned<String>) -> Result<Profile, CaseError> {
        let name = device.get_ref();
        let found = if is_file(name) { read(&self.path(Path::new(name)), name) } else { Profile::named(name) };
        found.map_err(|error| {
            let help = format!("{}`crossbar devices` lists the devices", meant(&error));
            self.place.wrong(device.span(), error.to_string(), help)
        })
    }

    fn format(&self, format: &Spanned<String>) -> Result<Format, CaseError> {
        format.get_ref().parse().and_then(Format::for_registers).map_err(|error| {
            self.place.wrong(format.span(), error.to_string(), "for example `s3.12`, `fp24` or `e5m10:rtz`")
        })
    }
}

const MAX_BYTES: u64 = 1 << 20;

/// Returns a device of [`Profile::named`], or of a device file if the name ends in `.toml`; fails if there is no such
/// device.
pub fn device_named(name: &str) -> Result<Profile, DeviceError> {
    if is_file(name) { read(Path::new(name), name) } else { Profile::named(name) }
}

fn is_file(name: &str) -> bool {
    name.ends_with(".toml")
}

fn read(path: &Path, name: &str) -> Result<Profile, DeviceError> {
    let wrong = |problem: String| DeviceError::File { problem: format!("{name}: {problem}") };
    let bytes = read_limited(path, MAX_BYTES).map_err(|error| wrong(error.to_string()))?;
    let bytes = bytes.ok_or_else(|| wrong(format!("expected at most {MAX_BYTES} bytes, found more")))?;
    let text = String::from_utf8(bytes).map_err(|error| wrong(error.to_string()))?;
    Profile::from_device_file(&text).map_err(|error| match error {
        DeviceError::File { problem } => wrong(problem),
        other => other,
    })
}

/// Help text for a device error: suggests the nearest known name; often empty.
pub fn meant(error: &DeviceError) -> String {
    match error {
        DeviceError::UnknownDevice { name: found, known: names }
        | DeviceError::UnknownSwitch { name: found, allowed: names, .. }
        | DeviceError::SwitchValue { value: found, allowed: names, .. } => did_you_mean(found, names.split(' ')),
        _ => String::new(),
    }
}
