//! The parts of the page that run programs and shaders of the visitor's own.

use maud::{Markup, html};

use super::encode::packed;

pub(super) struct Emulator {
    /// The module, compressed and as base64.
    pub(super) packed: String,
    /// `true` if it was compiled with the feature `wgsl`.
    pub(super) takes_shaders: bool,
}

impl Emulator {
    pub(super) fn new(module: &[u8]) -> std::io::Result<Self> {
        const SHADER: &[u8] = b"refsim_shader";
        let takes_shaders = module.windows(SHADER.len()).any(|bytes| bytes == SHADER);
        Ok(Self { packed: packed(module)?, takes_shaders })
    }
}

/// The script of these parts; none without the emulator.
pub(super) fn script(emulator: Option<&Emulator>) -> String {
    const PARTS: [&str; 2] = [include_str!("assets/playground.js"), include_str!("assets/shader.js")];
    emulator.map_or_else(String::new, |emulator| PARTS[..1 + usize::from(emulator.takes_shaders)].concat())
}

/// A program of the visitor's own; without the emulator a paragraph that explains how to get it.
pub(super) fn playground(has_emulator: bool) -> Markup {
    html! {
        section aria-labelledby="playground" {
            h2 #playground { "Your own program" }
            @if has_emulator {
                p {
                    "The emulator itself runs in this page: write a program in a language of Direct3D or OpenGL, choose a device \
                     and a pixel. Texture coordinate set 0 goes from (0, 0) to (1, 1), set 1 from -1 to 1; samplers 0 \
                     to 3 hold a checkerboard, a gradient, normals and a ramp."
                }
                div.stand {
                    div.chooser {
                        canvas #play-picture tabindex="0" role="application" aria-label="Picture: arrow keys choose a pixel"
                            aria-describedby="play-said" {}
                        form #play-controls aria-label="Device and program" {}
                        p { a #play-link href="#playground" { "Link to this program" } }
                    }
                    div.player {
                        textarea #program-text rows="14" spellcheck="false" aria-label="Program" aria-describedby="remarks" {}
                        ul.remarks #remarks role="status" {}
                        p #play-said role="status" {}
                        div.scroll {
                            table {
                                caption { "What each instruction writes" }
                                thead {
                                    tr {
                                        @for name in ["line", "instruction", "register", "number", "bits", "exceptions"] {
                                            th scope="col" { (name) }
                                        }
                                    }
                                }
                                tbody #play-trace {}
                            }
                        }
                    }
                }
            } @else {
                p {
                    "This page was written without the emulator, which runs programs of your own. " code { "refsim/web/build" }
                    " compiles it, and " code { "crossbar page --emulator target/web/refsim_web.wasm" } " writes it into the page."
                }
            }
        }
    }
}

pub(super) fn shader() -> Markup {
    html! {
        section aria-labelledby="shader" {
            h2 #shader { "Your own shader" }
            p {
                "Paste a fragment shader in WGSL. The emulator draws it with all numbers in the format that \
                 you choose, and your GPU runs the unchanged shader. "
                code { "@location(0)" }
                " goes from (0, 0) to (1, 1). There are no textures, and not all of WGSL is translated: \
                 docs/wgsl.md has the list."
            }
            div.stand {
                div.chooser {
                    form #shader-controls aria-label="Shader and numbers" {}
                    form #shader-uniforms aria-label="Uniforms" onsubmit="return false" {}
                    p { a #shader-link href="#shader" { "Link to this shader" } }
                }
                div.player {
                    textarea #shader-text rows="18" spellcheck="false" aria-label="Shader in WGSL" aria-describedby="shader-remarks" {}
                    ul.remarks #shader-remarks role="status" {}
                    div.figures #shader-pictures {
                        figure {
                            canvas #shader-own aria-label="The emulator's picture" {}
                            figcaption { "emulator, " code #shader-format-said {} }
                        }
                        figure {
                            canvas #shader-gpu aria-label="Your GPU's picture" {}
                            figcaption { "your GPU" }
                        }
                        figure {
                            canvas #shader-apart aria-label="Difference" aria-describedby="shader-said" {}
                            figcaption { "difference: " span #shader-scale {} }
                        }
                    }
                    p #shader-said role="status" {}
                }
            }
        }
    }
}
