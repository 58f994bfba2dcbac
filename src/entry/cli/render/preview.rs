//! `drystone render --watch --serve`: shows figures in a browser, and draws them again whenever a file is saved.
//!
//! The server reads the head of one GET request and answers it; this needs no crate. It listens on the loopback address
//! only, and what a browser may load from it belongs to its own page:
//!
//! - The `Host` header must be exactly the address or `localhost`, with the port. A name of another site that leads to this
//!   machine (DNS rebinding) is refused.
//! - A request that a page of another origin makes is refused (`Origin`, `Sec-Fetch-Site`), and no header allows other
//!   origins to read an answer.
//! - The page loads nothing from elsewhere and cannot be shown in a frame (`Content-Security-Policy`).

use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::PathBuf;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use super::Render;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::picture::Format;
use crate::entry::cli::source;
use crate::entry::cli::style_args::ThemeChoice;
use crate::entry::cli::terminal::{Terminal, uncoloured};
use crate::entry::cli::watch;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure::{Kind, Options, View};
use crate::products::result::quoted;
use crate::text::Word;

const PAGE: &str = include_str!("../../../../assets/preview/preview.html");
const SCRIPT: &str = include_str!("../../../../assets/preview/preview.js");
/// The port if none is given and no other program uses it.
const PORT: u16 = 7171;
/// The page waits for a change for at most this time, and then asks again.
const PATIENCE: Duration = Duration::from_secs(20);
/// The time in which a request must arrive.
const MAX_READING: Duration = Duration::from_secs(5);
/// The largest head of a request.
const MAX_HEAD_BYTES: u64 = 16 << 10;
/// The number of columns of quoted lines in messages.
const COLUMNS: usize = 110;
const HEADERS: &str = "Cache-Control: no-store\r\nConnection: close\r\nX-Content-Type-Options: nosniff\r\n\
    Cross-Origin-Resource-Policy: same-origin\r\nReferrer-Policy: no-referrer\r\n\
    Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'unsafe-inline'; img-src data:; \
    connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n";

/// An SVG, and a line about it.
type Shown = (String, String);

/// The figures of scenes for a browser.
struct Preview<'a> {
    render: &'a Render,
    terminal: &'a Terminal,
    port: u16,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    /// The number of times that files were saved.
    version: u64,
    scenes: Vec<PathBuf>,
    /// Whether each scene is valid; empty before the first drawing.
    valid: Vec<bool>,
    /// The last good figure of each scene, for each kind and theme that a page asked for.
    good: BTreeMap<[String; 3], Shown>,
}

/// Serves the page on `port` until the program is stopped. `scenes` are the files at the start.
pub(super) fn serve(render: &Render, port: Option<u16>, scenes: Vec<PathBuf>, terminal: &Terminal) -> Ended {
    let bound = TcpListener::bind((Ipv4Addr::LOCALHOST, port.unwrap_or(PORT)));
    let bound = bound.or_else(|why| port.map_or_else(|| TcpListener::bind((Ipv4Addr::LOCALHOST, 0)), |_| Err(why)));
    let opened = bound.and_then(|listener| Ok((listener.local_addr()?, listener)));
    let (address, listener) = opened.map_err(|why| CliError::from(format!("--serve cannot open the port: {why}")))?;
    terminal.note(&format!("open http://{address}/ in a browser; Ctrl+C ends the preview"));
    let state = Mutex::new(State { scenes, ..State::default() });
    let preview = Preview { render, terminal, port: address.port(), state, changed: Condvar::new() };
    thread::scope(|scope| {
        scope.spawn(|| {
            for stream in listener.incoming().flatten() {
                let preview = &preview;
                // The browser may have closed the connection.
                scope.spawn(move || preview.answer(&stream));
            }
        });
        watch::repeat(|| render.watched(), terminal, || preview.saved())
    })
}

impl Preview<'_> {
    /// Draws the output again if there is one, and tells the pages that files were saved.
    fn saved(&self) -> Ended {
        let render = self.render.started();
        let level = &render.draw.figure.level;
        let read = |scene: &PathBuf| source::read(std::slice::from_ref(scene), render.frame, level);
        let scenes = source::files(&self.render.scenes)?.scenes;
        let read: Vec<Result<_, Vec<CliError>>> = scenes.iter().map(read).collect();
        let mut state = self.state();
        if state.scenes != scenes {
            // The numbers of the scenes change.
            state.good.clear();
            state.scenes = scenes;
        }
        state.valid = read.iter().map(Result::is_ok).collect();
        state.version += 1;
        drop(state);
        self.changed.notify_all();
        if self.render.output.is_some() {
            return render.once(self.terminal);
        }
        let problems: Vec<CliError> = read.into_iter().filter_map(Result::err).flatten().collect();
        if problems.is_empty() { Ok(ExitStatus::Done) } else { Err(problems) }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads a request and answers it.
    fn answer(&self, stream: &TcpStream) -> io::Result<()> {
        stream.set_read_timeout(Some(MAX_READING))?;
        let (mut head, mut reader) = (Vec::new(), BufReader::new(stream.take(MAX_HEAD_BYTES)));
        // An empty line ends the head.
        while reader.read_until(b'\n', &mut head)? > 2 {}
        let (status, kind, body) = self.content(&String::from_utf8_lossy(&head));
        let length = body.len();
        let head = format!(
            "HTTP/1.1 {status}\r\nContent-Type: {kind}; charset=utf-8\r\nContent-Length: {length}\r\n{HEADERS}\r\n"
        );
        let mut stream = stream;
        stream.write_all(format!("{head}{body}").as_bytes())
    }

    /// Returns the status, the type and the content of the answer to a request.
    fn content(&self, head: &str) -> (&'static str, &'static str, String) {
        let mut words = head.lines().next().unwrap_or_default().split(' ');
        let (method, target) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
        let values = |name: &str| -> Vec<&str> {
            let pairs = head.lines().skip(1).filter_map(|line| line.split_once(':'));
            pairs.filter(|(key, _)| key.eq_ignore_ascii_case(name)).map(|(_, value)| value.trim()).collect()
        };
        let is_own = |host: &str| {
            // A browser leaves out the port 80.
            let host = if host.contains(':') { host.to_owned() } else { format!("{host}:80") };
            ["127.0.0.1", "localhost"].iter().any(|name| host == format!("{name}:{}", self.port))
        };
        let (path, query) = target.split_once('?').unwrap_or((target, ""));
        let is_foreign = values("Sec-Fetch-Site").iter().any(|site| !["same-origin", "none"].contains(site));
        let has_foreign_origin = values("Origin").iter().any(|of| !of.strip_prefix("http://").is_some_and(is_own));
        let value = |name: &str| {
            let pairs = query.split('&').filter_map(|pair| pair.split_once('='));
            pairs.into_iter().find(|(key, _)| *key == name).map_or("", |(_, value)| value)
        };
        match (values("Host").as_slice(), method, path) {
            _ if has_foreign_origin => ("403 Forbidden", "text/plain", "a page of another origin asks\n".into()),
            ([host], "GET", "/") if is_own(host) => ("200 OK", "text/html", PAGE.into()),
            ([host], "GET", path) if is_own(host) && !is_foreign => match path {
                "/preview.js" => ("200 OK", "text/javascript", SCRIPT.into()),
                "/state" => ("200 OK", "application/json", self.news(value("since"))),
                "/picture" => {
                    ("200 OK", "application/json", self.picture([value("scene"), value("kind"), value("theme")]))
                }
                _ => ("404 Not Found", "text/plain", "there is no such page\n".into()),
            },
            _ => ("403 Forbidden", "text/plain", "only the page http://127.0.0.1 of this server may ask\n".into()),
        }
    }

    /// Waits until files were saved after the version `since`, but not too long. Returns the version, the scenes with
    /// their validity, the kinds and the themes, as JSON.
    fn news(&self, since: &str) -> String {
        let is_old = |state: &mut State| state.version == 0 || state.version.to_string() == since;
        let waited = self.changed.wait_timeout_while(self.state(), PATIENCE, is_old);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        let scenes = state.scenes.iter().zip(&state.valid);
        let scenes = scenes.map(|(path, valid)| format!("[{},{valid}]", quoted(&source::name(path))));
        let figure = &self.render.draw.figure;
        let needs_more = |kind: Kind| {
            kind.shows_one_block() && figure.block.is_none()
                || kind.needs_capacity() && figure.ask.capacity.capacity.is_none()
        };
        let kinds = Kind::ALL.into_iter().filter(|kind| !needs_more(*kind)).map(|kind| quoted(kind.name()));
        let themes = ThemeChoice::all().into_iter().map(|theme| quoted(theme.word()));
        let list = |items: Vec<String>| format!("[{}]", items.join(","));
        let [scenes, kinds, themes] = [list(scenes.collect()), list(kinds.collect()), list(themes.collect())];
        format!("{{\"version\":{},\"scenes\":{scenes},\"kinds\":{kinds},\"themes\":{themes}}}", state.version)
    }

    /// Draws a scene, given by its number, as a kind and in a theme, or in those of the command line for empty words.
    /// Returns the SVG, a line about it and the problems as JSON. If there are problems, the SVG is the last good one, or
    /// the outlines with the problems marked.
    fn picture(&self, asked: [&str; 3]) -> String {
        let (drawn, key) = (self.draw(asked), asked.map(str::to_owned));
        let (shown, problem) = match drawn {
            Ok(shown) => {
                self.state().good.insert(key, shown.clone());
                (shown, String::new())
            }
            Err(problems) => {
                let pages: Vec<String> = problems.iter().map(|one| uncoloured(&one.page(Some(COLUMNS)))).collect();
                let good = self.state().good.get(&key).cloned();
                let kept = good.map(|(svg, words)| (svg, format!("the last version without problems: {words}")));
                (kept.or_else(|| self.outlines(asked)).unwrap_or_default(), pages.join("\n"))
            }
        };
        format!("{{\"svg\":{},\"words\":{},\"problem\":{}}}", quoted(&shown.0), quoted(&shown.1), quoted(&problem))
    }

    /// Returns the scene with this number, the command with the kind and the theme, and what drawing needs.
    fn prepared(&self, [scene, kind, theme]: [&str; 3]) -> Result<(PathBuf, Render, Options, Fonts), CliError> {
        let scene = scene.parse().ok().and_then(|number: usize| self.state().scenes.get(number).cloned());
        let mut render = self.render.started();
        render.draw.figure.kind = View::from_name(kind).unwrap_or(render.draw.figure.kind);
        let theme = ThemeChoice::all().into_iter().find(|choice| choice.word() == theme);
        render.draw.look.theme = theme.or(render.draw.look.theme);
        render.draw.check(Format::Svg)?;
        let (options, fonts) = (render.draw.options()?, render.draw.picture.fonts()?);
        Ok((scene.ok_or("there is no such scene")?, render, options, fonts))
    }

    fn draw(&self, asked: [&str; 3]) -> Result<Shown, Vec<CliError>> {
        let (scene, render, options, fonts) = self.prepared(asked)?;
        let sources = source::read(std::slice::from_ref(&scene), render.frame, &render.draw.figure.level)?;
        let mut drawn = render.render_all(&sources, false, &options, Format::Svg, &fonts, self.terminal);
        let drawn = drawn.pop().ok_or_else(|| CliError::from("there is no such scene"))??;
        Ok((String::from_utf8_lossy(&drawn.bytes.concat()).into_owned(), drawn.summary))
    }

    /// Returns the outlines of a scene that is not valid, with its problems marked.
    fn outlines(&self, asked: [&str; 3]) -> Option<Shown> {
        let (scene, render, options, fonts) = self.prepared(asked).ok()?;
        let (_, picture) = render.sketch(&scene, &options, Format::Svg, &fonts).ok()?.ok()?;
        Some((String::from_utf8_lossy(&picture).into_owned(), "the outlines, with the problems marked".into()))
    }
}
