//! Closed and closable rooms as test scenes of radiosity: a closed cube, and a Cornell box with right angles. z is up,
//! y points to the back, walls face inwards.

use crate::geom::Mesh;
use crate::scene::{Color, Material, Scene, Surface, View};

/// Names of the walls: floor, ceiling, left (x = 0), right, front (y = 0) and back.
pub const WALLS: [&str; 6] = ["floor", "ceiling", "left", "right", "front", "back"];

/// Reflectances of the Cornell box used by renderers, after the spectra measured at Cornell.
const WHITE: Color = [0.725, 0.71, 0.68];
const RED: Color = [0.63, 0.065, 0.05];
const GREEN: Color = [0.14, 0.45, 0.091];
const LIGHT: Color = [17.0, 12.0, 4.0];

#[derive(Default)]
struct RoomBuilder {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    materials: Vec<Material>,
    material_of: Vec<u32>,
}

impl RoomBuilder {
    fn quad(&mut self, corners: [[f32; 3]; 4], material: u32) {
        let first = self.positions.len() as u32;
        self.positions.extend(corners);
        self.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|corner| first + corner)));
        self.material_of.extend([material; 2]);
    }

    /// Adds the six walls of a box from the origin, in the order of [`WALLS`]; omits walls of material `None`.
    fn walls(&mut self, [x, y, z]: [f32; 3], materials: [Option<u32>; 6]) {
        let quads = [
            [[0.0, 0.0, 0.0], [x, 0.0, 0.0], [x, y, 0.0], [0.0, y, 0.0]],
            [[0.0, y, z], [x, y, z], [x, 0.0, z], [0.0, 0.0, z]],
            [[0.0, 0.0, 0.0], [0.0, y, 0.0], [0.0, y, z], [0.0, 0.0, z]],
            [[x, 0.0, z], [x, y, z], [x, y, 0.0], [x, 0.0, 0.0]],
            [[0.0, 0.0, 0.0], [0.0, 0.0, z], [x, 0.0, z], [x, 0.0, 0.0]],
            [[x, y, 0.0], [x, y, z], [0.0, y, z], [0.0, y, 0.0]],
        ];
        for (quad, material) in quads.into_iter().zip(materials) {
            if let Some(material) = material {
                self.quad(quad, material);
            }
        }
    }

    fn scene(self, eye: [f32; 3], target: [f32; 3], tan_half_height: f32) -> Scene {
        let mesh = Mesh::new(self.positions, self.triangles).expect("corners of our own");
        let mut scene = Scene::new(mesh, self.materials, self.material_of, Vec::new()).expect("a material a triangle");
        scene.views = vec![View::upright("front", eye, target, tan_half_height)];
        scene
    }
}

/// Builds the closed unit cube, with a material per wall in the order of [`WALLS`].
pub fn cube(materials: [Material; 6]) -> Scene {
    let mut room = RoomBuilder { materials: materials.into(), ..RoomBuilder::default() };
    room.walls([1.0; 3], [0, 1, 2, 3, 4, 5].map(Some));
    room.scene([0.5, 0.01, 0.5], [0.5, 1.0, 0.5], 0.75)
}

/// Builds a white furnace: the unit cube whose walls reflect `reflectance` and emit 1 - `reflectance`. The radiosity is
/// 1 everywhere.
pub fn furnace(reflectance: f32) -> Scene {
    let radiance = ((1.0 - f64::from(reflectance)) / std::f64::consts::PI) as f32;
    let surface = Surface::Diffuse { albedo: [reflectance; 3] };
    cube(WALLS.map(|name| Material { name: name.to_owned(), surface, emission: [radiance; 3] }))
}

/// Options of the Cornell box.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CornellBox {
    /// `true` to include the short and the tall block.
    pub blocks: bool,
    /// `true` to omit the front wall, as in the photographs; otherwise a white wall closes the room.
    pub open: bool,
}

/// Builds the Cornell box: 5.5 in each direction, red wall left, green wall right, a light of 1.3 x 1.05 in the
/// ceiling, blocks as published.
pub fn cornell(what: CornellBox) -> Scene {
    let light = Material { emission: LIGHT, ..Material::diffuse("light", [0.78; 3]) };
    let painted =
        [("white", WHITE), ("red", RED), ("green", GREEN)].map(|(name, albedo)| Material::diffuse(name, albedo));
    let mut room = RoomBuilder { materials: painted.into_iter().chain([light]).collect(), ..RoomBuilder::default() };
    let front = (!what.open).then_some(0);
    room.walls([5.5; 3], [Some(0), None, Some(1), Some(2), front, Some(0)]);
    ceiling_with_light(&mut room);
    if what.blocks {
        block(&mut room, [[1.3, 0.65], [0.82, 2.25], [2.4, 2.72], [2.9, 1.14]], 1.65);
        #[expect(clippy::approx_constant, reason = "a corner of a block")]
        block(&mut room, [[4.23, 2.47], [2.65, 2.96], [3.14, 4.56], [4.72, 4.06]], 3.3);
    }
    let eye = if what.open { [2.75, -8.0, 2.75] } else { [2.75, 0.05, 2.6] };
    // The closed room is seen from inside, with a wide angle so that the light is visible. The target is a little low,
    // so that no pixel looks exactly into a corner.
    let target = [2.75, 2.75, if what.open { 2.75 } else { 2.6 }];
    room.scene(eye, target, if what.open { 0.345 } else { 1.2 })
}

fn ceiling_with_light(room: &mut RoomBuilder) {
    let (xs, ys, z) = ([0.0, 2.1, 3.4, 5.5], [0.0, 2.25, 3.3, 5.5], 5.5);
    for j in 0..3 {
        for i in 0..3 {
            let ([x, x2], [y, y2]) = ([xs[i], xs[i + 1]], [ys[j], ys[j + 1]]);
            room.quad([[x, y2, z], [x2, y2, z], [x2, y, z], [x, y, z]], if i == 1 && j == 1 { 3 } else { 0 });
        }
    }
}

/// Adds four sides and a top on a quadrilateral of the floor, whose corners run clockwise from above.
fn block(room: &mut RoomBuilder, floor: [[f32; 2]; 4], height: f32) {
    let at = |[x, y]: [f32; 2], z: f32| [x, y, z];
    for i in 0..4 {
        let (a, b) = (floor[i], floor[(i + 1) % 4]);
        room.quad([at(b, 0.0), at(a, 0.0), at(a, height), at(b, height)], 0);
    }
    room.quad([floor[3], floor[2], floor[1], floor[0]].map(|corner| at(corner, height)), 0);
}
