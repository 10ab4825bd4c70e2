//! Rewrites the messages of the TOML library: the key, the given value, and what it must be.

/// Explains that a value is not of its key's type, from serde's message.
pub(super) fn mismatch(path: &str, given: &str, message: &str) -> String {
    let given = given.lines().next().unwrap_or("");
    let inside = |key: &str| match path {
        "" => key.to_owned(),
        path if path.rsplit('.').next() == Some(key) => path.to_owned(),
        path => format!("{path}.{key}"),
    };
    // The TOML library hands a date over as a table of its own.
    if message.contains("$__toml") {
        let path = path.split(".$__toml").next().unwrap_or(path);
        return format!("{path} = {given}: must be a table of keys and values");
    }
    if let Some((name, known)) = quoted(message, "unknown field ") {
        return format!("{}: unknown key; must be {}", inside(name), choice(name, &known));
    }
    if let Some((name, known)) = quoted(message, "unknown variant ") {
        return format!("{path} = \"{name}\": must be {}", choice(name, &known));
    }
    if let Some((name, _)) = quoted(message, "missing field ") {
        let table = if path.is_empty() { "the file".to_owned() } else { format!("[{path}]") };
        return format!("{}: missing; must be given in {table}", inside(name));
    }
    if message.contains("overflowed") {
        return format!("{path} = {given}: must be a number of at most 1.8e308");
    }
    let Some((_, expected)) = message.split_once(", expected ") else {
        return format!("{path}: {message}");
    };
    let last = path.rsplit(['.', ']']).next().unwrap_or(path);
    match (last, expected) {
        ("moves", "a sequence") => {
            "moves: must be [[moves]] in double brackets, one for each move".to_owned()
        }
        ("grid", "a sequence") => {
            "grid: must be [[grid]] in double brackets, one for each grid".to_owned()
        }
        ("move", expected) if expected.starts_with("struct") => {
            "move: must be one [move] in single brackets; several moves are [[moves]]".to_owned()
        }
        (_, expected) => format!("{path} = {given}: must be {}", kind(expected, given)),
    }
}

/// Returns the type that serde expects in plain words.
fn kind(expected: &str, given: &str) -> String {
    let bare = given.trim_matches(['"', '\'']);
    match expected {
        "f64" if bare != given && bare.parse::<f64>().is_ok() => {
            format!("a number without quotes, e.g. {bare}")
        }
        "f64" => number(bare),
        "i64" => "a whole number, e.g. 2".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a string" => "a text in quotes".to_owned(),
        "a sequence" => "a list in brackets, e.g. [1, 2]".to_owned(),
        other if other.starts_with("struct") => "a table of keys and values".to_owned(),
        other if other.starts_with("an array of length") || other.starts_with("a tuple") => {
            "two numbers, e.g. [0.5, 0.1]".to_owned()
        }
        other if other.starts_with("enum") || other.contains("identifier") => {
            "a name in quotes".to_owned()
        }
        other => other.to_owned(),
    }
}

/// Explains that the text after a key's `=` is not a TOML value.
pub(super) fn no_value(path: &str, given: &str, message: &str) -> String {
    let wanted = if given.is_empty() {
        "a value behind the =".to_owned()
    } else if given.starts_with(|c: char| c.is_ascii_digit() || ['+', '-', '.'].contains(&c)) {
        number(given)
    } else if given.chars().all(|c| c.is_ascii_alphanumeric() || ['-', '_'].contains(&c)) {
        format!("in quotes if it is a name, \"{given}\"; true, false or a number if not")
    } else {
        return format!("{path} = {given}: {message}; must be a value, e.g. 0.5 or \"cubic\"");
    };
    format!("{path} = {given}: must be {wanted}")
}

/// Explains that a line is not TOML.
pub(super) fn no_toml(given: &str, message: &str) -> String {
    format!("\"{given}\": {message}; must be key = value, or a table's name in brackets")
}

/// Describes the number that is wanted in place of a text that only begins as one.
fn number(given: &str) -> String {
    let end = given
        .find(|c: char| !(c.is_ascii_digit() || ['+', '-', '.', ',', '_'].contains(&c)))
        .unwrap_or(given.len());
    let (digits, unit) = (given[..end].trim_end_matches([',', '_']), given[end..].trim());
    let plain = digits.replace(',', ".").trim_end_matches('.').to_owned();
    let Ok(value) = plain.parse::<f64>() else { return "a number, e.g. 0.5".to_owned() };
    if unit.starts_with("deg") || unit.starts_with('\u{b0}') {
        return format!("a number in rad: {plain} deg are {:.4}", value.to_radians());
    }
    if digits.contains(',') {
        return format!("a number with a decimal point, e.g. {plain}");
    }
    if unit.starts_with(char::is_alphabetic) {
        return format!("a number without its unit, in SI units, e.g. {}", si(value, unit));
    }
    "a number, e.g. 0.5".to_owned()
}

/// Converts a value to its SI unit, if the unit is known.
fn si(value: f64, unit: &str) -> String {
    let factor = match unit {
        "ms" | "mm" | "g" | "mNm" => 1e-3,
        "us" | "um" => 1e-6,
        "cm" => 1e-2,
        "GPa" => 1e9,
        "MPa" => 1e6,
        _ => 1.0,
    };
    let scaled = value * factor;
    // Without the digits that a product leaves.
    format!("{:.12}", scaled).trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns the name after `prefix` and the known names. All of them stand in backticks.
fn quoted<'a>(message: &'a str, prefix: &str) -> Option<(&'a str, Vec<&'a str>)> {
    let mut parts = message.strip_prefix(prefix)?.split('`').skip(1).step_by(2);
    Some((parts.next()?, parts.collect()))
}

/// Lists the known names, and the one that is close to the given name.
fn choice(given: &str, known: &[&str]) -> String {
    let near = known
        .iter()
        .map(|name| (strsim::normalized_damerau_levenshtein(given, name), name))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .filter(|(likeness, _)| *likeness > 0.5);
    let suggestion = near.map_or(String::new(), |(_, name)| format!("; is it {name}?"));
    match known {
        [] => "absent".to_owned(),
        [one] => format!("{one}{suggestion}"),
        all => format!("one of {}{suggestion}", all.join(", ")),
    }
}

/// Returns the path with which an error of a scene begins. For `moves[3]: move.duration = 0: …` it
/// is the path of the move's own key.
pub(super) fn path_of(error: &str) -> Option<Vec<String>> {
    let name = |text: &str| -> String {
        text.chars().take_while(|c| c.is_ascii_alphanumeric() || "_.[]".contains(*c)).collect()
    };
    let first = name(error);
    let mut path: Vec<String> =
        first.split(['.', '[', ']']).filter(|step| !step.is_empty()).map(str::to_owned).collect();
    if let (Some(rest), true) = (error.split_once(": ").map(|(_, rest)| rest), path.len() == 2)
        && first.starts_with("moves[")
    {
        let key = name(rest);
        path.push(key.strip_prefix("move.").unwrap_or(&key).to_owned());
    }
    (!path.is_empty()).then_some(path)
}
