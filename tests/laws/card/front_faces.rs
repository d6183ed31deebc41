//! Cards draw only the front faces of open models, as the host's rays meet them. An ideal card differs from values
//! interpolated in f64 by less than the snapping of vertices to subpixels explains.

use super::{exits, interpolated};
use crate::support::{cluster_options, profile};
use crossbar::card::{MeshView, SeenPixel, Texels, seen_pixels};
use crossbar::clustering::{Clustering, compress};
use crossbar::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crossbar::geom::Mesh;
use crossbar::io::load_mesh;
use crossbar::report::Provenance;
use crossbar::scene::Camera;
use crossbar::sphere::HarmonicLight;
use crossbar::study::Study;
use crossbar::study::prt::{CardSetting, LitView, OnCard};
use crossbar::transfer::brdf::ExitBasis;
use crossbar::transfer::file::PrtMeaning;
use crossbar::transfer::synthetic::signal_at;
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use refsim::texture::TexelFormat;

const SIZE: [u32; 2] = [60, 50];
const FLOATS: TexelFormat = TexelFormat::Rgba32f;
/// Offsets of rays from a pixel's center, in pixels. If all meet the same triangle, the rasterizer must find it.
const AROUND: [[f64; 2]; 5] = [[0.0, 0.0], [0.05, 0.05], [0.05, -0.05], [-0.05, 0.05], [-0.05, -0.05]];

/// The surface that a pixel shows, computed in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shown {
    Nothing,
    /// The barycentric weights at the center, one subpixel step to the right of it, and one step below.
    Triangle([SeenPixel; 3]),
    /// Triangles meet near the center: the rasterizer may choose another triangle.
    Edge,
}

struct Scene {
    name: &'static str,
    vertices: Vertices,
    camera: Camera,
    shown: Vec<Shown>,
}

impl Scene {
    fn new(name: &'static str, mesh: &Mesh, camera: Camera) -> Self {
        let vertices = Vertices::new(mesh, Tangents::Along(DVec3::new(0.3, 0.5, 0.7))).expect("vertices");
        let mut scene = Self { name, vertices, camera, shown: Vec::new() };
        scene.shown = (0..SIZE[0] * SIZE[1]).map(|pixel| scene.pixel(pixel % SIZE[0], pixel / SIZE[0])).collect();
        let count = |is: fn(&Shown) -> bool| scene.shown.iter().filter(|shown| is(shown)).count();
        let counts = [count(|s| *s == Shown::Nothing), count(|s| matches!(s, Shown::Triangle(_)))];
        assert!(counts.iter().all(|&count| count > 500), "{name}: {counts:?}");
        scene
    }

    /// A box without a lid, seen obliquely from above: a culled inner face shows the background.
    fn open_box() -> Self {
        let corner = |at: usize| {
            let [x, y] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]][at % 4];
            [x, y, if at < 4 { -0.6 } else { 0.6 }]
        };
        let walls = (0..4_u32).flat_map(|at| {
            let next = (at + 1) % 4;
            [[at, next, next + 4], [at, next + 4, at + 4]]
        });
        let faces = walls.chain([[0, 3, 2], [0, 2, 1]]).collect();
        let mesh = Mesh::new((0..8).map(corner).collect(), faces).expect("a box");
        let camera = Camera::new([2.4, -3.1, 2.6], [0.0; 3], [0.0, 0.0, 1.0], 0.3, SIZE[0], SIZE[1]);
        Self::new("an open box", &mesh, camera.expect("a camera"))
    }

    /// The example's teapot, which has a gap between lid and body and an open bottom.
    fn teapot() -> Self {
        let mesh = load_mesh("docs/examples/teapot.obj".as_ref()).expect("the teapot");
        let camera = Camera::new([2.4, -5.2, -2.0], [0.6, 0.0, 1.3], [0.0, 0.0, 1.0], 0.5, SIZE[0], SIZE[1]);
        Self::new("the teapot", &mesh, camera.expect("a camera"))
    }

    fn place(&self, vertex: u32) -> DVec3 {
        DVec3::from(self.vertices.positions()[vertex as usize].map(f64::from))
    }

    /// Distance along the ray and barycentric weights of the point where the ray through a picture position meets a
    /// triangle's plane; `None` for a back face or a point behind the eye.
    fn meet(&self, triangle: usize, [x, y]: [f64; 2]) -> Option<(f64, SeenPixel)> {
        let (eye, direction) = (DVec3::from(self.camera.eye().map(f64::from)), self.camera.direction_at(x, y));
        let corners = self.vertices.triangles()[triangle];
        let [a, b, c] = corners.map(|corner| self.place(corner));
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a - eye) / normal.dot(direction);
        let point = eye + t * direction;
        let weight = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) / normal.dot(normal);
        let weights = [weight(b, c), weight(c, a), weight(a, b)];
        (normal.dot(direction) < 0.0 && t > 0.0)
            .then_some((t, SeenPixel { triangle: triangle as u32, corners, weights }))
    }

    /// Synthetic transfer to light of order 3: up to 64 clusters of 6 vectors, but at most one per four vertices.
    fn clusters(&self, basis: &ExitBasis) -> Clustering {
        let place = |at: usize| self.place(at as u32).to_array();
        let signal = signal_at(self.vertices.len(), basis.len() * 9, 3, place);
        let options = cluster_options(64.min(self.vertices.len() / 4), 6, 2, 4);
        compress(&signal, &options, |_| ()).expect("compressed").clustering
    }

    fn nearest(&self, at: [f64; 2]) -> Option<u32> {
        let met = (0..self.vertices.triangles().len()).filter_map(|triangle| self.meet(triangle, at));
        let inside = met.filter(|(_, seen)| seen.weights.iter().all(|&weight| weight >= 0.0));
        inside.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, seen)| seen.triangle)
    }

    fn pixel(&self, x: u32, y: u32) -> Shown {
        let at = |[right, down]: [f64; 2]| [f64::from(x) + 0.5 + right, f64::from(y) + 0.5 + down];
        let nearest = self.nearest(at([0.0; 2]));
        if AROUND.iter().any(|&beside| self.nearest(at(beside)) != nearest) {
            return Shown::Edge;
        }
        let Some(triangle) = nearest else { return Shown::Nothing };
        // One subpixel: twice the snapping error of a vertex, which is half a subpixel per axis.
        let step = 1.0 / f64::from(ideal().rules.subpixel_grid.lines());
        let met = [[0.0; 2], [step, 0.0], [0.0, step]].map(|beside| self.meet(triangle as usize, at(beside)));
        match met {
            [Some(center), Some(right), Some(down)] => Shown::Triangle([center.1, right.1, down.1]),
            _ => Shown::Edge,
        }
    }

    /// Compares a picture with values in f64: background pixels are exactly 0, others lie within the change over one
    /// subpixel step plus `share` of the largest value. Pixels whose value is `None` are not compared.
    fn check(&self, kind: &str, texels: &Texels, share: f64, value: &dyn Fn(&SeenPixel) -> Option<[f64; 3]>) {
        let name = format!("{}, {kind}", self.name);
        let values = |shown: &Shown| {
            let Shown::Triangle(around) = shown else { return None };
            let [center, right, down] = around.each_ref().map(value);
            Some([center?, right?, down?])
        };
        let all: Vec<Option<[[f64; 3]; 3]>> = self.shown.iter().map(values).collect();
        let largest = all.iter().flatten().flat_map(|[center, ..]| center).fold(0.0_f64, |most, v| most.max(v.abs()));
        let mut compared = 0;
        for (pixel, ((shown, texel), values)) in self.shown.iter().zip(&texels.texels).zip(&all).enumerate() {
            if *shown == Shown::Nothing {
                assert_eq!(*texel, [0.0; 4], "{name}, pixel {pixel} shows nothing");
            }
            let Some([center, right, down]) = values else { continue };
            compared += 1;
            for channel in 0..3 {
                let explained = (right[channel] - center[channel]).abs() + (down[channel] - center[channel]).abs();
                let off = (f64::from(texel[channel]) - center[channel]).abs();
                let bound = explained + share * largest;
                assert!(off <= bound, "{name}, pixel {pixel}: off by {off}, {bound} explained of {largest}");
            }
        }
        assert!(compared > 300, "{name}: {compared} pixels compared");
    }
}

fn ideal() -> Profile {
    profile("ideal-fp32")
}

fn scenes() -> [Scene; 2] {
    [Scene::open_box(), Scene::teapot()]
}

/// `seen_pixels`, on which comparisons rely, reports only front faces.
#[test]
fn seen_pixels_are_those_of_rays() {
    for scene in scenes() {
        let seen = seen_pixels(&ideal(), scene.vertices.geometry(), &scene.camera).expect("pixels");
        for (pixel, (seen, shown)) in seen.iter().zip(&scene.shown).enumerate() {
            match shown {
                Shown::Nothing => assert_eq!(*seen, None, "{}, pixel {pixel}", scene.name),
                Shown::Triangle([center, ..]) => {
                    let found = seen.map(|seen| seen.triangle);
                    assert_eq!(found, Some(center.triangle), "{}, pixel {pixel}", scene.name);
                }
                Shown::Edge => {}
            }
        }
    }
}

#[test]
fn compressed_transfer_shows_front_faces() {
    for scene in scenes() {
        // The remaining error of glossy transfer is the bilinear filter between the 256 texels of a map's side.
        for (basis, share) in [(ExitBasis::Radiance, 1e-5), (ExitBasis::of_order(4), 3e-3)] {
            let clustering = scene.clusters(&basis);
            let light = HarmonicLight::red_and_blue(3);
            let vectors = clustering.subspaces().iter().map(|subspace| subspace.len()).max().expect("a cluster");
            let (vertices, clustering, basis) = (&scene.vertices, &clustering, &basis);
            let transfer = CompressedTransfer { vertices, clustering, basis, channels: 1, vectors };
            let options = PrtCardOptions { map_side: 256, map_format: FLOATS, ..PrtCardOptions::default() };
            let mut card = PrtCard::new(ideal(), ExecutorKind::Batch, transfer, &options).expect("a card");
            let view = MeshView { camera: scene.camera, exposure: 0.5, format: FLOATS };
            let texels = card.view_texels(&light, &view).expect("a picture");
            let (exits, eye) = (exits(clustering, &light), scene.camera.eye());
            let value = |seen: &SeenPixel| interpolated(vertices, basis, &exits, eye, seen);
            scene.check(if transfer.is_glossy() { "glossy" } else { "diffuse" }, &texels, share, &value);
        }
    }
}

/// A study's sentence on the difference between card and host for the open box.
fn difference(profile: Profile, exposure: Option<f64>) -> serde_json::Value {
    let scene = Scene::open_box();
    let basis = ExitBasis::Radiance;
    let meaning = PrtMeaning::Transfer { channels: 1, exit_functions: vec![0], light_order: 3, includes_albedo: true };
    let study = OnCard {
        view: LitView {
            model: scene.name.to_owned(),
            light: "red and blue".to_owned(),
            camera: scene.camera,
            exposure,
        },
        clustering: scene.clusters(&basis),
        vertices: scene.vertices,
        meaning,
        light: HarmonicLight::red_and_blue(3),
        card: CardSetting {
            profile,
            switches: Vec::new(),
            executor: ExecutorKind::Batch.into(),
            format: FLOATS,
            sweep: false,
        },
    };
    let found = study.findings(&mut |_, _, _| ()).expect("a picture");
    found.document(&Provenance::new("crossbar cpca card"))["difference"].clone()
}

/// A study of an ideal card that interpolates shades reports only the rounding of single precision.
#[test]
fn a_study_blames_no_back_face() {
    let largest = difference(ideal(), None)["largest_255ths"].as_f64().expect("a number");
    assert!(largest > 0.0 && largest < 0.01, "{largest}");
}

/// Half precision cannot represent this exposure: pixels that are not finite are counted and visible.
#[test]
fn pixels_that_are_not_finite_are_not_right() {
    let found = difference(profile("ideal-fp16"), Some(1e9));
    assert!(found["not_finite"].as_u64().is_some_and(|count| count > 0), "{found}");
    assert!(found["rms_255ths"] == "inf" && found["visible_share"].as_f64() > Some(0.0), "{found}");
}
