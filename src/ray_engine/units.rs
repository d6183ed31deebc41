//! The scene in the units of a card, by powers of two; and rays as textures.

use refsim::texture::{Image, TexelFormat, TextureError, TextureKind};

use super::rays::{ceil_power_of_two, normalise_range, scale_into};
use super::{Form, Kernel, RayBatch};
use crate::geom::{Mesh, Ray};

/// What positions are multiplied by on the way to the card, and what depth 1 means there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    form: Form,
    /// Card units in a scene unit; a power of two.
    scale: f64,
    /// The t of depth 1, in card units and for directions brought into range; a power of two.
    t_max: f64,
    /// The common origin, in card units.
    origin: [f32; 3],
}

/// The largest component that s3.12 is sure to hold.
const REGISTER_RANGE: f64 = 7.999;
/// Depth 1 means no hit, so that the largest t must stay below it, rounded as it may be.
const ROOM: f64 = 1.0 + 1e-3;
/// What `any_origin_*.psa` divides t by.
const ANY_ORIGIN_T_MAX: f64 = 4.0;

impl Units {
    /// The largest scale at which everything fits the registers, textures and depth range of a program.
    pub(super) fn choose(form: Form, mesh: &Mesh, rays: &RayBatch) -> Self {
        Self::within(form, mesh.bounds().unwrap_or_default(), rays)
    }

    /// The same for a mesh of which these are the lowest and the highest coordinates.
    pub(super) fn within(form: Form, bounds: [[f32; 3]; 2], rays: &RayBatch) -> Self {
        let reach = Reach::of(bounds, rays);
        let scale = match form {
            // Registers hold o - a.
            Form::OneOrigin => scale_into(reach.offset, REGISTER_RANGE),
            // Textures hold o, registers a and o - a, depth t / 4.
            Form::AnyOrigin => scale_into(reach.origin, 1.0)
                .min(scale_into(reach.position.max(reach.offset), REGISTER_RANGE))
                .min(scale_into(reach.t, ANY_ORIGIN_T_MAX)),
            Form::Float => 1.0,
        };
        let t_max = match form {
            Form::AnyOrigin => ANY_ORIGIN_T_MAX,
            Form::OneOrigin | Form::Float => ceil_power_of_two(reach.t * scale),
        };
        let origin = rays.common_origin().unwrap_or_default().map(|x| (f64::from(x) * scale) as f32);
        Self { form, scale, t_max, origin }
    }

    /// Card units in a scene unit; a power of two.
    pub(super) const fn scale(&self) -> f64 {
        self.scale
    }

    /// `c0` is the program's own; `c1` scene scale, edge scale, 1 / t_max; `c2` the common origin.
    pub(super) fn vertex_constants(&self) -> Vec<[u32; 4]> {
        let [x, y, z] = self.origin;
        let c1 = [self.scale as f32, 1.0, (1.0 / self.t_max) as f32, 0.0];
        [[0.0; 4], c1, [x, y, z, 0.0]].map(|c| c.map(f32::to_bits)).to_vec()
    }

    /// `c0.x` is 1 / t_max for `ps_2_0`; `ps_1_4` programs bring their own constant.
    pub(super) fn pixel_constants(&self) -> Vec<[u32; 4]> {
        match self.form {
            Form::Float => vec![[((1.0 / self.t_max) as f32).to_bits(), 0, 0, 0]],
            _ => Vec::new(),
        }
    }

    /// t in multiples of the ray's own direction, from a depth.
    pub(super) fn t(&self, depth: f32, ray: &Ray) -> f32 {
        let (_, power) = normalise_range(ray.direction());
        (f64::from(depth) * self.t_max / self.scale * power) as f32
    }
}

/// The largest magnitudes of a scene.
struct Reach {
    /// Of a component of a corner.
    position: f64,
    /// Of a component of an origin.
    origin: f64,
    /// Of a component of origin minus corner.
    offset: f64,
    /// Of t, for directions brought into range.
    t: f64,
}

impl Reach {
    fn of(bounds: [[f32; 3]; 2], rays: &RayBatch) -> Self {
        let [low, high] = bounds.map(|p| p.map(f64::from));
        let mut reach = Self { position: 0.0, origin: 0.0, offset: 0.0, t: 0.0 };
        for axis in 0..3 {
            reach.position = reach.position.max(low[axis].abs()).max(high[axis].abs());
        }
        for ray in rays.rays() {
            let origin = ray.origin().map(f64::from);
            let mut square = 0.0;
            for axis in 0..3 {
                reach.origin = reach.origin.max(origin[axis].abs());
                let offset = (origin[axis] - low[axis]).abs().max((origin[axis] - high[axis]).abs());
                reach.offset = reach.offset.max(offset);
                square += offset * offset;
            }
            // The largest component of a direction in range is at least 1/2, so a corner at distance r is met at
            // t <= 2 r; along its own length, at t <= r / |d|.
            let (d, _) = normalise_range(ray.direction());
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
            reach.t = reach.t.max(square.sqrt() / length * ROOM);
        }
        reach
    }
}

/// The textures of a program's head comment, with the samplers that they belong to.
pub(super) fn ray_textures(
    kernel: &Kernel,
    rays: &RayBatch,
    units: &Units,
) -> Result<Vec<(usize, Image)>, TextureError> {
    let directions: Vec<[f64; 3]> = rays.rays().iter().map(|r| normalise_range(r.direction()).0).collect();
    let origin = |r: &Ray| r.origin().map(|x| f64::from(x) * units.scale);
    if kernel.form == Form::Float {
        let origins: Vec<[f64; 3]> = match rays.common_origin() {
            // Section 4.1: rays of one origin need a single texel.
            Some(_) => rays.rays().first().map(origin).into_iter().collect(),
            None => rays.rays().iter().map(origin).collect(),
        };
        let size = if origins.len() == 1 { [1, 1, 1] } else { extents(rays) };
        return Ok(vec![(0, float_texture(size, &origins)?), (1, float_texture(extents(rays), &directions)?)]);
    }
    let pairs = |pair: &dyn Fn(usize) -> [f64; 2]| {
        let texels = (0..directions.len()).map(pair);
        pair_texture(kernel.signed_rays, extents(rays), texels)
    };
    let xy = pairs(&|i| [directions[i][0], directions[i][1]])?;
    if kernel.form == Form::OneOrigin {
        return Ok(vec![(1, xy), (2, pairs(&|i| [directions[i][2], 0.0])?)]);
    }
    let origins: Vec<[f64; 3]> = rays.rays().iter().map(origin).collect();
    Ok(vec![
        (0, pairs(&|i| [origins[i][0], origins[i][1]])?),
        (1, xy),
        (4, pairs(&|i| [origins[i][2], directions[i][2]])?),
    ])
}

fn extents(rays: &RayBatch) -> [u32; 3] {
    [rays.width(), rays.height(), 1]
}

/// Four fp32 channels: x, y, z, 1.
fn float_texture(extents: [u32; 3], vectors: &[[f64; 3]]) -> Result<Image, TextureError> {
    let texel = |v: &[f64; 3]| [v[0] as f32, v[1] as f32, v[2] as f32, 1.0];
    let mut bytes = Vec::with_capacity(16 * vectors.len());
    for value in vectors.iter().flat_map(texel) {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    Image::from_bytes(TexelFormat::Rgba32f, TextureKind::D2, extents, 1, bytes)
}

/// Two 16-bit channels, each component rounded to the nearest code.
fn pair_texture(signed: bool, extents: [u32; 3], pairs: impl Iterator<Item = [f64; 2]>) -> Result<Image, TextureError> {
    let code = |x: f64| {
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
