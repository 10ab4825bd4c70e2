//! The application in QEMU, in lock-step with the host: every setpoint and every drive frame is
//! compared bit for bit. The board it is built for and has not run on.

mod axes;
mod conversation;
mod image;
mod in_the_loop;
mod payload;
mod planning;

/// Lines that hold counts of instructions or bytes, with every number as `#`. How long a plan
/// takes, by a tick or two, is such a count too, and all that is said after a plan is said that
/// much later.
fn without_counts(page: &str) -> Vec<String> {
    let mut planned = false;
    let mut kept = Vec::new();
    for line in page.lines() {
        planned = (planned || line == "<!-- lab:still -->") && line != "<!-- /lab -->";
        let reported = planned && line.contains(" | ");
        if planned || line.contains("instructions") || line.starts_with('|') {
            let parts = line.split(|c: char| c.is_ascii_digit() || planned && c == ' ');
            let parts: Vec<_> = parts.filter(|part| !part.is_empty()).collect();
            kept.extend((!reported).then(|| parts.join("#")));
        } else {
            kept.push(line.to_owned());
        }
    }
    kept
}
