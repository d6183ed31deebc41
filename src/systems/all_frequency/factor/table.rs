//! Tables of f at texels of two parabolic maps: Q of section 3.

use std::path::Path;

use crate::error::{InputError, input_error};
use crate::io::{NumberTable, load_numbers, number_table};
use crate::linalg::Matrix;
use crate::sphere::ParabolicMap;

/// Maximum number of texels along an edge of a map.
pub const MAX_MAP_SIDE: usize = 48;

/// Q: f at each texel of the view's map (row) and of the light's map (column). Texels are numbered row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct ProductTable {
    view: ParabolicMap,
    light: ParabolicMap,
    values: Matrix,
}

impl ProductTable {
    /// A table from values, with one row per texel of the view's map and one column per texel of the light's. Panics
    /// unless the numbers of rows and columns are the maps' numbers of texels.
    pub(super) fn new([view, light]: [ParabolicMap; 2], values: Matrix) -> Self {
        assert_eq!([values.row_count(), values.column_count()], [view.texels(), light.texels()], "a value per texel");
        Self { view, light, values }
    }

    /// A table from rows of numbers; `name` is the file's name in messages. Fails with [`InputError`] if the number of
    /// rows or columns is not a square map's number of texels, or a number is below 0, NaN or infinite.
    pub fn of_numbers(table: &NumberTable<f64>, name: &Path) -> Result<Self, InputError> {
        let columns = table.columns.max(1);
        let map = |what: &'static str, found: usize| {
            let side = found.isqrt();
            let fits = side * side == found && (1..=MAX_MAP_SIDE).contains(&side);
            let refused = || {
                input_error!("crossbar::factor::shape" =>
                    "expected a square number of {what} up to {}, a texel of a square map each, found {found}",
                    MAX_MAP_SIDE * MAX_MAP_SIDE;
                    help "a map of 32 x 32 texels has 1024; rows are views, columns lights, texels row by row")
                .at(name)
            };
            if fits { Ok(ParabolicMap::new(side)) } else { Err(refused()) }
        };
        let maps = [map("rows", table.values.len() / columns)?, map("columns", table.columns)?];
        if let Some(at) = table.values.iter().position(|&value| !(value.is_finite() && value >= 0.0)) {
            let [row, column] = [at / columns, at % columns];
            return Err(input_error!("crossbar::factor::number" =>
                "expected finite numbers of at least 0, found {} in row {row}, column {column} (counted from 0)",
                table.values[at]; help "the table holds reflectance times the light's cosine")
            .at(name));
        }
        let values =
            Matrix::new(maps.map(ParabolicMap::texels), table.values.clone()).expect("whole rows of a small matrix");
        Ok(Self::new(maps, values))
    }

    /// The map of views.
    pub const fn view(&self) -> ParabolicMap {
        self.view
    }

    /// The map of lights.
    pub const fn light(&self) -> ParabolicMap {
        self.light
    }

    /// The values: a row per view, a column per light.
    pub const fn values(&self) -> &Matrix {
        &self.values
    }

    /// f between texels, bilinear in both maps.
    pub fn interpolated(&self, view: glam::DVec3, light: glam::DVec3) -> f64 {
        let lights = self.light.taps(light);
        let along = |row: &[f64]| lights.iter().map(|&(at, weight)| weight * row[at]).sum::<f64>();
        self.view.taps(view).iter().map(|&(at, weight)| weight * along(self.values.row(at))).sum()
    }
}

/// Reads a table from a file: comma-separated values or a NumPy array, recognised by the first bytes.
pub fn load_product_table(path: &Path) -> Result<ProductTable, InputError> {
    let table = load_numbers(path, "table of reflectance", number_table::MAX_BYTES)?;
    ProductTable::of_numbers(&table, path)
}
