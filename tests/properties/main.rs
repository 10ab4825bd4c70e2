//! Properties of every arm, move and method, by random search. One property a file.

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

use proptest::test_runner::Config;

/// Asks for a number of random cases; `PROPTEST_CASES` makes it another.
fn cases(cases: u32) -> Config {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|number| number.parse().ok());
    let cases = asked.unwrap_or(cases);
    Config { cases, failure_persistence: None, ..Config::default() }
}
