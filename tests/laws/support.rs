//! Helpers of several tests: devices, files, threads, meshes, hits as bits, clusters.

use std::fmt::Debug;
use std::path::{Path, PathBuf};

use crossbar::clustering::{CpcaForm, CpcaMethod, CpcaOptions};
use crossbar::geom::vector::wide;
use crossbar::geom::{Hit, Mesh};
use crossbar::scene::Camera;
use proptest::sample::Index;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::timing::{Level, Model};

use crate::archive::{archive, members};

/// A device by name.
pub(crate) fn profile(name: &str) -> Profile {
    Profile::named(name).expect("a device")
}

/// A file of the repository.
pub(crate) fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Runs `work` on `threads` threads; returns its result.
pub(crate) fn in_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(work)
}

/// Triangles and bits of t of some hits.
pub(crate) fn bits(hits: &[Option<Hit>]) -> Vec<Option<(u32, u32)>> {
    hits.iter().map(|hit| hit.map(|hit| (hit.triangle, hit.t.to_bits()))).collect()
}

pub(crate) fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found}, expected {expected} to {tolerance:e}");
}

/// A mesh of unconnected triangles, given by three consecutive corners each.
pub(crate) fn soup(corners: Vec<[f32; 3]>) -> Mesh {
    let triangles = (0..corners.len() as u32 / 3).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
    Mesh::new(corners, triangles).expect("a mesh")
}

/// A mesh of unconnected triangles with flat normals.
pub(crate) fn flat(corners: Vec<[f32; 3]>) -> Mesh {
    let normals = corners.chunks(3).flat_map(|triangle| {
        let [a, b, c] = [0, 1, 2].map(|at| wide(triangle[at]));
        [(b - a).cross(c - a).normalize().as_vec3().to_array(); 3]
    });
    let normals = normals.collect();
    soup(corners).with_normals(normals).expect("normals")
}

/// A rectangle from the origin along x and y, of two triangles.
pub(crate) fn plate(length: f32, width: f32) -> Mesh {
    let corners = vec![[0.0, 0.0, 0.0], [length, 0.0, 0.0], [length, width, 0.0], [0.0, width, 0.0]];
    Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh")
}

/// A box between two corners, fronts outwards, of 8 vertices.
pub(crate) fn cuboid(low: [f32; 3], high: [f32; 3]) -> Mesh {
    let corner = |at: u32| [0, 1, 2].map(|axis| if at >> axis & 1 == 1 { high[axis] } else { low[axis] });
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh::new((0..8).map(corner).collect(), triangles).expect("a box")
}

/// A camera above the hills of [`crossbar::transfer::synthetic::hills`], so that no hill hides another.
pub(crate) fn over_hills([width, height]: [u32; 2]) -> Camera {
    Camera::new([0.6, -1.5, 3.0], [0.0; 3], [0.0, 1.0, 0.0], 0.4, width, height).expect("a camera")
}

/// The clocks in which a card transforms the vertices of all draws of a log.
pub(crate) fn vertex_clocks(card: &Profile, log: &[Event]) -> f64 {
    let model = Model::new(Level::Pipeline, card).expect("a model");
    let of = |event: &Event| if let Event::Draw(draw) = event { model.clocks(draw).vertices.0 } else { 0 };
    log.iter().map(of).sum::<u64>() as f64
}

/// Options for affine clusters, with the same number of both kinds of iterations, and start points chosen by the seed.
pub(crate) fn cluster_options(clusters: usize, vectors: usize, iterations: usize, seed: u64) -> CpcaOptions {
    CpcaOptions {
        clusters,
        vectors,
        vq_iterations: iterations,
        iterations,
        method: CpcaMethod::Iterative,
        form: CpcaForm::Affine,
        seed,
    }
}

/// A truncated file is refused; a flipped bit is refused, or changes only something that readers ignore, such as the
/// date of a member.
pub(crate) fn damage_is_seen<T: PartialEq>(
    file: &T,
    whole: &[u8],
    bits_per_byte: usize,
    read: impl Fn(&[u8]) -> Result<T, String>,
) {
    for length in 0..whole.len() {
        assert!(read(&whole[..length]).is_err(), "{length} of {} bytes", whole.len());
    }
    for (at, bit) in (0..whole.len()).flat_map(|at| (0..bits_per_byte).map(move |bit| (at, (at + bit) % 8))) {
        let mut damaged = whole.to_vec();
        damaged[at] ^= 1 << bit;
        assert!(read(&damaged).map_or(true, |read| read == *file), "bit {bit} of byte {at}");
    }
}

/// Changes a byte of a member and corrects its checksum: the file must be refused, or survive reading, writing and
/// reading again.
pub(crate) fn forgery_does_no_harm<T: PartialEq + Debug>(
    whole: &[u8],
    (which, at, byte): (Index, Index, u8),
    read: impl Fn(&[u8]) -> Result<T, String>,
    write: impl Fn(&T) -> Vec<u8>,
) {
    let mut members = members(whole);
    let which = which.index(members.len());
    let at = at.index(members[which].1.len());
    members[which].1[at] = byte;
    if let Ok(found) = read(&archive(&members)) {
        assert_eq!(read(&write(&found)), Ok(found));
    }
}
