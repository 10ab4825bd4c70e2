//! Remarks on the link: its sizes, its material, and a stiffness that does not fit its mass.

use super::super::link::LinkTable;
use super::super::sizes::Sizes;

/// Longest link, m. No robot's link is longer; lengths in millimetres exceed it by far.
const LONGEST: f64 = 30.0;

/// Softest solid, Pa.
const SOFTEST: f64 = 1e6;

/// `EI/μ²` of a section, m⁵/(kg s²): `E/12ρ²` times the square's ratio of sides. Steel 270,
/// aluminium 800, carbon 3,000; a hundredth of that for a tape, fifty times for a tube.
const SECTION: (f64, f64) = (0.02, 5e5);

/// Least density of a solid, kg/m³: half of balsa's. In g/cm³ all are below it.
const LIGHTEST: f64 = 50.0;

/// Returns the remarks on a link of that length, m.
pub(super) fn remarks(link: &LinkTable, length: f64) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(given) = link.length.filter(|length| *length > LONGEST) {
        lines.push(metres("link", "length", given));
    }
    lines.extend(sizes("link", &link.sizes(), length));
    for (index, section) in link.sections.iter().flatten().enumerate() {
        let place = format!("link.sections[{index}]");
        if section.length > LONGEST {
            lines.push(metres(&place, "length", section.length));
        }
        lines.extend(sizes(&place, &section.sizes(), length));
        lines.extend(matter(&place, section.youngs_modulus, section.density));
    }
    lines.extend(matter("link", link.youngs_modulus, link.density));
    if let Some(moment) = link.second_moment.filter(|i| (12.0 * i).powf(0.25) > 0.25 * length) {
        lines.push(format!(
            "link.second_moment = {moment}: it is in m^4 ({moment} mm^4 = {:e} m^4)",
            1e-12 * moment
        ));
    }
    // One wrong unit is told once.
    if lines.is_empty() {
        lines.extend(section(link, length));
    }
    lines
}

fn metres(place: &str, key: &str, value: f64) -> String {
    format!("{place}.{key} = {value}: lengths are in m ({value} mm = {} m)", 1e-3 * value)
}

/// Returns remarks on sizes that are large against the whole link.
fn sizes(place: &str, sizes: &Sizes, length: f64) -> Vec<String> {
    let thick = 0.25 * length;
    [
        ("width", sizes.width, length),
        ("thickness", sizes.thickness, thick),
        ("diameter", sizes.diameter, thick),
    ]
    .into_iter()
    .filter_map(|(key, ends, most)| {
        let [clamp, tip] = ends?.0;
        let value = clamp.max(tip);
        (value > most).then(|| metres(place, key, value))
    })
    .collect()
}

/// Returns remarks on a modulus and a density that no solid has.
fn matter(place: &str, modulus: Option<f64>, density: Option<f64>) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(modulus) = modulus.filter(|modulus| *modulus < SOFTEST) {
        let (prefix, unit) = if modulus < 1e3 { (1e9, "GPa") } else { (1e6, "MPa") };
        lines.push(format!(
            "{place}.youngs_modulus = {modulus}: moduli are in Pa ({modulus} {unit} = {:e} Pa)",
            prefix * modulus
        ));
    }
    if let Some(density) = density.filter(|density| *density < LIGHTEST) {
        lines.push(format!(
            "{place}.density = {density}: densities are in kg/m^3 ({density} g/cm^3 = {} kg/m^3)",
            1e3 * density
        ));
    }
    lines
}

/// Returns the remark on a mass and a stiffness that no section of that length has together.
fn section(link: &LinkTable, length: f64) -> Option<String> {
    let mass = link.mass?;
    let stiffness = link.bending_stiffness.or(link
        .youngs_modulus
        .zip(link.second_moment)
        .map(|(modulus, moment)| modulus * moment))?;
    let per_length = mass / length;
    let (least, most) = SECTION;
    let ratio = stiffness / (per_length * per_length);
    if ratio < least {
        let gram = 1e-3 * mass;
        Some(format!(
            "link.mass = {mass}: {per_length:.3} kg/m is far too heavy for a stiffness of \
             {stiffness} N m^2; masses are in kg ({mass} g = {gram} kg)"
        ))
    } else if ratio > most {
        Some(format!(
            "link.bending_stiffness = {stiffness}: far too stiff for {per_length:.3e} kg/m; it is in \
             N m^2 ({stiffness} N mm^2 = {:e} N m^2), masses are in kg",
            1e-6 * stiffness
        ))
    } else {
        None
    }
}
