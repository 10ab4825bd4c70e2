//! Steppers and planners as plain words: set up on the desktop, loaded on the target.
//!
//! | word | holds |
//! |---|---|
//! | 0 | `SBPA`, the lowest byte first |
//! | 1 | version of this table |
//! | 2 to 4 | [`Prepared::KIND`]: family, sizes and scalar, layout |
//! | 5, 6 | the tick, s: the bits of an f64, the lower half first |
//! | 7 | number of words of the value |
//! | 8 … | the value |
//! | last | CRC-32 (ISO-HDLC) of all words before it, each as four bytes, the lowest first |
//!
//! Set-up gives the same bits on desktop and target, so that a loaded stepper is the one that the
//! target would have set up.
//!
//! ```
//! use stillbeam::model::Rod;
//! use stillbeam::prepared::{Prepare, Prepared};
//! use stillbeam::stepper::{Elastica2, Quality};
//! use stillbeam::{Generator, Link, Scene};
//!
//! // On the desktop; `stillbeam-sim export` writes the words as Rust or C.
//! let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
//! let set_up = Elastica2::<f32>::new(&Rod::new(&scene)?, 0.010, Quality::Fast, 1.0)?;
//! let mut words = Vec::new();
//! set_up.prepare(&mut |word| words.push(word));
//!
//! // On the target.
//! let stepper = Elastica2::<f32>::load(&words, 0.010)?;
//! let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
//! assert_eq!(arm.tick().deflection(), 0.0);
//!
//! // Smaller: the stepper stays where it is, and the steps of the other quality are not linked.
//! let stepper = Elastica2::<f32>::load(&words, 0.010)?;
//! let known = stepper.fast().expect("it was set up so");
//! let mut arm = Generator::<_, 8>::new(known, 0.0)?;
//! assert_eq!(arm.tick().deflection(), 0.0);
//! # Ok::<(), stillbeam::Error>(())
//! ```

use crc::{CRC_32_ISO_HDLC, Crc, Digest, NoTable};

use crate::Error;
use crate::math::{self, Words};

/// The first word: `SBPA`, the lowest byte first.
const MAGIC: u32 = u32::from_le_bytes(*b"SBPA");

/// Version of the header. A change of what a type holds changes its layout's hash by itself.
const FORMAT: u32 = 1;

/// Words before the value's own.
const HEADER: usize = 8;

/// Without a table, which would take a kilobyte: words are checked once.
const CRC: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC);

/// A stepper or planner whose numbers can be written as words. The type that loads them may be
/// known only when the program runs, as that of [`Auto`](crate::select::Auto).
pub trait Prepare {
    /// Returns the type that loads the words: see [`Prepared::KIND`].
    fn kind(&self) -> [u32; 3];

    /// Returns the tick that the value was set up for, s.
    fn period(&self) -> f64;

    /// Hands the words of the value itself to `sink`, first to last.
    fn put_own(&self, sink: &mut dyn FnMut(u32));

    /// Hands the words of the prepared value to `sink`, first to last: header, value, checksum.
    fn prepare(&self, sink: &mut dyn FnMut(u32)) {
        let mut count = 0;
        self.put_own(&mut |_| count += 1);
        let mut digest = CRC.digest();
        let mut put = |word: u32| {
            digest.update(&word.to_le_bytes());
            sink(word);
        };
        let [family, sizes, layout] = self.kind();
        for word in [MAGIC, FORMAT, family, sizes, layout] {
            put(word);
        }
        self.period().put(&mut put);
        put(count);
        self.put_own(&mut put);
        sink(digest.finalize());
    }
}

/// A stepper or planner that can be loaded from the words that another program has prepared.
///
/// A program that only loads links no set-up: no matrices, no eigenvalues, no fit.
pub trait Prepared: Prepare + Words {
    /// The type: four letters of the family; sizes and bytes of the scalar, a byte each; the hash
    /// of its layout, [`Words::LAYOUT`].
    const KIND: [u32; 3];

    /// Loads the value from the words of [`Prepare::prepare`], for ticks of `tick` s.
    ///
    /// # Errors
    /// [`Error::NotPrepared`] for words that are not a prepared value of this type and version,
    /// that are cut, or that have changed; [`Error::OutOfRange`] for another tick.
    fn load(words: &[u32], tick: f64) -> Result<Self, Error> {
        load(words.len(), &|i| words.get(i).copied().unwrap_or(0), tick)
    }

    /// Loads the value as [`Self::load`] does, from bytes at any address: four a word, the lowest
    /// first.
    ///
    /// # Errors
    /// Those of [`Self::load`]; also bytes that are not whole words.
    fn load_bytes(bytes: &[u8], tick: f64) -> Result<Self, Error> {
        let (words, rest) = bytes.as_chunks::<4>();
        require(&[("arm.bytes", bytes.len() as u32, (bytes.len() - rest.len()) as u32)])?;
        let word = |i: usize| words.get(i).map_or(0, |&word| u32::from_le_bytes(word));
        load(words.len(), &word, tick)
    }
}

fn load<S: Prepared>(count: usize, word: &dyn Fn(usize) -> u32, tick: f64) -> Result<S, Error> {
    check(count, word, S::KIND)?;
    let mut reader = Reader { word, next: 5 };
    let prepared: f64 = math::read(&mut || reader.read());
    if prepared.to_bits() != tick.to_bits() {
        let (parameter, min, max, unit) = ("arm.tick", tick, tick, "s");
        return Err(Error::OutOfRange { parameter, value: prepared, min, max, unit });
    }
    let own = reader.read();
    let mut value = S::BLANK;
    value.fill(&mut || reader.read());
    // A value of this type has a number of words of its own, which the header has told.
    require(&[("arm.words", own, (reader.next - HEADER) as u32)])?;
    Ok(value)
}

/// Words, one after the other.
struct Reader<'a> {
    word: &'a dyn Fn(usize) -> u32,
    next: usize,
}

impl Reader<'_> {
    // Of a prepared value every word is a call, which is to be short.
    #[inline(never)]
    fn read(&mut self) -> u32 {
        self.next += 1;
        (self.word)(self.next - 1)
    }
}

/// Refuses words that are not a prepared value of that kind.
#[inline(never)]
fn check(count: usize, word: &dyn Fn(usize) -> u32, kind: [u32; 3]) -> Result<(), Error> {
    let [family, sizes, layout] = kind;
    let whole = (HEADER as u32 + 1).saturating_add(word(7));
    require(&[
        ("arm.magic", word(0), MAGIC),
        ("arm.format", word(1), FORMAT),
        ("arm.method", word(2), family),
        ("arm.sizes", word(3), sizes),
        ("arm.layout", word(4), layout),
        ("arm.length", count as u32, whole),
    ])?;
    let mut digest = CRC.digest();
    for i in 0..count - 1 {
        for byte in word(i).to_le_bytes() {
            add(&mut digest, byte);
        }
    }
    require(&[("arm.checksum", word(count - 1), digest.finalize())])
}

/// Adds a byte to a checksum. A function of its own, linked once: the loop over its bits is
/// unrolled, and one over bytes would be besides.
#[inline(never)]
fn add(digest: &mut Digest<'_, u32, NoTable>, byte: u8) {
    digest.update(&[byte]);
}

/// Refuses the first of these whose word that was found is not the one that is needed.
// One loop over all of them: an error that is returned from many places is copied in each.
#[inline(never)]
fn require(words: &[(&'static str, u32, u32)]) -> Result<(), Error> {
    match words.iter().find(|(_, found, needed)| found != needed) {
        Some(&(parameter, found, needed)) => Err(Error::NotPrepared { parameter, found, needed }),
        None => Ok(()),
    }
}

/// The second word of a kind.
pub(crate) const fn sizes<T>(n: usize, w: usize, variant: bool) -> u32 {
    u32::from_le_bytes([n as u8, w as u8, variant as u8, size_of::<T>() as u8])
}
