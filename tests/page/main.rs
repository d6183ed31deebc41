//! The page of `crossbar page` in Chromium, whose WebGPU runs on SwiftShader: all bits are the emulator's, controls
//! work, and without WebGPU the page shows its stored pictures. Without Chromium the tests count as ignored; where `CI`
//! is set, that is a failure.

mod browser;

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
        trial("without_webgpu_there_are_pictures", without_webgpu_there_are_pictures),
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

/// Does something, and waits for another live picture.
fn redrawn(browser: &mut Browser, act: impl FnOnce(&mut Browser)) -> (String, String) {
    let before = drawn(browser);
    act(browser);
    browser.wait(&format!("document.getElementById('view').dataset.drawn !== '{before}'"));
    (before, drawn(browser))
}

/// The short form draws three of the six fixed pictures: each takes SwiftShader ten seconds.
fn every_bit_is_the_emulators_and_controls_work(name: &str, file: &Path) {
    let (pictures, page) = if is_full() { (6, file.to_owned()) } else { (3, shortened(file)) };
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
    // SwiftShader's own floats are within what WGSL allows, and were looked at.
    let native = list("native");
    let single: Vec<&Value> = native.iter().filter(|line| line["type"] == "f32").collect();
    assert_eq!(single.len(), 17);
    assert!(single.iter().all(|line| line["beyond"].is_null() || line["beyond"] == 0), "{single:#?}");
    assert!(single.iter().all(|line| line["sets"].as_u64() > Some(500)));
    assert!(found["adapter"]["browser"].is_string());

    // The live view shows the first fixed view in s3.12, then what the keyboard chooses.
    let first = format!("s3.12 {}", list("teapot")[0]["expected"].as_str().unwrap_or_default());
    assert_eq!(drawn(&mut browser), first);
    let (before, after) = redrawn(&mut browser, |browser| browser.press("fractions-of", "ArrowLeft", 37));
    assert!(before.starts_with("s3.12 ") && after.starts_with("s3.11 "), "{before} -> {after}");
    let (before, after) = redrawn(&mut browser, |browser| browser.press("view", "ArrowLeft", 37));
    assert_ne!(before, after, "the camera moves");
    let told = browser.value("document.getElementById('told').textContent").to_string();
    assert!(told.contains("leak") && told.contains("double precision"), "{told}");

    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
    let others: Vec<&str> =
        browser.requests().into_iter().filter(|url| !url.starts_with("file:") && !url.starts_with("data:")).collect();
    assert!(others.is_empty(), "{others:?}");
}

fn is_full() -> bool {
    std::env::var_os("CROSSBAR_FULL").is_some()
}

/// Writes the page again under another name, with its data changed.
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

/// Two pictures of the first view, one of the second.
fn shortened(file: &Path) -> PathBuf {
    changed(file, "short.html", |data| {
        pictures(data, 0).truncate(2);
        pictures(data, 1).truncate(1);
    })
}

/// Flips the lowest bit of a byte of encoded data.
fn flip(data: &mut Value, byte: usize) {
    let mut bytes = STANDARD.decode(data.as_str().expect("text")).expect("base64");
    bytes[byte] ^= 1;
    *data = json!(STANDARD.encode(bytes));
}

/// A page that carries one wrong result and one wrong hit shows both: the comparison can fail. Full form.
fn a_wrong_bit_is_found_and_named(name: &str, file: &Path) {
    const PIXEL: usize = 39 * 128 + 8;
    // The first result of `add` in s3.12, of two bytes; t of a pixel of the first picture, which stays alone.
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

fn without_webgpu_there_are_pictures(name: &str, file: &Path) {
    let mut browser = Browser::start(name, false);
    browser.call(
        "Page.addScriptToEvaluateOnNewDocument",
        json!({ "source": "Object.defineProperty(Navigator.prototype, 'gpu', { get: () => undefined });" }),
    );
    browser.open(file);
    browser.wait("document.body.dataset.state !== 'loading'");
    assert_eq!(browser.value("document.body.dataset.state"), json!("without"));
    let status = browser.value("document.getElementById('status').textContent").to_string();
    assert!(status.contains("no WebGPU"), "{status}");
    let shown = "[...document.querySelectorAll('.fixed > img')].filter((image) => image.complete && image.naturalWidth === 128).length";
    assert_eq!(browser.value(shown), json!(6));
    assert_eq!(found(&mut browser)["operations"], json!([]));
    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
}
