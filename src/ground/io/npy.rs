//! NumPy's array files (`.npy`), versions 1 to 3: arrays of f4 or f8 in C order, in either byte order. In a table, the
//! first axis counts the rows, and the other axes together the columns. f8 is rounded to nearest if f32 is requested.

use std::io::{self, Write};
use std::path::Path;

use exr::prelude::f16;
use serde::Deserialize;
use toml::de::ValueDeserializer;

use super::error::read_file;
use super::number_table::{NumberTable, TableNumber, parse_number_table};
use super::quoted;
use crate::error::{InputError, input_error};

/// The first bytes of such a file.
pub const MAGIC: &[u8] = b"\x93NUMPY";

fn header_error(name: &Path, what: &str, expected: &str, found: String) -> InputError {
    input_error!("crossbar::npy::header" =>
        "{what}: expected {expected}, found {found}"; help "write it with numpy.save")
    .at(name)
}

fn size_error(name: &Path, expected: &str, found: String) -> InputError {
    input_error!("crossbar::npy::size" => "expected {expected} of numbers, found {found}").at(name)
}

pub(super) fn float_type_error(name: &Path, found: &str) -> InputError {
    input_error!("crossbar::npy::dtype" =>
        "expected numbers of type <f4, <f8, >f4 or >f8, found {}", quoted(found.as_bytes());
        help "convert the array: a.astype('<f4')")
    .at(name)
}

fn code_type_error(name: &Path, found: &str) -> InputError {
    input_error!("crossbar::npy::dtype" =>
        "expected numbers of type <f2, <f4 or <f8, or patterns of type u1, <u2 or <u4, found {}", quoted(found.as_bytes());
        help "convert the array: a.astype('<f4'), or a.view('u1') for patterns")
    .at(name)
}

/// Numbers along any number of axes, in C order.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberArray<T = f32> {
    /// Length of each axis. There is at least one axis, and each length is at least 1.
    pub shape: Vec<usize>,
    /// All numbers; their number is the product of the shape.
    pub values: Vec<T>,
}

impl<T> From<NumberArray<T>> for NumberTable<T> {
    fn from(NumberArray { shape, values }: NumberArray<T>) -> Self {
        Self { columns: shape.iter().skip(1).product(), values }
    }
}

/// An array of any type of 1 to 8 bytes, in C order, with its numbers as raw bytes.
#[derive(Debug)]
pub(super) struct NpyView<'a> {
    /// Byte order, kind and size, such as `<f4`.
    pub(super) descr: String,
    /// Bytes per number.
    pub(super) size: usize,
    pub(super) shape: Vec<usize>,
    /// The numbers' bytes; their count matches shape and type.
    pub(super) data: &'a [u8],
}

impl<'a> NpyView<'a> {
    /// The bits of each little-endian number.
    pub(super) fn elements(&self) -> impl Iterator<Item = u64> + use<'a> {
        self.data.chunks_exact(self.size).map(|bytes| {
            let mut wide = [0; 8];
            wide[..bytes.len()].copy_from_slice(bytes);
            u64::from_le_bytes(wide)
        })
    }
}

/// Reads the header of an array; `wrong_type` is the error of a type that no reader knows.
pub(super) fn view<'a>(
    bytes: &'a [u8],
    name: &Path,
    wrong_type: fn(&Path, &str) -> InputError,
) -> Result<NpyView<'a>, InputError> {
    let (text, data) = split(bytes, name)?;
    let header = Header::parse(text).ok_or_else(|| {
        let expected = "a Python dictionary of `descr`, `fortran_order` and `shape`";
        header_error(name, "the header", expected, quoted(text))
    });
    let Header { descr, fortran_order, shape } = header?;
    if fortran_order {
        return Err(input_error!("crossbar::npy::order" =>
            "expected an array in C order, found Fortran order"; help "convert the array: numpy.ascontiguousarray(a)")
        .at(name));
    }
    let size = match descr.as_bytes() {
        [b'<' | b'>' | b'|', b'f' | b'i' | b'u', size @ (b'1' | b'2' | b'4' | b'8')] => usize::from(size - b'0'),
        _ => return Err(wrong_type(name, &descr)),
    };
    let count = shape.iter().try_fold(1_usize, |product, &axis| product.checked_mul(axis));
    let Some(count) = count.filter(|_| !shape.is_empty()) else {
        return Err(size_error(name, "a shape", format!("{shape:?}")));
    };
    if count.checked_mul(size) != Some(data.len()) {
        return Err(size_error(name, &format!("{count} x {size} bytes"), format!("{} bytes", data.len())));
    }
    Ok(NpyView { descr, size, shape, data })
}

/// Reads an array from bytes; `name` is the file's name in messages.
pub fn parse_npy_array<T: TableNumber>(bytes: &[u8], name: &Path) -> Result<NumberArray<T>, InputError> {
    let NpyView { descr, shape, data, .. } = view(bytes, name, float_type_error)?;
    if data.is_empty() {
        return Err(size_error(name, "a shape", format!("{shape:?}")));
    }
    let values = match descr.as_str() {
        "<f4" | ">f4" => {
            let of = if descr == "<f4" { f32::from_le_bytes } else { f32::from_be_bytes };
            data.as_chunks().0.iter().map(|&bytes| T::of_single(of(bytes))).collect()
        }
        "<f8" | ">f8" => {
            let of = if descr == "<f8" { f64::from_le_bytes } else { f64::from_be_bytes };
            let numbers = data.as_chunks().0.iter().map(|&bytes| of(bytes)).enumerate();
            let narrowed = numbers.map(|(index, number)| {
                T::of_double(number).map_err(|_| {
                    input_error!("crossbar::npy::range" =>
                        "number {index} (counted from 0) is too large for a 32-bit float: {number:e}")
                    .at(name)
                })
            });
            narrowed.collect::<Result<_, _>>()?
        }
        _ => return Err(float_type_error(name, &descr)),
    };
    Ok(NumberArray { shape, values })
}

fn split<'a>(bytes: &'a [u8], name: &Path) -> Result<(&'a [u8], &'a [u8]), InputError> {
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        let found = quoted(&bytes[..bytes.len().min(MAGIC.len())]);
        return Err(header_error(name, "the first bytes", "\\x93NUMPY", found));
    };
    let cut = |what, expected, found| {
        input_error!("crossbar::npy::truncated" =>
            "expected {expected} bytes of {what}, found {found}"; help "the file is truncated; write it again")
        .at(name)
    };
    let [major, _minor, rest @ ..] = rest else { return Err(cut("its version", 2, rest.len())) };
    let (length, rest) = match (major, rest) {
        (1, [a, b, rest @ ..]) => (usize::from(u16::from_le_bytes([*a, *b])), rest),
        (2 | 3, [a, b, c, d, rest @ ..]) => (u32::from_le_bytes([*a, *b, *c, *d]) as usize, rest),
        (1..=3, _) => return Err(cut("the header's length", if *major == 1 { 2 } else { 4 }, rest.len())),
        _ => {
            let found = major.to_string();
            return Err(header_error(name, "its version", "1, 2 or 3", found));
        }
    };
    rest.split_at_checked(length).ok_or_else(|| cut("the header", length, rest.len()))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    descr: String,
    fortran_order: bool,
    shape: Vec<usize>,
}

impl Header {
    /// Reads a Python dictionary as an inline table of TOML, which differs from it in a few characters.
    fn parse(text: &[u8]) -> Option<Self> {
        let inside = std::str::from_utf8(text).ok()?.trim().strip_prefix('{')?.strip_suffix('}')?.trim_end();
        let mut table = format!("{{{}}}", inside.strip_suffix(',').unwrap_or(inside));
        for (python, toml) in [("(", "["), (")", "]"), (":", "="), ("False", "false"), ("True", "true")] {
            table = table.replace(python, toml);
        }
        Self::deserialize(ValueDeserializer::parse(&table).ok()?).ok()
    }
}

/// The numbers of a NumPy array or of comma-separated values; `name` is the file's name in messages.
pub fn parse_numbers<T: TableNumber>(bytes: &[u8], name: &Path) -> Result<NumberTable<T>, InputError> {
    match bytes.starts_with(MAGIC) {
        true => parse_npy_array(bytes, name).map(NumberTable::from),
        false => parse_number_table(bytes, name),
    }
}

/// [`parse_numbers`] from a file of at most `limit` bytes; `what` is the kind of file in messages.
pub fn load_numbers<T: TableNumber>(path: &Path, what: &'static str, limit: u64) -> Result<NumberTable<T>, InputError> {
    parse_numbers(&read_file(path, what, limit)?, path)
}

/// The numbers and the shape of a NumPy array, from a file of at most `limit` bytes; `what` is the kind of file in
/// messages.
pub fn load_npy_array(path: &Path, what: &'static str, limit: u64) -> Result<NumberArray, InputError> {
    parse_npy_array(&read_file(path, what, limit)?, path)
}

/// Numbers, or bit patterns of a number format.
#[derive(Clone, Debug, PartialEq)]
pub enum NumbersOrCodes {
    /// Numbers of type f2, f4 or f8.
    Numbers(NumberArray<f64>),
    /// Bit patterns of type u1, u2 or u4.
    Codes(NumberArray<u64>),
}

/// An array of floats, or of unsigned integers in little-endian order, from a file of at most `limit` bytes; `what` is
/// the kind of file in messages.
pub fn load_numbers_or_codes(path: &Path, what: &'static str, limit: u64) -> Result<NumbersOrCodes, InputError> {
    let bytes = read_file(path, what, limit)?;
    let view = view(&bytes, path, code_type_error)?;
    if view.data.is_empty() {
        return Err(size_error(path, "an array", format!("none in the shape {:?}", view.shape)));
    }
    let elements = view.elements();
    let half = |bits: u64| f16::from_bits(bits as u16).to_f64();
    let NpyView { descr, shape, .. } = view;
    Ok(match descr.as_str() {
        "|u1" | "<u2" | "<u4" => NumbersOrCodes::Codes(NumberArray { shape, values: elements.collect() }),
        "<f2" => NumbersOrCodes::Numbers(NumberArray { shape, values: elements.map(half).collect() }),
        "<f4" | ">f4" | "<f8" | ">f8" => NumbersOrCodes::Numbers(parse_npy_array(&bytes, path)?),
        _ => return Err(code_type_error(path, &descr)),
    })
}

/// Writes numbers of any shape as an array of little-endian f4, in version 1.
pub fn write_npy_array(shape: &[usize], values: &[f32], out: &mut dyn Write) -> io::Result<()> {
    assert_eq!(values.len(), shape.iter().product::<usize>(), "as many as the shape says");
    out.write_all(&beginning("<f4", shape))?;
    values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
}

/// Writes doubles of any shape as an array of little-endian f8, in version 1.
pub fn write_npy_doubles(shape: &[usize], values: &[f64], out: &mut dyn Write) -> io::Result<()> {
    assert_eq!(values.len(), shape.iter().product::<usize>(), "as many as the shape says");
    out.write_all(&beginning("<f8", shape))?;
    values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
}

/// The first bytes and header of an array, in version 1.
pub(super) fn beginning(descr: &str, shape: &[usize]) -> Vec<u8> {
    let axes: Vec<String> = shape.iter().map(usize::to_string).collect();
    // A Python tuple of one element has a trailing comma.
    let shape = format!("({}{})", axes.join(", "), if shape.len() == 1 { "," } else { "" });
    let mut header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    assert!(header.len() < 60_000, "a shape of fewer axes");
    // Data begin at a multiple of 64 bytes, after a line feed.
    let padding = (MAGIC.len() + 4 + header.len() + 1).next_multiple_of(64) - (MAGIC.len() + 4 + header.len() + 1);
    header.extend(std::iter::repeat_n(' ', padding).chain(['\n']));
    [MAGIC, &[1, 0], &(header.len() as u16).to_le_bytes(), header.as_bytes()].concat()
}
