//! fixtures/probes: operations of pixel programs, with the colors that real cards draw or documents state.

use std::{fmt::Write as _, path::Path};

use crossbar::case::{Loaded, Setup};
use refsim::machine::ExecutorKind;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    probe: Vec<Probe>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Probe {
    name: String,
    source: String,
    /// Devices, each with the switches that it needs.
    devices: Vec<String>,
    /// The case without device, target and probes.
    case: String,
    /// Colors as `rrggbb`, row by row.
    expected: Vec<Vec<String>>,
    /// Allowed error of a channel.
    slop: u8,
    /// Width and height of a color's cell, in pixels.
    #[serde(default = "one")]
    cell: u32,
    #[serde(default)]
    clear: [f64; 4],
}

fn one() -> u32 {
    1
}

fn color(text: &str) -> [u8; 3] {
    let bits = u32::from_str_radix(text, 16).expect("rrggbb");
    let [_, r, g, b] = bits.to_be_bytes();
    [r, g, b]
}

impl Probe {
    /// The case on a device.
    fn setup(&self, device: &str) -> Setup {
        let mut words = device.split(' ');
        let mut text = format!("device = \"{}\"\n[switches]\n", words.next().unwrap_or_default());
        for (name, value) in words.filter_map(|switch| switch.split_once('=')) {
            writeln!(text, "{name} = \"{value}\"").expect("a string takes everything");
        }
        let size = [self.expected[0].len() as u32 * self.cell, self.expected.len() as u32 * self.cell];
        write!(text, "{}[target]\nsize = {size:?}\nformat = \"bgrx8\"\nclear = {:?}\n", self.case, self.clear)
            .expect("a string takes everything");
        Setup::from_bytes(&self.name, text.as_bytes(), Path::new("."))
            .unwrap_or_else(|error| panic!("{} on {device}: {:?}", self.name, miette::Report::from(error)))
    }

    /// Every wrong color.
    fn wrong(&self, device: &str, found: &[Vec<[u8; 3]>]) -> Vec<String> {
        let mut wrong = Vec::new();
        for (y, (expected, found)) in self.expected.iter().zip(found).enumerate() {
            for (x, (expected, found)) in expected.iter().zip(found).enumerate() {
                let near = color(expected).iter().zip(found).all(|(e, f)| e.abs_diff(*f) <= self.slop);
                if !near {
                    let [r, g, b] = found;
                    let name = &self.name;
                    wrong.push(format!(
                        "{name} on {device} at ({x}, {y}): expected {expected}, found {r:02x}{g:02x}{b:02x}"
                    ));
                }
            }
        }
        wrong
    }

    fn draw(&self, setup: &Setup, executor: ExecutorKind) -> Vec<Vec<[u8; 3]>> {
        let mut loaded = Loaded::new(setup, executor).expect("the case can be loaded");
        loaded.draw().expect("the case can be drawn");
        let target = loaded.targets().expect("the targets can be read")[0];
        let place = |i: usize| i as u32 * self.cell + self.cell / 2;
        let pixel = |y: usize, x: usize| {
            let [b, g, r, _] = (target.raw(0, 0, place(y), place(x)) as u32).to_le_bytes();
            [r, g, b]
        };
        (0..self.expected.len()).map(|y| (0..self.expected[0].len()).map(|x| pixel(y, x)).collect()).collect()
    }
}

#[test]
fn cards_make_the_colours_of_the_table() {
    let table: Table =
        toml::from_str(include_str!("../../fixtures/probes/pixel_shaders.toml")).expect("a table of probes");
    let mut wrong = Vec::new();
    for probe in &table.probe {
        let known = probe.source.starts_with("Wine, ") || probe.source.starts_with("derived: ");
        assert!(known && !probe.devices.is_empty(), "{} says where it is from, and where it holds", probe.name);
        for device in &probe.devices {
            let setup = probe.setup(device);
            let found = probe.draw(&setup, ExecutorKind::Scalar);
            assert_eq!(found, probe.draw(&setup, ExecutorKind::Batch), "{} on {device}: executors agree", probe.name);
            wrong.extend(probe.wrong(device, &found));
        }
    }
    assert!(wrong.is_empty(), "{} colours are off:\n{}", wrong.len(), wrong.join("\n"));
}

/// According to GL_NV_texture_shader, 1.0 in a combiner register is code 255, but a unit of 1/256 is not 1/255:
/// compares the products of all pairs of 8-bit texels with exact products of 255ths rounded once.
#[test]
fn units_of_256_cost_products_one_code_at_most() {
    use refsim::num::{Format, from_ratio, ops};
    let format: Format = "s3.8".parse().expect("a format");
    let (mut off, mut most) = (0, 0);
    for a in 0..=255_u32 {
        for b in 0..=255_u32 {
            let [x, y] = [a, b].map(|code| from_ratio(format, false, code.into(), 255).bits);
            // Converts the register as stores to targets do: to the nearest 255th, ties up.
            let found = (ops::mul(format, x, y).bits * 255 * 2 + 256) / 512;
            let exact = (a * b * 2 + 255) / 510;
            off += u32::from(found != exact);
            most = most.max(found.abs_diff(exact));
        }
    }
    assert_eq!((most, off), (1, 8739), "the largest difference, and how many of 65536 products differ");
}
