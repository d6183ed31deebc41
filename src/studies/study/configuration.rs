//! Configurations of a precision study: a device in a number format, with its switches.

use refsim::device::{DeviceError, Profile};

use crate::case::device_named;

/// Switch that only affects generated mip levels. Studies whose cards generate no mip levels omit it.
const MIPMAP_SWITCH: &str = "mipmap-rounding";

/// Device configuration of a study's row.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// Name of the row, unique in a study and valid as a file name.
    pub label: String,
    /// Device with format and switches set.
    pub profile: Profile,
    /// Switch that differs from its default, with its value.
    pub switch: Option<(String, String)>,
}

impl Configuration {
    /// Creates the configuration of a device. Fails if there is no such device.
    pub fn device(name: &str) -> Result<Self, DeviceError> {
        let configuration = Self::of(&device_named(name)?);
        // A card has one canonical name; device files are told apart by their file names.
        let is_file = name.ends_with(".toml");
        Ok(if is_file { Self { label: file_name(name), ..configuration } } else { configuration })
    }

    /// Creates the configuration of a device without limits that computes in `format`. Fails if there is no such
    /// format.
    pub fn format(format: &str) -> Result<Self, DeviceError> {
        let mut configuration = Self::device(&format!("ideal-{format}"))?;
        configuration.label = file_name(format);
        Ok(configuration)
    }

    /// Creates the configuration of a device with its format replaced by `format`. Settings of a device file stay
    /// ([`Profile::replace_format`]). Fails if there is no such device or format, or the file's settings do not fit the
    /// format.
    pub fn device_in_format(name: &str, format: &str) -> Result<Self, DeviceError> {
        let mut configuration = Self::device(name)?;
        configuration.profile.replace_format(format)?;
        configuration.label = file_name(&format!("{}-{}", configuration.label, configuration.profile.rules.format));
        Ok(configuration)
    }

    /// Creates the configurations of every device in every format: of the devices as they are if there are no formats,
    /// and of devices without limits if there are no devices. Fails as [`Self::device_in_format`] does.
    pub fn each(devices: &[String], formats: &[String]) -> Result<Vec<Self>, DeviceError> {
        match (devices, formats) {
            (_, []) => devices.iter().map(|device| Self::device(device)).collect(),
            ([], _) => formats.iter().map(|format| Self::format(format)).collect(),
            _ => {
                let pairs = devices.iter().flat_map(|device| formats.iter().map(move |format| (device, format)));
                pairs.map(|(device, format)| Self::device_in_format(device, format)).collect()
            }
        }
    }

    /// Returns the configuration of a device, then those of [`Self::under_each_switch`].
    pub fn device_under_each_switch(name: &str) -> Result<Vec<Self>, DeviceError> {
        Self::device(name)?.under_each_switch()
    }

    /// Creates the configuration of a profile.
    pub fn of(profile: &Profile) -> Self {
        Self { label: file_name(&profile.name), profile: profile.clone(), switch: None }
    }

    /// Returns this configuration, then one per other value of each open switch of its device, with one switch changed
    /// at a time; switches of generated mip levels are left out. Fails if a switch rejects one of its own values.
    pub fn under_each_switch(self) -> Result<Vec<Self>, DeviceError> {
        let mut all = vec![self.clone()];
        for switch in self.profile.switches().iter().filter(|s| s.name != MIPMAP_SWITCH) {
            for value in switch.values.iter().filter(|v| **v != switch.current) {
                let mut turned = self.clone();
                turned.profile.set_switch(&switch.name, value)?;
                turned.label = file_name(&format!("{}-{}-{value}", self.profile.name, switch.name));
                turned.switch = Some((switch.name.to_string(), value.to_string()));
                all.push(turned);
            }
        }
        Ok(all)
    }
}

/// Replaces everything but letters, digits, dots and dashes in `text`.
fn file_name(text: &str) -> String {
    text.chars().map(|c| if c.is_ascii_alphanumeric() || matches!(c, '.' | '-') { c } else { '-' }).collect()
}
