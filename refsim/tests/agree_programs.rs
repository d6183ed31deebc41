//! The batch executor against the scalar one: random programs of every version, random draws, every format and rule.
//!
//! Compared are all targets, the depth buffer and every counter. `CROSSBAR_FULL=1` runs thirty times more cases;
//! `CROSSBAR_SEED=n` runs one case alone. A failing case is cut down, instruction by instruction, before it is shown.

#[path = "agree/generate.rs"]
mod generate;
#[path = "agree/generate_ps_1.rs"]
mod generate_ps_1;
#[path = "agree/random.rs"]
mod random;
#[path = "agree/scene.rs"]
mod scene;
#[path = "agree/traces.rs"]
mod traces;

use random::Random;
use refsim::asm::assemble;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::ExecutorKind;
use scene::{FORMATS, Scene};

const PIXEL: [Version; 7] =
    [Version::Ps1_1, Version::Ps1_2, Version::Ps1_3, Version::Ps1_4, Version::Ps2_0, Version::Ps2A, Version::Ps2B];

fn cases(quick: u64) -> std::ops::Range<u64> {
    if let Some(seed) = std::env::var("CROSSBAR_SEED").ok().and_then(|s| s.parse().ok()) {
        return seed..seed + 1;
    }
    0..if std::env::var_os("CROSSBAR_FULL").is_some() { 30 * quick } else { quick }
}

/// The checked program of some lines, if they are one.
fn build(lines: &[String], scene: &Scene) -> Option<CheckedProgram> {
    let program = assemble(&lines.join("\n")).ok()?;
    scene::accepted(&program, &scene.profile)
}

/// A random legal program.
fn legal(version: Version, scene: &Scene, r: &mut Random) -> (Vec<String>, CheckedProgram) {
    for _ in 0..4000 {
        let lines = generate::program(version, r);
        if let Some(program) = build(&lines, scene) {
            return (lines, program);
        }
    }
    let lines = generate::program(version, r);
    let text = lines.join("\n");
    let why = match assemble(&text) {
        Ok(program) => format!("{:?}", refsim::check::check(program, &scene.profile).err()),
        Err(e) => format!("{e:?}"),
    };
    panic!("no legal {version} program in 4000 tries; the last is\n{text}\n{why}");
}

/// Whether the executors differ, and how.
fn mismatch(scene: &Scene, pixel: &CheckedProgram, vertex: Option<&CheckedProgram>) -> Option<String> {
    let scalar = scene.draw(ExecutorKind::Scalar, 1, pixel, vertex).unwrap_or_else(|e| panic!("scalar: {e}"));
    let batch = scene.draw(ExecutorKind::Batch, 1, pixel, vertex).unwrap_or_else(|e| panic!("batch: {e}"));
    (scalar != batch).then(|| scene.difference(&scalar, &batch))
}

/// Takes instructions away as long as the executors still differ.
fn cut_down(mut lines: Vec<String>, scene: &Scene, differs: impl Fn(&CheckedProgram) -> Option<String>) -> String {
    loop {
        let shorter = (1..lines.len()).rev().find_map(|i| {
            let mut fewer = lines.clone();
            fewer.remove(i);
            let program = build(&fewer, scene)?;
            differs(&program).map(|_| fewer)
        });
        match shorter {
            Some(fewer) => lines = fewer,
            None => break,
        }
    }
    let what = build(&lines, scene).and_then(|p| differs(&p)).unwrap_or_default();
    format!("{}\n{what}", lines.join("\n"))
}

#[test]
fn pixel_programs_agree() {
    let mut shaded = 0;
    for seed in cases(3000) {
        let mut r = Random::new(seed);
        let version = PIXEL[seed as usize % PIXEL.len()];
        let format = FORMATS[(seed as usize / PIXEL.len()) % FORMATS.len()];
        let scene = Scene::new(scene::profile(format, &mut r), version, &mut r);
        let (lines, program) = legal(version, &scene, &mut r);
        if mismatch(&scene, &program, None).is_some() {
            let text = cut_down(lines, &scene, |p| mismatch(&scene, p, None));
            panic!("seed {seed}, {format}, {:?}:\n{text}", scene.profile.rules);
        }
        let drawn = scene.draw(ExecutorKind::Batch, 1, &program, None).unwrap_or_else(|e| panic!("{e}"));
        shaded += drawn.events.fragments.shaded;
    }
    assert!(shaded > 1000, "the scenes cover something: {shaded} fragments");
}

#[test]
fn vertex_programs_agree() {
    let mut shaded = 0;
    for seed in cases(200) {
        let mut r = Random::new(seed ^ 0x5eed);
        let version = [Version::Vs1_1, Version::Vs2_0][seed as usize % 2];
        let scene = Scene::new(scene::profile("fp32", &mut r), Version::Ps2_0, &mut r).with_attributes(&mut r);
        let pixel = ["ps_2_0", "dcl t0", "dcl v0", "mad r0, t0, c1, v0", "mov oC0, r0"].map(str::to_owned);
        let pixel = build(&pixel, &scene).unwrap_or_else(|| panic!("the pixel program is legal"));
        let (lines, program) = legal(version, &scene, &mut r);
        if mismatch(&scene, &pixel, Some(&program)).is_some() {
            let text = cut_down(lines, &scene, |p| mismatch(&scene, &pixel, Some(p)));
            panic!("seed {seed}, {:?}:\n{text}", scene.profile.rules);
        }
        let drawn = scene.draw(ExecutorKind::Batch, 1, &pixel, Some(&program)).unwrap_or_else(|e| panic!("{e}"));
        shaded += drawn.events.fragments.shaded;
    }
    assert!(shaded > 1000, "the scenes cover something: {shaded} fragments");
}

#[test]
fn thread_counts_agree() {
    for seed in cases(21) {
        let mut r = Random::new(seed ^ 0x7ead);
        let version = PIXEL[seed as usize % PIXEL.len()];
        let format = FORMATS[seed as usize % FORMATS.len()];
        let scene = Scene::new(scene::profile(format, &mut r), version, &mut r);
        let (lines, program) = legal(version, &scene, &mut r);
        let [one, two, three] = [1, 2, 3]
            .map(|threads| scene.draw(ExecutorKind::Batch, threads, &program, None).unwrap_or_else(|e| panic!("{e}")));
        assert!(one == two && two == three, "seed {seed}, {format}: threads matter\n{}", lines.join("\n"));
    }
}
