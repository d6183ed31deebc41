fn texture_read(
    sampler_number: u32, u: vec4<u32>, v: vec4<u32>, w: vec4<u32>, q: vec4<u32>, detail: u32, bias: vec4<u32>,
    gradients: array<vec4<u32>, 8>, run: vec4<bool>,
) -> array<vec4<u32>, 4> {
    return array<vec4<u32>, 4>(u ^ gradients[7], v ^ bias, w ^ vec4<u32>(sampler_number), q ^ vec4<u32>(detail));
}
