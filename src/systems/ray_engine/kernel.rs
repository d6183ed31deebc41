//! The choice of an intersection program for a device.

use refsim::device::{Profile, Rules};
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::texture::TexelFormat;

use super::EngineError;
use super::kernels;
use super::range::Range;
use crate::card::KernelText;
use crate::geom::exact::Sides;

/// Kind of rays that a program handles; determines its textures and constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `ps_1_4`, rays of one origin: the vertex program computes `ao`.
    OneOrigin,
    /// `ps_1_4`, rays of any origin, in [-1, 1].
    AnyOrigin,
    /// `ps_2_0`, rays of any origin in float textures.
    Float,
}

/// Evaluation of an edge shared by two triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeRule {
    /// As in the paper: each triangle tests the edge relative to its own corner a. Rounding may put a ray outside both
    /// triangles.
    Paper,
    /// Each triangle tests the edge from the edge's two corners in a fixed orientation, so both triangles get the same
    /// bits and no ray is outside both. Supports rays of one origin on `ps_1_4`, and of any origin on `ps_2_0`.
    SharedEdges,
}

/// Encoding of a component x in ray textures of `ps_1_4` programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayTexels {
    /// Two channels of 16 bits, unsigned: (x + 1) / 2.
    Unsigned,
    /// Two channels of 16 bits, signed.
    Signed,
    /// Signed bytes, in one texture of origins and one of directions, as in section 4.1.
    Bytes,
}

/// Intersection program, accepted by a device.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// Kind of rays that it handles.
    pub form: Form,
    /// File name of the pixel program.
    pub name: &'static str,
    /// Vertex program: triangle set-up.
    pub vertex: CheckedProgram,
    /// Pixel program: intersection.
    pub pixel: CheckedProgram,
    /// Encoding of rays in the program's textures, for `ps_1_4` forms only.
    pub texels: RayTexels,
    /// `true` if the vertex program culls by the bucket of rays.
    pub culls: bool,
    /// Evaluation of shared edges.
    pub edges: EdgeRule,
}

impl Kernel {
    /// Chooses the program for a device: `ps_2_0` if supported, otherwise `ps_1_4`. A device without limits runs
    /// `ps_1_4` in fixed-point formats, like the cards of the time. Fails with [`EngineError::NoKernel`] if the device
    /// runs neither.
    pub fn choose(profile: &Profile, one_origin: bool, sides: Sides) -> Result<Self, EngineError> {
        let versions = &profile.limits.versions;
        let has = |version| versions.contains(&version);
        let fixed = profile.rules.format.is_fixed();
        if has(Version::Ps2_0) && !(fixed && has(Version::Ps1_4)) {
            let pixel = if sides == Sides::Front { kernels::FLOAT } else { kernels::FLOAT_BOTH };
            return Self::load(profile, Form::Float, kernels::SEVEN_VECTORS_SETUP, pixel, RayTexels::Signed);
        }
        if !has(Version::Ps1_4) {
            return Err(EngineError::NoKernel { device: profile.name.clone() });
        }
        let signed = profile.limits.texture_formats.contains(&TexelFormat::Rg16Snorm);
        let texels = if signed { RayTexels::Signed } else { RayTexels::Unsigned };
        let pick = |unsigned: KernelText, with_sign: KernelText| if signed { with_sign } else { unsigned };
        if one_origin {
            let setup = if sides == Sides::Front { kernels::ONE_ORIGIN_SETUP } else { kernels::ONE_ORIGIN_BOTH_SETUP };
            let pixel = pick(kernels::ONE_ORIGIN_UNSIGNED, kernels::ONE_ORIGIN_SIGNED);
            return Self::load(profile, Form::OneOrigin, setup, pixel, texels);
        }
        let pixel = if sides == Sides::Front {
            pick(kernels::ANY_ORIGIN_UNSIGNED, kernels::ANY_ORIGIN_SIGNED)
        } else {
            pick(kernels::ANY_ORIGIN_BOTH_UNSIGNED, kernels::ANY_ORIGIN_BOTH_SIGNED)
        };
        Self::load(profile, Form::AnyOrigin, kernels::ANY_ORIGIN_SETUP, pixel, texels)
    }

    /// Chooses the program for [`EdgeRule::SharedEdges`]. Fails with [`EngineError::NoKernel`] if the device runs no
    /// intersection program, and with [`EngineError::NoSharedEdges`] if it runs one for these rays, but not with shared
    /// edges.
    pub fn with_shared_edges(profile: &Profile, one_origin: bool, sides: Sides) -> Result<Self, EngineError> {
        let paper = Self::choose(profile, one_origin, sides)?;
        let front = sides == Sides::Front;
        let (setup, pixel) = match paper.form {
            Form::AnyOrigin => return Err(EngineError::NoSharedEdges { device: profile.name.clone() }),
            Form::OneOrigin => (
                if front { kernels::ONE_ORIGIN_SHARED_SETUP } else { kernels::ONE_ORIGIN_BOTH_SHARED_SETUP },
                match paper.texels {
                    RayTexels::Unsigned => kernels::ONE_ORIGIN_SHARED_UNSIGNED,
                    _ => kernels::ONE_ORIGIN_SHARED_SIGNED,
                },
            ),
            Form::Float => (
                kernels::SEVEN_VECTORS_SHARED_SETUP,
                if front { kernels::FLOAT_SHARED } else { kernels::FLOAT_BOTH_SHARED },
            ),
        };
        let shared = Self::load(profile, paper.form, setup, pixel, paper.texels)?;
        Ok(Self { edges: EdgeRule::SharedEdges, ..shared })
    }

    /// Chooses the program for rays of any origin that are stored as bytes. Fails with [`EngineError::NoByteRays`] if
    /// both faces can be hit or the device stores rays as floats, and as [`Self::choose`] does.
    pub fn with_byte_rays(profile: &Profile, sides: Sides) -> Result<Self, EngineError> {
        match (Self::choose(profile, false, sides)?.form, sides) {
            (Form::AnyOrigin, Sides::Front) => {
                let (setup, pixel) = (kernels::ANY_ORIGIN_SETUP, kernels::ANY_ORIGIN_BYTES);
                Self::load(profile, Form::AnyOrigin, setup, pixel, RayTexels::Bytes)
            }
            _ => Err(EngineError::NoByteRays { device: profile.name.clone() }),
        }
    }

    /// The program's form, and the range of its intermediates.
    pub(super) fn numbers(&self, rules: &Rules) -> (Form, Range) {
        let range = Range::of_pixels(rules);
        (self.form, if self.texels == RayTexels::Bytes { range.with_byte_texels() } else { range })
    }

    /// Chooses the program for passes of rays of any origin, with or without culling by the bucket.
    pub(super) fn for_passes(profile: &Profile, sides: Sides, cull: bool) -> Result<Self, EngineError> {
        let plain = Self::choose(profile, false, sides)?;
        if !cull {
            return Ok(plain);
        }
        let setup = match plain.form {
            Form::Float => kernels::SEVEN_VECTORS_BUCKET_SETUP,
            _ => kernels::ANY_ORIGIN_BUCKET_SETUP,
        };
        Ok(Self { vertex: setup.checked(profile)?, culls: true, ..plain })
    }

    fn load(
        profile: &Profile,
        form: Form,
        setup: KernelText,
        pixel: KernelText,
        texels: RayTexels,
    ) -> Result<Self, EngineError> {
        Ok(Self {
            form,
            name: pixel.name,
            vertex: setup.checked(profile)?,
            pixel: pixel.checked(profile)?,
            texels,
            culls: false,
            edges: EdgeRule::Paper,
        })
    }
}
