//! NumPy's archives of arrays (`.npz`): a ZIP archive whose members are `.npy` files, stored without compression, as
//! `numpy.savez` writes them. Equal contents give equal bytes: members have no time stamp, and stay in the order of
//! writing.
//!
//! Reading never allocates more than the file holds: arrays are slices of the file until they are taken out.

use std::borrow::Borrow;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::{self, Cursor, Write};
use std::path::Path;

use zip::write::{SimpleFileOptions, StreamWriter};
use zip::{CompressionMethod, DateTime, System, ZipArchive, ZipWriter};

use super::npy::{self, NpyView};
use super::quoted;
use crate::error::{InputError, input_error};

/// The first bytes of such a file.
pub const MAGIC: &[u8] = b"PK\x03\x04";

/// The arrays of a file; each can be taken out once.
#[derive(Debug)]
pub struct NpzReader<'a> {
    name: &'a Path,
    arrays: BTreeMap<String, NpyView<'a>>,
}

impl<'a> NpzReader<'a> {
    /// Reads the archive, the checksums of all members, and the headers of all arrays; `name` is the file's name in
    /// messages.
    pub fn new(bytes: &'a [u8], name: &'a Path) -> Result<Self, InputError> {
        let refused = |reason: String| {
            input_error!("crossbar::npz::archive" =>
                "{reason}"; help "is it a .npz file, not compressed, and copied whole?")
            .at(name)
        };
        if !bytes.starts_with(MAGIC) {
            return Err(refused("expected a .npz file, found other first bytes".to_owned()));
        }
        let mut zip = ZipArchive::new(Cursor::new(bytes)).map_err(|error| refused(error.to_string()))?;
        // Bytes shared by many members would be read once per member.
        let overlap = zip.has_overlapping_entries().map_err(|error| refused(error.to_string()))?;
        if overlap || zip.has_duplicate_names() {
            return Err(refused("expected members that do not share names or bytes, found two that do".to_owned()));
        }
        let mut arrays = BTreeMap::new();
        for index in 0..zip.len() {
            let mut member = zip.by_index(index).map_err(|error| refused(error.to_string()))?;
            let member_name = quoted(member.name_raw());
            let refused = |what: &dyn Display| refused(format!("member {member_name}: {what}"));
            // The reader compares the checksum at the end.
            io::copy(&mut member, &mut io::sink()).map_err(|error| refused(&error))?;
            let begin = member.data_start().and_then(|start| usize::try_from(start).ok());
            let length = usize::try_from(member.size()).ok().filter(|_| member.size() == member.compressed_size());
            let range = begin.zip(length).and_then(|(begin, length)| Some(begin..begin.checked_add(length)?));
            let data = range.and_then(|range| bytes.get(range)).ok_or_else(|| refused(&"expected all its bytes"))?;
            let key = member.name().map_err(|error| refused(&error))?;
            let key = key.strip_suffix(".npy").ok_or_else(|| refused(&"expected a name that ends in .npy"))?;
            arrays.insert(
                key.to_owned(),
                npy::view(data, &name.join(&*member.name().unwrap_or_default()), npy::float_type_error)?,
            );
        }
        Ok(Self { name, arrays })
    }

    /// Creates the error for an invalid value.
    pub fn refuse(&self, field: &str, expected: impl Display, found: impl Display) -> InputError {
        input_error!("crossbar::npz::field" =>
            "{field}: expected {expected}, found {found}"; help "docs/npz.md says what belongs there")
        .at(self.name)
    }

    /// True if there is an array of this name.
    pub fn has(&self, field: &str) -> bool {
        self.arrays.contains_key(field)
    }

    /// Takes out the bytes of an array of one axis.
    pub fn bytes(&mut self, field: &str) -> Result<&'a [u8], InputError> {
        let length = self.arrays.get(field).map_or(0, |array| array.data.len());
        Ok(self.take(field, &[length], &["|u1"])?.data)
    }

    /// Takes out an array of integers of this shape, stored in any integer type of up to 32 bits, or in `<i8`.
    pub fn integers<T: TryFrom<i64>>(&mut self, field: &str, shape: &[usize]) -> Result<Vec<T>, InputError> {
        let array = self.take(field, shape, &["|u1", "|i1", "<u2", "<i2", "<u4", "<i4", "<i8"])?;
        // Shifting up to 64 bits and down again extends the sign.
        let (is_signed, unused) = (array.descr.contains('i'), 64 - 8 * array.size);
        let number = |bits: u64| if is_signed { (bits << unused).cast_signed() >> unused } else { bits.cast_signed() };
        let convert = |value| T::try_from(value).map_err(|_| value);
        let values: Result<Vec<T>, i64> = array.elements().map(number).map(convert).collect();
        values
            .map_err(|value| self.refuse(field, format!("integers of {} bits", 8 * size_of::<T>()), value.to_string()))
    }

    /// Takes out an array of 64-bit words of this shape.
    pub fn words(&mut self, field: &str, shape: &[usize]) -> Result<Vec<u64>, InputError> {
        Ok(self.take(field, shape, &["<u8"])?.elements().collect())
    }

    /// Takes out an array of finite f32 of this shape.
    pub fn singles(&mut self, field: &str, shape: &[usize]) -> Result<Vec<f32>, InputError> {
        let values = self.take(field, shape, &["<f4"])?.elements().map(|bits| f32::from_bits(bits as u32)).collect();
        self.finite(field, values, |value| value.is_finite())
    }

    /// Takes out an array of finite f64 of this shape.
    pub fn doubles(&mut self, field: &str, shape: &[usize]) -> Result<Vec<f64>, InputError> {
        let values = self.take(field, shape, &["<f8"])?.elements().map(f64::from_bits).collect();
        self.finite(field, values, |value| value.is_finite())
    }

    fn finite<T>(&self, field: &str, values: Vec<T>, is_finite: fn(&T) -> bool) -> Result<Vec<T>, InputError> {
        match values.iter().position(|value| !is_finite(value)) {
            Some(at) => Err(self.refuse(field, "finite numbers", format!("another at {at} (counted from 0)"))),
            None => Ok(values),
        }
    }

    /// Checks that no array is left.
    pub fn finish(self) -> Result<(), InputError> {
        match self.arrays.keys().next() {
            Some(left) => Err(self.refuse("arrays", "no other arrays", quoted(left.as_bytes()))),
            None => Ok(()),
        }
    }

    fn take(&mut self, field: &str, shape: &[usize], types: &[&str]) -> Result<NpyView<'a>, InputError> {
        let array = self.arrays.remove(field).ok_or_else(|| self.refuse(field, "an array", "none"))?;
        if !types.contains(&array.descr.as_str()) {
            return Err(self.refuse(
                field,
                format!("numbers of type {}", types.join(" ")),
                quoted(array.descr.as_bytes()),
            ));
        }
        if array.shape != shape {
            return Err(self.refuse(field, format!("the shape {shape:?}"), format!("{:?}", array.shape)));
        }
        Ok(array)
    }
}

/// Writes arrays one after the other.
pub struct NpzWriter<'a> {
    zip: ZipWriter<StreamWriter<&'a mut dyn Write>>,
}

const BUFFERED: usize = 1 << 16;

impl<'a> NpzWriter<'a> {
    /// Writes to `out`.
    pub fn new(out: &'a mut dyn Write) -> Self {
        Self { zip: ZipWriter::new_stream(out) }
    }

    /// Writes bytes as a one-dimensional array.
    pub fn bytes(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        self.put(name, ('u', 1), &[bytes.len()], bytes.iter().map(|&byte| byte.into()))
    }

    /// Writes integers in the smallest type that holds all of them.
    pub fn integers<T: Into<i64>>(
        &mut self,
        name: &str,
        shape: &[usize],
        values: impl Iterator<Item = T> + Clone,
    ) -> io::Result<()> {
        let values = values.map(Into::<i64>::into);
        let (least, most) =
            values.clone().fold((0, 0), |(least, most): (i64, i64), value| (least.min(value), most.max(value)));
        let sign_bits = u32::from(least < 0);
        // -1 - n takes as many bits as n.
        let bits = 64 - most.max(-1 - least).leading_zeros() + sign_bits;
        let size = if bits <= 32 { bits.div_ceil(8).next_power_of_two() } else { 8 };
        let kind = if least < 0 || size == 8 { 'i' } else { 'u' };
        self.put(name, (kind, size as usize), shape, values.map(i64::cast_unsigned))
    }

    /// Writes 64-bit words.
    pub fn words(&mut self, name: &str, shape: &[usize], words: &[u64]) -> io::Result<()> {
        self.put(name, ('u', 8), shape, words.iter().copied())
    }

    /// Writes f32.
    pub fn singles(
        &mut self,
        name: &str,
        shape: &[usize],
        values: impl Iterator<Item = impl Borrow<f32>>,
    ) -> io::Result<()> {
        self.put(name, ('f', 4), shape, values.map(|value| value.borrow().to_bits().into()))
    }

    /// Writes f64.
    pub fn doubles(
        &mut self,
        name: &str,
        shape: &[usize],
        values: impl Iterator<Item = impl Borrow<f64>>,
    ) -> io::Result<()> {
        self.put(name, ('f', 8), shape, values.map(|value| value.borrow().to_bits()))
    }

    /// Ends the archive.
    pub fn finish(self) -> io::Result<()> {
        self.zip.finish()?;
        Ok(())
    }

    fn put(
        &mut self,
        name: &str,
        (kind, size): (char, usize),
        shape: &[usize],
        mut values: impl Iterator<Item = u64>,
    ) -> io::Result<()> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::DEFAULT)
            .system(System::Unix)
            .unix_permissions(0o644);
        self.zip.start_file(format!("{name}.npy"), options)?;
        let order = if size == 1 { '|' } else { '<' };
        self.zip.write_all(&npy::beginning(&format!("{order}{kind}{size}"), shape))?;
        let mut buffer = Vec::with_capacity(BUFFERED);
        loop {
            buffer.clear();
            let some = values.by_ref().take(BUFFERED / 8);
            some.for_each(|value| buffer.extend_from_slice(&value.to_le_bytes()[..size]));
            if buffer.is_empty() {
                return Ok(());
            }
            self.zip.write_all(&buffer)?;
        }
    }
}
