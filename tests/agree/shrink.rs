//! Shrinks a case that shows a difference, as long as it still shows one.

use crate::rules;
use crate::scene::{Case, Scene};
use refsim::exec::{BumpStage, Projection};
use refsim::output::{DepthState, WriteMask};
use refsim::texture::SamplerState;
use std::fmt::Write as _;
use std::time::{Duration, Instant};

/// Time limit; a partly shrunk case is useful too.
const PATIENCE: Duration = Duration::from_secs(20);

/// The smallest case found that still `shows` the difference.
pub(crate) fn shrink(case: &Case, shows: impl Fn(&Case) -> bool) -> Case {
    let end = Instant::now() + PATIENCE;
    let mut best = case.clone();
    let mut again = true;
    while again {
        again = false;
        let mut n = 0;
        // After a successful step, candidate `n` of the smaller case is a different one.
        while let Some(smaller) = candidate(&best, n) {
            if Instant::now() > end {
                return best;
            }
            let changed = smaller.pixel != best.pixel || smaller.vertex != best.vertex || differs(&smaller, &best);
            if changed && shows(&smaller) {
                best = smaller;
                again = true;
            } else {
                n += 1;
            }
        }
    }
    best
}

fn differs(a: &Case, b: &Case) -> bool {
    describe(&a.scene) != describe(&b.scene) || a.scene.textures.len() != b.scene.textures.len()
}

/// Candidate `n`: parts of the scene first, then instructions, last first, then their dependencies.
fn candidate(case: &Case, n: usize) -> Option<Case> {
    let mut out = case.clone();
    let parts = PARTS.len();
    if n < parts {
        PARTS[n](&mut out.scene);
        if n == 0 {
            out.vertex = None;
        }
        return Some(out);
    }
    let n = n - parts;
    if n < case.scene.textures.len() {
        out.scene.textures.remove(n);
        return Some(out);
    }
    let n = n - case.scene.textures.len();
    let places = case.pixel.len() - 1;
    if n < 2 * places {
        out.pixel = fewer(&case.pixel, n)?;
        return Some(out);
    }
    let n = n - 2 * places;
    let vertex = case.vertex.as_ref()?;
    if n < 2 * (vertex.len() - 1) {
        out.vertex = Some(fewer(vertex, n)?);
        return Some(out);
    }
    None
}

/// Candidate `n`: removes one line (or the opening and closing line of a block), or simplifies one line.
fn fewer(lines: &[String], n: usize) -> Option<Vec<String>> {
    let mut out = lines.to_vec();
    let places = lines.len() - 1;
    let at = places - n % places;
    if n >= places {
        out[at] = plainer(&lines[at]);
        return Some(out);
    }
    match end_of(lines, at) {
        Some(end) => {
            out.remove(end);
            out.remove(at);
        }
        None => {
            out.remove(at);
        }
    }
    Some(out)
}

/// Index of the line that closes the block opened by line `at`.
fn end_of(lines: &[String], at: usize) -> Option<usize> {
    let opens = |l: &str| l.starts_with("if") || l.starts_with("rep ") || l.starts_with("loop ");
    if !opens(&lines[at]) {
        return None;
    }
    let mut depth = 0;
    for (i, line) in lines.iter().enumerate().skip(at) {
        depth += i32::from(opens(line)) - i32::from(line.starts_with("end"));
        if depth == 0 {
            return Some(i);
        }
    }
    None
}

/// The line without its modifiers.
fn plainer(line: &str) -> String {
    let mut out = line.to_owned();
    for extra in ["_sat", "_pp", "_x2", "_x4", "_x8", "_d2", "_d4", "_d8", "_bx2", "_bias", "1-", "_centroid"] {
        out = out.replace(extra, "");
    }
    out
}

/// Removes some vertices.
fn without(scene: &mut Scene, first: usize, count: usize) {
    let end = (first + count).min(scene.vertices.len());
    if first < end && end - first < scene.vertices.len() {
        scene.vertices.drain(first..end);
        scene.indices = None;
    }
    scene.vertex_count = scene.vertex_count.min(scene.vertices.len());
}

/// Simplifications of a scene; the first is used when the vertex program is dropped.
const PARTS: [fn(&mut Scene); 28] = [
    |s| s.instances = 1,
    |s| s.second_pass = false,
    |s| s.levels = None,
    |s| s.generated.clear(),
    |s| s.draws = 1,
    |s| s.alpha = None,
    |s| s.blend = None,
    |s| s.masks = [WriteMask::ALL; 4],
    |s| s.depth_state = DepthState::default(),
    |s| s.depth = None,
    |s| s.scissor = None,
    |s| s.viewport = None,
    |s| s.indices = None,
    |s| s.bump = [BumpStage::default(); 8],
    |s| s.projections = [Projection::None; 8],
    |s| s.flat = None,
    |s| s.instances = (s.instances / 2).max(1),
    |s| without(s, 0, 4),
    |s| without(s, 4, 8),
    |s| without(s, s.vertices.len().saturating_sub(4), 4),
    |s| without(s, s.vertices.len().saturating_sub(8), 4),
    |s| without(s, 3, 3),
    |s| without(s, s.vertices.len().saturating_sub(1), 1),
    |s| s.size[0] = (s.size[0] / 2).max(1),
    |s| s.size[1] = (s.size[1] / 2).max(1),
    |s| s.textures.iter_mut().for_each(|t| t.2 = SamplerState::NEAREST_CLAMP),
    |s| s.vertices.iter_mut().for_each(|v| (v.texcoords, v.colors) = ([[0x3f00_0000; 4]; 8], [[0x3f00_0000; 4]; 2])),
    |s| {
        let format = s.profile.rules.format;
        s.profile.rules = rules::profile("ideal-fp32").rules;
        s.profile.rules.format = format;
    },
];

pub(crate) fn describe(scene: &Scene) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "device {}, {:?}", scene.profile.name, scene.profile.rules);
    for (digest, formats) in scene.profile.instruction_formats().iter() {
        let formats: Vec<String> = formats.iter().map(|(index, format)| format!("{index} {format}")).collect();
        let _ = writeln!(text, "instructions of program {digest:016x}: {}", formats.join(", "));
    }
    let _ = writeln!(text, "constants {:x?}", scene.pixel_constants);
    for (slot, image, state) in &scene.textures {
        let sizes: Vec<String> =
            image.levels().iter().map(|l| format!("{}x{}x{}", l.width, l.height, l.slices)).collect();
        let format = image.format().name();
        let generated = if scene.generated.contains(slot) { " (generated)" } else { "" };
        let sizes = sizes.join(" ");
        let _ = writeln!(text, "texture {slot}: {} {format} {sizes}{generated}, {state:x?}", image.kind());
    }
    let _ = writeln!(text, "{:?} of {} vertices, {} instances", scene.primitive, scene.vertices.len(), scene.instances);
    for vertex in scene.vertices.iter().take(4) {
        let _ = writeln!(text, "  {vertex:x?}");
    }
    let targets: Vec<&str> = scene.targets.iter().map(|t| t.name()).collect();
    let _ = writeln!(text, "targets {:?} of {}, clear {:x?}", scene.size, targets.join(" "), scene.clear);
    let _ = writeln!(text, "depth {:x?} {:?}, alpha {:x?}", scene.depth, scene.depth_state, scene.alpha);
    let _ = writeln!(text, "blend {:?}, masks {:?}", scene.blend, scene.masks);
    let _ = writeln!(text, "{:?} {:?} {:?}", scene.center, scene.clip_space, scene.cull);
    let _ = writeln!(text, "viewport {:x?}, scissor {:?}", scene.viewport, scene.scissor);
    let _ = writeln!(text, "draws {}, indices {:?}", scene.draws, scene.indices);
    let _ = writeln!(text, "second pass {}, levels {:x?}", scene.second_pass, scene.levels);
    text
}
