//! The normalised, non-standard Haar transform of a square of 2^k x 2^k numbers (section 4; \[NRH03\]).
//!
//! A level maps four neighbors a b / c d to the average (a + b + c + d) / 2, and to differences across columns (a - b +
//! c - d) / 2, across rows (a + b - c - d) / 2, and across both (a - b - c + d) / 2. The next level transforms the
//! averages. The transform is orthonormal. Coefficients have the usual pyramid layout: the averages of a level are in
//! the upper left quarter of its square, differences across columns in the upper right, across rows in the lower left,
//! across both in the lower right.

/// The transform of squares of a fixed size.
#[derive(Clone, Debug)]
pub struct Haar {
    side: usize,
    scratch: Vec<f64>,
}

/// The square of numbers at which a basis function is not 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HaarSupport {
    /// The first row.
    pub row: usize,
    /// The first column.
    pub column: usize,
    /// Number of rows, and of columns.
    pub side: usize,
}

impl Haar {
    /// The transform of squares with `side` numbers along an edge, a power of two. Panics if `side` is not a power of
    /// two.
    pub fn new(side: usize) -> Self {
        assert!(side.is_power_of_two(), "a power of two along an edge, not {side}");
        Self { side, scratch: vec![0.0; side * side] }
    }

    /// Transforms a square, row by row, to its coefficients. Panics if it has another size.
    pub fn forward(&mut self, square: &mut [f64]) {
        assert_eq!(square.len(), self.side * self.side, "a square of side {}", self.side);
        let mut half = self.side / 2;
        while half > 0 {
            for row in 0..half {
                for column in 0..half {
                    let at = 2 * row * self.side + 2 * column;
                    let [a, b, c, d] = [at, at + 1, at + self.side, at + self.side + 1].map(|at| square[at]);
                    let quarters = butterfly([a, b, c, d]);
                    self.places(half, row, column).into_iter().zip(quarters).for_each(|(at, q)| self.scratch[at] = q);
                }
            }
            for row in 0..2 * half {
                let part = row * self.side..row * self.side + 2 * half;
                square[part.clone()].copy_from_slice(&self.scratch[part]);
            }
            half /= 2;
        }
    }

    /// Inverse transform, in place: coefficients to the numbers of the square. Panics if the length is not the
    /// square's.
    pub fn inverse(&mut self, coefficients: &mut [f64]) {
        assert_eq!(coefficients.len(), self.side * self.side, "a square of side {}", self.side);
        let mut half = 1;
        while half < self.side {
            for row in 0..half {
                for column in 0..half {
                    let quarters = self.places(half, row, column).map(|at| coefficients[at]);
                    let at = 2 * row * self.side + 2 * column;
                    let places = [at, at + 1, at + self.side, at + self.side + 1];
                    places.into_iter().zip(butterfly(quarters)).for_each(|(at, value)| self.scratch[at] = value);
                }
            }
            for row in 0..2 * half {
                let part = row * self.side..row * self.side + 2 * half;
                coefficients[part.clone()].copy_from_slice(&self.scratch[part]);
            }
            half *= 2;
        }
    }

    /// The indices of an average and its three differences in a level of 2 x `half` rows.
    const fn places(&self, half: usize, row: usize, column: usize) -> [usize; 4] {
        let at = row * self.side + column;
        [at, at + half, at + half * self.side, at + half * self.side + half]
    }

    /// The support of a coefficient's basis function. Panics if there is no such coefficient.
    pub fn support(&self, coefficient: usize) -> HaarSupport {
        assert!(coefficient < self.side * self.side, "a coefficient of a square of side {}", self.side);
        let [row, column] = [coefficient / self.side, coefficient % self.side];
        let largest = row.max(column);
        if largest == 0 {
            return HaarSupport { row: 0, column: 0, side: self.side };
        }
        // The largest power of two up to `largest` is the number of the level's squares along an edge.
        let half = 1 << largest.ilog2();
        let side = self.side / half;
        HaarSupport { row: row % half * side, column: column % half * side, side }
    }
}

/// Transforms four numbers of a level; it is its own inverse.
const fn butterfly([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    let ([left, right], [above, below]) = ([a + c, b + d], [a - b, c - d]);
    [(left + right) / 2.0, (above + below) / 2.0, ((a + b) - (c + d)) / 2.0, (above - below) / 2.0]
}
