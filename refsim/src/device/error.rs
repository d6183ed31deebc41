//! Errors of looking up devices, switches and their values.

use crate::num::{Format, FormatError};

/// Error for a device, switch or value that does not exist. Lists are separated by spaces.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum DeviceError {
    /// There is no profile with this name.
    #[error("unknown device `{name}`; expected one of {known}")]
    #[diagnostic(
        code(device::unknown),
        help(
            "words of a title also identify a card: `Radeon 8500`; any number format can follow `ideal-`, for example \
             `ideal-fp32` or `ideal-s3.12:rtz`"
        )
    )]
    UnknownDevice { name: String, known: String },
    /// The part of `ideal-<format>` after the dash is not a number format.
    #[error("device `{name}`: expected a number format after `ideal-`")]
    #[diagnostic(code(device::ideal_format))]
    IdealFormat { name: String, source: FormatError },
    /// The device has no switch with this name.
    #[error("device `{device}` has no switch `{name}`; expected one of {allowed}")]
    #[diagnostic(code(device::unknown_switch), help("`crossbar devices {device}` lists the switches"))]
    UnknownSwitch { device: String, name: String, allowed: String },
    /// The switch does not have this value.
    #[error("switch `{switch}` of device `{device}`: expected one of {allowed}, found `{value}`")]
    #[diagnostic(code(device::switch_value), help("`crossbar devices {device}` lists the switches"))]
    SwitchValue { device: String, switch: String, value: String, allowed: String },
    /// The switch sets a rule that the registers' format lacks.
    #[error("switch `{switch}` of device `{device}` is `{value}`, which its format `{format}` cannot have")]
    #[diagnostic(
        code(device::format_rule),
        help("remove the switch, or add the rule to the format, `:sat` for example")
    )]
    FormatRule { device: String, switch: String, value: String, format: Format },
    /// The switch sets a rule of exponents or significands, which fixed point lacks.
    #[error(
        "switch `{switch}` of device `{device}`: expected float registers for `{value}`, whose rule depends on \
         exponents or significands, found `{format}`"
    )]
    #[diagnostic(
        code(device::needs_floats),
        help("remove the switch: fixed-point sums are exact without alignment, and fixed-point products are not cut")
    )]
    NeedsFloats { device: String, switch: String, value: String, format: Format },
    /// The profile's file is malformed.
    #[error("profile `{device}`: {problem}")]
    #[diagnostic(code(device::profile), help("correct refsim/src/device/profiles/{device}.toml"))]
    Profile { device: String, problem: String },
    /// Registers cannot have a number format.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Format(#[from] FormatError),
    /// A device file is malformed.
    #[error("device file: {problem}")]
    #[diagnostic(
        code(device::file),
        help(
            "a device file has a `device`, and may have `format`, `accumulator`, `[switches]`, `[storage]` and \
             `[programs.DIGEST]`"
        )
    )]
    File { problem: String },
    /// A storage or the sums of dot products cannot have this format on the device.
    #[error("{what} of device `{device}`, whose registers are {registers}: expected {expected}, found {found}")]
    #[diagnostic(code(device::storage), help("`crossbar alu {found}` shows the numbers of a format"))]
    StorageFormat { device: String, registers: Format, what: &'static str, expected: &'static str, found: Format },
}
