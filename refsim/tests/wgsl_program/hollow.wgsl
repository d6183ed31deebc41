struct Format { kind: u32, upper: u32, frac: u32, rounding: u32, overflow: u32, denormals: u32, special: u32, spare: u32 }
fn n_alu(code: u32, f: Format, a: u32, b: u32, c: u32) -> u32 { return a ^ b ^ c ^ f.kind ^ code; }
fn n_dot(f: Format, terms: u32, a: vec4<u32>, b: vec4<u32>) -> u32 { return a.x ^ b.y ^ f.kind ^ terms; }
fn n_convert(from_format: Format, to_format: Format, a: u32) -> u32 { return a ^ from_format.kind ^ to_format.kind; }
fn n_unorm(f: Format, steps: u32, single: u32) -> u32 { return single ^ steps ^ f.kind; }
