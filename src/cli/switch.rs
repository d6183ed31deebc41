//! `NAME=VALUE` on the command line.

use refsim::device::{DeviceError, Profile};

use crate::case::device_named;

pub(super) fn device(name: &str, switches: &[(String, String)]) -> Result<Profile, DeviceError> {
    let mut profile = device_named(name)?;
    for (name, value) in switches {
        profile.set_switch(name, value)?;
    }
    Ok(profile)
}

/// Splits at the first `=`.
pub(super) fn parse(text: &str) -> Result<(String, String), String> {
    text.split_once('=')
        .filter(|(name, value)| !name.is_empty() && !value.is_empty())
        .map(|(name, value)| (name.to_owned(), value.to_owned()))
        .ok_or_else(|| format!("expected a switch such as `rounding=rtz`, found `{text}`"))
}
