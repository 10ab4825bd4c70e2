//! Numbers that faults are made of.

/// Values at which arithmetic tends to fail.
pub const EDGES: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN_POSITIVE,
    -0.0,
    0.0,
    1e6,
    -1e6,
    0.005,
    0.01,
    167_772.16,
];
