//! The page of `crossbar page` in Chromium, whose WebGPU runs on SwiftShader: all bits equal the emulator's, controls
//! work, and without WebGPU the page shows its stored pictures. Without Chromium the tests count as ignored, or as
//! failed if `CI` is set.

mod browser;
#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod shader;

use environment::is_full;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use libtest_mimic::{Arguments, Failed, Trial};
use serde_json::{Value, json};

use browser::Browser;

fn main() -> ExitCode {
    let folder = tempfile::tempdir().expect("a folder for the page");
    let file = folder.path().join("index.html");
    let name = browser::chromium();
    if name.is_some() {
        write_page(folder.path());
    }
    let trial = |title: &str, test: fn(&str, &Path)| {
        let file: PathBuf = file.clone();
        let trial = Trial::test(title, move || match name {
            Some(name) => {
                test(name, &file);
                Ok(())
            }
            None => Err(Failed::from("no Chromium: `apt-get install chromium`")),
        });
        trial.with_ignored_flag(name.is_none() && std::env::var_os("CI").is_none())
    };
    let mut trials = vec![
        trial("every_bit_is_the_emulators_and_controls_work", every_bit_is_the_emulators_and_controls_work),
        trial("a_wrong_step_is_marked", a_wrong_step_is_marked),
        trial(
            "without_webgpu_there_are_pictures_and_stored_traces",
            without_webgpu_there_are_pictures_and_stored_traces,
        ),
        trial("a_shader_stands_beside_that_of_the_gpu", shader::a_shader_stands_beside_that_of_the_gpu),
        trial("the_emulator_in_the_page_has_the_native_bits", the_emulator_in_the_page_has_the_native_bits)
            .with_ignored_flag(name.is_none() || !emulator().is_file()),
        trial("shaders_of_the_module_are_near_the_gpu", shader::shaders_of_the_module_are_near_the_gpu)
            .with_ignored_flag(name.is_none() || !emulator().is_file()),
    ];
    if is_full() {
        trials.push(trial("a_wrong_bit_is_found_and_named", a_wrong_bit_is_found_and_named));
    }
    if name.is_none() {
        tell("no Chromium: the page is not tested");
    }
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

#[expect(clippy::print_stderr, reason = "says that a test does not run")]
fn tell(text: &str) {
    eprintln!("{text}");
}

fn write_page(folder: &Path) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_crossbar"));
    let output = command.args(["page", "--out"]).arg(folder).output().expect("the program");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Results that the page shows as JSON.
fn found(browser: &mut Browser) -> Value {
    let text = browser.value("document.getElementById('json').value");
    serde_json::from_str(text.as_str().expect("a text")).expect("JSON")
}

fn drawn(browser: &mut Browser) -> String {
    browser.value("document.getElementById('view').dataset.drawn").as_str().unwrap_or_default().to_owned()
}

/// Performs an action, and waits until the live picture is redrawn.
fn redrawn(browser: &mut Browser, act: impl FnOnce(&mut Browser)) -> (String, String) {
    let before = drawn(browser);
    act(browser);
    browser.wait(&format!("document.getElementById('view').dataset.drawn !== '{before}'"));
    (before, drawn(browser))
}

/// By default the test draws one of the six fixed pictures (ten seconds each on SwiftShader), runs four of fifteen
/// traces, and changes only the format of the live view.
fn every_bit_is_the_emulators_and_controls_work(name: &str, file: &Path) {
    let (pictures, traces, page) = if is_full() { (6, 5 * 3, file.to_owned()) } else { (1, 1 + 3, shortened(file)) };
    let mut browser = Browser::start(name, true);
    browser.open(&page);
    browser.wait("document.body.dataset.state !== 'loading'");
    let found = found(&mut browser);
    assert_eq!(browser.value("document.body.dataset.state"), json!("equal"), "{found:#}");
    let list = |name: &str| found[name].as_array().cloned().unwrap_or_default();
    assert_eq!(list("operations").len(), 17 * 8);
    assert!(list("operations").iter().all(|cell| cell["wrong"] == 0 && cell["sets"] == 2048));
    assert_eq!(list("teapot").len(), pictures);
    assert!(list("teapot").iter().all(|picture| picture["found"] == picture["expected"]));
    let native = list("native");
    let single: Vec<&Value> = native.iter().filter(|line| line["type"] == "f32").collect();
    assert_eq!(single.len(), 17);
    assert!(single.iter().all(|line| line["sets"].as_u64() > Some(500)));
    assert!(found["adapter"]["browser"].is_string());

    // Every step of every program has the emulator's bits.
    let programs = list("programs");
    assert_eq!(programs.len(), traces);
    assert!(programs.iter().all(|line| line["wrong"] == 0 && line["pixels"] == 256), "{programs:#?}");
    assert!(programs.iter().all(|line| line["steps"].as_u64() > Some(8)));
    stepping_by_keys(&mut browser);

    // The live view shows the first fixed view in s3.12, then the view chosen with the keyboard.
    let first = format!("s3.12 {}", list("teapot")[0]["expected"].as_str().unwrap_or_default());
    assert_eq!(drawn(&mut browser), first);
    let (before, after) = redrawn(&mut browser, |browser| browser.press("fractions-of", "ArrowLeft", 37));
    assert!(before.starts_with("s3.12 ") && after.starts_with("s3.11 "), "{before} -> {after}");
    if is_full() {
        let (before, after) = redrawn(&mut browser, |browser| browser.press("view", "ArrowLeft", 37));
        assert_ne!(before, after, "the camera moves");
    }
    // The page has exact hits for the first camera; other views are judged while they are drawn.
    let judge = if is_full() { "double precision" } else { "exact arithmetic" };
    let told = browser.value("document.getElementById('told').textContent").to_string();
    assert!(told.contains("leak") && told.contains(judge), "{told}");

    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
    let others: Vec<&str> =
        browser.requests().into_iter().filter(|url| !url.starts_with("file:") && !url.starts_with("data:")).collect();
    assert!(others.is_empty(), "{others:?}");
}

fn attribute(browser: &mut Browser, id: &str, name: &str) -> String {
    browser.value(&format!("document.getElementById('{id}').{name}")).as_str().unwrap_or_default().to_owned()
}

/// The keyboard steps a program, chooses a pixel and another program.
fn stepping_by_keys(browser: &mut Browser) {
    let now = |browser: &mut Browser| {
        let line = "document.querySelector('#source [aria-current=step]')?.textContent ?? ''";
        (attribute(browser, "stepper", "dataset.step"), browser.value(line).as_str().unwrap_or_default().to_owned())
    };
    assert_eq!(attribute(browser, "program-verdict", "className"), "equal");
    let (first, line) = now(browser);
    assert!(line.contains("texld r1, t0"), "{line}");
    browser.press("stepper", "ArrowRight", 39);
    let (second, line) = now(browser);
    assert_eq!(second.parse().ok(), first.parse::<u32>().ok().map(|step| step + 1));
    assert!(line.contains("texld r2, t0"), "{line}");
    browser.press("stepper", "ArrowLeft", 37);
    assert_eq!(now(browser).0, first);
    browser.press("stepper", "End", 35);
    assert!(now(browser).1.contains("+cmp r0.a"), "{:?}", now(browser));
    browser.press("stepper", "Home", 36);
    assert_eq!(now(browser), ("0".to_owned(), String::new()), "an input register");
    // Written values are listed three times: from the emulator, from the emulation on the GPU, and in the GPU's own
    // floats.
    let cells =
        browser.value("[...document.querySelectorAll('#written tr:first-child > *')].map((cell) => cell.textContent)");
    let cells: Vec<&str> = cells.as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    assert_eq!((cells.len(), cells[0]), (7, "v0.x"), "{cells:?}");
    assert!(cells[2] == cells[3] && cells[5].len() == 8, "{cells:?}");

    let pixel = attribute(browser, "stepper", "dataset.pixel");
    browser.press("pixels", "ArrowDown", 40);
    let below = attribute(browser, "stepper", "dataset.pixel");
    assert_eq!(below.parse().ok(), pixel.parse::<u32>().ok().map(|pixel| pixel + 16));
    browser.press("program", "ArrowDown", 40);
    browser.wait("document.getElementById('source').textContent.startsWith('; Ray-triangle intersection, front faces, any origin')");
    browser.press("variant", "ArrowDown", 40);
    browser.wait("document.getElementById('written-caption').textContent.endsWith('e5m10')");
}

/// Writes a copy of the page with changed data under another name.
fn changed(file: &Path, name: &str, change: impl FnOnce(&mut Value)) -> PathBuf {
    const START: &str = "type=\"application/json\">";
    let page = std::fs::read_to_string(file).expect("the page");
    let (before, rest) = page.split_once(START).expect("data");
    let (data, after) = rest.split_once("</script>").expect("an end");
    let mut data: Value = serde_json::from_str(data).expect("JSON");
    change(&mut data);
    let changed = file.with_file_name(name);
    std::fs::write(&changed, format!("{before}{START}{data}</script>{after}")).expect("a file");
    changed
}

fn pictures(data: &mut Value, view: usize) -> &mut Vec<Value> {
    data["teapot"]["views"][view]["pictures"].as_array_mut().expect("pictures")
}

/// A copy of the page with one picture, in fixed point, and two programs: the first in one format, the second in all.
fn shortened(file: &Path) -> PathBuf {
    changed(file, "short.html", |data| {
        let programs = data["programs"]["programs"].as_array_mut().expect("programs");
        programs.truncate(2);
        programs[0]["variants"].as_array_mut().expect("variants").truncate(1);
        data["teapot"]["views"].as_array_mut().expect("views").truncate(1);
        pictures(data, 0).truncate(1);
    })
}

/// Flips the lowest bit of a byte of encoded data.
fn flip(data: &mut Value, byte: usize) {
    let mut bytes = STANDARD.decode(data.as_str().expect("text")).expect("base64");
    bytes[byte] ^= 1;
    *data = json!(STANDARD.encode(bytes));
}

/// A page with one wrong result and one wrong hit reports both, so the comparison can fail. Runs only with
/// `CROSSBAR_FULL=1`.
fn a_wrong_bit_is_found_and_named(name: &str, file: &Path) {
    const PIXEL: usize = 39 * 128 + 8;
    // Changes the first result of `add` in s3.12 (two bytes), and t of one pixel of the first picture; removes the
    // other pictures.
    let changed = changed(file, "changed.html", |data| {
        flip(&mut data["arithmetic"]["expected"][0][0], 0);
        data["teapot"]["views"].as_array_mut().expect("views").truncate(1);
        let pictures = pictures(data, 0);
        pictures.truncate(1);
        pictures[0]["digest"] = json!("0000000000000000");
        flip(&mut pictures[0]["hits"], 4 * (128 * 128 + PIXEL));
    });

    let mut browser = Browser::start(name, true);
    browser.open(&changed);
    browser.wait("document.body.dataset.state !== 'loading'");
    assert_eq!(browser.value("document.body.dataset.state"), json!("different"));
    let found = found(&mut browser);
    let wrong: Vec<&Value> =
        found["operations"].as_array().into_iter().flatten().filter(|cell| cell["wrong"] != 0).collect();
    assert_eq!(wrong.len(), 1, "{wrong:#?}");
    assert_eq!(
        (&wrong[0]["operation"], &wrong[0]["format"], &wrong[0]["wrong"]),
        (&json!("add"), &json!("s3.12"), &json!(1))
    );
    assert_eq!(wrong[0]["first"]["operands"].as_array().map(Vec::len), Some(2));
    // The cell leads to the sentence that names the operands.
    let said = "document.querySelector(document.querySelector('#at-0-0 > a').getAttribute('href')).textContent";
    assert!(browser.value(said).to_string().contains("add in s3.12: wrong results: 1."), "{}", browser.value(said));
    let picture = browser.value("document.querySelector('#fixed-0-0.wrong .found').textContent").to_string();
    assert!(picture.contains("pixel (8, 39)"), "{picture}");
}

/// A stored trace with one wrong bit is marked at its pixel and line. The page has little else, so that the test is
/// short.
fn a_wrong_step_is_marked(name: &str, file: &Path) {
    /// The pixel that is chosen at first.
    const PIXEL: usize = 8 * 16 + 8;
    let mut line = 0;
    let changed = changed(file, "wrong_step.html", |data| {
        data["arithmetic"]["shaders"] = json!([]);
        data["arithmetic"]["formats"].as_array_mut().into_iter().flatten().for_each(|f| f["native"] = Value::Null);
        data["teapot"]["side"] = json!(32);
        data["teapot"]["views"].as_array_mut().expect("views").truncate(1);
        pictures(data, 0).clear();
        let programs = data["programs"]["programs"].as_array_mut().expect("programs");
        programs.truncate(1);
        let variants = programs[0]["variants"].as_array_mut().expect("variants");
        variants.truncate(1);
        let variant = &mut variants[0];
        let bytes = |entry: &Value| {
            let width = variant["formats"][entry["format"].as_u64().unwrap_or_default() as usize]["width"].as_u64();
            entry["names"].as_array().map_or(0, Vec::len) * width.unwrap_or_default().div_ceil(8) as usize
        };
        let sizes: Vec<usize> = variant["entries"].as_array().expect("entries").iter().map(bytes).collect();
        let at = sizes.len() - 3;
        line = variant["entries"][at]["line"].as_u64().expect("an instruction") + 1;
        let before: usize = sizes[..at].iter().sum();
        flip(&mut variant["values"], PIXEL * sizes.iter().sum::<usize>() + before);
    });
    let mut browser = Browser::start(name, true);
    browser.open(&changed);
    browser.wait("document.body.dataset.state !== 'loading'");
    assert_eq!(browser.value("document.body.dataset.state"), json!("different"));
    let programs = found(&mut browser)["programs"].clone();
    assert_eq!((&programs[0]["wrong"], &programs[1]), (&json!(1), &Value::Null), "{programs}");
    assert_eq!(programs[0]["first"], json!({ "x": 8, "y": 8, "line": line }));
    assert_eq!(attribute(&mut browser, "program-verdict", "className"), "wrong");
    let verdict = attribute(&mut browser, "program-verdict", "textContent");
    assert!(verdict.contains("1 pixel") && verdict.contains("(8, 8)"), "{verdict}");
    let marked =
        "[...document.querySelectorAll('#source > li')].findIndex((item) => item.classList.contains('wrong')) + 1";
    assert_eq!(browser.value(marked), json!(line));
    // The wrong step is two steps before the last.
    browser.press("stepper", "End", 35);
    assert_eq!(browser.value("document.querySelectorAll('#written .wrong').length"), json!(0));
    browser.press("stepper", "ArrowLeft", 37);
    browser.press("stepper", "ArrowLeft", 37);
    assert_eq!(browser.value("document.querySelectorAll('#written .wrong').length"), json!(1));
    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
}

/// A browser in which pages find no WebGPU.
fn without_webgpu(name: &str) -> Browser {
    let mut browser = Browser::start(name, false);
    browser.call(
        "Page.addScriptToEvaluateOnNewDocument",
        json!({ "source": "Object.defineProperty(Navigator.prototype, 'gpu', { get: () => undefined });" }),
    );
    browser
}

/// The module that `refsim/web/build` writes.
fn emulator() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("target/web/refsim_web.wasm")
}

/// The emulator in the page gives the same answers as natively (`refsim/web/answers.txt`): identical pictures and
/// traces.
fn the_emulator_in_the_page_has_the_native_bits(name: &str, file: &Path) {
    let page = shader::page_with(&emulator(), file, "emulator");
    let mut browser = without_webgpu(name);
    browser.open(&page);
    browser.wait("document.getElementById('playground').parentElement.dataset.state === 'ready'");
    let dataset = |browser: &mut Browser, name: &str| {
        let value = browser.value(&format!("document.getElementById('playground').parentElement.dataset.{name}"));
        value.as_str().expect("text").to_owned()
    };
    // From the last example to the first, so that each choice changes the selection.
    let list: Vec<&str> = include_str!("../../refsim/web/answers.txt").lines().collect();
    for (example, golden) in list.into_iter().enumerate().rev() {
        let (digest, title) = golden.split_once(' ').expect("a digest and a title");
        let choose = format!(
            "(() => {{ const list = document.getElementById('play-example'); list.value = '{example}'; \
             list.dispatchEvent(new Event('change')); return list.selectedOptions[0].textContent; }})()"
        );
        let request = dataset(&mut browser, "request");
        assert_eq!(browser.value(&choose), json!(title));
        let section = "document.getElementById('playground').parentElement";
        browser.wait(&format!("{section}.dataset.request !== {}", json!(request)));
        let answer = dataset(&mut browser, "answer");
        assert_eq!(format!("{:08x}", crc32fast::hash(answer.as_bytes())), digest, "{title}: {answer}");
    }
    // A mistake is reported with its line and column, and the link contains the program.
    let text = "document.getElementById('program-text')";
    let wrong = json!("ps_1_4\nmull r0, r0, r0\n");
    browser.value(&format!("{text}.value = {wrong}; {text}.dispatchEvent(new Event('input'))"));
    browser.wait("document.querySelector('#remarks button')?.textContent === 'line 2, column 1'");
    let link = attribute(&mut browser, "play-link", "href");
    browser.call("Page.navigate", json!({ "url": "about:blank" }));
    browser.call("Page.navigate", json!({ "url": link }));
    browser.wait("document.querySelector('#remarks button')?.textContent === 'line 2, column 1'");
    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
}

fn without_webgpu_there_are_pictures_and_stored_traces(name: &str, file: &Path) {
    let mut browser = without_webgpu(name);
    browser.open(file);
    browser.wait("document.body.dataset.state !== 'loading'");
    assert_eq!(browser.value("document.body.dataset.state"), json!("without"));
    let status = browser.value("document.getElementById('status').textContent").to_string();
    assert!(status.contains("no WebGPU"), "{status}");
    let shown = "[...document.querySelectorAll('.fixed > img')].filter((image) => image.complete && image.naturalWidth === 128).length";
    assert_eq!(browser.value(shown), json!(6));
    assert_eq!(found(&mut browser)["operations"], json!([]));
    assert!(attribute(&mut browser, "program-verdict", "textContent").starts_with("Stored trace"));
    let before = attribute(&mut browser, "stepper", "dataset.step");
    browser.press("stepper", "ArrowRight", 39);
    assert_ne!(attribute(&mut browser, "stepper", "dataset.step"), before);
    assert!(browser.value("document.querySelectorAll('#written code').length").as_u64() > Some(0));
    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
}
