//! Drives a Chromium without a window through its debugging pipe, with JSON messages that end with a zero byte.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Maximum time without a change on the page.
const PATIENCE: Duration = Duration::from_secs(600);

/// The program's possible names.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// A Chromium with one page.
pub(crate) struct Browser {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    session: String,
    last_id: u64,
    /// Events that arrived before the awaited answers.
    pub(crate) events: Vec<Value>,
    // Deleted with the browser.
    _profile: tempfile::TempDir,
}

/// Name of the Chromium of this computer, if it has one.
pub(crate) fn chromium() -> Option<&'static str> {
    let runs =
        |name: &&&str| Command::new(**name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    NAMES.iter().find(|name| runs(name).is_ok_and(|status| status.success())).copied()
}

impl Browser {
    /// Starts a browser, with WebGPU on SwiftShader or without WebGPU.
    pub(crate) fn start(name: &str, webgpu: bool) -> Self {
        let profile = tempfile::tempdir().expect("a folder for the browser");
        let gpu = if webgpu { "--enable-unsafe-webgpu --use-webgpu-adapter=swiftshader" } else { "--disable-gpu" };
        // The pipe is at descriptors 3 and 4.
        let line = format!(
            "exec {name} --headless --no-sandbox --disable-dev-shm-usage --no-first-run --disable-renderer-backgrounding \
             --disable-background-timer-throttling --disable-backgrounding-occluded-windows --remote-debugging-pipe {gpu} \
             --user-data-dir=\"$0\" about:blank 3<&0 4>&1 >/dev/null"
        );
        let mut child = Command::new("sh")
            .args(["-c", &line])
            .arg(profile.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("a shell");
        let to = child.stdin.take().expect("a pipe");
        let from = BufReader::new(child.stdout.take().expect("a pipe"));
        let (session, events) = (String::new(), Vec::new());
        let mut browser = Self { child, to, from, session, last_id: 0, events, _profile: profile };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attached =
            browser.call("Target.attachToTarget", json!({ "targetId": target["targetId"], "flatten": true }));
        browser.session = attached["sessionId"].as_str().expect("a session").to_owned();
        for domain in ["Page", "Runtime", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// Calls a method of the protocol; returns its result.
    pub(crate) fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.last_id += 1;
        let mut message = json!({ "id": self.last_id, "method": method, "params": parameters });
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.to.write_all(&bytes).expect("the browser reads");
        loop {
            let mut bytes = Vec::new();
            self.from.read_until(0, &mut bytes).expect("the browser writes");
            bytes.pop();
            let mut message: Value = serde_json::from_slice(&bytes).expect("a message of the browser");
            if message["id"] == json!(self.last_id) {
                assert!(message.get("error").is_none(), "{method}: {}", message["error"]);
                return message["result"].take();
            }
            self.events.push(message);
        }
    }

    pub(crate) fn value(&mut self, expression: &str) -> Value {
        let mut result = self.call("Runtime.evaluate", json!({ "expression": expression, "returnByValue": true }));
        result["result"]["value"].take()
    }

    /// Waits until an expression holds, as long as the page continues to report changes.
    pub(crate) fn wait(&mut self, expression: &str) {
        let mut start = Instant::now();
        let mut last = Value::Null;
        while self.value(expression) != json!(true) {
            let status = self.value("document.getElementById('status').textContent");
            if status != last {
                (start, last) = (Instant::now(), status);
            }
            assert!(start.elapsed() < PATIENCE, "{expression} does not come true; the page says {last}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    pub(crate) fn open(&mut self, file: &Path) {
        self.call("Page.navigate", json!({ "url": format!("file://{}", file.display()) }));
        self.wait("document.readyState === 'complete'");
    }

    /// Focuses an element and presses a key.
    pub(crate) fn press(&mut self, id: &str, key: &str, code: u32) {
        self.value(&format!("document.getElementById('{id}').focus()"));
        for kind in ["keyDown", "keyUp"] {
            self.call(
                "Input.dispatchKeyEvent",
                json!({ "type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code }),
            );
        }
    }

    /// Errors that the page has raised or logged so far.
    pub(crate) fn errors(&self) -> Vec<&Value> {
        let is_error = |event: &&Value| match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => event["params"]["type"] == "error",
            _ => false,
        };
        self.events.iter().filter(is_error).collect()
    }

    /// Addresses that the page has requested.
    pub(crate) fn requests(&self) -> Vec<&str> {
        let sent = self.events.iter().filter(|event| event["method"] == "Network.requestWillBeSent");
        sent.filter_map(|event| event["params"]["request"]["url"].as_str()).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        self.child.kill().ok();
        self.child.wait().ok();
    }
}
