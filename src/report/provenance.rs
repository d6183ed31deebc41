//! Where a result comes from.

use serde::Serialize;

/// Everything that it takes to make a result again. No clock and no machine name: the same run writes the same bytes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// The version of the program.
    pub version: String,
    /// The command line that was obeyed, defaults filled in.
    pub command: String,
    /// The device profiles, in the order of use.
    pub profiles: Vec<String>,
    /// The switches that were set away from or explicitly to their default, as name and value.
    pub switches: Vec<(String, String)>,
    /// The seed of random choices, where any were made.
    pub seed: Option<u64>,
}

impl Provenance {
    /// A result of this version of the program.
    pub fn new(command: impl Into<String>) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: command.into(),
            profiles: Vec::new(),
            switches: Vec::new(),
            seed: None,
        }
    }

    /// The block as rows of name and value.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let switches: Vec<String> = self.switches.iter().map(|(name, value)| format!("{name}={value}")).collect();
        let or = |text: String, none: &str| if text.is_empty() { none.to_owned() } else { text };
        vec![
            ("version", self.version.clone()),
            ("command", self.command.clone()),
            ("profile", or(self.profiles.join(", "), "none")),
            ("switches", or(switches.join(", "), "all at their defaults")),
            ("seed", self.seed.map_or_else(|| "none: nothing is random".to_owned(), |s| s.to_string())),
        ]
    }
}
