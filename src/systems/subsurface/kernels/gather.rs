//! Pass 2 (4.2.3): the programs that follow the links, generated for a number of links.
//!
//! Sampler 0 is the radiosity map. TEX0 is the texel; `p[0]` is the factor of the final sum. The sum starts at 0, or at
//! the previous pass's result (sampler 1), and adds one product per link.
//!
//! - *Fixed*: `p[1 + n]` is the place of link n in its level. The factors of four links are in one texel. With three
//!   channels they are in three texels: the first three links' factors in xyz of one texel each, the fourth link's
//!   factors in the three w.
//! - *Adaptive*: a texel of link n has u, v, the factor, and the level in w; with three channels, z is unused and a
//!   second texel has the factors. For a map with levels, w is 2^level / side, which is both components of a derivative
//!   for `TXD`: the level of detail is then level + 1/2, and the sampler's bias subtracts 1/2. For a rectangle with all
//!   levels side by side, w is side / 2^level, and `p[1]` is (-2, 2 side, 0, 0): a level begins at 2 side - 2 w.
//!
//! Textures of links may be tiles of fewer, larger textures, row by row. Each tile but the first of a texture has a
//! constant with its corner, which is added to the texel's position.

use std::fmt::Write as _;

use refsim::device::Profile;
use refsim::exec::CheckedProgram;

use crate::card::{KernelError, checked, instructions};

/// The kind of links, as far as it affects the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LinkLayout {
    /// All links of a texel lead to the same level; constants contain their places.
    Fixed,
    /// Each link has its own place and level.
    Adaptive,
}

/// Kind of texture of the radiosity map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapTexture {
    /// A texture with levels.
    Leveled,
    /// A rectangle: one level, or all levels side by side.
    Rectangle,
}

impl MapTexture {
    fn target(self) -> &'static str {
        match self {
            Self::Leveled => "2D",
            Self::Rectangle => "RECT",
        }
    }
}

/// A program of pass 2, for any number of links.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GatherKernel {
    /// The kind of links.
    pub layout: LinkLayout,
    /// True for factors of three channels.
    pub rgb: bool,
    /// Type of the radiosity map's texture.
    pub map: MapTexture,
    /// True if the program computes in half precision.
    pub half: bool,
    /// True if the program adds to the result of the previous pass.
    pub continues: bool,
    /// Tiles along an edge of a texture of links; 1 if each is a separate texture.
    pub tiles: usize,
}

impl GatherKernel {
    /// All programs for links that are in separate textures.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for layout in [LinkLayout::Fixed, LinkLayout::Adaptive] {
            for map in [MapTexture::Leveled, MapTexture::Rectangle] {
                for bits in 0..8_u8 {
                    let [rgb, half, continues] = [1, 2, 4].map(|bit| bits & bit != 0);
                    all.push(Self { layout, rgb, map, half, continues, tiles: 1 });
                }
            }
        }
        all
    }

    /// A name for messages.
    pub fn name(&self) -> String {
        let layout = if self.layout == LinkLayout::Fixed { "fixed" } else { "adaptive" };
        let map = if self.map == MapTexture::Leveled { "leveled" } else { "rectangle" };
        let part = |on: bool, word: &'static str| if on { word } else { "" };
        let [rgb, half] = [part(self.rgb, "_rgb"), part(self.half, "_half")];
        let tiles = if self.tiles > 1 { format!("_tiles_{}", self.tiles) } else { String::new() };
        format!("gather_{layout}_{map}{rgb}{half}{}{tiles}", part(self.continues, "_next"))
    }

    /// The program for this number of links.
    pub fn text(&self, links: usize) -> String {
        let first = self.constants_before_tiles(links);
        let mut writer = Writer { kernel: *self, text: "!!FP1.0\n".to_owned(), textures: 0, first };
        let _ = writeln!(writer.text, "# {}: {links} links", self.name());
        if self.continues {
            writer.read(SUM, "f[TEX0]", 1);
        }
        match self.layout {
            LinkLayout::Fixed => (0..links).step_by(4).for_each(|from| writer.fixed(from, links)),
            LinkLayout::Adaptive => (0..links).for_each(|_| writer.adaptive()),
        }
        let _ = writeln!(writer.text, "MULR o[COLR], {}, p[0];\nEND", writer.register(SUM));
        writer.text
    }

    /// Instructions for this number of links.
    pub fn instructions(&self, links: usize) -> usize {
        instructions(&self.text(links))
    }

    /// Number of separate or tiled textures for this number of links.
    pub const fn link_textures(&self, links: usize) -> usize {
        match (self.layout, self.rgb) {
            (LinkLayout::Fixed, false) => links.div_ceil(4),
            (LinkLayout::Fixed, true) => links / 4 * 3 + if links % 4 < 3 { links % 4 } else { 3 },
            (LinkLayout::Adaptive, rgb) => links * if rgb { 2 } else { 1 },
        }
    }

    /// Samplers for this number of links.
    pub const fn samplers(&self, links: usize) -> usize {
        1 + self.continues as usize + self.link_textures(links).div_ceil(self.tiles * self.tiles)
    }

    /// Constants for this number of links.
    pub fn constants(&self, links: usize) -> usize {
        let tiles = self.link_textures(links).min(self.tiles * self.tiles);
        self.constants_before_tiles(links) + tiles.saturating_sub(1)
    }

    const fn constants_before_tiles(&self, links: usize) -> usize {
        match (self.layout, self.map) {
            (LinkLayout::Fixed, _) => 1 + links,
            (LinkLayout::Adaptive, MapTexture::Leveled) => 1,
            (LinkLayout::Adaptive, MapTexture::Rectangle) => 2,
        }
    }

    /// The program for this number of links, checked for a device.
    pub fn checked(&self, profile: &Profile, links: usize) -> Result<CheckedProgram, KernelError> {
        checked(profile, format!("`{}`, written out for {links} links", self.name()), &self.text(links))
    }
}

/// Registers: the sum, a texel of the map, a place; from [`FACTORS`] on, texels of factors or links.
const SUM: usize = 1;
const TEXEL: usize = 2;
const FACTORS: usize = 3;
const PLACE: &str = "R0";
const COMPONENTS: [&str; 4] = ["x", "y", "z", "w"];

struct Writer {
    kernel: GatherKernel,
    text: String,
    /// Textures of links that have been read.
    textures: usize,
    /// The first constant of tiles.
    first: usize,
}

impl Writer {
    fn register(&self, number: usize) -> String {
        format!("{}{number}", if self.kernel.half { 'H' } else { 'R' })
    }

    /// Reads a texture with one texel per target texel.
    fn read(&mut self, into: usize, at: &str, unit: usize) {
        let _ = writeln!(self.text, "TEX {}, {at}, TEX{unit}, RECT;", self.register(into));
    }

    fn read_links(&mut self, into: usize) {
        let in_one = self.kernel.tiles * self.kernel.tiles;
        let unit = 1 + usize::from(self.kernel.continues) + self.textures / in_one;
        match self.textures % in_one {
            0 => self.read(into, "f[TEX0]", unit),
            tile => {
                let _ = writeln!(self.text, "ADDR {PLACE}, f[TEX0], p[{}];", self.first + tile - 1);
                self.read(into, PLACE, unit);
            }
        }
        self.textures += 1;
    }

    fn read_map(&mut self, at: &str) {
        let _ = writeln!(self.text, "TEX {}, {at}, TEX0, {};", self.register(TEXEL), self.kernel.map.target());
    }

    /// Adds the map's texel times a factor to the components of a mask.
    fn add(&mut self, mask: &str, factor: &str) {
        let [sum, texel] = [SUM, TEXEL].map(|number| self.register(number));
        let letter = if self.kernel.half { 'H' } else { 'R' };
        let _ = writeln!(self.text, "MAD{letter} {sum}.{mask}, {texel}, {factor}, {sum};");
    }

    /// Adds up to four links from `from` on.
    fn fixed(&mut self, from: usize, links: usize) {
        let count = (links - from).min(4);
        let textures = if self.kernel.rgb { count.min(3) } else { 1 };
        for texture in 0..textures {
            self.read_links(FACTORS + texture);
        }
        for (link, component) in COMPONENTS[..count].iter().enumerate() {
            self.read_map(&format!("p[{}]", 1 + from + link));
            match (self.kernel.rgb, link) {
                (false, _) => self.add("xyz", &format!("{}.{component}", self.register(FACTORS))),
                (true, 3) => {
                    for (texture, mask) in COMPONENTS[..3].iter().enumerate() {
                        self.add(mask, &format!("{}.w", self.register(FACTORS + texture)));
                    }
                }
                (true, _) => self.add("xyz", &self.register(FACTORS + link)),
            }
        }
    }

    fn adaptive(&mut self) {
        self.read_links(FACTORS);
        let link = self.register(FACTORS);
        if self.kernel.rgb {
            self.read_links(FACTORS + 1);
        }
        match self.kernel.map {
            MapTexture::Leveled => {
                let texel = self.register(TEXEL);
                let _ = writeln!(self.text, "TXD {texel}, {link}, {link}.w, {{0, 0, 0, 0}}, TEX0, 2D;");
            }
            MapTexture::Rectangle => {
                let _ = writeln!(self.text, "MADR {PLACE}, {link}.w, p[1].xzzz, p[1].yzzz;");
                let _ = writeln!(self.text, "MADR {PLACE}.xy, {link}, {link}.w, {PLACE};");
                self.read_map(PLACE);
            }
        }
        let factor = if self.kernel.rgb { self.register(FACTORS + 1) } else { format!("{link}.z") };
        self.add("xyz", &factor);
    }
}
