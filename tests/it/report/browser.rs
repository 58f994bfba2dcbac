//! Controls a real Chromium over a pipe: reads what it shows, its errors and its network requests.

use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// The name of an installed browser. If there is none, a message is written; in CI the test fails.
pub fn installed() -> Option<&'static str> {
    let found = NAMES.into_iter().find(|name| {
        let version = Command::new(name).arg("--version").output();
        version.is_ok_and(|output| output.status.success())
    });
    if found.is_none() {
        let words = "no Chromium is installed: the tests of the report in a browser are skipped";
        assert!(std::env::var_os("CI").is_none(), "{words}");
        // Not by `eprintln!`, whose output is hidden if the test passes.
        let _ = writeln!(io::stderr(), "{words}");
    }
    found
}

/// An open page and its events.
pub struct Browser {
    process: Child,
    commands: ChildStdin,
    answers: BufReader<ChildStdout>,
    session: Option<String>,
    sent: u64,
    /// The events that have arrived, oldest first.
    pub events: VecDeque<Value>,
}

impl Browser {
    pub fn open(name: &str) -> Browser {
        // The browser reads commands from file descriptor 3 and answers on file descriptor 4.
        let line = format!(
            "exec {name} --headless --no-sandbox --disable-gpu --remote-debugging-pipe about:blank \
             3<&0 4>&1 </dev/null >/dev/null 2>/dev/null"
        );
        let mut process = Command::new("sh")
            .args(["-c", &line])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("starts");
        let commands = process.stdin.take().expect("piped");
        let answers = BufReader::new(process.stdout.take().expect("piped"));
        let mut browser = Browser { process, commands, answers, session: None, sent: 0, events: VecDeque::new() };
        let targets = browser.call("Target.getTargets", json!({}));
        let targets = targets["targetInfos"].as_array().expect("a list");
        let page = targets.iter().find(|t| t["type"] == "page").expect("a page");
        let parameters = json!({ "targetId": page["targetId"], "flatten": true });
        let attached = browser.call("Target.attachToTarget", parameters);
        browser.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Network", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        // A page without focus sends no focus events for its elements.
        let focus = json!({ "enabled": true });
        browser.call("Emulation.setFocusEmulationEnabled", focus);
        browser
    }

    /// Calls a method of the protocol. Events that arrive in the meantime are kept.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.sent += 1;
        let id = self.sent;
        let mut message = json!({ "id": id, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = session.clone().into();
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.commands.write_all(&bytes).expect("the browser reads its input");
        loop {
            let answer = self.next();
            if answer["id"] == id {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
        }
    }

    fn next(&mut self) -> Value {
        let mut bytes = Vec::new();
        self.answers.read_until(0, &mut bytes).expect("the browser answers");
        bytes.pop();
        let message: Value = serde_json::from_slice(&bytes).expect("JSON");
        if message["method"].is_string() {
            self.events.push_back(message.clone());
        }
        message
    }

    /// Opens a file and waits until it has loaded.
    pub fn go(&mut self, file: &Path) {
        self.visit(&format!("file://{}", file.display()));
    }

    /// Opens an address and waits until it has loaded.
    pub fn visit(&mut self, url: &str) {
        self.events.clear();
        self.call("Page.navigate", json!({ "url": url }));
        while !self.events.iter().any(|e| e["method"] == "Page.loadEventFired") {
            self.next();
        }
    }

    /// The value of a JavaScript expression on the page.
    pub fn eval(&mut self, expression: &str) -> Value {
        let parameters = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let answer = self.call("Runtime.evaluate", parameters);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {}", answer["exceptionDetails"]);
        answer["result"]["value"].clone()
    }

    /// The number of elements that match a selector. This works also if scripts are disabled.
    pub fn count(&mut self, selector: &str) -> usize {
        let root = self.call("DOM.getDocument", json!({}))["root"]["nodeId"].clone();
        let parameters = json!({ "nodeId": root, "selector": selector });
        let found = self.call("DOM.querySelectorAll", parameters);
        found["nodeIds"].as_array().map_or(0, Vec::len)
    }

    /// Sets the width and the colour scheme, light or dark, of the page.
    pub fn view(&mut self, width: u32, scheme: &str) {
        let size = json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", size);
        let scheme = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.call("Emulation.setEmulatedMedia", scheme);
    }

    /// The errors since the page was opened: exceptions, error messages, dialogues, and requests for anything except
    /// the page itself.
    pub fn complaints(&self) -> Vec<String> {
        let bad = |event: &&Value| match event["method"].as_str().unwrap_or_default() {
            "Runtime.exceptionThrown"
            | "Page.javascriptDialogOpening"
            | "Runtime.consoleAPICalled"
            | "Log.entryAdded" => true,
            "Network.requestWillBeSent" => event["params"]["type"] != "Document",
            _ => false,
        };
        self.events.iter().filter(bad).map(Value::to_string).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // The process may have ended already.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
