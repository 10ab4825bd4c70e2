//! Values as 32-bit words, written and read back to the bit.

/// A value that is written as 32-bit words and read back to the bit: what a prepared arm is made
/// of.
pub trait Words: Sized {
    /// Hands the words of the value to `sink`, first to last.
    fn put(&self, sink: &mut dyn FnMut(u32));

    /// Reads a value from the words that `source` gives, first to last. Any words are a value.
    fn get(source: &mut dyn FnMut() -> u32) -> Self;
}

impl Words for u32 {
    fn put(&self, sink: &mut dyn FnMut(u32)) {
        sink(*self);
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        source()
    }
}

impl Words for bool {
    fn put(&self, sink: &mut dyn FnMut(u32)) {
        sink(u32::from(*self));
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        source() != 0
    }
}

impl Words for f32 {
    fn put(&self, sink: &mut dyn FnMut(u32)) {
        sink(self.to_bits());
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        Self::from_bits(source())
    }
}

/// The lower half first.
impl Words for f64 {
    fn put(&self, sink: &mut dyn FnMut(u32)) {
        let bits = self.to_bits();
        sink(bits as u32);
        sink((bits >> 32) as u32);
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        let low = u64::from(source());
        Self::from_bits(low | u64::from(source()) << 32)
    }
}

impl<T: Words, const N: usize> Words for [T; N] {
    fn put(&self, sink: &mut dyn FnMut(u32)) {
        for value in self {
            value.put(sink);
        }
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        core::array::from_fn(|_| T::get(source))
    }
}

impl<A: Words, B: Words> Words for (A, B) {
    fn put(&self, sink: &mut dyn FnMut(u32)) {
        self.0.put(sink);
        self.1.put(sink);
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        (A::get(source), B::get(source))
    }
}

/// A flag, and the value or as many zeros.
impl Words for Option<f64> {
    fn put(&self, sink: &mut dyn FnMut(u32)) {
        (self.is_some(), self.unwrap_or(0.0)).put(sink);
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        let (is_some, value) = Words::get(source);
        if is_some { Some(value) } else { None }
    }
}

/// Implements [`Words`] for a struct: its fields in the order in which they stand here, every one.
macro_rules! words {
    ($([$($generics:tt)*] $type:ty: $($field:ident),* $(,)?;)*) => {
        $(
            impl<$($generics)*> $crate::math::Words for $type {
                fn put(&self, sink: &mut dyn FnMut(u32)) {
                    // A field that is left out does not compile.
                    let Self { $($field),* } = self;
                    $($crate::math::Words::put($field, sink);)*
                }

                fn get(source: &mut dyn FnMut() -> u32) -> Self {
                    // In the order in which they are written.
                    Self { $($field: $crate::math::Words::get(source)),* }
                }
            }
        )*
    };
}

pub(crate) use words;

#[cfg(test)]
mod tests {
    use super::Words;

    #[test]
    fn every_bit_comes_back_in_its_place() {
        type Value = ([f32; 3], (f64, (bool, (u32, [Option<f64>; 2]))));
        let value: Value =
            ([0.1, -0.0, f32::NAN], (1e-300, (true, (0xdead_beef, [Some(-2.5), None]))));
        let mut words = [0; 13];
        let mut n = 0;
        value.put(&mut |word| {
            words[n] = word;
            n += 1;
        });
        assert_eq!(n, words.len());
        let mut all = words.iter().copied();
        let again = Value::get(&mut || all.next().expect("as many as were written"));
        assert_eq!(again.0.map(f32::to_bits), value.0.map(f32::to_bits));
        assert_eq!(again.1, value.1);
        assert_eq!(words[0], 0.1f32.to_bits());
    }
}
