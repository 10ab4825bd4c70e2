//! Tables and numbers in the format of the pages.

/// Formats Markdown with columns of even width, the first to the left, numbers to the right.
pub fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.first().map_or(0, Vec::len);
    let width = |c: usize| {
        lines.iter().filter_map(|line| line.get(c)).fold(0, |most, s| most.max(s.chars().count()))
    };
    let widths: Vec<usize> = (0..columns).map(|c| width(c).max(3)).collect();
    let mut text = String::new();
    for (index, line) in lines.iter().enumerate() {
        for (c, (cell, &width)) in line.iter().zip(&widths).enumerate() {
            text +=
                &if c == 0 { format!("| {cell:<width$} ") } else { format!("| {cell:>width$} ") };
        }
        text += "|\n";
        if index == 0 {
            for (c, width) in widths.iter().enumerate() {
                let dashes = "-".repeat(width - usize::from(c > 0));
                text += &if c == 0 { format!("| {dashes} ") } else { format!("| {dashes}: ") };
            }
            text += "|\n";
        }
    }
    text
}

/// Formats a count with a comma between its thousands.
pub fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Returns the value below which a share of the rising values lies, 0 to 1. Returns `None` without
/// values.
pub fn quantile<T: Copy>(sorted: &[T], share: f64) -> Option<T> {
    let last = sorted.len().checked_sub(1)?;
    sorted.get((last as f64 * share) as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_even_and_thousands_apart() {
        let lines = [["a", "b"], ["long", "1"]].map(|line| line.map(str::to_owned).to_vec());
        assert_eq!(aligned(&lines), "| a    |   b |\n| ---- | --: |\n| long |   1 |\n");
        assert_eq!([7, 1234, 1_234_567].map(grouped), ["7", "1,234", "1,234,567"]);
    }

    #[test]
    fn quantiles_are_values() {
        assert_eq!(quantile::<f64>(&[], 0.5), None);
        let values: Vec<u32> = (0..=100).collect();
        assert_eq!(
            [0.0, 0.5, 0.99, 1.0].map(|share| quantile(&values, share)),
            [Some(0), Some(50), Some(99), Some(100)]
        );
    }
}
