//! Reads typed elements from buffers.

use std::fmt::Display;
use std::path::Path;

use gltf::Accessor;
use gltf::accessor::sparse::IndexType;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::View;

use super::buffers::Buffers;
use crate::error::InputError;
use crate::io::error::part_error;

/// Largest number of elements of an accessor.
pub(super) const MAX_ELEMENTS: usize = 1 << 26;
/// Largest number of elements of an accessor without a buffer.
const MAX_ZEROS: usize = 1 << 20;
/// The bytes of an element without a buffer.
const ZEROS: &[u8] = &[0; 64];

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
        let outside = |what: &'static str| self.wrong(accessor, what, "bytes beyond it");
        if count > MAX_ELEMENTS {
            return Err(self.wrong(accessor, format!("at most {MAX_ELEMENTS} elements"), &count.to_string()));
        }
        let mut elements = match accessor.view() {
            Some(view) => {
                let all = self.packed(&view, accessor.offset(), (count, size, view.stride()));
                all.ok_or_else(|| outside("elements within its buffer view"))?
            }
            None if count <= MAX_ZEROS => vec![&ZEROS[..size.min(ZEROS.len())]; count],
            None => {
                let expected = format!("a buffer view, or at most {MAX_ZEROS} elements");
                return Err(self.wrong(accessor, expected, &count.to_string()));
            }
        };
        if let Some(sparse) = accessor.sparse() {
            if sparse.count() > count {
                return Err(self.wrong(
                    accessor,
                    format!("at most {count} sparse elements"),
                    &sparse.count().to_string(),
                ));
            }
            let (places, values) = (sparse.indices(), sparse.values());
            let width = match places.index_type() {
                IndexType::U8 => 1,
                IndexType::U16 => 2,
                IndexType::U32 => 4,
            };
            let within = "sparse elements within their buffer views";
            let at = self.packed(&places.view(), places.offset(), (sparse.count(), width, None));
            let new = self.packed(&values.view(), values.offset(), (sparse.count(), size, None));
            for (at, new) in at.ok_or_else(|| outside(within))?.into_iter().zip(new.ok_or_else(|| outside(within))?) {
                let at = whole(at);
                let Some(old) = elements.get_mut(at as usize) else {
                    return Err(self.wrong(accessor, format!("sparse indices below {count}"), &at.to_string()));
                };
                *old = new;
            }
        }
        Ok(elements)
    }

    /// `count` elements of a size in bytes, contiguous or with a stride; `None` if they exceed the view.
    fn packed(
        &self,
        view: &View<'_>,
        offset: usize,
        (count, size, stride): (usize, usize, Option<usize>),
    ) -> Option<Vec<&[u8]>> {
        let bytes = self.buffers.view(view)?.get(offset..)?;
        let stride = stride.unwrap_or(size);
        let last = count.checked_sub(1)?.checked_mul(stride)?;
        bytes.get(last..last.checked_add(size)?).filter(|_| stride >= size)?;
        (0..count).map(|i| bytes.get(i * stride..i * stride + size)).collect()
    }

    fn wrong(&self, accessor: &Accessor<'_>, expected: impl Display, found: &str) -> InputError {
        part_error(self.name, format!("accessors[{}]", accessor.index()), expected, found)
    }
}

fn whole(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
}
