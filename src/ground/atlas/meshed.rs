//! The atlas: texels of a mesh, and clusters of them.

use glam::DVec3;
use rayon::prelude::*;

use super::census::Census;
use super::drawn::{DrawnFace, DrawnVertex};
use super::graph::FaceGraph;
use super::levels::levels;
use super::measures::FaceMeasures;
use super::part::TexelPart;
use super::place::FacePlace;
use super::surface::AtlasSurface;
use super::texel::{Cluster, Texel};
use super::tree::ClusterTree;
use crate::error::{InputError, ensure, input_error};
use crate::geom::Mesh;

/// Maximum side of an atlas, in texels.
pub const MAX_SIDE: u32 = 8192;

/// Mesh in a square of texels.
#[derive(Debug, Clone)]
pub struct Atlas {
    side: u32,
    surface: AtlasSurface,
    tree: ClusterTree,
    places: Vec<FacePlace>,
    texels: Vec<Texel>,
    levels: Vec<Vec<Cluster>>,
    census: Census,
}

impl Atlas {
    /// Builds the atlas of a mesh with `side` x `side` texels; `side` is a power of two.
    ///
    /// ```
    /// # mod crossbar { pub use {crossbar_base::*, crossbar_ground::*}; }
    /// use crossbar::atlas::Atlas;
    /// use crossbar::geom::Mesh;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    /// let square = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]])?;
    /// let atlas = Atlas::new(&square, 4)?;
    /// assert_eq!((atlas.texels().len(), atlas.levels()), (16, 3));
    /// assert!(atlas.texels().iter().all(|texel| texel.area == 1.0 / 16.0));
    /// assert_eq!(Atlas::new(&square, 1).err().map(|error| error.to_string()).as_deref(), Some(
    ///     "2 faces do not fit into an atlas of 1 x 1 texels, expected a side of at least 2: every face needs a texel"
    /// ));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Fails if the side is not a power of two or above [`MAX_SIDE`], if there are more faces than texels, and if the
    /// mesh has no face with an area.
    pub fn new(mesh: &Mesh, side: u32) -> Result<Self, InputError> {
        check(mesh.len(), side)?;
        let welded = mesh.welded();
        let surface = AtlasSurface::new(mesh, &welded);
        ensure!(
            !surface.areas().iter().all(|area| *area == 0.0),
            "all of the {} faces have zero area, expected at least one with an area",
            mesh.len()
        );
        let adjacency = welded.adjacency();
        let graph = FaceGraph::of_mesh(&surface, &welded, &adjacency);
        let parts = graph.parts(|_| true).1 as usize;
        let census = Census::new(&surface, &welded, &adjacency, parts);
        drop((adjacency, welded));
        let measures = FaceMeasures::new(&surface, f64::from(side) * f64::from(side));
        let tree = ClusterTree::new(graph, &measures, side);
        drop(measures);
        let places = places(&surface, &tree);
        let texels = texels(&surface, &places, side);
        let levels = levels(&surface, &places, &texels, side);
        Ok(Self { side, surface, tree, places, texels, levels, census })
    }

    /// Texels along a side.
    pub const fn side(&self) -> u32 {
        self.side
    }

    /// All texels, row by row. Every texel lies on a face.
    pub fn texels(&self) -> &[Texel] {
        &self.texels
    }

    /// Number of levels: 1 more than the logarithm of the side to base 2. Level 0 is the finest.
    pub fn levels(&self) -> u32 {
        self.levels.len() as u32
    }

    /// Clusters of a level, row by row; empty for a level that does not exist.
    pub fn clusters(&self, level: u32) -> &[Cluster] {
        self.levels.get(level as usize).map_or(&[], Vec::as_slice)
    }

    /// Returns the cluster under a texel of a level. Panics if there is no such level, column or row.
    pub fn cluster(&self, level: u32, x: u32, y: u32) -> &Cluster {
        let width = self.side >> level;
        assert!(x < width && y < width, "level {level} has {width} columns and rows, found {x}, {y}");
        &self.levels[level as usize][y as usize * width as usize + x as usize]
    }

    /// Rectangle of each face of the mesh, in its order.
    pub fn places(&self) -> &[FacePlace] {
        &self.places
    }

    /// Tree of clusters.
    pub const fn tree(&self) -> &ClusterTree {
        &self.tree
    }

    /// Area of the surface.
    pub fn area(&self) -> f64 {
        self.surface.areas().iter().sum()
    }

    /// Area of the surface divided by the number of texels.
    pub fn mean_texel_area(&self) -> f64 {
        self.area() / self.texels.len() as f64
    }

    /// Irregularities of the mesh.
    pub const fn census(&self) -> &Census {
        &self.census
    }

    /// Returns the mesh with vertices merged by position, without unused vertices.
    pub(super) fn welded(&self) -> Mesh {
        self.surface.welded()
    }

    /// Returns `true` if the mesh has normals; otherwise each vertex has the mean normal of its faces.
    pub const fn has_given_normals(&self) -> bool {
        self.surface.has_given_normals()
    }

    /// Returns the corners of a face of the mesh. Panics if there is no such face.
    pub fn corners(&self, face: u32) -> [DVec3; 3] {
        self.surface.corners(face)
    }

    /// Unit normals at the corners of a face; zero where unknown.
    pub fn normals(&self, face: u32) -> [DVec3; 3] {
        self.surface.normals(face)
    }

    /// Texel coordinates of the point of a face with these barycentric weights, by corner index.
    pub fn coordinates(&self, face: u32, weights: [f64; 3]) -> [f64; 2] {
        self.places[face as usize].coordinates(weights)
    }

    /// Part of the surface under the texel with this index.
    pub fn part(&self, texel: u32) -> TexelPart {
        let face = self.texels[texel as usize].face;
        let [x, y] = self.column_and_row(texel);
        TexelPart::new(&self.places[face as usize], self.surface.corners(face), [x, y], [x + 1.0, y + 1.0])
    }

    /// `n` x `n` points that stratify the surface under a texel, row by row: the centroids of subdivisions of equal
    /// area. Their mean is the texel's mean point.
    pub fn points(&self, texel: u32, n: u32) -> impl Iterator<Item = DVec3> {
        let face = self.texels[texel as usize].face;
        let [x, y] = self.column_and_row(texel);
        let step = 1.0 / f64::from(n);
        (0..n).flat_map(move |row| (0..n).map(move |column| [column, row])).map(move |at| {
            let [left, top] = [x + f64::from(at[0]) * step, y + f64::from(at[1]) * step];
            let weights = self.places[face as usize].mean_weights([left, top], [left + step, top + step]);
            self.surface.point(face, weights)
        })
    }

    fn column_and_row(&self, texel: u32) -> [f64; 2] {
        [f64::from(texel % self.side), f64::from(texel / self.side)]
    }

    /// Face for drawing it into the atlas or with texels from the atlas.
    pub fn drawn(&self, face: u32) -> DrawnFace {
        let place = self.places[face as usize];
        let [positions, normals] = [self.surface.corners(face), self.surface.normals(face)];
        let [x, y, width, height] = [place.x, place.y, place.width, place.height];
        let turned =
            |[along_x, along_y]: [[u32; 2]; 2]| if place.transposed { [along_y, along_x] } else { [along_x, along_y] };
        let vertex = |position, normal, at| DrawnVertex { position, normal, at };
        let far = [x + width, y + height];
        let [at_b, at_c] = turned([[far[0], y], [x, far[1]]]);
        let ([a, b, c], [na, nb, nc]) = (place.in_turn(positions), place.in_turn(normals));
        let [a, b, c] = [vertex(a, na, [x, y]), vertex(b, nb, at_b), vertex(c, nc, at_c)];
        let m = vertex((b.position + c.position) / 2.0, (nb + nc) / 2.0, far);
        let [beside, below] = turned([[x + 2 * width, y], [x, y + 2 * height]]);
        let at = place.by_index([[[x, y], [x, y]], [far, beside], [far, below]]);
        let whole = [0, 1, 2].map(|k| DrawnVertex { position: positions[k], normal: normals[k], at: at[k] });
        DrawnFace { triangles: [[a, b, m], [a, m, c]], whole, bounds: place.bounds() }
    }
}

/// Checks the side of an atlas.
pub fn require_side(side: u32) -> Result<(), InputError> {
    let fits = side.is_power_of_two() && side <= MAX_SIDE;
    ensure!(fits, "found an atlas of {side} x {side} texels, expected a side that is a power of two, up to {MAX_SIDE}");
    Ok(())
}

fn check(faces: usize, side: u32) -> Result<(), InputError> {
    require_side(side)?;
    let texels = |side: u32| u64::from(side) * u64::from(side);
    ensure!(faces != 0, "the mesh has no faces, expected at least one");
    ensure!(
        faces as u64 <= texels(MAX_SIDE),
        "found {faces} faces, expected at most {}: one for every texel of the largest atlas",
        texels(MAX_SIDE)
    );
    if faces as u64 > texels(side) {
        let mut least = side;
        while faces as u64 > texels(least) {
            least *= 2;
        }
        return Err(input_error!(
            "{faces} faces do not fit into an atlas of {side} x {side} texels, expected a side of at \
         least {least}: every face needs a texel"
        ));
    }
    Ok(())
}

fn places(surface: &AtlasSurface, tree: &ClusterTree) -> Vec<FacePlace> {
    let mut rectangles = vec![[0; 4]; surface.len()];
    for leaf in tree.nodes().iter().filter(|node| node.faces == 1) {
        rectangles[tree.order()[leaf.first as usize] as usize] = [leaf.x, leaf.y, leaf.width, leaf.height];
    }
    (0..).zip(rectangles).map(|(face, rectangle)| FacePlace::squarest(rectangle, surface.corners(face))).collect()
}

fn texels(surface: &AtlasSurface, places: &[FacePlace], side: u32) -> Vec<Texel> {
    let mut face_of = vec![0_u32; side as usize * side as usize];
    for (face, place) in (0..).zip(places) {
        for row in place.y..place.y + place.height {
            let from = row as usize * side as usize + place.x as usize;
            face_of[from..from + place.width as usize].fill(face);
        }
    }
    let texel = |(at, face): (usize, u32)| {
        let place = &places[face as usize];
        let [x, y] = [at % side as usize, at / side as usize].map(|at| at as f64);
        let weights = place.mean_weights([x, y], [x + 1.0, y + 1.0]);
        let area = surface.areas()[face as usize] / f64::from(place.texels());
        Texel { face, point: surface.point(face, weights), normal: surface.normal(face, weights), area }
    };
    face_of.into_par_iter().enumerate().map(texel).collect()
}
