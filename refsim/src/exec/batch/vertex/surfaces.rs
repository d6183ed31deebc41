//! Triangles in structure-of-arrays layout: each distinct shape once, and one row per component that the pixel program
//! reads.
//!
//! The Ray Engine draws thousands of quads with the same corners: these have only two shapes, and differ in components
//! that are constant over each triangle.

use crate::num::Format;
use crate::raster::{ComponentMask, Plane, TriangleSetup};

/// Number of recent shapes that are compared with a new shape.
const RECENT: usize = 4;

/// A triangle: indices of its shape and of its planes in the rows of components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Triangle {
    pub(crate) shape: u32,
    pub(crate) planes: u32,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct PlaneRows {
    /// Component, as in [`ComponentMask`].
    pub(crate) component: usize,
    pub(crate) base: Vec<u32>,
    /// Empty, like `d2`, if the component is constant over all triangles.
    pub(crate) d1: Vec<u32>,
    pub(crate) d2: Vec<u32>,
}

impl PlaneRows {
    pub(crate) fn plane(&self, index: u32) -> Plane {
        let at = |row: &[u32]| row.get(index as usize).copied().unwrap_or_default();
        Plane { base: at(&self.base), d1: at(&self.d1), d2: at(&self.d2) }
    }

    pub(crate) fn push(&mut self, plane: Plane) {
        self.d1.resize(self.base.len(), 0);
        self.d2.resize(self.base.len(), 0);
        self.base.push(plane.base);
        self.d1.push(plane.d1);
        self.d2.push(plane.d2);
    }
}

/// Triangles of a draw in order of submission, with the components that the pixel program reads.
#[derive(Clone, Debug)]
pub struct Surfaces {
    /// Set-ups without planes.
    pub(crate) shapes: Vec<TriangleSetup>,
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) rows: Vec<PlaneRows>,
    /// Components of `rows` that are constant over a triangle, by index of its planes.
    pub(crate) constant: Vec<u64>,
    /// For each triangle, `true` if the previous triangle has the same constant components with the same values.
    pub(crate) joins: Vec<bool>,
    pub(crate) iterator_format: Format,
}

impl Surfaces {
    /// Creates an empty list with rows for the `needed` components.
    pub(crate) fn new(needed: ComponentMask, iterator_format: Format) -> Self {
        let rows = (0..crate::raster::COMPONENTS)
            .filter(|&component| needed.has(component))
            .map(|component| PlaneRows { component, ..PlaneRows::default() })
            .collect();
        Self {
            shapes: Vec::new(),
            triangles: Vec::new(),
            rows,
            constant: Vec::new(),
            joins: Vec::new(),
            iterator_format,
        }
    }

    /// Converts triangle set-ups.
    pub fn from_setups(setups: &[TriangleSetup], needed: ComponentMask) -> Self {
        let format = setups.first().map_or(Format::FP32, |setup| setup.iterator_format);
        let mut out = Self::new(needed, format);
        for setup in setups {
            let shape = out.shape(setup);
            let planes = out.push_planes(setup);
            out.push(Triangle { shape, planes });
        }
        out
    }

    /// Returns the index of an equal shape among the most recent, or adds the shape.
    pub(crate) fn shape(&mut self, setup: &TriangleSetup) -> u32 {
        let first = self.shapes.len().saturating_sub(RECENT);
        if let Some(i) = self.shapes[first..].iter().position(|known| same_shape(known, setup)) {
            return (first + i) as u32;
        }
        self.shapes.push(setup.clone());
        (self.shapes.len() - 1) as u32
    }

    /// Appends the planes of a triangle; returns their index.
    pub(crate) fn push_planes(&mut self, setup: &TriangleSetup) -> u32 {
        let mut constant = 0;
        for row in &mut self.rows {
            row.push(setup.planes[row.component]);
            constant |= setup.constant.0 & 1 << row.component;
        }
        self.constant.push(constant);
        (self.constant.len() - 1) as u32
    }

    /// Appends a triangle whose planes were appended.
    pub(crate) fn push(&mut self, triangle: Triangle) {
        let joins = self.triangles.last().is_some_and(|last| self.same_constants(last.planes, triangle.planes));
        self.push_joined(triangle, joins);
    }

    /// [`Self::push`] with known `joins`.
    pub(crate) fn push_joined(&mut self, triangle: Triangle, joins: bool) {
        self.triangles.push(triangle);
        self.joins.push(joins);
    }

    /// Returns `true` if two sets of planes have the same constant components with the same values.
    fn same_constants(&self, a: u32, b: u32) -> bool {
        let (a, b) = (a as usize, b as usize);
        let constant = self.constant[a];
        constant == self.constant[b]
            && self.rows.iter().all(|row| constant >> row.component & 1 == 0 || row.base[a] == row.base[b])
    }

    /// Components that are constant over every triangle.
    pub(crate) fn all_constant(&self) -> u64 {
        self.triangles.iter().fold(u64::MAX, |mask, t| mask & self.constant[t.planes as usize])
    }

    pub(crate) fn row(&self, component: u16) -> Option<&PlaneRows> {
        self.rows.iter().find(|row| row.component == usize::from(component))
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Returns `true` if there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Set-up of a triangle; its planes are undefined.
    pub fn geometry(&self, triangle: usize) -> Option<&TriangleSetup> {
        self.triangles.get(triangle).and_then(|t| self.shapes.get(t.shape as usize))
    }
}

/// Returns `true` if two set-ups have the same pixels, weights and depths.
fn same_shape(a: &TriangleSetup, b: &TriangleSetup) -> bool {
    a.edges == b.edges
        && a.bounds == b.bounds
        && a.area == b.area
        && a.depth == b.depth
        && a.depth_constant == b.depth_constant
        && a.affine == b.affine
        && a.reciprocal_w == b.reciprocal_w
}
