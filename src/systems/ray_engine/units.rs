//! Scale of a scene in card units, by powers of two, and upload of rays as textures.
//!
//! Registers, ray textures and depth buffer of a card have different ranges. Powers of two scale rays and scene into
//! these ranges, which loses no bit of the input before the card rounds it.

use glam::DVec3;
use refsim::texture::{Image, TexelFormat, TextureError, TextureKind};

use super::range::{BYTE_CODES, Range};
use super::reach::{Reach, VectorRange, inner, largest, mixed, most_of_partial_sums};
use super::{EdgeRule, Form, Kernel, RayBatch, RayTexels};
use crate::error::InputError;
use crate::geom::vector::{narrow, wide};
use crate::geom::{Mesh, Ray};
use crate::tracer::scale::{ceil_power_of_two, in_single_precision, normalize_range, scale_into};

/// Scale of positions on the card, and the t of depth 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    form: Form,
    range: Range,
    /// Card units per scene unit; a power of two.
    scale: f64,
    t_max: f64,
    origins: VectorRange,
    directions: VectorRange,
    origin: [f32; 3],
}

/// Divisor of t in `any_origin_*.psa`.
const ANY_ORIGIN_T_MAX: f64 = 4.0;

impl Units {
    /// Chooses the largest scale at which all values fit the registers, textures and depth range of a program.
    pub(super) fn choose((form, range): (Form, Range), mesh: &Mesh, rays: &RayBatch) -> Self {
        Self::within((form, range), mesh.bounds().unwrap_or_default(), rays)
    }

    /// Like [`Self::choose`], for a mesh with these lowest and highest coordinates.
    pub(super) fn within((form, range): (Form, Range), bounds: [[f32; 3]; 2], rays: &RayBatch) -> Self {
        let reach = Reach::of(bounds, rays);
        // Registers hold o - a and its cross product with d.
        let offsets =
            || scale_into(reach.offset, range.of_vectors()).min(scale_into(reach.cross, range.of_cross_products()));
        let scale = match form {
            Form::OneOrigin => offsets(),
            // Ray textures hold the origin o, registers the corner a, the depth buffer t / 4.
            Form::AnyOrigin => scale_into(reach.origin, range.of_texels())
                .min(scale_into(reach.position, range.of_vectors()))
                .min(offsets())
                .min(scale_into(reach.t, ANY_ORIGIN_T_MAX)),
            Form::Float => {
                let [corners, offsets] = range.of_float_scenes();
                scale_into(reach.position, corners).min(scale_into(reach.offset.max(reach.origin), offsets))
            }
        };
        let scale = in_single_precision(scale);
        let t_max = match form {
            Form::AnyOrigin => ANY_ORIGIN_T_MAX,
            Form::OneOrigin | Form::Float => ceil_power_of_two(reach.t * scale),
        };
        let origins = reach.origins.times(scale);
        let origin = narrow(wide(rays.common_origin().unwrap_or_default()) * scale);
        Self { form, range, scale, t_max, origins, directions: reach.directions, origin }
    }

    /// Card units per scene unit; a power of two.
    pub(super) const fn scale(&self) -> f64 {
        self.scale
    }

    /// The t of depth 1, in card units and for directions brought into range; a power of two.
    pub(super) const fn t_max(&self) -> f64 {
        self.t_max
    }

    /// Edge scale of a triangle, by which the vertex program multiplies its edges and normal: a power of two that
    /// brings u, v, w, n.d and n.ao, times this scale, into the range of the format for every ray of the batch.
    pub(super) fn edge_scale(&self, corners: [[f32; 3]; 3]) -> f64 {
        if !self.range.has_edge_scale() {
            return 1.0;
        }
        let [a, b, c] = corners.map(|corner| wide(corner) * self.scale);
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let n = ab.cross(ac);
        let (texel, error) = (self.range.texel_error(), self.range.cross_product_error());
        let (ao, bo, d) = (self.origins.minus(a), self.origins.minus(b), self.directions);
        let components = [ab, ac, bc, n].map(largest).into_iter().fold(0.0, f64::max);
        let scale = |sum: f64| self.range.edge_scale(sum.max(components), largest(n));

        // The sum of all terms' magnitudes bounds every partial sum; this coarse bound suffices for most triangles.
        let [ao_most, bo_most, d_most] = [ao, bo, d].map(VectorRange::magnitudes);
        let [aod, bod] = [ao_most, bo_most].map(|v| mixed(v, d_most) + error);
        let n_d = inner(n, d_most + texel) * self.range.of_divisors();
        let n_ao = match self.form {
            Form::OneOrigin => inner(n, ao_most) / self.t_max,
            Form::AnyOrigin | Form::Float => inner(n, ao_most + texel + 2.0 * self.range.step),
        };
        let w = inner(bc, bod) + inner(n, DVec3::splat(texel));
        let terms = [n_d, n_ao, inner(ac, aod), inner(ab, aod), inner(bc, aod), w].into_iter().fold(0.0, f64::max);
        if scale(terms) == scale(0.0) {
            return scale(0.0);
        }

        let turned = |e: DVec3| most_of_partial_sums(e, |e| ao.triple(e, d)) + inner(e, DVec3::splat(error));
        // w is the difference of n.d and bc.aod, and has the errors of both.
        let w = bo.triple(bc, d) + inner(bc, DVec3::splat(error)) + inner(n, DVec3::splat(texel));
        let sums = [self.n_d(n), self.n_ao(n, a), turned(ac), turned(ab), turned(bc), w];
        scale(sums.into_iter().fold(0.0, f64::max))
    }

    /// Scale of an edge under [`EdgeRule::SharedEdges`]: a power of two, computed only from its two corners, that
    /// brings E = d . (e x (o - p)) and its operands into the range of the format.
    pub(super) fn shared_edge_scale(&self, p: [f32; 3], q: [f32; 3]) -> f64 {
        if !self.range.has_edge_scale() {
            return 1.0;
        }
        let [p, q] = [p, q].map(|corner| wide(corner) * self.scale);
        let (e, po, d) = (q - p, self.origins.minus(p), self.directions);
        match self.form {
            // Registers hold the moment e x (o - p).
            Form::OneOrigin => {
                let moment = e.cross(wide(self.origin) - p);
                let sum =
                    most_of_partial_sums(moment, |m| d.dot(m)) + inner(moment, DVec3::splat(self.range.texel_error()));
                self.range.own_scale(sum.max(largest(moment)), largest(moment))
            }
            // Registers hold e and (o - p) x d.
            Form::AnyOrigin | Form::Float => {
                let error = DVec3::splat(self.range.cross_product_error());
                let sum = most_of_partial_sums(e, |e| po.triple(e, d)) + inner(e, error);
                self.range.own_scale(sum.max(largest(e)), largest(e))
            }
        }
    }

    /// Scale of a normal for n.d and n.ao, if edges have their own scales.
    pub(super) fn normal_scale(&self, corners: [[f32; 3]; 3]) -> f64 {
        if !self.range.has_edge_scale() {
            return 1.0;
        }
        let [a, b, c] = corners.map(|corner| wide(corner) * self.scale);
        let n = (b - a).cross(c - a);
        let sum = self.n_d(n).max(self.n_ao(n, a));
        self.range.own_scale(sum.max(largest(n)), largest(n))
    }

    /// Bound on n.d, the divisor, and its partial sums.
    fn n_d(&self, n: DVec3) -> f64 {
        let sum =
            most_of_partial_sums(n, |n| self.directions.dot(n)) + inner(n, DVec3::splat(self.range.texel_error()));
        sum * self.range.of_divisors()
    }

    /// Bound on n.ao, or n.ao / t_max, and its partial sums.
    fn n_ao(&self, n: DVec3, a: DVec3) -> f64 {
        let ao = self.origins.minus(a);
        match self.form {
            // The vertex program computes n.ao / t_max in single precision.
            Form::OneOrigin => ao.dot(n) / self.t_max,
            Form::AnyOrigin | Form::Float => {
                let error = self.range.texel_error() + 2.0 * self.range.step;
                most_of_partial_sums(n, |n| ao.dot(n)) + inner(n, DVec3::splat(error))
            }
        }
    }

    /// Largest component of a triangle's normal in card units, and the step of the card's format.
    pub(super) fn largest_normal(&self, corners: [[f32; 3]; 3], edges: EdgeRule) -> (f64, f64) {
        let [a, b, c] = corners.map(|corner| wide(corner) * self.scale);
        let scale = match edges {
            EdgeRule::Paper => self.edge_scale(corners),
            EdgeRule::SharedEdges => self.normal_scale(corners),
        };
        (largest((b - a).cross(c - a)) * scale, self.range.step)
    }

    /// Vertex constants: the program defines `c0`; `c1` holds the scene scale, an unused number and 1 / t_max; `c2` is
    /// the common origin.
    pub(super) fn vertex_constants(&self) -> Vec<[u32; 4]> {
        let [x, y, z] = self.origin;
        let c1 = [self.scale as f32, 0.0, (1.0 / self.t_max) as f32, 0.0];
        [[0.0; 4], c1, [x, y, z, 0.0]].map(|c| c.map(f32::to_bits)).to_vec()
    }

    /// Pixel constants: `c0.x` is 1 / t_max for `ps_2_0`; `ps_1_4` programs define their own constant.
    pub(super) fn pixel_constants(&self) -> Vec<[u32; 4]> {
        match self.form {
            Form::Float => vec![[((1.0 / self.t_max) as f32).to_bits(), 0, 0, 0]],
            _ => Vec::new(),
        }
    }

    pub(super) fn in_bytes(&self, ray: &Ray) -> Result<Ray, InputError> {
        let held = |v: DVec3, scale: f64| narrow((v * scale).map(byte_code) / BYTE_CODES / scale);
        Ray::new(held(wide(ray.origin()), self.scale), held(normalize_range(ray.direction()).0, 1.0))
    }

    /// Converts a depth to t in multiples of the ray's own direction, exactly.
    pub(super) fn t(&self, depth: f32, ray: &Ray) -> f64 {
        let (_, power) = normalize_range(ray.direction());
        f64::from(depth) * self.t_max / self.scale * power
    }
}

/// Builds the textures listed in a program's head comment, with their samplers.
pub(super) fn ray_textures(
    kernel: &Kernel,
    rays: &RayBatch,
    units: &Units,
) -> Result<Vec<(usize, Image)>, TextureError> {
    let directions: Vec<DVec3> = rays.rays().iter().map(|r| normalize_range(r.direction()).0).collect();
    let origin = |r: &Ray| wide(r.origin()) * units.scale;
    if kernel.form == Form::Float || kernel.texels == RayTexels::Bytes {
        let origins: Vec<DVec3> = match rays.common_origin() {
            // Section 4.1: rays of one origin need a single texel.
            Some(_) => rays.rays().first().map(origin).into_iter().collect(),
            None => rays.rays().iter().map(origin).collect(),
        };
        let size = if origins.len() == 1 { [1, 1, 1] } else { extents(rays) };
        let texture = if kernel.form == Form::Float { float_texture } else { byte_texture };
        return Ok(vec![(0, texture(size, &origins)?), (1, texture(extents(rays), &directions)?)]);
    }
    let pairs = |pair: &dyn Fn(usize) -> [f64; 2]| {
        let texels = (0..directions.len()).map(pair);
        pair_texture(kernel.texels == RayTexels::Signed, units.range.of_texels(), extents(rays), texels)
    };
    let xy = pairs(&|i| [directions[i][0], directions[i][1]])?;
    if kernel.form == Form::OneOrigin {
        return Ok(vec![(1, xy), (2, pairs(&|i| [directions[i][2], 0.0])?)]);
    }
    let origins: Vec<DVec3> = rays.rays().iter().map(origin).collect();
    Ok(vec![
        (0, pairs(&|i| [origins[i][0], origins[i][1]])?),
        (1, xy),
        (4, pairs(&|i| [origins[i][2], directions[i][2]])?),
    ])
}

fn extents(rays: &RayBatch) -> [u32; 3] {
    [rays.width(), rays.height(), 1]
}

/// Builds a texture of four fp32 channels: x, y, z, 1.
fn float_texture(extents: [u32; 3], vectors: &[DVec3]) -> Result<Image, TextureError> {
    let mut bytes = Vec::with_capacity(16 * vectors.len());
    for value in vectors.iter().flat_map(|v| [v.x as f32, v.y as f32, v.z as f32, 1.0]) {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    Image::from_bytes(TexelFormat::Rgba32f, TextureKind::D2, extents, 1, bytes)
}

/// Code of a component in a signed byte. The largest code is 126, so that rounding does not scale a direction up to the
/// next power of two.
fn byte_code(x: f64) -> f64 {
    (x * BYTE_CODES).round().clamp(1.0 - BYTE_CODES, BYTE_CODES - 1.0)
}

/// Builds a texture of four signed bytes: x, y, z, 0.
fn byte_texture(extents: [u32; 3], vectors: &[DVec3]) -> Result<Image, TextureError> {
    let bytes = vectors.iter().flat_map(|v| [v.x, v.y, v.z, 0.0]).map(|x| byte_code(x) as i8 as u8).collect();
    Image::from_bytes(TexelFormat::Rgba8Snorm, TextureKind::D2, extents, 1, bytes)
}

/// Builds a texture of two 16-bit channels, each component rounded to the nearest code with a magnitude of at most
/// `most`.
fn pair_texture(
    signed: bool,
    most: f64,
    extents: [u32; 3],
    pairs: impl Iterator<Item = [f64; 2]>,
) -> Result<Image, TextureError> {
    let code = |x: f64| {
        let x = x.clamp(-most, most);
        if signed {
            ((x * 32_767.0).round() as i16).to_le_bytes()
        } else {
            (((x + 1.0) / 2.0 * 65_535.0).round() as u16).to_le_bytes()
        }
    };
    let mut bytes = Vec::with_capacity(4 * pairs.size_hint().0);
    for [x, y] in pairs {
        bytes.extend_from_slice(&code(x));
        bytes.extend_from_slice(&code(y));
    }
    let format = if signed { TexelFormat::Rg16Snorm } else { TexelFormat::Rg16 };
    Image::from_bytes(format, TextureKind::D2, extents, 1, bytes)
}
