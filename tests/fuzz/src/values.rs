//! Numbers out of bytes.

use arbitrary::{Arbitrary, Result, Unstructured};
use stillbeam::Angle;
use stillbeam::motor::Demand;
use stillbeam_board::EDGES;

/// Any bits, a whole multiple of 1/64 up to ±512 turns' worth, or a value that numbers go wrong at.
pub fn double(u: &mut Unstructured<'_>) -> Result<f64> {
    Ok(match u.int_in_range(0..=3)? {
        0 => f64::arbitrary(u)?,
        1 => *u.choose(&EDGES)?,
        _ => f64::from(i16::arbitrary(u)?) / 64.0,
    })
}

/// Any demand on a shaft whose angle is one, finite or not.
pub fn demand(u: &mut Unstructured<'_>) -> Result<Demand<f32>> {
    // An angle's part is within half a turn, by its type.
    let part = f32::from(i16::arbitrary(u)?) / 65_536.0;
    let turns = match u.int_in_range(0..=2)? {
        0 => i32::arbitrary(u)?,
        _ => i16::arbitrary(u)?.into(),
    };
    let [velocity, torque] = [double(u)? as f32, double(u)? as f32];
    Ok(Demand { position: Angle { turns, part }, velocity, torque })
}

/// `|a − b| ≤ bound`, which no NaN is.
pub fn close(a: f64, b: f64, bound: f64) -> bool {
    (a - b).abs() <= bound
}
