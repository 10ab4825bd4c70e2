//! What must hold for every arm, move and method, by random search. One property a file.

mod arms;
mod energy;
mod factors;
mod first_angle;
mod linearity;
mod methods;
mod mirror;
mod precision;
mod reciprocity;
mod restart;
mod runs;
mod split;
mod superposition;
mod time_reversal;
mod units;
mod work;

use proptest::prelude::ProptestConfig;

/// So many random cases; `PROPTEST_CASES` makes it another number, and Miri one.
fn cases(cases: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|number| number.parse().ok());
    let cases = if cfg!(miri) { 1 } else { asked.unwrap_or(cases) };
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}
