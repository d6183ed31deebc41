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
