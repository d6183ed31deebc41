//! Vertices in structure-of-arrays layout.

use crate::raster::{COLOR_COMPONENT, COMPONENTS, ComponentMask, FOG_COMPONENT, Vertex, clamped_color};

/// Vertices as rows of single-precision patterns: the position and the components requested.
#[derive(Clone, Debug, Default)]
pub struct VertexRows {
    pub(crate) position: [Vec<u32>; 4],
    /// Rows by component, as in [`ComponentMask`]; empty if not requested.
    pub(crate) components: Vec<Vec<u32>>,
    /// Instruction slots executed, in total over the vertices.
    pub executed: u64,
    /// Vertices that exceeded the step budget, each with the first instruction beyond it.
    pub(crate) cut: Vec<(usize, usize)>,
}

impl VertexRows {
    pub(crate) fn new() -> Self {
        Self { position: Default::default(), components: vec![Vec::new(); COMPONENTS], executed: 0, cut: Vec::new() }
    }

    /// Converts vertices to rows.
    pub fn from_vertices(vertices: &[Vertex], needed: ComponentMask) -> Self {
        let mut rows = Self::new();
        for (c, row) in rows.position.iter_mut().enumerate() {
            *row = vertices.iter().map(|v| v.position[c]).collect();
        }
        for (component, row) in rows.components.iter_mut().enumerate().filter(|(c, _)| needed.has(*c)) {
            *row = vertices.iter().map(|v| v.component(component)).collect();
        }
        rows
    }

    /// [`Vertex::clamp_colors`] of all vertices.
    pub(crate) fn clamp_colors(&mut self) {
        let colors = self.components[COLOR_COMPONENT..FOG_COMPONENT].iter_mut();
        colors.flatten().for_each(|color| *color = clamped_color(*color));
    }

    /// A vertex with the components that have rows; other components are zero.
    pub(crate) fn vertex(&self, index: usize) -> Vertex {
        let at = |row: &Vec<u32>| row.get(index).copied().unwrap_or_default();
        let component = |i: usize| self.components.get(i).map_or(0, at);
        Vertex {
            position: [0, 1, 2, 3].map(|c: usize| at(&self.position[c])),
            texcoords: std::array::from_fn(|set| std::array::from_fn(|c| component(4 * set + c))),
            colors: std::array::from_fn(|i| std::array::from_fn(|c| component(COLOR_COMPONENT + 4 * i + c))),
            fog: component(FOG_COMPONENT),
            point_size: 0,
        }
    }
}
