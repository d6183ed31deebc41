//! Random rules: families of number formats, groups of switches.

use crate::random::Random;
use refsim::device::{
    AddMode, BorderStorage, ColorClamp, ColorIterator, ConstantStorage, FilterArithmetic, LrpMode, MadMode,
    MissingChannels, Profile, SignedTexelMinimum, SubpixelGrid, SubpixelRounding, TargetRounding, TexcrdOverflow,
    TexdepthDenominator, TexelValues, TexkillComponents, WeightRounding,
};
use refsim::num::{DotOrder, Format, Rounding};
use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};
use strum::{IntoStaticStr, VariantArray};

/// Formats that share an implementation.
#[derive(Clone, Copy, Debug, IntoStaticStr, PartialEq, Eq, VariantArray)]
#[strum(serialize_all = "snake_case")]
pub(crate) enum Family {
    S3_12,
    ShortFixed,
    LongFixed,
    Fp16,
    Fp24,
    Fp32,
    OddFloat,
    /// Units of cards.
    Units,
}

impl Family {
    pub(crate) fn formats(self) -> Vec<&'static str> {
        let words = match self {
            Self::S3_12 => "s3.12 s3.12:rna s3.12:rtz s3.12:rdn s3.12:wrap s3.12:rdn:wrap s3.12:rna:wrap",
            Self::ShortFixed => {
                "s1.10 s0.8 s7.8 s1.10:rtz s0.15:wrap s2.5:rna s1.6:rdn:wrap n3.8:rna n2.6:rtz s1.10:rup \
                 s0.8:rup n3.8:rup n2.6:rup:wrap"
            }
            Self::LongFixed => "s7.16 s15.16:rtz s0.31 s8.20:rdn s15.0:rna s7.24:wrap s7.16:rup s15.16:rup",
            Self::Fp16 => "fp16 fp16:rtz fp16:ftz:nvovf:nv fp16:sat fp16:rna fp16:rdn:ftz",
            Self::Fp24 => "fp24 fp24:ftz fp24:rtz fp24:rdn:sat fp24:rna fp24:nvovf:nv",
            Self::Fp32 => "fp32 fp32:ftz fp32:rtz fp32:nv:nvovf fp32:sat fp32:rna:ftz fp32:rdn",
            Self::OddFloat => {
                "e4m3fn bf16 e5m2fnuz:sat e3m4 e8m10 e7m16fn:rup:nv e8m10:rna fp16:rup:ftz e5m2 fp24:rod \
                 e6m9:rtz e2m3fn:nv e4m3:sat e7m10:ftz"
            }
            Self::Units => "e8m23:nv2x e8m23:nv3x e8m23:nv3x-legacy e8m23:gt200 e8m23:gt200:rtz e8m23:gt200-zero-wins",
        };
        words.split(' ').collect()
    }
}

/// Rules that vary together.
#[derive(Clone, Copy, Debug, IntoStaticStr, PartialEq, Eq, VariantArray)]
#[strum(serialize_all = "snake_case")]
pub(crate) enum Group {
    /// Arithmetic of instructions.
    Arithmetic,
    /// Results of texture instructions.
    Sampling,
    /// Stages before and after the program.
    Pipeline,
    /// All of them.
    Together,
}

impl Group {
    fn has(self, part: Self) -> bool {
        self == part || self == Self::Together
    }
}

/// A profile by name; each is read only once.
pub(crate) fn profile(name: &str) -> Profile {
    static READ: LazyLock<Mutex<BTreeMap<String, Profile>>> = LazyLock::new(Mutex::default);
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = read.get(name) {
        return known.clone();
    }
    let fresh = Profile::named(name).unwrap_or_else(|e| panic!("{name}: {e}"));
    read.insert(name.to_owned(), fresh.clone());
    fresh
}

fn format(text: &str) -> Format {
    text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// An ideal device with random rules of the group; the seed selects a format of the family.
pub(crate) fn ideal(family: Family, group: Group, seed: u64, r: &mut Random) -> Profile {
    let mut profile = profile("ideal-fp32");
    let formats = family.formats();
    let name = formats[(seed % formats.len() as u64) as usize];
    profile.set_format(format(name)).expect("a format of registers");
    profile.name = format!("ideal-{name}");
    let rules = &mut profile.rules;
    if group.has(Group::Arithmetic) {
        let partial = [None, Some("fp16"), Some("fp16:rtz:nv"), Some("s1.10"), Some("fp32"), Some("e4m3fn")];
        rules.partial = r.of(&partial).map(format);
        if r.one_in(4) {
            rules.vertex_format = format(r.of(&["fp32:rtz", "fp24", "s7.16", "fp32:ftz"]));
        }
        rules.constant_storage = r.of(ConstantStorage::ALL);
        rules.mad = r.of(MadMode::ALL);
        let aligned = DotOrder::Aligned(r.below(29u8));
        rules.dot = r.of(&[DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact, aligned]);
        if r.one_in(2) {
            let roundings = [Rounding::NearestEven, Rounding::NearestAway, Rounding::TowardZero, Rounding::Down];
            rules.product_rounding = Some(r.of(&roundings));
        }
        if r.one_in(3) {
            rules.add = AddMode::Aligned(r.below(29u8));
        }
        rules.lrp = r.of(LrpMode::ALL);
        rules.zero_times_anything = r.one_in(3);
        rules.vertex_zero_times_anything = r.one_in(3);
    }
    if group.has(Group::Sampling) {
        rules.texcrd_overflow = r.of(TexcrdOverflow::ALL);
        rules.texdepth_denominator = r.of(TexdepthDenominator::ALL);
        rules.signed_texel_minimum = r.of(SignedTexelMinimum::ALL);
        rules.filter_fraction_bits = r.of(&[0, 4, 5, 6, 8, 12]);
        rules.lod_fraction_bits = r.of(&[0, 4, 5, 6, 8]);
        rules.filter_weight_rounding = r.of(WeightRounding::ALL);
        rules.filter_arithmetic = r.of(FilterArithmetic::ALL);
        rules.texel_values = r.of(TexelValues::ALL);
        rules.missing_channels = r.of(MissingChannels::ALL);
        rules.border_storage = r.of(BorderStorage::ALL);
    }
    if group.has(Group::Pipeline) {
        if r.one_in(4) {
            rules.iterator_format = format(r.of(&["fp24", "s7.16", "fp16", "fp32:rtz"]));
        }
        let bits = r.of(&[8, 12, 1, 16]);
        rules.color_iterator = r.of(&[ColorIterator::Full, ColorIterator::Unorm(bits)]);
        rules.texkill_components = r.of(TexkillComponents::ALL);
        rules.target_rounding = r.of(TargetRounding::ALL);
        rules.depth_rounding = r.of(TargetRounding::ALL);
        rules.subpixel_grid =
            r.of(&[SubpixelGrid::Bits(0), SubpixelGrid::Bits(4), SubpixelGrid::Twelfths, SubpixelGrid::Bits(8)]);
        rules.subpixel_rounding = r.of(SubpixelRounding::ALL);
        rules.color_clamp = r.of(ColorClamp::ALL);
    }
    profile
}

/// Vertex programs in a format of the family, pixel programs in fp32.
pub(crate) fn vertex_ideal(family: Family, group: Group, seed: u64, r: &mut Random) -> Profile {
    let mut profile = ideal(Family::Fp32, group, seed, r);
    let formats = family.formats();
    profile.rules.vertex_format = format(formats[(seed % formats.len() as u64) as usize]);
    profile
}

/// A card with random settings of all switches.
pub(crate) fn card(name: &str, r: &mut Random) -> Profile {
    let mut profile = profile(name);
    let switches: Vec<(String, String)> =
        profile.switches().iter().map(|s| (s.name.clone(), s.values[r.below(s.values.len())].clone())).collect();
    for (name, value) in switches {
        profile.set_switch(&name, &value).unwrap_or_else(|e| panic!("{name} = {value}: {e}"));
    }
    profile
}
