//! Downscaling of pictures for a page: by whole factors, without smoothing, and keeping marked pixels.

use std::borrow::Cow;

use super::NamedPicture;
use crate::picture::RgbImage;

impl NamedPicture {
    /// Smallest whole factor by which the picture is at most this wide; 1 if it fits.
    pub fn reduction(&self, width: u32) -> u32 {
        self.image.width().div_ceil(width.max(1)).max(1)
    }

    /// Downscales by a whole factor: of each block of pixels, takes the one of the highest rank, the first of these
    /// from the top left. A block without marked pixels shows its middle one.
    pub fn reduced(&self, factor: u32) -> Cow<'_, RgbImage> {
        if factor <= 1 {
            return Cow::Borrowed(&self.image);
        }
        let (width, height) = self.image.dimensions();
        Cow::Owned(RgbImage::from_fn(width.div_ceil(factor), height.div_ceil(factor), |x, y| {
            let block = |from: u32, side: u32| (from * factor)..(from * factor + factor).min(side);
            let (columns, rows) = (block(x, width), block(y, height));
            let middle = ((columns.start + columns.end - 1) / 2, (rows.start + rows.end - 1) / 2);
            let mut worst = (0, middle);
            for place in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
                let rank = self.rank(place);
                if rank > worst.0 {
                    worst = (rank, place);
                }
            }
            let (_, (x, y)) = worst;
            *self.image.get_pixel(x, y)
        }))
    }

    /// Rank of a pixel; 0 if it is not marked.
    fn rank(&self, (x, y): (u32, u32)) -> u8 {
        let place = y as usize * self.image.width() as usize + x as usize;
        self.ranks.get(place).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::rgb8;
    use proptest::prelude::*;

    proptest! {
        /// Every marked pixel survives: its block shows a marked pixel of its own rank or a higher one.
        #[test]
        fn no_marked_pixel_is_lost(
            (width, height) in (1..40_u32, 1..40_u32),
            seed in prop::collection::vec(prop_oneof![9 => Just(0_u8), 1 => 1..4_u8], 40 * 40),
            room in 1..20_u32,
        ) {
            // A pixel's colour is its rank.
            let ranks = seed[..(width * height) as usize].to_vec();
            let image = rgb8(width, height, ranks.iter().map(|rank| [*rank; 3]));
            let picture = NamedPicture::new("p", image, "").marked(ranks);
            let factor = picture.reduction(room);
            let shown = picture.reduced(factor);
            prop_assert!(shown.width() <= room && shown.height() == height.div_ceil(factor));
            for (x, y, pixel) in picture.image.enumerate_pixels() {
                prop_assert!(shown.get_pixel(x / factor, y / factor).0[0] >= pixel.0[0]);
            }
            // And nothing else is drawn: what is shown marked is marked in the block.
            for (x, y, pixel) in shown.enumerate_pixels() {
                let block = picture.image.enumerate_pixels().filter(|(a, b, _)| (a / factor, b / factor) == (x, y));
                prop_assert_eq!(block.map(|(_, _, p)| p.0[0]).max(), Some(pixel.0[0]));
            }
        }
    }

    #[test]
    fn a_picture_that_fits_is_shown_as_it_is() {
        let picture = NamedPicture::new("p", rgb8(3, 2, [[1; 3]; 6]), "");
        assert_eq!((picture.reduction(3), picture.reduction(2)), (1, 2));
        assert!(matches!(picture.reduced(1), Cow::Borrowed(same) if *same == picture.image));
    }
}
