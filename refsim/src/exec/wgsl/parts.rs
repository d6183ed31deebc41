//! Which parts of the machine a draw uses, and the text with those alone.
//!
//! Drivers put every function in line and compile what no branch reaches, so a machine for everything takes them
//! minutes. Here a text is cut down before a driver sees it. It stays WGSL as it stands: parts are arms of switches
//! (`case VM_DOT: {`) whose labels are names of parts, blocks under `if (HAS_CUBES) {`, and functions that nothing
//! calls any more.

use super::program::operations;
use crate::num::NumberOperation;
use std::collections::{BTreeMap, BTreeSet};

/// What draws may need beyond operations. In the text a block stands under an `if` of its own for each.
const FEATURES: [&str; 15] = [
    // Numbers: registers in fixed point; any format but single precision with the default rules.
    "HAS_FIXED",
    "HAS_FORMATS",
    // Programs: that may be longer than a dispatch; whose steps are counted.
    "HAS_SUSPENSION",
    "HAS_STEP_BUDGET",
    // Textures: arithmetic before texels are read; cubes; texels that are ratios or floats; floats that are blended.
    "HAS_TEXTURE_DETAIL",
    "HAS_CUBES",
    "HAS_RATIO_TEXELS",
    "HAS_FLOAT_TEXELS",
    "HAS_FLOAT_FILTERS",
    "HAS_ALPHA_TEST",
    "HAS_DEPTH_TEST",
    "HAS_FLOAT_TARGETS",
    "HAS_INTEGER_TARGETS",
    "HAS_FLOAT_BLENDING",
    "HAS_INTEGER_BLENDING",
];
/// Operations whose arms cost compilers much, in groups that come and go together; all others are always there, so that
/// programs which differ in them alone share a text.
const COSTLY: [&[NumberOperation]; 4] = [
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
];
/// Arms for cubes.
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

/// Parts of the machine, by their names in the text.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Parts(BTreeSet<String>);

impl Default for Parts {
    /// What every draw has.
    fn default() -> Self {
        let costly: Vec<NumberOperation> = COSTLY.concat();
        let plain = NumberOperation::ALL.into_iter().filter(|operation| !costly.contains(operation));
        Self(plain.map(NumberOperation::constant).chain(operations::plain()).collect())
    }
}

impl Parts {
    /// Everything there is.
    pub fn all() -> Self {
        let features = FEATURES.iter().chain(&CUBES).map(|&name| name.to_owned());
        let operations = NumberOperation::ALL.into_iter().map(NumberOperation::constant);
        Self(features.chain(operations).chain(operations::all()).collect())
    }

    /// With a part more.
    pub fn add(&mut self, name: &str) {
        if name == "HAS_CUBES" {
            self.0.extend(CUBES.iter().map(|&arm| arm.to_owned()));
        }
        self.0.insert(name.to_owned());
    }

    /// With a part more if `used`.
    pub fn add_if(&mut self, used: bool, name: &str) {
        if used {
            self.add(name);
        }
    }

    /// With an operation on numbers more.
    pub fn add_operation(&mut self, operation: NumberOperation) {
        let group = COSTLY.into_iter().find(|group| group.contains(&operation)).unwrap_or_default();
        self.0.extend(group.iter().map(|operation| operation.constant()));
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Whether a part is among these.
    pub fn contains(&self, name: &str) -> bool {
        self.0.contains(name)
    }

    /// With all parts of another more.
    pub fn extend(&mut self, other: &Self) {
        self.0.extend(other.0.iter().cloned());
    }

    /// Whether all parts of another are among these.
    pub fn covers(&self, other: &Self) -> bool {
        other.0.is_subset(&self.0)
    }

    /// What a whole text comes to with these parts, started at `entry`.
    pub fn of(&self, text: &str, entry: &str) -> String {
        let all = Self::all();
        constants() + &reachable(&self.arms(text, &all), entry)
    }

    /// The text without the arms and blocks of other parts.
    fn arms(&self, text: &str, all: &Self) -> String {
        let mut out = String::with_capacity(text.len());
        // Braces that are open within what is left out.
        let mut open = 0;
        for line in text.lines() {
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

    /// A line as it stays; `None` if it begins an arm or a block that goes.
    fn heading(&self, line: &str, all: &Self) -> Option<String> {
        let trimmed = line.trim_start();
        if let Some(feature) = trimmed.strip_prefix("if (").and_then(|rest| rest.strip_suffix(") {")) {
            let goes = all.0.contains(feature) && !self.0.contains(feature);
            return (!goes).then(|| line.to_owned());
        }
        let Some((labels, rest)) = trimmed.strip_prefix("case ").and_then(|rest| rest.split_once(':')) else {
            return Some(line.to_owned());
        };
        let kept = |label: &&str| !all.0.contains(*label) || self.0.contains(*label);
        let labels: Vec<&str> = labels.split(", ").filter(kept).collect();
        (!labels.is_empty()).then(|| format!("case {}:{rest}", labels.join(", ")))
    }
}

/// The constants that blocks stand under: a text with all parts is valid with them.
pub fn constants() -> String {
    FEATURES.iter().map(|name| format!("const {name}: bool = true;\n")).collect()
}

/// A text without the functions that its entry point never calls. Functions end at a brace in the first column.
fn reachable(text: &str, entry: &str) -> String {
    let mut items: Vec<(Option<&str>, String)> = vec![(None, String::new())];
    for line in text.lines() {
        if let Some((name, _)) = line.strip_prefix("fn ").and_then(|rest| rest.split_once('(')) {
            // Attributes stand on the line before.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_blocks_and_functions_go_with_their_parts() {
        let text = "const A: u32 = 1u;\nfn low() {\n}\nfn high() { low(); }\nfn cube() {\n    if (HAS_CUBES) {\n        high();\n    }\n}\n\
                    @compute @workgroup_size(1)\nfn main() {\n    switch op {\n        case N_ADD, N_SUB: { cube(); } // both\n        \
                    case N_MUL: { // one {\n            high();\n        }\n        default: {}\n    }\n}\n";
        let parts = Parts(BTreeSet::from(["N_SUB".to_owned()]));
        let found = parts.of(text, "main");
        assert!(
            found.ends_with(
                "const A: u32 = 1u;\nfn cube() {\n}\n@compute @workgroup_size(1)\nfn main() {\n    switch op {\n\
             case N_SUB: { cube(); } // both\n        default: {}\n    }\n}\n"
            ),
            "{found}"
        );
        assert!(Parts::all().covers(&parts) && !parts.covers(&Parts::all()));
        assert!(Parts::all().of(text, "main").contains("high();"));
    }
}
