//! The page in use: keys, link, themes, a phone, refusals.

use serde_json::json;
use stillbeam_tests::browser::Browser;

use super::open;

fn settings(browser: &mut Browser) -> serde_json::Value {
    browser.value("playground.settings")
}

#[test]
fn keys_play_step_and_move_sliders() {
    let mut browser = Browser::start();
    open(&mut browser, "");
    let playing = |browser: &mut Browser| browser.value("playground.player.playing");
    assert_eq!(playing(&mut browser), true, "it moves when it is opened");
    browser.press(" ", 32);
    assert_eq!(playing(&mut browser), false);
    browser.press("Home", 36);
    browser.press("ArrowRight", 39);
    browser.press("ArrowRight", 39);
    assert_eq!(browser.text("document.querySelector('#clock').textContent"), "0.02 s");
    // Every control is reached by the tabulator, and the first is the theme.
    let order =
        ["theme", "play", "speed", "time", "set-material", "set-length-number", "set-length"];
    for id in order {
        browser.press("Tab", 9);
        assert_eq!(browser.text("document.activeElement.id"), id);
    }
    let outline = browser.text("getComputedStyle(document.activeElement).outlineStyle");
    assert_eq!(outline, "solid", "the focus shows");
    browser.press("ArrowRight", 39);
    assert_eq!(settings(&mut browser)["length"], 510);
    let unnamed = browser.value(
        "[...document.querySelectorAll('input, select, button, canvas, svg[role]')].filter((e) => \
         !(e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim())).length",
    );
    assert_eq!(unnamed, 0, "every control and picture has a name");
    assert_eq!(browser.trouble(), [""; 0]);
}

#[test]
fn the_link_restores_the_arm() {
    let mut browser = Browser::start();
    open(&mut browser, "length=330&material=titanium&robust=0.1&duration=0.77&error=-3");
    let before = settings(&mut browser);
    assert_eq!(before["material"], "titanium");
    browser.wait("location.hash.includes('shaper=zv')");
    let link = browser.text("location.hash.slice(1)");
    let runs = "JSON.stringify(playground.runs)";
    let numbers = browser.text(runs);
    open(&mut browser, &link);
    assert_eq!(settings(&mut browser), before);
    assert_eq!(browser.text(runs), numbers);
    // What is out of range or no number at all is mended, not believed.
    open(&mut browser, "length=9e9&thickness=x&material=unobtainium&duration=-1&shaper=");
    let mended = settings(&mut browser);
    assert_eq!(mended["length"], 1000);
    assert_eq!(mended["thickness"], 2);
    assert_eq!(mended["material"], "aluminium");
    assert_eq!(mended["duration"], 0.1);
    assert_eq!(browser.trouble(), [""; 0]);
}

#[test]
fn a_refusal_says_what_would_do() {
    let mut browser = Browser::start();
    open(&mut browser, "duration=0.2&angle=180");
    for (kind, words) in [(1, "must be at least"), (2, "must be at least")] {
        let said = browser.text(&format!("playground.runs[{kind}].refusal"));
        assert!(said.contains(words), "{said}");
    }
    open(&mut browser, "length=1000&thickness=0.5&material=pla&payload=500&width=5");
    let said = browser.text("playground.facts.refusal ?? ''");
    assert!(said.contains("first period") && said.contains("must be"), "{said}");
    assert_eq!(browser.trouble(), [""; 0]);
}

#[test]
fn it_fits_a_phone_and_either_theme() {
    let mut browser = Browser::start();
    for (width, theme) in [(390, "dark"), (390, "light"), (1280, "dark")] {
        let screen =
            json!({ "width": width, "height": 844, "deviceScaleFactor": 1, "mobile": width < 600 });
        browser.call("Emulation.setDeviceMetricsOverride", screen);
        let scheme = json!({ "features": [{ "name": "prefers-color-scheme", "value": theme }] });
        browser.call("Emulation.setEmulatedMedia", scheme);
        open(&mut browser, "");
        let theme_of = "document.documentElement.dataset.theme";
        assert_eq!(browser.text(theme_of), theme);
        let page = "document.documentElement";
        let overflow = browser.value(&format!("{page}.scrollWidth > {page}.clientWidth"));
        assert_eq!(overflow, false, "{width} px: nothing is cut at the right");
        // The arms are drawn: pixels of their colour are there.
        let drawn = browser.value(
            "[...document.querySelectorAll('.arm canvas')].every((canvas) => { const { data } = \
             canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height); \
             return data.some((value, k) => k % 4 === 3 && value > 200); })",
        );
        assert_eq!(drawn, true, "{width} px, {theme}");
        let lines = browser.value("document.querySelectorAll('#torque .curve').length");
        assert_eq!(lines, 3);
        browser.value("document.querySelector('#theme').click()");
        assert_ne!(browser.text(theme_of), theme, "the switch goes before the system");
        browser.value("localStorage.clear()");
    }
    assert_eq!(browser.trouble(), [""; 0]);
}
