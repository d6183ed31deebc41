//! Good input gone wrong.

use std::ops::Range;

use proptest::prelude::*;

/// A good text with so many bytes replaced, put in or left out.
pub(crate) fn mutated(good: &'static str, edits: Range<usize>) -> impl Strategy<Value = Vec<u8>> {
    let edits = prop::collection::vec((any::<prop::sample::Index>(), 0_u8..3, any::<u8>()), edits);
    edits.prop_map(move |edits| {
        let mut bytes = good.as_bytes().to_vec();
        for (place, kind, byte) in edits {
            let at = place.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                _ => drop(bytes.remove(at)),
            }
        }
        bytes
    })
}
