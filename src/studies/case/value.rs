//! Number syntax of cases.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{self, SeqAccess, Visitor},
};
use toml::Spanned;

/// Number: a TOML integer or float, or a bit pattern of an IEEE single as text (`"0x3f800000"`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// Written as a number; rounded to nearest even if a single is expected.
    Value(f64),
    /// Written as a bit pattern.
    Bits(u32),
}

impl Number {
    /// Converts to an IEEE single. NaN is the positive quiet one.
    pub fn single(self) -> u32 {
        match self {
            Self::Bits(bits) => bits,
            Self::Value(value) if value.is_nan() => 0x7fc0_0000,
            // A cast rounds to nearest even, and gives infinity for numbers out of range.
            Self::Value(value) => (value as f32).to_bits(),
        }
    }

    /// Converts to a double: exact for a bit pattern.
    pub fn double(self) -> f64 {
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exactly<T, const N: usize>(pub [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = Vec::<T>::deserialize(deserializer)?;
        let found = list.len();
        let wrong = |_| de::Error::custom(format!("expected {N} numbers, found {found}"));
        list.try_into().map(Self).map_err(wrong)
    }
}

/// One string, or a list of strings.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(from = "OneOrSeveral")]
pub struct OneOrMany(pub Vec<String>);

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
pub enum Mipmaps {
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

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Mipmaps, A::Error> {
        let mut levels = Vec::new();
        while let Some(level) = list.next_element()? {
            levels.push(level);
        }
        Ok(Mipmaps::Texels(levels))
    }
}

impl<'de> Deserialize<'de> for Mipmaps {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MipmapsVisitor)
    }
}

/// Value of a constant register.
#[derive(Clone, Debug, PartialEq)]
pub enum Constant {
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

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Constant, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = list.next_element()? {
            numbers.push(number);
        }
        Ok(Constant::Vector(numbers))
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

/// Converts up to four numbers; missing ones come from (0, 0, 0, 1), as Direct3D expands vertex data.
pub(super) fn vector(numbers: &[Number]) -> Option<[u32; 4]> {
    if numbers.is_empty() || numbers.len() > 4 {
        return None;
    }
    let mut bits = [0, 0, 0, 1.0_f32.to_bits()];
    for (place, number) in bits.iter_mut().zip(numbers) {
        *place = number.single();
    }
    Some(bits)
}
