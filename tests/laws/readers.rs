//! Readers of single files: no bytes make a reader panic, and a file that claims 2^32 elements is refused without
//! allocating that much.
#![cfg_attr(not(target_os = "linux"), allow(dead_code, reason = "memory is limited by a shell of Linux"))]

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use crossbar::all_frequency::file::parse_all_frequency;
use crossbar::bi_scale::file::parse_bi_scale;
use crossbar::io;
use crossbar::picture::{ChannelUnit, Picture, Samples, exr, hdr, png};
use crossbar::transfer::file::parse_prt;
use proptest::prelude::*;

use crate::archive::{members, text_of, with_member, with_metadata};
use crate::files::mutation::mutated;

/// Environment variable that is set in the process with a limited address space.
const LIMITED: &str = "CROSSBAR_TEST_LIMITED";
/// Number of bytes at the start of a binary file that are replaced in turn.
const HEAD: usize = 320;
/// The largest number of 32 bits.
const CLAIM: &str = "4294967295";

/// A valid file, and the reader for it.
#[derive(Clone, Debug)]
struct GoodFile {
    name: &'static str,
    bytes: Vec<u8>,
    read: fn(&[u8], &Path),
}

/// 2^32 of the smallest elements are 4 GiB; the readers have an address space of 1.5 GiB, including the program itself.
#[cfg(target_os = "linux")]
#[test]
fn no_reader_takes_memory_on_the_word_of_a_file() {
    if std::env::var_os(LIMITED).is_some() {
        good_files().iter().for_each(read_claims);
        return;
    }
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -v 1500000; exec \"$0\" \"$@\""]).arg(std::env::current_exe().expect("this test"));
    command.args(["--exact", "readers::no_reader_takes_memory_on_the_word_of_a_file", "--nocapture"]);
    let output = command.env(LIMITED, "1").output().expect("a shell");
    let said = [&output.stdout[..], &output.stderr].concat();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&said));
}

/// The good files, made once.
static GOOD: LazyLock<Vec<GoodFile>> = LazyLock::new(good_files);

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn arbitrary_bytes_do_no_harm(bytes in prop::collection::vec(any::<u8>(), 0..300), kept in 0_usize..400) {
        for good in GOOD.iter() {
            (good.read)(&bytes, Path::new(good.name));
            (good.read)(&[&good.bytes[..kept.min(good.bytes.len())], &bytes].concat(), Path::new(good.name));
        }
    }

    #[test]
    fn mutated_files_do_no_harm(
        (name, bytes, read) in prop::sample::select(&GOOD[..])
            .prop_flat_map(|good| (Just(good.name), mutated(good.bytes, 1..12), Just(good.read))),
        cut in any::<prop::sample::Index>(),
    ) {
        read(&bytes, Path::new(name));
        read(&bytes[..cut.index(bytes.len() + 1)], Path::new(name));
    }
}

fn read_claims(good: &GoodFile) {
    for claim in claims(&good.bytes) {
        let start = Instant::now();
        (good.read)(&claim, Path::new(good.name));
        let took = start.elapsed();
        assert!(took < Duration::from_secs(10), "{}: {took:?} for {:?}", good.name, &claim[..claim.len().min(HEAD)]);
    }
}

/// Copies of the file, each with one number replaced by a large one; checksums are valid.
fn claims(good: &[u8]) -> Vec<Vec<u8>> {
    if let Some(text) = std::str::from_utf8(good).ok().filter(|text| !text.contains('\0')) {
        return text_claims(text).into_iter().map(String::into_bytes).collect();
    }
    let is_archive = good.starts_with(io::npz::MAGIC);
    // An archive repeats sizes at its end.
    let last = if is_archive { good.len().saturating_sub(HEAD)..good.len() - 3 } else { 0..0 };
    let mut all = if is_archive { claims_of_members(good) } else { Vec::new() };
    for at in (0..good.len().min(HEAD).saturating_sub(3)).chain(last) {
        for with in [[0xff; 4], [0xff, 0xff, 0xff, 0x7f], [0x7f, 0xff, 0xff, 0xff]] {
            let mut bytes = good.to_vec();
            bytes[at..at + 4].copy_from_slice(&with);
            if good.starts_with(b"\x89PNG") {
                let crc = crc32fast::hash(&bytes[12..29]);
                bytes[29..33].copy_from_slice(&crc.to_be_bytes());
            }
            all.push(bytes);
        }
    }
    all
}

fn text_claims(text: &str) -> Vec<String> {
    let bytes = text.as_bytes();
    let is_first = |at: usize| at == 0 || !bytes[at - 1].is_ascii_digit();
    let numbers = (0..text.len()).filter(|&at| bytes[at].is_ascii_digit() && is_first(at));
    let end = |at: usize| at + bytes[at..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    numbers.map(|at| [&text[..at], CLAIM, &text[end(at)..]].concat()).collect()
}

/// Claims of the metadata and of the arrays' headers.
fn claims_of_members(good: &[u8]) -> Vec<Vec<u8>> {
    let mut all = Vec::new();
    for (name, array) in members(good) {
        let begin = 10 + usize::from(u16::from_le_bytes([array[8], array[9]]));
        for header in text_claims(std::str::from_utf8(&array[10..begin]).expect("text")) {
            let length = (header.len() as u16).to_le_bytes();
            let claim = [&array[..8], &length, header.as_bytes(), &array[begin..]].concat();
            all.push(with_member(good, &name, |_| claim));
        }
        if name == "metadata.npy" {
            let claims = text_claims(text_of(&array)).into_iter();
            all.extend(claims.map(|text| with_metadata(good, |_| text)));
        }
    }
    all
}

fn good_files() -> Vec<GoodFile> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let stored = |path: &str| fs::read(root.join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
    let colors: Vec<[f32; 3]> = (0..64_u8).map(|i| [f32::from(i); 3]).collect();
    let picture = Picture::rgb(8, 8, &colors).with("id", ChannelUnit::Id, Samples::Uint(vec![1; 64])).expect("ids");
    let mut array = Vec::new();
    io::write_npy_array(&[2, 3], &[0.5; 6], &mut array).expect("an array");
    let decoded = |bytes: &[u8], _: &Path| {
        if let Ok(picture) = Picture::decode(bytes) {
            let pixels = picture.width() as usize * picture.height() as usize;
            assert!(picture.channels().iter().all(|channel| channel.samples.len() == pixels));
        }
    };
    let file = |name, bytes: Vec<u8>, read| GoodFile { name, bytes, read };
    vec![
        file("p.png", png(&picture.display(1.0).expect("color")).expect("a file"), decoded),
        file("p.hdr", hdr(&picture).expect("a file"), decoded),
        file("p.exr", exr(&picture).expect("a file"), decoded),
        file("a.npy", array, |bytes, name| {
            drop(io::parse_npy_array::<f32>(bytes, name));
            drop(io::parse_numbers::<f64>(bytes, name));
        }),
        file("t.csv", stored("docs/examples/reflectance.csv"), |bytes, name| {
            drop(io::parse_numbers::<f64>(bytes, name));
            drop(io::parse_numbers::<f32>(bytes, name));
        }),
        file("q.mtx", stored("docs/examples/quarters.mtx"), |bytes, name| drop(io::parse_matrix_market(bytes, name))),
        file("m.obj", stored("fixtures/models/square.obj"), |bytes, name| drop(io::parse_obj(bytes, name))),
        file("m.ply", stored("fixtures/models/square.ply"), |bytes, name| drop(io::parse_ply(bytes, name))),
        file("m.stl", stored("fixtures/models/square.stl"), |bytes, name| drop(io::parse_stl(bytes, name))),
        file(
            "a.stl",
            b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid x\n"
                .to_vec(),
            |bytes, name| drop(io::parse_stl(bytes, name)),
        ),
        file("m.gltf", stored("fixtures/models/square.gltf"), |bytes, name| {
            let mut none = |_: &Path| Err(std::io::Error::other("no file beside it"));
            drop(io::parse_gltf(bytes, name, &mut none));
        }),
        file("a.mtl", stored("docs/examples/room.mtl"), |bytes, name| drop(io::parse_mtl(bytes, name))),
        file("s.obj", stored("docs/examples/room.obj"), |bytes, name| {
            drop(io::parse_scene(bytes, name, &mut |_: &Path| Ok(b"newmtl red\n".to_vec())));
        }),
        file("s.toml", stored("docs/examples/room.toml"), |bytes, name| {
            drop(io::scene_file::parse(&String::from_utf8_lossy(bytes), name));
        }),
        file("r.csv", stored("docs/examples/rays.csv"), |bytes, name| drop(io::parse_rays(bytes, name))),
        file("l.csv", b"face,row,column,r,g,b\n0,0,0,1,1,1\n".to_vec(), |bytes, name| {
            drop(io::parse_cube_table(bytes, name, 4));
        }),
        file("l.sources.csv", b"x,y,z,degrees,r,g,b\n0,0,2,1,1,2,3\n".to_vec(), |bytes, name| {
            drop(io::parse_light_sources(bytes, name));
        }),
        file("s.npz", stored("docs/examples/step_small.npz"), |bytes, name| drop(parse_prt(bytes, name))),
        file("a.npz", stored("docs/examples/step_all_small.npz"), |bytes, name| {
            drop(parse_all_frequency(bytes, name));
        }),
        file("b.npz", stored("docs/examples/step_biclusters.npz"), |bytes, name| drop(parse_bi_scale(bytes, name))),
    ]
}
