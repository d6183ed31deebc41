//! The fragment programs of matrix radiosity as text. Solver programs are written for a block of one texel; the marked
//! part is unrolled for each texel of a block, since these programs have no loops. Display programs are complete.

use super::packing::Packing;
use crate::card::{KernelText, kernels};

kernels! {
    /// Solver programs, to be unrolled for a block.
    BLOCKS:
    RGB_FIRST "rgb_first.fp"
    RGB_NEXT "rgb_next.fp"
    LUMINANCE_FIRST "luminance_first.fp"
    LUMINANCE_NEXT "luminance_next.fp"
    RGB_FIRST_HALF "rgb_first_half.fp"
    RGB_NEXT_HALF "rgb_next_half.fp"
    LUMINANCE_FIRST_HALF "luminance_first_half.fp"
    LUMINANCE_NEXT_HALF "luminance_next_half.fp"
    PRODUCT_FIRST "product_first.fp"
    PRODUCT_NEXT "product_next.fp"
}

kernels! {
    /// Display programs.
    DRAWING:
    FLAT "flat.fp"
    ID "id.fp"
    RESAMPLE "resample.fp"
    SMOOTH_QUAD "smooth_quad.fp"
    SMOOTH_TRIANGLE "smooth_triangle.fp"
}

/// The programs of the first pass of an iteration and of the later ones.
pub fn of(packing: Packing, half: bool) -> [KernelText; 2] {
    match (packing, half) {
        (Packing::Rgb, false) => [RGB_FIRST, RGB_NEXT],
        (Packing::Rgb, true) => [RGB_FIRST_HALF, RGB_NEXT_HALF],
        (Packing::Luminance, false) => [LUMINANCE_FIRST, LUMINANCE_NEXT],
        (Packing::Luminance, true) => [LUMINANCE_FIRST_HALF, LUMINANCE_NEXT_HALF],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::radiosity::model::{BLOCK, MAX_INSTRUCTIONS};

    #[test]
    fn a_block_of_the_paper_is_the_longest_that_fits() {
        let most = MAX_INSTRUCTIONS as usize;
        for kernel in BLOCKS {
            let [rest, each] = [kernel.overhead(), kernel.per_texel()];
            let block = kernel.block(most);
            let expected = if each == 4 { BLOCK as usize } else { 204 };
            assert!(rest >= 3 && block >= expected, "{}: {rest} and {each}", kernel.name);
        }
        for packing in [Packing::Rgb, Packing::Luminance] {
            let least = of(packing, false).map(|kernel| kernel.block(most)).into_iter().min();
            assert_eq!(least, Some(BLOCK as usize));
        }
    }

    #[test]
    fn files_are_programs_for_one_texel() {
        for kernel in BLOCKS {
            let stripped = |text: &str| -> Vec<String> {
                text.lines().filter(|line| line.ends_with(';')).map(str::to_owned).collect()
            };
            assert_eq!(stripped(&kernel.unrolled(1)), stripped(kernel.text), "{}", kernel.name);
        }
    }
}
