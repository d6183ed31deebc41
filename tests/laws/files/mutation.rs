//! Damaged input.

use std::ops::Range;

use proptest::prelude::*;

/// A valid file with some bytes replaced, inserted or removed.
pub(crate) fn mutated(good: impl Into<Vec<u8>>, edits: Range<usize>) -> impl Strategy<Value = Vec<u8>> {
    let good = good.into();
    let edits = prop::collection::vec((any::<prop::sample::Index>(), 0_u8..3, any::<u8>()), edits);
    edits.prop_map(move |edits| {
        let mut bytes = good.clone();
        for (place, kind, byte) in edits {
            let at = place.index(bytes.len().max(1));
            match kind {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                _ => drop(bytes.remove(at)),
            }
        }
        bytes
    })
}
