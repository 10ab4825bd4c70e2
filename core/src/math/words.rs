//! Values as 32-bit words, written and read back to the bit.

/// A value that is written as 32-bit words and read back to the bit: what a prepared arm is made
/// of.
pub trait Words: Sized {
    /// Hash of the type's layout: names and types of all fields in their order. Words of another
    /// layout are those of another version of the program.
    const LAYOUT: u32;

    /// A value to be read into.
    const BLANK: Self;

    /// Hands the words of the value to `sink`, first to last.
    fn put(&self, sink: &mut dyn FnMut(u32));

    /// Reads the value from the words that `source` gives, first to last. Any words are a value.
    // In place: values that are returned are copied by every level of what holds them.
    fn fill(&mut self, source: &mut dyn FnMut() -> u32);
}

/// Returns a small value from the words that `source` gives, first to last. A large one is better
/// filled where it is kept.
#[inline(always)]
pub(crate) fn read<T: Words>(source: &mut dyn FnMut() -> u32) -> T {
    let mut value = T::BLANK;
    value.fill(source);
    value
}

/// Mixes a word into a hash (FNV-1a, by words).
pub(crate) const fn mix(hash: u32, word: u32) -> u32 {
    (hash ^ word).wrapping_mul(0x0100_0193)
}

/// Hash of a name.
pub(crate) const fn named(name: &str) -> u32 {
    let (bytes, mut hash, mut i) = (name.as_bytes(), 0x811c_9dc5, 0);
    while i < bytes.len() {
        hash = mix(hash, bytes[i] as u32);
        i += 1;
    }
    hash
}

/// Layout of a field's type, which is found from how the field is reached.
pub(crate) const fn layout_of<S, T: Words>(_: fn(&S) -> &T) -> u32 {
    T::LAYOUT
}

impl Words for u32 {
    const LAYOUT: u32 = named("u32");
    const BLANK: Self = 0;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        sink(*self);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        *self = source();
    }
}

impl Words for bool {
    const LAYOUT: u32 = named("bool");
    const BLANK: Self = false;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        sink(u32::from(*self));
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        *self = source() != 0;
    }
}

impl Words for f32 {
    const LAYOUT: u32 = named("f32");
    const BLANK: Self = 0.0;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        sink(self.to_bits());
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        *self = Self::from_bits(source());
    }
}

/// The lower half first.
impl Words for f64 {
    const LAYOUT: u32 = named("f64");
    const BLANK: Self = 0.0;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        let bits = self.to_bits();
        sink(bits as u32);
        sink((bits >> 32) as u32);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        let low = u64::from(source());
        *self = Self::from_bits(low | u64::from(source()) << 32);
    }
}

impl<T: Words, const N: usize> Words for [T; N] {
    const LAYOUT: u32 = mix(T::LAYOUT, N as u32);
    const BLANK: Self = [T::BLANK; N];

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        for value in self {
            value.put(sink);
        }
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        for value in self {
            value.fill(source);
        }
    }
}

impl<A: Words, B: Words> Words for (A, B) {
    // Begun with a name, because a single step of `mix` is the same either way round.
    const LAYOUT: u32 = mix(mix(named("pair"), A::LAYOUT), B::LAYOUT);
    const BLANK: Self = (A::BLANK, B::BLANK);

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        self.0.put(sink);
        self.1.put(sink);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        self.0.fill(source);
        self.1.fill(source);
    }
}

/// A flag, and the value or as many zeros.
impl Words for Option<f64> {
    const LAYOUT: u32 = named("Option<f64>");
    const BLANK: Self = None;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        (self.is_some(), self.unwrap_or(0.0)).put(sink);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        let (is_some, value) = read::<(bool, f64)>(source);
        *self = is_some.then_some(value);
    }
}

/// Implements [`Words`] for a struct: its fields in the order in which they stand here, every one.
macro_rules! words {
    ($([$($generics:tt)*] $type:ty: $($field:ident),* $(,)?;)*) => {
        $(
            impl<$($generics)*> $crate::math::Words for $type {
                const LAYOUT: u32 = {
                    let mut hash = 0;
                    $(
                        hash = $crate::math::mix(hash, $crate::math::named(stringify!($field)));
                        let layout = $crate::math::layout_of(|value: &Self| &value.$field);
                        hash = $crate::math::mix(hash, layout);
                    )*
                    hash
                };

                const BLANK: Self = Self { $($field: $crate::math::Words::BLANK),* };

                fn put(&self, sink: &mut dyn FnMut(u32)) {
                    // A field that is left out does not compile.
                    let Self { $($field),* } = self;
                    $($crate::math::Words::put($field, sink);)*
                }

                // Linked once, however many values of the type another holds.
                #[inline(never)]
                fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
                    // In the order in which they are written.
                    $($crate::math::Words::fill(&mut self.$field, source);)*
                }
            }
        )*
    };
}

pub(crate) use words;

#[cfg(test)]
mod tests {
    use super::Words;

    /// Order, names and types count.
    #[test]
    fn another_layout_has_another_hash() {
        struct One {
            a: f32,
            b: bool,
        }
        struct Swapped {
            a: f32,
            b: bool,
        }
        struct Typed {
            a: [f32; 1],
            b: bool,
        }
        words! {
            [] One: a, b;
            [] Swapped: b, a;
            [] Typed: a, b;
        }
        assert_ne!(One::LAYOUT, Swapped::LAYOUT);
        assert_ne!(One::LAYOUT, Typed::LAYOUT);
        assert_ne!(<[f32; 2]>::LAYOUT, <[f32; 3]>::LAYOUT);
        assert_ne!(<(f32, bool)>::LAYOUT, <(bool, f32)>::LAYOUT);
        let mut count = 0;
        Typed { a: [1.0], b: true }.put(&mut |_| count += 1);
        One { a: 1.0, b: true }.put(&mut |_| count += 1);
        Swapped { a: 1.0, b: true }.put(&mut |_| count += 1);
        assert_eq!(count, 6);
    }

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
        let mut again = Value::BLANK;
        again.fill(&mut || all.next().expect("as many as were written"));
        assert_eq!(again.0.map(f32::to_bits), value.0.map(f32::to_bits));
        assert_eq!(again.1, value.1);
        assert_eq!(words[0], 0.1f32.to_bits());
    }
}
