//! Command lines and option values for the test of all options, from table.txt.

use std::sync::LazyLock;

/// A command: lines to which its options are added, and its options with values.
pub(super) struct Tried {
    pub(super) bases: Vec<&'static str>,
    pub(super) options: String,
}

/// The options that `+NAME` or `+NAME:AT` stands for: of a camera; of a picture under distant light, whose line `AT`
/// reads a model with defects; of the card `AT`; and of a ray caster, for the first line and for line `AT`, which uses a
/// Ray Engine with rates. Any other word is an option itself.
fn group(word: &str) -> String {
    let (name, at) = word.split_once(':').filter(|_| word.starts_with('+')).unwrap_or((word, ""));
    let eye = "--size=9x7 --eye=3,-4,2 --target=0.2,0.1,0.3 --tan-half-height=0.2";
    match name {
        "+eye" => eye.to_owned(),
        "+picture" => {
            format!("{eye} --exposure=0.3 --model=white-box --model-up=y --strict@{at} --light=red-and-blue")
        }
        "+card" => format!("--sweep --device={at} --switch=target-rounding=truncate same:--executor=scalar"),
        "+caster" => format!(
            "--caster=engine@0 --caster-device=r200 --caster-format=fp16@0,{at} --octree=1,1@{at} \
             --pass-triangles=9,99@{at} --pass-rays=3001@{at} --readback=free@{at}"
        ),
        option => option.to_owned(),
    }
}

/// Every command.
pub(super) static TABLE: LazyLock<Vec<Tried>> = LazyLock::new(|| {
    let blocks = include_str!("table.txt").split("\n\n").filter(|block| !block.starts_with('#'));
    let tried = |block: &'static str| {
        let (options, bases): (Vec<&str>, Vec<&str>) = block.lines().partition(|line| line.starts_with("    "));
        let options: Vec<String> = options.iter().flat_map(|line| line.split_whitespace()).map(group).collect();
        Tried { bases, options: options.join(" ") }
    };
    blocks.map(tried).collect()
});
