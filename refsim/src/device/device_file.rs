//! Device files: devices with changed switches, and changed formats of registers, storages, sums and instructions.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde::Deserialize;

use super::accumulator::{ACCUMULATORS, accumulates};
use super::instruction_formats::{InstructionFormats, MAX_INSTRUCTION_FORMATS};
use super::switch::FORMAT_RULES;
use super::{DeviceError, Profile, Rules, Storage};
use crate::isa::Program;
use crate::num::Format;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DeviceFile {
    device: String,
    /// Format of pixel registers and pixel arithmetic, replacing the device's.
    format: Option<Format>,
    /// Format of the sums of dot products.
    accumulator: Option<Format>,
    /// Formats of storages.
    #[serde(default)]
    storage: StorageTable,
    #[serde(default)]
    switches: BTreeMap<String, String>,
    /// Formats of instructions, by the program's digest in hexadecimal, then by the instruction's index in decimal.
    #[serde(default)]
    programs: BTreeMap<String, BTreeMap<String, Format>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct StorageTable {
    temporaries: Option<Format>,
    constants: Option<Format>,
    texels: Option<Format>,
    colors: Option<Format>,
    coordinates: Option<Format>,
    outputs: Option<Format>,
}

impl StorageTable {
    fn of(&self, storage: Storage) -> Option<Format> {
        match storage {
            Storage::Temporaries => self.temporaries,
            Storage::Constants => self.constants,
            Storage::Texels => self.texels,
            Storage::Colors => self.colors,
            Storage::Coordinates => self.coordinates,
            Storage::Outputs => self.outputs,
        }
    }
}

impl Profile {
    /// Reads a device file, a TOML text:
    ///
    /// ```toml
    /// device = "ideal-fp32"     # any device
    /// format = "e8m20"          # registers and arithmetic, if not the device's
    /// accumulator = "e8m13"     # sums of dot products
    /// [switches]
    /// mad = "fused"
    /// [storage]
    /// temporaries = "e5m10"     # what is written to r#
    /// [programs.b1946ac92492d234]
    /// 3 = "s3.12"               # the fourth instruction of that program
    /// ```
    ///
    /// ```
    /// use refsim::{asm, device::Profile};
    ///
    /// let program = asm::assemble("ps_2_0\ndcl t0\nmul r0, t0, t0\nmov oC0, r0")?;
    /// let mut profile = Profile::named("ideal-fp32")?;
    /// assert!(profile.set_instruction_format(&program, 0, Some("e5m2".parse()?)));
    /// let text = profile.to_device_file(&[&program]);
    /// assert_eq!(Profile::from_device_file(&text)?, profile);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`DeviceError::File`] with the reason, and the errors of [`Profile::named`] and [`Profile::set_switch`].
    pub fn from_device_file(text: &str) -> Result<Self, DeviceError> {
        let problem = |problem: String| DeviceError::File { problem };
        let file: DeviceFile = toml::from_str(text).map_err(|error| problem(error.to_string()))?;
        let mut profile = Self::named(&file.device)?;
        let registers = |format: Format| format.for_registers().map_err(|error| problem(error.to_string()));
        if let Some(format) = file.format {
            profile.set_format(format).map_err(|error| problem(error.to_string()))?;
        }
        for (name, value) in &file.switches {
            profile.set_switch(name, value)?;
        }
        for storage in Storage::ALL {
            profile.set_storage_format(storage, file.storage.of(storage))?;
        }
        profile.set_accumulator(file.accumulator)?;
        for (digest, formats) in file.programs {
            let expected = "expected the 16 hexadecimal digits of a program's digest";
            let number = Some(&digest).filter(|d| d.len() == 16).and_then(|d| u64::from_str_radix(d, 16).ok());
            let number = number.ok_or_else(|| problem(format!("programs.{}: {expected}", cut(&digest))))?;
            let index = |text: String| match text.parse::<usize>() {
                Ok(index) => Ok(index),
                Err(_) => Err(problem(format!("programs.{digest}.{}: expected an instruction's index", cut(&text)))),
            };
            let formats = formats.into_iter().map(|(text, format)| Ok((index(text)?, registers(format)?)));
            let formats = formats.collect::<Result<BTreeMap<_, _>, DeviceError>>()?;
            if !profile.instruction_formats.insert(number, formats) {
                let most = MAX_INSTRUCTION_FORMATS;
                return Err(problem(format!("programs.{digest}: expected at most {most} different formats")));
            }
        }
        Ok(profile)
    }

    /// Writes the device as a text that [`Profile::from_device_file`] reads: its name, register format, the switches
    /// that differ from their defaults, and the formats of instructions. A comment after each format shows the
    /// instruction, if its program is among `programs`.
    pub fn to_device_file(&self, programs: &[&Program]) -> String {
        let mut text = format!("device = \"{}\"\n", self.name);
        let mut switched: Vec<_> =
            self.switches().iter().filter(|s| s.current != s.default || self.stated.0.contains(&s.name)).collect();
        let mut same = Self::named(&self.name).ok();
        for switch in &switched {
            same = same.and_then(|mut p| p.set_switch(&switch.name, &switch.current).ok().map(|()| p));
        }
        // If the switches alone do not reproduce the registers' rules, the file also states the register format.
        let of_file = (self.rules.storage, self.rules.accumulator);
        if same.is_none_or(|same| Rules { storage: of_file.0, accumulator: of_file.1, ..same.rules } != self.rules) {
            let _ = writeln!(text, "format = \"{}\"", self.rules.format);
            let of_format = |name: &str| name == "format" || FORMAT_RULES.contains(&name);
            switched.retain(|switch| self.stated.0.contains(&switch.name) || !of_format(&switch.name));
        }
        if let Some(format) = self.rules.accumulator {
            let _ = writeln!(text, "accumulator = \"{format}\"");
        }
        if !switched.is_empty() {
            text.push_str("\n[switches]\n");
        }
        for switch in switched {
            let _ = writeln!(text, "{} = \"{}\"", switch.name, switch.current);
        }
        if self.rules.storage.iter().next().is_some() {
            text.push_str("\n[storage]\n");
        }
        for (storage, format) in self.rules.storage.iter() {
            let _ = writeln!(text, "{} = \"{format}\"", storage.name());
        }
        for (digest, formats) in self.instruction_formats.iter() {
            let program = programs.iter().find(|program| program.digest() == digest);
            let _ = writeln!(text, "\n[programs.{digest:016x}]");
            for (index, format) in formats {
                let _ = write!(text, "{index} = \"{format}\"");
                let line = program.and_then(|program| program.instruction_text(*index));
                let _ = writeln!(text, "{}", line.map(|line| format!("  # {line}")).unwrap_or_default());
            }
        }
        text
    }

    /// Sets or removes the number format of a storage of pixel programs.
    ///
    /// # Errors
    /// [`DeviceError::StorageFormat`] if registers cannot have the format ([`Format::for_registers`]) or cannot
    /// represent all its numbers ([`Format::holds`]); the profile is unchanged.
    pub fn set_storage_format(&mut self, storage: Storage, format: Option<Format>) -> Result<(), DeviceError> {
        if let Some(found) = format {
            // Coordinates are single precision.
            let (registers, expected) = match storage {
                Storage::Coordinates => (Format::FP32, "a format whose numbers single precision holds"),
                _ => (self.rules.format, "a format whose numbers the registers hold"),
            };
            self.fits(found.for_registers().is_ok() && registers.holds(found), storage.name(), expected, found)?;
        }
        self.rules.storage.set(storage, format);
        Ok(())
    }

    /// Sets or removes the accumulator of dot products in pixel programs (docs/devices.md, "Device files").
    ///
    /// # Errors
    /// [`DeviceError::StorageFormat`] if registers cannot have the format, or executors cannot round products of the
    /// registers' numbers into it once; the profile is unchanged.
    pub fn set_accumulator(&mut self, format: Option<Format>) -> Result<(), DeviceError> {
        if let Some(found) = format {
            let is_fit = found.for_registers().is_ok() && accumulates(found, self.rules.format);
            self.fits(is_fit, "accumulator", ACCUMULATORS, found)?;
        }
        self.rules.accumulator = format;
        Ok(())
    }

    fn fits(&self, is_fit: bool, what: &'static str, expected: &'static str, found: Format) -> Result<(), DeviceError> {
        let (device, registers) = (self.name.clone(), self.rules.format);
        is_fit.then_some(()).ok_or(DeviceError::StorageFormat { device, registers, what, expected, found })
    }

    /// Formats of single instructions.
    pub fn instruction_formats(&self) -> &InstructionFormats {
        &self.instruction_formats
    }

    /// Sets or removes the number format of instruction `index` of a program
    /// ([`Instruction::format`](crate::isa::Instruction::format)). Returns `false`, without effect, if there is no such
    /// instruction, if it cannot have a format ([`super::takes_format`]), if registers cannot have this format
    /// ([`Format::for_registers`]), or if the program would have more than [`MAX_INSTRUCTION_FORMATS`] formats.
    pub fn set_instruction_format(&mut self, program: &Program, index: usize, format: Option<Format>) -> bool {
        self.instruction_formats.set(program, index, format)
    }

    /// Replaces the formats of all instructions of a program; unlisted instructions get no format. Returns
    /// `false`, without effect, if [`Self::set_instruction_format`] would for any listed instruction.
    pub fn set_instruction_formats(&mut self, program: &Program, formats: BTreeMap<usize, Format>) -> bool {
        self.instruction_formats.set_all(program, formats)
    }
}

/// Shortens a text from outside for a message.
fn cut(text: &str) -> String {
    text.chars().take(40).collect()
}
