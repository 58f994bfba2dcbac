//! The report page in a real Chromium.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::browser::{Browser, installed};
use super::{FALLS, Folder, HOSTILE, STANDS};

/// The open report page of three scenes.
fn opened(folder: &Folder) -> Option<Browser> {
    let name = installed()?;
    folder.done("report in -o r.html --margins");
    let mut browser = Browser::open(name);
    browser.view(1200, "light");
    browser.go(&folder.path("r.html"));
    Some(browser)
}

/// The visible names in the table of all scenes.
const NAMES: &str = "[...document.querySelectorAll('table.all tbody tr:not([hidden])')].map(r => r.cells[1].querySelector('a').textContent)";

fn click(browser: &mut Browser, what: &str) {
    browser.eval(&format!("document.querySelector({}).click()", json!(what)));
}

#[test]
fn the_page_sorts_filters_and_searches_without_errors() {
    let folder = Folder::three();
    let Some(mut browser) = opened(&folder) else {
        return;
    };
    let hostile: Value = serde_json::from_str(HOSTILE).expect("JSON");
    let hostile = hostile["title"].as_str().expect("text").replace('\u{202e}', "\u{fffd}");
    let (a, b, c) = ("A lintel", "Half a lintel", hostile.as_str());
    assert_eq!(browser.eval(NAMES), json!([a, b, c]));
    // Sorted by the number of blocks: three, two, one; then in the reverse order.
    let head = "table.all th:nth-child(5) button";
    click(&mut browser, head);
    assert_eq!(browser.eval(NAMES), json!([c, b, a]));
    click(&mut browser, head);
    assert_eq!(browser.eval(NAMES), json!([a, b, c]));
    let sorted = "document.querySelector('table.all th:nth-child(5)').getAttribute('aria-sort')";
    assert_eq!(browser.eval(sorted), "descending");
    let choose = |verdict: &str| {
        format!(
            "(s => {{ s.value = '{verdict}'; s.dispatchEvent(new Event('change')) }})(document.querySelector('.controls select'))"
        )
    };
    browser.eval(&choose("falls"));
    assert_eq!(browser.eval(NAMES), json!([b]));
    browser.eval(&choose("any"));
    browser.eval(
        "(s => { s.value = 'half'; s.dispatchEvent(new Event('input')) })(document.querySelector('.controls input'))",
    );
    assert_eq!(browser.eval(NAMES), json!([b]));
    let title = "document.querySelector('#scene-3 h2').textContent";
    assert_eq!(browser.eval(title), c, "shown as text");
    assert_eq!(browser.eval("document.querySelectorAll('img').length"), 0);
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn the_page_marks_related_parts_and_enlarges_figures() {
    let folder = Folder::three();
    let Some(mut browser) = opened(&folder) else {
        return;
    };
    // If the mouse moves to the middle of an interface in the figure, its row in the table is marked.
    let row = browser.eval("document.querySelector('#scene-1 tr[data-mark]').dataset.mark");
    let row = row.as_str().expect("a joint of the collapse");
    browser.eval(&format!("document.querySelector('#scene-1 g.touch[data-mark={row}]').scrollIntoView()"));
    let place = format!(
        "(r => [r.x + r.width / 2, r.y + r.height / 2])(document.querySelector('#scene-1 g.touch[data-mark={row}] path').getBoundingClientRect())"
    );
    let at = browser.eval(&place);
    let mouse = json!({ "type": "mouseMoved", "x": at[0], "y": at[1] });
    browser.call("Input.dispatchMouseEvent", mouse);
    let on = "[...document.querySelectorAll('#scene-1 .on')].map(e => e.tagName + ' ' + (e.dataset.mark))";
    let marked = json!([format!("g {row}"), format!("g {row}"), format!("TR {row}")]);
    assert_eq!(browser.eval(on), marked);
    let readout = browser.eval("document.querySelector('#scene-1 .readout').textContent");
    let readout = readout.as_str().expect("words");
    assert!(readout.contains("normal force") && readout.contains(" N"), "{readout}");
    // If a row of the table gets the keyboard focus, its interface in the figure is marked.
    browser.eval(&format!("document.querySelector('#scene-1 tr[data-mark={row}]').focus()"));
    assert_eq!(browser.eval(on), marked);
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn without_scripts_the_page_is_complete() {
    let folder = Folder::three();
    let Some(mut browser) = opened(&folder) else {
        return;
    };
    browser.call("Emulation.setScriptExecutionDisabled", json!({ "value": true }));
    browser.go(&folder.path("r.html"));
    assert_eq!(browser.count("table.all tbody tr"), 3);
    assert_eq!(browser.count("noscript section.step"), 6, "the figures are in noscript elements");
    // Each figure is drawn for light and for dark pages.
    let figures = browser.count("noscript figure.plate");
    assert!(figures >= 4, "{figures}");
    assert_eq!(browser.count("noscript figure.plate .paper > svg"), 2 * figures);
    assert_eq!(browser.count(".controls"), 0);
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn the_page_prints_every_step_and_fits_a_phone() {
    let folder = Folder::three();
    let Some(mut browser) = opened(&folder) else {
        return;
    };
    for width in [360, 768] {
        browser.view(width, "dark");
        let wide = browser.eval("document.documentElement.scrollWidth");
        assert!(wide.as_u64().is_some_and(|w| w <= u64::from(width)), "{wide} of {width}");
    }
    browser.view(1200, "light");
    let print = json!({ "preferCSSPageSize": true, "printBackground": true });
    let pdf = browser.call("Page.printToPDF", print);
    assert!(pdf["data"].as_str().is_some_and(|data| data.starts_with("JVBERi")), "a PDF");
    browser.call("Emulation.setEmulatedMedia", json!({ "media": "print" }));
    let steps = "[...document.querySelectorAll('.step')].map(s => getComputedStyle(s).display)";
    assert_eq!(browser.eval(steps), json!(vec!["block"; 6]));
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn axe_finds_no_violation_in_light_dark_and_on_a_phone() {
    let folder = Folder::three();
    let Some(mut browser) = opened(&folder) else {
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/axe/package/axe.min.js");
    let Ok(script) = fs::read_to_string(&script) else {
        let words = "axe-core is not below target/axe: the test of accessibility is skipped; .ci/run fetches it";
        assert!(std::env::var_os("CI").is_none(), "{words}");
        let _ = std::io::Write::write_all(&mut std::io::stderr(), format!("{words}\n").as_bytes());
        return;
    };
    browser.call("Page.setBypassCSP", json!({ "enabled": true }));
    for (width, scheme) in [(1200, "light"), (1200, "dark"), (380, "light"), (380, "dark")] {
        browser.view(width, scheme);
        browser.go(&folder.path("r.html"));
        browser.eval(&format!("{script}; 0"));
        let found = browser.eval(
            "axe.run(document).then(r => r.violations
               .map(v => v.id + ': ' + v.nodes.slice(0, 3).map(n => n.html.slice(0, 200) + ' ' + n.failureSummary).join(' | ')))",
        );
        assert_eq!(found, json!([]), "{width} {scheme}");
    }
}

/// Opening a page of very many scenes and scrolling to its end takes less than a minute.
#[test]
fn a_thousand_scenes_open_and_scroll() {
    let Some(name) = installed() else { return };
    let folder = Folder::new(&[]);
    fs::create_dir(folder.path("in")).expect("writable");
    for number in 0..1000 {
        let text = if number % 3 == 0 { FALLS } else { STANDS };
        let text = text.replace("intel\"", &format!("intel {number}\""));
        fs::write(folder.path(&format!("in/{number:04}.json")), text).expect("writable");
    }
    folder.done("report in -o r.html");
    let size = fs::metadata(folder.path("r.html")).expect("there").len();
    assert!(size < 80_000_000, "{size} bytes");
    let mut browser = Browser::open(name);
    browser.view(1200, "light");
    let start = std::time::Instant::now();
    browser.go(&folder.path("r.html"));
    assert_eq!(browser.eval("document.querySelectorAll('table.all tbody tr').length"), 1000);
    browser.eval("scrollTo(0, document.body.scrollHeight); document.body.getBoundingClientRect().height");
    browser.eval("location.hash = '#scene-701'; new Promise(r => setTimeout(r, 50))");
    let figures = browser.eval("document.querySelectorAll('#scene-701 .plate svg').length");
    assert!(figures.as_u64().is_some_and(|n| n > 0), "{figures}");
    let elements = browser.eval("document.querySelectorAll('*').length");
    assert!(elements.as_u64().is_some_and(|n| n < 60_000), "{elements} elements");
    let seconds = start.elapsed().as_secs_f64();
    let _ = std::io::Write::write_all(
        &mut std::io::stderr(),
        format!("1000 scenes: {size} bytes, open and scrolled in {seconds:.1} s\n").as_bytes(),
    );
    assert_eq!(browser.complaints(), Vec::<String>::new());
}
