//! Reads typed elements from buffers.

use std::fmt::Display;
use std::path::Path;

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use super::buffers::Buffers;
use crate::error::InputError;
use crate::io::error::part_error;

/// Largest number of elements of an accessor.
pub(super) const MAX_ELEMENTS: usize = 1 << 26;

/// Reads accessors within the bounds of their buffers.
pub(super) struct AccessorReader<'a> {
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) name: &'a Path,
}

impl AccessorReader<'_> {
    /// Vectors in single precision; normalized unsigned integers are divided by their type's maximum.
    pub(super) fn vectors<const N: usize>(&self, accessor: &Accessor<'_>) -> Result<Vec<[f32; N]>, InputError> {
        let fits = accessor.dimensions().multiplicity() == N
            && !matches!(accessor.dimensions(), Dimensions::Mat2 | Dimensions::Mat3 | Dimensions::Mat4);
        let (size, read): (usize, fn(&[u8]) -> f32) = match (accessor.data_type(), accessor.normalized()) {
            (DataType::F32, _) => (4, |bytes| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
            (DataType::U8, true) => (1, |bytes| (f64::from(whole(&bytes[..1])) / 255.0) as f32),
            (DataType::U16, true) => (2, |bytes| (f64::from(whole(&bytes[..2])) / 65535.0) as f32),
            _ => (0, |_| 0.0),
        };
        if !fits || size == 0 {
            let expected = format!("vectors of {N} floats, or of normalized unsigned bytes or shorts");
            return Err(self.wrong(accessor, expected, "elements of another type"));
        }
        let elements = self.elements(accessor)?;
        Ok(elements.into_iter().map(|bytes| std::array::from_fn(|i| read(&bytes[i * size..]))).collect())
    }

    /// Indices of vertices, each below `vertices`.
    pub(super) fn indices(&self, accessor: &Accessor<'_>, vertices: usize) -> Result<Vec<u32>, InputError> {
        let unsigned = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
        if accessor.dimensions() != Dimensions::Scalar || !unsigned {
            return Err(self.wrong(accessor, "unsigned scalars for indices", "elements of another type"));
        }
        let indices: Vec<u32> = self.elements(accessor)?.into_iter().map(whole).collect();
        match indices.iter().find(|&&index| index as usize >= vertices) {
            Some(beyond) => Err(self.wrong(accessor, format!("indices below {vertices}"), &beyond.to_string())),
            None => Ok(indices),
        }
    }

    fn elements(&self, accessor: &Accessor<'_>) -> Result<Vec<&[u8]>, InputError> {
        let (count, size) = (accessor.count(), accessor.size());
        if count > MAX_ELEMENTS {
            return Err(self.wrong(accessor, format!("at most {MAX_ELEMENTS} elements"), &count.to_string()));
        }
        let Some(view) = accessor.view().filter(|_| accessor.sparse().is_none()) else {
            return Err(self.wrong(accessor, "elements in a buffer view", "sparse ones"));
        };
        let within = || -> Option<Vec<&[u8]>> {
            let bytes = self.buffers.view(&view)?.get(accessor.offset()..)?;
            let stride = view.stride().unwrap_or(size);
            let last = count.checked_sub(1)?.checked_mul(stride)?;
            bytes.get(last..last.checked_add(size)?).filter(|_| stride >= size)?;
            (0..count).map(|i| bytes.get(i * stride..i * stride + size)).collect()
        };
        within().ok_or_else(|| self.wrong(accessor, "elements within its buffer view", "bytes beyond it"))
    }

    fn wrong(&self, accessor: &Accessor<'_>, expected: impl Display, found: &str) -> InputError {
        part_error(self.name, format!("accessors[{}]", accessor.index()), expected, found)
    }
}

fn whole(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
}
