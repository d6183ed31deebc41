//! Options of all commands that trace rays: sizes, sides, folders of results.

use std::path::{Path, PathBuf};

use miette::IntoDiagnostic as _;
use refsim::num::FormatError;

use super::one_of::{OneOf, one_of};
use super::size::Size;
use super::{MemoryError, Problem, memory};
use crate::geom::exact::{Sides, Tracer};
use crate::geom::{Mesh, Ray};
use crate::io::PictureFile;
use crate::io::atomic::FileSet;
use crate::picture::Picture;
use crate::scene::Camera;

/// The sides that can be hit, for `--sides`.
pub(super) fn sides() -> OneOf<Sides> {
    let front = ("front", "The side from which the corners run counter-clockwise", Sides::Front);
    one_of([front, ("both", "Both sides", Sides::Both)])
}

/// The card where none is named.
pub(super) const DEFAULT_DEVICE: &str = "ideal-fp32";

/// Memory that rays and their hits take at most, per byte of the rays' file: 90 bytes for a line of at least 12.
pub(super) const RAYS_PER_BYTE: u64 = 8;

/// For `map_err` on parsing a number format.
pub(super) fn bad_format(error: FormatError) -> miette::Report {
    Problem::usage(format!("{error}"), "formats are s3.12, e5m10:rtz, fp24 and the like: see `crossbar alu --help`")
        .into()
}

/// Where a camera stands, what it looks at, and what is up.
pub(super) type Placement = (Option<[f32; 3]>, Option<[f32; 3]>, [f32; 3]);

/// A camera; without an eye, one that looks down a little from the front and sees all of the mesh, without a target, at
/// its middle.
pub(super) fn framing(
    mesh: &Mesh,
    size: Size,
    tan_half_height: f32,
    (eye, target, up): Placement,
) -> miette::Result<Camera> {
    let Some([low, high]) = mesh.bounds() else {
        return Err(Problem::usage(
            "the mesh has no triangles",
            "name an OBJ, PLY, STL or glTF file with at least one face",
        )
        .into());
    };
    let middle = [0, 1, 2].map(|i| low[i] / 2.0 + high[i] / 2.0);
    let target = target.unwrap_or(middle);
    let eye = eye.unwrap_or_else(|| {
        let half = [0, 1, 2].map(|i| f64::from(high[i]) / 2.0 - f64::from(low[i]) / 2.0);
        let radius = (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]).sqrt();
        // The sphere around the mesh touches the edges of the picture where the sine of half the view is radius /
        // distance.
        let tangent = f64::from(tan_half_height);
        let distance = 1.05 * radius * (1.0 + 1.0 / (tangent * tangent)).sqrt();
        let way = [0.3, -0.8, 0.52];
        [0, 1, 2].map(|i| (f64::from(target[i]) + distance * way[i]) as f32)
    });
    Camera::new(eye, target, up, tan_half_height, size.width, size.height).into_diagnostic()
}

/// First hits by exact arithmetic, triangle and t; the exact numbers behind them are dropped some rays at a time.
pub(super) fn exact_hits(tracer: &Tracer<'_>, rays: &[Ray], sides: Sides) -> Vec<Option<(u32, f32)>> {
    /// Rays whose exact numbers are in memory at once.
    const AT_ONCE: usize = 1 << 16;
    let mut hits = Vec::with_capacity(rays.len());
    for some in rays.chunks(AT_ONCE) {
        hits.extend(
            tracer.nearest_all(some, sides).into_iter().map(|hit| Some((hit.as_ref()?.triangle, hit?.t.to_f32()))),
        );
    }
    hits
}

/// Refuses a mesh, a Wavefront OBJ, PLY, STL or glTF file, whose text would take more memory than there is.
pub(super) fn require_mesh(path: &Path) -> Result<(), MemoryError> {
    require_file(path, 12, "name a smaller mesh")
}

/// Refuses a file whose contents take more memory than there is: `per_byte` bytes per byte of its text.
///
/// # Errors
/// [`MemoryError`].
pub(super) fn require_file(path: &Path, per_byte: u64, help: &str) -> Result<(), MemoryError> {
    // What is no file takes what it takes: it cannot be asked for its size.
    let length = std::fs::metadata(path).map_or(0, |file| file.len());
    memory::require(format_args!("reading `{}`", path.display()), length.saturating_mul(per_byte), help)
}

/// Memory for decoding a picture, in bytes: codes of 16 bits or floats, then the samples of each channel.
pub(super) fn decoded_bytes(file: &PictureFile) -> u64 {
    const PER_PIXEL: u64 = 24;
    const PER_SAMPLE: u64 = 8;
    let size = file.size();
    memory::of_pixels(size.width, size.height, PER_PIXEL, PER_SAMPLE * size.samples())
}

/// Reads a picture, unless decoding it takes more memory than there is.
///
/// # Errors
/// [`MemoryError`] before a pixel is decoded; what is wrong with the file.
pub(super) fn picture(path: &Path) -> miette::Result<Picture> {
    let file = PictureFile::open(path)?;
    require_picture(path, &file)?;
    Ok(file.decode()?)
}

/// Refuses a picture that takes more memory than there is.
///
/// # Errors
/// [`MemoryError`].
pub(super) fn require_picture(path: &Path, file: &PictureFile) -> Result<(), MemoryError> {
    let (size, bytes) = (file.size(), decoded_bytes(file));
    let what = format_args!("the picture `{}` of {}x{} pixels", path.display(), size.width, size.height);
    memory::require(what, bytes, "name a smaller picture")
}

/// Writes all files of a result together, and says where they are.
pub(super) fn write_folder(mut set: FileSet, files: &[(String, Vec<u8>)]) -> Result<Vec<PathBuf>, Problem> {
    for (name, bytes) in files {
        set.write(Path::new(name), |out| out.write_all(bytes))?;
    }
    Ok(set.commit()?)
}
