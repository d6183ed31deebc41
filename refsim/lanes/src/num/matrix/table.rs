//! The units as data.
//!
//! Names of sources: M is microsoft/MMA-Sim (`mmasim` 2.1.1, MIT; arXiv 2511.10909), K is Khattak and Mikaitis,
//! "Accurate Models of NVIDIA Tensor Cores" (arXiv 2512.07004; north-numerical-computing/MATLAB-tensor-core b12b5a7,
//! BSD-2).

use super::Evidence::{Measured, OneModel, TwoModels};
use super::ResultFormat::{Cut22, Cut32, Nearest16, Nearest32, Nearest64};
use super::{Element, Evidence, MatrixError, MatrixUnit, ResultFormat, Rule, Scaling};

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

type Known = (Evidence, &'static str);
const V100: Known = (Measured, "V100 (K); Turing: M");
const V100_BITS: Known = (Measured, "V100 (K); its bits: M, K");
const FOUR_CHIPS: Known = (Measured, "A100 A2 Ada L40S (K); Turing: M");
const FOUR_CHIPS_BITS: Known = (Measured, "A100 A2 Ada L40S (K); Turing: M; its bits: M, K");
const CHAIN: Known = (Measured, "one block: A100 A2 Ada L40S (K); two: M, K");
const CHAIN_BITS: Known = (Measured, "one block: A100 A2 Ada L40S (K); two, and its bits: M, K");
const MMA: Known = (Measured, "mma: H100 H200 B200 (K); wgmma, tcgen05: M, K; RTX: M");
const MMA_BITS: Known = (Measured, "mma: H100 H200 B200 (K); wgmma, tcgen05, its bits: M, K; RTX: M");
const MMA_LEAST: Known =
    (Measured, "mma: H100 H200 B200 (K), its least exponent: one result of H100; wgmma, tcgen05: M, K; RTX: M");
const SHORT_BLOCK: Known = (Measured, "blocks of 4: H100 H200 B200 (K); of 8: M, K; RTX: M");
const NO_ADDEND: Known = (Measured, "with c = 0: H100 H200 (K); c: M, K, SageAttention 2");
const DEEP_GEMM: Known = (OneModel, "M; bits: also DeepGEMM issue 176");
const MODEL: Known = (OneModel, "M");

/// NVIDIA's adder: the least exponent follows from the bits of the unit's 16-bit types.
const fn nvidia(
    name: &'static str,
    chips: &'static str,
    operands: &'static [Element],
    [length, block, bits, half_bits]: [u32; 4],
    result: ResultFormat,
    (evidence, source): Known,
) -> MatrixUnit {
    let least = if matches!(result, Nearest16) { 4 - half_bits.cast_signed() } else { -108 - half_bits.cast_signed() };
    let (length, block) = (length as usize, block as usize);
    let rule = Rule::Aligned { block, bits, least };
    let addend = result.element();
    MatrixUnit { name, chips, operands, addend, length, rule, scaling: None, result, evidence, source }
}

const fn amd(
    name: &'static str,
    chips: &'static str,
    operands: &'static [Element],
    length: usize,
    rule: Rule,
    source: &'static str,
) -> MatrixUnit {
    let (result, addend, evidence) = (Nearest32, Element::FP32, TwoModels);
    MatrixUnit { name, chips, operands, addend, length, rule, scaling: None, result, evidence, source }
}

const fn groups(name: &'static str, chips: &'static str, block: usize, is_e4m3: bool) -> MatrixUnit {
    let unit = nvidia(name, chips, FOUR, [64, 64, 35, 25], Cut32, DEEP_GEMM);
    MatrixUnit { rule: Rule::Groups { bits: 35 }, scaling: Some(Scaling { block, is_e4m3 }), ..unit }
}

const fn synchronous(
    name: &'static str,
    bits: u32,
    least: i32,
    result: ResultFormat,
    source: &'static str,
) -> MatrixUnit {
    let unit = nvidia(name, SYNC, EIGHT, [32, 32, 25, 25], result, (Measured, source));
    MatrixUnit { rule: Rule::Synchronous { bits, least }, ..unit }
}

/// Every unit, oldest first.
pub static UNITS: [MatrixUnit; 36] = [
    nvidia("volta_f16_f32", VOLTA, HALF, [4, 4, 23, 23], Cut32, V100),
    MatrixUnit { addend: Element::FP16, ..nvidia("volta_f16_f32_c16", VOLTA, HALF, [4, 4, 23, 23], Cut32, MODEL) },
    nvidia("volta_f16_f16", VOLTA, HALF, [4, 4, 23, 23], Nearest16, V100_BITS),
    nvidia("turing_f16_f32", TURING, HALF, [8, 8, 24, 24], Cut32, FOUR_CHIPS),
    nvidia("turing_f16_f16", TURING, HALF, [8, 8, 24, 24], Nearest16, FOUR_CHIPS_BITS),
    nvidia("ampere_f16_f32", AMPERE, HALF, [16, 8, 24, 24], Cut32, CHAIN),
    nvidia("ampere_f16_f16", AMPERE, HALF, [16, 8, 24, 24], Nearest16, CHAIN_BITS),
    nvidia("ampere_bf16_f32", AMPERE, BRAIN, [16, 8, 24, 24], Cut32, CHAIN),
    nvidia("ampere_tf32_f32", "Ampere, Ada: m16n8k8 and k4", TF32, [8, 4, 24, 24], Cut32, CHAIN),
    nvidia("ada_fp8_f32", ADA, EIGHT, [32, 16, 13, 24], Cut22, (Measured, "RTX 1000 Ada, L40S (K)")),
    nvidia("ada_fp8_f16", ADA, EIGHT, [32, 16, 13, 24], Nearest16, (Measured, "RTX 1000 Ada (K)")),
    nvidia("hopper_f16_f32", HOPPER, HALF, [16, 16, 25, 25], Cut32, MMA),
    nvidia("hopper_f16_f16", HOPPER, HALF, [16, 16, 25, 25], Nearest16, MMA_BITS),
    nvidia("hopper_bf16_f32", HOPPER, BRAIN, [16, 16, 25, 25], Cut32, MMA_LEAST),
    nvidia("hopper_tf32_f32", HOPPER, TF32, [8, 8, 25, 25], Cut32, SHORT_BLOCK),
    nvidia("hopper_fp8_f32", HOPPER_8, EIGHT, [32, 32, 13, 25], Cut22, NO_ADDEND),
    nvidia("hopper_fp8_f16", HOPPER_8, EIGHT, [32, 32, 13, 25], Nearest16, (TwoModels, "M, K")),
    synchronous("sync_fp8_f32", 25, -133, Cut32, "B200 (K); special values: none"),
    synchronous("sync_fp8_f16", 25, -21, Nearest16, "H100 H200 B200 (K); special values: none"),
    nvidia("blackwell_f8f6f4_f32", BLACKWELL, SHORT, [32, 32, 25, 25], Cut32, DEEP_GEMM),
    nvidia("blackwell_f8f6f4_f16", BLACKWELL, SHORT, [32, 32, 25, 25], Nearest16, MODEL),
    MatrixUnit {
        scaling: Some(Scaling { block: 32, is_e4m3: false }),
        ..nvidia("blackwell_mxf8f6f4", MXF8, SHORT, [32, 32, 25, 25], Cut32, MODEL)
    },
    groups("blackwell_mxf4", "B200: tcgen05; RTX Blackwell: mma; mxf4, and mxf4nvf4 with blocks of 32", 32, false),
    groups("blackwell_mxf4_block16", MXF4, 16, false),
    groups("blackwell_nvf4", MXF4, 16, true),
    amd("cdna1_f16", "MI100", HALF, 16, Rule::Exact { block: 4 }, "M, K"),
    amd("cdna1_bf16", "MI100: bf16 without _1k", BRAIN, 8, Rule::Exact { block: 2 }, "M, K"),
    amd("cdna2_f16", "MI200", HALF, 16, Rule::Pairs { block: 4 }, "M, K; flushing: AMD"),
    amd("cdna2_bf16_1k", "MI200: bf16_1k", BRAIN, 16, Rule::Pairs { block: 4 }, "M, K; flushing: AMD"),
    amd("cdna2_bf16", "MI200: bf16 without _1k", BRAIN, 8, Rule::Pairs { block: 2 }, "M, K; flushing: AMD"),
    amd("cdna3_f16", "MI300", HALF, 16, Rule::Floored { block: 8, halves: false }, "M, K"),
    amd("cdna3_bf16", "MI300", BRAIN, 16, Rule::Floored { block: 8, halves: false }, "M, K"),
    amd("cdna3_xf32", "MI300", XF32, 8, Rule::Floored { block: 4, halves: false }, "M, K"),
    amd("cdna3_fp8", "MI300: fp8 and bf8", AMD_EIGHT, 32, Rule::Floored { block: 16, halves: true }, "M, K"),
    MatrixUnit {
        result: Nearest64,
        addend: Element::FP64,
        evidence: OneModel,
        ..amd("fma_f64", "all with fp64", &[Element::FP64], 4, Rule::Fused, "M; documented as FMA")
    },
    MatrixUnit {
        evidence: OneModel,
        ..amd("fma_f32", "CDNA with fp32", &[Element::FP32], 4, Rule::Fused, "M; documented as FMA")
    },
];

impl MatrixUnit {
    /// The unit of a name; `-` counts as `_`, and a missing `_f32` is added.
    ///
    /// # Errors
    /// If there is none.
    pub fn find(name: &str) -> Result<Self, MatrixError> {
        let name = name.to_ascii_lowercase().replace('-', "_");
        let named = |name: &str| UNITS.iter().find(|unit| unit.name == name).copied();
        named(&name).or_else(|| named(&format!("{name}_f32"))).ok_or_else(|| {
            let names: Vec<&str> = UNITS.iter().map(|unit| unit.name).collect();
            MatrixError::new("matrix unit", names.join(" "), name.chars().take(40).collect::<String>())
        })
    }
}
