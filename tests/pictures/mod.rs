//! The pages that move, in a browser.

use std::path::Path;

use serde_json::json;
use stillbeam::Limits;
use stillbeam_sim::plan::{Options, Request, page};
use stillbeam_sim::scenes;
use stillbeam_tests::browser::Browser;

/// True once the script has taken the picture over.
const READY: &str = "document.querySelector('figure.moving.steered')";

/// Playing time of the first picture, s.
const TIME: &str = "document.querySelector('.stage svg').getCurrentTime()";

/// Writes the page of a plan.
fn plan(folder: &Path) -> String {
    let arm = scenes::open("b-tip30").expect("a scene").arm;
    let (limits, options, tick) = (Limits::default(), Options::default(), 0.01);
    let (from, to, duration, robust) = (0.0, 1.2, Some(1.0), None);
    let request = Request { arm, from, to, duration, limits, robust, options, tick };
    let planned = request.carry_out(&|| ()).expect("a plan");
    let path = page::write(folder, "b-tip30", &request, &planned).expect("a page");
    format!("file://{}", path.display())
}

/// Returns true if the playing time goes on.
fn plays(browser: &mut Browser) -> bool {
    let time = |browser: &mut Browser| browser.value(TIME).as_f64().expect("a time");
    let before = time(browser);
    // Two frames: what plays has moved by then.
    browser.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))");
    time(browser) > before
}

/// A button and a slider steer both arms by keyboard, and the page fits a phone.
#[test]
fn a_plan_plays_and_stops_by_keyboard() {
    let folder = tempfile::tempdir().expect("a folder");
    let url = plan(folder.path());
    let mut browser = Browser::start();
    let phone = json!({ "width": 390, "height": 800, "deviceScaleFactor": 1, "mobile": true });
    browser.call("Emulation.setDeviceMetricsOverride", phone);
    browser.open(&url, READY);
    assert!(plays(&mut browser));
    let wide = browser.value("document.documentElement.scrollWidth");
    assert_eq!(wide, 390, "the page is wider than the phone");

    browser.press("Tab", 9);
    assert_eq!(browser.text("document.activeElement.textContent"), "Pause");
    browser.press(" ", 32);
    assert_eq!(browser.text("document.activeElement.textContent"), "Play");
    assert!(!plays(&mut browser));

    browser.press("Tab", 9);
    browser.press("Home", 36);
    browser.press("ArrowRight", 39);
    let times = "[...document.querySelectorAll('.stage svg')].map(svg => svg.getCurrentTime())";
    let times = browser.value(times);
    let times: Vec<f64> =
        times.as_array().expect("times").iter().filter_map(|time| time.as_f64()).collect();
    let length = browser.text("document.querySelector('figure.moving').dataset.seconds");
    let step = length.parse::<f64>().expect("s") / 200.0;
    assert_eq!(times.len(), 2);
    assert!(times.iter().all(|time| (time - step).abs() < 1e-3), "{times:?}, a step is {step}");
    assert_eq!(browser.trouble(), [""; 0]);
}

/// Who prefers reduced motion sees poses, and the arm at rest until it is told to play.
#[test]
fn reduced_motion_begins_at_rest() {
    let folder = tempfile::tempdir().expect("a folder");
    let url = plan(folder.path());
    let mut browser = Browser::start();
    let reduced = json!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] });
    browser.call("Emulation.setEmulatedMedia", reduced);
    browser.open(&url, READY);
    assert!(!plays(&mut browser));
    browser.value("document.querySelector('figure.moving button').click()");
    assert!(plays(&mut browser));
    // The file has no script.
    let file = url.replace("index.html", "moving.svg");
    browser.open(&file, "document.readyState === 'complete'");
    let shown = "getComputedStyle(document.querySelector('.moving-live')).display";
    assert_eq!(browser.text(shown), "none");
    let pose = "getComputedStyle(document.querySelector('.moving-pose')).display";
    assert_eq!(browser.text(pose), "inline");
    assert_eq!(browser.trouble(), [""; 0]);
}
