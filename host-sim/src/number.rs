//! Numbers as a reader sees them.

use crate::table::significant;

/// How many digits of a number are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// That many decimals.
    Decimals(usize),
    /// Three significant digits, plain if that is short.
    Three,
    /// Three digits but no fourth decimal, for columns whose numbers stand below each other.
    Column,
}

impl Digits {
    /// Formats a number. An infinite one has diverged; what is not a number has nothing to count.
    pub fn show(self, value: f64) -> String {
        if value.is_nan() {
            return "–".to_owned();
        }
        if value.is_infinite() {
            return "diverges".to_owned();
        }
        match self {
            Self::Decimals(decimals) => format!("{value:.decimals$}"),
            Self::Three => {
                let value = significant(value, 3);
                let digits = if value == 0.0 { 0 } else { 2 - value.abs().log10().floor() as i32 };
                match digits {
                    ..=0 => format!("{value:.0}"),
                    1..=6 => format!("{value:.*}", digits as usize),
                    _ => format!("{value:.2e}"),
                }
            }
            Self::Column if value >= 10.0 => format!("{value:.1}"),
            Self::Column if value >= 1.0 => format!("{value:.2}"),
            Self::Column => format!("{value:.3}"),
        }
    }
}

/// Formats `part` of `whole` as a percentage with its sign, e.g. `13.0 %`.
pub fn percent(part: f64, whole: f64, digits: Digits) -> String {
    let value = 100.0 * part / whole;
    let unit = if value.is_finite() { " %" } else { "" };
    format!("{}{unit}", digits.show(value))
}

/// Formats a fraction as a percentage without zeros at its end, e.g. `0.1 %`, rounded to so many
/// significant digits.
pub fn short_percent(fraction: f64, digits: usize) -> String {
    format!("{} %", significant(100.0 * fraction, digits))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits() {
        let cases = [
            (0.0, "0"),
            (13.04, "13.0"),
            (9.996, "10.0"),
            (0.001234, "0.00123"),
            (1234.0, "1230"),
            (1.234e-6, "1.23e-6"),
            (f64::INFINITY, "diverges"),
        ];
        for (x, text) in cases {
            assert_eq!(Digits::Three.show(x), text);
        }
    }

    #[test]
    fn a_column_stops_at_the_third_decimal() {
        let cases = [(0.0004, "0.000"), (0.0126, "0.013"), (1.234, "1.23"), (45.678, "45.7")];
        for (x, text) in cases {
            assert_eq!(Digits::Column.show(x), text);
        }
    }

    #[test]
    fn a_percentage_has_its_sign_unless_it_is_no_number() {
        assert_eq!(percent(0.1304, 1.0, Digits::Three), "13.0 %");
        assert_eq!(percent(-1.0, 4.0, Digits::Decimals(1)), "-25.0 %");
        assert_eq!(percent(f64::INFINITY, 1.0, Digits::Three), "diverges");
        assert_eq!(percent(0.0, 0.0, Digits::Decimals(2)), "–");
    }
}
