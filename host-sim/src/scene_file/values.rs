//! Values of a scene file that are one number or several: both ends of a section, several modes.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

/// A size at both ends of a section, clamp side first. One number stands for both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ends(pub [f64; 2]);

/// Numbers of the first modes, at least one. A single number needs no brackets.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Modes(pub Vec<f64>);

/// A number, or the word that asks for it to be deduced from measurements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Given {
    /// The number itself.
    Number(f64),
    /// `"deduced"`.
    Deduced,
}

impl Given {
    /// The word in scene files.
    pub const WORD: &'static str = "deduced";
}

impl Ends {
    /// Writes the value as it stands in the file.
    pub fn text(self) -> String {
        let [a, b] = self.0;
        if a == b { a.to_string() } else { format!("[{a}, {b}]") }
    }
}

impl Modes {
    /// Writes the value as it stands in the file.
    pub fn text(&self) -> String {
        match &self.0[..] {
            [one] => one.to_string(),
            all => format!("{all:?}"),
        }
    }
}

/// Reads one number or a list of numbers.
struct Numbers(&'static str);

impl<'de> Visitor<'de> for Numbers {
    type Value = Vec<f64>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Vec<f64>, E> {
        Ok(vec![value])
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Vec<f64>, E> {
        Ok(vec![value as f64])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<f64>, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = list.next_element()? {
            numbers.push(number);
        }
        Ok(numbers)
    }
}

impl<'de> Deserialize<'de> for Ends {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        const WANTED: &str = "a number, or two for clamp side and tip side, e.g. [0.03, 0.015]";
        let numbers = from.deserialize_any(Numbers(WANTED))?;
        match numbers[..] {
            [both] => Ok(Self([both; 2])),
            [clamp, tip] => Ok(Self([clamp, tip])),
            _ => Err(Error::invalid_length(numbers.len(), &WANTED)),
        }
    }
}

impl<'de> Deserialize<'de> for Modes {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        const WANTED: &str =
            "a number for the first mode, or one for each of the first modes, e.g. [2.5, 16.0]";
        let numbers = from.deserialize_any(Numbers(WANTED))?;
        if numbers.is_empty() {
            return Err(Error::invalid_length(0, &WANTED));
        }
        Ok(Self(numbers))
    }
}

impl<'de> Deserialize<'de> for Given {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Value;

        impl Visitor<'_> for Value {
            type Value = Given;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a number, or \"{}\"", Given::WORD)
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Given, E> {
                Ok(Given::Number(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Given, E> {
                Ok(Given::Number(value as f64))
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<Given, E> {
                if word == Given::WORD {
                    return Ok(Given::Deduced);
                }
                Err(Error::invalid_value(serde::de::Unexpected::Str(word), &self))
            }
        }

        from.deserialize_any(Value)
    }
}
