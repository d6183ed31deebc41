//! What a precision study compares: a device in a number format, with its switches.

use refsim::device::{DeviceError, Profile};
use refsim::num::Format;

/// Switches that only generated mip levels ask. Studies whose cards generate none leave them out.
const MIPMAP_SWITCHES: [&str; 1] = ["mipmap-rounding"];

/// A device as one row of a study sees it.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// The row's name, unique in a study and fit for a file name.
    pub label: String,
    /// The device with format and switches set.
    pub profile: Profile,
    /// The switch that was turned away from its default, with its value.
    pub switch: Option<(String, String)>,
}

impl Configuration {
    /// A device as its profile has it.
    ///
    /// # Errors
    /// If there is no such device.
    pub fn device(name: &str) -> Result<Self, DeviceError> {
        Ok(Self { label: file_name(name), ..Self::of(&Profile::named(name)?) })
    }

    /// A device without limits that computes in `format`.
    ///
    /// # Errors
    /// If there is no such format.
    pub fn format(format: &str) -> Result<Self, DeviceError> {
        let mut configuration = Self::device(&format!("ideal-{format}"))?;
        configuration.label = file_name(format);
        Ok(configuration)
    }

    /// A device made to compute in `format`.
    ///
    /// # Errors
    /// If there is no such device.
    pub fn device_in_format(name: &str, format: Format) -> Result<Self, DeviceError> {
        let mut configuration = Self::device(name)?;
        configuration.profile.set_format(format);
        configuration.label = file_name(&format!("{name}-{format}"));
        Ok(configuration)
    }

    /// A device, and then the same device with each of its open switches turned to each other value, one at a time;
    /// without those of generated mip levels.
    ///
    /// # Errors
    /// If there is no such device.
    pub fn device_under_each_switch(name: &str) -> Result<Vec<Self>, DeviceError> {
        Self::device(name)?.under_each_switch()
    }

    /// A profile as it is.
    pub fn of(profile: &Profile) -> Self {
        Self { label: file_name(&profile.name), profile: profile.clone(), switch: None }
    }

    /// This configuration, and then the same with each open switch of its device turned to each other value, one at a
    /// time; without those of generated mip levels.
    ///
    /// # Errors
    /// If a switch does not take one of its own values.
    pub fn under_each_switch(self) -> Result<Vec<Self>, DeviceError> {
        let mut all = vec![self.clone()];
        for switch in self.profile.switches().iter().filter(|s| !MIPMAP_SWITCHES.contains(&s.name.as_str())) {
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

/// `text` with everything but letters, digits, dots and dashes replaced.
fn file_name(text: &str) -> String {
    text.chars().map(|c| if c.is_ascii_alphanumeric() || matches!(c, '.' | '-') { c } else { '-' }).collect()
}
