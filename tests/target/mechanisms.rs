//! Chains of links in the emulator: the host's bits, and the instructions of a tick.

use std::fmt::Write;

use stillbeam::chain::ChainSetpoint;
use stillbeam_golden::{mechanisms, record};
use stillbeam_tests::emulator::{self, Clock, LIMIT};
use stillbeam_tests::firmware;

/// The host's own lines of bits.
#[derive(Default)]
struct Host(String);

impl mechanisms::Sink for Host {
    fn tick<const LINKS: usize>(
        &mut self,
        name: &'static str,
        tick: u32,
        make: impl FnOnce() -> ChainSetpoint<f32, LINKS>,
    ) {
        let setpoint = make();
        write!(self.0, "bits,{name},{tick}").expect("a string");
        for (joint, end) in setpoint.joints.iter().zip(setpoint.ends) {
            for word in record::bits(joint).into_iter().chain(end.map(f32::to_bits)) {
                write!(self.0, ",{word:08x}").expect("a string");
            }
        }
        writeln!(self.0).expect("a string");
    }

    fn frame(&mut self, joint: usize, payload: [u8; 8]) {
        let payload = u64::from_le_bytes(payload);
        writeln!(self.0, "frame,{joint},{payload:016x}").expect("a string");
    }
}

/// Most instructions of a tick, as measured, with 2 % of room for another compiler.
const MOST: [(&str, u32); 9] = [
    ("one-link", 1_910),
    ("one-link-fine", 3_070),
    ("two-links", 4_330),
    ("two-links-full", 4_930),
    ("three-links", 7_370),
    ("four-bar", 11_130),
    ("latch", 13_960),
    ("two-links-fine", 7_480),
    // The tick that begins the stop looks for its length.
    ("two-axes", 11_920),
];

#[test]
fn chains_give_the_hosts_bits_within_their_instructions() {
    let image = firmware::build("mechanisms").unwrap_or_else(|error| panic!("{error}"));
    let printed = emulator::run(&image, Clock::Instructions, LIMIT);
    let printed = printed.unwrap_or_else(|error| panic!("{error}"));
    let printed = String::from_utf8(printed).expect("lines");
    let mut host = Host::default();
    mechanisms::run(&mut host).expect("every chain is accepted");
    let bits: Vec<&str> = printed.lines().filter(|line| !line.starts_with("tick,")).collect();
    let frames = bits.iter().filter(|line| line.starts_with("frame,")).count();
    assert!(bits.len() > 800 && frames == 2 * 61, "{} lines, {frames} frames", bits.len());
    for (target, host) in bits.iter().zip(host.0.lines()) {
        assert_eq!(*target, host);
    }
    assert_eq!(bits.len(), host.0.lines().count());
    let counts: Vec<Vec<&str>> = printed
        .lines()
        .filter(|line| line.starts_with("tick,"))
        .map(|line| line.split(',').collect())
        .collect();
    println!("{counts:?}");
    assert_eq!(counts.len(), MOST.len());
    for (count, (name, most)) in counts.iter().zip(MOST) {
        let worst: u32 = count[3].parse().expect("a number");
        assert!(count[1] == name && worst <= most, "{count:?}: at most {most}");
    }
}
