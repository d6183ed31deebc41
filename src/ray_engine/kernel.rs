//! Which program a device runs.

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::texture::TexelFormat;

use super::EngineError;
use super::kernels::{self, KernelText};
use crate::geom::exact::Sides;

/// Which rays a program serves, and what its texture and constants are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `ps_1_4`, rays of one origin: the vertex program knows `ao`.
    OneOrigin,
    /// `ps_1_4`, rays of any origin, in [-1, 1].
    AnyOrigin,
    /// `ps_2_0`, rays of any origin in float textures.
    Float,
}

/// An intersection program that its device accepts.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// Which rays it serves.
    pub form: Form,
    /// The pixel program's file.
    pub name: &'static str,
    /// Triangle set-up.
    pub vertex: CheckedProgram,
    /// Intersection.
    pub pixel: CheckedProgram,
    /// Whether ray textures hold signed codes; else a component x is stored as (x + 1) / 2. Of `ps_1_4` forms only.
    pub signed_rays: bool,
    /// Whether the vertex program culls by the bucket of rays.
    pub culls: bool,
    /// Whether colour is (u, v, w, place) and not an id.
    pub weights: bool,
}

impl Kernel {
    /// The program for a device: `ps_2_0` where it is to be had, else `ps_1_4`. A device without limits runs `ps_1_4`
    /// in fixed-point formats, as the cards did.
    ///
    /// # Errors
    /// [`EngineError::NoKernel`] if the device runs neither.
    pub fn choose(profile: &Profile, one_origin: bool, sides: Sides) -> Result<Self, EngineError> {
        let versions = &profile.limits.versions;
        let has = |version| versions.contains(&version);
        let fixed = profile.rules.format.is_fixed();
        if has(Version::Ps2_0) && !(fixed && has(Version::Ps1_4)) {
            let pixel = if sides == Sides::Front { kernels::FLOAT } else { kernels::FLOAT_BOTH };
            return Self::load(profile, Form::Float, kernels::SEVEN_VECTORS_SETUP, pixel, true);
        }
        if !has(Version::Ps1_4) {
            return Err(EngineError::NoKernel { device: profile.name.clone() });
        }
        let signed = profile.limits.texture_formats.iter().any(|f| f == "rg16s");
        let pick = |unsigned: KernelText, with_sign: KernelText| if signed { with_sign } else { unsigned };
        if one_origin {
            let setup = if sides == Sides::Front { kernels::ONE_ORIGIN_SETUP } else { kernels::ONE_ORIGIN_BOTH_SETUP };
            let pixel = pick(kernels::ONE_ORIGIN_UNSIGNED, kernels::ONE_ORIGIN_SIGNED);
            return Self::load(profile, Form::OneOrigin, setup, pixel, signed);
        }
        let pixel = if sides == Sides::Front {
            pick(kernels::ANY_ORIGIN_UNSIGNED, kernels::ANY_ORIGIN_SIGNED)
        } else {
            pick(kernels::ANY_ORIGIN_BOTH_UNSIGNED, kernels::ANY_ORIGIN_BOTH_SIGNED)
        };
        Self::load(profile, Form::AnyOrigin, kernels::ANY_ORIGIN_SETUP, pixel, signed)
    }

    /// The program for passes of rays of any origin: one that culls by the bucket, one that gives barycentric
    /// coordinates, or both. A card without float programs and targets gives ids.
    ///
    /// # Errors
    /// As [`Kernel::choose`].
    pub fn for_passes(profile: &Profile, sides: Sides, cull: bool, weights: bool) -> Result<Self, EngineError> {
        let plain = Self::choose(profile, false, sides)?;
        let targets = &profile.limits.target_formats;
        let weights = weights && plain.form == Form::Float && targets.iter().any(|f| f == TexelFormat::Rgba32f.name());
        if !cull && !weights {
            return Ok(plain);
        }
        let setup = match plain.form {
            Form::Float => kernels::SEVEN_VECTORS_BUCKET_SETUP,
            _ => kernels::ANY_ORIGIN_BUCKET_SETUP,
        };
        let vertex = checked(profile, setup)?;
        if !weights {
            return Ok(Self { vertex, culls: cull, ..plain });
        }
        let pixel = if sides == Sides::Front { kernels::FLOAT_UVW } else { kernels::FLOAT_UVW_BOTH };
        Ok(Self { vertex, pixel: checked(profile, pixel)?, name: pixel.name, culls: cull, weights, ..plain })
    }

    /// Whether the vertex program wants the constants of a bucket.
    pub(super) fn takes_bucket(&self) -> bool {
        self.culls || self.weights
    }

    fn load(
        profile: &Profile,
        form: Form,
        setup: KernelText,
        pixel: KernelText,
        signed_rays: bool,
    ) -> Result<Self, EngineError> {
        Ok(Self {
            form,
            name: pixel.name,
            vertex: checked(profile, setup)?,
            pixel: checked(profile, pixel)?,
            signed_rays,
            culls: false,
            weights: false,
        })
    }
}

/// A program of this folder, judged by the device's own rules.
pub(super) fn checked(profile: &Profile, kernel: KernelText) -> Result<CheckedProgram, EngineError> {
    let refused = |problem: String| EngineError::Refused { kernel: kernel.name, device: profile.name.clone(), problem };
    let program = assemble(kernel.text).map_err(|e| refused(e.to_string()))?;
    check(program, profile).map_err(|e| refused(e.to_string()))
}
