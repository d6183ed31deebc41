//! Number syntax of cases.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{self, SeqAccess, Visitor, value::SeqAccessDeserializer},
};
use toml::Spanned;

pub(super) const ONE: u32 = 0x3f80_0000;

/// Number: a TOML integer or float, or a bit pattern of an IEEE single as text (`"0x3f800000"`).
#[derive(Clone, Copy, Debug)]
pub(super) enum Number {
    Value(f64),
    Bits(u32),
}

pub(super) trait Singles: Copy {
    type Bits;
    fn singles(self) -> Self::Bits;
}

impl Singles for Number {
    type Bits = u32;
    fn singles(self) -> u32 {
        self.single()
    }
}

impl<T: Singles, const N: usize> Singles for Exactly<T, N> {
    type Bits = [T::Bits; N];
    fn singles(self) -> Self::Bits {
        self.0.map(T::singles)
    }
}

impl Number {
    /// Converts to an IEEE single. NaN is the positive quiet one.
    pub(super) fn single(self) -> u32 {
        match self {
            Self::Bits(bits) => bits,
            Self::Value(value) if value.is_nan() => 0x7fc0_0000,
            // A cast rounds to nearest even, and gives infinity for numbers out of range.
            Self::Value(value) => (value as f32).to_bits(),
        }
    }

    pub(super) fn double(self) -> f64 {
        match self {
            Self::Bits(bits) => f64::from(f32::from_bits(bits)),
            Self::Value(value) => value,
        }
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or the bits of a single as \"0x3f800000\"")
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Number, E> {
        Ok(Number::Value(value as f64))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Number, E> {
        Ok(Number::Value(value as f64))
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Number, E> {
        Ok(Number::Value(value))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Number, E> {
        let digits = text
            .strip_prefix("0x")
            .filter(|digits| (1..=8).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
        digits
            .and_then(|digits| u32::from_str_radix(digits, 16).ok())
            .map(Number::Bits)
            .ok_or_else(|| E::invalid_value(de::Unexpected::Str(text), &self))
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberVisitor)
    }
}

/// List of exactly N elements. (serde's arrays accept longer lists and ignore the rest.)
#[derive(Clone, Copy, Debug)]
pub(super) struct Exactly<T, const N: usize>(pub(super) [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = Vec::<T>::deserialize(deserializer)?;
        let found = list.len();
        let wrong = |_| de::Error::custom(format!("expected {N} numbers, found {found}"));
        list.try_into().map(Self).map_err(wrong)
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(from = "OneOrSeveral")]
pub(super) struct OneOrMany(pub(super) Vec<String>);

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a text or a list of texts")]
enum OneOrSeveral {
    One(String),
    Several(Vec<String>),
}

impl From<OneOrSeveral> for OneOrMany {
    fn from(written: OneOrSeveral) -> Self {
        Self(match written {
            OneOrSeveral::One(text) => vec![text],
            OneOrSeveral::Several(texts) => texts,
        })
    }
}

/// Source of levels 1 and up of a texture.
#[derive(Clone, Debug)]
pub(super) enum Mipmaps {
    /// `"automatic"`: the card generates all of them from level 0.
    Automatic,
    /// Texels of each level.
    Texels(Vec<Spanned<Vec<Vec<Number>>>>),
}

struct MipmapsVisitor;

impl<'de> Visitor<'de> for MipmapsVisitor {
    type Value = Mipmaps;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"automatic\" or a list with the texels of each level")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Mipmaps, E> {
        if text == "automatic" {
            return Ok(Mipmaps::Automatic);
        }
        Err(E::invalid_value(de::Unexpected::Str(text), &self))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, levels: A) -> Result<Mipmaps, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(levels)).map(Mipmaps::Texels)
    }
}

impl<'de> Deserialize<'de> for Mipmaps {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MipmapsVisitor)
    }
}

#[derive(Clone, Debug)]
pub(super) enum Constant {
    /// `b#`
    Bool(bool),
    /// `c#`, `i#`: four numbers; a named constant has up to four.
    Vector(Vec<Number>),
}

struct ConstantVisitor;

impl<'de> Visitor<'de> for ConstantVisitor {
    type Value = Constant;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of four numbers, or true or false")
    }

    fn visit_bool<E: de::Error>(self, value: bool) -> Result<Constant, E> {
        Ok(Constant::Bool(value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, numbers: A) -> Result<Constant, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(numbers)).map(Constant::Vector)
    }
}

impl<'de> Deserialize<'de> for Constant {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ConstantVisitor)
    }
}

/// Converts to an integer; `None` if it is not integral.
pub(super) fn whole(number: &Number) -> Option<i64> {
    match *number {
        Number::Value(value) if value % 1.0 == 0.0 && value.abs() < 4_503_599_627_370_496.0 => Some(value as i64),
        Number::Value(_) => None,
        Number::Bits(bits) => Some(bits.into()),
    }
}

/// Converts up to four numbers; missing numbers come from (0, 0, 0, 1), as Direct3D expands vertex data.
pub(super) fn vector(numbers: &[Number]) -> Option<[u32; 4]> {
    if numbers.is_empty() || numbers.len() > 4 {
        return None;
    }
    let mut bits = [0, 0, 0, ONE];
    for (place, number) in bits.iter_mut().zip(numbers) {
        *place = number.single();
    }
    Some(bits)
}
