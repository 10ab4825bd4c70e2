//! Names of fields in lists, as errors tell them.

/// The names `list[0].field`, `list[1].field`, … of a field of every link or joint.
macro_rules! indexed {
    ($list:literal, $field:literal) => {
        [
            concat!($list, "[0].", $field),
            concat!($list, "[1].", $field),
            concat!($list, "[2].", $field),
            concat!($list, "[3].", $field),
            concat!($list, "[4].", $field),
            concat!($list, "[5].", $field),
            concat!($list, "[6].", $field),
            concat!($list, "[7].", $field),
        ]
    };
}

pub(super) use indexed;
