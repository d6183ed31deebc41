//! Scenes in words, for the report of a difference.

use crate::scene::Scene;
use std::fmt::Write as _;

/// A scene in words.
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
