//! Strips of the page: measured colors above the colors of each answer, with the difference in codes.

use super::rule::Measured;
use super::values::{Value, Values};
use font8x8::legacy::BASIC_LEGACY;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Values that a strip shows.
const SHOWN: usize = 96;
/// Sizes in pixels: the strips, a strip of colors, the bars below it, the space below those, a letter.
const WIDTH: usize = 480;
const COLORS: usize = 14;
const BARS: usize = 17;
const SPACE: usize = 5;
const LETTER: usize = 8;
/// The longest bar, and its growth for each code.
const LONGEST: usize = 8;
const PER_CODE: usize = 3;

const WHITE: [u8; 3] = [255; 3];
const BLACK: [u8; 3] = [0; 3];
const GROUND: [u8; 3] = [232; 3];
const EDGE: [u8; 3] = [128; 3];
/// The drawn code is above the measured one, below it, or different in a way that the strip does not show.
const ABOVE: [u8; 3] = [0xd5, 0x5e, 0x00];
const BELOW: [u8; 3] = [0x00, 0x72, 0xb2];
const ELSEWHERE: [u8; 3] = [0x00, 0x00, 0x00];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/pictures/measured")
}

/// File of a rule's picture, from the first words of its name.
fn file(measured: &Measured) -> String {
    let words = measured.rule.name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<String> = words.take(6).map(str::to_lowercase).collect();
    format!("{}.png", words.join("-"))
}

/// The section of the page with all pictures.
pub(crate) fn section(all: &[Measured]) -> String {
    let files: BTreeSet<String> = all.iter().map(file).collect();
    assert_eq!(files.len(), all.len(), "a file for each rule");
    let picture = |measured: &Measured| {
        let (name, file) = (measured.rule.name, file(measured));
        format!("{name}:\n\n![Measured values, and what each answer draws](pictures/measured/{file})\n")
    };
    all.iter().map(picture).collect::<Vec<_>>().join("\n")
}

/// Writes all pictures, or compares those that there are, and leaves no other file in their folder.
pub(crate) fn hold(all: &[Measured], write: bool) {
    if write {
        fs::create_dir_all(folder()).expect("a folder");
    }
    let there = fs::read_dir(folder()).expect("the folder").map(|entry| entry.expect("a file").path());
    let expected: BTreeSet<PathBuf> = all.iter().map(|measured| folder().join(file(measured))).collect();
    for stale in there.filter(|path| !expected.contains(path)) {
        assert!(write, "{} belongs to no rule", stale.display());
        fs::remove_file(stale).expect("removed");
    }
    for measured in all {
        let (path, picture) = (folder().join(file(measured)), Picture::of(measured));
        match write {
            true => fs::write(&path, picture.png()).expect("written"),
            false => assert!(Picture::read(&path) == picture, "{}: the picture of the rule", path.display()),
        }
    }
}

/// Rows of pixels, red, green and blue.
#[derive(PartialEq, Eq)]
struct Picture {
    width: usize,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    fn of(measured: &Measured) -> Self {
        let shown = shown(&measured.values);
        let label = |name: &str, values: &Values| format!("{name}: {} of {}", values.right(), values.all());
        let labels: Vec<String> = measured.values.iter().map(|(name, values)| label(name, values)).collect();
        let longest = labels.iter().map(String::len).max().unwrap_or_default().max("measured".len());
        let left = (longest + 1) * LETTER;
        let strip = COLORS + BARS + SPACE;
        let (width, height) = (left + WIDTH, COLORS + SPACE + labels.len() * strip);
        let mut picture = Self { width, pixels: vec![WHITE; width * height] };
        let cell = |i: usize| left + i * WIDTH / shown.len()..left + (i + 1) * WIDTH / shown.len();
        picture.write("measured", [0, 3]);
        picture.fill(left..width, 0..COLORS, EDGE);
        for (i, &value) in shown.iter().enumerate() {
            picture.fill(cell(i), 1..COLORS - 1, measured.values[0].1.0[value].measured);
        }
        for (number, (label, (_, values))) in labels.iter().zip(&measured.values).enumerate() {
            let top = COLORS + SPACE + number * strip;
            picture.write(label, [0, top + 3]);
            picture.fill(left..width, top..top + COLORS, EDGE);
            picture.fill(left..width, top + COLORS + 1..top + COLORS + BARS, GROUND);
            for (i, &value) in shown.iter().enumerate() {
                let value = values.0[value];
                picture.fill(cell(i), top + 1..top + COLORS - 1, value.drawn);
                let middle = top + COLORS + 1 + LONGEST;
                let (color, rows) = match bar(value) {
                    None => continue,
                    Some(0) => (ELSEWHERE, middle - 1..middle + 1),
                    Some(off @ 1..) => (ABOVE, middle - off.unsigned_abs()..middle),
                    Some(off) => (BELOW, middle..middle + off.unsigned_abs()),
                };
                picture.fill(cell(i), rows, color);
            }
        }
        picture
    }

    fn fill(&mut self, columns: std::ops::Range<usize>, rows: std::ops::Range<usize>, color: [u8; 3]) {
        for row in rows {
            self.pixels[row * self.width..][columns.clone()].fill(color);
        }
    }

    fn write(&mut self, text: &str, [x, y]: [usize; 2]) {
        for (i, byte) in text.bytes().enumerate() {
            let glyph = BASIC_LEGACY.get(usize::from(byte)).unwrap_or(&BASIC_LEGACY[usize::from(b'?')]);
            for (row, bits) in glyph.iter().enumerate() {
                for column in (0..LETTER).filter(|column| bits >> column & 1 == 1) {
                    self.pixels[(y + row) * self.width + x + i * LETTER + column] = BLACK;
                }
            }
        }
    }

    fn png(&self) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width as u32, (self.pixels.len() / self.width) as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(self.pixels.as_flattened()).expect("pixels");
        writer.finish().expect("an end");
        file
    }

    fn read(path: &Path) -> Self {
        let file = fs::File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG file");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut bytes).expect("pixels");
        Self { width: info.width as usize, pixels: bytes.as_chunks().0.to_vec() }
    }
}

/// Positions of the values that are shown: of those about which the same answers are right as many as of any others,
/// evenly chosen.
fn shown(hypotheses: &[(String, Values)]) -> Vec<usize> {
    let mut alike: BTreeMap<Vec<bool>, Vec<usize>> = BTreeMap::new();
    for i in 0..hypotheses[0].1.all() {
        alike.entry(hypotheses.iter().map(|(_, values)| values.0[i].right).collect()).or_default().push(i);
    }
    let mut groups: Vec<Vec<usize>> = alike.into_values().collect();
    groups.sort_by_key(Vec::len);
    let mut chosen = Vec::new();
    for (number, group) in groups.iter().enumerate() {
        // Columns that a small group does not use go to the larger ones.
        let count = group.len().min((SHOWN - chosen.len()) / (groups.len() - number));
        chosen.extend((0..count).map(|i| group[i * group.len() / count]));
    }
    chosen.sort_unstable();
    chosen
}

/// Length of the bar of a wrong value, upward if more was drawn than measured: of the component that is most off.
fn bar(value: Value) -> Option<isize> {
    let off = |i: usize| isize::from(value.drawn[i]) - isize::from(value.measured[i]);
    let most = [0, 1, 2].map(off).into_iter().max_by_key(|off| off.unsigned_abs())?;
    let length = LONGEST.min(PER_CODE * most.unsigned_abs()).cast_signed();
    (!value.right).then_some(most.signum() * length)
}
