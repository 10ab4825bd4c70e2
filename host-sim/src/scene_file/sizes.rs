//! Cross-sections from the sizes in a file. Which sizes are given tells the shape.

use stillbeam::scene::CrossSection;

use super::values::Ends;
use crate::error::Error;

/// Sizes of a cross-section, m, as they stand in a table.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sizes {
    pub width: Option<Ends>,
    pub thickness: Option<Ends>,
    pub diameter: Option<Ends>,
    pub wall: Option<Ends>,
}

impl Sizes {
    /// Returns the cross-section at both ends, in range, or `None` if no size is given. Errors
    /// begin with `place`.
    pub fn cross_section(&self, place: &str) -> Result<Option<CrossSection<[f64; 2]>>, Error> {
        let [width, thickness, diameter, wall] =
            [self.width, self.thickness, self.diameter, self.wall].map(|ends| ends.map(|e| e.0));
        let cut = match (width, thickness, diameter, wall) {
            (None, None, None, None) => return Ok(None),
            (Some(width), Some(thickness), None, None) => CrossSection::Strip { width, thickness },
            (Some(width), Some(thickness), None, Some(wall)) => {
                CrossSection::RectangleTube { width, thickness, wall }
            }
            (None, None, Some(diameter), None) => CrossSection::Round { diameter },
            (None, None, Some(diameter), Some(wall)) => CrossSection::Tube { diameter, wall },
            (Some(_), None, None, _) => return Err(self.missing(place, "thickness", "width")),
            (None, Some(_), None, _) => return Err(self.missing(place, "width", "thickness")),
            (None, None, None, Some(_)) => {
                return Err(self.missing(place, "diameter", "wall"));
            }
            (_, _, Some(_), _) => {
                let key = if width.is_some() { "width" } else { "thickness" };
                return Err(Error::new(format_args!(
                    "{place}.{key} = {}: must be absent beside diameter = {}; a section is round or \
                     it is rectangular",
                    self.text(key),
                    self.text("diameter")
                )));
            }
        };
        for s in [0.0, 1.0] {
            cut.at(s).validate().map_err(|error| located(&error, place))?;
        }
        Ok(Some(cut))
    }

    fn missing(&self, place: &str, key: &str, given: &str) -> Error {
        Error::new(format_args!(
            "{place}.{key}: missing beside {given} = {}; must be width and thickness, or diameter, \
             each with wall for a tube",
            self.text(given)
        ))
    }

    /// Writes a size as it stands in the file.
    fn text(&self, key: &str) -> String {
        let ends = match key {
            "width" => self.width,
            "thickness" => self.thickness,
            "diameter" => self.diameter,
            _ => self.wall,
        };
        ends.map_or(String::new(), Ends::text)
    }
}

/// Returns true if both ends are alike.
pub(super) fn is_uniform(cut: &CrossSection<[f64; 2]>) -> bool {
    cut.at(0.0) == cut.at(1.0)
}

/// Gives an error of the core the path of the table that it is of. The core calls every link `link`
/// and every section `link.sections`.
pub(super) fn located(error: &stillbeam::Error, place: &str) -> Error {
    let text = error.to_string();
    let key = text.strip_prefix("link.sections.").or_else(|| text.strip_prefix("link."));
    match key {
        Some(key) => Error::new(format_args!("{place}.{key}")),
        None => Error::new(text),
    }
}
