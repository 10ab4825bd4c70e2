//! Sine and cosine: the core's polynomials against micromath and libm.

use core::f32::consts::TAU;
use core::fmt::Write;
use core::hint::black_box;

use micromath::F32Ext;
use stillbeam::Scalar;

use crate::stopwatch::{Counter, Stopwatch};

/// Angles over `−½ ..= ½` turn, where the hub's angle lies.
const POINTS: i32 = 256;

/// Prints a line a function: both sine and cosine of an angle in turns.
pub fn print<C: Counter>(watch: &Stopwatch<C>, output: &mut impl Write) {
    compare(watch, output, "stillbeam", own);
    compare(watch, output, "micromath", fast);
    compare(watch, output, "libm", libm);
}

#[inline(never)]
fn own(turns: f32) -> (f32, f32) {
    turns.sin_cos_turns()
}

#[inline(never)]
fn fast(turns: f32) -> (f32, f32) {
    let x = TAU * turns;
    (F32Ext::sin(x), F32Ext::cos(x))
}

#[inline(never)]
fn libm(turns: f32) -> (f32, f32) {
    libm::sincosf(TAU * turns)
}

fn compare<C: Counter>(
    watch: &Stopwatch<C>,
    output: &mut impl Write,
    name: &str,
    function: fn(f32) -> (f32, f32),
) {
    let (mut least, mut worst, mut error) = (u32::MAX, 0, 0.0);
    for i in -POINTS / 2..=POINTS / 2 {
        let turns = i as f32 / POINTS as f32;
        let ((sin, cos), count) = watch.count(|| function(black_box(turns)));
        (least, worst) = (count.min(least), count.max(worst));
        let (s, c) = libm::sincos(core::f64::consts::TAU * f64::from(turns));
        for off in [f64::from(sin) - s, f64::from(cos) - c] {
            error = libm::fmax(error, libm::fabs(off));
        }
    }
    writeln!(output, "function,{name},{least},{worst},{error:.1e}")
        .expect("the host takes the lines");
}
