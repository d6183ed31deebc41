//! Pictures: written pictures can be read back, exactly or to the precision of the format, and no bytes cause a panic.

use std::path::Path;

use crossbar::error::InputError;
use crossbar::io::load_picture;
use crossbar::picture::metrics::{ErrorSums, relative_error, value_error};
use crossbar::picture::{ChannelUnit, Picture, Samples, exr, hdr, png, rgb8};
use proptest::prelude::*;

use crate::support::file;

const SIZE: [u32; 2] = [5, 3];
const PIXELS: usize = 15;

/// Colors from dark to brighter than white, with a channel of ids.
fn picture() -> Picture {
    let color: Vec<[f32; 3]> = (0..PIXELS).map(|i| [i as f32 * 0.01, 1.0 / (1 + i) as f32, 40.0 * i as f32]).collect();
    let ids = (0..PIXELS as u32).collect();
    Picture::rgb(SIZE[0], SIZE[1], &color).with("id", ChannelUnit::Id, Samples::Uint(ids)).expect("an id per pixel")
}

/// One file of each format.
fn files() -> [Vec<u8>; 3] {
    let picture = picture();
    let shown = picture.display(1.0).expect("color");
    [png(&shown).expect("a file"), hdr(&picture).expect("a file"), exr(&picture).expect("a file")]
}

fn any_single() -> impl Strategy<Value = f32> {
    any::<u32>().prop_map(f32::from_bits)
}

proptest! {
    #[test]
    fn exr_keeps_every_bit(samples in prop::collection::vec(any_single(), PIXELS), ids in prop::collection::vec(any::<u32>(), PIXELS)) {
        let written = Picture::new(SIZE[0], SIZE[1]).with("a", ChannelUnit::Unknown, Samples::Float(samples.clone()));
        let written = written.and_then(|picture| picture.with("b", ChannelUnit::Id, Samples::Uint(ids.clone())));
        let file = exr(&written.expect("a sample per pixel")).expect("a file");
        let read = Picture::decode(&file).expect("our own file");
        let bits = |samples: &[f32]| samples.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        prop_assert_eq!([read.width(), read.height()], SIZE);
        prop_assert_eq!(bits(read.floats("a").expect("floats").1), bits(&samples));
        prop_assert_eq!(&read.channels()[1].samples, &Samples::Uint(ids));
    }

    #[test]
    fn png_keeps_every_byte(bytes in prop::collection::vec(any::<[u8; 3]>(), PIXELS)) {
        let image = rgb8(SIZE[0], SIZE[1], bytes);
        let read = Picture::decode(&png(&image).expect("a file")).expect("our own file");
        prop_assert_eq!(read.floats("R").expect("red").0, ChannelUnit::Srgb);
        prop_assert_eq!(read.display(1.0).expect("color"), image);
    }

    /// Three mantissas of 8 bits share the exponent of the brightest channel: each channel is accurate to 1/128 of the
    /// brightest, and writing a picture that was read loses nothing.
    #[test]
    fn hdr_keeps_what_its_format_holds(color in prop::collection::vec(prop::array::uniform3(1e-6_f32..1e6), PIXELS)) {
        let read = Picture::decode(&hdr(&Picture::rgb(SIZE[0], SIZE[1], &color)).expect("a file")).expect("our own file");
        for (found, want) in read.linear().expect("color").iter().zip(&color) {
            let brightest = want.iter().copied().fold(0.0, f32::max);
            prop_assert!(found.iter().zip(want).all(|(x, y)| (x - y).abs() <= brightest / 128.0), "{:?}, {:?}", found, want);
        }
        let again = Picture::decode(&hdr(&read).expect("a file")).expect("our own file");
        prop_assert_eq!(again, read);
    }
}

/// Radiance's tools multiply pixels, and record the factor in the header; the factors of several lines are multiplied.
#[test]
fn exposures_of_hdr_files_are_undone() {
    let picture = Picture::rgb(2, 1, &[[1.0, 2.0, 4.0], [0.5, 0.25, 8.0]]);
    let plain = hdr(&picture).expect("a file");
    let with = |lines: &str| {
        let end = plain.windows(2).position(|two| two == b"\n\n").expect("the end of the header") + 1;
        [&plain[..end], lines.as_bytes(), &plain[end..]].concat()
    };
    let read = |lines: &str| Picture::decode(&with(lines));
    assert_eq!(read(""), Ok(picture.clone()));
    // Radiance compares lines from their first column up to `=`.
    for line in [" EXPOSURE=2\n", "\tEXPOSURE=2\n", "EXPOSURE =2\n", " COLORCORR=1 2 2\n", "\tGAMMA=2.2\n"] {
        assert_eq!(read(line), Ok(picture.clone()), "{line}");
    }
    let divided = Picture::rgb(2, 1, &[[0.125, 0.25, 0.5], [0.0625, 0.03125, 1.0]]);
    assert_eq!(read("EXPOSURE=2\nEXPOSURE= 4.0\n"), Ok(divided));
    let corrected = Picture::rgb(2, 1, &[[0.5, 0.5, 1.0], [0.25, 0.0625, 2.0]]);
    assert_eq!(read("COLORCORR=1 2 2\nEXPOSURE=2\n"), Ok(corrected));
    for lines in
        ["EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=NaN\n", "EXPOSURE=1e30\nEXPOSURE=1e30\n", "COLORCORR=1 0 1\n"]
    {
        let error = read(lines).expect_err("refused").to_string();
        assert!(error.contains("positive product"), "{lines}: {error}");
    }
}

fn fixture(name: &str) -> Result<Picture, InputError> {
    load_picture(&file("fixtures/pictures").join(name))
}

/// A picture is an EXR file's display window: 4 x 3 pixels from (-1, 10). OpenEXR's own library wrote the files; where
/// the data window has pixels, red is 1 + column + 10 row.
#[test]
fn exr_files_show_their_display_window() {
    let shown = |name: &str| {
        let picture = fixture(name).expect("a picture");
        assert_eq!([picture.width(), picture.height()], [4, 3]);
        let red = picture.floats("R").expect("floats").1.to_vec();
        assert!(picture.floats("B").expect("floats").1.iter().zip(&red).all(|(blue, red)| *blue == 4.0 * red));
        red
    };
    assert_eq!(shown("inside.exr"), [0.0, 0.0, 0.0, 0.0, 0.0, 12.0, 13.0, 0.0, 0.0, 22.0, 23.0, 0.0]);
    assert_eq!(shown("overscan.exr"), [1.0, 2.0, 0.0, 0.0, 11.0, 12.0, 0.0, 0.0, 21.0, 22.0, 0.0, 0.0]);
    let error = fixture("beside.exr").expect_err("no pixel is shown").to_string();
    let reason = "no pixel of the data window (2x3 at 3, 10) lies in the display window (4x3 at -1, 10)";
    assert!(error.ends_with(reason), "{error}");
}

/// PNG's specification: linear light is a sample to the power of 1 / gamma, unless an sRGB or cICP chunk says
/// otherwise. Samples are 0 to 5 fifths of the maximum.
#[test]
fn png_files_say_what_light_samples_stand_for() {
    let samples = |name: &str| {
        let picture = fixture(name).expect("a picture");
        let channels = ["R", "G", "B"].map(|name| picture.floats(name).expect("floats"));
        (channels[0].0, [0, 1].map(|pixel| channels.map(|(_, samples)| samples[pixel])))
    };
    let fifths = [[0.0, 0.2, 0.4], [0.6, 0.8, 1.0]];
    assert_eq!(samples("gama.png"), (ChannelUnit::Linear, [[0.0, 0.04, 0.16], [0.36, 0.64, 1.0]]));
    assert_eq!(samples("gama_srgb.png"), (ChannelUnit::Srgb, fifths));
    assert_eq!(samples("gama_linear.png"), (ChannelUnit::Linear, fifths));
    assert_eq!(samples("gama_0.png"), (ChannelUnit::Srgb, fifths), "no gamma");
    let error = fixture("pq.png").expect_err("refused").to_string();
    assert!(error.ends_with("expected a cICP chunk of transfer function 8 or 13, found 16"), "{error}");
    let error = fixture("narrow.png").expect_err("refused").to_string();
    assert!(error.ends_with("of full range, found narrow range (video full range flag 0)"), "{error}");
}

/// Header lines of Radiance HDR files other than exposures.
#[test]
fn hdr_files_that_are_not_linear_or_turned_are_refused() {
    let plain = hdr(&Picture::rgb(2, 1, &[[1.0; 3]; 2])).expect("a file");
    let text = |from: &str, to: &str| {
        let at = plain.windows(from.len()).position(|bytes| bytes == from.as_bytes()).expect("it is there");
        Picture::decode(&[&plain[..at], to.as_bytes(), &plain[at + from.len()..]].concat())
    };
    let said = |from, to| text(from, to).expect_err("refused").to_string();
    assert_eq!(text("\n\n", "\nGAMMA= 1.0\n\n"), Picture::decode(&plain));
    assert!(said("\n\n", "\nGAMMA=2.2\n\n").ends_with("(GAMMA=1 or no such line), found GAMMA=2.2"));
    assert!(said("-Y 1 +X 2", "+Y 1 +X 2").contains("Orientation +Y +X"));
    assert!(said("rle_rgbe", "rle_xyze").contains("32-bit_rle_xyze"));
}

/// One rule for `diff` and studies: equal non-finite values have no error; otherwise the error is infinite.
#[test]
fn errors_that_are_not_finite_are_counted_apart() {
    let (nan, infinity) = (f64::NAN, f64::INFINITY);
    let pairs =
        [(3.0, 1.0), (1.0, 1.0), (nan, nan), (infinity, infinity), (nan, 1.0), (1.0, infinity), (-infinity, infinity)];
    let errors = pairs.map(|(found, right)| value_error(found, right));
    assert_eq!(errors, [2.0, 0.0, 0.0, 0.0, infinity, infinity, infinity]);
    assert_eq!(pairs.map(|(found, right)| relative_error(found, right))[..5], [2.0, 0.0, 0.0, 0.0, infinity]);
    assert_eq!([relative_error(2.0, 0.0), relative_error(nan, 0.0), relative_error(0.0, 0.0)], [1.0, infinity, 0.0]);
    let mut sums = ErrorSums::default();
    errors.iter().for_each(|error| sums.add(*error, 2.0));
    assert_eq!((sums.not_finite, sums.largest), (3, infinity));
    assert_eq!([sums.mean(), sums.rms(), sums.squares()], [infinity; 3]);
    let finite = sums.of_finite();
    assert_eq!([finite.mean(), finite.rms(), finite.squares()], [0.5, 1.0, 8.0], "2, 0, 0 and 0, of weight 2");
}

#[test]
fn what_is_wrong_is_said() {
    let said = |bytes: &[u8]| Picture::decode(bytes).expect_err("no picture").to_string();
    assert_eq!(
        said(b"P6 1 1 255"),
        "expected a PNG, Radiance HDR or OpenEXR picture, found a file that begins with 50 36 20 31 20 31 20 32"
    );
    assert_eq!(said(b""), "expected a PNG, Radiance HDR or OpenEXR picture, found a file that begins with nothing");
    let [png, hdr, exr] = files();
    for (bytes, head) in [
        (&png[..40], "the PNG data cannot be read: "),
        (&hdr[..20], "the Radiance HDR data cannot be read: "),
        (&exr[..40], "the EXR data cannot be read: "),
    ] {
        assert!(said(bytes).starts_with(head), "{}", said(bytes));
    }
    let huge = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n";
    assert_eq!(
        said(huge),
        "expected a picture of at most 16384 pixels per side and 1073741824 bytes decoded, found 1000000x1000000 with 3 \
         channels"
    );
    let header = b"IHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x02\0\0\0\x9b\xab\x9c\x31\0\0\0\0IDAT\x35\xaf\x06\x1e";
    let huge = [b"\x89PNG\r\n\x1a\n\0\0\0\x0d", &header[..]].concat();
    assert!(said(&huge).starts_with("expected a picture of at most 16384 pixels per side"), "{}", said(&huge));
    let ids = Picture::new(1, 1).with("id", ChannelUnit::Id, Samples::Uint(vec![0])).expect("one sample");
    let refused = ids.display(1.0).map(|_| ()).unwrap_err().to_string();
    assert_eq!(refused, "expected channels R, G and B, or Y; found id");
    let missing = load_picture(Path::new("no/such.exr")).expect_err("no file");
    assert_eq!(missing.to_string(), "cannot read the picture no/such.exr");
    let other = load_picture(&file("Cargo.toml")).expect_err("no picture").to_string();
    assert!(other.contains(": expected a PNG, Radiance HDR or OpenEXR picture, "), "{other}");
}
