use crossbar_ground::picture::Picture;
use crossbar_ground::picture::display::decode;
use crossbar_ground::picture::metrics::{DEFAULT_PPD, FlipMap, ScreenPicture, flip};

fn screen(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [f64; 3]) -> ScreenPicture {
    let pixels: Vec<[f32; 3]> =
        (0..width * height).map(|at| pixel(at % width, at / width).map(|value| decode(value) as f32)).collect();
    ScreenPicture::new(&Picture::rgb(width, height, &pixels), 1.0).expect("color")
}

/// Two patterns of many edges.
fn busy(shift: u32, green: f64) -> ScreenPicture {
    screen(40, 30, |x, y| {
        let cycle = |value: u32, length: u32| f64::from(value % length) / f64::from(length - 1);
        let blue = cycle(x + y * 13 + shift / 2, 16);
        [cycle(x * 7 + y * 3 + shift, 64), cycle(x * 5 + y * 11, 32) * green, blue]
    })
}

/// A gradient, darker in a rectangle.
fn slope(factor: f64) -> ScreenPicture {
    screen(40, 30, |x, y| {
        let inside = (10..30).contains(&x) && (10..20).contains(&y);
        [f64::from(x) / 39.0, f64::from(y) / 29.0, 0.5].map(|value| if inside { value * factor } else { value })
    })
}

#[test]
fn equal_pictures_do_not_differ_and_the_order_does_not_matter() {
    let (one, other) = (busy(0, 1.0), busy(5, 0.9));
    let same = flip(&one, &one, DEFAULT_PPD).expect("one size");
    assert!(same.errors.iter().all(|&error| error == 0.0) && same.mean == 0.0);
    let [there, back] = [flip(&one, &other, 40.0), flip(&other, &one, 40.0)];
    assert_eq!(there, back);
    assert!(there.is_some_and(|map| map.errors.iter().all(|error| (0.0..=1.0).contains(error))));
    assert_eq!(flip(&one, &screen(30, 40, |_, _| [0.0; 3]), 40.0), None);
}

#[test]
fn figures_are_those_of_the_authors_program() {
    let near = |found: f64, want: f64| assert!((found - want).abs() < 5e-4, "{found}, expected {want}");
    let black_white = flip(&screen(8, 8, |_, _| [0.0; 3]), &screen(8, 8, |_, _| [1.0; 3]), DEFAULT_PPD);
    near(black_white.expect("one size").mean, 0.967_388);
    let pixel = |map: &FlipMap, x: usize, y: usize| map.errors[y * 40 + x];
    for (ppd, mean, first, middle, last, maximum) in [
        (DEFAULT_PPD, 0.369_282, 0.262_539, 0.356_791, 0.379_060, 0.738_161),
        (20.0, 0.551_369, 0.136_037, 0.635_261, 0.563_953, 0.972_233),
    ] {
        let map = flip(&busy(0, 1.0), &busy(5, 0.9), ppd).expect("one size");
        near(map.mean, mean);
        near(map.maximum, maximum);
        near(pixel(&map, 0, 0), first);
        near(pixel(&map, 20, 15), middle);
        near(pixel(&map, 39, 29), last);
    }
    for (ppd, mean, corner, middle, maximum) in
        [(DEFAULT_PPD, 0.091_641, 0.214_547, 0.385_401, 0.484_897), (20.0, 0.075_501, 0.309_65, 0.356_702, 0.560_229)]
    {
        let map = flip(&slope(1.0), &slope(0.8), ppd).expect("one size");
        near(map.mean, mean);
        near(map.maximum, maximum);
        near(pixel(&map, 10, 10), corner);
        near(pixel(&map, 20, 15), middle);
    }
}
