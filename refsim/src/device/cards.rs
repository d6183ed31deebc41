//! The files of the cards, and the lookup of cards by name.

/// The cards, by release date.
pub(super) const CARDS: [(&str, &str); 8] = [
    ("nv20", include_str!("profiles/nv20.toml")),
    ("r200", include_str!("profiles/r200.toml")),
    ("nv25", include_str!("profiles/nv25.toml")),
    ("r300", include_str!("profiles/r300.toml")),
    ("nv30", include_str!("profiles/nv30.toml")),
    ("r350", include_str!("profiles/r350.toml")),
    ("nv35", include_str!("profiles/nv35.toml")),
    ("gt200", include_str!("profiles/gt200.toml")),
];
/// Cards that differ from another card only in clocks, by release date: their files override figures of their `base`.
pub(super) const VARIANTS: [(&str, &str); 2] =
    [("fx5800", include_str!("profiles/fx5800.toml")), ("fx5900", include_str!("profiles/fx5900.toml"))];

/// Finds a card by its name or by words of its title, and returns its name and file. A match of a whole title takes
/// precedence over a match of some of its words.
pub(super) fn card_named(name: &str) -> Option<(&'static str, &'static str)> {
    let plain = |text: &str| text.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase();
    let wanted = plain(name);
    let all = || CARDS.into_iter().chain(VARIANTS);
    if let Some(card) = all().find(|(card, _)| *card == wanted) {
        return Some(card);
    }
    // The words of a title, without the chip in parentheses: the maker, then the card.
    let title = |text: &'static str| text.lines().find_map(|line| line.strip_prefix("title = \"")?.split(" (").next());
    let words = |text| title(text).unwrap_or_default().split(' ').map(plain).collect::<Vec<_>>();
    let whole = all().find(|(_, text)| (0..2).any(|maker| words(text)[maker..].concat() == wanted));
    whole.or_else(|| {
        let has = |words: Vec<String>| {
            (0..words.len()).any(|start| (start..words.len()).any(|end| words[start..=end].concat() == wanted))
        };
        let mut found = all().filter(|(_, text)| has(words(text)));
        found.next().filter(|_| found.next().is_none())
    })
}
