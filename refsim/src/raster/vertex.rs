//! Vertices after the vertex stage, and the numbering of their components.

/// Number of interpolated components: 8 coordinate sets, 2 colours, fog.
pub const COMPONENTS: usize = 41;
/// First component of the texture coordinates: `t[i].c` is `TEXCOORD_COMPONENT + 4 * i + c`.
pub const TEXCOORD_COMPONENT: usize = 0;
/// First component of the colours: `v[i].c` is `COLOR_COMPONENT + 4 * i + c`.
pub const COLOR_COMPONENT: usize = 32;
/// Index of the fog factor.
pub const FOG_COMPONENT: usize = 40;

/// First component of the window position, after the vertex components: column and row of the pixel's centre, depth,
/// and 1 / w of clip space.
pub const POSITION_COMPONENT: usize = COMPONENTS;

/// A vertex after the vertex program. All numbers are FP32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vertex {
    /// Position in clip space.
    pub position: [u32; 4],
    /// Diffuse and specular colour.
    pub colors: [[u32; 4]; 2],
    /// Texture coordinate sets.
    pub texcoords: [[u32; 4]; 8],
    /// Fog factor.
    pub fog: u32,
    /// Point size; unused, because points are not supported.
    pub point_size: u32,
}

impl Default for Vertex {
    /// All components 0, except for the position's w, which is 1.
    fn default() -> Self {
        Self { position: [0, 0, 0, 0x3f80_0000], colors: [[0; 4]; 2], texcoords: [[0; 4]; 8], fog: 0, point_size: 0 }
    }
}

impl Vertex {
    /// Clamps the colours to [0, 1] by the order of their bit patterns, so +NaN gives 1 and -NaN gives 0.
    pub(crate) fn clamp_colors(&mut self) {
        self.colors.as_flattened_mut().iter_mut().for_each(|color| *color = clamped_color(*color));
    }

    /// The interpolated component with this index; 0 past the last component.
    pub fn component(&self, index: usize) -> u32 {
        match index {
            0..COLOR_COMPONENT => self.texcoords[index / 4][index % 4],
            COLOR_COMPONENT..FOG_COMPONENT => self.colors[(index - COLOR_COMPONENT) / 4][index % 4],
            FOG_COMPONENT => self.fog,
            _ => 0,
        }
    }

    pub(crate) fn components(&self) -> [u32; COMPONENTS] {
        std::array::from_fn(|i| self.component(i))
    }
}

/// [`Vertex::clamp_colors`] of one component.
pub(crate) fn clamped_color(bits: u32) -> u32 {
    if bits >> 31 == 1 { 0 } else { bits.min(0x3f80_0000) }
}

/// A set of interpolated components.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ComponentMask(pub u64);

impl ComponentMask {
    /// No component.
    pub const NONE: Self = Self(0);
    /// All vertex components.
    pub const ALL: Self = Self((1 << COMPONENTS) - 1);

    /// Adds a component.
    pub const fn with(self, component: usize) -> Self {
        Self(self.0 | (1 << component))
    }

    /// Adds all components of texture coordinate set `set`.
    pub const fn with_texcoord(self, set: usize) -> Self {
        Self(self.0 | (15 << (TEXCOORD_COMPONENT + 4 * set)))
    }

    /// Adds all components of colour `color`.
    pub const fn with_color(self, color: usize) -> Self {
        Self(self.0 | (15 << (COLOR_COMPONENT + 4 * color)))
    }

    /// Adds the window position.
    pub const fn with_position(self) -> Self {
        Self(self.0 | (15 << POSITION_COMPONENT))
    }

    /// Returns `true` if the component is in the set.
    pub const fn has(self, component: usize) -> bool {
        self.0 >> component & 1 == 1
    }
}
