//! Tables I and II.

/// Name of the host on which biclusters are computed.
pub(super) const HOST: &str = "host";

/// Scene of either table.
pub(super) struct PrintedScene {
    pub(super) name: &'static str,
    pub(super) place: &'static str,
    pub(super) vertices: usize,
    /// Local directions along an edge.
    pub(super) side: usize,
    /// Non-zeros of T, in millions.
    pub(super) nonzeros: f64,
    /// Millions of operations, before and after. The scan has "8.4" for 78.4, twice the non-zeros.
    pub(super) operations: [f64; 2],
    /// Remaining operations, in %.
    pub(super) operations_left: f64,
    /// Megabytes before (printed without decimals) and after.
    pub(super) megabytes: [f64; 2],
    /// Remaining megabytes, in %, with their digits.
    pub(super) megabytes_left: (f64, u8),
    /// Numbers of bidirectional textures with patches of 64 x 64 and of 32 x 32 texels, and their megabytes; Table I
    /// alone.
    pub(super) textures: Option<([usize; 2], f64)>,
}

pub(super) const SCENES: [PrintedScene; 6] = [
    PrintedScene {
        name: "bunny",
        place: "table 1",
        vertices: 3286,
        side: 8,
        nonzeros: 10.6,
        operations: [21.2, 5.8],
        operations_left: 27.4,
        megabytes: [1400.0, 24.2],
        megabytes_left: (1.7, 1),
        textures: Some(([1, 0], 113.2)),
    },
    PrintedScene {
        name: "armor",
        place: "table 1",
        vertices: 10_652,
        side: 12,
        nonzeros: 21.9,
        operations: [43.9, 14.9],
        operations_left: 33.9,
        megabytes: [9500.0, 59.0],
        megabytes_left: (0.62, 2),
        textures: Some(([1, 0], 255.2)),
    },
    PrintedScene {
        name: "chair",
        place: "table 1",
        vertices: 16_101,
        side: 8,
        nonzeros: 40.5,
        operations: [81.0, 9.0],
        operations_left: 11.1,
        megabytes: [6300.0, 36.4],
        megabytes_left: (0.58, 2),
        textures: Some(([1, 2], 169.9)),
    },
    PrintedScene {
        name: "temple",
        place: "table 1",
        vertices: 32_409,
        side: 8,
        nonzeros: 62.8,
        operations: [125.6, 7.9],
        operations_left: 6.3,
        megabytes: [12_600.0, 32.9],
        megabytes_left: (0.26, 2),
        textures: Some(([1, 4], 226.5)),
    },
    PrintedScene {
        name: "middle bunny",
        place: "table 2",
        vertices: 12_380,
        side: 8,
        nonzeros: 39.2,
        operations: [78.4, 21.2],
        operations_left: 27.0,
        megabytes: [4868.0, 84.1],
        megabytes_left: (1.7, 1),
        textures: None,
    },
    PrintedScene {
        name: "fine bunny",
        place: "table 2",
        vertices: 47_960,
        side: 8,
        nonzeros: 151.3,
        operations: [302.7, 80.7],
        operations_left: 26.7,
        megabytes: [18_859.0, 316.9],
        megabytes_left: (1.7, 1),
        textures: None,
    },
];

/// Bunnies of Table II, of which the first is that of Table I.
pub(super) const BUNNIES: [&PrintedScene; 3] = [&SCENES[0], &SCENES[4], &SCENES[5]];
