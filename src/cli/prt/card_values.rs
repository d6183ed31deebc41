//! Values of options of `crossbar prt card`.

use clap::ValueEnum;

/// What a vertex holds weights in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum WeightsArg {
    /// Single precision
    Fp32,
    /// Half precision
    Fp16,
    /// 16 bits of the range of the cluster's weights on a vector
    Unorm16,
    /// 8 bits of it
    Unorm8,
}

/// What the card makes of transfer of all frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum WayArg {
    /// Nothing: the host makes colors of vertices, which are interpolated
    Colors,
    /// The product with factors of the view, which are in textures, for each pixel
    Products,
    /// That, and before it the sums over representatives, vertex by vertex in textures
    Sums,
}

/// Who interpolates between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FilterArg {
    /// The sampler, whose weights have few bits
    Sampler,
    /// The program
    Program,
}

/// What a vertex holds transferred radiance in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum RadianceArg {
    /// Single precision
    Fp32,
    /// Half precision
    Fp16,
}

/// A vertex language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum VertexArg {
    #[value(name = "vs_1_1")]
    Vs1_1,
    #[value(name = "vs_2_0")]
    Vs2_0,
}
