//! The file `axes.rs`: another method or tick is one line in it, and its page says how many axes
//! fit.

use stillbeam::axis::Mode;
use stillbeam_lab::markers;
use stillbeam_sim::talk::DEMONSTRATION;
use stillbeam_tests::firmware_page::{self, FITTED, Fit};
use stillbeam_tests::{assert_near, firmware, root};

use super::without_counts;
use crate::session::{begin, begin_with, run, status, take};

/// Most instructions of an axis' tick as the application is built.
const TICK: u32 = 1_500;

/// The method stands in `axes.rs` and nowhere else: the build prepares the arms for it, and the
/// host runs whichever the firmware names.
#[test]
fn another_method_is_one_line_in_axes() {
    let change = ["stillbeam_methods::Elastica2", "stillbeam_methods::Newmark1Nodal"];
    let image = firmware::changed_application("mps2", "Newmark1Nodal", change)
        .unwrap_or_else(|error| panic!("{error}"));
    let mut session = begin_with(&image);
    let lines = run(&mut session, &DEMONSTRATION);
    let [setpoints, frames] = session.compared();
    assert!(setpoints > 800 && frames > 800, "{setpoints}, {frames}, {lines:#?}");
    assert!(lines.iter().any(|line| line.contains("stopped")), "{lines:#?}");
    let payload = lines.iter().find(|line| line.starts_with("payload 1 0.08"));
    assert!(payload.is_some_and(|line| line.contains("accepted")), "{lines:#?}");
    let status = status(&mut session);
    assert_eq!([status.missed, status.early, status.overruns], [0; 3], "{status:?}");
}

/// The tick stands in `axes.rs` and nowhere else: at another one a missed tick is found, and half a
/// second of silence is half a second. In 2 ms the emulated board does not get its first setpoints
/// out.
#[test]
fn another_tick_is_one_line_in_axes() {
    let tick = 0.005;
    let change = ["TICK: f64 = 0.010", "TICK: f64 = 0.005"];
    let image = firmware::changed_application("mps2", "5ms", change)
        .unwrap_or_else(|error| panic!("{error}"));
    let mut session = begin_with(&image);
    assert_near("tick", session.tick(), tick, 0.0);
    take(&mut session, "enable 0");
    take(&mut session, "move 0 quintic 1.7 1.57");
    take(&mut session, "wait 0.3");
    take(&mut session, "stall 0.012");
    assert_eq!(status(&mut session).missed, 1);
    take(&mut session, "rest");
    let heard = session.now();
    take(&mut session, "silence 0.6");
    let lost =
        session.history(0).iter().find(|tick| tick.mode != Mode::Enabled && tick.number > heard);
    let silent = lost.expect("the link is lost").number - heard;
    assert!((80..=120).contains(&silent), "{silent} ticks of 5 ms, 0.5 s after the last heartbeat");
}

/// The table of axes holds every method, its arithmetic is right, and a method of each end is
/// counted again: to 2 %, as the instruction table is.
#[test]
fn as_many_axes_fit_as_the_page_says() {
    let page = std::fs::read_to_string(root().join("docs/firmware.md")).expect("docs/firmware.md");
    let table = markers::block(&page, "axes").expect("the table of axes");
    let rows: Vec<&str> = table.lines().skip(2).take_while(|line| line.starts_with('|')).collect();
    assert_eq!(rows.len(), FITTED.len(), "{rows:#?}");
    for ((name, id), row) in FITTED.into_iter().zip(rows) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let count = |i: usize| cells[i].parse().unwrap_or_else(|_| panic!("{row}"));
        let written = Fit { moving: count(2), worst: count(3) };
        assert_eq!(row.to_owned() + "\n", firmware_page::row(name, &written));
        if ["RigidArm", "Elastica2"].contains(&id) {
            let counted = firmware_page::fit(id).unwrap_or_else(|error| panic!("{error}"));
            for (was, is) in [(written.moving, counted.moving), (written.worst, counted.worst)] {
                assert!(was.abs_diff(is) * 50 <= was, "{name}: {counted:?}, write the page anew");
            }
        }
    }
}

/// The count for the table of axes is the cost of the application's tick, to 8 %: the application's
/// also watches the heartbeats of its drives. And that is no more than an axis was promised.
#[test]
fn the_image_that_counts_axes_stands_for_the_application() {
    let fit = firmware_page::fit("Elastica2").unwrap_or_else(|error| panic!("{error}"));
    let mut session = begin("mps2");
    for step in ["enable 0", "enable 1", "move 0 s-curve 1.2 1.5", "move 1 s-curve 1.2 1.5", "rest"]
    {
        let said = take(&mut session, step);
        assert!(!said.contains("refused"), "{step}: {said}");
    }
    let own = status(&mut session).worst;
    println!("application {own}, {fit:?}");
    assert!(own.abs_diff(fit.moving) * 12 <= own, "application {own}, {fit:?}");
    assert!(own <= 2 * TICK, "{own} instructions of two axes");
}

/// A tick costs what it costs at `opt-level = 3`, to 20 %, though all around it is compiled for
/// size, which makes it four times as dear otherwise: its arithmetic is a concrete function in a
/// crate that the profile compiles for speed. What is around it is the same for every method, and
/// cancels.
#[test]
fn a_tick_costs_what_it_costs_at_the_highest_level() {
    let table = std::fs::read_to_string(root().join("docs/instructions.csv")).expect("the table");
    let worst = |row: &str| {
        let row = table.lines().find_map(|line| line.strip_prefix(row)).expect("a row");
        let counts = row.split(',').filter_map(|cell| cell.parse::<u32>().ok());
        counts.max().expect("counts")
    };
    let fast = worst("elastica,2,fast,,") - worst("rigid,0,,,");
    let [elastica, rigid] = ["Elastica2", "RigidArm"].map(|id| {
        let fit = firmware_page::fit(id).unwrap_or_else(|error| panic!("{error}"));
        fit.moving / 2
    });
    println!("{elastica} - {rigid} in the application's profile, {fast} in the table");
    assert!((elastica - rigid) * 10 <= fast * 12, "{elastica} - {rigid}, {fast}");
}

/// The page says what happens. Instruction counts and sizes may be off by what a change of the code
/// makes until the page is written anew; everything else is as it stands there.
#[test]
fn the_pages_are_what_the_firmware_does() {
    // The table of axes has a test of its own.
    let blocks = firmware_page::blocks().unwrap_or_else(|error| panic!("{error}"));
    let page = std::fs::read_to_string(root().join("docs/firmware.md")).expect("docs/firmware.md");
    let written = firmware_page::replace(&page, &blocks).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(without_counts(&page), without_counts(&written), "write the page anew");
    for block in blocks {
        assert!(markers::has(&page, &block.name), "{} has no place", block.name);
    }
}
