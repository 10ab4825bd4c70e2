//! Colours that readers with any colour vision can tell apart.

use plotters::style::RGBColor;

/// The palette of Okabe and Ito, without its yellow, which is too pale on white paper.
///
/// In SVG the colours stand as `#RRGGBB` in upper case. A page's style sheet can lighten them for a
/// dark background by attribute selectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The colour of text.
    Ink,
    /// The colour of rules and of secondary elements.
    Grey,
    /// #0072B2.
    Blue,
    /// #D55E00.
    Vermilion,
    /// #009E73.
    Green,
    /// #CC79A7.
    Purple,
    /// #E69F00.
    Orange,
    /// #56B4E9.
    Sky,
}

impl Colour {
    /// The order in which series take them.
    pub const CYCLE: [Self; 6] =
        [Self::Blue, Self::Vermilion, Self::Green, Self::Purple, Self::Orange, Self::Sky];

    /// Converts to a plotters colour.
    pub(super) fn rgb(self) -> RGBColor {
        match self {
            Self::Ink => RGBColor(0x22, 0x22, 0x22),
            Self::Grey => RGBColor(0x88, 0x88, 0x88),
            Self::Blue => RGBColor(0x00, 0x72, 0xB2),
            Self::Vermilion => RGBColor(0xD5, 0x5E, 0x00),
            Self::Green => RGBColor(0x00, 0x9E, 0x73),
            Self::Purple => RGBColor(0xCC, 0x79, 0xA7),
            Self::Orange => RGBColor(0xE6, 0x9F, 0x00),
            Self::Sky => RGBColor(0x56, 0xB4, 0xE9),
        }
    }
}

/// Colour of the grid's lines.
pub(super) const GRID: RGBColor = RGBColor(0xDD, 0xDD, 0xDD);
