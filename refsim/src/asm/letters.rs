//! Swizzle and mask letters.

use super::error::{ErrorKind, Parsed, SyntaxError, quote};
use crate::isa::{Mask, Span, Swizzle};

/// Parses a swizzle: one to four letters of `xyzw` or of `rgba`; the last one is repeated.
pub(super) fn swizzle(letters: &str, span: Span) -> Parsed<Swizzle> {
    let bad = || {
        SyntaxError::new(
            ErrorKind::Swizzle,
            span,
            "one to four letters of xyzw or of rgba",
            quote(letters),
            "write `.x`, `.xyz` or `.wzyx`, for example; letters of the two sets cannot be mixed",
        )
    };
    let components = components(letters).ok_or_else(bad)?;
    let last = *components.last().ok_or_else(bad)?;
    let mut lanes = [last; 4];
    lanes[..components.len()].copy_from_slice(&components);
    Ok(Swizzle(lanes))
}

/// Component numbers of one to four letters, all of xyzw or all of rgba.
pub(super) fn components(letters: &str) -> Option<Vec<u8>> {
    if letters.is_empty() || letters.len() > 4 {
        return None;
    }
    ["xyzw", "rgba"].iter().find_map(|set| {
        letters
            .bytes()
            .map(|letter| set.bytes().position(|l| l == letter.to_ascii_lowercase()))
            .map(|position| position.map(|p| p as u8))
            .collect()
    })
}

/// Parses a mask: letters of `xyzw` or of `rgba`, in this order.
pub(super) fn mask(letters: &str, span: Span) -> Parsed<Mask> {
    let bad = |help: &str| {
        SyntaxError::new(
            ErrorKind::Mask,
            span,
            "letters of xyzw or of rgba in this order, each once at most",
            quote(letters),
            help,
        )
    };
    let Some(components) = components(letters) else {
        return Err(bad("write `.x`, `.rgb` or `.xyw`, for example; letters of the two sets cannot be mixed"));
    };
    mask_of(&components).ok_or_else(|| bad("a destination has a mask, not a swizzle: put the swizzle on the sources"))
}

/// The mask of components in ascending order; `None` for another order.
pub(super) fn mask_of(components: &[u8]) -> Option<Mask> {
    components.is_sorted_by(|a, b| a < b).then(|| Mask(components.iter().fold(0, |bits, c| bits | 1 << c)))
}
