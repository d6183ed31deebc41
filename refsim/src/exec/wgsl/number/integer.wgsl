// No operation is left to the device's own floats.

fn n_native(op: u32, f: Format) -> bool {
    return false;
}

fn n_native_alu(op: u32, a: u32, b: u32, c: u32) -> u32 {
    return 0u;
}

fn s_from_i32(x: i32) -> u32 {
    return s_whole(x);
}
