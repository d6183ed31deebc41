//! What a precision study compares: a device in a number format, with its switches.

use refsim::device::{DeviceError, Profile};
use refsim::num::Format;

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
        Ok(Self { label: file_name(name), profile: Profile::named(name)?, switch: None })
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

    /// A device, and then the same device with each of its open switches turned to each other value, one at a time.
    ///
    /// # Errors
    /// If there is no such device.
    pub fn device_under_each_switch(name: &str) -> Result<Vec<Self>, DeviceError> {
        let default = Self::device(name)?;
        let mut all = vec![default.clone()];
        for switch in default.profile.switches() {
            for value in switch.values.iter().filter(|v| **v != switch.current) {
                let mut turned = default.clone();
                turned.profile.set_switch(&switch.name, value)?;
                turned.label = file_name(&format!("{name}-{}-{value}", switch.name));
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
