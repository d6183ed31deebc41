//! Limits of a device on a system's programs and textures: texels per block, texels per side.

use refsim::device::Profile;
use refsim::isa::Version;
use refsim::texture::TexelFormat;

use crate::card::CardError;
use crate::error::InputError;
use crate::radiosity::card_system::CardSystem;
use crate::radiosity::kernels;
use crate::radiosity::packing::{self, Packing};
use crate::radiosity::{System, model};

/// Maximum texels per side if a device states no limit: the largest image.
const MAX_TEXELS: usize = 16384;

/// The number format of textures and registers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum Storage {
    /// Single floats throughout.
    #[default]
    Fp32,
    /// Half floats in textures, targets and registers; coordinates stay single floats.
    Fp16,
}

impl Storage {
    /// Texel format of matrices and vectors.
    pub fn format(self) -> TexelFormat {
        match self {
            Self::Fp32 => TexelFormat::Rgba32f,
            Self::Fp16 => TexelFormat::Rgba16f,
        }
    }
}

/// The limits of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fit {
    /// Maximum number of texels per block in a program of the device's maximum length.
    pub block: usize,
    /// Maximum number of texels along a side of matrix and vector.
    pub limit: usize,
}

impl Fit {
    /// Limits of a device. A block is 254 texels on the paper's card.
    pub fn of(profile: &Profile, packing: Packing) -> Result<Self, CardError> {
        let (instructions, limit) = limits(profile)?;
        let blocks = kernels::of(packing, false).map(|kernel| kernel.block(instructions));
        Ok(Self { block: blocks[0].min(blocks[1]).max(1), limit })
    }

    /// Checks the size of a system before its form factors are computed, which takes a long time.
    pub fn require(self, profile: &Profile, packing: Packing, patches: usize) -> Result<(), CardError> {
        let size = packing.matrix_texels(patches);
        if size[0].max(size[1]) <= self.limit {
            return Ok(());
        }
        Err(too_large(profile, packing::too_large("a matrix", self.limit, size)))
    }

    /// Lays out a system for the device: one system of three channels, or three systems of one channel.
    pub fn systems(self, profile: &Profile, packing: Packing, system: &System) -> Result<Vec<CardSystem>, CardError> {
        let made = match packing {
            Packing::Rgb => CardSystem::rgb(system, self.block, self.limit).map(|one| vec![one]),
            Packing::Luminance => {
                let channel =
                    |c| CardSystem::luminance(system.matrix(c), &system.right_hand_side(c), self.block, self.limit);
                (0..3).map(channel).collect()
            }
        };
        made.map_err(|problem| too_large(profile, problem))
    }
}

/// Maximum number of instructions of a program, and of texels per side.
pub(super) fn limits(profile: &Profile) -> Result<(usize, usize), CardError> {
    let limits = &profile.limits;
    if !limits.versions.contains(&Version::Fp1_0) {
        return Err(no_programs(profile));
    }
    let instructions = limits.fragment_instructions.unwrap_or(model::MAX_INSTRUCTIONS) as usize;
    // A vector is a target and a texture, and a matrix is as wide as a vector is long, so both limits apply.
    let sides = [limits.max_texture_size, limits.max_target_size].into_iter().flatten();
    Ok((instructions, sides.min().map_or(MAX_TEXELS, |side| side as usize)))
}

pub(super) fn too_large(profile: &Profile, problem: InputError) -> CardError {
    CardError::input(format!("device `{}`: {problem}", profile.name))
}

/// The error for a device without a shader version for such programs.
fn no_programs(profile: &Profile) -> CardError {
    let runs = |name: &&str| Profile::named(name).is_ok_and(|p| p.limits.versions.contains(&Version::Fp1_0));
    let mut have: Vec<&str> = Profile::card_names().into_iter().filter(runs).collect();
    have.push("ideal-<format>");
    let chain = |reads: u32| {
        format!(
            " (its programs allow {reads} dependent reads in a chain (limits.dependent_reads); a block has hundreds)"
        )
    };
    let why = profile.limits.dependent_reads.map_or_else(String::new, chain);
    CardError::input(format!(
        "device `{}` runs no `!!FP1.0` programs, in which the passes are written{why}; expected one of {}",
        profile.name,
        have.join(", ")
    ))
}
