//! A profile, and its construction from TOML.

use std::collections::{BTreeMap, BTreeSet};

use super::DeviceError;
use super::cards::{CARDS, VARIANTS, card_named};
use super::figure::{FigureRow, Section};
use super::instruction_formats::InstructionFormats;
use super::limits::{Bus, Limits, Rates};
use super::profile_file::{LIMIT_SWITCHES, RawProfile};
use super::rule_values::ResultRange;
use super::rules::Rules;
use super::storage_formats::StorageFormats;
use super::switch::{FORMAT_RULES, Switch, apply, denormals_name, overflow_name, registers_name, sets_rule};
use crate::isa::{Opcode, Version};
use crate::num::{Format, FormatError};
use crate::texel::{DepthFormat, TexelFormat};

const IDEAL: &str = include_str!("profiles/ideal.toml");

/// Names of the rules that [`Profile::set_switch`] has set since the format was last replaced: rules of the format, and
/// rules that need floats. Ignored by equality.
#[derive(Clone, Debug, Default, Eq)]
pub(super) struct StatedRules(pub(super) BTreeSet<String>);

impl PartialEq for StatedRules {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A device: its arithmetic, limits and speeds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Profile {
    /// Name on the command line, `r200` for example.
    pub name: String,
    /// Full name of the card.
    pub title: String,
    /// Arithmetic, for the executors.
    pub rules: Rules,
    /// Limits, for [`crate::check`].
    pub limits: Limits,
    /// Speeds, for the timing model.
    pub rates: Rates,
    /// Connection to the host.
    pub bus: Bus,
    switches: Vec<Switch>,
    pub(super) stated: StatedRules,
    /// Switch values that are not offered while registers are in fixed point.
    withheld: Vec<(String, String)>,
    figures: Vec<FigureRow>,
    pub(super) instruction_formats: InstructionFormats,
}

impl Profile {
    /// Returns the profile of a card, or of `ideal-<format>` for any number format string. A card is named by its chip,
    /// or by words that identify its title, in any case: `Radeon 8500`, `geforce3`.
    ///
    /// ```
    /// use refsim::device::Profile;
    ///
    /// let radeon = Profile::named("r200").expect("a card of the project");
    /// assert_eq!(radeon.name, "r200");
    /// assert!(radeon.figures().iter().all(|figure| !figure.source.is_empty()));
    /// assert_eq!(Profile::named("Radeon 8500"), Ok(radeon));
    /// assert!(Profile::named("ideal-s3.12").is_ok());
    /// ```
    ///
    /// # Errors
    /// [`DeviceError::UnknownDevice`] with all names, or [`DeviceError::IdealFormat`] if no format follows `ideal-`.
    pub fn named(name: &str) -> Result<Self, DeviceError> {
        if let Some((card, text)) = card_named(name) {
            return Self::from_toml(card, text);
        }
        if let Some(format) = name.strip_prefix("ideal-") {
            let mut profile = Self::from_toml("ideal", IDEAL)?;
            profile.name = name.to_owned();
            let set = format.parse().and_then(|format| profile.set_format(format));
            set.map_err(|source| DeviceError::IdealFormat { name: name.to_owned(), source })?;
            return Ok(profile);
        }
        Err(DeviceError::UnknownDevice { name: name.chars().take(60).collect(), known: Self::all_names().join(" ") })
    }

    /// Names of the cards and their variants, by release date, then the placeholder `ideal-<format>`.
    pub fn all_names() -> Vec<&'static str> {
        Self::card_names().into_iter().chain(Self::variant_names()).chain(["ideal-<format>"]).collect()
    }

    /// Names of the cards that equal another card except for clocks: `fx5900` is an `nv35`.
    pub fn variant_names() -> Vec<&'static str> {
        VARIANTS.iter().map(|(name, _)| *name).collect()
    }

    /// Names of the cards, by release date, without [`Profile::variant_names`]: all have different rules or limits.
    pub fn card_names() -> Vec<&'static str> {
        CARDS.iter().map(|(name, _)| *name).collect()
    }

    /// All figures of the profile; switches have their current value.
    pub fn figures(&self) -> Vec<FigureRow> {
        let mut rows = self.figures.clone();
        for row in &mut rows {
            let Some(name) = row.key.strip_prefix("rules.") else { continue };
            if let Some(switch) = self.switches.iter().find(|s| s.name == name) {
                row.value.clone_from(&switch.current);
            } else if name == "format" {
                row.value = self.rules.format.to_string();
            } else if name == "result-range" {
                self.rules.result_range.name().clone_into(&mut row.value);
            }
        }
        rows
    }

    /// The switches of the device.
    pub fn switches(&self) -> &[Switch] {
        &self.switches
    }

    /// Sets a switch.
    ///
    /// Fails with [`DeviceError::UnknownSwitch`] or [`DeviceError::SwitchValue`], each with the allowed values; with
    /// [`DeviceError::FormatRule`] or [`DeviceError::NeedsFloats`] if the registers' format cannot have the rule. The
    /// profile is then unchanged.
    pub fn set_switch(&mut self, name: &str, value: &str) -> Result<(), DeviceError> {
        let Some(index) = self.switches.iter().position(|s| s.name == name) else {
            let allowed: Vec<&str> = self.switches.iter().map(|s| s.name.as_str()).collect();
            return Err(DeviceError::UnknownSwitch {
                device: self.name.clone(),
                name: name.chars().take(60).collect(),
                allowed: if allowed.is_empty() { "none".to_owned() } else { allowed.join(" ") },
            });
        };
        if self.withheld.iter().any(|(switch, of)| switch == name && of == value) {
            return Err(DeviceError::NeedsFloats {
                device: self.name.clone(),
                switch: name.to_owned(),
                value: value.to_owned(),
                format: self.rules.format,
            });
        }
        if !self.switches[index].values.iter().any(|v| v == value) {
            return Err(DeviceError::SwitchValue {
                device: self.name.clone(),
                switch: name.to_owned(),
                value: value.chars().take(60).collect(),
                allowed: self.switches[index].values.join(" "),
            });
        }
        if LIMIT_SWITCHES.contains(&name) {
            self.set_limit_switch(name, value);
        } else {
            // Applied to a copy, so that an invalid value changes nothing.
            let mut rules = self.rules.clone();
            apply(&mut rules, name, value).ok_or_else(|| DeviceError::FormatRule {
                device: self.name.clone(),
                switch: name.to_owned(),
                value: value.to_owned(),
                format: self.rules.format,
            })?;
            self.rules = rules;
        }
        value.clone_into(&mut self.switches[index].current);
        if name == "format" {
            self.refresh_format_switches();
        } else if FORMAT_RULES.contains(&name) || self.rules.needs_floats(name) {
            self.stated.0.insert(name.to_owned());
        }
        Ok(())
    }

    /// Replaces the format of pixel registers and pixel arithmetic with all its rules, for parameter sweeps. Also
    /// disables `_pp`, clamps results only to the format's range, and removes the formats of storages and sums, which
    /// were chosen for the previous registers.
    ///
    /// # Errors
    /// If registers cannot have the format ([`Format::for_registers`]); the profile is unchanged.
    pub fn set_format(&mut self, format: Format) -> Result<(), FormatError> {
        self.rules.format = format.for_registers()?;
        self.rules.result_range = ResultRange::Format;
        self.rules.partial = None;
        self.rules.storage = StorageFormats::default();
        self.rules.accumulator = None;
        self.refresh_format_switches();
        Ok(())
    }

    /// Replaces the format as `--format` and a case's `format` do: [`Self::set_format`], but settings of this device
    /// stay. These are the formats of storages and sums, and the switches of rounding, overflow and subnormal numbers
    /// unless the text has a suffix for the rule.
    ///
    /// ```
    /// use refsim::device::Profile;
    ///
    /// let mut down = Profile::from_device_file("device = \"r200\"\n[switches]\nrounding = \"rdn\"")?;
    /// down.replace_format("s3.8")?;
    /// assert_eq!(down.rules.format.to_string(), "s3.8:rdn");
    /// down.replace_format("s3.8:rne")?;
    /// assert_eq!(down.rules.format.to_string(), "s3.8");
    /// # Ok::<(), refsim::device::DeviceError>(())
    /// ```
    ///
    /// # Errors
    /// [`DeviceError::Format`] unless registers can have the format; [`DeviceError::FormatRule`] and
    /// [`DeviceError::StorageFormat`] if a setting does not fit it. The profile is unchanged.
    pub fn replace_format(&mut self, text: &str) -> Result<(), DeviceError> {
        let format: Format = text.parse()?;
        let mut new = self.clone();
        new.set_format(format)?;
        let has_suffix = |rule: &str| text.split(':').skip(1).any(|suffix| sets_rule(format, rule, suffix));
        for switch in self.switches.iter().filter(|switch| self.stated.0.contains(&switch.name)) {
            // The layout determines the unit of registers.
            if switch.name != "registers" && !has_suffix(&switch.name) {
                new.set_switch(&switch.name, &switch.current)?;
            }
        }
        for (storage, format) in self.rules.storage.iter() {
            new.set_storage_format(storage, Some(format))?;
        }
        new.set_accumulator(self.rules.accumulator)?;
        *self = new;
        Ok(())
    }

    /// Updates the switches that depend on the format: their current values, and the values that they offer.
    fn refresh_format_switches(&mut self) {
        self.stated.0.clear();
        self.offer_values();
        let format = self.rules.format;
        for switch in &mut self.switches {
            let current = match switch.name.as_str() {
                "registers" => registers_name(format).to_owned(),
                "rounding" => format.rounding.name().to_owned(),
                "overflow" => overflow_name(format.overflow).to_owned(),
                "denormals" => denormals_name(format.denormals).to_owned(),
                "format" => format.to_string(),
                _ => continue,
            };
            switch.current = current;
        }
    }

    /// If registers are in fixed point, removes switch values that need floats, except defaults, which then act as
    /// plain rounding; restores them for floats. A switch with a removed value is reset to its default.
    fn offer_values(&mut self) {
        let mut rules = self.rules.clone();
        for switch in &mut self.switches {
            let given = self.withheld.extract_if(.., |(name, _)| *name == switch.name).map(|(_, value)| value);
            switch.values.extend(given);
            if !self.rules.format.is_fixed() || FORMAT_RULES.contains(&switch.name.as_str()) {
                continue;
            }
            let mut needs_floats =
                |value: &String| apply(&mut rules, &switch.name, value).is_some() && rules.needs_floats(&switch.name);
            let taken: Vec<String> = switch
                .values
                .iter()
                .filter(|value| **value != switch.default && needs_floats(value))
                .cloned()
                .collect();
            if taken.contains(&switch.current) && apply(&mut self.rules, &switch.name, &switch.default).is_some() {
                switch.current.clone_from(&switch.default);
            }
            switch.values.retain(|value| !taken.contains(value));
            self.withheld.extend(taken.into_iter().map(|value| (switch.name.clone(), value)));
        }
    }

    fn set_limit_switch(&mut self, name: &str, value: &str) {
        if name == "instruction-slots" {
            self.limits.instructions = value.parse().ok();
            return;
        }
        // R200 has one format of two 16-bit channels; it is open whether its codes are signed. `wide` adds a
        // four-channel format that the card lacks.
        let formats = &mut self.limits.texture_formats;
        let wide = [TexelFormat::Rg16, TexelFormat::Rg16Snorm, TexelFormat::Rgba16, TexelFormat::Rgba16Snorm];
        formats.retain(|format| !wide.contains(format));
        formats.extend(match value {
            "unsigned" => &wide[..1],
            "signed" => &wide[1..2],
            _ => &wide,
        });
    }

    /// The profile that a card's file describes.
    ///
    /// # Errors
    /// [`DeviceError::Profile`] with the reason.
    #[doc(hidden)] // Public for tests of invalid files.
    pub fn from_toml(device: &str, text: &str) -> Result<Self, DeviceError> {
        let problem = |problem: String| DeviceError::Profile { device: device.to_owned(), problem };
        let raw = RawProfile::read(text).map_err(problem)?;
        let figures = raw.rows().map_err(problem)?;
        let switches = raw.switches();
        let rules = raw.rules().map_err(problem)?;
        let section = |name, figures| Section { device, name, figures };

        let mut part = section("limits", raw.limits);
        let mut limits = Limits::read(&mut part)?;
        limits.float_filtering = part.flag("float_filtering")?;
        limits.float_mipmaps = part.flag("float_mipmaps")?;
        limits.float_blending = part.flag("float_blending")?;
        limits.version_limits = device != "ideal";
        part.finish()?;

        let mut part = section("formats", raw.formats);
        limits.texture_formats = part.named("texture", TexelFormat::ALL, TexelFormat::name)?;
        limits.target_formats = part.named("target", TexelFormat::ALL, TexelFormat::name)?;
        limits.depth_formats = part.named("depth", DepthFormat::ALL, DepthFormat::name)?;
        part.finish()?;

        let versions = raw.versions.ok_or_else(|| problem("versions are missing".to_owned()))?;
        let mut part = section("versions", BTreeMap::from([("value".to_owned(), versions)]));
        for token in part.names("value")? {
            match token.parse() {
                Ok(version) => limits.versions.push(version),
                Err(e) => return Err(problem(format!("versions: {e}"))),
            }
        }

        let mut part = section("rates", raw.rates);
        let mut rates = Rates::read(&mut part)?;
        part.finish()?;
        let mut part = section("clocks", raw.clocks);
        for mnemonic in part.figures.keys().cloned().collect::<Vec<_>>() {
            if !Opcode::ALL.iter().any(|opcode| opcode.info().mnemonic == mnemonic) {
                let known: Vec<&str> = Opcode::ALL.iter().map(|opcode| opcode.info().mnemonic).collect();
                return Err(
                    part.problem(&mnemonic, &format!("no such instruction; expected one of {}", known.join(" ")))
                );
            }
            let clocks = part.number(&mnemonic)?.unwrap_or(1);
            rates.instruction_clocks.insert(mnemonic, clocks);
        }

        let mut part = section("bus", raw.bus);
        let mut bus = Bus::read(&mut part)?;
        bus.kind = part.text("kind").unwrap_or_default();
        part.finish()?;

        let mut profile = Self {
            name: raw.name,
            title: raw.title,
            rules,
            limits,
            rates,
            bus,
            switches,
            stated: StatedRules::default(),
            withheld: Vec::new(),
            figures,
            instruction_formats: InstructionFormats::default(),
        };
        // Applies the defaults of all switches, because some change limits.
        for (name, value) in profile.switches.iter().map(|s| (s.name.clone(), s.current.clone())).collect::<Vec<_>>() {
            profile.set_switch(&name, &value)?;
        }
        profile.stated.0.clear();
        Ok(profile)
    }

    /// Returns `true` if the device runs programs of this version.
    pub fn supports(&self, version: Version) -> bool {
        self.limits.versions.contains(&version)
    }
}
