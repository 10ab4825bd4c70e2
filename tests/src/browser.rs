//! Chromium without a window, driven by its debugging protocol through a pipe.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;

/// Time after which a browser that does not answer counts as hung.
const PATIENCE: Duration = Duration::from_secs(120);

/// Events that tell of trouble: what a page writes to the console, faults of a script, and what the
/// browser itself notes.
const TROUBLE: [&str; 3] =
    ["Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"];

/// A browser with one page.
pub struct Browser {
    child: Child,
    input: ChildStdin,
    messages: Receiver<Value>,
    session: String,
    count: u64,
    /// Events so far.
    events: Vec<Value>,
    /// The profile, which goes with the browser.
    _profile: TempDir,
}

impl Browser {
    /// Starts a browser.
    ///
    /// # Panics
    /// Panics if Chromium is missing or does not answer.
    pub fn start() -> Self {
        let profile = tempfile::tempdir().expect("a folder for the profile");
        // The protocol is spoken on the descriptors 3 and 4.
        let mut child = Command::new("sh")
            .args(["-c", "exec chromium \"$@\" 3<&0 4>&1 </dev/null >/dev/null 2>&1", "sh"])
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run"])
            .args(["--disable-background-networking", "--remote-debugging-pipe"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a shell");
        let input = child.stdin.take().expect("its standard input");
        let output = child.stdout.take().expect("its standard output");
        let (sender, messages) = channel();
        thread::spawn(move || {
            for message in BufReader::new(output).split(0) {
                let Ok(message) = message else { break };
                let Ok(message) = serde_json::from_slice(&message) else { break };
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        let (session, count, events) = (String::new(), 0, Vec::new());
        let mut browser =
            Self { child, input, messages, session, count, events, _profile: profile };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let target = json!({ "targetId": target["targetId"], "flatten": true });
        let attached = browser.call("Target.attachToTarget", target);
        browser.session = attached["sessionId"].as_str().expect("a session").to_owned();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// Calls a method of the protocol and returns its result.
    ///
    /// # Panics
    /// Panics if the browser refuses the call or does not answer.
    pub fn call(&mut self, method: &str, params: Value) -> Value {
        self.count += 1;
        let mut message = json!({ "id": self.count, "method": method, "params": params });
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        let missing = "chromium does not run: apt-get install --no-install-recommends chromium";
        self.input.write_all(format!("{message}\0").as_bytes()).expect(missing);
        loop {
            let mut message = self.messages.recv_timeout(PATIENCE).expect(missing);
            if message["id"] == self.count {
                assert!(message["error"].is_null(), "{method}: {}", message["error"]);
                return message["result"].take();
            }
            if message["method"].is_string() {
                self.events.push(message);
            }
        }
    }

    /// Opens a page and waits until `ready`, an expression, is true there.
    ///
    /// # Panics
    /// Panics if the page cannot be opened.
    pub fn open(&mut self, url: &str, ready: &str) {
        // Another link into the same page would not load it anew.
        self.call("Page.navigate", json!({ "url": "about:blank" }));
        let opened = self.call("Page.navigate", json!({ "url": url }));
        assert!(opened["errorText"].is_null(), "{url}: {opened}");
        self.wait(ready);
    }

    /// Waits until an expression is true in the page.
    ///
    /// # Panics
    /// Panics if it does not become true.
    pub fn wait(&mut self, ready: &str) {
        let mut waited = Duration::ZERO;
        let step = Duration::from_millis(20);
        while self.value(&format!("Boolean({ready})")) != true {
            assert!(waited < PATIENCE, "{ready}: {:?}", self.trouble());
            thread::sleep(step);
            waited += step;
        }
    }

    /// Returns the value of an expression in the page.
    ///
    /// # Panics
    /// Panics if the expression fails.
    pub fn value(&mut self, expression: &str) -> Value {
        let params =
            json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let mut result = self.call("Runtime.evaluate", params);
        let fault = &result["exceptionDetails"];
        assert!(fault.is_null(), "{expression}: {fault}");
        result["result"]["value"].take()
    }

    /// Returns the text that an expression is.
    ///
    /// # Panics
    /// Panics if it is none.
    pub fn text(&mut self, expression: &str) -> String {
        let value = self.value(expression);
        value.as_str().unwrap_or_else(|| panic!("{expression}: {value}")).to_owned()
    }

    /// Presses and releases a key, by its name and its code, such as `Tab` and 9.
    pub fn press(&mut self, key: &str, code: u32) {
        let name = if key == " " { "Space" } else { key };
        for kind in ["keyDown", "keyUp"] {
            let mut event = json!({
                "type": kind, "key": key, "code": name, "windowsVirtualKeyCode": code,
            });
            if kind == "keyDown" && key == " " {
                event["text"] = json!(" ");
            }
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Returns what went wrong so far: lines on the console, faults of scripts, and requests that
    /// leave the machine.
    pub fn trouble(&self) -> Vec<String> {
        let asks = |event: &&Value| {
            let url = event["params"]["request"]["url"].as_str().unwrap_or_default();
            let local =
                ["file:", "data:", "blob:", "about:"].iter().any(|way| url.starts_with(way));
            event["method"] == "Network.requestWillBeSent" && !local
        };
        let tells = |event: &&Value| TROUBLE.iter().any(|name| event["method"] == *name);
        self.events
            .iter()
            .filter(|event| tells(event) || asks(event))
            .map(Value::to_string)
            .collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // A test that has failed leaves no browser behind.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
