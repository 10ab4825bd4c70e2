//! TOML files whose errors name file, line, column, key, and what the value must be.

mod tables;
mod words;

use serde::de::DeserializeOwned;
use toml::de::{DeTable, DeValue};

use self::tables::Tables;
use crate::error::Error;

/// A TOML text with the positions of its keys.
pub struct Document<'a> {
    /// Name of the text in errors: its file, or another name.
    place: &'a str,
    text: &'a str,
    root: DeValue<'a>,
}

/// Range of bytes in the text, from which lines and columns are counted.
type Span = std::ops::Range<usize>;

/// A key of the text: its path, e.g. `moves[3].duration`, and its position.
struct Key {
    path: String,
    span: Span,
}

impl<'a> Document<'a> {
    /// Parses a text. Errors call it `place`.
    pub fn parse(place: &'a str, text: &'a str) -> Result<Self, Error> {
        // What can be made of a broken text tells the key that it breaks at.
        let (table, errors) = DeTable::parse_recoverable(text);
        let document = Self { place, text, root: DeValue::Table(table.into_inner()) };
        match errors.first() {
            Some(error) => Err(document.unparsed(error)),
            None => Ok(document),
        }
    }

    /// Reads the text as a `T`.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, Error> {
        let tokens = toml::Deserializer::parse(self.text).map_err(|error| self.unparsed(&error))?;
        serde_path_to_error::deserialize(Tables(tokens)).map_err(|error| {
            let path = error.path().to_string();
            let span = error.inner().span().unwrap_or(0..0);
            let given = self.text.get(span.clone()).unwrap_or("");
            let path = if path == "." { String::new() } else { path };
            let message = words::mismatch(&path, given, error.inner().message());
            self.error_at(span.start, message)
        })
    }

    /// Adds the position of a key to an error that begins with that key, as errors of scenes do.
    pub fn locate(&self, error: &Error) -> Error {
        let text = error.to_string();
        match words::path_of(&text).and_then(|path| self.find(&path)) {
            Some(start) => self.error_at(start, &text),
            None => Error::new(format_args!("{}: {text}", self.place)),
        }
    }

    /// Returns the byte at which the value of a path begins. If the value is absent, returns that
    /// of the innermost table around it.
    fn find(&self, path: &[String]) -> Option<usize> {
        let (mut value, mut start) = (&self.root, None);
        for step in path {
            let next = match value {
                DeValue::Table(table) => {
                    table.iter().find(|(key, _)| key.get_ref() == step).map(|(_, value)| value)
                }
                DeValue::Array(list) => step.parse().ok().and_then(|k: usize| list.get(k)),
                _ => None,
            };
            let Some(next) = next else { break };
            (value, start) = (next.get_ref(), Some(next.span().start));
        }
        start
    }

    /// Returns the error of a text that is not TOML.
    fn unparsed(&self, error: &toml::de::Error) -> Error {
        let at = error.span().map_or(self.text.len(), |span| span.start).min(self.text.len());
        let message = error.message();
        let mut keys = Vec::new();
        collect(&self.root, "", &mut keys);
        if message.contains("duplicate") {
            let name = self.text.get(error.span().unwrap_or(0..0)).unwrap_or("").trim();
            let named = |key: &&Key| key.path.rsplit('.').next() == Some(name);
            let before = keys.iter().filter(|key| key.span.start < at).filter(named);
            if let Some(first) = before.max_by_key(|key| key.span.start) {
                let (line, _) = self.position(first.span.start);
                let path = &first.path;
                return self.error_at(
                    at,
                    format_args!("{path}: given twice, first in line {line}; must be given once"),
                );
            }
        }
        // The key of the line, where the line has one.
        let (line, _) = self.position(at);
        let of_line = keys.iter().filter(|key| self.position(key.span.start).0 == line);
        let key = of_line.filter(|key| key.span.start <= at).max_by_key(|key| key.span.start);
        let Some((key, (start, given))) = key.and_then(|key| Some((key, self.value_after(key)?)))
        else {
            let given = self.text.lines().nth(line - 1).unwrap_or("").trim();
            return self.error_at(at, words::no_toml(given, message));
        };
        self.error_at(start, words::no_value(&key.path, given, message))
    }

    /// Returns the value after a key's `=`, without a comment, and the byte at which it begins.
    fn value_after(&self, key: &Key) -> Option<(usize, &'a str)> {
        let rest = self.text.get(key.span.end..)?.lines().next()?;
        let (_, value) = rest.split_once('=')?;
        let value = value.trim_start();
        let start = key.span.end + (rest.len() - value.len());
        let value = value.split('#').next().unwrap_or(value).trim_end();
        Some((start, value))
    }

    /// Returns line and column of a byte, both from 1.
    fn position(&self, byte: usize) -> (usize, usize) {
        let before = self.text.get(..byte).unwrap_or(self.text);
        let line = before.rsplit('\n').next().unwrap_or("");
        (before.matches('\n').count() + 1, line.chars().count() + 1)
    }

    fn error_at(&self, byte: usize, message: impl std::fmt::Display) -> Error {
        let (line, column) = self.position(byte);
        Error::new(format_args!("{}:{line}:{column}: {message}", self.place))
    }
}

/// Collects every key of a value. `path` is the value's own.
fn collect(value: &DeValue<'_>, path: &str, keys: &mut Vec<Key>) {
    match value {
        DeValue::Table(table) => {
            for (key, value) in table {
                let dot = if path.is_empty() { "" } else { "." };
                let path = format!("{path}{dot}{}", key.get_ref());
                keys.push(Key { path: path.clone(), span: key.span() });
                collect(value.get_ref(), &path, keys);
            }
        }
        DeValue::Array(list) => {
            for (k, value) in list.iter().enumerate() {
                collect(value.get_ref(), &format!("{path}[{k}]"), keys);
            }
        }
        _ => {}
    }
}
