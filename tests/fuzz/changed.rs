//! Kept inputs after random edits, through their bodies, on the stable toolchain: the bounded part
//! of fuzzing, which needs no build of its own. Unlike libFuzzer it does not see which branches an
//! input reaches.

use std::fs;
use std::path::Path;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{Config, TestRunner};
use stillbeam_fuzz::{BODIES, Body};

use crate::replay::inputs;

/// Edits of an input, at most.
const EDITS: usize = 8;

/// Length that an edited input is cut to: far above that of any kept one.
const LENGTH: usize = 4096;

/// One edit. A place is a share of the input's length.
#[derive(Clone, Debug)]
enum Edit {
    Flip(Index, u8),
    Set(Index, u8),
    Insert(Index, Vec<u8>),
    Remove(Index, u8),
    /// A part of another kept input.
    Splice(Index, Index, Index, u8),
    Word(Index, Index),
}

fn edit() -> impl Strategy<Value = Edit> {
    let place = any::<Index>;
    prop_oneof![
        (place(), 0..8_u8).prop_map(|(at, bit)| Edit::Flip(at, bit)),
        (place(), any::<u8>()).prop_map(|(at, byte)| Edit::Set(at, byte)),
        (place(), vec(any::<u8>(), 1..40)).prop_map(|(at, bytes)| Edit::Insert(at, bytes)),
        (place(), 1..40_u8).prop_map(|(at, count)| Edit::Remove(at, count)),
        (place(), place(), place(), 1..80_u8)
            .prop_map(|(at, other, from, count)| Edit::Splice(at, other, from, count)),
        (place(), place()).prop_map(|(at, word)| Edit::Word(at, word)),
    ]
}

/// Kept inputs of a target, and words for edits.
struct Kept {
    inputs: Vec<Vec<u8>>,
    words: Vec<Vec<u8>>,
}

impl Kept {
    fn of(name: &str) -> Self {
        let inputs = inputs(name).iter().map(|path| fs::read(path).expect("an input")).collect();
        Self { inputs, words: words(name) }
    }

    fn apply(&self, edit: &Edit, bytes: &mut Vec<u8>) {
        let length = bytes.len();
        let place = |at: &Index| at.index(length + 1);
        match edit {
            Edit::Flip(at, bit) if length > 0 => bytes[at.index(length)] ^= 1 << bit,
            Edit::Set(at, byte) if length > 0 => bytes[at.index(length)] = *byte,
            Edit::Flip(..) | Edit::Set(..) => (),
            Edit::Insert(at, new) => insert(bytes, place(at), new),
            Edit::Remove(at, count) => {
                let begin = place(at);
                bytes.drain(begin..length.min(begin + usize::from(*count)));
            }
            Edit::Splice(at, other, from, count) => {
                let other = other.get(&self.inputs);
                let begin = from.index(other.len() + 1);
                let end = other.len().min(begin + usize::from(*count));
                insert(bytes, place(at), &other[begin..end]);
            }
            Edit::Word(at, _) if self.words.is_empty() => insert(bytes, place(at), &[0; 4]),
            Edit::Word(at, word) => insert(bytes, place(at), word.get::<Vec<u8>>(&self.words)),
        }
        bytes.truncate(LENGTH);
    }
}

fn insert(bytes: &mut Vec<u8>, at: usize, new: &[u8]) {
    bytes.splice(at..at, new.iter().copied());
}

/// The words of libFuzzer's dictionary, if the target has one.
fn words(name: &str) -> Vec<Vec<u8>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("{name}.dict"));
    let text = fs::read_to_string(path).unwrap_or_default();
    let words = text.lines().filter_map(|line| line.strip_prefix('"')?.strip_suffix('"'));
    words.map(|word| word.as_bytes().to_vec()).collect()
}

/// Asks for a number of cases of a body; `PROPTEST_CASES` makes it another.
fn comes_through(name: &str, body: Body, cases: u32) {
    let kept = Kept::of(name);
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|number| number.parse().ok());
    let cases = asked.unwrap_or(cases);
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let edited = (any::<Index>(), vec(edit(), 1..=EDITS));
    let run = TestRunner::new(config).run(&edited, |(begin, edits)| {
        let mut bytes = begin.get(&kept.inputs).clone();
        edits.iter().for_each(|edit| kept.apply(edit, &mut bytes));
        body(&bytes);
        Ok(())
    });
    run.unwrap_or_else(|error| panic!("{name}: {error}"));
}

/// Half a second or so each.
fn cases_of(name: &str) -> u32 {
    match name {
        "scene" => 700,
        "axis" => 1_000,
        _ => 6_000,
    }
}

#[test]
fn every_edited_input_comes_through() {
    for (name, body) in BODIES {
        comes_through(name, body, cases_of(name));
    }
}
