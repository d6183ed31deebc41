//! Pictures on pages, and false colors.

use crossbar_ground::picture::{RgbImage, rgb8};
use crossbar_studies::report::false_color::{magnitude, signed};
use crossbar_studies::report::{Findings, NamedPicture};

use super::{between, page};

/// Returns `true` if the first of `count` pictures of a width is enlarged on a page, and its width in pixels.
fn shown(width: u32, count: usize) -> (bool, u32) {
    let picture = |n: usize| NamedPicture::new(format!("p{n}"), rgb8(width, 1, vec![[0; 3]; width as usize]), "p");
    let mut found = Findings::new("t");
    found.pictures((0..count).map(picture).collect());
    let html = page(found);
    let image = between(&html, "<img ", ">").next().expect("an image").to_owned();
    let width = between(&image, " width=\"", "\"").next().expect("a width").parse().expect("a number");
    (image.contains("enlarged"), width)
}

#[test]
fn pictures_are_shown_pixel_by_pixel_and_small_ones_enlarged() {
    for (width, is_enlarged, on_page) in [(20, true, 160), (40, true, 320), (160, true, 320), (161, false, 161)] {
        assert_eq!([shown(width, 1), shown(width, 3)], [(is_enlarged, on_page); 2]);
    }
    assert_eq!([shown(512, 3), shown(16_000, 1)], [(false, 512), (false, 16_000)]);
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
