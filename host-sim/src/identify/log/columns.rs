//! Which columns of a log are read, and what their names say about their units.

use clap::ValueEnum;

use crate::error::Error;

/// Columns by name. `None` is found among the names that are usual.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// Time.
    pub time: Option<String>,
    /// Hub angle.
    pub hub: Option<String>,
    /// Sensor.
    pub sensor: Option<String>,
    /// Quantity that the sensor measures.
    pub kind: Option<Kind>,
}

/// Quantity that a sensor measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// Deflection of the tip in the hub's frame, m, or in rad as seen from the clamp.
    Deflection,
    /// Angle of the link's tangent at the tip in the hub's frame, rad.
    Angle,
    /// Strain of the link, in any unit.
    Strain,
    /// Acceleration of the link across itself, m/s².
    Acceleration,
    /// Torque of the motor, N m.
    Torque,
}

/// Columns as found in a header.
pub(super) struct Found {
    pub time: Column,
    pub hub: Option<Column>,
    pub sensor: Column,
    pub kind: Kind,
}

/// A column: its place, its name, and the unit that its name ends in.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub index: usize,
    pub name: String,
    /// Factor to the SI unit.
    pub factor: f64,
    /// SI unit.
    pub unit: &'static str,
}

/// Endings of names: unit in the file, factor, SI unit. Longer ones before those they end in.
const UNITS: [(&str, f64, &str); 19] = [
    ("_mm_s2", 1e-3, "m/s²"),
    ("_m_s2", 1.0, "m/s²"),
    ("_mrad", 1e-3, "rad"),
    ("_rad", 1.0, "rad"),
    ("_deg", std::f64::consts::PI / 180.0, "rad"),
    ("_turn", std::f64::consts::TAU, "rad"),
    ("_strain", 1.0, "strain"),
    ("_mg", 9.80665e-3, "m/s²"),
    ("_g", 9.80665, "m/s²"),
    ("_um", 1e-6, "m"),
    ("_mm", 1e-3, "m"),
    ("_nm", 1.0, "N m"),
    ("_m", 1.0, "m"),
    ("_mv", 1e-3, "V"),
    ("_v", 1.0, "V"),
    ("_ns", 1e-9, "s"),
    ("_us", 1e-6, "s"),
    ("_ms", 1e-3, "s"),
    ("_s", 1.0, "s"),
];

/// Names of the time, in order of preference.
const TIMES: [&str; 8] =
    ["t_s", "time_s", "unix_time_s", "timestamp_s", "t", "time", "timestamp", "unix_time"];

/// Names of the hub's angle.
const HUBS: [&str; 2] = ["hub_angle_rad", "hub_angle_deg"];

/// Beginnings of a sensor's name, in order of preference.
const SENSORS: [&str; 6] =
    ["tip_deflection", "deflection", "tip_", "strain", "sensor", "acceleration"];

impl Columns {
    /// Finds the columns in a header.
    pub(super) fn find(&self, header: &[String]) -> Result<Found, Error> {
        let place = |name: &str| header.iter().position(|found| found.eq_ignore_ascii_case(name));
        let column = |index: usize| Column::of(index, &header[index]);
        let asked = |key: &str, name: &Option<String>| match name {
            None => Ok(None),
            Some(name) => place(name).map(column).map(Some).ok_or_else(|| {
                Error::new(format_args!(
                    "{key} = {name}: no such column; must be one of {}",
                    header.join(", ")
                ))
            }),
        };
        let time = match asked("--time", &self.time)? {
            Some(time) => time,
            None => find_time(header)?,
        };
        let hub = match asked("--hub", &self.hub)? {
            Some(hub) => Some(hub),
            None => HUBS.iter().find_map(|name| place(name)).map(column),
        };
        let taken = [Some(time.index), hub.as_ref().map(|hub| hub.index)];
        let sensor = match asked("--sensor", &self.sensor)? {
            Some(sensor) if taken.contains(&Some(sensor.index)) => {
                return Err(Error::new(format_args!(
                    "--sensor = {}: must be another column than time and hub",
                    sensor.name
                )));
            }
            Some(sensor) => sensor,
            None => find_sensor(header, &taken)?,
        };
        let kind = match self.kind {
            Some(kind) => kind,
            None => sensor.kind()?,
        };
        Ok(Found { time, hub, sensor, kind })
    }
}

fn find_time(header: &[String]) -> Result<Column, Error> {
    let lower: Vec<String> = header.iter().map(|name| name.to_lowercase()).collect();
    let exact = TIMES.iter().find_map(|name| lower.iter().position(|found| found == name));
    let like = || {
        lower.iter().position(|found| {
            let begins = ["t_", "time_", "timestamp_"].iter().any(|head| found.starts_with(head));
            begins && Column::of(0, found).unit == "s"
        })
    };
    exact.or_else(like).map(|index| Column::of(index, &header[index])).ok_or_else(|| {
        Error::new(format_args!(
            "no time column among \"{}\"; must have t_s, or --time must name it",
            header.join(", ")
        ))
    })
}

fn find_sensor(header: &[String], taken: &[Option<usize>]) -> Result<Column, Error> {
    let left: Vec<usize> = (0..header.len()).filter(|&k| !taken.contains(&Some(k))).collect();
    let begins =
        |head: &str| left.iter().copied().find(|&k| header[k].to_lowercase().starts_with(head));
    let index = match left[..] {
        [only] => Some(only),
        _ => SENSORS.iter().find_map(|head| begins(head)),
    };
    index.map(|index| Column::of(index, &header[index])).ok_or_else(|| {
        Error::new(format_args!(
            "no sensor column among \"{}\"; --sensor must name it",
            header.join(", ")
        ))
    })
}

impl Column {
    fn of(index: usize, name: &str) -> Self {
        let lower = name.to_lowercase();
        let unit = UNITS.iter().find(|(ending, ..)| lower.ends_with(ending));
        let (factor, unit) = unit.map_or((1.0, ""), |(_, factor, unit)| (*factor, unit));
        Self { index, name: name.to_owned(), factor, unit }
    }

    /// Returns what a sensor of that name and unit measures.
    fn kind(&self) -> Result<Kind, Error> {
        let lower = self.name.to_lowercase();
        let named = |words: &[&str]| words.iter().any(|word| lower.contains(word));
        match self.unit {
            "m" => Ok(Kind::Deflection),
            "m/s²" => Ok(Kind::Acceleration),
            "N m" => Ok(Kind::Torque),
            "rad" if named(&["deflection"]) => Ok(Kind::Deflection),
            "rad" => Ok(Kind::Angle),
            "strain" | "V" => Ok(Kind::Strain),
            _ if named(&["deflection"]) => Ok(Kind::Deflection),
            _ if named(&["accel"]) => Ok(Kind::Acceleration),
            _ if named(&["strain", "gauge"]) => Ok(Kind::Strain),
            _ if named(&["torque"]) => Ok(Kind::Torque),
            _ => Err(Error::new(format_args!(
                "--kind: missing, and column {} has no unit that tells it; must be deflection, angle, \
                 strain, acceleration or torque",
                self.name
            ))),
        }
    }
}
