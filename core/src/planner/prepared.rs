//! The planner as prepared words.

use super::Planner;
use crate::math::{Scalar, Words};
use crate::prepared::{Prepare, Prepared, sizes};

impl<T: Scalar, const K: usize> Prepare for Planner<T, K> {
    fn kind(&self) -> [u32; 3] {
        Self::KIND
    }

    fn period(&self) -> f64 {
        self.tick
    }

    fn put_own(&self, sink: &mut dyn FnMut(u32)) {
        self.put(sink);
    }
}

impl<T: Scalar, const K: usize> Prepared for Planner<T, K> {
    const KIND: [u32; 3] = [u32::from_le_bytes(*b"plan"), sizes::<T>(K, 0, false), Self::LAYOUT];
}
