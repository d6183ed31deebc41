//! Triangle ids as colors: 24 bits and a hit mask, 4 bytes per ray.

/// Encodes an id as a color: the lowest byte in red, alpha 1.
pub(super) fn color_of_id(id: u32) -> [u32; 4] {
    let part = |shift: u32| ((id >> shift & 0xff) as f32 / 255.0).to_bits();
    [part(0), part(8), part(16), 1.0_f32.to_bits()]
}

/// Decodes the id of an `A8R8G8B8` pixel; `None` for a miss.
pub(super) const fn id_of_color(raw: u32) -> Option<u32> {
    if raw >> 24 == 0 {
        return None;
    }
    Some((raw >> 16 & 0xff) | (raw & 0xff00) | (raw & 0xff) << 16)
}
