//! The page of `crossbar page` in Chromium, whose WebGPU runs on SwiftShader: all bits are the emulator's, controls
//! work, and without WebGPU the page shows its stored pictures. Without Chromium the tests count as ignored; where `CI`
//! is set, that is a failure.

mod browser;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

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
    let trials = vec![
        trial("every_bit_is_the_emulators_and_controls_work", every_bit_is_the_emulators_and_controls_work),
        trial("without_webgpu_there_are_pictures", without_webgpu_there_are_pictures),
    ];
    if name.is_none() {
        eprintln!("no Chromium: the page is not tested");
    }
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

fn write_page(folder: &Path) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_crossbar"));
    let output = command.args(["page", "--out"]).arg(folder).output().expect("the program");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// What the page shows as JSON.
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

fn every_bit_is_the_emulators_and_controls_work(name: &str, file: &Path) {
    let mut browser = Browser::start(name, true);
    browser.open(file);
    browser.wait("document.body.dataset.state !== 'loading'");
    let found = found(&mut browser);
    assert_eq!(browser.value("document.body.dataset.state"), json!("equal"), "{found:#}");
    let list = |name: &str| found[name].as_array().cloned().unwrap_or_default();
    assert_eq!(list("operations").len(), 17 * 8);
    assert!(list("operations").iter().all(|cell| cell["wrong"] == 0 && cell["sets"] == 2048));
    assert_eq!(list("teapot").len(), 6);
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
    assert!(told.contains("leaks") && told.contains("double precision"), "{told}");

    assert!(browser.errors().is_empty(), "{:?}", browser.errors());
    let others: Vec<&str> =
        browser.requests().into_iter().filter(|url| !url.starts_with("file:") && !url.starts_with("data:")).collect();
    assert!(others.is_empty(), "{others:?}");
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
