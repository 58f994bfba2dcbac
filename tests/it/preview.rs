//! The live preview: its answers to requests, and its page in Chromium.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::report::browser::{Browser, installed};
use crate::snapshot::lintel;

/// A running preview of two scenes.
struct Preview {
    folder: TempDir,
    process: Child,
    address: String,
}

impl Preview {
    fn start(options: &[&str]) -> Preview {
        Preview::of(&["a.json", "b.json"], options)
    }

    fn of(scenes: &[&str], options: &[&str]) -> Preview {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["a.json", "b.json"] {
            fs::write(folder.path().join(name), lintel(&format!("The lintel of {name}"), 1.0)).expect("written");
        }
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        command.arg("render").args(scenes).arg("--watch").args(options).args(["--serve", "0"]);
        command.current_dir(folder.path()).stderr(Stdio::piped());
        let mut process = command.spawn().expect("starts");
        let mut lines = BufReader::new(process.stderr.take().expect("piped"));
        let mut first = String::new();
        lines.read_line(&mut first).expect("readable");
        let address = first.split("http://").nth(1).and_then(|rest| rest.split('/').next());
        let address = address.unwrap_or_else(|| panic!("no address in {first}")).to_owned();
        std::thread::spawn(move || lines.read_to_end(&mut Vec::new()));
        Preview { folder, process, address }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Sends these lines as the head of a request, and returns the answer.
    fn ask(&self, lines: &[&str]) -> String {
        let mut stream = TcpStream::connect(&self.address).expect("it listens");
        stream.set_read_timeout(Some(Duration::from_secs(60))).expect("set");
        stream.write_all(format!("{}\r\n\r\n", lines.join("\r\n")).as_bytes()).expect("written");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        answer
    }

    fn get(&self, path: &str) -> Value {
        let answer = self.ask(&[&format!("GET {path} HTTP/1.1"), &format!("Host: {}", self.address)]);
        assert!(answer.starts_with("HTTP/1.1 200 OK\r\n"), "{answer}");
        serde_json::from_str(answer.split_once("\r\n\r\n").expect("a body").1).expect("JSON")
    }
}

impl Drop for Preview {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

#[test]
fn the_preview_answers_only_its_own_page_on_this_machine() {
    let preview = Preview::start(&[]);
    assert!(preview.address.starts_with("127.0.0.1:"), "{}", preview.address);
    let host = format!("Host: {}", preview.address);
    let port = preview.address.rsplit(':').next().expect("a port");
    let [local, own, other] = [
        format!("Host: localhost:{port}"),
        format!("Origin: http://{}", preview.address),
        format!("Origin: http://{}.evil.example", preview.address),
    ];
    for (lines, status) in [
        (vec!["GET / HTTP/1.1", &host], "200"),
        (vec!["GET / HTTP/1.1", &local], "200"),
        (vec!["GET /preview.js HTTP/1.1", &local, &own], "200"),
        (vec!["GET / HTTP/1.1", "Host: localhost:9"], "403"),
        (vec!["GET / HTTP/1.1", "Host: localhost"], "403"),
        (vec!["GET / HTTP/1.1", "Host: 127.0.0.1:evil.example"], "403"),
        (vec!["GET / HTTP/1.1", &host, "Origin: null"], "403"),
        (vec!["GET /preview.js HTTP/1.1", &host, "Origin: https://evil.example"], "403"),
        (vec!["GET /preview.js HTTP/1.1", &host, &other], "403"),
        (vec!["GET / HTTP/1.1", &host, "Sec-Fetch-Site: cross-site"], "200"),
        (vec!["GET /preview.js HTTP/1.1", &host, "sec-fetch-site: same-origin"], "200"),
        (vec!["GET / HTTP/1.1", "Host: evil.example"], "403"),
        (vec!["GET / HTTP/1.1", "host: 127.0.0.1.evil.example:80"], "403"),
        (vec!["GET /state?since=0 HTTP/1.1", &host, "Sec-Fetch-Site: same-site"], "403"),
        (vec!["GET /preview.js HTTP/1.1", &host, "Sec-Fetch-Site: cross-site"], "403"),
        (vec!["GET / HTTP/1.1"], "403"),
        (vec!["GET / HTTP/1.1", &host, "Host: evil.example"], "403"),
        (vec!["POST / HTTP/1.1", &host], "403"),
        (vec!["GET /../Cargo.toml HTTP/1.1", &host], "404"),
    ] {
        let answer = preview.ask(&lines);
        assert!(answer.starts_with(&format!("HTTP/1.1 {status} ")), "{lines:?}: {answer}");
        assert!(!answer.contains("Access-Control"), "{answer}");
        assert!(answer.contains("Cross-Origin-Resource-Policy: same-origin"), "{answer}");
    }
}

#[test]
fn the_preview_follows_each_save_and_keeps_the_last_good_picture() {
    let preview = Preview::start(&["-o", "out/"]);
    let state = preview.get("/state?since=0");
    assert_eq!(state["scenes"], json!([["a.json", true], ["b.json", true]]));
    assert!(state["kinds"].as_array().expect("a list").contains(&json!("flow")), "{state}");
    let good = preview.get("/picture?scene=1&kind=flow&theme=dark");
    assert!(
        good["svg"].as_str().expect("text").starts_with("<svg") && good["words"] == "stands" && good["problem"] == ""
    );

    fs::write(preview.path("b.json"), lintel("x", 1.0).replace("\"weight\":60", "\"wieght\":60")).expect("written");
    let version = state["version"].to_string();
    let state = preview.get(&format!("/state?since={version}"));
    assert_eq!(state["scenes"], json!([["a.json", true], ["b.json", false]]));
    let kept = preview.get("/picture?scene=1&kind=flow&theme=dark");
    assert_eq!(kept["svg"], good["svg"]);
    assert_eq!(kept["words"], "the last version without problems: stands");
    let problem = kept["problem"].as_str().expect("text");
    for part in
        ["b.json:1:61: blocks[0].wieght", "\"wieght\":60", "^^^^^^^^", "help: the nearest known key is `weight`"]
    {
        assert!(problem.contains(part), "{part}: {problem}");
    }
    assert!(!problem.contains('\u{1b}'), "no escape codes: {problem:?}");
    // This kind has no good picture yet.
    let outlines = preview.get("/picture?scene=1&kind=thrust");
    assert_eq!(outlines["words"], "the outlines, with the problems marked");
    assert!(outlines["svg"].as_str().expect("text").starts_with("<svg"));
    let written = fs::read_to_string(preview.path("out/a.svg")).expect("written too");
    assert_eq!(preview.get("/picture?scene=0")["svg"], written);
    assert!(preview.get("/picture?scene=7")["problem"].as_str().expect("text").contains("no such scene"));
}

#[test]
fn a_preview_of_a_folder_shows_files_that_are_new_and_no_longer_those_that_are_gone() {
    let preview = Preview::of(&["."], &[]);
    let names = |state: &Value| -> Vec<String> {
        let name = |scene: &Value| scene[0].as_str().expect("a name").trim_start_matches("./").to_owned();
        state["scenes"].as_array().expect("a list").iter().map(name).collect()
    };
    let after = |state: &Value| preview.get(&format!("/state?since={}", state["version"]));
    let state = preview.get("/state?since=0");
    assert_eq!(names(&state), ["a.json", "b.json"]);
    fs::write(preview.path("c.json"), lintel("The third", 1.0)).expect("written");
    let state = after(&state);
    assert_eq!(names(&state), ["a.json", "b.json", "c.json"]);
    assert!(preview.get("/picture?scene=2")["svg"].as_str().expect("text").contains("The third"));
    fs::remove_file(preview.path("a.json")).expect("removed");
    assert_eq!(names(&after(&state)), ["b.json", "c.json"]);
}

#[test]
fn the_page_shows_saves_problems_tabs_and_themes_in_a_browser() {
    let Some(name) = installed() else {
        return;
    };
    let preview = Preview::start(&[]);
    let mut browser = Browser::open(name);
    browser.view(1000, "light");
    browser.visit(&format!("http://{}/", preview.address));
    let until = |browser: &mut Browser, condition: &str| {
        let start = Instant::now();
        while browser.eval(condition) != true {
            assert!(
                start.elapsed() < Duration::from_secs(60),
                "{condition}: {}",
                browser.eval("document.body.innerText")
            );
            std::thread::sleep(Duration::from_millis(50));
        }
    };
    let picture = "decodeURIComponent(document.getElementById('picture').src)";
    until(&mut browser, &format!("{picture}.includes('The lintel of a.json')"));
    assert_eq!(browser.eval("document.getElementById('problem').hidden"), true);
    assert_eq!(browser.eval("document.getElementById('picture').naturalWidth > 100"), true);
    // Tabs, kinds and themes.
    browser.eval("document.querySelectorAll('nav button')[1].click()");
    until(&mut browser, &format!("{picture}.includes('The lintel of b.json')"));
    let pick = |id: &str, value: &str| {
        format!(
            "(s => {{ s.value = '{value}'; s.dispatchEvent(new Event('change')) }})(document.getElementById('{id}'))"
        )
    };
    for (list, value) in [("theme", "dark"), ("kind", "flow")] {
        let old = browser.eval(picture);
        browser.eval(&pick(list, value));
        until(&mut browser, &format!("{picture} !== {old}"));
    }
    // A problem, with the last good picture; then a save without it.
    let old = browser.eval(picture);
    fs::write(preview.path("b.json"), lintel("Mended", 1.0).replace("\"weight\":110", "\"weight\":-1"))
        .expect("written");
    until(&mut browser, "document.getElementById('problem').textContent.includes('^^')");
    assert_eq!(browser.eval(picture), old);
    assert_eq!(browser.eval("document.querySelectorAll('nav button.wrong').length"), 1);
    fs::write(preview.path("b.json"), lintel("Mended", 1.0)).expect("written");
    until(&mut browser, &format!("{picture}.includes('Mended') && document.getElementById('problem').hidden"));
    let bad = browser.complaints();
    let bad: Vec<&String> = bad.iter().filter(|event| !event.contains("Network.requestWillBeSent")).collect();
    assert!(bad.is_empty(), "{bad:?}");
    for event in &browser.events {
        let url = event["params"]["request"]["url"].as_str().unwrap_or_default();
        let is_own =
            url.is_empty() || url.starts_with("data:") || url.starts_with(&format!("http://{}/", preview.address));
        assert!(is_own, "{url}");
    }
}
