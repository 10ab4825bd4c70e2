//! A setpoint as it crosses from target to host: ten little-endian words.

use stillbeam::Setpoint;

/// Bytes of a record.
pub const BYTES: usize = 4 * (1 + FIELDS.len());

/// The fields of a setpoint in their order, by the names in its type, and what it computes on
/// demand.
pub const FIELDS: [&str; 9] = [
    "angle.turns",
    "angle.part",
    "rate",
    "acceleration",
    "torque",
    "tip[0]",
    "tip[1]",
    "global_tip[0]",
    "global_tip[1]",
];

/// The bits of each field, in the order of [`FIELDS`].
pub fn bits(setpoint: &Setpoint<f32>) -> [u32; FIELDS.len()] {
    // Taken apart by name, so that a new field does not compile until it is compared.
    let Setpoint { angle, rate, acceleration, torque, tip: [hub_x, hub_y] } = *setpoint;
    let [x, y] = setpoint.global_tip();
    [
        angle.turns as u32,
        angle.part.to_bits(),
        rate.to_bits(),
        acceleration.to_bits(),
        torque.to_bits(),
        hub_x.to_bits(),
        hub_y.to_bits(),
        x.to_bits(),
        y.to_bits(),
    ]
}

/// First word of a record: which case and tick it belongs to. Up to 65,535 of each.
pub fn stamp(case: u32, tick: u32) -> u32 {
    (case << 16) | (tick & 0xffff)
}

/// The record.
pub fn encode(stamp: u32, setpoint: &Setpoint<f32>) -> [u8; BYTES] {
    let mut bytes = [0; BYTES];
    let words = core::iter::once(stamp).chain(bits(setpoint));
    for (slot, word) in bytes.chunks_exact_mut(4).zip(words) {
        slot.copy_from_slice(&word.to_le_bytes());
    }
    bytes
}
