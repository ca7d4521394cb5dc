//! A browser and its tabs.
//!
//! The protocol runs over two pipes, file descriptors 3 and 4 of the browser, as JSON texts that end with a zero byte. A
//! shell makes these descriptors of its standard input and output, which needs no code of the operating system's here.

use crate::referees::is_there;
use serde_json::{Value, json};
use std::cell::{Cell, RefCell};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// How long anything may take that a test waits for. Far more than it does: machines of tests are busy.
const PATIENCE: Duration = Duration::from_secs(60);

const START: &str = "exec chromium --headless=new --no-sandbox --disable-gpu --use-angle=swiftshader \
    --enable-unsafe-swiftshader --disable-dev-shm-usage --no-first-run --disable-extensions --disable-background-networking \
    --disable-component-update --disable-sync --hide-scrollbars --remote-debugging-pipe --user-data-dir=\"$PROFILE\" \
    3<&0 4>&1 0</dev/null 1>/dev/null 2>/dev/null";

/// Whether Chromium is installed.
fn is_installed() -> bool {
    is_there(
        "Chromium",
        Command::new("chromium").arg("--version"),
        "Debian package chromium",
    )
}

/// A browser without a window.
pub(super) struct Browser {
    process: Child,
    to: RefCell<ChildStdin>,
    from: RefCell<BufReader<ChildStdout>>,
    next: Cell<u64>,
    /// What was reported without being asked for.
    events: RefCell<Vec<Value>>,
    /// Where it keeps its things.
    _profile: TempDir,
}

impl Browser {
    /// A new one; none where it is not installed.
    pub(super) fn start() -> Option<Self> {
        if !is_installed() {
            return None;
        }
        let profile = tempfile::tempdir().unwrap();
        let mut process = Command::new("sh")
            .args(["-c", START])
            .env("PROFILE", profile.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let to = RefCell::new(process.stdin.take().unwrap());
        let from = RefCell::new(BufReader::new(process.stdout.take().unwrap()));
        Some(Self {
            process,
            to,
            from,
            next: Cell::new(1),
            events: RefCell::new(Vec::new()),
            _profile: profile,
        })
    }

    /// Sends a command and waits for its answer.
    fn call(&self, tab: Option<&str>, method: &str, params: &Value) -> Value {
        let id = self.next.replace(self.next.get() + 1);
        let mut message = json!({ "id": id, "method": method, "params": params });
        if let Some(tab) = tab {
            message["sessionId"] = json!(tab);
        }
        let mut to = self.to.borrow_mut();
        to.write_all(message.to_string().as_bytes()).unwrap();
        to.write_all(&[0]).unwrap();
        to.flush().unwrap();
        loop {
            let answer = self.read();
            if answer["id"] == id {
                // A page that goes on to another one answers nothing more.
                if answer["error"]["message"] == "Inspected target navigated or closed" {
                    return Value::Null;
                }
                assert_eq!(answer["error"], Value::Null, "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.events.borrow_mut().push(answer);
        }
    }

    fn read(&self) -> Value {
        let mut bytes = Vec::new();
        self.from.borrow_mut().read_until(0, &mut bytes).unwrap();
        assert_eq!(bytes.pop(), Some(0), "the browser has gone");
        serde_json::from_slice(&bytes).unwrap()
    }

    /// A tab of this size in CSS pixels with a page in it, loaded.
    pub(super) fn open(&self, page: &Path, width: u32, height: u32) -> Tab<'_> {
        self.open_at(&format!("file://{}", page.display()), width, height)
    }

    /// A tab of this size with what is at an address, loaded.
    pub(super) fn open_at(&self, url: &str, width: u32, height: u32) -> Tab<'_> {
        let target = self.call(None, "Target.createTarget", &json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        let session = self.call(None, "Target.attachToTarget", &attach)["sessionId"].clone();
        let tab = Tab {
            browser: self,
            session: session.as_str().unwrap().to_owned(),
        };
        for domain in ["Page", "Runtime", "Log", "Network"] {
            tab.call(&format!("{domain}.enable"), &json!({}));
        }
        tab.resize(width, height);
        tab.call("Page.navigate", &json!({ "url": url }));
        tab.wait_for_event("Page.loadEventFired");
        tab
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // It may be gone already, and then there is nothing to end.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// A tab with a page.
pub(super) struct Tab<'b> {
    browser: &'b Browser,
    session: String,
}

impl Tab<'_> {
    fn call(&self, method: &str, params: &Value) -> Value {
        self.browser.call(Some(&self.session), method, params)
    }

    /// Sets the size of what is seen.
    pub(super) fn resize(&self, width: u32, height: u32) {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", &size);
    }

    /// The value of an expression; promises are waited for.
    pub(super) fn value(&self, expression: &str) -> Value {
        let params = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let answer = self.call("Runtime.evaluate", &params);
        assert_eq!(
            answer["exceptionDetails"],
            Value::Null,
            "{expression}: {}",
            answer["exceptionDetails"]["exception"]["description"]
        );
        answer["result"]["value"].clone()
    }

    /// The value of an expression that is a number.
    pub(super) fn number(&self, expression: &str) -> f64 {
        let value = self.value(expression);
        value
            .as_f64()
            .unwrap_or_else(|| panic!("{expression} is {value}"))
    }

    /// Whether an expression holds.
    pub(super) fn holds(&self, expression: &str) -> bool {
        self.value(expression) == Value::Bool(true)
    }

    /// Waits until an expression holds.
    pub(super) fn wait_until(&self, expression: &str) {
        let start = Instant::now();
        while !self.holds(expression) {
            assert!(start.elapsed() < PATIENCE, "it never came to this: {expression}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn wait_for_event(&self, method: &str) {
        let start = Instant::now();
        let is_it = |event: &Value| event["method"] == method && event["sessionId"] == self.session.as_str();
        while !self.browser.events.borrow().iter().any(is_it) {
            assert!(start.elapsed() < PATIENCE, "no {method}");
            let event = self.browser.read();
            self.browser.events.borrow_mut().push(event);
        }
    }

    /// Presses or turns the mouse at a place of the window; `more` are further parameters of the event.
    pub(super) fn mouse(&self, kind: &str, [x, y]: [f64; 2], more: &Value) {
        let mut params = json!({ "type": kind, "x": x, "y": y });
        for (key, value) in more.as_object().unwrap() {
            params[key] = value.clone();
        }
        self.call("Input.dispatchMouseEvent", &params);
    }

    /// Clicks at a place of the window.
    pub(super) fn click(&self, at: [f64; 2]) {
        for kind in ["mousePressed", "mouseReleased"] {
            self.mouse(kind, at, &json!({ "button": "left", "clickCount": 1 }));
        }
    }

    /// Presses a key that stands for a letter or has a name.
    pub(super) fn key(&self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            self.call("Input.dispatchKeyEvent", &json!({ "type": kind, "key": key }));
        }
    }

    /// The middle of an element in the window, after it has been brought there.
    pub(super) fn middle(&self, selector: &str) -> [f64; 2] {
        let selector = json!(selector);
        self.value(&format!(
            "document.querySelector({selector}).scrollIntoView({{ block: 'center', behavior: 'instant' }})"
        ));
        let place = |of: &str, size: &str| {
            self.number(&format!(
                "(() => {{ const box = document.querySelector({selector}).getBoundingClientRect(); \
                 return box.{of} + box.{size} / 2; }})()"
            ))
        };
        [place("left", "width"), place("top", "height")]
    }

    /// How many pages of A4 it is on paper, in a document of PDF.
    pub(super) fn pages_on_paper(&self) -> f64 {
        let paper = json!({ "paperWidth": 8.27, "paperHeight": 11.69, "preferCSSPageSize": true });
        let printed = self.call("Page.printToPDF", &paper);
        // The tree of pages says how many there are.
        self.number(&format!(
            "Number(/\\/Type\\s*\\/Pages\\s*\\/Count (\\d+)/.exec(atob('{}'))[1])",
            printed["data"].as_str().unwrap()
        ))
    }

    /// Whether what is seen is shown on a dark ground.
    pub(super) fn darken(&self) {
        let dark = json!({ "features": [{ "name": "prefers-color-scheme", "value": "dark" }] });
        self.call("Emulation.setEmulatedMedia", &dark);
    }

    /// A picture of what is seen as PNG, in base 64.
    pub(super) fn picture(&self) -> String {
        let picture = self.call("Page.captureScreenshot", &json!({ "format": "png" }));
        picture["data"].as_str().unwrap().to_owned()
    }

    /// How many different colours a picture has.
    pub(super) fn colours(&self, picture: &str) -> f64 {
        let blank = self.browser.open(Path::new("/dev/null"), 100, 100);
        blank.number(&format!(
            "(async () => {{
                const bytes = Uint8Array.from(atob('{picture}'), (letter) => letter.charCodeAt(0));
                const image = await createImageBitmap(new Blob([bytes], {{ type: 'image/png' }}));
                const canvas = new OffscreenCanvas(image.width, image.height);
                const context = canvas.getContext('2d');
                context.drawImage(image, 0, 0);
                return new Set(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)).size;
            }})()"
        ))
    }

    /// What the page said to the console, what went wrong in it, and what it asked for beside itself.
    pub(super) fn complaints(&self) -> Vec<String> {
        // Events come in order: after this answer all earlier ones are there.
        self.value("1");
        let events = self.browser.events.borrow();
        let mine = events
            .iter()
            .filter(|event| event["sessionId"] == self.session.as_str());
        let mut is_first = true;
        mine.filter(|event| match event["method"].as_str().unwrap_or_default() {
            "Runtime.exceptionThrown" | "Runtime.consoleAPICalled" => true,
            // Graphics without a graphics card are slow, and its driver says so.
            "Log.entryAdded" => event["params"]["entry"]["source"] != "rendering",
            "Network.requestWillBeSent" => !std::mem::take(&mut is_first),
            _ => false,
        })
        .map(|event| event["params"].to_string())
        .collect()
    }
}
