//! Colors of pages, charts and false-color pictures.

/// Red, green, blue in sRGB.
pub type Color = [u8; 3];

pub(super) struct Theme {
    pub(super) paper: Color,
    pub(super) ink: Color,
    pub(super) quiet: Color,
    pub(super) rule: Color,
    pub(super) soft: Color,
}

pub(super) const LIGHT: Theme = Theme {
    paper: [0xfc, 0xfc, 0xfa],
    ink: [0x1c, 0x1e, 0x21],
    quiet: [0x5c, 0x61, 0x68],
    rule: [0xcf, 0xd2, 0xd6],
    soft: [0xf0, 0xf1, 0xee],
};
pub(super) const DARK: Theme = Theme {
    paper: [0x16, 0x18, 0x1b],
    ink: [0xe4, 0xe5, 0xe7],
    quiet: [0x9a, 0xa0, 0xa8],
    rule: [0x3b, 0x3f, 0x45],
    soft: [0x20, 0x23, 0x29],
};

/// Colors of Okabe and Ito (2008), which readers with any of the three color vision deficiencies can distinguish.
pub mod okabe_ito {
    use super::Color;

    /// Sky blue.
    pub const SKY_BLUE: Color = [0x56, 0xb4, 0xe9];
    /// Yellow.
    pub const YELLOW: Color = [0xf0, 0xe4, 0x42];
    /// Vermilion.
    pub const VERMILION: Color = [0xd5, 0x5e, 0x00];
    /// Reddish purple.
    pub const REDDISH_PURPLE: Color = [0xcc, 0x79, 0xa7];
}
