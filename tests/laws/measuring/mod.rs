//! Tests fixtures/probes/open, which has a small case for each open switch of a card. Owners of the card can draw it to
//! find the switch's value. docs/measuring.md lists the cases.

mod probe;

use crate::pages::hold;
use crate::support::{file, profile};
use std::fs;
use std::path::PathBuf;

use crossbar::case::Setup;
use refsim::machine::ExecutorKind;

/// The cards, without variants that differ only in clocks.
const CARDS: [&str; 6] = ["nv20", "nv25", "r200", "r300", "nv30", "nv35"];
const PRODUCTS: &str = "the only product out of range is -3 times -3, and with any third operand both results exceed 1, \
                        where registers end; else rounding commutes with the addition of multiples of the unit";
const SIGNED: &str = "a signed byte k is 2k / 255 while texels are bytes (switch texel-values)";
const TEXELS: &str = "chooses the texel format of a system's textures: the card has it, or refuses it";

/// Device, switch and reason, for switches whose values draw the same with every program of the card.
const UNDRAWN: [(&str, &str, &str); 5] = [
    ("nv20", "mad", PRODUCTS),
    ("nv20", "signed-texel-minimum", SIGNED),
    ("nv25", "mad", PRODUCTS),
    ("nv25", "signed-texel-minimum", SIGNED),
    ("r200", "ray-textures", TEXELS),
];

/// The reason why no draw can distinguish the values of a switch, if it is known to be so.
fn undrawn(device: &str, switch: &str) -> Option<&'static str> {
    UNDRAWN.iter().find(|(name, of, _)| *name == device && *of == switch).map(|(_, _, why)| *why)
}

/// Two values of each switch draw different codes, and the batch executor produces the reference's bits. The page's table
/// lists the probes, and the folder has no other files, so a settled switch cannot leave a probe behind.
#[test]
fn each_open_switch_has_a_probe_that_the_page_lists() {
    let mut table =
        "| card | switch | default | told apart | probe | measured |\n|---|---|---|---|---|---|\n".to_owned();
    let mut places = Vec::new();
    for device in CARDS {
        for switch in probe::open(&profile(device)) {
            let row = match undrawn(device, &switch.name) {
                Some(why) => format!("{} | none: {why} | ", switch.values.join(", ")),
                None => {
                    let path = format!("fixtures/probes/open/{device}/{}.toml", switch.name);
                    let setup = Setup::read(&file(&path)).expect("a case");
                    let text = fs::read_to_string(file(&path)).expect("a case");
                    let groups = probe::groups(&text, switch).expect("it can be drawn");
                    assert!(groups.len() > 1, "{path} tells no values apart");
                    for (codes, values) in &groups {
                        let batch = |value| probe::codes(&text, (&switch.name, value), ExecutorKind::Batch);
                        assert!(values.iter().all(|value| batch(value).as_ref() == Some(codes)), "{path}, {values:?}");
                    }
                    places.push(file(&path));
                    let told: Vec<String> = groups.iter().map(|(_, values)| values.join(", ")).collect();
                    let depth = if setup.depth.is_some() { ", depth" } else { "" };
                    let [width, height] = setup.size;
                    let told = told.join(" / ");
                    format!("{told} | [{device}/{}.toml](../{path}) | {width} x {height} pixels{depth}", switch.name)
                }
            };
            table += &format!("| `{device}` | `{}` | {} | {row} |\n", switch.name, switch.default);
        }
    }
    let page = fs::read_to_string(file("docs/measuring.md")).expect("the page");
    let (before, rest) = page.split_once("<!-- probes -->\n").expect("the mark");
    let (_, after) = rest.split_once("<!-- /probes -->").expect("the end mark");
    let expected = format!("{before}<!-- probes -->\n\n{table}\n<!-- /probes -->{after}");
    hold(&file("docs/measuring.md"), &expected);
    let in_folder =
        |folder: PathBuf| fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    for probe in in_folder(file("fixtures/probes/open")).flat_map(in_folder) {
        assert!(places.contains(&probe), "{} belongs to no open switch", probe.display());
    }
}
