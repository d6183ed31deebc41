//! Reduction of the shader text to the parts that a draw uses.
//!
//! Drivers inline every function and compile unreachable code, so compiling the complete machine takes minutes.
//! Therefore unused parts are first removed from the text. The text is valid WGSL before and after. Parts are arms of
//! switches (`case VM_DOT: {`) labelled with names of parts, blocks under `if (HAS_CUBES) {`, and functions that become
//! unreachable. Sections between `// begin HAS_UNITS` and `// end HAS_UNITS` are removed as a whole.

use super::number;
use super::program::operations;
use crate::num::{Encoding, Format, NumberOperation};
use std::collections::{BTreeMap, BTreeSet};

/// Features of draws other than operations. In the text, each feature guards blocks with an `if`.
const FEATURES: [&str; 24] = [
    // Numbers: fixed-point registers; normalized registers; floats without infinity; formats other than single
    // precision with default rules.
    "HAS_FIXED",
    "HAS_NORMALIZED",
    "HAS_FINITE",
    "HAS_FORMATS",
    // Square roots and their reciprocals; sums of products, rounded once.
    "HAS_ROOTS",
    "HAS_DOTS",
    // Programs: may exceed one dispatch.
    "HAS_SUSPENSION",
    // Textures: arithmetic before the read; cube maps; level selection; linear filtering; repeated or mirrored images;
    // fixed-point texels; float texels; filtered float texels; filtered bytes; filtered float texels or bytes.
    "HAS_TEXTURE_DETAIL",
    "HAS_CUBES",
    "HAS_LEVELS",
    "HAS_FILTERS",
    "HAS_PERIODS",
    "HAS_RATIO_TEXELS",
    "HAS_FLOAT_TEXELS",
    "HAS_FLOAT_FILTERS",
    "HAS_BYTE_FILTERS",
    "HAS_INTERPOLATION",
    "HAS_ALPHA_TEST",
    "HAS_DEPTH_TEST",
    "HAS_FLOAT_DEPTH",
    "HAS_FLOAT_TARGETS",
    "HAS_INTEGER_TARGETS",
    "HAS_FLOAT_BLENDING",
    "HAS_INTEGER_BLENDING",
];
/// Feature of draws that use the unit of a card. Its text is a section, which also defines the feature's constant.
const UNITS: &str = "HAS_UNITS";
/// Operations that are expensive to compile, in groups that are included together. All other operations are always
/// included, so that programs that differ only in these share a text.
const COSTLY: [&[NumberOperation]; 5] = [
    &[NumberOperation::Exp2, NumberOperation::Log2],
    &[NumberOperation::Sin, NumberOperation::Cos],
    &[NumberOperation::Floor, NumberOperation::Frc, NumberOperation::AddressFloor, NumberOperation::AddressNearest],
    &[
        NumberOperation::Steps,
        NumberOperation::Decode,
        NumberOperation::Encode,
        NumberOperation::JoinPattern,
        NumberOperation::JoinShort,
        NumberOperation::JoinByte,
        NumberOperation::JoinSignedByte,
        NumberOperation::SplitPattern,
        NumberOperation::SplitShort,
        NumberOperation::SplitByte,
        NumberOperation::SplitSignedByte,
    ],
    &[NumberOperation::SetLess, NumberOperation::SetLessEqual, NumberOperation::SetEqual, NumberOperation::SetNotEqual],
];
/// Arms for cube maps.
const CUBES: [&str; 12] = [
    "TEXTURE_STEP_MOVE",
    "TEXTURE_STEP_QUOTIENT",
    "TEXTURE_STEP_MINOR",
    "TEXTURE_STEP_MAJOR",
    "TEXTURE_STEP_TURN",
    "TEXTURE_STEP_SLOPE",
    "TEXTURE_STEP_SHRINK",
    "TEXTURE_STEP_HALVE",
    "TEXTURE_STEP_DIVIDE",
    "TEXTURE_STEP_SHIFT",
    "TEXTURE_STEP_FACE",
    "S_DIVIDE",
];

/// Set of parts, by name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Parts(BTreeSet<String>);

impl Default for Parts {
    /// The parts that every draw needs.
    fn default() -> Self {
        let costly: Vec<NumberOperation> = COSTLY.concat();
        let plain = number::operations().filter(|operation| !costly.contains(operation));
        Self(plain.map(NumberOperation::constant).chain(operations::plain()).collect())
    }
}

impl Parts {
    /// All parts.
    pub fn all() -> Self {
        let features = FEATURES.iter().chain(&CUBES).chain([&UNITS]).map(|&name| name.to_owned());
        let numbers = number::operations().map(NumberOperation::constant);
        Self(features.chain(numbers).chain(operations::all()).collect())
    }

    /// All parts, except those of units of cards unless they are in the set.
    pub fn grown(&self) -> Self {
        let mut all = Self::all();
        if !self.contains(UNITS) {
            let of_units = number::operations().filter(|operation| operation.is_of_units());
            let of_units: BTreeSet<String> = of_units.map(NumberOperation::constant).collect();
            all.0.retain(|name| name != UNITS && !of_units.contains(name));
        }
        all
    }

    /// Adds a part.
    pub fn add(&mut self, name: &str) {
        match name {
            "HAS_CUBES" => self.0.extend(CUBES.iter().map(|&arm| arm.to_owned())),
            "VM_DOT" => self.add("HAS_DOTS"),
            _ => {}
        }
        self.0.insert(name.to_owned());
    }

    /// Adds a part if `used`.
    pub fn add_if(&mut self, used: bool, name: &str) {
        if used {
            self.add(name);
        }
    }

    /// Adds the parts that numbers of a format need.
    pub fn add_format(&mut self, format: &Format) {
        self.add_if(format.is_fixed(), "HAS_FIXED");
        self.add_if(format.denominator() != 1, "HAS_NORMALIZED");
        self.add_if(format.encoding != Encoding::Ieee, "HAS_FINITE");
        self.add_if(format.unit.is_card(), UNITS);
    }

    /// Adds a number operation, with its group.
    pub fn add_operation(&mut self, operation: NumberOperation) {
        let group = COSTLY.into_iter().find(|group| group.contains(&operation)).unwrap_or_default();
        self.0.extend(group.iter().map(|operation| operation.constant()));
        self.add_if(matches!(operation, NumberOperation::Sqrt | NumberOperation::Rsq), "HAS_ROOTS");
    }

    /// Number of parts.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns `true` if the part is in the set.
    pub fn contains(&self, name: &str) -> bool {
        self.0.contains(name)
    }

    /// Adds all parts of another set.
    pub fn extend(&mut self, other: &Self) {
        self.0.extend(other.0.iter().cloned());
    }

    /// Returns `true` if all parts of another set are in this one.
    pub fn covers(&self, other: &Self) -> bool {
        other.0.is_subset(&self.0)
    }

    /// Reduces a complete text to these parts and to everything reachable from `entry`.
    pub fn of(&self, text: &str, entry: &str) -> String {
        let all = Self::all();
        constants() + &reachable(&self.arms(text, &all), entry)
    }

    /// Removes arms and blocks of other parts.
    fn arms(&self, text: &str, all: &Self) -> String {
        let mut out = String::with_capacity(text.len());
        // Nesting depth of braces within removed text.
        let mut open = 0;
        // The enclosing section that is being removed, if any.
        let mut left_out: Option<&str> = None;
        for line in text.lines() {
            if let Some(name) = line.strip_prefix(BEGIN) {
                left_out = left_out.or((!self.contains(name)).then_some(name));
                continue;
            }
            if let Some(name) = line.strip_prefix(END) {
                left_out = left_out.filter(|&section| section != name);
                continue;
            }
            if left_out.is_some() {
                continue;
            }
            let code = line.split("//").next().unwrap_or_default();
            let braces = || code.matches('{').count().wrapping_sub(code.matches('}').count()).cast_signed();
            if open > 0 {
                open += braces();
                continue;
            }
            match self.heading(line, all) {
                Some(line) => {
                    out += &line;
                    out.push('\n');
                }
                None => open = braces(),
            }
        }
        out
    }

    /// Returns a line, reduced to the labels that are kept; `None` if it begins an arm or block to be removed.
    fn heading(&self, line: &str, all: &Self) -> Option<String> {
        let trimmed = line.trim_start();
        if let Some(feature) = trimmed.strip_prefix("if (").and_then(|rest| rest.strip_suffix(") {")) {
            let goes = all.0.contains(feature) && !self.0.contains(feature);
            return (!goes).then(|| line.to_owned());
        }
        // Only some devices' rules have such sums; the texts for other devices omit the constant.
        if trimmed.starts_with("const VM_SUM:") {
            return self.contains("VM_SUM").then(|| line.to_owned());
        }
        let Some((labels, rest)) = trimmed.strip_prefix("case ").and_then(|rest| rest.split_once(':')) else {
            return Some(line.to_owned());
        };
        let kept = |label: &&str| !all.0.contains(*label) || self.0.contains(*label);
        let labels: Vec<&str> = labels.split(", ").filter(kept).collect();
        (!labels.is_empty()).then(|| format!("case {}:{rest}", labels.join(", ")))
    }
}

const BEGIN: &str = "// begin ";
const END: &str = "// end ";

/// The feature constants, all `true`: blocks of unused features are removed from the text.
pub fn constants() -> String {
    FEATURES.iter().map(|name| format!("const {name}: bool = true;\n")).collect()
}

/// Removes functions that the entry point never calls. A function ends at a brace in the first column.
fn reachable(text: &str, entry: &str) -> String {
    let mut items: Vec<(Option<&str>, String)> = vec![(None, String::new())];
    for line in text.lines() {
        if let Some((name, _)) = line.strip_prefix("fn ").and_then(|rest| rest.split_once('(')) {
            // Attributes are on the line before.
            let mut item = String::new();
            if let Some((None, other)) = items.last_mut()
                && let Some(at) = other.find("@compute")
            {
                item = other.split_off(at);
            }
            items.push((Some(name), item));
        }
        if let Some((_, item)) = items.last_mut() {
            item.push_str(line);
            item.push('\n');
        }
        if line == "}" || (line.starts_with("fn ") && line.ends_with('}')) {
            items.push((None, String::new()));
        }
    }
    let bodies: BTreeMap<&str, &str> =
        items.iter().filter_map(|(name, text)| Some(((*name)?, text.as_str()))).collect();
    let mut called = BTreeSet::from([entry]);
    let mut waiting = vec![entry];
    while let Some(body) = waiting.pop().and_then(|name| bodies.get(name)) {
        let words = body.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        waiting.extend(words.filter(|&word| bodies.contains_key(word) && called.insert(word)));
    }
    items
        .iter()
        .filter(|(name, _)| name.is_none_or(|name| called.contains(name)))
        .map(|(_, text)| text.as_str())
        .collect()
}
