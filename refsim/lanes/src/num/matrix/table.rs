//! The units as data.
//!
//! Names of sources: M is microsoft/MMA-Sim (`mmasim` 2.1.1, MIT; arXiv 2511.10909), K is Khattak and Mikaitis,
//! "Accurate Models of NVIDIA Tensor Cores" (arXiv 2512.07004; north-numerical-computing/MATLAB-tensor-core b12b5a7,
//! BSD-2).

use super::{Element, MatrixError, MatrixUnit, ResultFormat, Rule};

const CUT32: ResultFormat = ResultFormat::CUT32;
const CUT22: ResultFormat = ResultFormat::CUT22;
const NEAREST16: ResultFormat = ResultFormat::NEAREST16;

const HALF: &[Element] = &[Element::FP16];
const BRAIN: &[Element] = &[Element::BF16];
const TF32: &[Element] = &[Element::TF32];
const XF32: &[Element] = &[Element::XF32];
const EIGHT: &[Element] = &[Element::E4M3, Element::E5M2];
const SHORT: &[Element] = &[Element::E4M3, Element::E5M2, Element::E3M2, Element::E2M3, Element::E2M1];
const FOUR: &[Element] = &[Element::E2M1];
const AMD_EIGHT: &[Element] = &[Element::FP8, Element::BF8];

const VOLTA: &str = "Volta: mma m8n8k4; Turing: the same instruction";
const TURING: &str = "Turing, Ampere, Ada: m16n8k8";
const AMPERE: &str = "Ampere, Ada: m16n8k16";
const ADA: &str = "Ada: mma m16n8k32 and k16";
const HOPPER: &str = "Hopper, Blackwell, RTX Blackwell: mma, wgmma, tcgen05 kind::f16";
const HOPPER_8: &str = "Hopper: wgmma k32";
const SYNC: &str = "Hopper, B200: mma.sync m16n8k32, which is converted to fp16";
const BLACKWELL: &str = "B200: tcgen05 kind::f8f6f4; RTX Blackwell: mma kind::f8f6f4, and Ada's FP8 forms";
const MXF8: &str = "B200: tcgen05; RTX Blackwell: mma; mxf8f6f4";
const MXF4: &str = "B200: tcgen05; RTX Blackwell: mma; mxf4nvf4";

const MEASURED: &str = "measured";
const TWO: &str = "two models";
const ONE: &str = "one model";
type Known = (&'static str, &'static str);
const V100: Known = (MEASURED, "V100 (K); Turing: M");
const V100_BITS: Known = (MEASURED, "V100 (K); its bits: M, K");
const FOUR_CHIPS: Known = (MEASURED, "A100 A2 Ada L40S (K); Turing: M");
const FOUR_CHIPS_BITS: Known = (MEASURED, "A100 A2 Ada L40S (K); Turing: M; its bits: M, K");
const CHAIN: Known = (MEASURED, "one block: A100 A2 Ada L40S (K); two: M, K");
const CHAIN_BITS: Known = (MEASURED, "one block: A100 A2 Ada L40S (K); two, and its bits: M, K");
const MMA: Known = (MEASURED, "mma: H100 H200 B200 (K); wgmma, tcgen05: M, K; RTX: M");
const MMA_BITS: Known = (MEASURED, "mma: H100 H200 B200 (K); wgmma, tcgen05, its bits: M, K; RTX: M");
const MMA_LEAST: Known =
    (MEASURED, "mma: H100 H200 B200 (K), its least exponent: one result of H100; wgmma, tcgen05: M, K; RTX: M");
const SHORT_BLOCK: Known = (MEASURED, "blocks of 4: H100 H200 B200 (K); of 8: M, K; RTX: M");
const NO_ADDEND: Known = (MEASURED, "with c = 0: H100 H200 (K); c: M, K, SageAttention 2");
const DEEP_GEMM: Known = (ONE, "M; bits: also DeepGEMM issue 176");
const MODEL: Known = (ONE, "M");
const MODELS: Known = (TWO, "M, K");
const FLUSHED: Known = (TWO, "M, K; flushing: AMD");
const FMA: Known = (ONE, "M; documented as FMA");

/// NVIDIA's adder: the least exponent follows from the bits of the unit's 16-bit types.
const fn nvidia(
    name: &'static str,
    chips: &'static str,
    operands: &'static [Element],
    [length, block, bits, half_bits]: [u32; 4],
    result: ResultFormat,
    (evidence, source): Known,
) -> MatrixUnit {
    let addend = result.element;
    let least = if addend.width() == 16 { 4 - half_bits.cast_signed() } else { -108 - half_bits.cast_signed() };
    let (length, block, bits, rule) = (length as usize, block as usize, Some(bits), Rule::Aligned { least });
    MatrixUnit { name, chips, operands, addend, length, block, bits, rule, scaling: None, result, evidence, source }
}

const fn scaled(unit: MatrixUnit, rule: Rule, share: usize, scale: Element) -> MatrixUnit {
    MatrixUnit { rule, scaling: Some((share, scale)), ..unit }
}

const fn groups(name: &'static str, chips: &'static str, share: usize, scale: Element) -> MatrixUnit {
    scaled(nvidia(name, chips, FOUR, [64, 64, 35, 25], CUT32, DEEP_GEMM), Rule::Groups, share, scale)
}

const fn synchronous(name: &'static str, least: i32, result: ResultFormat, source: &'static str) -> MatrixUnit {
    let rule = Rule::Synchronous { least };
    MatrixUnit { rule, ..nvidia(name, SYNC, EIGHT, [32, 32, 25, 25], result, (MEASURED, source)) }
}

/// Units of AMD, and units of fused operations.
const fn other(
    name: &'static str,
    chips: &'static str,
    operands: &'static [Element],
    [length, block]: [usize; 2],
    rule: Rule,
    (evidence, source): Known,
) -> MatrixUnit {
    let is_double = operands[0].width() == 64;
    let result = if is_double { ResultFormat::NEAREST64 } else { ResultFormat::NEAREST32 };
    let (addend, bits, scaling) = (result.element, None, None);
    MatrixUnit { name, chips, operands, addend, length, block, bits, rule, scaling, result, evidence, source }
}

/// Every unit, oldest first.
pub static UNITS: [MatrixUnit; 36] = [
    nvidia("volta_f16_f32", VOLTA, HALF, [4, 4, 23, 23], CUT32, V100),
    MatrixUnit { addend: Element::FP16, ..nvidia("volta_f16_f32_c16", VOLTA, HALF, [4, 4, 23, 23], CUT32, MODEL) },
    nvidia("volta_f16_f16", VOLTA, HALF, [4, 4, 23, 23], NEAREST16, V100_BITS),
    nvidia("turing_f16_f32", TURING, HALF, [8, 8, 24, 24], CUT32, FOUR_CHIPS),
    nvidia("turing_f16_f16", TURING, HALF, [8, 8, 24, 24], NEAREST16, FOUR_CHIPS_BITS),
    nvidia("ampere_f16_f32", AMPERE, HALF, [16, 8, 24, 24], CUT32, CHAIN),
    nvidia("ampere_f16_f16", AMPERE, HALF, [16, 8, 24, 24], NEAREST16, CHAIN_BITS),
    nvidia("ampere_bf16_f32", AMPERE, BRAIN, [16, 8, 24, 24], CUT32, CHAIN),
    nvidia("ampere_tf32_f32", "Ampere, Ada: m16n8k8 and k4", TF32, [8, 4, 24, 24], CUT32, CHAIN),
    nvidia("ada_fp8_f32", ADA, EIGHT, [32, 16, 13, 24], CUT22, (MEASURED, "RTX 1000 Ada, L40S (K)")),
    nvidia("ada_fp8_f16", ADA, EIGHT, [32, 16, 13, 24], NEAREST16, (MEASURED, "RTX 1000 Ada (K)")),
    nvidia("hopper_f16_f32", HOPPER, HALF, [16, 16, 25, 25], CUT32, MMA),
    nvidia("hopper_f16_f16", HOPPER, HALF, [16, 16, 25, 25], NEAREST16, MMA_BITS),
    nvidia("hopper_bf16_f32", HOPPER, BRAIN, [16, 16, 25, 25], CUT32, MMA_LEAST),
    nvidia("hopper_tf32_f32", HOPPER, TF32, [8, 8, 25, 25], CUT32, SHORT_BLOCK),
    nvidia("hopper_fp8_f32", HOPPER_8, EIGHT, [32, 32, 13, 25], CUT22, NO_ADDEND),
    nvidia("hopper_fp8_f16", HOPPER_8, EIGHT, [32, 32, 13, 25], NEAREST16, MODELS),
    synchronous("sync_fp8_f32", -133, CUT32, "B200 (K); special values: none"),
    synchronous("sync_fp8_f16", -21, NEAREST16, "H100 H200 B200 (K); special values: none"),
    nvidia("blackwell_f8f6f4_f32", BLACKWELL, SHORT, [32, 32, 25, 25], CUT32, DEEP_GEMM),
    nvidia("blackwell_f8f6f4_f16", BLACKWELL, SHORT, [32, 32, 25, 25], NEAREST16, MODEL),
    scaled(
        nvidia("blackwell_mxf8f6f4", MXF8, SHORT, [32, 32, 25, 25], CUT32, MODEL),
        Rule::Aligned { least: -133 },
        32,
        Element::UE8M0,
    ),
    groups("blackwell_mxf4", "B200: tcgen05; RTX Blackwell: mma; mxf4, mxf4nvf4 with blocks of 32", 32, Element::UE8M0),
    groups("blackwell_mxf4_block16", MXF4, 16, Element::UE8M0),
    groups("blackwell_nvf4", MXF4, 16, Element::UE4M3),
    other("cdna1_f16", "MI100", HALF, [16, 4], Rule::Exact, MODELS),
    other("cdna1_bf16", "MI100: bf16 without _1k", BRAIN, [8, 2], Rule::Exact, MODELS),
    other("cdna2_f16", "MI200", HALF, [16, 4], Rule::Pairs, FLUSHED),
    other("cdna2_bf16_1k", "MI200: bf16_1k", BRAIN, [16, 4], Rule::Pairs, FLUSHED),
    other("cdna2_bf16", "MI200: bf16 without _1k", BRAIN, [8, 2], Rule::Pairs, FLUSHED),
    other("cdna3_f16", "MI300", HALF, [16, 8], Rule::Floored { halves: false }, MODELS),
    other("cdna3_bf16", "MI300", BRAIN, [16, 8], Rule::Floored { halves: false }, MODELS),
    other("cdna3_xf32", "MI300", XF32, [8, 4], Rule::Floored { halves: false }, MODELS),
    other("cdna3_fp8", "MI300: fp8 and bf8", AMD_EIGHT, [32, 16], Rule::Floored { halves: true }, MODELS),
    other("fma_f64", "all with fp64", &[Element::FP64], [4, 1], Rule::Fused, FMA),
    other("fma_f32", "CDNA with fp32", &[Element::FP32], [4, 1], Rule::Fused, FMA),
];

impl MatrixUnit {
    /// Finds a unit by name; `-` counts as `_`, and a missing `_f32` is added.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn find(name: &str) -> Result<Self, MatrixError> {
        let name = name.to_ascii_lowercase().replace('-', "_");
        let named = |name: &str| UNITS.iter().find(|unit| unit.name == name).copied();
        named(&name).or_else(|| named(&format!("{name}_f32"))).ok_or_else(|| {
            let names: Vec<&str> = UNITS.iter().map(|unit| unit.name).collect();
            MatrixError::new("matrix unit", names.join(" "), name.chars().take(40).collect::<String>())
        })
    }
}
