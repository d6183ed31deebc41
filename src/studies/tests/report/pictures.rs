//! Pictures on pages, and false colors.

use std::borrow::Cow;

use crossbar_ground::picture::{RgbImage, rgb8};
use crossbar_studies::report::false_color::{magnitude, signed};
use crossbar_studies::report::{Findings, NamedPicture};
use proptest::prelude::*;

use super::{between, page};

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

/// Classes and width, in pixels, of each size of the first of `count` pictures of one row on a page.
fn sizes(width: u32, count: usize) -> Vec<(String, u32)> {
    let picture = |n: usize| NamedPicture::new(format!("p{n}"), rgb8(width, 1, vec![[0; 3]; width as usize]), "p");
    let mut found = Findings::new("t");
    found.pictures((0..count).map(picture).collect());
    let html = page(found);
    let figure = between(&html, "<figure class=\"picture\"", "</figure>").next().expect("a figure").to_owned();
    let size = |image: &str| {
        let value = |name: &str| between(image, &format!("{name}=\""), "\"").next().expect("an attribute").to_owned();
        (value("class"), value(" width").parse().expect("a number"))
    };
    between(&figure, "<img ", ">").map(size).collect()
}

#[test]
fn pictures_share_a_row_of_a_screen() {
    let wide = |count| sizes(16_000, count).iter().find(|(class, _)| class.contains("wide")).expect("a size").1;
    assert!(3 * wide(3) + 2 * 20 <= 1226 && wide(7) == wide(3) && wide(1) > 2 * wide(3));
    let size = |classes: &str, width| (format!("size {classes}"), width);
    assert_eq!(sizes(640, 3), [size("narrow middle wide", 320), size("full", 640)]);
    for (width, shown) in [(20, 160), (40, 320), (160, 320), (300, 300), (320, 320)] {
        assert_eq!(sizes(width, 3), [size("narrow middle wide full", shown)]);
    }
}

#[test]
fn a_picture_alone_is_enlarged_by_a_whole_factor() {
    let mut found = Findings::new("t");
    found.pictures(vec![NamedPicture::new("p", rgb8(160, 1, vec![[0; 3]; 160]), "a caption")]);
    let html = page(found);
    assert!(html.contains("id=\"picture-0\" style=\"--zoomed: 1120px\"") && html.contains("href=\"#caption-0\""));
}

fn rgb(image: &RgbImage, x: u32, y: u32) -> [u8; 3] {
    image.get_pixel(x, y).0
}

#[test]
fn darker_is_blue_brighter_red_and_the_bar_runs_the_same_way() {
    let image = signed(4, &[-2.0, 0.0, 2.0, f64::NAN], 2.0);
    let [[r0, _, b0], white, [r1, _, b1], none] = [0, 1, 2, 3].map(|x| rgb(&image, x, 0));
    assert!(b0 > r0 && r1 > b1 && white.iter().all(|&channel| channel > 225) && none == [0; 3]);
    let [[r0, _, b0], [r1, _, b1]] = [0, 3].map(|x| rgb(&image, x, 2));
    assert!(b0 > r0 && r1 > b1, "the bar");
    let image = magnitude(2, &[0.0, f64::INFINITY]);
    assert!(rgb(&image, 0, 0) != rgb(&image, 1, 0), "infinity is not 0");
    let image = magnitude(2, &[0.0, 1.0]);
    let sum = |color: [u8; 3]| color.map(u32::from).iter().sum::<u32>();
    assert!(sum(rgb(&image, 0, 0)) < sum(rgb(&image, 1, 0)) && sum(rgb(&image, 0, 2)) < sum(rgb(&image, 1, 2)));
}
