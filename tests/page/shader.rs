//! The part of the page for the visitor's own shader: compares the emulator's picture with SwiftShader's picture.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

use crate::browser::Browser;
use crate::{attribute, emulator};

/// JavaScript expression for this part of the page.
const SECTION: &str = "document.getElementById('shader').parentElement";

/// Largest difference of the two pictures, in 255ths.
const MOST: &str = "Number(document.getElementById('shader-apart').dataset.most)";

/// Disables the page's integer comparisons, which would occupy SwiftShader for a minute.
const SHADERS_ALONE: &str = "GPUDevice.prototype.createComputePipelineAsync = () => new Promise(() => {});";

/// A browser with WebGPU on a page whose shader is drawn; `script` runs first.
fn opened(name: &str, page: &Path, script: &str) -> Browser {
    let mut browser = Browser::start(name, true);
    let source = format!("{SHADERS_ALONE}\n{script}");
    browser.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": source }));
    browser.open(page);
    browser.wait(&format!("{SECTION}.dataset.state === 'ready'"));
    browser
}

/// Writes a page with a module; its folder is named after the test.
pub(crate) fn page_with(module: &Path, file: &Path, name: &str) -> PathBuf {
    let folder = file.with_file_name(name);
    let mut command = Command::new(env!("CARGO_BIN_EXE_crossbar"));
    let output = command.args(["page", "--emulator"]).arg(module).arg("--out").arg(&folder).output();
    let output = output.expect("the program");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder.join("index.html")
}

/// Functions that replace a module's, so that the page can be tested without a WebAssembly compiler. They return the
/// answer of `refsim-web` (its tests compare it) with the colors of this shader, and reject texts with a certain word.
fn stand_in() -> (String, Value) {
    let stored: Value = serde_json::from_str(include_str!("../../refsim/web/shader.json")).expect("JSON");
    let (request, mut answer) = (stored["request"].clone(), stored["answer"].clone());
    let side = answer["side"].as_u64().expect("a side") as u32;
    let coordinate = |at: u32| (at as f32 + 0.5) / side as f32 * 0.5;
    let texel = |p: u32| [coordinate(p % side), coordinate(p / side), 0.25, 1.0].map(f32::to_bits);
    answer["drawn"]["bits"] = (0..side * side).flat_map(texel).collect();
    answer["examples"] = json!([{ "title": "one", "text": request["text"], "uniforms": [] }]);
    let error = json!({ "message": "no number", "help": "write one", "line": 2, "column": 3, "start": 9, "end": 13 });
    let refused = json!({ "side": side, "examples": [], "formats": [], "errors": [error], "uniforms": [] });
    let program = json!({ "side": 32, "devices": ["r200"], "examples": [{ "text": "", "device": "r200", "title": "" }],
        "errors": [], "warnings": [] });
    let script = format!(
        "(() => {{
            let [request, answer] = [[], []];
            const answered = (of) => () => {{
                const asked = JSON.parse(new TextDecoder().decode(Uint8Array.from(request)));
                request = [];
                answer = new TextEncoder().encode(JSON.stringify(of(asked)));
                return answer.length;
            }};
            const exports = {{
                refsim_push: (byte) => request.push(byte),
                refsim_read: (at) => answer[at] | answer[at + 1] << 8 | answer[at + 2] << 16 | answer[at + 3] << 24,
                refsim_answer: answered(() => ({program})),
                refsim_shader: answered(({{ text }}) => text.includes('refuse') ? {refused} : {answer}),
            }};
            WebAssembly.compile = async () => ({{}});
            WebAssembly.instantiate = async () => ({{ exports }});
        }})()"
    );
    (script, request)
}

fn number(browser: &mut Browser, expression: &str) -> f64 {
    browser.value(expression).as_f64().unwrap_or(f64::NAN)
}

/// Replaces the text, and waits until it is drawn.
fn write(browser: &mut Browser, text: &str) {
    let area = "document.getElementById('shader-text')";
    browser.value(&format!("{area}.value = {}; {area}.dispatchEvent(new Event('input'))", json!(text)));
    browser.wait(&format!("JSON.parse({SECTION}.dataset.drawn).text === {}", json!(text)));
}

/// Text of the first remark on the page, and its source line with carets.
fn remark(browser: &mut Browser) -> [String; 2] {
    ["li", "li pre"].map(|of| {
        let text = format!("document.querySelector('#shader-remarks {of}')?.textContent ?? ''");
        browser.value(&text).as_str().unwrap_or_default().to_owned()
    })
}

pub(crate) fn a_shader_stands_beside_that_of_the_gpu(name: &str, file: &Path) {
    let module = file.with_file_name("stand_in.wasm");
    std::fs::write(&module, b"\0asm refsim_shader").expect("a file");
    let (script, request) = stand_in();
    let mut browser = opened(name, &page_with(&module, file, "shader"), &script);
    // The GPU interpolates the coordinates in its own way.
    let apart = number(&mut browser, MOST);
    assert!(apart < 0.01, "{apart} of 255: {}", attribute(&mut browser, "shader-said", "textContent"));
    assert_eq!(attribute(&mut browser, "shader-text", "value"), request["text"]);

    // A uniform has one input field per component; its number is sent.
    let fields = "document.querySelectorAll('#shader-uniforms input')";
    assert_eq!(number(&mut browser, &format!("{fields}.length")), 2.0);
    browser.value(&format!("{fields}[1].value = '0.75'; {fields}[1].dispatchEvent(new Event('input'))"));
    browser.wait(&format!("JSON.parse({SECTION}.dataset.drawn).uniforms.half[1] === 0.75"));

    // Errors of the emulator and of the browser's compiler state their positions; the page continues to work.
    write(&mut browser, "refuse\n  this = 1;");
    assert_eq!(remark(&mut browser)[1], "  this = 1;\n  ^^^^");
    assert_eq!(number(&mut browser, "document.getElementById('shader-pictures').offsetHeight"), 0.0);
    write(&mut browser, "@fragment fn main() -> @location(0) vec4f {\n    return vec4f(nothing);\n}");
    let [words, line] = remark(&mut browser);
    assert!(words.contains("line 2") && words.contains("your GPU's browser"), "{words}");
    assert!(line.starts_with("    return vec4f(nothing);\n") && line.ends_with('^'), "{line}");
    write(&mut browser, request["text"].as_str().expect("a text"));
    browser.wait("document.querySelectorAll('#shader-remarks li').length === 0");
    assert!(number(&mut browser, MOST) < 0.01);
    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
}

/// If the module includes WGSL, its pictures in single precision are close to SwiftShader's; those in half precision are
/// not.
pub(crate) fn shaders_of_the_module_are_near_the_gpu(name: &str, file: &Path) {
    if !std::fs::read(emulator()).is_ok_and(|bytes| bytes.windows(13).any(|name| name == b"refsim_shader")) {
        return;
    }
    let mut browser = opened(name, &page_with(&emulator(), file, "shaders"), "");
    for (example, format) in (0..10).map(|example| (example, "fp32")).chain([(0, "fp16")]) {
        browser.value(&format!(
            "document.getElementById('shader-format').value = '{format}'; (() => {{ \
             const list = document.getElementById('shader-example'); list.value = '{example}'; \
             list.dispatchEvent(new Event('change')); }})()"
        ));
        let drawn = format!("{SECTION}.dataset.drawn");
        browser.wait(&format!(
            "JSON.parse({drawn}).format === '{format}' && \
             JSON.parse({drawn}).text === document.getElementById('shader-text').value"
        ));
        let apart = number(&mut browser, MOST);
        let said = attribute(&mut browser, "shader-said", "textContent");
        match (example, format) {
            // The highlight of docs/wgsl.md; the sine of a large number depends on the driver.
            (0, "fp16") => assert_eq!(apart.round(), 41.0, "{said}"),
            (4, _) => assert!(apart > 1.0, "{said}"),
            _ => assert!(apart < 0.1, "example {example}: {said}"),
        }
    }
    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
}
