//! Compares the stream of setpoints from the target with the same run on the host, bit by bit.

use std::fmt;

use stillbeam::{Error, Setpoint};
use stillbeam_golden::record::{self, BYTES, FIELDS};
use stillbeam_golden::{Case, run, run_few};

/// First difference between host and target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// A field differs.
    Field {
        /// `scene, method`.
        case: String,
        /// Tick, from 0.
        tick: u32,
        /// The field's name.
        field: &'static str,
        /// Bits on the host.
        host: u32,
        /// Bits on the target.
        target: u32,
    },
    /// The record belongs to another case or tick.
    OutOfStep {
        /// `scene, method`.
        case: String,
        /// Tick, from 0.
        tick: u32,
    },
    /// The streams have different lengths.
    Length {
        /// Length of the host's stream, bytes.
        host: usize,
        /// Length of the target's stream, bytes.
        target: usize,
    },
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Field { case, tick, field, host, target } => write!(
                f,
                "{case}, tick {tick}, {field}: host {host:#010x} ({}), target {target:#010x} ({})",
                f32::from_bits(*host),
                f32::from_bits(*target)
            ),
            Self::OutOfStep { case, tick } => {
                write!(f, "{case}, tick {tick}: the target's record is of another case or tick")
            }
            Self::Length { host, target } => {
                write!(f, "the host has {host} bytes of setpoints, the target sent {target}")
            }
        }
    }
}

/// Takes the setpoints of a run.
pub type Sink<'a> = dyn FnMut(&Case, u32, &Setpoint<f32>) + 'a;

/// The run of the host that a target's is compared with.
pub type Run = fn(&mut Sink<'_>) -> Result<u32, Error>;

/// The run of every method. With one kind of sink for all: each method is then compiled once.
///
/// # Errors
/// Errors are those of [`run()`].
pub fn every_method(sink: &mut Sink<'_>) -> Result<u32, Error> {
    run(sink)
}

/// The run of a processor that computes in software.
///
/// # Errors
/// Errors are those of [`run()`].
pub fn few_methods(sink: &mut Sink<'_>) -> Result<u32, Error> {
    run_few(sink)
}

/// Amount that was compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Agreement {
    /// Number of scenes with a method each.
    pub cases: u32,
    /// Number of setpoints in all of them.
    pub setpoints: usize,
}

/// Steps every case on the host and compares it with the target's stream. The sign of a NaN, which
/// differs between processors, is left out. Every other bit of every field counts.
///
/// # Errors
/// An error is returned with the first difference.
pub fn compare(target: &[u8], run: Run) -> Result<Agreement, Mismatch> {
    let mut records = target.chunks_exact(BYTES);
    let mut setpoints = 0;
    let mut mismatch = None;
    let cases = run(&mut |case, tick, setpoint| {
        setpoints += 1;
        let Some(record) = records.next() else { return };
        if mismatch.is_some() {
            return;
        }
        let words: Vec<u32> = record
            .chunks_exact(4)
            .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
            .collect();
        if words[0] != record::stamp(case.index, tick) {
            mismatch = Some(Mismatch::OutOfStep { case: name(case), tick });
            return;
        }
        let host = record::bits(setpoint);
        mismatch = (0..FIELDS.len()).find(|&i| !same(FIELDS[i], host[i], words[i + 1])).map(|i| {
            let (field, host, target) = (FIELDS[i], host[i], words[i + 1]);
            Mismatch::Field { case: name(case), tick, field, host, target }
        });
    })
    .expect("every embedded scene is accepted");
    match mismatch {
        Some(mismatch) => Err(mismatch),
        None if target.len() != setpoints * BYTES => {
            Err(Mismatch::Length { host: setpoints * BYTES, target: target.len() })
        }
        None => Ok(Agreement { cases, setpoints }),
    }
}

fn same(field: &str, a: u32, b: u32) -> bool {
    // The turns are a whole number, which has no NaN.
    let nan = |bits: u32| field != "angle.turns" && f32::from_bits(bits).is_nan();
    let unsigned = |bits: u32| if nan(bits) { bits & 0x7fff_ffff } else { bits };
    unsigned(a) == unsigned(b)
}

fn name(case: &Case) -> String {
    let Case { scene, method, size, quality, skip, .. } = case;
    let words = [method.to_string(), size.to_string(), quality.to_string(), skip.to_string()];
    let words: Vec<_> = words.into_iter().filter(|word| !word.is_empty()).collect();
    format!("{scene}, {}", words.join(" "))
}
